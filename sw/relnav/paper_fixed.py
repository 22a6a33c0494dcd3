# SPDX-License-Identifier: Apache-2.0
"""The paper's own arithmetic: Q15.16 throughout, inputs scaled by alpha and beta (Eqs. 26-31).

32-bit words with 16 fractional bits; every product is truncated back to Q15.16 before it is added, the
inverse is adj(M) / det M, elements divided one by one. What the paper leaves open: inputs are rounded to
nearest, what leaves 32 bits saturates (and is reported), weights are w / max(w) in Q15.16. The points are
centred in double first, by software, as there. det M goes with alpha^6, so alpha a few times below the
overflow limit costs several percent.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import fxpmath
import numpy as np
import numpy.typing as npt

from .attitude import FloatArray
from .golden import centre, centroids, sums_and_differences, unscale

IntArray = npt.NDArray[np.int64]

Fxp: Any = fxpmath.Fxp  # type: ignore[attr-defined]

WORD, FRACTION = 32, 16
LARGEST, SMALLEST = (1 << (WORD - 1)) - 1, -(1 << (WORD - 1))


@dataclass(frozen=True, eq=False)
class PaperResult:
    """q (3,) by Eq. 31, None where det M came out 0; overflow: something saturated; alpha, beta as used."""

    q: FloatArray | None
    overflow: bool
    alpha: float
    beta: float


class Words:
    """Q15.16 words as Python integers; remembers whether one had to be saturated."""

    def __init__(self) -> None:
        self.overflow = False

    def hold(self, value: int) -> int:
        """value, saturated to 32 bits."""
        held = min(max(value, SMALLEST), LARGEST)
        self.overflow |= held != value
        return held

    def enter(self, values: FloatArray) -> IntArray:
        """Floats to words: to nearest, saturated."""
        fixed = Fxp(values, True, WORD, FRACTION, rounding="around", overflow="saturate")
        self.overflow |= bool(fixed.get_status()["overflow"])
        return np.asarray(fixed.val, dtype=np.int64)

    def leave(self, words: list[int]) -> FloatArray:
        """Words to floats, exact."""
        fixed = Fxp(np.array(words, dtype=np.int64), True, WORD, FRACTION, raw=True)
        return np.asarray(fixed.get_val(), dtype=np.float64)

    def product(self, x: int, y: int) -> int:
        """x y, truncated."""
        return self.hold(x * y >> FRACTION)

    def difference_of_products(self, x: int, y: int, u: int, v: int) -> int:
        """x y - u v, each product truncated."""
        return self.hold(self.product(x, y) - self.product(u, v))

    def quotient(self, x: int, y: int) -> int:
        """x / y, truncated towards 0."""
        magnitude = (abs(x) << FRACTION) // abs(y)
        return self.hold(magnitude if (x < 0) == (y < 0) else -magnitude)

    def total(self, terms: IntArray) -> int:
        """The sum, saturated at its end."""
        return self.hold(int(terms.sum()))


def solve(a: FloatArray, b: FloatArray, w: FloatArray | None, alpha: float, beta: float) -> PaperResult:
    """Eq. 28 in Q15.16 on alpha s and beta y, then Eq. 31. a, b (n, 3), w (n,) or None."""
    words = Words()
    weights = np.ones(len(a)) if w is None else w / w.max()
    a_bar, b_bar = centroids(a, b, weights)
    sums, differences = sums_and_differences(centre(a, a_bar), centre(b, b_bar))
    s, y = words.enter(alpha * sums), words.enter(beta * differences)
    # Both factors have 32 bits: products are exact in int64.
    ws = s if w is None else words.enter(weights)[:, None] * s >> FRACTION

    def inner(x: IntArray, u: IntArray) -> int:
        return words.total(x * u >> FRACTION)

    xx, yy, zz = (inner(ws[:, i], s[:, i]) for i in range(3))
    xy, xz, yz = inner(ws[:, 0], s[:, 1]), inner(ws[:, 0], s[:, 2]), inner(ws[:, 1], s[:, 2])
    hold = words.hold
    m = ((hold(yy + zz), -xy, -xz), (-xy, hold(xx + zz), -yz), (-xz, -yz, hold(xx + yy)))
    z = [hold(inner(ws[:, i], y[:, j]) - inner(ws[:, j], y[:, i])) for i, j in ((1, 2), (2, 0), (0, 1))]

    minor = words.difference_of_products
    adj = [[0] * 3 for _ in range(3)]
    for i in range(3):
        for j in range(3):  # cyclic indices carry the sign of the cofactor
            r, t, c, d = (j + 1) % 3, (j + 2) % 3, (i + 1) % 3, (i + 2) % 3
            adj[i][j] = minor(m[r][c], m[t][d], m[r][d], m[t][c])
    det = hold(sum(words.product(m[0][k], adj[k][0]) for k in range(3)))
    if det == 0:
        return PaperResult(None, words.overflow, alpha, beta)
    inverse = [[words.quotient(adj[i][j], det) for j in range(3)] for i in range(3)]
    q = [hold(-sum(words.product(inverse[i][j], z[j]) for j in range(3))) for i in range(3)]
    return PaperResult(unscale(words.leave(q), alpha, beta), words.overflow, alpha, beta)


def overflow_limit(a: FloatArray, b: FloatArray, w: FloatArray | None = None) -> float:
    """The largest alpha (= beta), within 2 %, at which nothing overflows."""
    largest = float(np.abs(np.vstack((a - a.mean(axis=0), b - b.mean(axis=0)))).max())
    exponent = 15.0 - np.floor(np.log2(largest))
    while solve(a, b, w, 2.0**exponent, 2.0**exponent).overflow:
        exponent -= 1.0
    for step in (0.5, 0.25, 0.125, 0.0625, 0.03125):
        if not solve(a, b, w, 2.0 ** (exponent + step), 2.0 ** (exponent + step)).overflow:
            exponent += step
    return float(2.0**exponent)


def relative_error(q: FloatArray | None, reference: FloatArray) -> float:
    """|q - reference| / |reference|; 1 where there is no q."""
    return 1.0 if q is None else float(np.linalg.norm(q - reference) / np.linalg.norm(reference))
