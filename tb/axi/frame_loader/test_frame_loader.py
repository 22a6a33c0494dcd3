# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

from sim.runner import build_and_test, sources

BUILDS = {
    "weight-in-front": {"BEATS": 3, "LEAST": 3, "WEIGHTED": 1},
    "no-weight": {"BEATS": 3, "LEAST": 3, "WEIGHTED": 0},
    "weight-inside": {"BEATS": 4, "LEAST": 6, "WEIGHTED": 2},
}


@pytest.mark.parametrize("build", BUILDS)
def test_frame_loader(simulator: str, build: str) -> None:
    tests = ["random_frames", "every_error", "resets", "aborts", "priority"]
    if build == "weight-in-front":
        tests.append("weight_upset")
    if simulator == "verilator" or build == "weight-in-front":  # 65535 rows for real: 10 s on Icarus
        tests.append("longest_frames")
    build_and_test(
        "frame_loader",
        sources("axi", "trust"),
        "frame_loader_bench",
        simulator=simulator,
        parameters=BUILDS[build],
        testcase=tests,
        env={name: str(value) for name, value in BUILDS[build].items()},
    )
