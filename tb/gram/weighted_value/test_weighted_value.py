# SPDX-License-Identifier: Apache-2.0
"""weighted_value on both simulators."""

from __future__ import annotations

import pytest

from sim.runner import build_and_test, sources


@pytest.mark.parametrize("shift", [1, 0])
def test_weighted_value(simulator: str, shift: int) -> None:
    build_and_test(
        "weighted_value",
        sources("gram"),
        "weighted_value_bench",
        simulator=simulator,
        parameters={"SHIFT": shift},
        env={"SHIFT": str(shift)},
    )
