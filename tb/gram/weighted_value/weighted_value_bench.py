# SPDX-License-Identifier: Apache-2.0
"""Corners and random values, one a clock: the product two clocks later, and its three balanced digits."""

from __future__ import annotations

import os
import random
from itertools import product
from typing import Any

import cocotb

from tb.common.clocks import start, tick
from tb.common.vectors import corners, random_value, to_signed, to_unsigned

LATENCY = 2


@cocotb.test()
async def digits_are_balanced_and_exact(dut: Any) -> None:
    shift = int(os.environ["SHIFT"]) << 15
    rng = random.Random(1)
    inputs = list(product((0, 1, 2, 32767, 32768, 65534, 65535), corners(32)))
    inputs += [(rng.getrandbits(16), random_value(rng, 32)) for _ in range(3000)]
    await start(dut, weight=0, component=0)
    for k, (weight, component) in enumerate(inputs):
        dut.weight.value = weight
        dut.component.value = to_unsigned(component, 32)
        await tick(dut)
        if k + 1 < LATENCY:
            continue
        w, u = inputs[k + 1 - LATENCY]
        biased = int(dut.biased.value)
        v0 = (biased & 0xFFFF) - (1 << 15)
        v1 = to_signed(biased >> 16, 16)
        v2 = to_signed(biased >> 32, 16) + (biased >> 31 & 1)
        assert (v2 << 32) + (v1 << 16) + v0 == w * (u - shift), (w, u)
        assert -(1 << 15) <= v2 < 1 << 15
