# SPDX-License-Identifier: Apache-2.0
"""centring against its model, and the model against the covariance written as differences."""

from __future__ import annotations

import random
from itertools import product
from pathlib import Path

import pytest
from relnav.model.centring import Centring
from relnav.words import FULL, LEAN, Build

from tb.common.replay import run
from tb.common.vectors import corners, pack, random_value

TAG = 8
Operands = tuple[int, int, int, int]


def limits(words: Build) -> list[Operands]:
    """Every combination of the ends of the ranges."""
    ends = [[0, 1, (1 << words.W) - 1]]
    ends += [[-(1 << (bits - 1)), -1, 0, 1, (1 << (bits - 1)) - 1] for bits in (words.M2, words.M1, words.M1)]
    return [(w, g, i, j) for w, g, i, j in product(*ends)]


def cancellations(words: Build, rng: random.Random, count: int) -> list[Operands]:
    """W G next to m_i m_j: results of 0, +-1, powers of two and small numbers."""
    found: list[Operands] = []
    while len(found) < count:
        first_i, first_j = random_value(rng, words.M1), random_value(rng, words.M1)
        weight = max(1, random_value(rng, words.W, signed=False))
        power = 1 << rng.randrange(60)
        shift = rng.choice([0, 0, 1, -1, random_value(rng, 24), power, -power])
        moment = (first_i * first_j + shift) // weight
        if rng.random() < 0.5:  # exact: m_i m_j a multiple of W
            first_i = first_i // weight * weight
            moment = first_i * first_j // weight + rng.choice([0, 0, 1, -1])
        if -(1 << (words.M2 - 1)) <= moment < 1 << (words.M2 - 1):
            found.append((weight, moment, first_i, first_j))
    return found


def operands(words: Build, rng: random.Random, count: int = 6000) -> list[Operands]:
    """Ends of the ranges, cancellations, other corners, random lengths and random words."""
    first, moment = corners(words.M1), corners(words.M2)
    weight = corners(words.W, signed=False)
    picks: list[Operands] = []
    for _ in range(count):
        picks.append((rng.choice(weight), rng.choice(moment), rng.choice(first), rng.choice(first)))
        w = random_value(rng, words.W, signed=False)
        g, i, j = (random_value(rng, bits) for bits in (words.M2, words.M1, words.M1))
        picks.append((w, g, i, j))
        g, i, j = (rng.getrandbits(bits) - (1 << (bits - 1)) for bits in (words.M2, words.M1, words.M1))
        picks.append((rng.getrandbits(words.W), g, i, j))
    return [*limits(words), *cancellations(words, rng, 4000), *picks]


@pytest.mark.parametrize("words", [LEAN, FULL], ids=["lean", "full"])
def test_centring_matches_the_model(words: Build, simulator: str, tmp_path: Path) -> None:
    rng = random.Random(11)
    model = Centring(words)
    latency = (4 if words is LEAN else 5) + 1  # to the high part
    in_widths = [1, TAG, words.W, words.M2, words.M1, words.M1]
    stimulus, expected = [], []
    for weight, moment, first_i, first_j in operands(words, rng):
        if rng.random() < 0.1:  # a gap, with rubbish on the other inputs
            stimulus.append(rng.getrandbits(sum(in_widths) - 1))
        tag = rng.getrandbits(TAG)
        fields = [1, tag, weight, moment, first_i, first_j]
        centred = model.run(weight, moment, first_i, first_j)
        expected.append((len(stimulus) + latency, [tag, centred % (1 << words.CENTRED)]))
        stimulus.append(pack(zip(fields, in_widths, strict=True)))
    parameters = {"W": words.W, "M1": words.M1, "M2": words.M2, "CENTRED": words.CENTRED, "TAG": TAG}
    parameters |= {"LOW": 48, "LATENCY": 4} if words is LEAN else {"LOW": 64, "LATENCY": 5}
    top = Path(__file__).parent / "centring_replay.v"
    got = run(top, ["gram"], simulator, tmp_path, stimulus, sum(in_widths), [TAG, words.CENTRED], parameters)
    assert len(got) == len(expected)
    for mine, theirs in zip(got, expected, strict=True):
        assert mine == theirs


def test_model_is_the_sum_over_pairs_of_points() -> None:
    """W sum w u v - sum w u sum w v = sum over p < q of w_p w_q (u_p - u_q)(v_p - v_q)."""
    rng = random.Random(12)
    for _ in range(50):
        weights = rng.sample(range(1, 1 << 16), 12)
        points = [(w, random_value(rng, 32), random_value(rng, 32)) for w in weights]
        weight = sum(w for w, _, _ in points)
        first_u, first_v = sum(w * u for w, u, _ in points), sum(w * v for w, _, v in points)
        moment = sum(w * u * v for w, u, v in points)
        pairs = sum(
            wp * wq * (up - uq) * (vp - vq)
            for p, (wp, up, vp) in enumerate(points)
            for wq, uq, vq in points[p + 1 :]
        )
        assert Centring(FULL).run(weight, moment, first_u, first_v) == pairs


def test_model_refuses_words_that_do_not_fit() -> None:
    with pytest.raises(OverflowError, match="weight sum"):
        Centring(LEAN).run(1 << 16, 0, 0, 0)
    with pytest.raises(OverflowError, match="first moment"):
        Centring(LEAN).run(1, 0, 0, 1 << 47)
