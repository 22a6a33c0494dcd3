# SPDX-License-Identifier: Apache-2.0
"""What every core's register file has, through AXI4-Lite, register by register against the generated map."""

from __future__ import annotations

import random
from collections.abc import Callable
from typing import Any

import cocotb
from cocotb.triggers import FallingEdge, ReadOnly, gather

from tb.axi.registers import CORE, MAP, STORED, Bench, merged
from tb.common import axil, clocks, netlist


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def identity_reset_and_unmapped(dut: Any) -> None:
    bench = await Bench(dut).begin()
    mapped = CORE.mapped()
    assert not mapped.keys() & set(CORE.holes)
    for address in range(0, 0x1000, 4):
        word, response = await axil.read(bench.bus, address)
        register = mapped.get(address)
        if register is None:
            assert (word, response) == (0, axil.SLVERR), f"0x{address:03x}"
        elif address >= 0x100:
            assert (word, response) == (STORED[(address - 0x100) // 4], axil.OKAY)
        elif register is MAP.BUILD:
            assert (word, response) == (CORE.build, axil.OKAY)
        else:
            expected = CORE.resets.get(register.__name__, register.RESET or 0)
            assert (word, response) == (expected, axil.OKAY), f"0x{address:03x}"
    for address in [a for a in range(0, 0x1000, 4) if a not in mapped and (a < 0x220 or a % 0x1C == 0)]:
        assert await axil.write(bench.bus, address, 0xFFFFFFFF) == axil.SLVERR, f"0x{address:03x}"
    for address, register in mapped.items():  # read-only: OKAY and ignored
        if register.ACCESS == "ro":
            await bench.write(address, 0xFFFFFFFF)
    assert await bench.read(MAP.FLAGS.ADDRESS) == 0
    assert await bench.read(MAP.ID.ADDRESS) == MAP.ID.RESET
    assert bench.pulses == {"soft_reset": 0, "acknowledge": 0} and int(dut.push_valid.value) == 0


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def words_and_strobes(dut: Any) -> None:
    """DATA_A, DATA_B, VARIANCE, IRQ_ENABLE with every strobe; the outputs follow."""
    bench = await Bench(dut).begin()
    rng = random.Random(2)
    outputs: dict[Any, tuple[int, Callable[[], int]]] = {
        MAP.DATA_A: (0xFFFFFFFF, lambda: int(dut.push_data.value) & 0xFFFFFFFF),
        MAP.DATA_B: (0xFFFFFFFF, lambda: int(dut.push_data.value) >> 32),
        MAP.VARIANCE: (0xFFFFFFFF, lambda: int(dut.config_variance.value)),
        MAP.IRQ_ENABLE: (3, lambda: -1),
    }
    for register, (mask, output) in outputs.items():
        held = await bench.read(register.ADDRESS)
        for strobe in [*range(16), 15, 15, 15, 15]:
            value = rng.getrandbits(32)
            await bench.write(register.ADDRESS, value, strobe)
            held = merged(held, value, strobe) & mask
            assert await bench.read(register.ADDRESS) == held, register.__name__
            assert output() in (held, -1), register.__name__
    await bench.write(MAP.CONTROL.ADDRESS, 0x3, 0b1110)
    await bench.write(MAP.CONTROL.ADDRESS, 0xFFFFFFFC)
    assert bench.pulses == {"soft_reset": 0, "acknowledge": 0}
    await bench.write(MAP.CONTROL.ADDRESS, 1)
    await bench.write(MAP.CONTROL.ADDRESS, 2)
    await bench.write(MAP.CONTROL.ADDRESS, 3)
    await clocks.tick(dut, 3)
    assert bench.pulses == {"soft_reset": 2, "acknowledge": 2}, "each pulse is one clock"


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def binary_points(dut: Any) -> None:
    """Each byte through all its values, the other at random: one of them outside -64..95, no write."""
    bench = await Bench(dut).begin()
    rng = random.Random(3)
    fields = list(CORE.points.values())
    mask = sum(field.mask for field in fields)
    held = 0

    async def written(word: int, strobe: int = 15) -> None:
        nonlocal held
        byte = {field: bool(strobe >> (field.low // 8) & 1) for field in fields}
        if all(-64 <= field.get(word) <= 95 for field in fields if byte[field]):
            held = merged(held, word, strobe) & mask
        await bench.write(MAP.FRAC.ADDRESS, word, strobe)
        assert await bench.read(MAP.FRAC.ADDRESS) == held
        for port, field in CORE.points.items():
            assert int(getattr(dut, port).value) == (held & field.mask) >> field.low

    for field in fields:
        for value in range(256):
            others = rng.getrandbits(32) & ~mask
            for other in fields:
                others |= other.put(rng.choice([-64, -1, 0, 95, 95, 96 if value % 8 == 0 else 7]))
            await written(others & ~field.mask | value << field.low)
    for strobe in range(16):
        await written(rng.getrandbits(32) & ~mask | mask & 0x2805, strobe)
        await written(rng.getrandbits(32) | 0x6000, strobe)
    assert await bench.read(MAP.FLAGS.ADDRESS) == 0


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def status_and_latched_values(dut: Any) -> None:
    bench = await Bench(dut).begin()
    rng = random.Random(4)
    fields = MAP.STATUS.FIELDS
    for _ in range(20):
        values = {name: rng.getrandbits(bits) for name, (bits, _) in CORE.latched.items()}
        for name, value in values.items():
            getattr(dut, name).value = value
        for name, (_, register) in CORE.latched.items():
            assert await bench.read(getattr(MAP, register).ADDRESS) == values[name], name
        state, busy, ready, push = (rng.getrandbits(bits) for bits in (3, 1, 3, 1))
        groups = [place for place in (5, 6, 7) if any(field.low == place for field in fields.values())]
        ready &= sum(1 << (place - 5) for place in groups)  # a group that the core has not is tied to 0
        dut.state.value, dut.busy.value, dut.ready.value, dut.push_open.value = state, busy, ready, push
        word = await bench.read(MAP.STATUS.ADDRESS)
        assert word == MAP.STATUS.encode(STATE=state, BUSY=busy, PUSH_READY=push) | ready << 5
    for count in range(1, 5):
        await bench.pulse("frame_complete")
        assert MAP.STATUS.FRAME.get(await bench.read(MAP.STATUS.ADDRESS)) == count


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def flags(dut: Any) -> None:
    """Each flag alone: raised, sticky over a frame, cleared by its own 1 only, never lost while clearing."""
    bench = await Bench(dut).begin()
    assert list(MAP.FLAGS.FIELDS) == list(MAP.FRAME_FLAGS.FIELDS)
    for field in MAP.FLAGS.FIELDS.values():
        bit = field.mask
        await bench.pulse("flag_set", bit)
        assert await bench.read(MAP.FLAGS.ADDRESS) == bit == await bench.read(MAP.FRAME_FLAGS.ADDRESS)
        await bench.pulse("frame_start")
        assert await bench.read(MAP.FRAME_FLAGS.ADDRESS) == 0
        assert await bench.read(MAP.FLAGS.ADDRESS) == bit
        await bench.write(MAP.FLAGS.ADDRESS, ~bit & 0xFFFFFFFF)
        await bench.write(MAP.FLAGS.ADDRESS, bit, 0b1101 if field.low >= 8 else 0b1110)
        assert await bench.read(MAP.FLAGS.ADDRESS) == bit, "cleared without its 1 or its strobe"
        await bench.write(MAP.FLAGS.ADDRESS, bit)
        assert await bench.read(MAP.FLAGS.ADDRESS) == 0
        dut.flag_set.value = bit  # held: rises in every clock
        await bench.write(MAP.FLAGS.ADDRESS, bit)
        await clocks.tick(dut)
        dut.flag_set.value = 0
        assert await bench.read(MAP.FLAGS.ADDRESS) == bit, "a flag was lost by the write that cleared it"
        await bench.clear()
    await FallingEdge(dut.clk)
    dut.frame_start.value, dut.flag_set.value = 1, 0x3  # a flag of the first beat belongs to the new frame
    await FallingEdge(dut.clk)
    dut.frame_start.value, dut.flag_set.value = 0, 0
    assert await bench.read(MAP.FRAME_FLAGS.ADDRESS) == 3


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def interrupt(dut: Any) -> None:
    bench = await Bench(dut).begin()

    async def level() -> int:
        await clocks.tick(dut, 3)
        return int(dut.irq.value)

    for name, pulse in (("DONE", ("frame_complete", 1)), ("ERROR", ("flag_set", 0x10))):
        bit = MAP.IRQ_STATUS.FIELDS[name].mask
        await bench.pulse(*pulse)
        assert await bench.read(MAP.IRQ_STATUS.ADDRESS) == bit and await level() == 0, "masked"
        await bench.write(MAP.IRQ_ENABLE.ADDRESS, 3 & ~bit)
        assert await level() == 0, "the other's enable"
        await bench.write(MAP.IRQ_ENABLE.ADDRESS, bit)
        assert await level() == 1
        await clocks.tick(dut, 20)
        assert await level() == 1, "a level, not a pulse"
        await bench.write(MAP.IRQ_STATUS.ADDRESS, 3 & ~bit)
        await bench.write(MAP.IRQ_STATUS.ADDRESS, bit, 0b1110)
        assert await level() == 1
        await bench.write(MAP.IRQ_STATUS.ADDRESS, bit)
        assert await level() == 0 and await bench.read(MAP.IRQ_STATUS.ADDRESS) == 0
        await bench.pulse(*pulse)
        assert await level() == 1
        await bench.write(MAP.IRQ_ENABLE.ADDRESS, 0)
        assert await level() == 0 and await bench.read(MAP.IRQ_STATUS.ADDRESS) == bit
        await bench.clear()
    for pending in range(4):  # what is enabled stays, whatever is pending
        if pending & 1:
            await bench.pulse("frame_complete")
        if pending & 2:
            await bench.pulse("flag_set", 0x10)
        for enabled in range(4):
            await bench.write(MAP.IRQ_ENABLE.ADDRESS, enabled)
            for _ in range(2):
                assert await level() == int(enabled & pending != 0)
                assert await bench.read(MAP.IRQ_ENABLE.ADDRESS) == enabled
                assert await bench.read(MAP.IRQ_STATUS.ADDRESS) == pending
                await clocks.tick(dut)
        await bench.clear()
    await bench.write(MAP.IRQ_ENABLE.ADDRESS, 3)
    dut.frame_complete.value = 1
    await bench.write(MAP.IRQ_STATUS.ADDRESS, 1)
    await clocks.tick(dut, 2)
    dut.frame_complete.value = 0
    assert await level() == 1, "a completion was lost by the write that cleared the one before"


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def busy_writes(dut: Any) -> None:
    bench = await Bench(dut).begin()
    flag = MAP.FLAGS.BUSY_WRITE.mask
    values = {MAP.FRAC: 17, MAP.VARIANCE: 0x3F800000}
    for register, value in values.items():
        await bench.write(register.ADDRESS, value)
        dut.busy.value = 1
        await bench.write(register.ADDRESS, value ^ 1)
        assert await bench.read(register.ADDRESS) == value, f"{register.__name__} changed while busy"
        assert await bench.read(MAP.FLAGS.ADDRESS) == flag == await bench.read(MAP.FRAME_FLAGS.ADDRESS)
        assert await bench.read(MAP.IRQ_STATUS.ADDRESS) == 2
        dut.busy.value = 0
        await bench.clear()
        await bench.write(register.ADDRESS, value)
        assert await bench.read(MAP.FLAGS.ADDRESS) == 0
    dut.busy.value = 1  # none of these is locked
    for register in (
        MAP.DATA_A,
        MAP.DATA_B,
        MAP.IRQ_ENABLE,
        MAP.IRQ_STATUS,
        MAP.FLAGS,
        MAP.CONTROL,
    ):
        await bench.write(register.ADDRESS, 0)
    assert await bench.read(MAP.FLAGS.ADDRESS) == 0


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def pushes(dut: Any) -> None:
    bench = await Bench(dut).begin()
    flag = MAP.FLAGS.BUSY_WRITE.mask
    push_ready = MAP.STATUS.PUSH_READY

    async def beat(a: int, b: int, last: int, strobe: int = 15) -> None:
        await bench.write(MAP.DATA_A.ADDRESS, a)
        await bench.write(MAP.DATA_B.ADDRESS, b)
        await bench.write(MAP.PUSH.ADDRESS, last, strobe)

    await beat(1, 2, 0)  # not open
    await clocks.tick(dut, 3)
    assert int(dut.push_valid.value) == 0
    assert await bench.read(MAP.FLAGS.ADDRESS) == flag
    await bench.clear()
    dut.push_open.value = 1
    assert push_ready.get(await bench.read(MAP.STATUS.ADDRESS)) == 1
    await beat(0x11111111, 0x22222222, 1)  # open, not taken yet
    await clocks.tick(dut, 3)
    assert int(dut.push_valid.value) == 1 and not bench.pushed
    assert push_ready.get(await bench.read(MAP.STATUS.ADDRESS)) == 0
    for register in (MAP.DATA_A, MAP.DATA_B, MAP.PUSH):
        await bench.write(register.ADDRESS, 0)
        assert await bench.read(MAP.FLAGS.ADDRESS) == flag, register.__name__
        await bench.clear()
    dut.push_ready.value = 1
    await clocks.tick(dut, 3)
    assert bench.pushed == [(0x2222222211111111, 1)] and int(dut.push_valid.value) == 0
    bench.pushed.clear()
    await beat(3, 4, 1, 0b1110)  # LAST without its strobe
    await clocks.tick(dut, 2)
    assert bench.pushed == [(4 << 32 | 3, 0)]
    bench.pushed.clear()
    rng = random.Random(8)  # a slave that takes within two clocks loses nothing at the bus's full rate
    sent = []
    for _ in range(60):
        sent.append((rng.getrandbits(32), rng.getrandbits(32), rng.getrandbits(1)))
        dut.push_ready.value = 0
        await beat(*sent[-1])
        dut.push_ready.value = 1
        if rng.random() < 0.5:
            await bench.write(MAP.PUSH.ADDRESS, sent[-1][2] ^ 1)  # the same data once more
            sent.append((*sent[-1][:2], sent[-1][2] ^ 1))
        await clocks.tick(dut, 2)
    assert bench.pushed == [(b << 32 | a, last) for a, b, last in sent]
    assert await bench.read(MAP.FLAGS.ADDRESS) == 0
    bench.pushed.clear()
    dut.push_ready.value = 0  # a soft reset forgets a waiting push
    await beat(5, 6, 0)
    await bench.write(MAP.CONTROL.ADDRESS, 1)
    await clocks.tick(dut, 3)
    assert int(dut.push_valid.value) == 0
    dut.push_ready.value = 1
    await clocks.tick(dut, 3)
    assert not bench.pushed


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def stress(dut: Any) -> None:
    """Reads and writes together, idle and back-pressure on every channel, the result memory often busy."""
    bench = await Bench(dut).begin()
    bench.result_waits = 0.5
    rng = random.Random(12)
    held = {MAP.DATA_A: 0, MAP.DATA_B: 0, MAP.VARIANCE: 0}

    async def writer(registers: list[Any], count: int) -> None:
        for _ in range(count):
            register = rng.choice(registers)
            held[register] = value = rng.getrandbits(32)
            await bench.write(register.ADDRESS, value)

    async def reader(registers: list[Any], count: int) -> None:
        for _ in range(count):
            pick = rng.randrange(3)
            if pick == 0:
                index = rng.randrange(28)
                assert await bench.read(0x100 + 4 * index) == STORED[index]
            elif pick == 1:
                register = rng.choice(registers)
                assert await bench.read(register.ADDRESS) == held[register]
            else:
                hole = rng.choice(CORE.holes)
                assert await axil.read(bench.bus, hole) == (0, axil.SLVERR)

    names = list(held)
    for _ in range(12):
        axil.random_pauses(bench.bus, rng)
        rng.shuffle(names)
        await gather(writer(names[:1], 20), reader(names[1:], 20))
    assert bench.monitor.done == {"aw": 240, "w": 240, "b": 240, "ar": 240, "r": 240}


async def flip(dut: Any, signal: Any, bit: int) -> None:
    """Flip one bit at the next falling edge."""
    await FallingEdge(dut.clk)
    signal.value = int(signal.value) ^ 1 << bit


@cocotb.test(timeout_time=5, timeout_unit="ms", skip=netlist.REPLACED)
async def configuration_upsets(dut: Any) -> None:
    """A flip of any configuration bit or its parity raises UPSET until it is written again."""
    bench = await Bench(dut).begin()
    flag = MAP.FLAGS.UPSET.mask
    rng = random.Random(21)
    common = dut.common
    held = {MAP.FRAC: 0, MAP.VARIANCE: 0}
    for register, signals in {
        MAP.FRAC: (common.config_frac, common.frac_parity),
        MAP.VARIANCE: (common.config_variance, common.variance_parity),
    }.items():
        for signal in signals:
            for bit in range(len(signal)):
                held[register] = rng.getrandbits(32) & 0x1F1F1F1F
                await bench.write(register.ADDRESS, held[register])
                await bench.clear()
                assert int(dut.upset.value) == 0 == await bench.read(MAP.FLAGS.ADDRESS)
                await flip(dut, signal, bit)
                await clocks.tick(dut)
                assert int(dut.upset.value) == 1
                await bench.write(MAP.FLAGS.ADDRESS, flag)
                assert (
                    await bench.read(MAP.FLAGS.ADDRESS) == flag == await bench.read(MAP.FRAME_FLAGS.ADDRESS)
                )
                await bench.write(register.ADDRESS, held[register])
                await clocks.tick(dut, 2)
                assert int(dut.upset.value) == 0
                await bench.write(MAP.FLAGS.ADDRESS, flag)
                assert await bench.read(MAP.FLAGS.ADDRESS) == 0


@cocotb.test(timeout_time=5, timeout_unit="ms", skip=netlist.REPLACED)
async def flag_upsets(dut: Any) -> None:
    """A flag that rises or is lost by a flip is never alone: UPSET is beside it."""
    bench = await Bench(dut).begin()
    twins = dut.common.flags_register
    upset = MAP.FLAGS.UPSET.mask
    fields = list(MAP.FLAGS.FIELDS.values())
    every = sum(field.mask for field in fields)
    width = len(twins.first) // 2
    for copy in (twins.first, twins.second):
        for half in (0, 1):
            for field in fields:
                for raised in (0, every & ~upset & ~field.mask, every & ~upset):
                    await bench.clear()
                    await bench.pulse("flag_set", raised)
                    await flip(dut, copy, half * width + field.low)
                    await clocks.tick(dut, 3)
                    seen = [await bench.read(MAP.FLAGS.ADDRESS), await bench.read(MAP.FRAME_FLAGS.ADDRESS)]
                    expected = [raised | upset, raised | upset]
                    if copy is twins.first:
                        expected[half] = (raised ^ field.mask) | upset
                    assert seen == expected


@cocotb.test(timeout_time=5, timeout_unit="ms", skip=netlist.REPLACED)
async def voted_upsets(dut: Any) -> None:
    """No flip of one voted flip-flop is seen: pulses, pushes, interrupt, frame counter."""
    bench = await Bench(dut).begin()
    for _ in range(5):
        await bench.pulse("frame_complete")
    await bench.write(MAP.IRQ_ENABLE.ADDRESS, 3)
    dut.push_open.value = 1
    for offered in (0, 1):
        if offered:
            await bench.write(MAP.PUSH.ADDRESS, 1)
        for register in (dut.common.control_register, dut.common.event_register):
            for name in ("first", "second", "third"):
                copy = getattr(register, name)
                for bit in range(len(copy)):
                    await flip(dut, copy, bit)
                    for _ in range(3):
                        await ReadOnly()
                        assert (int(dut.push_valid.value), int(dut.irq.value)) == (offered, 1)
                        assert not offered or int(dut.push_last.value) == 1
                        await FallingEdge(dut.clk)
        assert MAP.STATUS.FRAME.get(await bench.read(MAP.STATUS.ADDRESS)) == 5
        assert await bench.read(MAP.IRQ_ENABLE.ADDRESS) == 3
        assert await bench.read(MAP.IRQ_STATUS.ADDRESS) == 1
        assert await bench.read(MAP.FLAGS.ADDRESS) == 0
    assert bench.pulses == {"soft_reset": 0, "acknowledge": 0}


@cocotb.test(timeout_time=5, timeout_unit="ms", skip=netlist.REPLACED)
async def held_upsets(dut: Any) -> None:
    """Any bit of a held write flips before its use: SLVERR, no register changes, UPSET."""
    bench = await Bench(dut).begin()
    slave = dut.common.slave
    rng = random.Random(23)
    held = 0
    spoilt = slave.write_data, slave.write_strobe, slave.write_parity
    for signal in (*spoilt, slave.write_address, slave.write_address_parity):
        for bit in range(len(signal)):
            writing = cocotb.start_soon(axil.write(bench.bus, MAP.VARIANCE.ADDRESS, rng.getrandbits(32)))
            while not int(slave.address_full.value) or not int(slave.data_full.value):
                await FallingEdge(dut.clk)
            signal.value = int(signal.value) ^ 1 << bit
            assert await writing == axil.SLVERR
            assert await bench.read(MAP.VARIANCE.ADDRESS) == held
            assert await bench.read(MAP.FLAGS.ADDRESS) == MAP.FLAGS.UPSET.mask
            await bench.clear()
            held = rng.getrandbits(32)
            await bench.write(MAP.VARIANCE.ADDRESS, held)
    assert await bench.read(MAP.FLAGS.ADDRESS) == 0
