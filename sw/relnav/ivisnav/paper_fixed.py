# SPDX-License-Identifier: Apache-2.0
"""The paper's own order of operations: Q15.16 products, an explicit single-precision inverse, Q15.16 again.

H^T, H^T W, H^T W H and H^T W y~ in 32-bit words with 16 fractional bits, every product truncated before it is
added; H^T W H to binary32, L D U, the inverses of the three, their product (Eqs. 10, 11); the inverse back to
Q15.16 and times H^T W y~. y~ are phase differences times `scale`, undone with lambda / 4 pi dt by software.
What the paper leaves open: conversions round to nearest, what leaves 32 bits saturates (and is reported).

`explicit_inverse` is the same inverse on the core's exact sums: what the order of operations alone costs.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..attitude import FloatArray
from ..model.float32 import Floats, divide, multiply
from ..model.gram_ring import gram_ring
from ..model.rates_explicit import explicit_rates, factors, product, unit_lower_inverse
from ..model.rates_scale import FrameScale
from ..paper_fixed import FRACTION, IntArray, Words
from .quantise import QuantisedRows, equations, metres_per_second
from .rows import RateFrame


@dataclass(frozen=True, eq=False)
class PaperRates:
    """x (6,) = (v, omega), m/s and rad/s, None where a pivot came out 0; overflow: something saturated."""

    x: FloatArray | None
    overflow: bool
    scale: float


def solve(frame: RateFrame, f0: float, dt: float, scale: float = 1.0) -> PaperRates:
    """Eq. 9 in the paper's arithmetic; weights are w / max(w) in Q15.16, a covariance is not supported.

    scale: of the phase differences; 1 is a phase in rad in Q15.16.
    """
    words = Words()
    h = words.enter(equations(frame, f0, dt).h)
    y = words.enter(scale * frame.dphi)
    weighted = h if frame.w is None else words.enter(frame.w / frame.w.max())[:, None] * h >> FRACTION
    normal = _matrix_product(words, weighted.T, h)
    moment = _matrix_product(words, weighted.T, y[:, None])[:, 0]
    inverse = invert((normal / 2.0**FRACTION).astype(np.float32))
    if inverse is None:
        return PaperRates(None, words.overflow, scale)
    x = _matrix_product(words, words.enter(inverse.astype(np.float64)), moment[:, None])[:, 0]
    rates = words.leave(x.tolist()) * (metres_per_second(f0, dt) / scale)
    return PaperRates(rates, words.overflow, scale)


def invert(a: Floats) -> Floats | None:
    """A^-1 = U^-1 D^-1 L^-1 (6, 6) in binary32, no pivoting; None where a pivot is 0 or not finite."""
    lower, pivots = factors(a)
    if not np.isfinite(pivots).all() or (pivots == 0.0).any():
        return None
    inverse_lower = unit_lower_inverse(lower)
    one = np.ones(len(pivots), np.float32)
    scaled = multiply(np.asarray(inverse_lower.T), divide(one, pivots)[None, :])
    return product(scaled, inverse_lower)


def explicit_inverse(rows: QuantisedRows) -> FloatArray:
    """x (6,) in binary32 from the core's exact sums by U^-1 D^-1 L^-1, without refinement."""
    sums = gram_ring(rows.h, rows.y, rows.w)
    scale = FrameScale.of(sums, rows.frac_h, rows.frac_y)
    return explicit_rates(sums.moments, scale)[0].astype(np.float64)


def _matrix_product(words: Words, left: IntArray, right: IntArray) -> IntArray:
    """left (m, k) times right (k, n) in Q15.16: each product truncated, each sum held in 32 bits."""
    return np.array(
        [[words.total(row * column >> FRACTION) for column in right.T] for row in left], dtype=np.int64
    )
