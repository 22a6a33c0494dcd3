# SPDX-License-Identifier: Apache-2.0
"""recombine on both simulators."""

from __future__ import annotations

import pytest

from sim.runner import build_and_test, sources


@pytest.mark.parametrize("weighted", [0, 1])
def test_recombine(simulator: str, weighted: int) -> None:
    build_and_test(
        "recombine",
        sources("gram"),
        "recombine_bench",
        simulator=simulator,
        parameters={"WEIGHTED": weighted, "M2_BITS": 96 if weighted else 80},
        env={"WEIGHTED": str(weighted)},
    )
