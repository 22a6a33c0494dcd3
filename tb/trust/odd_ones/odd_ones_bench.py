# SPDX-License-Identifier: Apache-2.0
"""odd_ones against Python's count of ones."""

from __future__ import annotations

import random
from typing import Any

import cocotb
from cocotb.triggers import Timer


@cocotb.test()
async def parity(dut: Any) -> None:
    """Every bit alone, all bits, none, and any."""
    rng = random.Random(1)
    width = len(dut.bits)
    values = [0, (1 << width) - 1, *(1 << bit for bit in range(width))]
    for value in [*values, *(rng.getrandbits(width) for _ in range(300))]:
        dut.bits.value = value
        await Timer(1, "ns")
        assert int(dut.odd.value) == value.bit_count() % 2, f"{value:x}"
