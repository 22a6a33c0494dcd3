# SPDX-License-Identifier: Apache-2.0
"""Clocks the player until it has read its stimulus; the pytest side compares the files.

With FLIPS set it flips registers on the way (tb/common/flips.py).
"""

from __future__ import annotations

import os
from typing import Any

import cocotb
from cocotb.clock import Clock
from cocotb.triggers import RisingEdge

from tb.common.flips import flips


@cocotb.test()
async def play(dut: Any) -> None:
    Clock(dut.clk, 10, "ns").start()
    if "FLIPS" in os.environ:
        await flips(dut)
    else:
        await RisingEdge(dut.done)
