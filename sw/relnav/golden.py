# SPDX-License-Identifier: Apache-2.0
"""The golden model: OLTAE in double precision, one function a step of the paper (Eqs. 1-31).

Points are rows: a, b (n, 3), weights w (n,) = inverse variances up to one common factor, so point i of a
carries noise of variance sigma_a^2 / w_i a component, likewise b. Corrections to the paper: the centroids are
weighted (its Eq. 11 is not), the words sum and difference before its Eq. 16 are swapped, its Eq. 24 means
vectors. Here `sums` is nu = b + a (the paper's s) and `differences` is eps = b - a (its y).

The core does not see points but moments; `moments` and what follows it is the same mathematics in that form,
with the turns, the re-application and the covariances that the paper does not have.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from . import words
from .attitude import (
    IDENTITY,
    TURN_NAMES,
    TURN_SIGNS,
    FloatArray,
    quaternion_of,
    rotation_of,
    skew,
    turn_back,
)
from .result import PoseResult

MAX_POINTS = 65535
# The core's bounds on `relative_determinant`; it meets them with its own rounding, to 3 % or so. Down to the
# first, 35-bit mantissas leave 3 digits or so; below the second the determinant is lost in them.
FULL_SCALE_BITS = words.MANT - 1
ILL_CONDITIONED = 2.0 ** (words.ILL_BITS - FULL_SCALE_BITS)
RANK_DEFICIENT = 2.0 ** (words.RANK_BITS - FULL_SCALE_BITS)
Q_FIXED_FRACTION = 16


# ---- the paper, step by step


def transform(a: FloatArray, rotation: FloatArray, t: FloatArray) -> FloatArray:
    """Eq. 1: b = R a + t for every row of a."""
    return a @ rotation.T + t


def cost(a: FloatArray, b: FloatArray, w: FloatArray, rotation: FloatArray, t: FloatArray) -> float:
    """Eq. 2: sum of w |b - R a - t|^2. (Eq. 25 does not minimise it: see `residual`.)"""
    r = b - transform(a, rotation, t)
    return float(w @ np.einsum("ij,ij->i", r, r))


def residual(a: FloatArray, b: FloatArray, q: FloatArray, t_star: FloatArray) -> FloatArray:
    """Eqs. 6-9: (b - a) - [(b + a) x] q - t*, (n, 3): what is minimised, (I + Q) times the residual of Eq. 2.

    Eq. 3 is attitude.cayley, Eq. 4 attitude.skew, Eq. 5 is Eq. 3 in Eq. 1.
    """
    return (b - a) - np.cross(b + a, q) - t_star


def solve_together(a: FloatArray, b: FloatArray, w: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Eq. 9 for q and t* at once, the 6-state least squares that the centroids avoid: (q, (I + Q)^-1 t*)."""
    rows = np.concatenate([np.hstack((skew(nu), IDENTITY)) for nu in b + a])
    root = np.repeat(np.sqrt(w), 3)
    x = _double(np.linalg.lstsq(rows * root[:, None], (b - a).ravel() * root, rcond=None)[0])
    return x[:3], _double(np.linalg.solve(IDENTITY + skew(x[:3]), x[3:]))


def centroids(a: FloatArray, b: FloatArray, w: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Eqs. 10-11, weighted: (a_bar, b_bar), (3,) each."""
    return w @ a / w.sum(), w @ b / w.sum()


def translation(a_bar: FloatArray, b_bar: FloatArray, rotation: FloatArray) -> FloatArray:
    """Eq. 12: t = b_bar - R a_bar."""
    return b_bar - rotation @ a_bar


def centre(points: FloatArray, centroid: FloatArray) -> FloatArray:
    """Eq. 13: points less their centroid, (n, 3)."""
    return points - centroid


def sums_and_differences(da: FloatArray, db: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Eqs. 14-15: s = db + da, y = db - da, (n, 3) each; y = [s x] q."""
    return db + da, db - da


def design_matrix(s: FloatArray) -> FloatArray:
    """Eqs. 16-17 and 20: H (3n, 3), the stacked [s_i x]."""
    return np.concatenate([skew(row) for row in s])


def batch_solution(h: FloatArray, y: FloatArray, w: FloatArray) -> FloatArray:
    """Eqs. 18-19: q = (H^T W H)^-1 H^T W y with W = diag(w) (x) I3, the inverse of Eq. 21's (x) I3."""
    weights = np.repeat(w, 3)
    return _double(np.linalg.solve(h.T @ (weights[:, None] * h), h.T @ (weights * y.ravel())))


def normal_matrix(s: FloatArray, w: FloatArray) -> FloatArray:
    """Eqs. 22-23: M = sum of w (s^T s I - s s^T), (3, 3), weight unit * unit^2."""
    return _trace_minus((s * w[:, None]).T @ s)


def normal_vector(s: FloatArray, y: FloatArray, w: FloatArray) -> FloatArray:
    """Eq. 24: z = sum of w (s x y), (3,)."""
    return w @ np.cross(s, y)


def solve(m: FloatArray, z: FloatArray) -> FloatArray:
    """Eq. 25: q = -M^-1 z."""
    return _double(-np.linalg.solve(m, z))


def scale(s: FloatArray, y: FloatArray, alpha: float, beta: float) -> tuple[FloatArray, FloatArray]:
    """Eqs. 26-27: (alpha s, beta y)."""
    return alpha * s, beta * y


def unscale(q_scaled: FloatArray, alpha: float, beta: float) -> FloatArray:
    """Eqs. 28-31: q' = (beta / alpha) q solves the scaled system, hence q = (alpha / beta) q'."""
    return q_scaled * (alpha / beta)


# ---- from the moments


@dataclass(frozen=True, eq=False)
class Moments:
    """What is left of a frame: all later steps are functions of it.

    count: points of positive weight; weight: sum of w; mean_a, mean_b: centroids (3,);
    saa, sbb, sba: centred sums of w a a^T, w b b^T, w b a^T (3, 3)
    """

    count: int
    weight: float
    mean_a: FloatArray
    mean_b: FloatArray
    saa: FloatArray
    sbb: FloatArray
    sba: FloatArray

    def turned(self, rotation: FloatArray) -> Moments:
        """The moments of (R a, b): no pass over the points."""
        return replace(
            self,
            mean_a=rotation @ self.mean_a,
            saa=rotation @ self.saa @ rotation.T,
            sba=self.sba @ rotation.T,
        )


def moments(a: FloatArray, b: FloatArray, w: FloatArray) -> Moments:
    """Eqs. 10-13 and all sums of products, centred first."""
    a_bar, b_bar = centroids(a, b, w)
    da, db = centre(a, a_bar), centre(b, b_bar)
    wa, wb = da * w[:, None], db * w[:, None]
    return Moments(int(np.count_nonzero(w)), float(w.sum()), a_bar, b_bar, wa.T @ da, wb.T @ db, wb.T @ da)


def sum_matrix(m: Moments) -> FloatArray:
    """S = sum of w s s^T, (3, 3)."""
    return m.saa + m.sbb + m.sba + m.sba.T


def moment_matrix(m: Moments) -> FloatArray:
    """Eqs. 22-23: M = tr(S) I - S."""
    return _trace_minus(sum_matrix(m))


def moment_vector(m: Moments) -> FloatArray:
    """Eq. 24: z = 2 sum of w (a x b), from the skew part of sum w b a^T."""
    d = m.sba - m.sba.T
    return 2.0 * np.array([d[2, 1], d[0, 2], d[1, 0]])


def adjugate(m: FloatArray) -> FloatArray:
    """adj(M), (3, 3), of a symmetric M: Cramer's rule."""
    rows = (np.cross(m[1], m[2]), np.cross(m[2], m[0]), np.cross(m[0], m[1]))
    return np.stack(rows, axis=1)


def cramer(matrix: FloatArray, z: FloatArray) -> tuple[float, FloatArray]:
    """(D, N) with q = N / D: D = det M, N = -adj(M) z. An unnormalised quaternion, finite at every angle."""
    adj = adjugate(matrix)
    return float(matrix[0] @ adj[:, 0]), -adj @ z


def condition(matrix: FloatArray) -> float:
    """tr(M) tr(M^-1), infinite when singular: never below kappa(M) and at most 9 times it (9 for M = c I).

    Needs nothing beyond the adjugate: no eigenvalues, no square root.
    """
    adj = adjugate(matrix)
    det = float(matrix[0] @ adj[:, 0])
    return float(np.trace(matrix) * np.trace(adj)) / det if det > 0.0 else np.inf


def relative_determinant(matrix: FloatArray, m: Moments) -> float:
    """det M over P^3, P the core's scale: the power of two at or below the largest of T_i = Sa_ii + Sb_ii.

    The core's moments, M among them, carry a factor W, which moves P.
    """
    largest = float(np.diag(m.saa + m.sbb).max())
    if not largest > 0.0:
        return 0.0
    # of W only the mantissa, of the unit only what is left: nothing leaves double's range
    (weight, _), (size, exponent) = np.frexp(m.weight), np.frexp(largest)
    scaled = weight * np.ldexp(matrix, -int(exponent))
    return cramer(np.ldexp(scaled, 1 - int(np.frexp(weight * size)[1])), np.zeros(3))[0]


def turn(m: Moments, k: int) -> Moments:
    """The moments with a turned by 180 degrees about none, x, y, z (k = 0..3)."""
    return m.turned(np.diag(np.array(TURN_SIGNS[k], float)))


def turn_determinants(m: Moments) -> FloatArray:
    """det M_k (4,) of the four turns, over (tr Sa + tr Sb)^3, so that no cube leaves double's range."""
    size = float(np.trace(m.saa) + np.trace(m.sbb)) or 1.0
    return np.array(
        [cramer(moment_matrix(turn(m, k)) / size, np.zeros(3))[0] for k in range(len(TURN_SIGNS))]
    )


def choose_turn(m: Moments, forbid_turns: bool = False) -> int:
    """0..3: the turn with the largest det M_k, the first of equals; 0 when turns are forbidden."""
    return 0 if forbid_turns else int(np.argmax(turn_determinants(m)))


@dataclass(frozen=True, eq=False)
class Attitude:
    """One application of Eq. 25 to turned moments.

    scalar, vector:  (D, N) of the whole rotation, q = N / D;  rotation: R (3, 3)
    turn:            0..3;  matrix: M of the turned points;  turned: their moments;  q_turned: their q
    """

    scalar: float
    vector: FloatArray
    rotation: FloatArray
    turn: int
    matrix: FloatArray
    turned: Moments
    q_turned: FloatArray


def solve_moments(m: Moments, forbid_turns: bool = False) -> Attitude:
    """Turn, Eq. 25 by Cramer's rule, turn back. The M of the chosen turn must not be singular."""
    k = choose_turn(m, forbid_turns)
    turned = turn(m, k)
    matrix = moment_matrix(turned)
    # As in turn_determinants. q = N / D does not notice.
    size = float(np.trace(matrix))
    det, n = cramer(matrix / size, moment_vector(turned) / size)
    scalar, vector = turn_back(k, det, n)
    return Attitude(scalar, vector, rotation_of(scalar, vector), k, matrix, turned, n / det)


def reapply(m: Moments, first: Attitude) -> Attitude:
    """Eq. 25 once more on a turned by the first R: Wahba's optimum. The remaining angle is small: no turn."""
    again = solve_moments(m.turned(first.rotation), forbid_turns=True)
    # Quaternions multiply: (D, N) of R2 R1 is (D1, N1)(D2, N2) in this sign convention.
    scalar = first.scalar * again.scalar - float(first.vector @ again.vector)
    vector = first.scalar * again.vector + again.scalar * first.vector + np.cross(first.vector, again.vector)
    return replace(again, scalar=scalar, vector=vector, rotation=rotation_of(scalar, vector), turn=first.turn)


def residual_sum(m: Moments, rotation: FloatArray) -> float:
    """Eq. 2 at t's optimum, from the moments: tr Sa + tr Sb - 2 tr(R^T B). Cancels; `cost` does not."""
    return max(0.0, float(np.trace(m.saa) + np.trace(m.sbb) - 2.0 * np.sum(rotation * m.sba)))


# ---- covariance


def unit_variance(rss: float, count: int) -> float:
    """sigma_a^2 + sigma_b^2 at unit weight from residuals: rss / (3n - 6), n counts positive weights."""
    return rss / (3 * count - 6) if count > 2 else np.nan


def gibbs_covariance(matrix: FloatArray, q: FloatArray, variance: float) -> FloatArray:
    """Covariance (3, 3) of Eq. 25's q: s^2 M^-1 [(1 + |q|^2) M - [q x] S [q x]^T] M^-1, S = tr(M)/2 I - M.

    variance is sigma_a^2 + sigma_b^2 at unit weight. The naive s^2 M^-1 is right only for small q.
    """
    inverse = np.linalg.inv(matrix)
    s = 0.5 * np.trace(matrix) * IDENTITY - matrix
    cross = skew(q)
    return _double(variance * inverse @ ((1.0 + float(q @ q)) * matrix - cross @ s @ cross.T) @ inverse)


def attitude_jacobian(q: FloatArray) -> FloatArray:
    """G (3, 3), 2 (I - Q) / (1 + q^2): for a small error dq of q, R(q) = exp(-[G dq x]) R(q + dq)."""
    return 2.0 * (IDENTITY - skew(q)) / (1.0 + float(q @ q))


def gibbs_jacobian(q: FloatArray) -> FloatArray:
    """L = G^-1 = (I + Q + q q^T) / 2, (3, 3): attitude error (radians, in b's frame) -> error of q."""
    return 0.5 * (IDENTITY + skew(q) + np.outer(q, q))


def attitude_covariance(attitude: Attitude, variance: float) -> FloatArray:
    """Covariance (3, 3), rad^2, of the small rotation in b's frame between R true and R estimated.

    A turn multiplies R on the right and leaves that rotation alone, so the turned q serves, never large.
    """
    g = attitude_jacobian(attitude.q_turned)
    return g @ gibbs_covariance(attitude.matrix, attitude.q_turned, variance) @ g.T


def translation_covariance(
    p_theta: FloatArray, rotated_mean: FloatArray, variance: float, weight: float
) -> FloatArray:
    """Covariance (3, 3) of t: s^2 / W I + [R a_bar x] P_theta [R a_bar x]^T.

    Not sum w^2 / W^2: docs/decisions/translation-covariance.md.
    """
    cross = skew(rotated_mean)
    return variance / weight * IDENTITY + cross @ p_theta @ cross.T


def translation_covariance_gibbs(
    q_cov: FloatArray, q: FloatArray, mean_a: FloatArray, variance: float, weight: float
) -> FloatArray:
    """The same through q: s^2 / W I + J P J^T, J = -2 (I+Q)^-1 [((I+Q)^-1 a_bar) x]."""
    inverse = np.linalg.inv(IDENTITY + skew(q))
    j = -2.0 * inverse @ skew(inverse @ mean_a)
    return variance / weight * IDENTITY + j @ q_cov @ j.T


# ---- the frame


def estimate(
    a: FloatArray,
    b: FloatArray,
    w: FloatArray | None = None,
    *,
    forbid_turns: bool = False,
    reapplied: bool = False,
    variance: float = 0.0,
    frame: str | int = 0,
) -> PoseResult:
    """The whole pose of one frame, with the core's rules and flags.

    a, b (n, 3); w (n,) or None; variance: sigma_a^2 + sigma_b^2 at unit weight, 0 to take it from the
    residuals.
    """
    n = len(a)
    weights = np.ones(n) if w is None else w
    for flag, fails in (
        ("FEW_POINTS", n < 3),
        ("TOO_LONG", n > MAX_POINTS),
        ("ZERO_WEIGHT", not weights.any()),
    ):
        if fails:
            return PoseResult(frame, n, flags=(flag,))
    m = moments(a, b, weights)
    chosen = moment_matrix(turn(m, choose_turn(m, forbid_turns)))
    size = relative_determinant(chosen, m)
    if size < RANK_DEFICIENT:
        return PoseResult(frame, n, flags=("RANK_DEFICIENT",))
    attitude = solve_moments(m, forbid_turns)
    if reapplied:
        attitude = reapply(m, attitude)
    t = translation(m.mean_a, m.mean_b, attitude.rotation)
    rss = cost(centre(a, m.mean_a), centre(b, m.mean_b), weights, attitude.rotation, np.zeros(3))
    if variance == 0.0:
        variance = unit_variance(rss, m.count)
    p_theta = attitude_covariance(attitude, variance)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        q = attitude.vector / attitude.scalar
        determinant = float(np.linalg.det(chosen))
    finite = bool(np.all(np.isfinite(q)))
    jacobian = gibbs_jacobian(q) if finite else None
    q_fixed, saturated = to_q_fixed(q)
    flags = [
        name for name, on in (("Q_SATURATED", saturated), ("ILL_CONDITIONED", size < ILL_CONDITIONED)) if on
    ]
    return PoseResult(
        frame=frame,
        n=n,
        q=q if finite else None,
        quaternion=quaternion_of(attitude.rotation),
        R=attitude.rotation,
        t=t,
        q_cov=None if jacobian is None else jacobian @ p_theta @ jacobian.T,
        t_cov=translation_covariance(p_theta, attitude.rotation @ m.mean_a, variance, m.weight),
        rss=rss,
        turn=TURN_NAMES[attitude.turn],
        flags=tuple(flags),
        weight=m.weight,
        condition=condition(chosen / np.trace(chosen)),
        determinant=determinant,
        q_fixed=q_fixed,
    )


def to_q_fixed(q: FloatArray) -> tuple[FloatArray, bool]:
    """q in Q15.16, to nearest, saturated, and whether it had to be; a NaN counts as saturated and gives 0."""
    one = 1 << Q_FIXED_FRACTION
    rounded = np.rint(q * one)
    held = np.clip(np.nan_to_num(rounded, nan=0.0), -(2.0**31), 2.0**31 - 1)
    return held / one, not bool(np.all(held == rounded))


def _double(values: npt.NDArray[Any]) -> FloatArray:
    """For the type checker: numpy.linalg promises any floating type."""
    return np.asarray(values, dtype=np.float64)


def _trace_minus(s: FloatArray) -> FloatArray:
    return float(np.trace(s)) * IDENTITY - s
