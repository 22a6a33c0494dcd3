# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

from sim.runner import RTL, build_and_test


@pytest.mark.parametrize(("middle", "last"), [(3, 18), (6, 6)], ids=["three-groups", "two-groups"])
def test_result_store(simulator: str, middle: int, last: int) -> None:
    bounds = {"MIDDLE_FIRST": middle, "LAST_FIRST": last}
    build_and_test(
        "result_store",
        [RTL / "axi" / "result_store.v", RTL / "trust" / "voted_register.v"],
        "result_store_bench",
        simulator=simulator,
        parameters=bounds,
        env={name: str(value) for name, value in bounds.items()},
    )
