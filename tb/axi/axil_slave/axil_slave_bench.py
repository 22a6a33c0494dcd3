# SPDX-License-Identifier: Apache-2.0
"""axil_slave behind a real master, with a small register file in Python on its other side."""

from __future__ import annotations

import random
from typing import Any

import cocotb
from cocotb.triggers import ClockCycles, FallingEdge, ReadOnly, gather

from tb.common import axil, clocks, netlist

WORDS = 64  # mapped words of the 1024


class Registers:
    """The register side: WORDS words, error above; read data one clock after a read not held up, else 0."""

    def __init__(self, dut: Any, wait_share: float) -> None:
        self.dut = dut
        self.words = [0] * WORDS
        self.writes = 0
        self.reads = 0
        self.rng = random.Random(7)
        self.wait_share = wait_share
        cocotb.start_soon(self._run())

    async def _run(self) -> None:
        dut = self.dut
        dut.read_data.value = 0
        while True:
            dut.read_wait.value = int(self.rng.random() < self.wait_share)
            dut.write_error.value = int(str(dut.write_word.value).startswith("0000") is False)
            dut.read_error.value = int(str(dut.read_word.value).startswith("0000") is False)
            await ReadOnly()
            answer = 0
            if not int(dut.rst.value):
                if int(dut.write_valid.value):
                    self.writes += 1
                    word = int(dut.write_word.value)
                    if word < WORDS:
                        mask = sum(0xFF << (8 * i) for i in range(4) if int(dut.write_strobe.value) >> i & 1)
                        self.words[word] = self.words[word] & ~mask | int(dut.write_data.value) & mask
                if int(dut.read_valid.value) and not int(dut.read_wait.value):
                    self.reads += 1
                    word = int(dut.read_word.value)
                    answer = self.words[word] if word < WORDS else 0
            await FallingEdge(dut.clk)
            dut.read_data.value = answer


async def setup(dut: Any, wait_share: float = 0.0) -> tuple[Any, Registers, axil.Monitor]:
    bus = axil.master(dut)
    registers = Registers(dut, wait_share)
    monitor = axil.Monitor(dut)
    await clocks.start(dut)
    await ClockCycles(dut.clk, 2)
    return bus, registers, monitor


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def words_bytes_and_errors(dut: Any) -> None:
    bus, registers, _ = await setup(dut)
    for word in range(WORDS):
        assert await axil.write(bus, 4 * word, 0x01010101 * word) == axil.OKAY
    for word in range(WORDS):
        assert await axil.read(bus, 4 * word) == (0x01010101 * word, axil.OKAY)
    for strobe in range(16):
        before = registers.words[5]
        assert await axil.write(bus, 20, 0xFFEEDDCC, strobe) == axil.OKAY
        mask = sum(0xFF << (8 * i) for i in range(4) if strobe >> i & 1)
        assert await axil.read(bus, 20) == (before & ~mask | 0xFFEEDDCC & mask, axil.OKAY)
    for word in (WORDS, 512, 1023):
        assert await axil.write(bus, 4 * word, 1) == axil.SLVERR
        assert await axil.read(bus, 4 * word) == (0, axil.SLVERR)
    assert await axil.read(bus, 0) == (0, axil.OKAY)


async def raw_handshakes(dut: Any, **channels: dict[str, int]) -> None:
    """Offer the given channels at once, each until its ready."""

    async def offer(channel: str, payload: dict[str, int]) -> None:
        for name, value in payload.items():
            getattr(dut, f"s_axil_{name}").value = value
        getattr(dut, f"s_axil_{channel}valid").value = 1
        while True:
            ready = int(getattr(dut, f"s_axil_{channel}ready").value)
            await FallingEdge(dut.clk)
            if ready:
                break
        getattr(dut, f"s_axil_{channel}valid").value = 0

    await gather(*(offer(name, payload) for name, payload in channels.items()))


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def answers_wait_for_nothing(dut: Any) -> None:
    """Driven by hand: address before data, data before address, misaligned, valid rising with ready low."""
    names = (
        "awvalid",
        "wvalid",
        "bready",
        "arvalid",
        "rready",
        "awaddr",
        "araddr",
        "wdata",
        "wstrb",
        "awprot",
        "arprot",
    )
    registers = Registers(dut, 0.0)
    monitor = axil.Monitor(dut)
    await clocks.start(dut, **{f"s_axil_{name}": 0 for name in names})
    await clocks.tick(dut, 2)
    aw = {"awaddr": 8}
    w = {"wdata": 0x1234, "wstrb": 15}
    for order in ([{"aw": aw}, {"w": w}], [{"w": w}, {"aw": aw}], [{"aw": aw, "w": w}]):
        for step in order:
            await raw_handshakes(dut, **step)
            await clocks.tick(dut, 5)
        assert int(dut.s_axil_bvalid.value) == 1, "bvalid waited for bready"
        await clocks.tick(dut, 3)
        dut.s_axil_bready.value = 1
        await clocks.tick(dut)
        dut.s_axil_bready.value = 0
        assert int(dut.s_axil_bvalid.value) == 0
    assert registers.writes == 3 and registers.words[2] == 0x1234
    await raw_handshakes(dut, ar={"araddr": 8})
    await clocks.tick(dut, 5)
    assert int(dut.s_axil_rvalid.value) == 1, "rvalid waited for rready"
    assert int(dut.s_axil_rdata.value) == 0x1234
    dut.s_axil_rready.value = 1
    dut.s_axil_bready.value = 1
    await clocks.tick(dut)
    for low in (1, 2, 3):
        await raw_handshakes(dut, aw={"awaddr": 8 + low}, w=w, ar={"araddr": 8 + low})
        while not (int(dut.s_axil_bvalid.value)):
            await clocks.tick(dut)
        assert int(dut.s_axil_bresp.value) == 2
        while not (int(dut.s_axil_rvalid.value)):
            await clocks.tick(dut)
        assert int(dut.s_axil_rresp.value) == 2 and int(dut.s_axil_rdata.value) == 0
        await clocks.tick(dut, 2)
    assert registers.writes == 3 and registers.reads == 1, "a misaligned access reached the registers"
    assert monitor.early["b"] >= 3 and monitor.early["r"] == 1


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def throughput(dut: Any) -> None:
    """One write in 2 clocks and one read in 4, with a master that never waits."""
    names = ("awaddr", "araddr", "wdata", "awprot", "arprot")
    registers = Registers(dut, 0.0)
    axil.Monitor(dut)
    ones = {f"s_axil_{name}": 1 for name in ("awvalid", "wvalid", "bready", "arvalid", "rready")}
    await clocks.start(dut, **{f"s_axil_{name}": 0 for name in names}, s_axil_wstrb=15, **ones)
    await clocks.tick(dut, 8)
    writes, reads = registers.writes, registers.reads
    await clocks.tick(dut, 400)
    assert (registers.writes - writes, registers.reads - reads) == (200, 100)


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def stress(dut: Any) -> None:
    """Reads and writes together, idle and back-pressure on every channel, a register side that waits."""
    bus, registers, monitor = await setup(dut, wait_share=0.3)
    rng = random.Random(11)
    words = [0] * WORDS
    lanes = 3  # so many accesses at once on each side: the bus offers the next while an answer waits

    async def writer(lane: int, count: int) -> None:
        for _ in range(count):
            if rng.random() < 0.3:
                assert await axil.write(bus, 4 * rng.randrange(WORDS, 1024), 1) == axil.SLVERR
                continue
            word = rng.randrange(lane, WORDS // 2, lanes) + upper
            words[word] = value = rng.getrandbits(32)
            assert await axil.write(bus, 4 * word, value) == axil.OKAY

    async def reader(count: int) -> None:
        for _ in range(count):
            word = rng.randrange(WORDS // 2) + WORDS // 2 - upper
            if rng.random() < 0.3:
                assert await axil.read(bus, 4 * (word + WORDS)) == (0, axil.SLVERR)
            else:
                assert await axil.read(bus, 4 * word) == (words[word], axil.OKAY)

    for turn in range(12):
        axil.random_pauses(bus, rng)
        upper = turn % 2 * (WORDS // 2)  # the half that is written; the other one is read
        await gather(*(writer(lane, 15) for lane in range(lanes)), *(reader(15) for _ in range(lanes)))
    axil.no_pauses(bus)
    assert words == registers.words
    assert monitor.done == dict.fromkeys(("aw", "w", "b", "ar", "r"), 12 * lanes * 15)
    assert registers.writes == registers.reads == 12 * lanes * 15
    assert monitor.early["b"] > 20 and monitor.early["r"] > 20


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def reset_in_the_middle(dut: Any) -> None:
    """A reset at any moment leaves no half access behind; ready is low in it."""
    bus, _, _ = await setup(dut)
    rng = random.Random(3)
    for _ in range(80):
        axil.random_pauses(bus, rng)
        tasks = [
            cocotb.start_soon(bus.write(8, bytes(4))),
            cocotb.start_soon(bus.read(8, 4)),
        ]  # may end as None
        await clocks.tick(dut, rng.randrange(1, 12))
        dut.rst.value = 1
        await clocks.tick(dut)
        for name in ("awready", "wready", "bvalid", "arready", "rvalid"):
            assert int(getattr(dut, f"s_axil_{name}").value) == 0, name
        await clocks.tick(dut, rng.randrange(2))  # a reset of one clock is enough
        for task in tasks:
            task.cancel()
        dut.rst.value = 0
        axil.no_pauses(bus)
        await clocks.tick(dut, 3)
        value = rng.getrandbits(32)
        assert await axil.write(bus, 12, value) == axil.OKAY
        assert await axil.read(bus, 12) == (value, axil.OKAY)


def copies(dut: Any) -> list[tuple[Any, int]]:
    """Every flip-flop of every voted register, as (signal, bit)."""
    registers = (dut.running_register, dut.write_register, dut.read_register)
    signals = [getattr(register, name) for register in registers for name in ("first", "second", "third")]
    return [(signal, bit) for signal in signals for bit in range(len(signal))]


@cocotb.test(timeout_time=5, timeout_unit="ms", skip=netlist.REPLACED)
async def voted_upsets(dut: Any) -> None:
    """One voted flip-flop after the other flips, in every second clock, under traffic: nobody sees it."""
    bus, registers, monitor = await setup(dut, wait_share=0.3)
    rng = random.Random(13)
    words = [0] * WORDS
    flips = 0

    async def flip() -> None:
        nonlocal flips
        places = copies(dut)
        while True:
            rng.shuffle(places)
            for signal, bit in places:
                await FallingEdge(dut.clk)
                signal.value = int(signal.value) ^ 1 << bit
                await clocks.tick(dut, rng.randrange(1, 3))
                flips += 1

    async def writer() -> None:
        for _ in range(25):
            word = rng.randrange(WORDS // 2)
            words[word] = value = rng.getrandbits(32)
            assert await axil.write(bus, 4 * word, value) == axil.OKAY
            assert await axil.write(bus, 4 * WORDS, value) == axil.SLVERR

    async def reader() -> None:
        for _ in range(50):
            word = rng.randrange(WORDS // 2, WORDS)
            assert await axil.read(bus, 4 * word) == (words[word], axil.OKAY)

    for word in range(WORDS):
        words[word] = rng.getrandbits(32)
        assert await axil.write(bus, 4 * word, words[word]) == axil.OKAY
    flipping = cocotb.start_soon(flip())
    for _ in range(8):
        axil.random_pauses(bus, rng)
        await gather(writer(), reader())
    flipping.cancel()
    assert flips > 20 * len(copies(dut))
    assert words == registers.words
    assert monitor.done["b"] == WORDS + 400 and monitor.done["r"] == 400
    assert registers.writes == WORDS + 400 and registers.reads == 400


@cocotb.test(timeout_time=5, timeout_unit="ms", skip=netlist.REPLACED)
async def held_upsets(dut: Any) -> None:
    """A bit of a held write address, or its parity, flips before its use: SLVERR and no access.

    The same of data and strobe: tb/axi/core_registers (here they are ports, which cannot be flipped).
    """
    registers = Registers(dut, 0.0)
    axil.Monitor(dut)
    inputs = ("awaddr", "araddr", "wdata", "wstrb", "awprot", "arprot", "awvalid", "wvalid", "arvalid")
    await clocks.start(dut, **{f"s_axil_{name}": 0 for name in inputs}, s_axil_bready=1, s_axil_rready=1)
    await clocks.tick(dut, 2)
    rng = random.Random(5)
    writes = 0
    for signal in (dut.write_address, dut.write_address_parity):
        for bit in range(len(signal)):
            for spoil in (True, False):
                before = list(registers.words)
                word, value, strobe = rng.randrange(WORDS), rng.getrandbits(32), rng.randrange(1, 16)
                await raw_handshakes(dut, aw={"awaddr": 4 * word}, w={"wdata": value, "wstrb": strobe})
                if spoil:  # in the one clock in which it is held
                    signal.value = int(signal.value) ^ 1 << bit
                    await ReadOnly()
                    assert int(dut.upset.value) == 1 and int(dut.write_valid.value) == 0
                    await FallingEdge(dut.clk)
                while not int(dut.s_axil_bvalid.value):
                    await clocks.tick(dut)
                assert int(dut.s_axil_bresp.value) == (2 if spoil else 0)
                await clocks.tick(dut, 2)
                writes += not spoil
                assert registers.writes == writes
                assert not spoil or registers.words == before
