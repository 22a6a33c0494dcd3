# SPDX-License-Identifier: Apache-2.0
"""oltae_top through its ports: the state machine, the interrupt, and a soft reset in every state."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any

import cocotb
from cocotb.triggers import FallingEdge, RisingEdge
from relnav.driver import OltaeDriver, beats_of
from relnav.model.raw import CoreConfig, RawResult
from relnav.quantise import QuantisedFrame
from relnav.registers import Oltae

from tb.common import clocks
from tb.oltae.environment import FULL, Bench, State, configured, good, reached

STEP = int(os.environ.get("STEP", "7"))  # clocks of COMPUTE between two resets


@cocotb.test()
async def states_acknowledge_and_interrupt(dut: Any) -> None:
    """IDLE, LOAD, COMPUTE, DONE in order; DONE holds until acknowledged or the next frame; irq as enabled."""
    bench = await Bench(dut, 4).begin()
    order: list[State] = []

    async def watch() -> None:
        while True:
            await RisingEdge(dut.clk)
            if dut.state.value.is_resolvable and (not order or order[-1] != bench.state()):
                order.append(bench.state())

    watcher = cocotb.start_soon(watch())
    await bench.drive(lambda d: d.enable_interrupts(done=True))
    assert bench.state() == State.IDLE and dut.irq.value == 0
    frame = good(bench.rng)
    await bench.solve(frame)
    assert bench.state() == State.DONE and dut.irq.value == 1
    status = await bench.drive(OltaeDriver.status)
    assert status.state == State.DONE and status.all_ready and not status.busy and status.frame == 1
    assert await bench.drive(OltaeDriver.clear_interrupts) == (True, False)
    await clocks.tick(dut, 200)
    assert bench.state() == State.DONE and dut.irq.value == 0
    await bench.drive(OltaeDriver.acknowledge)
    await clocks.tick(dut, 4)
    assert bench.state() == State.IDLE
    status = await bench.drive(OltaeDriver.status)
    assert status.q_ready and status.pose_ready and status.all_ready  # of the last frame started
    await bench.unchanged()
    await bench.solve(good(bench.rng))
    await bench.drive(lambda d: d.enable_interrupts())
    await clocks.tick(dut, 2)
    assert dut.irq.value == 0
    await bench.solve(good(bench.rng))  # straight from DONE
    watcher.cancel()
    round_trip = [State.LOAD, State.COMPUTE, State.DONE]
    assert order == [State.IDLE, *round_trip, State.IDLE, *round_trip, *round_trip]


@cocotb.test()
async def soft_reset_in_every_state(dut: Any) -> None:
    """IDLE, LOAD after every beat, COMPUTE every few clocks, DONE: then IDLE, and the next frame is right."""
    bench = await Bench(dut, 5).begin()
    caught: set[State] = set()

    async def reset() -> None:
        caught.add(bench.state())
        await bench.drive(OltaeDriver.soft_reset)
        await clocks.tick(dut, 4)
        assert bench.state() == State.IDLE

    await reset()
    await bench.solve(good(bench.rng))
    await reset()
    await bench.unchanged()

    # LOAD: what was pushed is forgotten
    for weights in (False, True) if FULL else (False,):
        frame = good(bench.rng, 3, weights)
        await bench.drive(lambda d, w=weights: d.configure(CoreConfig(covariance=FULL), frac=0, weighted=w))
        beats = beats_of(frame)
        for count in range(1, len(beats)):
            await bench.drive(lambda d, part=beats[:count]: push(d, part))
            await reset()
            if count % 3 == 0:
                await bench.unchanged()
                await bench.solve(good(bench.rng, 3, weights), feed="registers" if count % 2 else "stream")
    # LOAD by stream: the rest of the frame counts as a new one
    for count in range(1, 9, 2):
        frame = good(bench.rng, 5)
        bench.bus.source.pause = True
        await bench.drive(lambda d, f=frame: configured(d, f.frac).feed(beats_of(f)))
        taken = await reached(bench, count)
        await reset()
        await bench.drive(OltaeDriver.clear_flags)
        rest = len(beats_of(frame)) - taken
        bench.bus.source.pause = False
        await clocks.tick(dut, 3 * rest + 20)
        if rest % 3:
            assert (await bench.flags())[0] == {"BAD_TLAST"}
        elif rest < 9:
            assert (await bench.flags())[0] == {"FEW_POINTS"}
        else:
            while bench.state() == State.COMPUTE:
                await clocks.tick(dut)
            left = QuantisedFrame(frame.a[-rest // 3 :], frame.b[-rest // 3 :], None, frame.frac)
            got = await bench.standing()
            expected = bench.model.run(left, CoreConfig(covariance=FULL))
            if not expected.failed:
                assert got.result_words() == expected.result_words()
                bench.last = got
        await bench.solve(good(bench.rng))

    # COMPUTE, to a few clocks past its end
    for number, delay in enumerate(range(0, (bench.last.cycles_all or 0) + 2 * STEP, STEP)):
        weights = FULL and number % 2 == 1
        frame = good(bench.rng, 3, weights)
        await bench.drive(
            lambda d, f=frame: d.configure(CoreConfig(covariance=FULL), frac=f.frac, weighted=f.w is not None)
        )
        await bench.drive(lambda d, f=frame: d.feed(beats_of(f)))
        while bench.state() != State.COMPUTE:
            await FallingEdge(dut.clk)
        await clocks.tick(dut, delay)
        await reset()
        if number % 4 == 0:
            await whole_groups(bench, bench.model.run(frame, CoreConfig(covariance=FULL)))
        await bench.solve(good(bench.rng, 3, FULL and number % 3 == 0))
    assert caught == set(State)


def push(driver: OltaeDriver, beats: Sequence[int]) -> None:
    """Beats without a last one."""
    for beat in beats:
        driver.write(Oltae.DATA_A, beat & 0xFFFFFFFF)
        driver.write(Oltae.DATA_B, beat >> 32)
        driver.write(Oltae.PUSH, 0)


async def whole_groups(bench: Bench, new: RawResult) -> None:
    """After a reset amid the results: each group is the old frame's, or the new one's where its bit is up."""
    status = await bench.drive(OltaeDriver.status)
    now, old = (await bench.standing()).result_words(), bench.last.result_words()
    fresh = new.result_words()
    assert now[:3] == (fresh if status.q_ready else old)[:3]
    assert now[6:18] == (fresh if status.pose_ready else old)[6:18]
    assert now[18:] == (fresh if status.all_ready else old)[18:]
