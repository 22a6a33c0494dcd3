# SPDX-License-Identifier: Apache-2.0
"""ivisnav_top through its ports: frames of every kind without a reset between, bit for bit the model's."""

from __future__ import annotations

import os
from typing import Any

import cocotb
from relnav.driver import Feed

from tb.common import axil, core_tests
from tb.ivisnav.environment import Bench
from tb.ivisnav.frames import VARIANCES, random_rows

FRAMES = int(os.environ.get("FRAMES", "40"))


@cocotb.test()
async def frames_on_every_channel(dut: Any) -> None:
    """Random frames, by stream and by registers, with pauses everywhere; the bus keeps its rules."""
    bench = await Bench(dut, 1).begin()
    axil.Monitor(dut)
    cycles: set[tuple[int | None, ...]] = set()
    for number in range(FRAMES):
        if number % 8 == 0:
            bench.pauses()
        feed: Feed = "registers" if number % 4 == 1 else "stream"
        got = await bench.solve(random_rows(bench.rng), feed, bench.rng.choice(VARIANCES))
        if not got.failed:
            cycles.add((got.cycles_rates, got.cycles_all))
    dut._log.info("cycles %s", cycles)
    assert len(cycles) == 1, f"the latency depends on the frame: {cycles}"


@cocotb.test()
async def one_frame_of_a_thousand(dut: Any) -> None:
    """n = 1000 at the full rate, a row in 8 clocks, then 6 again."""
    bench = await Bench(dut, 2).begin()
    for n in (1000, 6):
        await bench.solve(bench.good(n))
        assert bench.rises["frame_end"] - bench.rises["frame_start"] <= 8 * n


@cocotb.test()
async def reading_does_not_disturb(dut: Any) -> None:
    await core_tests.reading_does_not_disturb(await Bench(dut, 6).begin())


@cocotb.test()
async def queued_frames(dut: Any) -> None:
    await core_tests.queued_frames(await Bench(dut, 7).begin())
