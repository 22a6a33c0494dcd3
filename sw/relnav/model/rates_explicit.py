# SPDX-License-Identifier: Apache-2.0
"""The paper's order of operations in the core's binary32: A^-1 = U^-1 D^-1 L^-1 (Eqs. 10, 11), then A^-1 b.

Not built in hardware: it is here to show what an explicit inverse without refinement costs. It starts from
the same exact sums, rounded once to binary32, and uses the same multiplier, adder and divider.
"""

from __future__ import annotations

import numpy as np

from relnav.model.float32 import Floats, add, divide, from_integer, multiply, subtract
from relnav.model.rates_program import SIZE, Scale
from relnav.model.rates_scale import FrameScale

ONE = np.ones(1, np.float32)


def explicit_rates(moments: dict[tuple[int, int], int], scale: FrameScale) -> tuple[Floats, Floats]:
    """(x (6,), A^-1 (6, 6)) in the user's units, each operation rounded to binary32.

    moments: exact sums by (row, column), row <= column, 6 for y. A singular A gives infinities or NaN.
    """
    A = np.zeros((SIZE, SIZE), np.float32)
    b = np.zeros(SIZE, np.float32)
    for (row, column), moment in moments.items():
        value = from_integer(moment, scale.moment(row, column))
        if column < SIZE:
            A[row, column] = A[column, row] = value
        elif row < SIZE:
            b[row] = value
    L, d = factors(A)
    inverse_L = unit_lower_inverse(L)
    scaled = multiply(np.asarray(inverse_L.T), divide(np.ones(SIZE, np.float32), d)[None, :])
    inverse = product(scaled, inverse_L)
    x = product(inverse, b[:, None])[:, 0]
    return (
        np.ldexp(x, scale.output(Scale.RATE)),
        np.ldexp(inverse, 2 * scale.frac_h + scale.moment(0, 0)),
    )


def factors(A: Floats) -> tuple[Floats, Floats]:
    """Unit lower L (6, 6) and the diagonal d (6,) of A = L D L^T."""
    work = A.copy()
    L = np.eye(SIZE, dtype=np.float32)
    for k in range(SIZE):
        rest = slice(k + 1, SIZE)
        L[rest, k] = divide(work[rest, k], np.full(SIZE - 1 - k, work[k, k]))
        step = multiply(np.repeat(L[rest, k : k + 1], SIZE - 1 - k, 1), work[None, k, rest])
        work[rest, rest] = subtract(work[rest, rest], step)
    return L, np.diag(work).copy()


def unit_lower_inverse(L: Floats) -> Floats:
    """L^-1 by forward substitution, column by column."""
    inverse = np.eye(SIZE, dtype=np.float32)
    for row in range(1, SIZE):
        for k in range(row):
            step = multiply(np.full(SIZE, L[row, k]), inverse[k])
            inverse[row] = subtract(inverse[row], step)
    return inverse


def product(x: Floats, y: Floats) -> Floats:
    """Matrix product, summed from the first column on."""
    total = np.zeros((x.shape[0], y.shape[1]), np.float32)
    for k in range(x.shape[1]):
        total = add(total, multiply(np.repeat(x[:, k : k + 1], y.shape[1], 1), y[None, k, :]))
    return total
