# SPDX-License-Identifier: Apache-2.0
"""A clock for soak_harness until it is done; everything else is in files."""

from __future__ import annotations

from typing import Any

import cocotb
from cocotb.clock import Clock
from cocotb.triggers import RisingEdge

from tb.common.clocks import PERIOD_NS


@cocotb.test()
async def soak(dut: Any) -> None:
    Clock(dut.clk, PERIOD_NS, "ns").start()
    await RisingEdge(dut.done)
