# SPDX-License-Identifier: Apache-2.0
"""weighted_value on both simulators."""

from __future__ import annotations

from sim.runner import build_and_test, sources


def test_weighted_value(simulator: str) -> None:
    build_and_test("weighted_value", sources("gram"), "weighted_value_bench", simulator=simulator)
