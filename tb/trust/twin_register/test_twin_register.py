# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

from sim.runner import build_and_test, sources


@pytest.mark.parametrize("width", [1, 7])
def test_twin_register(simulator: str, width: int) -> None:
    build_and_test(
        "twin_register",
        sources("trust"),
        "twin_register_bench",
        simulator=simulator,
        parameters={"WIDTH": width, "RESET": 1},
    )
