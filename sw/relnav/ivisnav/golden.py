# SPDX-License-Identifier: Apache-2.0
"""The golden model in double: Eq. 9 by the normal equations, and by QR, which is its reference.

Everything goes by A = H^T W H and b = H^T W y of the equations y = h x (quantise.Equations). QR works on
sqrt(W) H, whose condition is the square root of A's; the backend `double` is that.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..attitude import FloatArray
from ..golden import MAX_POINTS as MAX_ROWS
from ..words import LARGEST_CONDITION, PIVOT_BITS
from .quantise import Equations
from .result import RatesResult

UNKNOWNS = 6
SINGULAR = 2.0**26  # cond(sqrt(W) H) that the rounding of rows to 32 bits alone may make of a singular H


@dataclass(frozen=True, eq=False)
class Solution:
    """x (6,) = (v, omega) m/s, rad/s; inverse (6, 6) of A; rss = sum of w (y - h x)^2, weights as given."""

    x: FloatArray
    inverse: FloatArray
    rss: float


def normal_matrix(e: Equations) -> tuple[FloatArray, FloatArray]:
    """A (6, 6) = H^T W H and b (6,) = H^T W y."""
    weighted = e.h * weights_of(e)[:, None]
    return weighted.T @ e.h, weighted.T @ e.y


def normal_equations(e: Equations) -> Solution:
    """Eq. 9 as it stands, by Cholesky: A x = b. Raises numpy.linalg.LinAlgError where A is not positive."""
    a, b = normal_matrix(e)
    root = np.asarray(np.linalg.inv(np.linalg.cholesky(a)), dtype=np.float64)
    inverse = root.T @ root
    return _solution(e, inverse @ b, inverse)


def orthogonal(e: Equations) -> Solution:
    """The same least squares by QR of sqrt(W) H, without A."""
    root = np.sqrt(weights_of(e))
    q, r = np.linalg.qr(root[:, None] * e.h)
    upper = np.asarray(np.linalg.inv(r), dtype=np.float64)
    return _solution(e, upper @ (q.T @ (root * e.y)), upper @ upper.T)


def condition(e: Equations) -> float:
    """cond(sqrt(W) H), the largest over the smallest singular value; infinite where that is 0 or missing."""
    root = np.sqrt(weights_of(e))
    values = np.linalg.svd(root[:, None] * e.h, compute_uv=False)
    if len(values) < UNKNOWNS or not values[-1] > 0.0:
        return float(np.inf)
    return float(values[0] / values[-1])


def rank_deficient(e: Equations) -> bool:
    """The core's rule: a pivot of A = L D L^T more than PIVOT_BITS exponents below its diagonal element.

    The noise of binary32 in a pivot is about that large; in double it would be told from 0 by 30 bits more.
    """
    a, _ = normal_matrix(e)
    first = np.frexp(np.diag(a))[1]
    for k in range(UNKNOWNS):
        if not a[k, k] > 0.0 or np.frexp(a[k, k])[1] + PIVOT_BITS < first[k]:
            return True
        a = a - np.outer(a[:, k], a[k]) / a[k, k]
    return False


def estimate(e: Equations, *, variance: float = 0.0) -> RatesResult:
    """The rates of one frame, with the core's rules and flags.

    variance: of y at the user's unit weight, (m/s)^2; 0 to take it from the residuals.
    """
    name = e.frame.name
    for flag, fails in (
        ("FEW_ROWS", e.n < UNKNOWNS),
        ("TOO_LONG", e.n > MAX_ROWS),
        ("ZERO_WEIGHT", not weights_of(e).any()),
    ):
        if fails:
            return RatesResult(name, e.n, flags=(flag,))
    cond = condition(e)
    if cond > SINGULAR or rank_deficient(e):
        return RatesResult(name, e.n, flags=("RANK_DEFICIENT",))
    if cond > LARGEST_CONDITION:
        return RatesResult(name, e.n, flags=("ILL_CONDITIONED",), condition=cond)
    solution = orthogonal(e)
    used = int(np.count_nonzero(weights_of(e)))
    scaled = variance * e.weight_scale if variance else unit_variance(solution.rss, used)
    cov = scaled * solution.inverse
    return RatesResult(
        frame=name,
        n=e.n,
        v=solution.x[:3],
        omega=solution.x[3:],
        cov=cov if np.isfinite(cov).all() else None,
        rss=solution.rss / e.weight_scale,
        condition=cond,
    )


def unit_variance(rss: float, used: int) -> float:
    """Variance of y at unit weight from residuals: rss / (used - 6); used counts positive weights."""
    return rss / (used - UNKNOWNS) if used > UNKNOWNS else float(np.nan)


def weights_of(e: Equations) -> FloatArray:
    """(n,) weights, 1 where none are given."""
    return np.ones(e.n) if e.w is None else e.w


def _solution(e: Equations, x: FloatArray, inverse: FloatArray) -> Solution:
    residual = e.y - e.h @ x
    return Solution(x, inverse, float(np.sum(weights_of(e) * residual**2)))
