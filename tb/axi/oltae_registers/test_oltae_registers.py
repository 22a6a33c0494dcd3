# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

from sim.runner import build_and_test, sources


@pytest.mark.parametrize("full", [1, 0], ids=["full", "lean"])
def test_oltae_registers(simulator: str, full: int) -> None:
    build = {"WEIGHTED": full, "COVARIANCE": full, "REAPPLY": full}
    env = {"CORE": "oltae", "FULL": str(full)}
    build_and_test(
        "oltae_registers",
        sources("axi", "trust"),
        "oltae_registers_bench",
        simulator=simulator,
        parameters=build,
        env=env,
    )
