# SPDX-License-Identifier: Apache-2.0
"""voted_register while its copies are flipped, one a clock at most: the output never shows it."""

from __future__ import annotations

import random
from typing import Any

import cocotb
from cocotb.triggers import FallingEdge, ReadOnly

from tb.common import clocks

RESET = 1


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def one_copy(dut: Any) -> None:
    """Every bit of every copy, and any bits of one copy at once; right again in the next clock."""
    rng = random.Random(1)
    width = len(dut.d)
    copies = (dut.first, dut.second, dut.third)
    await clocks.start(dut, d=0)
    assert int(dut.q.value) == RESET
    flips = [(copy, 1 << bit) for copy in copies for bit in range(width)] * 4
    flips += [(rng.choice(copies), rng.getrandbits(width)) for _ in range(200)]
    rng.shuffle(flips)
    held = RESET
    for copy, mask in flips:
        copy.value = held ^ mask
        following = rng.getrandbits(width)
        dut.d.value = following
        await ReadOnly()
        assert int(copy.value) == held ^ mask
        assert int(dut.q.value) == held
        await FallingEdge(dut.clk)
        assert [int(each.value) for each in copies] == [following] * 3
        assert int(dut.q.value) == following
        held = following


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def majority(dut: Any) -> None:
    """Every state of the copies of a bit: the majority of them; two that are wrong win."""
    width = len(dut.d)
    await clocks.start(dut, d=0)
    for state in range(8):
        bits = [state >> place & 1 for place in range(3)]
        for bit in range(width):
            for copy, value in zip((dut.first, dut.second, dut.third), bits, strict=True):
                copy.value = value << bit
            await ReadOnly()
            assert int(dut.q.value) == (sum(bits) >= 2) << bit
            await FallingEdge(dut.clk)


@cocotb.test(timeout_time=1, timeout_unit="ms")
async def reset(dut: Any) -> None:
    """Reset goes before d, in every copy."""
    await clocks.start(dut, d=0)
    await clocks.tick(dut)
    assert int(dut.q.value) == 0
    dut.rst.value = 1
    await clocks.tick(dut)
    assert int(dut.q.value) == RESET
    assert [int(each.value) for each in (dut.first, dut.second, dut.third)] == [RESET] * 3
    dut.rst.value = 0
    await clocks.tick(dut)
    assert int(dut.q.value) == 0
