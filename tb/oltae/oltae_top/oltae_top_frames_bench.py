# SPDX-License-Identifier: Apache-2.0
"""oltae_top through its ports: frames of every kind without a reset between, bit for bit the model's."""

from __future__ import annotations

import os
from dataclasses import replace
from typing import Any

import cocotb
import numpy as np
from relnav.attitude import TURN_SIGNS
from relnav.driver import Feed, OltaeDriver, beats_of
from relnav.model.raw import RESULT_WORDS, CoreConfig
from relnav.quantise import QuantisedFrame
from relnav.registers import Oltae

from tb.common import axil, clocks
from tb.oltae.environment import FULL, Bench, configured, good
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
        got = await bench.solve(frame, config, feed)
        if not got.failed:
            mode = (frame.w is not None, config.reapply, config.covariance)
            cycles.setdefault(mode, set()).add((got.cycles_q, got.cycles_pose, got.cycles_all))
    dut._log.info("cycles %s", cycles)
    assert all(len(found) == 1 for found in cycles.values()), "the latency depends on the frame"


@cocotb.test()
async def every_turn(dut: Any) -> None:
    """A cloud turned by nearly 180 degrees about nothing, x, y, z; and with turns forbidden."""
    bench = await Bench(dut, 8).begin()
    cloud = np.array([[9, 2, -3], [-4, 8, 1], [5, -6, 7], [1, 1, -9]], dtype=np.int64) << 20
    for turn, signs in enumerate(TURN_SIGNS):
        frame = QuantisedFrame(
            cloud, cloud @ np.diag(signs).astype(np.int64) + cloud[:, [1, 2, 0]] // 9, None, 16
        )
        assert (await bench.solve(frame)).turn == turn
        forbidden = await bench.solve(frame, CoreConfig(forbid_turns=True, covariance=FULL))
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
    """Reads at any address while frames come and go; a result word is the old one or the new one."""
    bench = await Bench(dut, 6).begin()
    rng = bench.rng
    results = range(Oltae.Q.ADDRESS, Oltae.Q.ADDRESS + 4 * RESULT_WORDS, 4)
    others = [
        r.ADDRESS for r in (Oltae.STATUS, Oltae.POINTS, Oltae.WEIGHT, Oltae.TURN, Oltae.CYCLES_Q, Oltae.FLAGS)
    ]
    allowed = [{word} for word in bench.last.result_words()]
    reads = 0

    async def storm() -> None:
        nonlocal reads
        while True:
            if rng.random() < 0.8:
                word, _ = await axil.read(bench.bus.axil, rng.choice(results))
                del word
            else:
                await axil.read(bench.bus.axil, rng.choice([*others, rng.randrange(0, 0x1000, 4)]))
            reads += 1

    async def checked() -> None:
        nonlocal reads
        while True:
            index = rng.randrange(RESULT_WORDS)
            word, response = await axil.read(bench.bus.axil, results[index])
            assert response == axil.OKAY and word in allowed[index], f"word {index} is {word:#x}"
            reads += 1

    stormy = [cocotb.start_soon(storm()), cocotb.start_soon(checked())]
    for number in range(6):
        frame = good(rng, 4, FULL and number % 2 == 1)
        for index, word in enumerate(bench.model.run(frame, CoreConfig(covariance=FULL)).result_words()):
            allowed[index].add(word)
        before = reads
        await bench.solve(frame)
        assert reads - before > 20
        for index, word in enumerate(bench.last.result_words()):
            allowed[index] = {word}
    for task in stormy:
        task.cancel()


@cocotb.test()
async def queued_frames(dut: Any) -> None:
    """Frames that wait at the stream while the core computes; one is bad, the others are not touched."""
    bench = await Bench(dut, 7).begin()
    frames = [good(bench.rng, n) for n in (3, 5, 4)]
    frames = [replace(frame, frac=-9) for frame in frames]
    short = beats_of(frames[0])[:6]
    ticket = await bench.drive(lambda d: configured(d, -9).feed(beats_of(frames[0])))
    for beats in (beats_of(frames[1]), short, beats_of(frames[2])):
        await bench.drive(lambda d, b=beats: d.bus.stream(b))
    while (await bench.drive(OltaeDriver.status)).frame != ticket + len(frames):
        await clocks.tick(dut)
    got = await bench.standing()
    assert got.result_words() == bench.model.run(frames[-1], CoreConfig(covariance=FULL)).result_words()
    assert (got.points, got.flag_names) == (4, ())
    assert await bench.flags() == ({"FEW_POINTS"}, set())
