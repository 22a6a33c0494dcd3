# SPDX-License-Identifier: Apache-2.0
"""`relnav.driver.Bus` inside a simulation. Its calls block: make them from a thread (cocotb.task.bridge)."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from cocotb.task import resume
from cocotb.triggers import FallingEdge, SimTimeoutError, Timer, ValueChange, with_timeout
from cocotbext.axi import AxiLiteBus, AxiLiteMaster, AxiResp

from relnav.errors import BackendError

PERIOD_NS = 10
BEATS = Path("beats.hex")  # the harness's default, in the run's folder
ANSWER_US = 100  # an access that takes longer will not end
IDLE_CLOCKS = 32  # between two looks at the core
BEAT_CLOCKS = 20  # a frame of which a beat takes longer on average will not end


class RegisterBus:
    """The registers, by the AXI4-Lite port s_axil_* of `dut`. Subclasses add `stream`."""

    def __init__(self, dut: Any) -> None:
        self.dut = dut
        logging.getLogger(f"cocotb.{dut._name}.s_axil").setLevel(logging.WARNING)
        self.axil = AxiLiteMaster(AxiLiteBus.from_prefix(dut, "s_axil"), dut.clk, dut.rst)

    @resume
    async def read(self, address: int) -> int:
        """A register's word."""
        answer = await self._answer(self.axil.read(address, 4), f"read of 0x{address:03x}")
        return int.from_bytes(answer.data, "little")

    @resume
    async def write(self, address: int, value: int) -> None:
        """Write a register's word."""
        await self._answer(self.axil.write(address, value.to_bytes(4, "little")), f"write to 0x{address:03x}")

    @resume
    async def idle(self) -> None:
        """Let the core work; much cheaper than to look at it again and again."""
        await Timer(IDLE_CLOCKS * PERIOD_NS, "ns")

    async def _answer(self, access: Any, what: str) -> Any:
        try:
            answer = await with_timeout(access, ANSWER_US, "us")
        except SimTimeoutError:
            raise BackendError(f"the core does not answer the {what}") from None
        if answer.resp != AxiResp.OKAY:
            raise BackendError(f"the core answers the {what} with {answer.resp.name}")
        return answer


class HarnessBus(RegisterBus):
    """The registers and the stream source of sim/core_harness.v."""

    @resume
    async def stream(self, beats: Sequence[int]) -> None:
        """Play the beats through the source; returns when the last one is taken."""
        lines = [f"{beat:017x}\n" for beat in (*beats[:-1], beats[-1] | 1 << 64)]
        BEATS.write_text("".join(lines))
        await FallingEdge(self.dut.clk)
        self.dut.go.value = not int(self.dut.go.value)
        limit = BEAT_CLOCKS * PERIOD_NS * (len(beats) + 100)
        try:
            await with_timeout(ValueChange(self.dut.sent), limit, "ns")
        except SimTimeoutError:
            raise BackendError("the core does not take the stream's beats") from None
