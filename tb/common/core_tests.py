# SPDX-License-Identifier: Apache-2.0
"""What every core's top has to pass, whatever it computes; called by the cocotb tests of each."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import cocotb
from cocotb.triggers import FallingEdge, RisingEdge

from coverage import points
from tb.common import axil, clocks
from tb.common.core_bench import CoreBench

LOADING, COMPUTE, DONE, VERIFY = 1, 2, 3, 4


# ------------------------------------------------------------------------------------------------ states


async def states_acknowledge_and_interrupt(bench: CoreBench) -> None:
    """The states in order; DONE holds until acknowledged or the next frame; irq as enabled."""
    dut, driver = bench.dut, bench.DRIVER
    order: list[int] = []

    async def watch() -> None:
        while True:
            await RisingEdge(dut.clk)
            if dut.state.value.is_resolvable and (not order or order[-1] != int(dut.state.value)):
                order.append(int(dut.state.value))

    watcher = cocotb.start_soon(watch())
    await bench.drive(lambda d: d.enable_interrupts(done=True))
    assert bench.state() == 0 and dut.irq.value == 0
    await bench.solve(bench.good())
    assert bench.state() == DONE and dut.irq.value == 1
    status = await bench.drive(driver.status)
    assert status.state == DONE and status.all_ready and not status.busy and status.frame == 1
    assert await bench.drive(driver.clear_interrupts) == (True, False)
    await clocks.tick(dut, 200)
    assert bench.state() == DONE and dut.irq.value == 0
    await bench.drive(driver.acknowledge)
    await clocks.tick(dut, 4)
    assert bench.state() == 0
    status = await bench.drive(driver.status)
    assert all(getattr(status, f"{group}_ready") for group in bench.GROUPS)  # of the last frame started
    await bench.unchanged()
    await bench.solve(bench.good())
    await bench.drive(lambda d: d.enable_interrupts())
    await clocks.tick(dut, 2)
    assert dut.irq.value == 0
    await bench.solve(bench.good())  # straight from DONE
    watcher.cancel()
    round_trip = [LOADING, COMPUTE, *([VERIFY] if await verifies(bench) else []), DONE]
    assert order == [0, *round_trip, 0, *round_trip, *round_trip]


async def soft_reset_in_every_state(bench: CoreBench, step: int) -> None:
    """In IDLE, after every beat, every `step` clocks of COMPUTE, now and then in VERIFY, in DONE."""
    dut, kinds = bench.dut, bench.KINDS
    caught: set[int] = set()

    async def reset() -> None:
        caught.add(int(dut.state.value))
        await bench.drive(bench.DRIVER.soft_reset)
        await clocks.tick(dut, 4)
        assert bench.state() == 0

    await reset()
    await bench.solve(bench.good())
    await reset()
    await bench.unchanged()

    # loading: what was pushed is forgotten
    for kind in kinds:
        frame = bench.good(bench.LEAST, **kind)
        await bench.drive(lambda d, f=frame: bench.prepare(d, f))
        beats = bench.beats(frame)
        for count in range(1, len(beats)):
            await bench.drive(lambda d, part=beats[:count]: push(d, part))
            await reset()
            if count % 3 == 0:
                await bench.unchanged()
                await bench.solve(bench.good(bench.LEAST, **kind), "registers" if count % 2 else "stream")
                await bench.drive(lambda d, f=frame: bench.prepare(d, f))
    # loading by stream: the rest of the frame counts as a new one
    per_row = bench.BEATS
    for count in range(1, 3 * per_row, 2):
        frame = bench.good(bench.LEAST + 2)
        bench.bus.source.pause = True
        await bench.drive(lambda d, f=frame: bench.prepare(d, f).feed(bench.beats(f)))
        taken = await bench.reached(count)
        await reset()
        await bench.drive(bench.DRIVER.clear_flags)
        rest = len(bench.beats(frame)) - taken
        bench.bus.source.pause = False
        await clocks.tick(dut, 4 * rest + 20)
        if rest % per_row:
            assert (await bench.flags())[0] == {"BAD_TLAST"}
        elif rest < bench.LEAST * per_row:
            assert (await bench.flags())[0] == {bench.FEW}
        else:
            while bench.state() in (COMPUTE, VERIFY):
                await clocks.tick(dut)
            expected = bench.expected(bench.tail(frame, rest // per_row))
            if not expected.failed:
                got = await bench.standing()
                assert bench.words(got) == bench.words(expected)
                bench.last = got
        await bench.solve(bench.good())

    # COMPUTE, to a few clocks past its end, and VERIFY
    pass_ends = (bench.last.cycles_all or 0) + 2 * step
    again = await verifies(bench)
    delays = (*range(0, pass_ends, step), *(range(pass_ends, 2 * pass_ends, 5 * step) if again else ()))
    for number, delay in enumerate(delays):
        frame = bench.good(bench.LEAST, **kinds[number % len(kinds)])
        await bench.drive(lambda d, f=frame: bench.prepare(d, f).feed(bench.beats(f)))
        while bench.state() != COMPUTE:
            await FallingEdge(dut.clk)
        await clocks.tick(dut, delay)
        await reset()
        if number % 4 == 0:
            await whole_groups(bench, bench.expected(frame))
        await bench.solve(bench.good(bench.LEAST, **kinds[number // 2 % len(kinds)]))
    assert caught == {0, LOADING, COMPUTE, DONE, *([VERIFY] if again else [])}


async def verifies(bench: CoreBench) -> bool:
    """This build has the second pass."""
    build = bench.registers.BUILD
    return bool(build.VERIFY.get(await bench.drive(lambda d: d.read(build))))


def push(driver: Any, beats: Sequence[int]) -> None:
    """Beats without a last one."""
    for beat in beats:
        driver.push(beat)


async def whole_groups(bench: CoreBench, new: Any) -> None:
    """After a reset amid the results: each group is the old frame's, or the new one's where its bit is up."""
    status = await bench.drive(bench.DRIVER.status)
    now, old, fresh = (bench.words(raw) for raw in (await bench.standing(), bench.last, new))
    for group, span in bench.GROUPS.items():
        wanted = fresh if getattr(status, f"{group}_ready") else old
        assert [now[index] for index in span] == [wanted[index] for index in span], group


# ------------------------------------------------------------------------------------------------ frames


async def reading_does_not_disturb(bench: CoreBench) -> None:
    """Reads at any address while frames come and go; a result word is the old one or the new one."""
    rng, registers = bench.rng, bench.registers
    count = len(bench.words(bench.last))
    results = range(0x100, 0x100 + 4 * count, 4)
    others = [r.ADDRESS for r in (registers.STATUS, registers.WEIGHT, registers.CYCLES_ALL, registers.FLAGS)]
    allowed = [{word} for word in bench.words(bench.last)]
    reads = 0

    async def storm() -> None:
        nonlocal reads
        while True:
            if rng.random() < 0.8:
                await axil.read(bench.bus.axil, rng.choice(results))
            else:
                await axil.read(bench.bus.axil, rng.choice([*others, rng.randrange(0, 0x1000, 4)]))
            reads += 1

    async def checked() -> None:
        nonlocal reads
        while True:
            index = rng.randrange(count)
            word, response = await axil.read(bench.bus.axil, results[index])
            assert response == axil.OKAY and word in allowed[index], f"word {index} is {word:#x}"
            reads += 1

    stormy = [cocotb.start_soon(storm()), cocotb.start_soon(checked())]
    for number in range(6):
        frame = bench.good(bench.LEAST + 1, **bench.KINDS[number % len(bench.KINDS)])
        for index, word in enumerate(bench.words(bench.expected(frame))):
            allowed[index].add(word)
        before = reads
        await bench.solve(frame)
        assert reads - before > 20
        for index, word in enumerate(bench.words(bench.last)):
            allowed[index] = {word}
    for task in stormy:
        task.cancel()


async def queued_frames(bench: CoreBench) -> None:
    """Frames that wait at the stream while the core computes; one is bad, the others are not touched."""
    least = bench.LEAST
    first = bench.good(least)
    beats = bench.beats(first)
    few = beats[: (least - 1) * bench.BEATS]
    ticket = await bench.drive(lambda d: bench.prepare(d, first).feed(beats))
    others = [bench.like(first, bench.good(n)) for n in (least + 2, least + 1)]
    for more in (bench.beats(others[0]), few, bench.beats(others[1])):
        await bench.drive(lambda d, b=more: d.bus.stream(b))
    while (await bench.drive(bench.DRIVER.status)).frame != (ticket + 3) & 0xFFFF:
        await clocks.tick(bench.dut)
    got = await bench.standing()
    assert bench.words(got) == bench.words(bench.expected(others[1]))
    assert got.flag_names == ()
    assert await bench.flags() == ({bench.FEW}, set())


# ------------------------------------------------------------------------------------------------ flags


async def raised_and_cleared(bench: CoreBench, names: set[str]) -> None:
    """Exactly these flags are up, irq too; after clearing, none; the results stand; the next frame works."""
    sticky, frame = await bench.flags()
    assert sticky == frame == names
    if names & bench.FAILURES:
        assert bench.state() == 0
        await bench.unchanged()
    assert bench.dut.irq.value == 1
    assert (await bench.drive(bench.DRIVER.clear_interrupts))[1]
    await clocks.tick(bench.dut, 2)
    assert bench.dut.irq.value == 0
    await bench.drive(lambda d: d.clear_flags())
    assert await bench.flags() == (set(), names)  # FRAME_FLAGS stay until the next frame
    await bench.solve(bench.good())
    assert await bench.flags() == (set(), set())


async def broken_frames(bench: CoreBench) -> None:
    """Last beats where none may be, too few rows, too many, and a core that is stuck."""
    dut = bench.dut

    async def fed(beats: Sequence[int]) -> int:
        frame = bench.good()
        return await bench.drive(lambda d: bench.prepare(d, frame).feed(beats))

    async def fails(ticket: int, name: str) -> None:
        assert not await bench.drive(lambda d: d.wait(ticket, 200))
        await raised_and_cleared(bench, {name})

    for part in (slice(-1), slice(-2), slice(1)):
        await fails(await fed(bench.beats(bench.good())[part]), "BAD_TLAST")
    for rows in (1, bench.LEAST - 1):
        await fails(await fed(bench.beats(bench.good())[: rows * bench.BEATS]), bench.FEW)

    # TOO_LONG: the counter is set as if 65532 rows had come; swallowed to the end
    bench.bus.source.pause = True
    ticket = await fed(bench.beats(bench.good(max(bench.LEAST, 6))))
    await bench.reached(bench.BEATS)
    dut.loader.count.value = 65532
    bench.bus.source.pause = False
    await fails(ticket, "TOO_LONG")

    # WATCHDOG: as if 2040 clocks had gone by
    ticket = await fed(bench.beats(bench.good()))
    while bench.state() != COMPUTE:
        await FallingEdge(dut.clk)
    dut.core.states.cycles.value = 2040
    await fails(ticket, "WATCHDOG")


async def busy_writes(bench: CoreBench) -> None:
    """The configuration of a busy core and a push beside an open stream frame are ignored."""
    frame = bench.good()
    expected = bench.expected(frame)
    for register in (*(getattr(bench.registers, name) for name in bench.LOCKED), bench.registers.PUSH):
        await bench.drive(lambda d: bench.prepare(d, frame))
        before = await bench.drive(lambda d, r=register: d.read(r))
        bench.bus.source.pause = True
        ticket = await bench.drive(lambda d: d.feed(bench.beats(frame)))
        await bench.reached(2)
        await bench.drive(lambda d, r=register: d.write(r, 0x5))
        bench.bus.source.pause = False
        assert await bench.drive(lambda d, t=ticket: d.wait(t, 200))
        assert await bench.drive(lambda d, r=register: d.read(r)) == before
        got = await bench.standing()
        assert bench.words(got) == bench.words(expected) and got.flag_names == ("BUSY_WRITE",)
        bench.last = got
        await raised_and_cleared(bench, {"BUSY_WRITE"})


async def upset_in_every_state(bench: CoreBench) -> None:
    """What a protection notices ends the frame, wherever it is: flag UPSET, IDLE; the next frame is right."""
    dut = bench.dut
    states = [0, LOADING, COMPUTE, *([VERIFY] if await verifies(bench) else []), DONE]
    for state in states * 2:
        await bench.solve(bench.good())
        if state == 0:
            await bench.drive(bench.DRIVER.acknowledge)
        elif state != DONE:
            frame = bench.good(bench.LEAST + 2)
            bench.bus.source.pause = True
            await bench.drive(lambda d, f=frame: bench.prepare(d, f).feed(bench.beats(f)))
            await bench.reached(bench.rng.randrange(1, bench.BEATS * 2))
            bench.bus.source.pause = state == LOADING
        while bench.state() != state:
            await FallingEdge(dut.clk)
        await clocks.tick(dut, bench.rng.randrange(20))
        await FallingEdge(dut.clk)
        assert bench.state() == state
        dut.core.upsets.rows.value = 1  # as if the loader and the array had counted differently
        await clocks.tick(dut, 2)
        assert bench.state() == 0
        bench.bus.source.pause = False
        await clocks.tick(dut, 12 * bench.BEATS)  # the rest of an open frame is swallowed
        assert bench.state() == 0
        assert await bench.flags() == ({"UPSET"}, {"UPSET"})
        status = await bench.drive(bench.DRIVER.status)
        assert state in (0, DONE) or not any(getattr(status, f"{name}_ready") for name in bench.GROUPS)
        await bench.drive(bench.DRIVER.soft_reset)
        await bench.drive(lambda d: (d.clear_flags(), d.clear_interrupts()))
        await bench.solve(bench.good())
        assert await bench.flags() == (set(), set())


async def flags_cleared_while_busy(bench: CoreBench) -> None:
    """A flag that is raised and cleared in mid-computation does not come again, and disturbs nothing."""
    dut, name = bench.dut, bench.LOCKED[0]
    for state in [COMPUTE, *([VERIFY] if await verifies(bench) else [])]:
        frame = bench.good()
        ticket = await bench.drive(lambda d, f=frame: bench.prepare(d, f).feed(bench.beats(f)))
        while bench.state() != state:
            await FallingEdge(dut.clk)
        await bench.drive(lambda d: d.write(getattr(bench.registers, name), 1))
        assert (await bench.flags())[0] == {"BUSY_WRITE"}
        await bench.drive(lambda d: d.clear_flags())
        assert bench.state() == state
        points.event(dut._name, points.STATES[state], "flags cleared")
        assert (await bench.flags())[0] == set()
        assert await bench.drive(lambda d, t=ticket: d.wait(t, 200))
        got = await bench.standing()
        assert bench.words(got) == bench.words(bench.expected(frame))
        bench.last = got
