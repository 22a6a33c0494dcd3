# SPDX-License-Identifier: Apache-2.0
"""Tests in a process of their own, on a stand-in for one module, with a limit of time.

Times are those of the processor, so that a busy machine kills no mutant. Where a simulation writes its
results to a file (plusargs in WRITTEN), it is ended soon after a line that differs from the right netlist's
file; the lines after the wrong ones are taken from there, and the test judges the whole as always.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import math
import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import pytest

from mutate.netlist import CONTROL
from sim import runner

OPTIONS = ["-x", "-q", "-p", "no:cacheprovider", "--no-header", "--tb=short", "-o", "addopts="]
CLOCK = Path(__file__).parent / "clock.v"
PLAYED = ("replay_bench", "gram_array_bench", "gram_ring_bench")
"""Benches that give a clock, and reset if there is one, until `done`; with FLIPS in the environment, more."""
WRITTEN = ("+results=", "+response=")
BUSY = 60.0
"""Seconds of the clock on the wall that one of the processor may take."""
DEAD = 120.0
"""Seconds that a process may need beyond its simulations' limit."""


@dataclass
class Outcome:
    """What tests said, until the first failure."""

    state: str = "none"
    """passed, failed, timeout (of the processor), busy (so is the machine), invalid (does not compile),
    none (no test ran)."""
    test: str = ""
    """The test that failed."""
    text: str = ""
    """Its last words."""
    seconds: float = 0.0
    """Of the processor."""
    durations: dict[str, float] = field(default_factory=dict)
    """Test that passed -> seconds of the processor."""
    reports: dict[str, list[str]] = field(default_factory=dict)
    """Test -> lines that a probe wrote meanwhile."""
    short: bool = False
    """Whether a simulation was ended at a wrong line."""


def processor() -> float:
    """Seconds of the processor that this process and those that it has waited for have taken."""
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(one.ru_utime + one.ru_stime for one in used)


class _Watch:
    """The pytest plugin that fills an Outcome."""

    def __init__(self, report: Path | None) -> None:
        self.outcome = Outcome()
        self.report = report
        self.start = 0.0
        self.test = ""
        self.simulations = 0
        self.late = False

    @pytest.hookimpl
    def pytest_runtest_logstart(self, nodeid: str) -> None:
        """Called before each test."""
        self.start, self.test, self.simulations = processor(), nodeid, 0

    @pytest.hookimpl
    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Called after setup, call and teardown of each test."""
        if report.failed and self.outcome.state != "failed":
            text = report.longreprtext
            self.outcome.state, self.outcome.test = "failed", report.nodeid
            if self.late:
                self.outcome.state = "timeout"
            elif "the simulation did not end in time" in text:
                self.outcome.state = "busy"
            elif "SimulationFailed: building " in text:
                self.outcome.state = "invalid"
            self.outcome.text = text[-4000:]
        elif report.when == "call" and report.passed:
            self.outcome.durations[report.nodeid] = round(processor() - self.start, 2)
            if self.outcome.state == "none":
                self.outcome.state = "passed"
            if self.report is not None and self.report.is_file():
                self.outcome.reports[report.nodeid] = self.report.read_text().splitlines()
                self.report.unlink()


def warm(tests: Sequence[str], log: Path) -> list[str]:
    """Import the tests once, for the processes to be forked; returns their ids."""
    found: list[str] = []

    class Collect:
        def pytest_collection_finish(self, session: pytest.Session) -> None:
            found.extend(item.nodeid for item in session.items)

    with _output(log):
        pytest.main(["--collect-only", *OPTIONS, *tests], plugins=[Collect()])
    return found


@contextlib.contextmanager
def _output(log: Path) -> Any:
    """Everything printed goes to a file, that of subprocesses too."""
    sys.stdout.flush()
    sys.stderr.flush()
    saved = os.dup(1), os.dup(2)
    with log.open("w") as out:
        os.dup2(out.fileno(), 1)
        os.dup2(out.fileno(), 2)
        try:
            yield
        finally:
            sys.stdout.flush()
            sys.stderr.flush()
            for number, file in enumerate(saved, 1):
                os.dup2(file, number)
                os.close(file)


class _Reader(threading.Thread):
    """Follows a file that a simulation writes, and ends the simulation once a line is not as it should be."""

    def __init__(self, file: Path, right: Path) -> None:
        super().__init__(daemon=True)
        self.file, self.right = file, right.read_bytes()
        self.stop = threading.Event()
        self.ended = False

    def run(self) -> None:
        """Look ten times a second."""
        seen = 0
        while not self.stop.wait(0.1):
            try:
                with self.file.open("rb") as file:
                    file.seek(seen)
                    fresh = file.read()
            except OSError:
                continue
            whole = fresh[: fresh.rfind(b"\n") + 1]
            if self.right[seen : seen + len(whole)] != whole:
                self.ended = True
                _end_leaves(os.getpid())
                return
            seen += len(whole)

    def complete(self) -> None:
        """Put the right lines after those that were written."""
        written = self.file.read_bytes()
        lines = written[: written.rfind(b"\n") + 1].splitlines(keepends=True)
        self.file.write_bytes(b"".join([*lines, *self.right.splitlines(keepends=True)[len(lines) :]]))


def _end_leaves(process: int) -> None:
    """Kill what a process has started; what waits for others is left to end by itself."""
    children = [
        int(child)
        for task in Path(f"/proc/{process}/task").glob("*/children")
        for child in task.read_text().split()
    ]
    for child in children:
        _end_leaves(child)
    if not children and process != os.getpid():
        with contextlib.suppress(ProcessLookupError):
            os.kill(process, signal.SIGKILL)


def _play(build: Any, plusargs: Sequence[str]) -> None:
    """A bench of PLAYED on Icarus without Python, whose start takes longer than many a simulation."""
    simulation = build.folder / "alone.vvp"
    stamp = build.folder / "stamp"
    if not simulation.is_file() or simulation.stat().st_mtime < stamp.stat().st_mtime:
        command = ["iverilog", "-g2005", "-o", f"{simulation}", "-s", build.top, "-s", "relnav_clock"]
        command += [f"-I{folder}" for folder in build.includes]
        command += [f"-P{build.top}.{name}={value}" for name, value in build.parameters.items()]
        command += [f"-D{name}={value}" for name, value in build.defines.items()]
        top = next(file for file in build.sources if file.stem == build.top)
        command += (
            ["-DRELNAV_RST"] if re.search(r"^ *input +wire +rst\b", top.read_text(), re.MULTILINE) else []
        )
        command += [f"-DRELNAV_TOP={build.top}", str(CLOCK), *map(str, build.sources)]
        subprocess.run(command, check=True)
    done = subprocess.run(["vvp", "-n", str(simulation), "-none", *plusargs], check=False)
    if done.returncode:
        raise runner.SimulationFailed(f"the simulation ended with {done.returncode}")


def _prepare(number: int, limit: float, watch: _Watch, right: Path | None) -> None:
    """Every simulation gets the plusarg that chooses the mutant, and `limit` seconds of the processor.

    right: folder of what simulations write without a mutation: filled without one, compared with one.
    """
    build: Any = runner._Build
    simulate = build.run

    def run(self: Any, folder: Path, bench: str, cases: Any, plusargs: Sequence[str], seed: int) -> Any:
        watch.simulations += 1
        alone = self.simulator == "icarus" and bench in PLAYED and "FLIPS" not in os.environ
        written = [Path(word.partition("=")[2]) for word in plusargs if word.startswith(WRITTEN)]
        digest = hashlib.sha256(f"{watch.test} {watch.simulations}".encode()).hexdigest()[:16]
        kept = right / digest if right is not None and written else None
        reader = None
        if kept is not None and number and kept.is_file():
            written[0].unlink(missing_ok=True)
            reader = _Reader(written[0], kept)
            reader.start()
        start, found = processor(), None
        os.environ["COCOTB_MAX_FAILURES"] = "1"  # the runner puts the environment back
        resource.setrlimit(resource.RLIMIT_CPU, (math.ceil(start + limit), resource.RLIM_INFINITY))
        try:
            if alone:
                _play(self, [*plusargs, f"+{CONTROL}={number}"])
            else:
                found = simulate(self, folder, bench, cases, [*plusargs, f"+{CONTROL}={number}"], seed)
        except AssertionError:
            if reader is None or not reader.ended:
                raise
        finally:
            resource.setrlimit(resource.RLIMIT_CPU, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
            watch.late = watch.late or processor() - start > limit
            if reader is not None:
                reader.stop.set()
                reader.join()
        if reader is not None and reader.ended:
            reader.complete()
            watch.outcome.short = True
        if kept is not None and not number:
            shutil.copyfile(written[0], kept)
        return found

    build.run = run
    defaults: Any = runner.build_and_test.__kwdefaults__
    defaults["timeout"] = BUSY * limit


def attempt(
    tests: Sequence[str],
    folder: Path,
    replaced: Mapping[str, Path],
    *,
    number: int = 0,
    limit: float = 900.0,
    whole: float | None = None,
    report: Path | None = None,
    right: Path | None = None,
    named: bool = False,
) -> Outcome:
    """Run tests (ids of pytest) with files in some modules' places, up to the first failure.

    folder: for the log, builds and temporary files. number: the mutant. limit: seconds of the processor
    for each simulation. whole: for all of them (default: limit). report: a file that a probe writes.
    right: folder of what simulations write, filled with number 0, compared with any other.
    named: the files have the registers of the modules in their places (tb/common/netlist.py).
    """
    folder.mkdir(parents=True, exist_ok=True)
    answer = folder / "outcome.json"
    answer.unlink(missing_ok=True)
    if report is not None:
        report.unlink(missing_ok=True)
    start = time.monotonic()
    child = os.fork()
    if child == 0:
        code = 1
        try:
            os.setpgid(0, 0)  # not a session: of its own it would lose the caller's low priority
            os.environ["RELNAV_REPLACE"] = " ".join(f"{module}={file}" for module, file in replaced.items())
            os.environ["RELNAV_BUILD"] = str(folder)
            if named:
                os.environ["RELNAV_NAMED"] = "1"
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            watch = _Watch(report)
            _prepare(number, limit, watch, right)
            with _output(folder / "pytest.log"):
                pytest.main([*OPTIONS, "--basetemp", str(folder / "tmp"), *tests], plugins=[watch])
            answer.write_text(json.dumps(asdict(watch.outcome)))
            code = 0
        finally:
            os._exit(code)
    done = 0
    while not done and time.monotonic() < start + BUSY * (whole or limit) + DEAD:
        done, _, used = os.wait4(child, os.WNOHANG)
        if not done:
            time.sleep(0.02)
    if not done:
        os.killpg(child, signal.SIGKILL)
        _, _, used = os.wait4(child, 0)
    seconds = used.ru_utime + used.ru_stime
    if not done:
        return Outcome("busy", seconds=seconds)
    if not answer.is_file():
        text = (folder / "pytest.log").read_text(errors="replace")[-4000:]
        return Outcome("invalid", text=text, seconds=seconds)
    outcome = Outcome(**json.loads(answer.read_text()))
    outcome.seconds = seconds
    return outcome


def relative(test: str) -> str:
    """A test's id without its folder, for tables."""
    return test.rpartition("/")[2] if test else ""
