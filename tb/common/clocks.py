# SPDX-License-Identifier: Apache-2.0
"""Clock and reset of a bench: 10 ns, inputs are driven and outputs read at the falling edge."""

from __future__ import annotations

from typing import Any

from cocotb.clock import Clock
from cocotb.triggers import ClockCycles, FallingEdge

PERIOD_NS = 10


async def start(dut: Any, cycles: int = 3, **inputs: int) -> None:
    """Start `clk`, set the named `inputs`, hold `rst` (if there is one); returns at a falling edge."""
    for name, value in inputs.items():
        getattr(dut, name).value = value
    Clock(dut.clk, PERIOD_NS, "ns").start()
    if hasattr(dut, "rst"):
        dut.rst.value = 1
        await ClockCycles(dut.clk, cycles)
    await FallingEdge(dut.clk)
    if hasattr(dut, "rst"):
        dut.rst.value = 0


async def reset(dut: Any, cycles: int = 2) -> None:
    """Reset again, with the clock running; returns at a falling edge."""
    dut.rst.value = 1
    await ClockCycles(dut.clk, cycles)
    await FallingEdge(dut.clk)
    dut.rst.value = 0


async def tick(dut: Any, cycles: int = 1) -> None:
    """Go on to the falling edge `cycles` clocks later."""
    for _ in range(cycles):
        await FallingEdge(dut.clk)
