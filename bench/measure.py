# SPDX-License-Identifier: Apache-2.0
"""Errors of one frame of the bit-exact model against the exact solution of the quantised points."""

from __future__ import annotations

from dataclasses import asdict, dataclass, replace
from fractions import Fraction
from typing import Any

import numpy as np
from relnav import exact, golden
from relnav.attitude import FloatArray, turn_back
from relnav.exact import ExactMoments, ExactPose, Matrix
from relnav.model.core import OltaeCore
from relnav.model.raw import RawResult, word_to_float

from bench.clouds import Case

UPPER = np.triu_indices(3)
NOISY = 1e-3  # rms residual over rms extent from which the relative error of rss means something
SMALLEST, LARGEST = 2.0**-126, 2.0**128  # normal binary32


@dataclass(frozen=True)
class Errors:
    """One case. None: not defined for it.

    kappa:       cond M of the turn taken, exact;  size: |q|
    turn_loss:   how much smaller its det M is than the largest of the four
    q:           |dq| / |q| of the stored binary32 words
    components:  components of q within 1 ulp of binary32
    R:           largest |dR_ij|;  t: |dt| / (|R a_bar| + |b_bar|)
    rss:         |d rss| / rss;  floor: |d rss| / sum of w (|a - a_bar|^2 + |b - b_bar|^2)
    q_cov, t_cov: |dP| / |P|, Frobenius, against golden.py on the exact moments
    """

    family: str
    number: int
    n: int
    turn: int
    flags: tuple[str, ...]
    kappa: float
    turn_loss: float = 0.0
    size: float | None = None
    q: float | None = None
    components: int = 0
    R: float | None = None
    t: float | None = None
    rss: float | None = None
    floor: float | None = None
    noise: float | None = None
    q_cov: float | None = None
    t_cov: float | None = None

    def to_json(self) -> dict[str, Any]:
        """For results.json."""
        return {key: value for key, value in asdict(self).items() if value is not None}


def measure(core: OltaeCore, case: Case) -> Errors:
    """Run the model and the exact solution."""
    frame = case.frame
    raw = core.run(frame, case.config)
    chosen = None if raw.failed else raw.turn
    try:
        truth = exact.solve(frame, turn=chosen, forbid_turns=case.config.forbid_turns)
    except exact.Singular:
        return Errors(case.family, case.number, frame.n, raw.turn, raw.flag_names, np.inf)
    errors = Errors(case.family, case.number, frame.n, truth.turn, raw.flag_names, truth.kappa)
    if raw.failed:
        return errors
    moments = exact.exact_moments(frame)
    unit = Fraction(2) ** -frame.frac
    spread = sum(Fraction(moments.saa[i][i] + moments.sbb[i][i]) for i in range(3)) * unit**2 / moments.weight
    rotation = np.array([[float(x) for x in row] for row in truth.R])
    mean_a = np.array([float(Fraction(x) * unit / moments.weight) for x in moments.first_a])
    mean_b = np.array([float(Fraction(x) * unit / moments.weight) for x in moments.first_b])
    found: dict[str, Any] = {
        "R": float(np.abs(floats(raw.R).reshape(3, 3) - rotation).max()),
        "t": translation_error(raw, truth, float(np.linalg.norm(mean_a) + np.linalg.norm(mean_b))),
        "noise": float(np.sqrt(max(0.0, float(truth.rss / spread)))) if spread else None,
        "turn_loss": float(1 - truth.determinant / max(truth.determinants)),
    }
    found |= q_errors(raw, truth) | rss_errors(raw, truth, spread)
    return replace(errors, **(found | covariance_errors(case, raw, truth, moments)))


def floats(words: tuple[int, ...]) -> FloatArray:
    """Binary32 words as numbers."""
    return np.array([word_to_float(word) for word in words])


def q_errors(raw: RawResult, truth: ExactPose) -> dict[str, Any]:
    """Relative error of q and its components within 1 ulp; nothing where q is not finite or not normal."""
    if truth.q is None:
        return {}
    try:
        expected = np.array([float(x) for x in truth.q])
    except OverflowError:
        return {}
    size = float(np.linalg.norm(expected))
    if not SMALLEST * 2**30 < size < LARGEST / 2:
        return {}
    difference = np.abs(floats(raw.q) - expected)
    ulp = np.exp2(np.floor(np.log2(np.maximum(np.abs(expected), SMALLEST))) - 23)
    return {
        "size": size,
        "q": float(np.linalg.norm(difference)) / size,
        "components": int(np.count_nonzero(difference <= ulp)),
    }


def translation_error(raw: RawResult, truth: ExactPose, reach: float) -> float | None:
    """|dt| / (|R a_bar| + |b_bar|); a length beyond binary32 has none."""
    if not SMALLEST * 2**24 < reach < LARGEST / 4:
        return None
    return float(np.linalg.norm(floats(raw.T) - [float(x) for x in truth.t])) / reach


def rss_errors(raw: RawResult, truth: ExactPose, spread: Fraction) -> dict[str, float]:
    """Relative to rss, and to the spread of the two clouds."""
    if not SMALLEST * 2**80 < spread < LARGEST:
        return {}
    difference = abs(Fraction(word_to_float(raw.rss)) - truth.rss)
    found = {"floor": float(difference / spread)}
    return found | ({"rss": float(difference / truth.rss)} if truth.rss else {})


def real(matrix: Matrix, scale: Fraction) -> FloatArray:
    """A rational matrix times a scale as doubles."""
    return np.array([[float(x * scale) for x in row] for row in matrix])


def covariance_errors(case: Case, raw: RawResult, truth: ExactPose, m: ExactMoments) -> dict[str, float]:
    """Against golden.py on the exact moments, with the exact rss where the core estimates the variance."""
    if raw.q_cov is None or raw.t_cov is None or truth.q is None:
        return {}
    # in units of the spread's root, whose square is 1: nothing leaves double's range
    spread = sum(Fraction(m.saa[i][i] + m.sbb[i][i]) for i in range(3))
    scale = Fraction(m.weight) / spread
    root = float(spread / m.weight**2) ** 0.5  # rms distance from the centroid, in bits
    unit = 2.0**-case.frame.frac
    moments = golden.Moments(
        m.n,
        float(m.weight),
        np.array([float(Fraction(x) / m.weight) for x in m.first_a]) / root,
        np.array([float(Fraction(x) / m.weight) for x in m.first_b]) / root,
        real(m.saa, scale),
        real(m.sbb, scale),
        real(m.sba, scale),
    )
    turned = golden.turn(moments, truth.turn)
    matrix = golden.moment_matrix(turned)
    det, numerator = golden.cramer(matrix, golden.moment_vector(turned))
    rotation = np.array([[float(x) for x in row] for row in truth.R])
    scalar, vector = turn_back(truth.turn, det, numerator)
    attitude = golden.Attitude(scalar, vector, rotation, truth.turn, matrix, turned, numerator / det)
    given = case.config.variance
    variance = given if given else float(truth.rss) / (3 * m.n - 6)
    if not given and float(truth.rss) < NOISY**2 * m.weight * (root * unit) ** 2:
        return {}  # rss is near its floor
    relative = variance / (root * unit) ** 2
    p_theta = golden.attitude_covariance(attitude, relative)
    jacobian = golden.gibbs_jacobian(np.array([float(x) for x in truth.q]))
    q_cov = jacobian @ p_theta @ jacobian.T
    t_cov = golden.translation_covariance(p_theta, rotation @ moments.mean_a, relative, moments.weight)
    found = {}
    for name, words, expected in (
        ("q_cov", raw.q_cov, q_cov),
        ("t_cov", raw.t_cov, t_cov * (root * unit) ** 2),
    ):
        size = float(np.linalg.norm(expected))
        if SMALLEST * 2**30 < size < LARGEST / 8:
            stored = np.zeros((3, 3))
            stored[UPPER] = floats(words)
            stored.T[UPPER] = stored[UPPER]
            found[name] = float(np.linalg.norm(stored - expected)) / size
    return found
