# SPDX-License-Identifier: Apache-2.0
"""The Gram array's model against the definition, and what it refuses."""

from __future__ import annotations

import random

import pytest
from relnav.model.gram import DRAIN_ORDER, GramArray, exact_moments, pair_components

from tb.common.vectors import corners, random_value


def test_every_pair_comes_once() -> None:
    pairs = {tuple(sorted(pair_components(slot, lane))) for slot, lane in DRAIN_ORDER}
    assert pairs == {(i, j) for i in range(6) for j in range(i, 6)}


@pytest.mark.parametrize("weighted", [False, True])
@pytest.mark.parametrize("seed", range(8))
def test_model_is_exact(weighted: bool, seed: int) -> None:
    rng = random.Random(seed)

    def vector() -> list[int]:
        return [rng.choice((random_value(rng, 32), rng.choice(corners(32)))) for _ in range(3)]

    n = rng.choice((1, 3, 50, 400))
    a, b = [vector() for _ in range(n)], [vector() for _ in range(n)]
    w = [rng.choice((0, 1, 65535, rng.getrandbits(16))) for _ in range(n)] if weighted else None
    model = GramArray(weighted)
    cut = n // 2
    model.add(a[:cut], b[:cut], None if w is None else w[:cut])
    model.add(a[cut:], b[cut:], None if w is None else w[cut:])
    second, first, weight = exact_moments(a, b, w)
    assert (model.weight_sum, model.point_count) == (weight, n)
    for pair in model.drain():
        i, j = pair_components(pair.slot, pair.lane)
        assert (pair.moment, pair.first_i, pair.first_j) == (second[i][j], first[i], first[j])


def test_refusals() -> None:
    lean = GramArray(weighted_build=False)
    with pytest.raises(ValueError, match="no weights"):
        lean.add([[0, 0, 0]], [[0, 0, 0]], [1])
    with pytest.raises(ValueError, match="32 bits"):
        lean.add([[1 << 31, 0, 0]], [[0, 0, 0]])
    with pytest.raises(ValueError, match="65535"):
        lean.add([[0, 0, 0]] * 65536, [[0, 0, 0]] * 65536)
    with pytest.raises(ValueError, match="16 bits"):
        GramArray().add([[0, 0, 0]], [[0, 0, 0]], [65536])
