# SPDX-License-Identifier: Apache-2.0
"""Runs inside the simulator: the driver, in a thread, on core_harness."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import cocotb
from cocotb.clock import Clock
from cocotb.task import bridge
from cocotb.triggers import ClockCycles, FallingEdge

from relnav.errors import BackendError

from . import job
from .bus import PERIOD_NS, HarnessBus
from .cores import CORES

POLLS = 200  # each takes at least 40 clocks, a frame that is fed at most 2048: then the watchdog barks


@cocotb.test()
async def run_job(dut: Any) -> None:
    """The frames of the job, back to back; results or the reason for none go to the job's folder."""
    folder = Path(os.environ["RELNAV_JOB"])
    given = job.read(folder / job.JOB)
    core = CORES[given.core]
    dut.go.value = 0
    dut.gap.value = 0
    dut.rst.value = 1
    bus = HarnessBus(dut)
    Clock(dut.clk, PERIOD_NS, "ns").start()
    await ClockCycles(dut.clk, 4)
    await FallingEdge(dut.clk)
    dut.rst.value = 0

    @bridge
    def drive() -> list[Any]:
        driver: Any = core.driver(bus, bus.idle)
        driver.identify()
        options = core.options(given.options)
        return [driver.solve(frame, **options, feed=given.feed, polls=POLLS) for frame in given.frames]

    try:
        job.write_results(folder / job.RESULTS, await drive())
    except Exception as error:
        reason = str(error) if isinstance(error, BackendError) else f"{type(error).__name__}: {error}"
        job.write_failure(folder / job.RESULTS, reason)
        raise
