# SPDX-License-Identifier: Apache-2.0
"""oltae_top through its ports: every flag is raised by what it stands for, is cleared, and harms nothing."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import cocotb
import numpy as np
from cocotb.triggers import FallingEdge
from relnav.driver import OltaeDriver, beats_of
from relnav.model.raw import CoreConfig
from relnav.quantise import QuantisedFrame
from relnav.registers import Oltae

from tb.common import clocks
from tb.oltae.environment import FULL, Bench, State, configured, good, reached


@cocotb.test()
async def every_flag(dut: Any) -> None:
    """Each error is raised alone, leaves the results, is cleared, and the next frame is as good as any."""
    bench = await Bench(dut, 3).begin()
    rng = bench.rng
    await bench.drive(OltaeDriver.identify)
    await bench.drive(lambda d: d.enable_interrupts(error=True))
    await bench.solve(good(rng))
    line = np.outer(np.arange(5), [3, -1, 2]).astype(np.int64)
    spot = np.full((4, 3), 7, dtype=np.int64)
    cloud = np.array([[9, 2, -3], [-4, 8, 1], [5, -6, 7], [1, 1, -9]], dtype=np.int64) << 24
    turned = cloud @ np.diag([-1, -1, 1])  # by 180 degrees about z
    nearly = turned + np.eye(4, 3, dtype=np.int64)
    thin = cloud >> [0, 11, 11]
    plain = CoreConfig(covariance=FULL)
    forbid = replace(plain, forbid_turns=True)
    cases: list[tuple[str, QuantisedFrame, CoreConfig]] = [
        ("FEW_POINTS", QuantisedFrame(cloud[:1], cloud[:1], None, 0), plain),
        ("FEW_POINTS", QuantisedFrame(cloud[:2], cloud[:2], None, 0), plain),
        ("RANK_DEFICIENT", QuantisedFrame(line, line + 5, None, 3), plain),
        ("RANK_DEFICIENT", QuantisedFrame(spot, spot, None, 3), plain),
        ("RANK_DEFICIENT", QuantisedFrame(cloud, turned, None, 20), forbid),
        ("Q_SATURATED", QuantisedFrame(cloud, turned, None, 20), plain),
        ("Q_SATURATED", QuantisedFrame(cloud, nearly, None, 20), plain),
        ("ILL_CONDITIONED", QuantisedFrame(thin, thin, None, 20), plain),
    ]
    if FULL:
        zero = np.zeros(4, dtype=np.int64)
        cases.append(("ZERO_WEIGHT", QuantisedFrame(cloud, cloud, zero, 20), plain))
        one = np.array([0, 5, 0, 0], dtype=np.int64)
        cases.append(("RANK_DEFICIENT", QuantisedFrame(cloud, cloud, one, 20), plain))
    for name, frame, config in cases:
        got = await bench.solve(frame, config)
        assert name in got.flag_names, (name, got.flag_names)
        await raised_and_cleared(bench, set(got.flag_names))

    for beats, name in (
        (beats_of(good(rng))[:-1], "BAD_TLAST"),
        (beats_of(good(rng))[:-2], "BAD_TLAST"),
        (beats_of(good(rng))[:1], "BAD_TLAST"),
    ):
        ticket = await bench.drive(lambda d, b=beats: configured(d).feed(b))
        assert not await bench.drive(lambda d, t=ticket: d.wait(t, 200))
        await raised_and_cleared(bench, {name})

    # TOO_LONG: the counter is set as if 65533 points had come; swallowed to the end
    bench.bus.source.pause = True
    beats = beats_of(good(rng, 6))
    ticket = await bench.drive(lambda d: configured(d).feed(beats))
    await reached(bench, 3)
    dut.loader.count.value = 65533
    bench.bus.source.pause = False
    assert not await bench.drive(lambda d: d.wait(ticket, 200))
    await raised_and_cleared(bench, {"TOO_LONG"})

    # WATCHDOG: as if 2040 clocks had gone by
    ticket = await bench.drive(lambda d: configured(d).feed(beats_of(good(rng))))
    while bench.state() != State.COMPUTE:
        await FallingEdge(dut.clk)
    dut.core.cycles.value = 2040
    assert not await bench.drive(lambda d: d.wait(ticket, 200))
    await raised_and_cleared(bench, {"WATCHDOG"})

    await busy_writes(bench)
    await not_built(bench)


async def raised_and_cleared(bench: Bench, names: set[str]) -> None:
    """Exactly these flags are up, irq too; after clearing, none; the results stand; the next frame works."""
    sticky, frame = await bench.flags()
    assert sticky == frame == names
    if names.isdisjoint({"Q_SATURATED", "ILL_CONDITIONED", "BUSY_WRITE"}):
        assert bench.state() == State.IDLE
        await bench.unchanged()
    assert bench.dut.irq.value == 1
    assert (await bench.drive(OltaeDriver.clear_interrupts))[1]
    await clocks.tick(bench.dut, 2)
    assert bench.dut.irq.value == 0
    await bench.drive(OltaeDriver.clear_flags)
    assert await bench.flags() == (set(), names)  # FRAME_FLAGS stay until the next frame
    await bench.solve(good(bench.rng))
    assert await bench.flags() == (set(), set())


async def busy_writes(bench: Bench) -> None:
    """CONFIG, FRAC, VARIANCE of a busy core and a push beside an open stream frame are ignored."""
    frame = good(bench.rng)
    expected = bench.model.run(frame, CoreConfig(covariance=FULL))
    for register in (Oltae.CONFIG, Oltae.FRAC, Oltae.VARIANCE, Oltae.PUSH):
        beats = beats_of(frame)
        await bench.drive(lambda d, f=frame.frac: configured(d, f))
        before = await bench.drive(lambda d, r=register: d.read(r))
        bench.bus.source.pause = True
        ticket = await bench.drive(lambda d, b=beats: d.feed(b))
        await reached(bench, 2)
        await bench.drive(lambda d, r=register: d.write(r, 0x5))
        bench.bus.source.pause = False
        assert await bench.drive(lambda d, t=ticket: d.wait(t, 200))
        assert await bench.drive(lambda d, r=register: d.read(r)) == before
        got = await bench.standing()
        assert got.result_words() == expected.result_words() and got.flag_names == ("BUSY_WRITE",)
        bench.last = got
        await raised_and_cleared(bench, {"BUSY_WRITE"})


async def not_built(bench: Bench) -> None:
    """What this build has not is named by the write and by every frame run so; the full build has it all."""
    wish = Oltae.CONFIG.encode(WEIGHTED=1, REAPPLY=1, COVARIANCE=1)
    await bench.drive(lambda d: d.write(Oltae.CONFIG, wish))
    kept = await bench.drive(lambda d: d.read(Oltae.CONFIG))
    assert kept == (wish if FULL else 0)
    assert (await bench.flags())[0] == (set() if FULL else {"NOT_BUILT"})
    await bench.drive(OltaeDriver.clear_flags)
    await bench.drive(OltaeDriver.clear_interrupts)
    if not FULL:
        frame = good(bench.rng)
        got = await bench.drive(lambda d: d.solve(frame, CoreConfig(covariance=True), polls=200))
        expected = bench.model.run(frame, CoreConfig(covariance=False))
        assert got.flag_names == ("NOT_BUILT",) and got.result_words() == expected.result_words()
        bench.last = got
    await bench.drive(configured)
    await bench.drive(OltaeDriver.clear_flags)
    await bench.solve(good(bench.rng))
    assert await bench.flags() == (set(), set())
