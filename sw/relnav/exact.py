# SPDX-License-Identifier: Apache-2.0
"""The exact solution of quantised points in rational arithmetic: all other arithmetic is measured against it.

Same mathematics as golden.py. Moments are the integers A^ = W A - m m^T (DESIGN's hats), W times the centred.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from operator import mul
from typing import TypeAlias

import numpy as np

from .attitude import TURN_SIGNS
from .quantise import QuantisedFrame

Number: TypeAlias = int | Fraction
Vector: TypeAlias = list[Number]
Matrix: TypeAlias = list[list[Number]]


@dataclass(frozen=True)
class ExactMoments:
    """n points, W, first moments m_a, m_b (3), hatted Sa, Sb, B = sum w b a^T (3 x 3); units 2^-frac."""

    n: int
    weight: int
    first_a: Vector
    first_b: Vector
    saa: Matrix
    sbb: Matrix
    sba: Matrix
    frac: int

    def turned(self, rotation: Matrix) -> ExactMoments:
        """The moments of (R a, b)."""
        back = transpose(rotation)
        return ExactMoments(
            self.n,
            self.weight,
            times(rotation, self.first_a),
            self.first_b,
            product(product(rotation, self.saa), back),
            self.sbb,
            product(self.sba, back),
            self.frac,
        )


@dataclass(frozen=True)
class ExactPose:
    """The exact pose, units applied; q None at 180 degrees.

    scalar, vector: (D, N), q = N / D, up to a common factor;  R, t;  rss: at integer weights;  turn: 0..3
    determinants: det M_k of the four turns, weight^3 unit^6;  determinant, kappa (cond M): of the turn taken
    """

    q: Vector | None
    scalar: Number
    vector: Vector
    R: Matrix
    t: Vector
    rss: Fraction
    turn: int
    determinants: tuple[Fraction, Fraction, Fraction, Fraction]
    determinant: Fraction
    kappa: float


class Singular(Exception):
    """det M of the turn taken is exactly zero: collinear points, or 180 degrees without a turn."""


def exact_moments(frame: QuantisedFrame) -> ExactMoments:
    """The integer moments of a frame."""
    a = [column.tolist() for column in frame.a.T]
    b = [column.tolist() for column in frame.b.T]
    weights = None if frame.w is None else frame.w.tolist()
    wa = a if weights is None else [list(map(mul, weights, column)) for column in a]
    wb = b if weights is None else [list(map(mul, weights, column)) for column in b]
    total = frame.n if weights is None else sum(weights)
    ma, mb = [sum(column) for column in wa], [sum(column) for column in wb]

    def hat(left: list[list[int]], ml: list[int], right: list[list[int]], mr: list[int]) -> Matrix:
        return [
            [total * sum(map(mul, left[i], right[j])) - ml[i] * mr[j] for j in range(3)] for i in range(3)
        ]

    return ExactMoments(
        frame.n,
        total,
        list(ma),
        list(mb),
        hat(wa, ma, a, ma),
        hat(wb, mb, b, mb),
        hat(wb, mb, a, ma),
        frame.frac,
    )


def matrix_hat(m: ExactMoments) -> Matrix:
    """W M, M = tr(S) I - S."""
    s = [[m.saa[i][j] + m.sbb[i][j] + m.sba[i][j] + m.sba[j][i] for j in range(3)] for i in range(3)]
    trace = s[0][0] + s[1][1] + s[2][2]
    return [[(trace if i == j else 0) - s[i][j] for j in range(3)] for i in range(3)]


def vector_hat(m: ExactMoments) -> Vector:
    """W z, z = 2 [B32 - B23, B13 - B31, B21 - B12]."""
    b = m.sba
    return [2 * (b[2][1] - b[1][2]), 2 * (b[0][2] - b[2][0]), 2 * (b[1][0] - b[0][1])]


def turn_determinants(m: ExactMoments) -> tuple[Number, Number, Number, Number]:
    """det (W M_k) of the four turns."""
    none, x, y, z = (determinant(matrix_hat(m.turned(turn_matrix(k)))) for k in range(4))
    return none, x, y, z


def solve(
    frame: QuantisedFrame, *, turn: int | None = None, forbid_turns: bool = False, reapply: bool = False
) -> ExactPose:
    """Eq. 25 of the turned points, turned back.

    turn: 0..3, or None for the exact largest det M_k, the first of equals.
    Raises Singular.
    """
    m = exact_moments(frame)
    dets = turn_determinants(m)
    if turn is None:
        turn = 0 if forbid_turns else max(range(4), key=lambda k: dets[k])
    hat = matrix_hat(m.turned(turn_matrix(turn)))
    scalar, vector = _apply(m.turned(turn_matrix(turn)))
    if turn:
        scalar, vector = hamilton((0, [-1 if i == turn - 1 else 0 for i in range(3)]), (scalar, vector))
    if reapply:
        scalar, vector = hamilton((scalar, vector), _apply(m.turned(rotation_of(scalar, vector))))
    rotation = rotation_of(scalar, vector)
    weight, unit = m.weight, Fraction(2) ** -m.frac
    turned_mean = times(rotation, m.first_a)
    overlap = sum(rotation[i][j] * m.sba[i][j] for i in range(3) for j in range(3))
    trace = sum(m.saa[i][i] + m.sbb[i][i] for i in range(3))
    volume = unit**6 / Fraction(weight) ** 3
    none, x, y, z = (Fraction(d) * volume for d in dets)
    return ExactPose(
        q=None if scalar == 0 else [Fraction(v) / scalar for v in vector],
        scalar=scalar,
        vector=vector,
        R=rotation,
        t=[(m.first_b[i] - turned_mean[i]) * unit / weight for i in range(3)],
        rss=(trace - 2 * overlap) * unit**2 / weight,
        turn=turn,
        determinants=(none, x, y, z),
        determinant=(none, x, y, z)[turn],
        kappa=kappa(hat),
    )


def rotation_of(scalar: Number, vector: Sequence[Number]) -> Matrix:
    """R = [(D^2 - N.N) I + 2 N N^T - 2 D [N x]] / (D^2 + N.N)."""
    x, y, z = vector
    square = x * x + y * y + z * z
    size = Fraction(scalar * scalar + square)
    cross: Matrix = [[0, -z, y], [z, 0, -x], [-y, x, 0]]
    return [
        [
            (
                (scalar * scalar - square if i == j else 0)
                + 2 * vector[i] * vector[j]
                - 2 * scalar * cross[i][j]
            )
            / size
            for j in range(3)
        ]
        for i in range(3)
    ]


def kappa(matrix: Matrix) -> float:
    """cond M = largest / smallest eigenvalue of a symmetric positive matrix, infinite when singular.

    The smallest is taken from the exact adjugate, where it is the largest: good at any condition.
    """
    det = determinant(matrix)
    if det <= 0:
        return np.inf
    trace = Fraction(matrix[0][0] + matrix[1][1] + matrix[2][2])
    large = np.linalg.eigvalsh([[float(x / trace) for x in row] for row in matrix])[-1]
    inverse = np.linalg.eigvalsh([[float(x * trace / det) for x in row] for row in adjugate(matrix)])[-1]
    return float(large * inverse)


def adjugate(m: Matrix) -> Matrix:
    """adj(M) of a 3 x 3."""

    def minor(i: int, j: int) -> Number:
        (r, s), (c, d) = [k for k in range(3) if k != i], [k for k in range(3) if k != j]
        return m[r][c] * m[s][d] - m[r][d] * m[s][c]

    return [[(-1) ** (i + j) * minor(j, i) for j in range(3)] for i in range(3)]


def determinant(m: Matrix) -> Number:
    """det of a 3 x 3."""
    adj = adjugate(m)
    return m[0][0] * adj[0][0] + m[0][1] * adj[1][0] + m[0][2] * adj[2][0]


def turn_matrix(k: int) -> Matrix:
    """The 180 degree turn about none, x, y, z."""
    return [[TURN_SIGNS[k][i] if i == j else 0 for j in range(3)] for i in range(3)]


def hamilton(p: tuple[Number, Vector], q: tuple[Number, Vector]) -> tuple[Number, Vector]:
    """Product of (D, N)s: of R1 and R2 in this order gives that of R2 R1."""
    (d, u), (e, v) = p, q
    scalar = d * e - u[0] * v[0] - u[1] * v[1] - u[2] * v[2]
    cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
    return scalar, [d * v[i] + e * u[i] + cross[i] for i in range(3)]


def times(m: Matrix, v: Sequence[Number]) -> Vector:
    """M v."""
    return [sum(m[i][j] * v[j] for j in range(3)) for i in range(3)]


def product(m: Matrix, n: Matrix) -> Matrix:
    """M N."""
    return [[sum(m[i][k] * n[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def transpose(m: Matrix) -> Matrix:
    """M^T."""
    return [[m[j][i] for j in range(3)] for i in range(3)]


def _apply(m: ExactMoments) -> tuple[Number, Vector]:
    """(D, N) of Eq. 25."""
    hat = matrix_hat(m)
    det = determinant(hat)
    if det == 0:
        raise Singular
    return det, [-x for x in times(adjugate(hat), vector_hat(m))]
