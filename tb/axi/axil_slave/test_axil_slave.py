# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from sim.runner import RTL, build_and_test


def test_axil_slave(simulator: str) -> None:
    build_and_test("axil_slave", [RTL / "axi" / "axil_slave.v"], "axil_slave_bench", simulator=simulator)
