# SPDX-License-Identifier: Apache-2.0
"""Tests in a process of their own, on a stand-in for one module, with a limit of time."""

from __future__ import annotations

import contextlib
import json
import os
import signal
import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

import pytest

from mutate.netlist import CONTROL
from sim import runner

OPTIONS = ["-x", "-q", "-p", "no:cacheprovider", "--no-header", "--tb=short", "-o", "addopts="]
DEAD = 30.0
"""Seconds that a process may need beyond its simulations' limit."""


@dataclass
class Outcome:
    """What tests said, until the first failure."""

    state: str = "none"
    """passed, failed, timeout, invalid (does not compile), none (no test ran)."""
    test: str = ""
    """The test that failed."""
    text: str = ""
    """Its last words."""
    seconds: float = 0.0
    durations: dict[str, float] = field(default_factory=dict)
    """Test that passed -> seconds."""
    reports: dict[str, list[str]] = field(default_factory=dict)
    """Test -> lines that a probe wrote meanwhile."""


class _Watch:
    """The pytest plugin that fills an Outcome."""

    def __init__(self, report: Path | None) -> None:
        self.outcome = Outcome()
        self.report = report

    @pytest.hookimpl
    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Called after setup, call and teardown of each test."""
        if report.failed and self.outcome.state != "failed":
            text = report.longreprtext
            self.outcome.state, self.outcome.test = "failed", report.nodeid
            if "the simulation did not end in time" in text:
                self.outcome.state = "timeout"
            elif "SimulationFailed: building " in text:
                self.outcome.state = "invalid"
            self.outcome.text = text[-4000:]
        elif report.when == "call" and report.passed:
            self.outcome.durations[report.nodeid] = report.duration
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


def _prepare(number: int, limit: float) -> None:
    """Every simulation gets the plusarg that chooses the mutant, and `limit` seconds."""
    build: Any = runner._Build
    simulate = build.run

    def run(self: Any, folder: Path, bench: str, cases: Any, plusargs: Sequence[str], seed: int) -> Any:
        return simulate(self, folder, bench, cases, [*plusargs, f"+{CONTROL}={number}"], seed)

    build.run = run
    defaults: Any = runner.build_and_test.__kwdefaults__
    defaults["timeout"] = limit


def attempt(
    tests: Sequence[str],
    folder: Path,
    replaced: Mapping[str, Path],
    *,
    number: int = 0,
    limit: float = 900.0,
    whole: float | None = None,
    report: Path | None = None,
    builds: Path | None = None,
) -> Outcome:
    """Run tests (ids of pytest) with files in some modules' places, up to the first failure.

    folder: for the log and temporary files. number: the mutant. limit: seconds for each simulation.
    whole: seconds for all of them (default: limit). report: a file that a probe writes. builds: RELNAV_BUILD.
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
            os.setsid()
            os.environ["RELNAV_REPLACE"] = " ".join(f"{module}={file}" for module, file in replaced.items())
            os.environ["RELNAV_BUILD"] = str(builds or folder)
            _prepare(number, limit)
            watch = _Watch(report)
            with _output(folder / "pytest.log"):
                pytest.main([*OPTIONS, "--basetemp", str(folder / "tmp"), *tests], plugins=[watch])
            answer.write_text(json.dumps(asdict(watch.outcome)))
            code = 0
        finally:
            os._exit(code)
    done = 0
    while not done and time.monotonic() < start + (whole or limit) + DEAD:
        done, _ = os.waitpid(child, os.WNOHANG)
        if not done:
            time.sleep(0.02)
    seconds = time.monotonic() - start
    if not done:
        os.killpg(child, signal.SIGKILL)
        os.waitpid(child, 0)
        return Outcome("timeout", seconds=seconds)
    if not answer.is_file():
        text = (folder / "pytest.log").read_text(errors="replace")[-4000:]
        return Outcome("invalid", text=text, seconds=seconds)
    outcome = Outcome(**json.loads(answer.read_text()))
    outcome.seconds = seconds
    return outcome


def relative(test: str) -> str:
    """A test's id without its folder, for tables."""
    return test.rpartition("/")[2] if test else ""
