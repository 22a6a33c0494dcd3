# SPDX-License-Identifier: Apache-2.0
"""Bit-exact model of rtl/gram/gram_ring.v: the 28 exact sums of a frame of rows [h0 .. h5 y] with weights.

G = sum w u u^T with u = [h; y]: the normal equations H^T W H, H^T W y and y^T W y of a weighted linear least
squares problem. Nothing is rounded, so the model needs none of the hardware's digits.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from relnav import words
from relnav.model.gram import split

COMPONENTS = 7  # h0 .. h5, y

#: (row, column) of the items, in the order in which the hardware gives them (rtl/gram/ring_drain.v): row 0
#: first, then rows roughly ascending, no lane twice in a row
DRAIN_ORDER: tuple[tuple[int, int], ...] = (
    *((0, 0), (0, 6), (0, 1), (0, 5), (0, 2), (0, 4), (0, 3)),
    *((1, 1), (1, 6), (1, 2), (1, 5), (1, 3), (2, 2), (1, 4), (2, 6), (2, 3), (3, 3), (2, 4)),
    *((3, 4), (2, 5), (3, 5), (4, 4), (3, 6), (4, 5), (5, 5), (4, 6), (5, 6), (6, 6)),
)


@dataclass(frozen=True)
class RingSums:
    """What gram_ring gives for one frame."""

    moments: dict[tuple[int, int], int]
    """G_ij of (row, column), row <= column, in the order of `DRAIN_ORDER`; signed 96-bit integers."""
    weight_sum: int
    row_count: int
    used_count: int
    """Rows whose weight is not 0."""
    h_bits: int
    """The smallest s with every |h| < 2^s, |h| being h or its one's complement -h - 1."""
    y_bits: int
    """The same for y."""
    weight_bits: int
    """The smallest s with weight_sum < 2^s."""

    def items(self) -> Iterator[tuple[int, int, int]]:
        """(row, column, moment) in the order of the hardware."""
        for (row, column), moment in self.moments.items():
            yield row, column, moment


def gram_ring(h: ArrayLike, y: ArrayLike, w: ArrayLike) -> RingSums:
    """Sums of a frame: h (n, 6) and y (n,) signed 32-bit integers, w (n,) in 0..65535, n of 1..65535.

    Raises ValueError for values the ports cannot carry and for a frame too long.
    """
    values = np.asarray(y, np.int64).reshape(-1)
    n = len(values)
    rows = np.column_stack([np.asarray(h, np.int64).reshape(n, COMPONENTS - 1), values])
    weights = np.asarray(w, np.int64).reshape(n)
    if not 1 <= n < 1 << words.COUNT:
        raise ValueError("a frame has 1 to 65535 rows")
    if not (rows.min() >= -(1 << (words.INPUT - 1)) and rows.max() < 1 << (words.INPUT - 1)):
        raise ValueError("a component does not fit 32 bits")
    if not (weights.min() >= 0 and weights.max() < 1 << words.WEIGHT):
        raise ValueError("a weight does not fit 16 bits")

    # 16-bit digits of the plain and of the weighted components: sums of 65535 products stay below 2^46
    high, low = split(rows)
    rest, v0 = split(rows * weights[:, None])
    v2, v1 = split(rest)
    sums = [[0] * COMPONENTS for _ in range(COMPONENTS)]
    for place, digits in enumerate((v0, v1, v2)):
        for other, limbs in enumerate((low, high)):
            product = (digits.T @ limbs).tolist()
            for i in range(COMPONENTS):
                for j in range(COMPONENTS):
                    sums[i][j] += product[i][j] << (words.LIMB * (place + other))

    weight_sum = int(weights.sum())
    return RingSums(
        moments={(i, j): sums[i][j] for i, j in DRAIN_ORDER},
        weight_sum=weight_sum,
        row_count=n,
        used_count=int(np.count_nonzero(weights)),
        h_bits=_bits(rows[:, :-1].ravel().tolist()),
        y_bits=_bits(rows[:, -1].tolist()),
        weight_bits=weight_sum.bit_length(),
    )


def _bits(values: Sequence[int]) -> int:
    """The smallest s with max(v, -v - 1) < 2^s for all of them."""
    return max(max(value, ~value) for value in values).bit_length()


def exact_sums(h: Sequence[Sequence[int]], y: Sequence[int], w: Sequence[int]) -> dict[tuple[int, int], int]:
    """G by definition, in Python integers, upper triangle."""
    rows = [[int(v) for v in (*u, v)] for u, v in zip(h, y, strict=True)]
    return {
        (i, j): sum(int(k) * u[i] * u[j] for u, k in zip(rows, w, strict=True))
        for i in range(COMPONENTS)
        for j in range(i, COMPONENTS)
    }
