# SPDX-License-Identifier: Apache-2.0
"""core_registers inside the register file of each core: the map of each, with every port that it has."""

from __future__ import annotations

import pytest

from sim.runner import build_and_test, sources

BUILDS = {
    "oltae": {"WEIGHTED": 1, "COVARIANCE": 1, "REAPPLY": 1},
    "lean": {"WEIGHTED": 0, "COVARIANCE": 0, "REAPPLY": 0},
    "ivisnav": {"MANTISSA": 24},
}


@pytest.mark.parametrize("build", BUILDS)
def test_core_registers(simulator: str, build: str) -> None:
    core = "ivisnav" if build == "ivisnav" else "oltae"
    build_and_test(
        f"{core}_registers",
        sources("axi", "trust"),
        "core_registers_bench",
        simulator=simulator,
        parameters=BUILDS[build],
        env={"CORE": core, "FULL": str(int(build != "lean"))},
    )
