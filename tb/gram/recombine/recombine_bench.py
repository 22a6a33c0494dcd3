# SPDX-License-Identifier: Apache-2.0
"""Limb sums of true moments, one a clock, `both` wrapped as in a DSP: the moment is exact 3 clocks later."""

from __future__ import annotations

import os
import random
from typing import Any

import cocotb

from tb.common.clocks import start, tick
from tb.common.vectors import corners, random_value, to_signed, to_unsigned

LATENCY = 3


@cocotb.test()
async def moments_are_exact(dut: Any) -> None:
    weighted = int(os.environ["WEIGHTED"])
    m2 = 96 if weighted else 80
    rng = random.Random(1)
    # Bounds of the sums of 65535 products; a weighted high sum takes two products a point.
    edge = 65535 << 30
    bounds = (edge * (1 + weighted), edge, 2 * edge, edge * weighted)
    await start(dut, with_top=weighted, high=0, low=0, both=0, top=0)
    want: list[int] = []
    for _ in range(4000):
        high, low, middle, top = (
            max(-b, min(b, rng.choice((-b, b, rng.choice(corners(48)), random_value(rng, 48)))))
            for b in bounds
        )
        for name, value in (("high", high), ("low", low), ("both", middle + high + low), ("top", top)):
            getattr(dut, name).value = to_unsigned(value & ((1 << 48) - 1), 48)
        want.append((top << 48) + (high << 32) + (middle << 16) + low)
        await tick(dut)
        if len(want) >= LATENCY:
            expected = want[len(want) - LATENCY]
            assert to_signed(int(dut.moment.value), m2) == to_signed(expected, m2) == expected
