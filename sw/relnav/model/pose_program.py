# SPDX-License-Identifier: Apache-2.0
"""The pose microprogram: moments of the two clouds -> q, R, t (OLTAE, Eqs. 25, 3, 12 by Cramer's rule).

With S = sum w (b+a)(b+a)^T of the points turned by the lane's half turn d = diag(+-1), M = tr(S) I - S,
z = sum w (s x y) (halved here, and D with it): C = adj M, D = det M, N = -C z, p = (D, N) is the unnormalised
quaternion of the lane's turn; undoing the turn permutes it: P_c = +-p_(c XOR lane).
R = 2 A/|p|^2 - I, A_im = p_i p_m -+ p_0 p_k, A_mm = p_m^2 + p_0^2; t = m_b/W - R m_a/W.
"""

from __future__ import annotations

from relnav.model import assembler as asm
from relnav.model.assembler import ALL, STREAM, Dot, Term, lanes

# stream bank: slot*8 + kind
KIND_T, KIND_E, KIND_F, KIND_H, KIND_P, KIND_N, KIND_B2, KIND_MA = range(8)
ITEM_W, ITEM_MB, ITEM_COUNT, ITEM_VARIANCE = 24, 25, 28, 29

# result registers; blocks of four are addressed by lane
ONE = 0  # constant; also z[0]
Z = 0
DET = 4  # also adjugate diagonal block: [D, C11, C22, C33]
CD = 4
CO = 8  # [1/W, C23, C13, C12]
RECIPROCAL_W = 8
P = 12
MD = 16  # [1/p0, M11, M22, M33]
RECIPROCAL_P0 = 16
MO = 20  # [2/|p|^2, M23, M13, M12]
RECIPROCAL_NORM = 20
CA = 24  # [., ca1, ca2, ca3]
CB = 28  # [., cb1, cb2, cb3]
U = 24
HALF_NORM = 24  # |p|^2 / 2, until u takes its place
A = 0  # A_m at A + m, over z

ROWS = lanes(1, 2, 3)  # lane = matrix row

AXES = ((1, 2, 3), (2, 3, 1), (3, 1, 2))  # (i, j, k): pair (i, j) of slot i-1, third axis k


def item(slot: int, kind: int) -> int:
    """Stream address of an item of pair slot 0..2."""
    return STREAM + slot * 8 + kind


def flips(axis: int) -> frozenset[int]:
    """Lanes whose turn flips ``axis``."""
    return frozenset({1, 2, 3} - {axis})


def arrival() -> dict[int, int]:
    """First cycle in which each stream item can be read; cycle 0 is the first item's."""
    order = [item(s, k) for s in (0, 1, 2) for k in (KIND_T, KIND_E, KIND_B2)]
    order += [item(s, k) for s in (0, 2, 1) for k in (KIND_F, KIND_H, KIND_P, KIND_N)]
    order += [STREAM + ITEM_W] + [item(s, KIND_MA) for s in range(3)]
    order += [STREAM + ITEM_MB + s for s in range(3)] + [STREAM + ITEM_COUNT, STREAM + ITEM_VARIANCE]
    return {address: cycle + 1 for cycle, address in enumerate(order)}


def references() -> dict[int, int]:
    """First cycle in which a dot product may begin that uses a scale of the stream, looked up a cycle on."""
    ready = arrival()
    return {
        asm.REF_MOMENT: ready[item(2, KIND_T)] - 1,
        asm.REF_CROSS: ready[item(1, KIND_N)] - 1,
    }


def moment_matrix() -> list[Dot]:
    """M and z of every lane's turn, in one fixed format each."""

    def diagonal(k: int) -> Dot:
        i, j = sorted({1, 2, 3} - {k})
        return Dot(
            f"M{k}{k}",
            [
                Term(item(i - 1, KIND_T), ONE),
                Term(item(j - 1, KIND_T), ONE),
                Term(item(i - 1, KIND_B2), ONE, negate=flips(i)),
                Term(item(j - 1, KIND_B2), ONE, negate=flips(j)),
            ],
            kind=asm.RAW,
            reference=asm.REF_MOMENT,
            dest=MD + k,
        )

    def off_diagonal(i: int, j: int, k: int) -> Dot:
        return Dot(
            f"M{i}{j}",
            [
                Term(item(i - 1, KIND_F), ONE, negate=lanes(0, k), alternate=lanes(i, j)),
                Term(item(i - 1, KIND_P), ONE, negate=lanes(0, j), alternate=lanes(i, j)),
            ],
            kind=asm.RAW,
            reference=asm.REF_MOMENT,
            dest=MO + k,
        )

    def cross(i: int, j: int, k: int) -> Dot:
        return Dot(
            f"z{k}",
            [Term(item(i - 1, KIND_N), ONE, negate=lanes(0, j), alternate=lanes(i, j))],
            kind=asm.RAW,
            reference=asm.REF_CROSS,
            dest=Z + k,
        )

    weight = Dot(
        "1/W",
        [Term(STREAM + ITEM_W, ONE)],
        write=asm.NO_WRITE,
        source=0,
        divide=asm.DIVIDE,
        divide_dest=RECIPROCAL_W,
    )
    first, second, third = AXES
    return [
        diagonal(3),
        diagonal(1),
        diagonal(2),
        off_diagonal(*first),
        off_diagonal(*third),
        off_diagonal(*second),
        cross(*third),
        weight,
        cross(*second),
        cross(*first),
    ]


def adjugate(reference: int = asm.OWN) -> list[Dot]:
    """C = adj M: first what the determinant needs, cofactors that need the last moment last."""

    def cofactor(name: str, dest: int, plus: tuple[int, int], minus: tuple[int, int]) -> Dot:
        return Dot(
            name, [Term(*plus), Term(*minus, negate=ALL)], kind=asm.RAW, reference=reference, dest=dest
        )

    m11, m22, m33 = MD + 1, MD + 2, MD + 3
    m23, m13, m12 = MO + 1, MO + 2, MO + 3
    return [
        cofactor("C11", CD + 1, (m22, m33), (m23, m23)),
        cofactor("C13", CO + 2, (m12, m23), (m13, m22)),
        cofactor("C12", CO + 3, (m13, m23), (m12, m33)),
        cofactor("C23", CO + 1, (m12, m13), (m11, m23)),
        cofactor("C33", CD + 3, (m11, m22), (m12, m12)),
        cofactor("C22", CD + 2, (m11, m33), (m13, m13)),
    ]


def determinant_terms() -> list[Term]:
    """det M = sum_j M_1j C_1j."""
    return [Term(MD + 1, CD + 1), Term(MO + 2, CO + 2), Term(MO + 3, CO + 3)]


def determinant() -> Dot:
    """D/2 of every turn; the largest chooses the turn."""
    return Dot(
        "D",
        determinant_terms(),
        half=True,
        write=asm.BROADCAST,
        source=asm.TURN,
        dest=DET,
        turn_dest=True,
        choose_turn=True,
        track=asm.TRACK_QUATERNION,
        divide=asm.DIVIDE_UNTURNED,
        divide_dest=RECIPROCAL_P0,
    )


# sign of p_(c ^ lane) in P_c
QUATERNION_SIGN = {
    (0, 0): 1, (1, 0): 1, (2, 0): 1, (3, 0): 1,
    (0, 1): 1, (1, 1): -1, (2, 1): -1, (3, 1): 1,
    (0, 2): 1, (1, 2): 1, (2, 2): -1, (3, 2): -1,
    (0, 3): 1, (1, 3): -1, (2, 3): 1, (3, 3): -1,
}  # fmt: skip


def quaternion(c: int) -> Dot:
    """P_c of every lane's turn, the turn undone; N = -C z, so N's terms carry the opposite sign."""
    minus_n = frozenset(lane for lane in range(4) if QUATERNION_SIGN[lane, c] > 0)
    minus_d = frozenset(lane for lane in range(4) if QUATERNION_SIGN[lane, c] < 0)
    terms = [
        Term(CO + k, Z + (c ^ k), negate=minus_n, enable=ALL - {c, c ^ k}, y_by_lane=True) for k in (1, 2, 3)
    ]
    sign = (minus_n - {c}) | (minus_d & {c})
    terms.append(
        Term(CD + c, Z + c, negate=sign, enable=ALL - {0} if c == 0 else ALL, x_by_lane=True, y_by_lane=True)
    )
    return Dot(
        f"P{c}",
        terms,
        write=asm.BROADCAST,
        source=asm.TURN,
        dest=P + c,
        only_turned=c == 0,
        track=asm.TRACK_QUATERNION,
        divide=asm.DIVIDE_TURNED if c == 0 else asm.NO_DIVIDE,
        divide_dest=RECIPROCAL_P0 if c == 0 else None,
    )


def centroids() -> list[Dot]:
    """m_a/W and m_b/W, broadcast."""
    dots = [
        Dot(
            f"ca{m}",
            [Term(item(m - 1, KIND_MA), RECIPROCAL_W)],
            write=asm.BROADCAST,
            source=0,
            dest=CA + m,
            track=asm.TRACK_CENTROID,
        )
        for m in (1, 2, 3)
    ]
    dots += [
        Dot(
            f"cb{m}",
            [Term(STREAM + ITEM_W + m, RECIPROCAL_W)],
            write=asm.BROADCAST,
            source=0,
            dest=CB + m,
            track=asm.TRACK_CENTROID,
        )
        for m in (1, 2, 3)
    ]
    return dots


def norm() -> Dot:
    """|p|^2 / 2 and its reciprocal."""
    return Dot(
        "den",
        [Term(P + c, P + c) for c in range(4)],
        half=True,
        reference=asm.REF_QUATERNION,
        write=asm.BROADCAST,
        source=0,
        dest=HALF_NORM,
        divide=asm.DIVIDE,
        divide_dest=RECIPROCAL_NORM,
    )


def rotation_numerators() -> list[Dot]:
    """A_im of row i = lane: R_im = 2 A_im/|p|^2 - delta_im.

    Column 1, which leaves first, has its delta inside already, as -|p|^2/2: its last slot is one earlier.
    """
    minus = {1: lanes(2), 2: lanes(3), 3: lanes(1)}

    def column(m: int, delta: list[Term]) -> Dot:
        terms = [
            Term(P, P + m, enable=ROWS, x_by_lane=True),
            Term(P, P + m, negate=minus[m], enable=ROWS, y_by_lane=True),
        ]
        return Dot(f"A{m}", terms + delta, reference=asm.REF_QUATERNION, dest=A + m)

    return [column(2, []), column(3, []), column(1, [Term(HALF_NORM, ONE, negate=ALL, enable=lanes(1))])]


def pose_outputs() -> list[Dot]:
    """R by column, t."""
    rotation = []
    for m in (1, 2, 3):
        delta = [Term(ONE, ONE, negate=ALL, enable=lanes(m))] if m != 1 else []
        rotation.append(
            Dot(
                f"R{m}",
                [Term(A + m, RECIPROCAL_NORM, enable=ROWS), *delta],
                reference=asm.REF_UNIT,
                write=asm.NO_WRITE,
                output=asm.TRIPLE_COLUMN,
                output_index=6 + m - 1,
            )
        )
    translation = Dot(
        "t",
        [
            Term(CA, ONE, enable=lanes(2, 3), x_by_lane=True),
            Term(CB, ONE, enable=ROWS, x_by_lane=True),
            Term(U, RECIPROCAL_NORM, negate=ALL, enable=ROWS),
        ],
        reference=asm.REF_CENTROID,
        write=asm.NO_WRITE,
        output=asm.TRIPLE,
        output_index=15,
        mark="pose",
    )
    return [*rotation, translation]


def rotated_centroid() -> Dot:
    """u = A m_a/W by row."""
    return Dot("u", [Term(CA + m, A + m, enable=ROWS) for m in (2, 3, 1)], reference=asm.REF_ROTATED, dest=U)


def rodrigues() -> list[Dot]:
    """q = P/P_0 as binary32."""
    return [
        Dot(
            f"q{c}",
            [Term(P + c, RECIPROCAL_P0)],
            write=asm.NO_WRITE,
            output=asm.SINGLE,
            output_index=c - 1,
            mark="q" if c == 3 else "",
        )
        for c in (1, 2, 3)
    ]


def rodrigues_fixed() -> list[Dot]:
    """q in the paper's Q15.16; read with the pose."""
    return [
        Dot(
            f"qfixed{c}",
            [Term(P + c, RECIPROCAL_P0)],
            kind=asm.FIXED,
            reference=asm.REF_FIXED,
            write=asm.NO_WRITE,
            output_index=c + 2,
        )
        for c in (1, 2, 3)
    ]


def program() -> list[Dot]:
    """The whole program in issue order."""
    return [
        *moment_matrix(),
        *adjugate(),
        determinant(),
        *(quaternion(c) for c in range(4)),
        *centroids(),
        *rodrigues(),
        norm(),
        *rotation_numerators(),
        *rodrigues_fixed(),
        rotated_centroid(),
        *pose_outputs(),
    ]
