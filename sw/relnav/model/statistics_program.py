# SPDX-License-Identifier: Apache-2.0
"""The second half of the microprogram: residual, conditioning, determinant and the covariances of q and t.

Everything here is dimensioned by data, so every dot product is probed: run once for its largest exponent,
once for its sum. With q, M, S of the chosen turn and p the composed quaternion:

  rss = p^T (T I - 2 K) p / (|p|^2 W), K Davenport's matrix of B, two limbs a moment (see the datasheet)
  condition = tr M tr M^-1, determinant = det M / W^3
  P_theta = 4 s^2/(1+q^2)^2 [(1+q^2)(U + V) - V S V^T], U = (I - Q) M^-1, V = U Q      (attitude error, rad^2)
  t_cov = s^2/W I + [c x] P_theta [c x]^T, c = R m_a/W
  q_cov = L P_theta L^T, L = (I + Q + q q^T)/2 of the composed q
  s^2 = VARIANCE, or rss / (3n - 6) where that is 0.
"""

from __future__ import annotations

from relnav.model import assembler as asm
from relnav.model import pose_program as pose
from relnav.model.assembler import ALL, STREAM, Dot, Term, lanes
from relnav.model.pose_program import CA, CD, CO, MD, MO, ONE, ROWS, P, item

# stream bank, after the second drain: the low limbs take the places of what is no longer needed
KIND_T_LOW, KIND_P_LOW, KIND_N_LOW, KIND_B2_LOW = pose.KIND_E, pose.KIND_F, pose.KIND_H, pose.KIND_MA

# registers, over what the pose program no longer needs
TWO_P = 28  # 2 p                                                    (block, over C_b)
RECIPROCAL_W, RECIPROCAL_P0, RECIPROCAL_NORM = pose.RECIPROCAL_W, pose.RECIPROCAL_P0, pose.RECIPROCAL_NORM
RSS = 24  # rss, then s^2                                            (over u)
ROTATED = CA  # c = R m_a / W                                        (block, over m_a / W)
RESIDUAL = (1, 2, 3, 4)  # v = (T I - 2 K) p                         (over A)
D, RECIPROCAL_D = 20, 28  #                                          (over 2/|p|^2, 2 p)
Q_TURN = 28  # q of the chosen turn at + 1..3
S_DIAGONAL, S_OFF = 0, MO  # S_ii at + 1..3 (over v), S_ij in place of M_ij
TRACE_S, TRACE_INVERSE = 17, 18
W_NORM = 20  # 1 + q^2                                               (over D)
U_ROW, V_ROW, Y_ROW = (17, 18, 19), (5, 6, 7), (4, 9, 10)  # private rows, i = lane
V_ALL = (1, 2, 3)  # one row of V at a time
THETA_ROW = (29, 30, 31)  # P_theta (unscaled), row private          (over q)
TWO, FREEDOM = 21, 22
RECIPROCAL_FREEDOM, RECIPROCAL_NORM_Q = 23, 28
SCALE, VARIANCE_W = 20, 21  # 4 s^2/(1+q^2)^2, s^2/W
CROSS_ROW = (17, 18, 19)  # [c x] P_theta
Q = 28  # composed q at + 1..3
QP = (1, 2, 3)  # q^T P_theta
L_ROW, LQ = (21, 22, 23), 20  # L P_theta (row private), its product with q


def arrival(start: int) -> dict[int, int]:
    """First cycle in which each low limb can be read; the first item of the second drain is due at start."""
    order: list[int | None] = []
    for slot in (0, 1, 2):
        order += [item(slot, KIND_T_LOW), None, item(slot, KIND_B2_LOW)]
    for slot in (0, 2, 1):
        order += [None, None, item(slot, KIND_P_LOW), item(slot, KIND_N_LOW)]
    return {address: start + place + 1 for place, address in enumerate(order) if address is not None}


def epsilon(i: int, k: int) -> tuple[int, int]:
    """[x cross]_ik = sign * x_l: (sign, l) for i != k in 1..3."""
    other = i ^ k
    sign = -1 if (i, k) in ((1, 2), (2, 3), (3, 1)) else 1
    return sign, other


def probed(name: str, terms: list[Term], **keywords: object) -> Dot:
    """A dot product whose reference is probed."""
    return Dot(name, terms, reference=asm.REF_PROBED, **keywords)  # type: ignore[arg-type]


def symmetric_row(
    diagonal: int, off: int, j: int, c: int, y: int, y_by_lane: bool, negate: frozenset[int]
) -> list[Term]:
    """Terms X_(i^c, j) * y of lane i = 1..3, X symmetric in the blocks diagonal[i] and off[i^j]."""
    diagonal_lane = frozenset({j ^ c}) & ROWS
    off_lanes = frozenset(i for i in ROWS if i ^ c not in (0, j))
    terms = []
    if diagonal_lane:
        terms.append(Term(diagonal + j, y, negate=negate, enable=diagonal_lane, y_by_lane=y_by_lane))
    if off_lanes:
        terms.append(
            Term(off + (c ^ j), y, negate=negate, enable=off_lanes, x_by_lane=True, y_by_lane=y_by_lane)
        )
    return terms


def cross_rows(diagonal: int, off: int, vector: int, j: int, sign: int) -> list[Term]:
    """Terms of sign * ([v x] X)_ij in lane i, X symmetric, v = registers vector + 1..3."""
    terms = []
    for c in (1, 2, 3):
        minus = frozenset(i for i in ROWS if i != c and sign * epsilon(i, i ^ c)[0] < 0)
        terms += symmetric_row(diagonal, off, j, c, vector + c, False, minus)
    return terms


def residual() -> list[Dot]:
    """c = R m_a/W, then rss from the two limbs of every moment in the wide lane 0."""
    dots = [
        probed(
            f"c{i}",
            [Term(pose.U, RECIPROCAL_NORM), Term(CA + i, ONE, negate=ALL, enable=lanes(2, 3))],
            write=asm.BROADCAST,
            source=i,
            dest=ROTATED + i,
        )
        for i in (1, 2, 3)
    ]
    dots += [
        Dot(f"2p{c}", [Term(P + c, ONE), Term(P + c, ONE)], write=asm.BROADCAST, source=0, dest=TWO_P + c)
        for c in range(4)
    ]

    def limbs(slot: int, high: int, low: int, y: int, negate: bool) -> list[Term]:
        sign = ALL if negate else frozenset()
        return [Term(item(slot, kind), y, negate=sign) for kind in (high, low)]

    for row in range(4):
        terms = []
        for axis in (1, 2, 3):
            terms += limbs(axis - 1, pose.KIND_T, KIND_T_LOW, P + row, False)
            # L_00 = T - tr 2B; L_ii = T + tr 2B - 2 (2B_ii)
            terms += limbs(axis - 1, pose.KIND_B2, KIND_B2_LOW, P + row, row in (0, axis))
        for c in (1, 2, 3):
            column = row ^ c
            slot = {1: 1, 2: 2, 3: 0}[c]  # of the pair (i, j) whose third axis is c
            crossed = 0 in (row, column)
            high, low = (pose.KIND_N, KIND_N_LOW) if crossed else (pose.KIND_P, KIND_P_LOW)
            terms += limbs(slot, high, low, TWO_P + column, True)
        dots.append(probed(f"v{row}", terms, write=asm.BROADCAST, source=0, dest=RESIDUAL[row]))
    dots += [
        probed("pLp", [Term(RESIDUAL[c], P + c) for c in range(4)], write=asm.BROADCAST, source=0, dest=RSS),
        Dot("rss W", [Term(RSS, RECIPROCAL_NORM)], half=True, write=asm.BROADCAST, source=0, dest=RSS),
        Dot(
            "rss",
            [Term(RSS, RECIPROCAL_W)],
            clamp=True,
            write=asm.BROADCAST,
            source=0,
            dest=RSS,
            output=asm.SINGLE,
            output_index=18,
        ),
    ]
    return dots


def determinant() -> list[Dot]:
    """det M of the chosen turn, its reciprocal, and det M / W^3."""
    dots = [
        Dot(
            "D",
            pose.determinant_terms(),
            reference=asm.REF_PROBED,
            write=asm.BROADCAST,
            source=asm.TURN,
            dest=D,
            divide=asm.DIVIDE,
            divide_dest=RECIPROCAL_D,
        )
    ]
    for power in (1, 2, 3):
        last = power == 3
        dots.append(
            Dot(
                f"D/W^{power}",
                [Term(D, RECIPROCAL_W)],
                write=asm.NO_WRITE if last else asm.BROADCAST,
                source=0,
                dest=D,
                output=asm.SINGLE if last else asm.NO_OUTPUT,
                output_index=20,
            )
        )
    return dots


def inverse() -> list[Dot]:
    """S, q and M^-1 of the chosen turn in every lane; the condition number."""

    def copy(name: str, terms: list[Term], dest: int, half: bool = False) -> Dot:
        return probed(name, terms, half=half, write=asm.BROADCAST, source=asm.TURN, dest=dest)

    dots = []
    for i in (1, 2, 3):
        others = [k for k in (1, 2, 3) if k != i]
        terms = [Term(MD + k, ONE) for k in others] + [Term(MD + i, ONE, negate=ALL)]
        dots.append(copy(f"S{i}{i}", terms, S_DIAGONAL + i, half=True))
    dots += [copy(f"S off {k}", [Term(MO + k, ONE, negate=ALL)], S_OFF + k) for k in (1, 2, 3)]
    # twice: p carries half the determinant
    dots += [copy(f"q turn {c}", [quaternion_of_turn(c)] * 2, Q_TURN + c) for c in (1, 2, 3)]
    dots += [copy(f"M^-1 {c}{c}", [Term(CD + c, RECIPROCAL_D)], CD + c) for c in (1, 2, 3)]
    dots += [copy(f"M^-1 off {k}", [Term(CO + k, RECIPROCAL_D)], CO + k) for k in (1, 2, 3)]
    for name, base, dest in (("tr S", S_DIAGONAL, TRACE_S), ("tr M^-1", CD, TRACE_INVERSE)):
        terms = [Term(base + i, ONE) for i in (1, 2, 3)]
        dots.append(probed(name, terms, write=asm.BROADCAST, source=0, dest=dest))
    product = Term(TRACE_S, TRACE_INVERSE)
    dots.append(
        Dot(
            "condition",
            [product, product],
            write=asm.NO_WRITE,
            output=asm.SINGLE,
            output_index=19,
            mark="basic",
        )
    )
    return dots


def quaternion_of_turn(c: int) -> Term:
    """p_c of the lane's turn from the composed one, times 1/D: P_(c^lane) = +-p_c."""
    minus = frozenset(lane for lane in range(4) if pose.QUATERNION_SIGN[lane, c ^ lane] < 0)
    # after a re-application it stands for the points turned by R, whose q is 0
    return Term(P + c, RECIPROCAL_D, negate=minus, x_by_lane=True, only_first=True)


def attitude() -> list[Dot]:
    """P_theta, unscaled, by rows."""
    dots = [
        probed(
            "1 + q^2",
            [Term(ONE, ONE), *(Term(Q_TURN + c, Q_TURN + c) for c in (1, 2, 3))],
            write=asm.BROADCAST,
            source=0,
            dest=W_NORM,
        )
    ]
    for j in (1, 2, 3):
        terms = symmetric_row(CD, CO, j, 0, ONE, False, frozenset()) + cross_rows(CD, CO, Q_TURN, j, -1)
        dots.append(probed(f"U.{j}", terms, dest=U_ROW[j - 1]))
    for j in (1, 2, 3):
        terms = []
        for k in (1, 2, 3):
            if k != j:
                sign, axis = epsilon(k, j)
                terms.append(
                    Term(U_ROW[k - 1], Q_TURN + axis, negate=ALL if sign < 0 else frozenset(), enable=ROWS)
                )
        dots.append(probed(f"V.{j}", terms, dest=V_ROW[j - 1]))
    for j in (1, 2, 3):
        terms = [
            Term(V_ROW[k - 1], S_DIAGONAL + j if k == j else S_OFF + (k ^ j), enable=ROWS) for k in (1, 2, 3)
        ]
        dots.append(probed(f"Y.{j}", terms, dest=Y_ROW[j - 1]))
    for j in (1, 2, 3):
        dots += [
            Dot(f"V{j}{k}", [Term(V_ROW[k - 1], ONE)], write=asm.BROADCAST, source=j, dest=V_ALL[k - 1])
            for k in (1, 2, 3)
        ]
        terms = [Term(U_ROW[j - 1], W_NORM, enable=ROWS), Term(V_ROW[j - 1], W_NORM, enable=ROWS)]
        terms += [Term(Y_ROW[k - 1], V_ALL[k - 1], negate=ALL, enable=ROWS) for k in (1, 2, 3)]
        dots.append(probed(f"theta.{j}", terms, dest=THETA_ROW[j - 1]))
    return dots


def variance() -> list[Dot]:
    """s^2, the scale of P_theta, s^2/W; then P_theta itself, broadcast."""
    count = STREAM + pose.ITEM_COUNT

    def scalar(name: str, terms: list[Term], dest: int) -> Dot:
        return probed(name, terms, write=asm.BROADCAST, source=0, dest=dest)

    def divide(name: str, register: int, dest: int) -> Dot:
        return Dot(
            name,
            [Term(register, ONE)],
            write=asm.NO_WRITE,
            source=0,
            divide=asm.DIVIDE,
            divide_dest=dest,
        )

    dots = [
        divide("1/(1 + q^2)", W_NORM, RECIPROCAL_NORM_Q),
        Dot("2", [Term(ONE, ONE), Term(ONE, ONE)], write=asm.BROADCAST, source=0, dest=TWO),
        scalar("3n - 6", [Term(count, ONE)] * 3 + [Term(TWO, ONE, negate=ALL)] * 3, FREEDOM),
        divide("1/(3n - 6)", FREEDOM, RECIPROCAL_FREEDOM),
        scalar(
            "s^2",
            [
                Term(STREAM + pose.ITEM_VARIANCE, ONE),
                Term(RSS, RECIPROCAL_FREEDOM, only_estimated=True),
            ],
            RSS,
        ),
        scalar("s^2/W", [Term(RSS, RECIPROCAL_W)], VARIANCE_W),
        scalar("2/(1 + q^2)", [Term(RECIPROCAL_NORM_Q, ONE)] * 2, RECIPROCAL_NORM_Q),
        scalar("s^2 2/(1 + q^2)", [Term(RSS, RECIPROCAL_NORM_Q)], SCALE),
        scalar("scale / W", [Term(SCALE, RECIPROCAL_NORM_Q)], SCALE),
        # centred moments carry a factor W, so M^-1 lacks one
        scalar("scale", [Term(STREAM + pose.ITEM_W, SCALE)], SCALE),
    ]
    for i in (1, 2, 3):
        for j in range(i, 4):
            dest = CD + i if i == j else CO + (i ^ j)
            dots.append(
                Dot(
                    f"theta{i}{j}",
                    [Term(THETA_ROW[j - 1], SCALE)],
                    write=asm.BROADCAST,
                    source=i,
                    dest=dest,
                )
            )
    return dots


def outputs(name: str, index: int, columns: list[list[Term]], half: bool, mark: str) -> list[Dot]:
    """Upper triangle of a symmetric matrix whose row i is in lane i: columns 1, 2, 3 of terms."""
    kinds = (asm.TRIPLE, asm.PAIR, asm.THIRD)
    starts = (index, index + 2, index + 3)
    return [
        probed(
            f"{name}.{j + 1}",
            terms,
            half=half,
            write=asm.NO_WRITE,
            output=kinds[j],
            output_index=starts[j],
            mark=mark if j == 2 else "",
        )
        for j, terms in enumerate(columns)
    ]


def translation_covariance() -> list[Dot]:
    """t_cov = s^2/W I + [c x] P_theta [c x]^T."""
    dots = [
        probed(f"[c x] theta.{j}", cross_rows(CD, CO, ROTATED, j, 1), dest=CROSS_ROW[j - 1])
        for j in (1, 2, 3)
    ]
    columns = []
    for j in (1, 2, 3):
        terms = [Term(VARIANCE_W, ONE, enable=lanes(j))]
        for k in (1, 2, 3):
            if k != j:
                sign, axis = epsilon(j, k)
                terms.append(
                    Term(
                        CROSS_ROW[k - 1], ROTATED + axis, negate=ALL if sign < 0 else frozenset(), enable=ROWS
                    )
                )
        columns.append(terms)
    return dots + outputs("t_cov", 28, columns, False, "")


def rodrigues_covariance() -> list[Dot]:
    """q_cov = L P_theta L^T, L = (I + Q + q q^T) / 2 of the composed q."""
    dots = [
        Dot(
            f"q composed {c}",
            [Term(P + c, RECIPROCAL_P0)],
            write=asm.BROADCAST,
            source=0,
            dest=Q + c,
        )
        for c in (1, 2, 3)
    ]
    for j in (1, 2, 3):
        terms = [Term(CD + j if k == j else CO + (k ^ j), Q + k) for k in (1, 2, 3)]
        dots.append(probed(f"q theta.{j}", terms, dest=QP[j - 1]))
    for j in (1, 2, 3):
        terms = symmetric_row(CD, CO, j, 0, ONE, False, frozenset()) + cross_rows(CD, CO, Q, j, 1)
        terms.append(Term(Q, QP[j - 1], enable=ROWS, x_by_lane=True))
        dots.append(probed(f"L theta.{j}", terms, half=True, dest=L_ROW[j - 1]))
    dots.append(probed("L theta q", [Term(L_ROW[k - 1], Q + k, enable=ROWS) for k in (1, 2, 3)], dest=LQ))
    columns = []
    for j in (1, 2, 3):
        terms = [Term(L_ROW[j - 1], ONE, enable=ROWS), Term(LQ, Q + j, enable=ROWS)]
        for k in (1, 2, 3):
            if k != j:
                sign, axis = epsilon(j, k)
                terms.append(
                    Term(L_ROW[k - 1], Q + axis, negate=ALL if sign < 0 else frozenset(), enable=ROWS)
                )
        columns.append(terms)
    return dots + outputs("q_cov", 22, columns, True, "all")


def program(covariance: bool) -> list[Dot]:
    """Everything after the pose."""
    basic = [*residual(), *determinant(), *inverse()]
    if not covariance:
        return basic
    return [*basic, *attitude(), *variance(), *translation_covariance(), *rodrigues_covariance()]
