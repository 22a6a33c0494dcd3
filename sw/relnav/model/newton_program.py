# SPDX-License-Identifier: Apache-2.0
"""Re-application: one Newton step on Wahba's cost from OLTAE's quaternion, in the tangent space of rotations.

rss = T - 2 p^T K p / |p|^2 with Davenport's K; e_0 = p, e_c = (0, unit c) (x) p turns p about axis c.
With lambda = p^T K p, g_c = e_c^T K p, H = e^T K e and r = 2/|p|^2:

  M'' = r (lambda I - H), C = adj M'', D = det M'', N = C r g, p'' = p + sum N_c e_c / D

which is what OLTAE gives on the moments turned by R(p), to second order in the noise. M'' replaces M, so
that with q = 0 for the turned points the covariance of the second application, 4 s^2 M''^-1, comes out of the
same program.
"""

from __future__ import annotations

from relnav.model import assembler as asm
from relnav.model import pose_program as pose
from relnav.model.assembler import ALL, Dot, Term
from relnav.model.pose_program import CD, CO, MD, MO, ONE, RECIPROCAL_NORM, RECIPROCAL_P0, P, item

K_TRACE = 28  # tr 2B
Y = (24, 1, 2, 3)  # K e_c, c = lane
H = (16, 25, 26, 27)  # e_c^T K e_lane; c = 0: g (lane 0: lambda)
LAMBDA = 28
GRADIENT = 0  # r g_c at + 1..3
DETERMINANT = 4
NUMERATOR = (DETERMINANT, 29, 30, 31)
RECIPROCAL_DETERMINANT = RECIPROCAL_NORM  # keeps the exponents of p'' those of p
STEPPED = 24  # D p''_lane

# sign of p_(m ^ c) in e_c[m]
BASIS = {0: (1, 1, 1, 1), 1: (1, -1, -1, 1), 2: (1, 1, -1, -1), 3: (1, -1, 1, -1)}
SLOT = {1: 1, 2: 2, 3: 0}  # of the pair whose third axis is k


def minus(component: int) -> frozenset[int]:
    """Lanes c in which e_c has a negative sign at `component`."""
    return frozenset(c for c in range(4) if BASIS[c][component] < 0)


def element(row: int, column: int) -> int:
    """Register or stream item that holds K_(row, column).

    K carries tr 2B / 2 times I more, which cancels in lambda I - H: its diagonal is
    (tr 2B, 2B_11, 2B_22, 2B_33).
    """
    k = row ^ column
    if k == 0:
        return item(row - 1, pose.KIND_B2) if row else K_TRACE
    return item(SLOT[k], pose.KIND_N if 0 in (row, column) else pose.KIND_P)


def moments() -> list[Dot]:
    """2/|p|^2, K e_c by lane, e_c^T K e_d."""
    trace = Dot(
        "tr 2B",
        [Term(item(axis, pose.KIND_B2), ONE) for axis in range(3)],
        reference=asm.REF_NEWTON,
        write=asm.BROADCAST,
        source=0,
        dest=K_TRACE,
    )
    norm = Dot(
        "|p|^2 / 2",
        [Term(P + c, P + c) for c in range(4)],
        half=True,
        reference=asm.REF_QUATERNION,
        write=asm.NO_WRITE,
        source=0,
        divide=asm.DIVIDE,
        divide_dest=RECIPROCAL_NORM,
    )
    # lane c has the whole of K e_c
    images = []
    for row in (1, 2, 3, 0):
        terms = [
            Term(element(row, row ^ d), P + (row ^ d), negate=minus(row ^ d), y_by_lane=True)
            for d in range(4)
        ]
        images.append(Dot(f"Y{row}", terms, reference=asm.REF_IMAGE, dest=Y[row]))

    def product(c: int) -> list[Term]:
        return [Term(Y[m], P + (m ^ c), negate=ALL if BASIS[c][m] < 0 else frozenset()) for m in (1, 2, 3, 0)]

    eigenvalue = Dot("lambda", product(0), reference=asm.REF_FORM, write=asm.BROADCAST, source=0, dest=LAMBDA)
    forms = [Dot(f"H{c}", product(c), reference=asm.REF_FORM, dest=H[c]) for c in (1, 2, 3, 0)]
    return [trace, *images, norm, eigenvalue, *forms]


def system() -> list[Dot]:
    """M'' and r g, broadcast."""
    dots = []
    for i, j, k in pose.AXES:
        dots.append(
            Dot(
                f"M''{i}{j}",
                [Term(H[j], RECIPROCAL_NORM, negate=ALL)],
                reference=asm.REF_NEWTON,
                write=asm.BROADCAST,
                source=i,
                dest=MO + k,
            )
        )
    dots += [
        Dot(
            f"M''{i}{i}",
            [Term(LAMBDA, RECIPROCAL_NORM), Term(H[i], RECIPROCAL_NORM, negate=ALL)],
            reference=asm.REF_NEWTON,
            write=asm.BROADCAST,
            source=i,
            dest=MD + i,
        )
        for i in (1, 2, 3)
    ]
    dots += [
        Dot(
            f"g{i}",
            [Term(H[0], RECIPROCAL_NORM)],
            write=asm.BROADCAST,
            source=i,
            dest=GRADIENT + i,
        )
        for i in (1, 2, 3)
    ]
    return dots


def step() -> list[Dot]:
    """D, N, p''."""
    dots = [
        *pose.adjugate(asm.REF_COFACTOR),
        Dot(
            "D''",
            pose.determinant_terms(),
            reference=asm.REF_PROBED,
            write=asm.BROADCAST,
            source=0,
            dest=DETERMINANT,
            divide=asm.DIVIDE,
            divide_dest=RECIPROCAL_DETERMINANT,
        ),
    ]
    for i in (1, 2, 3):
        terms = [Term(CD + j if i == j else CO + (i ^ j), GRADIENT + j) for j in (1, 2, 3)]
        dots.append(
            Dot(f"N''{i}", terms, reference=asm.REF_PROBED, write=asm.BROADCAST, source=0, dest=NUMERATOR[i])
        )
    terms = [
        Term(P + c, NUMERATOR[c], negate=frozenset(m for m in range(4) if BASIS[c][m] < 0), x_by_lane=True)
        for c in range(4)
    ]
    dots.append(Dot("p''", terms, reference=asm.REF_PROBED, dest=STEPPED))
    for c in range(4):
        first = c == 0
        dots.append(
            Dot(
                f"P''{c}",
                [Term(STEPPED, RECIPROCAL_DETERMINANT)],
                write=asm.BROADCAST,
                source=c,
                dest=P + c,
                track=asm.TRACK_AFRESH if first else asm.TRACK_QUATERNION,
                divide=asm.DIVIDE if first else asm.NO_DIVIDE,
                divide_dest=RECIPROCAL_P0 if first else None,
            )
        )
    return dots


def program() -> list[Dot]:
    """The whole step in issue order."""
    return [*moments(), *system(), *step()]
