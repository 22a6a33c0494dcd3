# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

from sim.runner import RTL, build_and_test

SOURCES = [RTL / "axi" / "frame_loader.v"]


@pytest.mark.parametrize("weighted", [1, 0])
def test_frame_loader(simulator: str, weighted: int) -> None:
    parameters = {"WEIGHTED": weighted}
    env = {"WEIGHTED": str(weighted)}
    tests = ["random_frames", "every_error", "resets", "priority"]
    if simulator == "verilator" or weighted:  # 65535 points for real: 10 s on Icarus
        tests.append("longest_frames")
    build_and_test(
        "frame_loader",
        SOURCES,
        "frame_loader_bench",
        simulator=simulator,
        parameters=parameters,
        testcase=tests,
        env=env,
    )
