# SPDX-License-Identifier: Apache-2.0
"""The exact solution of quantised rows in rational arithmetic: all else is measured against it."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from operator import mul

import numpy as np

from ..attitude import FloatArray
from .quantise import QuantisedRows

Vector = list[Fraction]
Matrix = list[list[Fraction]]
SIZE = 6


class Singular(Exception):
    """det(H^T W H) is exactly zero."""


@dataclass(frozen=True)
class ExactRates:
    """x = (v, omega), m/s and rad/s; inverse (6 x 6) of H^T W H and rss at the integer weights."""

    x: Vector
    inverse: Matrix
    rss: Fraction

    def floats(self) -> FloatArray:
        """x (6,) rounded once to double."""
        return np.array([float(value) for value in self.x])


def moments(rows: QuantisedRows) -> list[list[int]]:
    """The 7 x 7 sums of w u_i u_j, u = [h; y], in integers: what the Gram array gives."""
    columns = [column.tolist() for column in (*rows.h.T, rows.y)]
    weights = rows.w.tolist()
    weighted = [list(map(mul, weights, column)) for column in columns]
    return [[sum(map(mul, left, right)) for right in columns] for left in weighted]


def solve(rows: QuantisedRows) -> ExactRates:
    """Eq. 9 of the integers. Raises Singular."""
    g = moments(rows)
    # [A | b | I] by Bareiss' elimination: every division in it is exact, and so are the integers
    m = [[*g[i], *(int(i == j) for j in range(SIZE))] for i in range(SIZE)]
    previous = 1
    for k in range(SIZE):
        pivot = next((i for i in range(k, SIZE) if m[i][k]), None)
        if pivot is None:
            raise Singular
        m[k], m[pivot] = m[pivot], m[k]
        for i in range(SIZE):
            if i != k:
                m[i] = [(m[k][k] * x - m[i][k] * y) // previous for x, y in zip(m[i], m[k], strict=True)]
        previous = m[k][k]
    raw = [Fraction(m[i][SIZE], m[i][i]) for i in range(SIZE)]
    unit_h, unit_y = Fraction(2) ** -rows.frac_h, Fraction(2) ** -rows.frac_y
    return ExactRates(
        x=[value * unit_y / unit_h for value in raw],
        inverse=[
            [Fraction(m[i][SIZE + 1 + j], m[i][i]) / unit_h**2 for j in range(SIZE)] for i in range(SIZE)
        ],
        rss=(g[SIZE][SIZE] - sum(map(mul, raw, g[SIZE]), Fraction(0))) * unit_y**2,
    )
