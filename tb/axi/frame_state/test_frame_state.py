# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

from sim.runner import RTL, build_and_test


@pytest.mark.parametrize("bits", [5, 11])
def test_frame_state(simulator: str, bits: int) -> None:
    """With a watchdog that random traffic meets, and with the cores'."""
    build_and_test(
        "frame_state",
        [RTL / "axi" / "frame_state.v"],
        "frame_state_bench",
        simulator=simulator,
        parameters={"WATCHDOG_BITS": bits},
        env={"WATCHDOG_BITS": str(bits)},
    )
