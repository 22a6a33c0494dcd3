# SPDX-License-Identifier: Apache-2.0
"""The rates as a program of lane operations: L D L^T, triangular solves, two exact refinements, covariance.

Six lanes in step, lane i holding row i of [A | b], A = H^T W H, b = H^T W y (iVisNav paper, Eqs. 9-11), all
values binary32, each operation rounded by itself. One operation a cycle goes to all lanes:

    product = x * y        x of the lane's own; y of one lane (on the bus), of its own, or special
    sum     = c +- product

Moments and rates are scaled by powers of two (`rates_scale.py`), so that |A| < 1 and |b| < 1; the residuals
r = b - A x come from the exact integers (`rates_residual.py`).

Memory of a lane:
    A 0..5 row of A, 6 b, 7 (lane 0) used rows - 6            written by the moments, never again
    S 0..6 row being eliminated, then U (unit upper) and x at 6; 7 1/d; 8..13 row of the inverse; temporaries
    P 0..6 products awaiting 1/d
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from functools import cache

SIZE = 6
LANES = tuple(range(SIZE))
ALL = frozenset(LANES)


class Y(IntEnum):
    """Second factor of the product."""

    BUS = 0
    OWN = 1
    """What the lane itself would put on the bus."""
    ONE = 2
    RECIPROCAL = 3
    """Of the divider."""
    RESIDUAL = 4
    """The residual with the bus's address."""
    VARIANCE = 5
    """The VARIANCE register, or the bus where that is 0."""
    ZERO = 6


class Bank(IntEnum):
    """A lane's memories. NONE reads as 1 for x and as 0 for c."""

    NONE = 0
    S = 1
    A = 2
    P = 3


class Track(IntEnum):
    """What else looks at the bus."""

    NONE = 0
    PIVOT = 1
    """Is the pivot still a number, against the diagonal it came from?"""
    DIAGONAL = 2
    """Largest element of the inverse's diagonal; its number is the next operations' index."""
    FIRST_STEP = 3
    """Largest step of the first refinement."""
    STEP = 4
    """Largest step of the second one."""
    RATE = 5
    """Largest rate."""
    CONDITION = 6
    """cond(H)^2."""


class Scale(IntEnum):
    """The power of two that an output is scaled back with."""

    RATE = 0
    RSS = 1
    COVARIANCE = 2


class Mark(IntEnum):
    """Milestones, after the word that the operation writes."""

    NONE = 0
    RATES = 1
    ALL = 2


Place = tuple[Bank, int]

B = 6  # column of b, z and x
RECIPROCALS = 7
INVERSE = 8
T0, T1, T2 = 14, 15, 16  # sums of a refinement
V0, V1, V2, IMAGE, PART = 17, 18, 19, 20, 21  # condition: of A, then of the inverse
DOTS = 22  # ..25: v.Av and Av.Av of A, then of the inverse
NUMERATOR, DENOMINATOR, CONDITION = 26, 27, 28
PRODUCT, RSS, SPREAD, PER_FREEDOM = 29, 30, 31, 26
COVARIANCE = 0  # S 0..5 once U is not needed any more
FREEDOM = 7  # A of lane 0: used rows - 6


@dataclass(frozen=True)
class Bus:
    """What one lane (or, with `Y.OWN`, every lane) reads for the second factor.

    indexed: the address is the bank's row base plus the place of the largest diagonal element.
    """

    bank: Bank
    address: int
    lane: int = 0
    indexed: bool = False


@dataclass(frozen=True)
class Operation:
    """One cycle of the lanes. `lanes` are those whose sum is kept, or whose product counts."""

    name: str
    x: Place = (Bank.NONE, 0)
    y: Y = Y.ONE
    bus: Bus | None = None
    product: int | None = None
    c: Place = (Bank.NONE, 0)
    subtract: bool = False
    dest: int | None = None
    lanes: frozenset[int] = ALL
    divide: bool = False
    load: int | None = None
    """Place in the residual unit that takes the bus's value: a rate."""
    track: Track = Track.NONE
    output: int | None = None
    scale: Scale = Scale.RATE
    clamp: bool = False
    """A negative output becomes zero."""
    mark: Mark = Mark.NONE
    urgent: bool = True
    """Needed before the rates stand."""


@dataclass(frozen=True)
class Term:
    """One product of the exact residual: row of [A b; b^T c] times rate `column` (6: the scale of b)."""

    row: int
    column: int
    first: bool
    last: bool
    urgent: bool = True

    @property
    def name(self) -> str:
        """For comments."""
        return f"r{self.row} {self.column}"


Step = Operation | Term


def above(k: int) -> frozenset[int]:
    """Lanes whose rows lie above row k."""
    return frozenset(range(k))


def below(k: int) -> frozenset[int]:
    """Lanes whose rows lie below row k."""
    return frozenset(range(k + 1, SIZE))


def only(k: int) -> frozenset[int]:
    """Lane k alone."""
    return frozenset({k})


def one_lane(k: int) -> frozenset[int]:
    """Lane k alone."""
    return frozenset({k})


def factor() -> list[Step]:
    """L D L^T of A, with L z = b and L X = I solved on the way.

    Pivot k: a_ij -= (a_ik a_kj) / d_k for the rows i below; column k of these rows becomes that of L^-1.
    """
    steps: list[Step] = []
    for k in LANES:
        bank = Bank.A if k == 0 else Bank.S
        rows = below(k)
        steps.append(
            Operation(f"d{k}", bus=Bus(bank, k, k), divide=True, track=Track.PIVOT, lanes=frozenset())
        )
        columns = [*range(k + 1, SIZE), B, *range(k)] if rows else []
        steps += [
            Operation(f"p{k}{j}", x=(bank, k), y=Y.BUS, bus=Bus(bank, j, k), product=j, lanes=rows)
            for j in columns
        ]
        steps += [
            Operation(
                f"a{k}{j}", x=(Bank.P, j), y=Y.RECIPROCAL, c=(bank, j), subtract=True, dest=j, lanes=rows
            )
            for j in columns
        ]
        if rows:
            steps.append(Operation(f"l{k}", x=(bank, k), y=Y.RECIPROCAL, subtract=True, dest=k, lanes=rows))
        steps.append(Operation(f"i{k}", y=Y.RECIPROCAL, dest=INVERSE + k, lanes=one_lane(k)))
        if rows:
            steps.append(Operation(f"r{k}", y=Y.RECIPROCAL, dest=RECIPROCALS, lanes=one_lane(k)))
    return steps


def divide_rows() -> list[Step]:
    """Rows over their pivots: U = L^T above the diagonal, x = D^-1 z, D^-1 L^-1 where the inverse will be."""
    own = Bus(Bank.S, RECIPROCALS)
    steps: list[Step] = [
        Operation(f"0{j}", y=Y.ZERO, dest=INVERSE + j, lanes=above(j)) for j in range(1, SIZE)
    ]
    steps += [
        Operation(f"u0{j}", x=(Bank.A, j), y=Y.OWN, bus=own, dest=j, lanes=one_lane(0))
        for j in (*range(1, SIZE), B)
    ]
    middle = frozenset(range(1, SIZE - 1))
    for j in (*range(2, SIZE), B):
        rows = middle & (above(j) if j != B else ALL)
        steps.append(Operation(f"u{j}", x=(Bank.S, j), y=Y.OWN, bus=own, dest=j, lanes=rows))
    for j in range(SIZE - 2):
        rows = middle & below(j)
        steps.append(Operation(f"i{j}", x=(Bank.S, j), y=Y.OWN, bus=own, dest=INVERSE + j, lanes=rows))
    last = one_lane(SIZE - 1)  # its 1/d is still the divider's
    steps.append(Operation("x5", x=(Bank.S, B), y=Y.RECIPROCAL, dest=B, lanes=last))
    steps += [
        Operation(f"i5{j}", x=(Bank.S, j), y=Y.RECIPROCAL, dest=INVERSE + j, lanes=last)
        for j in range(SIZE - 1)
    ]
    return steps


def back_substitution() -> list[Step]:
    """U x = D^-1 z and U A^-1 = D^-1 L^-1, from the last row up; each rate goes to the residual unit."""
    steps: list[Step] = [
        Operation(
            f"x{k}" if j == B else f"i{k}{j - INVERSE}",
            x=(Bank.S, k),
            y=Y.BUS,
            bus=Bus(Bank.S, j, k),
            c=(Bank.S, j),
            subtract=True,
            dest=j,
            lanes=above(k),
            load=k if j == B else None,
            track=Track.DIAGONAL if j == INVERSE + k else Track.NONE,
        )
        for k in reversed(LANES[1:])
        for j in (B, *range(INVERSE, INVERSE + SIZE))
    ]
    steps.append(Operation("x0", bus=Bus(Bank.S, B, 0), load=0, lanes=frozenset()))
    steps.append(Operation("g0", bus=Bus(Bank.S, INVERSE, 0), track=Track.DIAGONAL, lanes=frozenset()))
    return steps


def residual_by_columns() -> list[Step]:
    """b - A x while x is still coming, its last component first."""
    columns = (SIZE, *reversed(LANES))
    return [Term(row, column, column == SIZE, column == 0) for column in columns for row in LANES]


def residual_by_rows(rows: int, urgent: bool) -> list[Step]:
    """b - A x (and, seven rows, y.y - b.x) of the rates loaded."""
    loads: list[Step] = [
        Operation(f"x{j}", bus=Bus(Bank.S, B, j), load=j, lanes=frozenset(), urgent=urgent) for j in LANES
    ]
    columns = (SIZE, *LANES)
    return loads + [
        Term(row, column, column == SIZE, column == SIZE - 1, urgent)
        for row in range(rows)
        for column in columns
    ]


def add(name: str, c: int, x: int, dest: int, lanes: frozenset[int] = ALL, urgent: bool = True) -> Operation:
    """S dest = S c + S x."""
    return Operation(name, x=(Bank.S, x), c=(Bank.S, c), dest=dest, lanes=lanes, urgent=urgent)


def correction(name: str, sums: tuple[int, ...]) -> list[Step]:
    """A^-1 r of the last residuals, in as many interleaved sums as given."""
    steps: list[Step] = []
    for j in LANES:
        place = sums[j % len(sums)]
        steps.append(
            Operation(
                f"{name}{j}",
                x=(Bank.S, INVERSE + j),
                y=Y.RESIDUAL,
                bus=Bus(Bank.S, j),
                c=(Bank.S, place) if j >= len(sums) else (Bank.NONE, 0),
                dest=place,
            )
        )
    return steps


def tracked(name: str, track: Track) -> list[Step]:
    """A refinement's step past what watches its size."""
    return [Operation(f"{name}{j}", bus=Bus(Bank.S, T2, j), track=track, lanes=frozenset()) for j in LANES]


def first_refinement() -> list[Step]:
    """x += A^-1 (b - A x); the residuals come at once, so three sums."""
    return [
        *residual_by_columns(),
        *correction("e", (T0, T1, T2)),
        add("e12", T1, T2, T1),
        add("xe0", B, T0, B),
        add("xe", B, T1, B),
        add("e", T0, T1, T2),
        *tracked("t", Track.FIRST_STEP),
    ]


def second_refinement() -> list[Step]:
    """The same once more; the residuals come seven cycles apart."""
    return [
        *residual_by_rows(SIZE, True),
        *correction("f", (T0, T1)),
        add("f01", T0, T1, T2),
        *tracked("s", Track.STEP),
        add("xf", B, T2, B),
    ]


def lane_sum(name: str, source: int, dest: int, urgent: bool = True) -> list[Step]:
    """Lane 0: the sum of all lanes' S source."""
    steps: list[Step] = []
    places = (V0, V1, V2)
    for j in LANES:
        place = places[j % 3]
        steps.append(
            Operation(
                f"{name}{j}",
                y=Y.BUS,
                bus=Bus(Bank.S, source, j),
                c=(Bank.S, place) if j > 2 else (Bank.NONE, 0),
                dest=place,
                lanes=one_lane(0),
                urgent=urgent,
            )
        )
    return [
        *steps,
        add(f"{name}01", V0, V1, V0, one_lane(0), urgent),
        add(f"{name}012", V0, V2, dest, one_lane(0), urgent),
    ]


def largest_eigenvalue(name: str, bank: Bank, base: int, dots: int) -> list[Step]:
    """v.Mv and Mv.Mv, v the column of M with the largest diagonal element: their ratio is <= lambda_max."""
    steps: list[Step] = []
    places = (V0, V1, V2)
    for j in LANES:
        place = places[j % 3]
        steps.append(
            Operation(
                f"{name}{j}",
                x=(bank, base + j),
                y=Y.BUS,
                bus=Bus(bank, base, j, indexed=True),
                c=(Bank.S, place) if j > 2 else (Bank.NONE, 0),
                dest=place,
            )
        )
    steps += [add(f"{name}01", V0, V1, V0), add(f"{name}012", V0, V2, IMAGE)]
    own = Bus(bank, base, indexed=True)
    steps.append(Operation(f"{name}v", x=(Bank.S, IMAGE), y=Y.OWN, bus=own, dest=PART))
    steps += lane_sum(f"{name}v", PART, dots)
    steps.append(Operation(f"{name}m", x=(Bank.S, IMAGE), y=Y.OWN, bus=Bus(Bank.S, IMAGE), dest=PART))
    return steps + lane_sum(f"{name}m", PART, dots + 1)


def condition_of_moments() -> list[Step]:
    """lambda_max(A)."""
    return largest_eigenvalue("ca", Bank.A, 0, DOTS)


def condition() -> list[Step]:
    """cond(H)^2 = lambda_max(A) lambda_max(A^-1)."""
    zero = one_lane(0)
    return [
        *largest_eigenvalue("ci", Bank.S, INVERSE, DOTS + 2),
        Operation("cn", x=(Bank.S, DOTS + 1), y=Y.BUS, bus=Bus(Bank.S, DOTS + 3), dest=NUMERATOR, lanes=zero),
        Operation("cd", x=(Bank.S, DOTS), y=Y.BUS, bus=Bus(Bank.S, DOTS + 2), dest=DENOMINATOR, lanes=zero),
        Operation("c/", bus=Bus(Bank.S, DENOMINATOR), divide=True, lanes=frozenset()),
        Operation("c", x=(Bank.S, NUMERATOR), y=Y.RECIPROCAL, dest=CONDITION, lanes=zero),
        Operation("c?", bus=Bus(Bank.S, CONDITION), track=Track.CONDITION, lanes=frozenset()),
    ]


def rates() -> list[Step]:
    """The six rates to the result memory."""
    return [
        Operation(
            f"out{j}",
            bus=Bus(Bank.S, B, j),
            output=j,
            track=Track.RATE,
            lanes=frozenset(),
            mark=Mark.RATES if j == SIZE - 1 else Mark.NONE,
        )
        for j in LANES
    ]


def statistics() -> list[Step]:
    """rss = (y.y - b.x) - x.(b - A x); the covariance is A^-1 times VARIANCE or rss / (used rows - 6)."""
    zero = one_lane(0)
    steps: list[Step] = residual_by_rows(SIZE + 1, False)
    for j in LANES:
        bus = Bus(Bank.S, j)
        steps.append(
            Operation(
                f"xr{j}", x=(Bank.S, B), y=Y.RESIDUAL, bus=bus, dest=PRODUCT, lanes=one_lane(j), urgent=False
            )
        )
    steps += lane_sum("xr", PRODUCT, PRODUCT, urgent=False)
    steps += [
        Operation("r6", y=Y.RESIDUAL, bus=Bus(Bank.S, SIZE), dest=RSS, lanes=zero, urgent=False),
        Operation(
            "rss", x=(Bank.S, PRODUCT), c=(Bank.S, RSS), subtract=True, dest=RSS, lanes=zero, urgent=False
        ),
        Operation(
            "rss",
            bus=Bus(Bank.S, RSS),
            output=SIZE,
            scale=Scale.RSS,
            clamp=True,
            lanes=frozenset(),
            urgent=False,
        ),
        Operation("n-6", bus=Bus(Bank.A, FREEDOM), divide=True, lanes=frozenset(), urgent=False),
        Operation("1/n", y=Y.RECIPROCAL, dest=PER_FREEDOM, lanes=zero, urgent=False),
        Operation(
            "s2",
            x=(Bank.S, PER_FREEDOM),
            y=Y.BUS,
            bus=Bus(Bank.S, RSS),
            clamp=True,
            dest=SPREAD,
            lanes=zero,
            urgent=False,
        ),
    ]
    for j in LANES:
        steps.append(
            Operation(
                f"v{j}",
                x=(Bank.S, INVERSE + j),
                y=Y.VARIANCE,
                bus=Bus(Bank.S, SPREAD),
                dest=COVARIANCE + j,
                urgent=False,
            )
        )
    number = SIZE + 1
    for i in LANES:
        for j in range(i, SIZE):
            steps.append(
                Operation(
                    f"cov{i}{j}",
                    bus=Bus(Bank.S, COVARIANCE + j, i),
                    output=number,
                    scale=Scale.COVARIANCE,
                    lanes=frozenset(),
                    mark=Mark.ALL if i == j == SIZE - 1 else Mark.NONE,
                    urgent=False,
                )
            )
            number += 1
    return steps


@cache
def program() -> tuple[Step, ...]:
    """All of it; the order is that of the data, the schedule may interleave."""
    return (
        *factor(),
        *condition_of_moments(),
        *divide_rows(),
        *back_substitution(),
        *first_refinement(),
        *condition(),
        *second_refinement(),
        *rates(),
        *statistics(),
    )
