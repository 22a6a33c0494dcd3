# SPDX-License-Identifier: Apache-2.0
"""oltae_top through its ports: frames of every kind without a reset between, bit for bit the model's."""

from __future__ import annotations

import os
from dataclasses import replace
from typing import Any

import cocotb
import numpy as np
from relnav.attitude import TURN_SIGNS
from relnav.driver import Feed
from relnav.model.raw import CoreConfig
from relnav.quantise import QuantisedFrame

from tb.common import axil, core_tests
from tb.oltae.environment import FULL, Bench
from tb.oltae.frames import random_config, random_frame

FRAMES = int(os.environ.get("FRAMES", "40"))


@cocotb.test()
async def frames_on_every_channel(dut: Any) -> None:
    """Random frames, by stream and by registers, with pauses everywhere; the bus keeps its rules."""
    bench = await Bench(dut, 1).begin()
    axil.Monitor(dut)
    cycles: dict[tuple[bool, ...], set[tuple[int | None, ...]]] = {}
    for number in range(FRAMES):
        if number % 8 == 0:
            bench.pauses()
        frame = random_frame(bench.rng, weights=None if FULL else False)
        config = random_config(bench.rng, FULL)
        feed: Feed = "registers" if number % 4 == 1 else "stream"
        got = await bench.solve(frame, feed, config)
        if not got.failed:
            mode = (frame.w is not None, config.reapply, config.covariance)
            cycles.setdefault(mode, set()).add((got.cycles_q, got.cycles_pose, got.cycles_all))
    dut._log.info("cycles %s", cycles)
    assert all(len(found) == 1 for found in cycles.values()), "the latency depends on the frame"


@cocotb.test()
async def every_turn(dut: Any) -> None:
    """A cloud turned by nearly 180 degrees about nothing, x, y, z; weighted too; and with turns forbidden."""
    bench = await Bench(dut, 8).begin()
    cloud = np.array([[9, 2, -3], [-4, 8, 1], [5, -6, 7], [1, 1, -9]], dtype=np.int64) << 20
    for turn, signs in enumerate(TURN_SIGNS):
        frame = QuantisedFrame(
            cloud, cloud @ np.diag(signs).astype(np.int64) + cloud[:, [1, 2, 0]] // 9, None, 16
        )
        assert (await bench.solve(frame)).turn == turn
        if FULL:
            assert (await bench.solve(replace(frame, w=np.array([1, 2, 3, 5])))).turn == turn
        forbidden = await bench.solve(frame, config=CoreConfig(forbid_turns=True, covariance=FULL))
        assert forbidden.turn == 0


@cocotb.test()
async def one_frame_of_a_thousand(dut: Any) -> None:
    """n = 1000 at the full rate, then 3 again."""
    bench = await Bench(dut, 2).begin()
    for n, weights in ((1000, False), (3, FULL), (1000 if FULL else 3, FULL), (4, False)):
        await bench.solve(random_frame(bench.rng, n, weights, "pose"))
        loading = bench.rises["frame_end"] - bench.rises["frame_start"]
        assert loading <= 6 * n if weights else loading == 3 * n


@cocotb.test()
async def reading_does_not_disturb(dut: Any) -> None:
    await core_tests.reading_does_not_disturb(await Bench(dut, 6).begin())


@cocotb.test()
async def queued_frames(dut: Any) -> None:
    await core_tests.queued_frames(await Bench(dut, 7).begin())
