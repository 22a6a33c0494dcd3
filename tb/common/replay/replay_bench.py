# SPDX-License-Identifier: Apache-2.0
"""Run a replay wrapper to its end: clock, reset, wait."""

from __future__ import annotations

from typing import Any

import cocotb
from cocotb.triggers import RisingEdge

from tb.common.clocks import start


@cocotb.test()
async def replay(dut: Any) -> None:
    await start(dut)
    await RisingEdge(dut.done)
