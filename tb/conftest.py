# SPDX-License-Identifier: Apache-2.0
"""Fixtures of every testbench, and the line that says which simulators ran."""

from __future__ import annotations

from collections import Counter

import pytest

from sim.runner import SIMULATORS, missing, simulator_version


@pytest.fixture(params=SIMULATORS)
def simulator(request: pytest.FixtureRequest) -> str:
    """Each simulator in turn; skipped, with the reason, where it is not installed."""
    name = str(request.param)
    reason = missing(name)
    if reason:
        pytest.skip(reason)
    return name


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Say which simulators ran, on how many cases, and why one did not."""
    ran: Counter[str] = Counter()
    for outcome in ("passed", "failed", "error"):
        for report in terminalreporter.getreports(outcome):
            words = getattr(report, "nodeid", "").partition("[")[2].rstrip("]").split("-")
            ran.update(name for name in SIMULATORS if name in words)
    terminalreporter.section("simulators")
    for name in SIMULATORS:
        reason = missing(name)
        state = f"NOT RUN: {reason}" if reason else f"{ran[name]} cases on {simulator_version(name)}"
        terminalreporter.write_line(f"{name:<10} {state}")
