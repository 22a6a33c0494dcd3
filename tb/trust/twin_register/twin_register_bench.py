# SPDX-License-Identifier: Apache-2.0
"""twin_register: what it holds, and that a flip of any bit of either copy is told of until the next load."""

from __future__ import annotations

import random
from typing import Any

import cocotb
from cocotb.triggers import FallingEdge, ReadOnly

from tb.common import clocks

RESET = 1


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def holds(dut: Any) -> None:
    """Loads, keeps, is reset; the copies never differ by themselves."""
    rng = random.Random(1)
    await clocks.start(dut, d=0, load=0)
    held = RESET
    for _ in range(200):
        assert (int(dut.q.value), int(dut.differ.value)) == (held, 0)
        value, load, reset = rng.getrandbits(len(dut.d)), rng.getrandbits(1), rng.random() < 0.1
        dut.d.value, dut.load.value, dut.rst.value = value, load, int(reset)
        held = RESET if reset else value if load else held
        await FallingEdge(dut.clk)


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def flips(dut: Any) -> None:
    rng = random.Random(2)
    width = len(dut.d)
    await clocks.start(dut, d=0, load=1)
    for copy in (dut.first, dut.second):
        for bit in range(width):
            held = rng.getrandbits(width)
            dut.d.value, dut.load.value = held, 1
            await FallingEdge(dut.clk)
            dut.load.value = 0
            copy.value = held ^ 1 << bit
            for _ in range(3):
                await ReadOnly()
                assert int(dut.differ.value) == 1
                assert int(dut.q.value) == (held ^ 1 << bit if copy is dut.first else held)
                await FallingEdge(dut.clk)
            dut.load.value = 1
            await FallingEdge(dut.clk)
            assert (int(dut.q.value), int(dut.differ.value)) == (held, 0)
