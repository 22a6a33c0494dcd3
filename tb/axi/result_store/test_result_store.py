# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from sim.runner import RTL, build_and_test


def test_result_store(simulator: str) -> None:
    build_and_test(
        "result_store", [RTL / "axi" / "result_store.v"], "result_store_bench", simulator=simulator
    )
