# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from sim.runner import build_and_test, sources


def test_axil_slave(simulator: str) -> None:
    build_and_test("axil_slave", sources("axi", "trust"), "axil_slave_bench", simulator=simulator)
