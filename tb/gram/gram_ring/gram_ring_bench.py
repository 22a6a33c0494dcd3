# SPDX-License-Identifier: Apache-2.0
"""Clocks the player until it has read its stimulus; the pytest side compares the files."""

from __future__ import annotations

from typing import Any

import cocotb
from cocotb.clock import Clock
from cocotb.triggers import RisingEdge


@cocotb.test()
async def play(dut: Any) -> None:
    Clock(dut.clk, 10, "ns").start()
    await RisingEdge(dut.done)
