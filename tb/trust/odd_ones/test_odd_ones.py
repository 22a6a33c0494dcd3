# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

from sim.runner import build_and_test, sources


@pytest.mark.parametrize("width", [1, 6, 7, 36, 37, 80, 216])
def test_odd_ones(simulator: str, width: int) -> None:
    build_and_test(
        "odd_ones",
        sources("trust"),
        "odd_ones_bench",
        simulator=simulator,
        parameters={"WIDTH": width},
    )
