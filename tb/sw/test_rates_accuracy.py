# SPDX-License-Identifier: Apache-2.0
"""Bounds on errors and refusals of `python -m bench.rates`, with fewer trials a cell."""

from __future__ import annotations

from typing import Any

import pytest
from relnav.words import LARGEST_CONDITION

from bench import rates
from bench.rate_cases import RINGS

TRIALS = 10


@pytest.fixture(scope="module")
def cells() -> list[dict[str, Any]]:
    return rates.rings(TRIALS, processes=1)


def test_driven_and_idle_channels_keep_the_bound(cells: list[dict[str, Any]]) -> None:
    assert sum(cell["frames"] for cell in cells) == TRIALS * len(RINGS) * 9 * 2
    for cell in cells:
        for channel in ("v_z", "omega_z", "idle"):
            assert cell[channel] is None or cell[channel] <= rates.BOUND, (cell, channel)


def test_within_the_condition_all_are_solved(cells: list[dict[str, Any]]) -> None:
    for cell in cells:
        assert cell["weighted"] or cell["refused_within"] == 0, cell
        assert cell["refused"] < TRIALS or cell["cond"][0] > LARGEST_CONDITION, cell


def test_beyond_it_all_are_refused(cells: list[dict[str, Any]]) -> None:
    assert any(cell["refused"] for cell in cells)
    for cell in cells:
        assert cell["solved_beyond"] == 0, cell
        assert cell["refused_by"]["pivot"] == 0, cell


def test_rss_of_rows_without_noise_is_none_of_it(cells: list[dict[str, Any]]) -> None:
    assert all(0.0 <= cell["rss_floor"] < 1e-13 for cell in cells if cell["rss_floor"] is not None)
