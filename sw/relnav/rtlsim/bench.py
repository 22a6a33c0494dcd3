# SPDX-License-Identifier: Apache-2.0
"""Runs inside the simulator: the driver, in a thread, on the harness's AXI4-Lite port and stream source."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import cocotb
from cocotb.clock import Clock
from cocotb.task import bridge, resume
from cocotb.triggers import ClockCycles, FallingEdge, RisingEdge, ValueChange

from relnav.driver import OltaeDriver
from relnav.errors import RelnavError
from relnav.model.raw import RawResult

from . import job

PERIOD_NS = 10
BEATS = "beats.hex"  # the harness's default, in the run's folder
ANSWER = 1000  # clocks after which a bus that does not answer is given up


class BusError(RelnavError):
    """The core's AXI4-Lite port refused an access or does not answer."""


class AxiLite:
    """One access at a time on an AXI4-Lite port, signals named `prefix`_*; Python wakes only at the handshakes."""

    def __init__(self, dut: Any, prefix: str = "s_axil") -> None:
        self.dut = dut
        self.prefix = prefix
        for name in ("awprot", "awvalid", "wvalid", "arprot", "arvalid", "bready", "rready"):
            self._signal(name).value = 0
        self._signal("wstrb").value = 15

    def _signal(self, name: str) -> Any:
        return getattr(self.dut, f"{self.prefix}_{name}")

    async def _take(self, channel: str) -> None:
        """Hold `channel`'s signal of ours until the clock edge of its handshake; returns after it."""
        ours, theirs = ("valid", "ready") if channel in ("aw", "w", "ar") else ("ready", "valid")
        self._signal(channel + ours).value = 1
        for _ in range(ANSWER):
            await FallingEdge(self.dut.clk)
            if self._signal(channel + theirs).value == 1:
                break
        else:
            raise BusError(f"{self.prefix}_{channel}{theirs} did not rise in {ANSWER} clocks")

    async def write(self, address: int, value: int) -> None:
        """Write a word."""
        self._signal("awaddr").value, self._signal("wdata").value = address, value
        await cocotb.triggers.gather(self._take("aw"), self._take("w"))
