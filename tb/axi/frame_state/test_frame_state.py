# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from sim.runner import RTL, build_and_test

WATCHDOG_BITS = 5


def test_frame_state(simulator: str) -> None:
    build_and_test(
        "frame_state",
        [RTL / "axi" / "frame_state.v"],
        "frame_state_bench",
        simulator=simulator,
        parameters={"WATCHDOG_BITS": WATCHDOG_BITS},
        env={"WATCHDOG_BITS": str(WATCHDOG_BITS)},
    )
