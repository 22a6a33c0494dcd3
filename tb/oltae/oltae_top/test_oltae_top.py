# SPDX-License-Identifier: Apache-2.0
"""oltae_top, full and lean, on both simulators: benches at its ports, and bulk frames through the product's own path."""

from __future__ import annotations

import pytest

from sim.runner import build_and_test, sources

BUILDS = {
    "full": {"WEIGHTED": 1, "COVARIANCE": 1, "REAPPLY": 1},
    "lean": {"WEIGHTED": 0, "COVARIANCE": 0, "REAPPLY": 0},
}


@pytest.mark.parametrize("build", BUILDS)
def test_oltae_top(build: str, simulator: str) -> None:
    build_and_test(
        "oltae_top",
        sources(),
        "oltae_top_bench",
        simulator=simulator,
        parameters=BUILDS[build],
        env={"FULL": str(int(build == "full")), "FRAMES": "60" if simulator == "verilator" else "30"},
    )
