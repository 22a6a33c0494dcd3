# SPDX-License-Identifier: Apache-2.0
"""Counts along with the counter; fails or hangs when the test of the runner asks for it."""

import os
from typing import Any

import cocotb

from tb.common.clocks import start, tick


@cocotb.test()
async def counts(dut: Any) -> None:
    await start(dut)
    for expected in range(40):
        assert int(dut.count.value) == expected % (1 << int(os.environ.get("WIDTH", "4")))
        await tick(dut)


@cocotb.test(skip="FAIL" not in os.environ)
async def fails(dut: Any) -> None:
    await start(dut)
    assert int(dut.count.value) == 13


@cocotb.test(skip="HANG" not in os.environ)
async def hangs(dut: Any) -> None:
    await start(dut)
    while True:
        await tick(dut)
