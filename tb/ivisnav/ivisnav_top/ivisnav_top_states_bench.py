# SPDX-License-Identifier: Apache-2.0
"""ivisnav_top through its ports: the state machine, the interrupt, and a soft reset in every state."""

from __future__ import annotations

import os
from typing import Any

import cocotb

from tb.common import core_tests
from tb.ivisnav.environment import Bench

STEP = int(os.environ.get("STEP", "7"))  # clocks of COMPUTE between two resets


@cocotb.test()
async def states_acknowledge_and_interrupt(dut: Any) -> None:
    await core_tests.states_acknowledge_and_interrupt(await Bench(dut, 4).begin())


@cocotb.test()
async def soft_reset_in_every_state(dut: Any) -> None:
    await core_tests.soft_reset_in_every_state(await Bench(dut, 5).begin(), STEP)
