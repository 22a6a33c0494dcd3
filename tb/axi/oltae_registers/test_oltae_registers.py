# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import pytest

from sim.runner import RTL, build_and_test

SOURCES = [RTL / "axi" / name for name in ("oltae_registers.v", "axil_slave.v")]


@pytest.mark.parametrize("full", [1, 0], ids=["full", "lean"])
def test_oltae_registers(simulator: str, full: int) -> None:
    build = {"WEIGHTED": full, "COVARIANCE": full, "REAPPLY": full}
    env = {"FULL": str(full)}
    build_and_test(
        "oltae_registers", SOURCES, "oltae_registers_bench", simulator=simulator, parameters=build, env=env
    )
