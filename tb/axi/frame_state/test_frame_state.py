# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

from sim.runner import RTL, build_and_test


@pytest.mark.parametrize(("bits", "verify"), [(5, 1), (11, 1), (5, 0)])
def test_frame_state(simulator: str, bits: int, verify: int) -> None:
    """With a watchdog that random traffic meets, and with the cores'; without the second pass."""
    build_and_test(
        "frame_state",
        [RTL / "axi" / "frame_state.v", RTL / "trust" / "voted_register.v"],
        "frame_state_bench",
        simulator=simulator,
        parameters={"WATCHDOG_BITS": bits, "VERIFY": verify},
        env={"WATCHDOG_BITS": str(bits), "VERIFY": str(verify)},
    )
