# SPDX-License-Identifier: Apache-2.0
"""AXI4-Lite in benches: the master, random pauses on each channel, a monitor of the protocol's rules."""

from __future__ import annotations

import logging
import random
from collections.abc import Iterator
from typing import Any, ClassVar

import cocotb
from cocotb.triggers import FallingEdge, ReadOnly
from cocotbext.axi import AxiLiteBus, AxiLiteMaster, AxiResp
from cocotbext.axi.axil_channels import AxiLiteAWTransaction, AxiLiteWTransaction

OKAY, SLVERR = AxiResp.OKAY, AxiResp.SLVERR


def master(dut: Any, prefix: str = "s_axil") -> AxiLiteMaster:
    """A quiet AXI4-Lite master on `dut`'s port `prefix`."""
    logging.getLogger(f"cocotb.{dut._name}.{prefix}").setLevel(logging.WARNING)
    return AxiLiteMaster(AxiLiteBus.from_prefix(dut, prefix), dut.clk, dut.rst)


def channels(axil: AxiLiteMaster) -> dict[str, Any]:
    """The five channels by name; each has `pause` and set_pause_generator()."""
    write, read = axil.write_if, axil.read_if
    return {
        "aw": write.aw_channel,
        "w": write.w_channel,
        "b": write.b_channel,
        "ar": read.ar_channel,
        "r": read.r_channel,
    }


def random_pauses(axil: AxiLiteMaster, rng: random.Random) -> None:
    """Idle clocks on AW, W and AR, back-pressure on B and R: each channel has its own share, 0 to 90 %."""

    def pauses(share: float, seed: int) -> Iterator[bool]:
        mine = random.Random(seed)
        while True:
            yield mine.random() < share

    for channel in channels(axil).values():
        channel.set_pause_generator(pauses(rng.choice([0.0, 0.3, 0.6, 0.9]), rng.getrandbits(32)))


def no_pauses(axil: AxiLiteMaster) -> None:
    """End every pause."""
    for channel in channels(axil).values():
        channel.clear_pause_generator()
        channel.pause = False


async def write(axil: AxiLiteMaster, address: int, value: int, strobe: int = 0xF) -> AxiResp:
    """Write one word; returns the response.

    A strobe other than 0xF goes past the master's queue, which would put the byte's own address on the bus.
    It must not run together with another write.
    """
    if strobe == 0xF:
        return (await axil.write(address, value.to_bytes(4, "little"))).resp
    bus = axil.write_if
    await bus.aw_channel.send(AxiLiteAWTransaction(awaddr=address, awprot=0))
    await bus.w_channel.send(AxiLiteWTransaction(wdata=value, wstrb=strobe))
    return AxiResp(int((await bus.b_channel.recv()).bresp))


async def read(axil: AxiLiteMaster, address: int) -> tuple[int, AxiResp]:
    """Read one word; returns it and the response."""
    answer = await axil.read(address, 4)
    return int.from_bytes(answer.data, "little"), answer.resp


class Monitor:
    """Watches all five channels of a slave and fails the test on a broken rule.

    A valid stays, and its payload is the same, until ready; the slave's outputs are never x outside reset; no
    answer comes without its address (and data). Counts handshakes in `done` and, in `early`, the answers that
    rose with ready low.
    """

    PAYLOAD: ClassVar[dict[str, tuple[str, ...]]] = {
        "aw": ("awaddr",),
        "w": ("wdata", "wstrb"),
        "b": ("bresp",),
        "ar": ("araddr",),
        "r": ("rdata", "rresp"),
    }

    def __init__(self, dut: Any, prefix: str = "s_axil") -> None:
        self.dut = dut
        self.prefix = prefix
        self.done = dict.fromkeys(self.PAYLOAD, 0)
        self.early = {"b": 0, "r": 0}
        cocotb.start_soon(self._run())

    def _signal(self, name: str) -> Any:
        return getattr(self.dut, f"{self.prefix}_{name}")

    async def _run(self) -> None:
        waiting: dict[str, tuple[int, ...]] = {}
        while True:
            await FallingEdge(self.dut.clk)
            await ReadOnly()  # what the next rising edge will see, whoever drove it at this falling one
            if int(self.dut.rst.value):
                waiting.clear()
                self.done = dict.fromkeys(self.PAYLOAD, 0)
                continue
            for channel, payload in self.PAYLOAD.items():
                valid = int(self._signal(f"{channel}valid").value)
                ready = int(self._signal(f"{channel}ready").value)
                held = waiting.pop(channel, None)
                if not valid:
                    assert held is None, f"{channel}valid fell before {channel}ready"
                    continue
                now = tuple(int(self._signal(name).value) for name in payload)
                assert held is None or now == held, (
                    f"{channel} changed from {held} to {now} before {channel}ready"
                )
                if channel == "b":
                    assert self.done["b"] < min(self.done["aw"], self.done["w"]), "bvalid without a write"
                if channel == "r":
                    assert self.done["r"] < self.done["ar"], "rvalid without a read"
                if ready:
                    self.done[channel] += 1
                else:
                    waiting[channel] = now
                    if channel in self.early and held is None:
                        self.early[channel] += 1
