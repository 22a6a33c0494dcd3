# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

from sim.runner import RTL, build_and_test


@pytest.mark.parametrize(("record", "verify"), [(50, 1), (80, 0)])
def test_core_upsets(simulator: str, record: int, verify: int) -> None:
    """With OLTAE's record, and without the second pass."""
    values = {"RECORD": record, "VERIFY": verify}
    build_and_test(
        "core_upsets",
        [RTL / "axi" / "core_upsets.v"],
        "core_upsets_bench",
        simulator=simulator,
        parameters=values,
        env={name: str(value) for name, value in values.items()},
    )
