# SPDX-License-Identifier: Apache-2.0
"""Bit-exact model of rtl/gram/gram_array.v: first and second moments of a frame, in its own digits.

`GramArray` mirrors 16-bit limbs, Karatsuba sums modulo 2^48 and the two passes of a weighted point;
`exact_moments` is the definition in Python integers, to check it against: G = sum w u u^T, nothing rounded.
The centroids of OLTAE's Eq. 11 and the sums of its Eqs. 20-25 are centred combinations of these.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from relnav import words

Integers = NDArray[np.int64]

LANES = 7
SLOTS = 3
A, B = 0, 1
#: (component of beat i, is the other of beat j?, component of it) of each lane: hardware drain order
TAPS = ((A, 0, A), (B, 0, B), (A, 0, B), (A, 1, A), (B, 1, B), (B, 1, A), (A, 1, B))


def pair_components(slot: int, lane: int) -> tuple[int, int]:
    """Indices into c0..c5 = ax bx ay by az bz of the two components of a drained pair."""
    first, other, second = TAPS[lane]
    return 2 * slot + first, 2 * ((slot + other) % SLOTS) + second


#: every (slot, lane), in the order of the drain
DRAIN_ORDER = (
    *((slot, lane) for slot in (0, 1, 2) for lane in (0, 1, 2)),
    *((slot, lane) for slot in (0, 2, 1) for lane in (3, 4, 5, 6)),
)

#: components i and j of the pairs, in that order
FIRST, SECOND = (list(c) for c in zip(*(pair_components(*key) for key in DRAIN_ORDER), strict=True))
BLOCK = 4096  # points summed at a time


@dataclass(frozen=True)
class Pair:
    """One drained moment G_ij and the first moments m' of its components, of inputs shifted by -2^15."""

    slot: int
    lane: int
    moment: int
    first_i: int
    first_j: int

    @property
    def last(self) -> bool:
        """The 21st of a frame."""
        return (self.slot, self.lane) == DRAIN_ORDER[-1]


def wrap(value: int, bits: int = words.SUM) -> int:
    """The signed number of `bits` bits that is equal to value modulo 2^bits."""
    value &= (1 << bits) - 1
    return value - (1 << bits) if value >> (bits - 1) else value


def split(value: Integers) -> tuple[Integers, Integers]:
    """(high, low) with value = high 2^16 + low and low in -2^15 .. 2^15 - 1, the balanced digit."""
    low = ((value + words.SHIFT) & 0xFFFF) - words.SHIFT
    return (value - low) >> words.LIMB, low


class GramArray:
    """Sums of one frame. `add` points, then `drain`; `clear` starts the next frame.

    Every limb sum is a 48-bit word that wraps as a DSP's does; results are Python integers.
    """

    def __init__(self, weighted_build: bool = True) -> None:
        self.weighted_build = weighted_build
        self.words = words.build(weighted_build)
        self.clear()

    def clear(self) -> None:
        """Zero every sum."""
        self.weight_sum = 0
        self.point_count = 0
        self.used_count = 0  # points whose weight is not 0
        self._first = [0] * 6
        # limb sums of each pair: high, low, both, and low's second set
        self._sums = {key: [0, 0, 0, 0] for key in DRAIN_ORDER}

    def add(self, a: ArrayLike, b: ArrayLike, w: ArrayLike | None = None) -> None:
        """Add points: a, b (n, 3) signed 32-bit integers, w (n,) in 0..65535 or None (unweighted frame).

        Raises ValueError for values the ports cannot carry or more than 65535 points.
        """
        points = np.stack(
            [np.asarray(a, np.int64).reshape(-1, 3), np.asarray(b, np.int64).reshape(-1, 3)], axis=2
        )
        n = len(points)
        if n and not (points.min() >= -(1 << 31) and points.max() < 1 << 31):
            raise ValueError("a component does not fit 32 bits")
        if w is not None and not self.weighted_build:
            raise ValueError("the lean build takes no weights")
        weights = np.ones(n, np.int64) if w is None else np.asarray(w, np.int64).reshape(n)
        if n and not (weights.min() >= 0 and weights.max() < 1 << words.WEIGHT):
            raise ValueError("a weight does not fit 16 bits")
        self.point_count += n
        self.used_count += int(np.count_nonzero(weights))
        if self.point_count >= 1 << words.COUNT:
            raise ValueError("a frame has at most 65535 points")
        self.weight_sum += int(weights.sum())

        components = points.reshape(n, 6) - words.SHIFT  # ax bx ay by az bz, shifted
        high, low = split(components)
        values = components * weights[:, None]  # below 2^47
        rest, v0 = split(values)
        v2, v1 = split(rest)
        for c in range(6):
            # 65535 values of up to 2^47 each: sum the upper and the lower halves apart, in 64 bits both.
            self._first[c] += (int((values[:, c] >> 24).sum()) << 24) + int((values[:, c] & 0xFFFFFF).sum())
        for start in range(0, n, BLOCK):
            block = slice(start, start + BLOCK)
            w0, w1, w2 = v0[block][:, FIRST], v1[block][:, FIRST], v2[block][:, FIRST]
            h, lo = high[block][:, SECOND], low[block][:, SECOND]
            # numpy's 64 bits hold 65535 products of up to 2^33
            upper = w2 * lo
            products = (w1 * h + upper, w0 * lo, (w1 + w0) * (h + lo) + upper, w2 * h)
            totals = np.stack([product.sum(axis=0) for product in products], axis=1).tolist()
            for key, total in zip(DRAIN_ORDER, totals, strict=True):
                sums = self._sums[key]
                for k, value in enumerate(total):
                    sums[k] = wrap(sums[k] + value)

    @property
    def first_moments(self) -> list[int]:
        """m'_0..m'_5 of the shifted components ax bx ay by az bz."""
        return [wrap(m, self.words.M1) for m in self._first]

    def moment(self, slot: int, lane: int) -> int:
        """One second moment from its limb sums, as rtl/gram/recombine.v makes it."""
        high, low, both, top = self._sums[slot, lane]
        middle = wrap(wrap(both - high) + wrap((low >> 16) - low))
        upper = (top << 16) + high + (middle >> 16)
        return wrap((upper << 32) + ((middle & 0xFFFF) << 16) + (low & 0xFFFF), self.words.M2)

    def drain(self) -> Iterator[Pair]:
        """The 21 pairs in the order of the hardware; repeatable."""
        first = self.first_moments
        for slot, lane in DRAIN_ORDER:
            i, j = pair_components(slot, lane)
            yield Pair(slot, lane, self.moment(slot, lane), first[i], first[j])


def exact_moments(
    a: Sequence[Sequence[int]], b: Sequence[Sequence[int]], w: Sequence[int] | None = None
) -> tuple[list[list[int]], list[int], int]:
    """(G, m, W) by definition: sum w u u^T (6, 6), sum w u (6,), sum w of u = (ax bx ay by az bz) - 2^15."""
    points = [
        [int(v) - words.SHIFT for pair in zip(p, q, strict=True) for v in pair]
        for p, q in zip(a, b, strict=True)
    ]
    weights = [1] * len(points) if w is None else [int(v) for v in w]
    second = [[0] * 6 for _ in range(6)]
    for i in range(6):
        for j in range(i, 6):
            second[i][j] = second[j][i] = sum(k * u[i] * u[j] for u, k in zip(points, weights, strict=True))
    first = [sum(k * u[i] for u, k in zip(points, weights, strict=True)) for i in range(6)]
    return second, first, sum(weights)
