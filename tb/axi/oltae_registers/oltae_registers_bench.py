# SPDX-License-Identifier: Apache-2.0
"""oltae_registers through AXI4-Lite, register by register against the generated map."""

from __future__ import annotations

import os
import random
from collections.abc import Callable
from typing import Any

import cocotb
from cocotb.triggers import FallingEdge, ReadOnly, RisingEdge, gather
from relnav.registermap import Register
from relnav.registers import Oltae

from tb.common import axil, clocks

FULL = os.environ.get("FULL", "1") == "1"
BUILT = 0b1111 if FULL else 0b0010  # of CONFIG
QUIET = dict.fromkeys(
    (
        *("push_ready", "push_open", "busy", "state", "q_ready", "pose_ready", "all_ready", "flag_set"),
        *(
            "frame_start",
            "frame_complete",
            "points",
            "weight",
            "turn",
            "cycles_q",
            "cycles_pose",
            "cycles_all",
        ),
        *("result_wait", "result_data"),
    ),
    0,
)
STORED = [0x9E3779B9 * (index + 1) & 0xFFFFFFFF for index in range(64)]


class Bench:
    """The bus, the result memory's answers, and every pulse that came out."""

    def __init__(self, dut: Any) -> None:
        self.dut = dut
        self.bus = axil.master(dut)
        self.monitor = axil.Monitor(dut)
        self.pulses = {"soft_reset": 0, "acknowledge": 0}
        self.pushed: list[tuple[int, int]] = []
        self.rng = random.Random(1)
        self.result_waits = 0.0

    async def begin(self) -> Bench:
        cocotb.start_soon(self._watch())
        await clocks.start(self.dut, **QUIET)
        await clocks.tick(self.dut, 3)
        return self

    async def _watch(self) -> None:
        dut = self.dut
        while True:
            await FallingEdge(dut.clk)
            dut.result_wait.value = int(self.rng.random() < self.result_waits)
            await ReadOnly()
            answer = 0
            if not int(dut.rst.value):
                for name in self.pulses:
                    self.pulses[name] += int(getattr(dut, name).value)
                if int(dut.push_valid.value) and int(dut.push_ready.value):
                    self.pushed.append((int(dut.push_data.value), int(dut.push_last.value)))
                if int(dut.result_valid.value) and not int(dut.result_wait.value):
                    answer = STORED[int(dut.result_index.value)]
            await RisingEdge(dut.clk)
            dut.result_data.value = answer

    async def read(self, address: int) -> int:
        word, response = await axil.read(self.bus, address)
        assert response == axil.OKAY, f"read of 0x{address:03x}: {response!r}"
        return word

    async def write(self, address: int, value: int, strobe: int = 15) -> None:
        assert await axil.write(self.bus, address, value, strobe) == axil.OKAY, f"write of 0x{address:03x}"

    async def pulse(self, name: str, value: int = 1) -> None:
        await FallingEdge(self.dut.clk)
        getattr(self.dut, name).value = value
        await FallingEdge(self.dut.clk)
        getattr(self.dut, name).value = 0

    async def clear(self) -> None:
        """Forget every flag."""
        await self.write(Oltae.FLAGS.ADDRESS, 0xFFFFFFFF)
        await self.write(Oltae.IRQ_STATUS.ADDRESS, 0xFFFFFFFF)
        await self.pulse("frame_start")
        await self.write(Oltae.FLAGS.ADDRESS, 0xFFFFFFFF)
        await self.write(Oltae.IRQ_STATUS.ADDRESS, 0xFFFFFFFF)


def merged(old: int, new: int, strobe: int) -> int:
    mask = sum(0xFF << (8 * i) for i in range(4) if strobe >> i & 1)
    return old & ~mask | new & mask


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def identity_reset_and_unmapped(dut: Any) -> None:
    bench = await Bench(dut).begin()
    mapped: dict[int, Any] = {}
    for register in vars(Oltae).values():
        if isinstance(register, type) and issubclass(register, Register):
            mapped.update((register.element(i), register) for i in range(register.COUNT))
    assert len(mapped) == 55
    for address in range(0, 0x1000, 4):
        word, response = await axil.read(bench.bus, address)
        register = mapped.get(address)
        if register is None:
            assert (word, response) == (0, axil.SLVERR), f"0x{address:03x}"
        elif address >= 0x100:
            assert (word, response) == (STORED[(address - 0x100) // 4], axil.OKAY)
        elif register is Oltae.BUILD:
            build = Oltae.BUILD.encode(WEIGHTED=FULL, COVARIANCE=FULL, REAPPLY=FULL, MANTISSA=35)
            assert (word, response) == (build, axil.OKAY)
        else:
            expected = register.RESET or 0
            if register is Oltae.CONFIG:
                expected &= BUILT
            assert (word, response) == (expected, axil.OKAY), f"0x{address:03x}"
    for address in [a for a in range(0, 0x1000, 4) if a not in mapped and (a < 0x220 or a % 0x1C == 0)]:
        assert await axil.write(bench.bus, address, 0xFFFFFFFF) == axil.SLVERR, f"0x{address:03x}"
    for address, register in mapped.items():  # read-only: OKAY and ignored
        if register.ACCESS == "ro":
            await bench.write(address, 0xFFFFFFFF)
    assert await bench.read(Oltae.FLAGS.ADDRESS) == 0
    assert await bench.read(Oltae.ID.ADDRESS) == 0x4F4C5445
    assert bench.pulses == {"soft_reset": 0, "acknowledge": 0} and int(dut.push_valid.value) == 0


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def words_and_strobes(dut: Any) -> None:
    """DATA_A, DATA_B, VARIANCE, CONFIG, IRQ_ENABLE with every strobe; the outputs follow."""
    bench = await Bench(dut).begin()
    rng = random.Random(2)
    outputs: dict[Any, tuple[int, Callable[[], int]]] = {
        Oltae.DATA_A: (0xFFFFFFFF, lambda: int(dut.push_data.value) & 0xFFFFFFFF),
        Oltae.DATA_B: (0xFFFFFFFF, lambda: int(dut.push_data.value) >> 32),
        Oltae.VARIANCE: (0xFFFFFFFF, lambda: int(dut.config_variance.value)),
        Oltae.CONFIG: (
            BUILT,
            lambda: (
                int(dut.config_weighted.value)
                | int(dut.config_forbid_turns.value) << 1
                | int(dut.config_reapply.value) << 2
                | int(dut.config_covariance.value) << 3
            ),
        ),
        Oltae.IRQ_ENABLE: (3, lambda: -1),
    }
    for register, (mask, output) in outputs.items():
        held = await bench.read(register.ADDRESS)
        for strobe in [*range(16), 15, 15, 15, 15]:
            value = rng.getrandbits(32)
            await bench.write(register.ADDRESS, value, strobe)
            held = merged(held, value, strobe) & mask
            assert await bench.read(register.ADDRESS) == held, register.__name__
            assert output() in (held, -1), register.__name__
    await bench.write(Oltae.CONTROL.ADDRESS, 0x3, 0b1110)
    await bench.write(Oltae.CONTROL.ADDRESS, 0xFFFFFFFC)
    assert bench.pulses == {"soft_reset": 0, "acknowledge": 0}
    await bench.write(Oltae.CONTROL.ADDRESS, 1)
    await bench.write(Oltae.CONTROL.ADDRESS, 2)
    await bench.write(Oltae.CONTROL.ADDRESS, 3)
    await clocks.tick(dut, 3)
    assert bench.pulses == {"soft_reset": 2, "acknowledge": 2}, "each pulse is one clock"


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def binary_point(dut: Any) -> None:
    bench = await Bench(dut).begin()
    held = 0
    for value in range(256):
        await bench.write(Oltae.FRAC.ADDRESS, 0xABCDEF00 | value)
        if -64 <= Oltae.FRAC.FRAC.get(value) <= 95:
            held = value
        assert await bench.read(Oltae.FRAC.ADDRESS) == held == int(dut.config_frac.value)
    await bench.write(Oltae.FRAC.ADDRESS, 5, 0b1110)
    assert await bench.read(Oltae.FRAC.ADDRESS) == held
    assert await bench.read(Oltae.FLAGS.ADDRESS) == 0


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def status_and_latched_values(dut: Any) -> None:
    bench = await Bench(dut).begin()
    rng = random.Random(4)
    words = {"points": (16, 0x060), "weight": (32, 0x064), "turn": (2, 0x068)}
    words |= {"cycles_q": (16, 0x06C), "cycles_pose": (16, 0x070), "cycles_all": (16, 0x074)}
    for _ in range(20):
        value = {name: rng.getrandbits(bits) for name, (bits, _) in words.items()}
        for name in words:
            getattr(dut, name).value = value[name]
        for name, (_, address) in words.items():
            assert await bench.read(address) == value[name], name
        parts = {
            "state": ("STATE", 3),
            "busy": ("BUSY", 1),
            "q_ready": ("Q_READY", 1),
            "pose_ready": ("POSE_READY", 1),
            "all_ready": ("ALL_READY", 1),
            "push_open": ("PUSH_READY", 1),
        }
        fields = {}
        for signal, (field, bits) in parts.items():
            fields[field] = rng.getrandbits(bits)
            getattr(dut, signal).value = fields[field]
        assert await bench.read(Oltae.STATUS.ADDRESS) == Oltae.STATUS.encode(**fields)
    for count in range(1, 5):
        await bench.pulse("frame_complete")
        assert Oltae.STATUS.FRAME.get(await bench.read(Oltae.STATUS.ADDRESS)) == count


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def flags(dut: Any) -> None:
    """Each flag alone: raised, sticky over a frame, cleared by its own 1 only, never lost while clearing."""
    bench = await Bench(dut).begin()
    assert list(Oltae.FLAGS.FIELDS) == list(Oltae.FRAME_FLAGS.FIELDS) and len(Oltae.FLAGS.FIELDS) == 10
    for field in Oltae.FLAGS.FIELDS.values():
        bit = field.mask
        await bench.pulse("flag_set", bit)
        assert await bench.read(Oltae.FLAGS.ADDRESS) == bit == await bench.read(Oltae.FRAME_FLAGS.ADDRESS)
        await bench.pulse("frame_start")
        assert await bench.read(Oltae.FRAME_FLAGS.ADDRESS) == 0
        assert await bench.read(Oltae.FLAGS.ADDRESS) == bit
        await bench.write(Oltae.FLAGS.ADDRESS, ~bit & 0xFFFFFFFF)
        await bench.write(Oltae.FLAGS.ADDRESS, bit, 0b1101 if field.low >= 8 else 0b1110)
        assert await bench.read(Oltae.FLAGS.ADDRESS) == bit, "cleared without its 1 or its strobe"
        await bench.write(Oltae.FLAGS.ADDRESS, bit)
        assert await bench.read(Oltae.FLAGS.ADDRESS) == 0
        dut.flag_set.value = bit  # held: rises in every clock
        await bench.write(Oltae.FLAGS.ADDRESS, bit)
        await clocks.tick(dut)
        dut.flag_set.value = 0
        assert await bench.read(Oltae.FLAGS.ADDRESS) == bit, "a flag was lost by the write that cleared it"
        await bench.clear()
    await FallingEdge(dut.clk)
    dut.frame_start.value, dut.flag_set.value = 1, 0x3  # a flag of the first beat belongs to the new frame
    await FallingEdge(dut.clk)
    dut.frame_start.value, dut.flag_set.value = 0, 0
    assert await bench.read(Oltae.FRAME_FLAGS.ADDRESS) == 3


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def interrupt(dut: Any) -> None:
    bench = await Bench(dut).begin()

    async def level() -> int:
        await clocks.tick(dut, 3)
        return int(dut.irq.value)

    for name, pulse in (("DONE", ("frame_complete", 1)), ("ERROR", ("flag_set", 0x10))):
        bit = Oltae.IRQ_STATUS.FIELDS[name].mask
        await bench.pulse(*pulse)
        assert await bench.read(Oltae.IRQ_STATUS.ADDRESS) == bit and await level() == 0, "masked"
        await bench.write(Oltae.IRQ_ENABLE.ADDRESS, 3 & ~bit)
        assert await level() == 0, "the other's enable"
        await bench.write(Oltae.IRQ_ENABLE.ADDRESS, bit)
        assert await level() == 1
        await clocks.tick(dut, 20)
        assert await level() == 1, "a level, not a pulse"
        await bench.write(Oltae.IRQ_STATUS.ADDRESS, 3 & ~bit)
        await bench.write(Oltae.IRQ_STATUS.ADDRESS, bit, 0b1110)
        assert await level() == 1
        await bench.write(Oltae.IRQ_STATUS.ADDRESS, bit)
        assert await level() == 0 and await bench.read(Oltae.IRQ_STATUS.ADDRESS) == 0
        await bench.pulse(*pulse)
        assert await level() == 1
        await bench.write(Oltae.IRQ_ENABLE.ADDRESS, 0)
        assert await level() == 0 and await bench.read(Oltae.IRQ_STATUS.ADDRESS) == bit
        await bench.clear()
    await bench.write(Oltae.IRQ_ENABLE.ADDRESS, 3)
    dut.frame_complete.value = 1
    await bench.write(Oltae.IRQ_STATUS.ADDRESS, 1)
    await clocks.tick(dut, 2)
    dut.frame_complete.value = 0
    assert await level() == 1, "a completion was lost by the write that cleared the one before"


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def busy_writes(dut: Any) -> None:
    bench = await Bench(dut).begin()
    flag = Oltae.FLAGS.BUSY_WRITE.mask
    values = {Oltae.CONFIG: 2, Oltae.FRAC: 17, Oltae.VARIANCE: 0x3F800000}
    for register, value in values.items():
        await bench.write(register.ADDRESS, value)
        dut.busy.value = 1
        await bench.write(register.ADDRESS, value ^ 1)
        assert await bench.read(register.ADDRESS) == value, f"{register.__name__} changed while busy"
        assert await bench.read(Oltae.FLAGS.ADDRESS) == flag == await bench.read(Oltae.FRAME_FLAGS.ADDRESS)
        assert await bench.read(Oltae.IRQ_STATUS.ADDRESS) == 2
        dut.busy.value = 0
        await bench.clear()
        await bench.write(register.ADDRESS, value)
        assert await bench.read(Oltae.FLAGS.ADDRESS) == 0
    dut.busy.value = 1  # none of these is locked
    for register in (
        Oltae.DATA_A,
        Oltae.DATA_B,
        Oltae.IRQ_ENABLE,
        Oltae.IRQ_STATUS,
        Oltae.FLAGS,
        Oltae.CONTROL,
    ):
        await bench.write(register.ADDRESS, 0)
    assert await bench.read(Oltae.FLAGS.ADDRESS) == 0


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def pushes(dut: Any) -> None:
    bench = await Bench(dut).begin()
    flag = Oltae.FLAGS.BUSY_WRITE.mask
    push_ready = Oltae.STATUS.PUSH_READY

    async def beat(a: int, b: int, last: int, strobe: int = 15) -> None:
        await bench.write(Oltae.DATA_A.ADDRESS, a)
        await bench.write(Oltae.DATA_B.ADDRESS, b)
        await bench.write(Oltae.PUSH.ADDRESS, last, strobe)

    await beat(1, 2, 0)  # not open
    await clocks.tick(dut, 3)
    assert int(dut.push_valid.value) == 0
    assert await bench.read(Oltae.FLAGS.ADDRESS) == flag
    await bench.clear()
    dut.push_open.value = 1
    assert push_ready.get(await bench.read(Oltae.STATUS.ADDRESS)) == 1
    await beat(0x11111111, 0x22222222, 1)  # open, not taken yet
    await clocks.tick(dut, 3)
    assert int(dut.push_valid.value) == 1 and not bench.pushed
    assert push_ready.get(await bench.read(Oltae.STATUS.ADDRESS)) == 0
    for register in (Oltae.DATA_A, Oltae.DATA_B, Oltae.PUSH):
        await bench.write(register.ADDRESS, 0)
        assert await bench.read(Oltae.FLAGS.ADDRESS) == flag, register.__name__
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
            await bench.write(Oltae.PUSH.ADDRESS, sent[-1][2] ^ 1)  # the same data once more
            sent.append((*sent[-1][:2], sent[-1][2] ^ 1))
        await clocks.tick(dut, 2)
    assert bench.pushed == [(b << 32 | a, last) for a, b, last in sent]
    assert await bench.read(Oltae.FLAGS.ADDRESS) == 0
    bench.pushed.clear()
    dut.push_ready.value = 0  # a soft reset forgets a waiting push
    await beat(5, 6, 0)
    await bench.write(Oltae.CONTROL.ADDRESS, 1)
    await clocks.tick(dut, 3)
    assert int(dut.push_valid.value) == 0
    dut.push_ready.value = 1
    await clocks.tick(dut, 3)
    assert not bench.pushed


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def not_built(dut: Any) -> None:
    """What the build has not reads 0 and raises NOT_BUILT at the write and in every frame run so."""
    bench = await Bench(dut).begin()
    flag = Oltae.FLAGS.NOT_BUILT.mask
    for bit in range(4):
        for ask in (1 << bit, 0):
            lacks = bool(ask & ~BUILT)
            await bench.write(Oltae.CONFIG.ADDRESS, ask)
            assert await bench.read(Oltae.CONFIG.ADDRESS) == ask & BUILT
            assert await bench.read(Oltae.FLAGS.ADDRESS) == flag * lacks
            await bench.clear()
            await bench.pulse("frame_start")
            assert (
                await bench.read(Oltae.FLAGS.ADDRESS)
                == flag * lacks
                == await bench.read(Oltae.FRAME_FLAGS.ADDRESS)
            )
            await bench.clear()


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def stress(dut: Any) -> None:
    """Reads and writes together, idle and back-pressure on every channel, the result memory often busy."""
    bench = await Bench(dut).begin()
    bench.result_waits = 0.5
    rng = random.Random(12)
    held = {Oltae.DATA_A: 0, Oltae.DATA_B: 0, Oltae.VARIANCE: 0}

    async def writer(registers: list[Any], count: int) -> None:
        for _ in range(count):
            register = rng.choice(registers)
            held[register] = value = rng.getrandbits(32)
            await bench.write(register.ADDRESS, value)

    async def reader(registers: list[Any], count: int) -> None:
        for _ in range(count):
            pick = rng.randrange(3)
            if pick == 0:
                index = rng.randrange(34)
                assert await bench.read(0x100 + 4 * index) == STORED[index]
            elif pick == 1:
                register = rng.choice(registers)
                assert await bench.read(register.ADDRESS) == held[register]
            else:
                hole = rng.choice([0x030, 0x04C, 0x07C, 0x188, 0x200, 0xFFC])
                assert await axil.read(bench.bus, hole) == (0, axil.SLVERR)

    names = list(held)
    for _ in range(12):
        axil.random_pauses(bench.bus, rng)
        rng.shuffle(names)
        await gather(writer(names[:1], 20), reader(names[1:], 20))
    assert bench.monitor.done == {"aw": 240, "w": 240, "b": 240, "ar": 240, "r": 240}
