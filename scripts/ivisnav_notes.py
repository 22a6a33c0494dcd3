# SPDX-License-Identifier: Apache-2.0
"""Measurements behind the iVisNav core's notes in docs/decisions; scripts/decisions.py runs them."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from typing import Any
from unittest.mock import patch

import numpy as np
from relnav.attitude import FloatArray
from relnav.ivisnav import exact
from relnav.ivisnav.quantise import QuantisedRows
from relnav.model import rates_engine, rates_program, rates_schedule
from relnav.model.float32 import add, from_integer, multiply
from relnav.model.gram_ring import gram_ring
from relnav.model.rates_engine import RatesEngine
from relnav.model.rates_program import (
    LANES,
    SIZE,
    B,
    Bank,
    Bus,
    Mark,
    Operation,
    Scale,
    Step,
    Term,
    Track,
    Y,
)
from relnav.model.rates_residual import ResidualUnit
from relnav.model.rates_scale import FrameScale
from relnav.words import LARGEST_CONDITION

from bench.rate_cases import DISTANCES, RADII, RINGS, random_rows, ring_rows
from bench.rates import condition
from scripts.marked import table

RESULTS = Path(__file__).resolve().parent.parent / "bench" / "results.json"
BINS = (1.0, 10.0, 100.0, 300.0, 1000.0, 2000.0)  # of cond(H)
FRAMES = 120  # of a bin
BOUND = 1e-5
ROUNDING = 5e-7  # an error above it is not that of binary32 alone


# ---- programs other than the built one


@contextmanager
def program_with(**parts: Callable[[], list[Step]]) -> Iterator[None]:
    """The program with some of its functions replaced, and the schedule that follows."""
    try:
        with ExitStack() as changes:
            for name, part in parts.items():
                changes.enter_context(patch.object(rates_program, name, part))
            _forget()
            yield
    finally:
        _forget()


def _forget() -> None:
    rates_program.program.cache_clear()
    rates_schedule.schedule.cache_clear()


def cycles() -> tuple[int, int, int]:
    """Cycles from the first sum to the last rate and to the end, and lane operations."""
    placed = rates_schedule.schedule()
    operations = sum(isinstance(step, Operation) for step in placed.steps)
    return placed.cycle(Mark.RATES), placed.cycle(Mark.ALL), operations


def versus(built: tuple[int, int, int]) -> list[str]:
    """This program's, against the built one's."""
    return [f"{now - then:+d}" for now, then in zip(cycles(), built, strict=True)]


def quotient_first() -> list[Step]:
    """Elimination in the textbook's order: l = a_ik / d_k, then a_ij -= l a_kj."""
    steps: list[Step] = []
    for k in LANES:
        bank = Bank.A if k == 0 else Bank.S
        rows = rates_program.below(k)
        steps.append(
            Operation(f"d{k}", bus=Bus(bank, k, k), divide=True, track=Track.PIVOT, lanes=frozenset())
        )
        if rows:
            steps.append(Operation(f"l{k}", x=(bank, k), y=Y.RECIPROCAL, product=k, lanes=rows))
            steps += [
                Operation(
                    f"a{k}{j}",
                    x=(Bank.P, k),
                    y=Y.BUS,
                    bus=Bus(bank, j, k),
                    c=(bank, j),
                    subtract=True,
                    dest=j,
                    lanes=rows,
                )
                for j in (*range(k + 1, SIZE), B, *range(k))
            ]
            steps.append(Operation(f"-l{k}", x=(bank, k), y=Y.RECIPROCAL, subtract=True, dest=k, lanes=rows))
        here = rates_program.only(k)
        steps.append(Operation(f"i{k}", y=Y.RECIPROCAL, dest=rates_program.INVERSE + k, lanes=here))
        if rows:
            steps.append(Operation(f"r{k}", y=Y.RECIPROCAL, dest=rates_program.RECIPROCALS, lanes=here))
    return steps


# ---- rates of every stage


@dataclass
class Watched(RatesEngine):
    """The engine, which keeps the rates as they stand before and after each refinement."""

    stages: list[FloatArray] = field(default_factory=list)
    asymmetry: int = 0
    """Bits, over the pivots, in which a_ij and a_ji of what is left of A differ."""

    def _operate(self, step: Operation, residual: ResidualUnit, words: dict[int, int]) -> None:
        if step.divide and step.track == Track.PIVOT and step.name != "d0":
            k = int(step.name[1:])
            left = self.S[k:SIZE, k:SIZE]
            self.asymmetry += int(np.count_nonzero(left != left.T)) // 2
        super()._operate(step, residual, words)
        first = step.name == "x0" and step.load == 0 and not self.stages
        if first or step.name in ("xe", "xf"):
            self.stages.append(self.rates())

    def rates(self) -> FloatArray:
        """x (6,) in the user's units."""
        found: FloatArray = np.ldexp(self.S[B].astype(np.float64), self.scale.output(Scale.RATE))
        return found

    def refine(self) -> FloatArray:
        """One more refinement; its rates."""
        unit = ResidualUnit(self.moments, self.scale)
        for step in rates_program.second_refinement():
            if isinstance(step, Operation):
                super()._operate(step, unit, {})
            elif (value := unit.add(step)) is not None:
                self.residuals[step.row] = value
        return self.rates()


class RoundedResidual(ResidualUnit):
    """b - A x from A and b as binary32, each operation rounded: what an engine without integers has."""

    def add(self, term: Term) -> np.float32 | None:
        """One product."""
        row, column = sorted((term.row, term.column))
        moment = from_integer(self.moments[row, column], self.scale.moment(row, column))
        word = 0x3F800000 if term.column == SIZE else self.rates[term.column] ^ 0x80000000
        factor = np.array([word], np.uint32).view(np.float32)
        before = np.zeros(1, np.float32) if term.first else self.rounded[term.row]
        self.rounded[term.row] = add(before, multiply(np.array([moment], np.float32), factor))
        return np.float32(self.rounded[term.row][0]) if term.last else None

    @property
    def rounded(self) -> dict[int, Any]:
        """The sums."""
        found: dict[int, Any] = self.__dict__.setdefault("_rounded", {})
        return found


def engine(rows: QuantisedRows) -> Watched:
    """At the start of a frame."""
    sums = gram_ring(rows.h, rows.y, rows.w)
    scale = FrameScale.of(sums, rows.frac_h, rows.frac_y)
    return Watched(sums.moments, scale, sums.used_count)


def error(x: FloatArray, truth: FloatArray) -> float:
    """The largest over the largest rate."""
    return float(np.abs(x - truth).max() / np.abs(truth).max())


def spread(low: float, high: float, count: int) -> list[QuantisedRows]:
    """Frames of random H, their cond(H) spread evenly by its logarithm."""
    return [random_rows(low * (high / low) ** ((k + 0.5) / count), k) for k in range(count)]


# ---- the notes


def lanes() -> str:
    """The order of a pivot's operations."""
    frames = spread(100.0, 1000.0, 60)
    rows = []
    built = cycles()
    for name, parts in (
        ("products while the divider works, then p / d (built)", {}),
        ("l = a / d, then l a", {"factor": quotient_first}),
    ):
        with program_with(**parts):
            worst, unlike = 0.0, 0
            for frame in frames:
                run = engine(frame)
                with np.errstate(all="ignore"):
                    run.run()
                worst = max(worst, error(run.stages[0], exact.solve(frame).floats()))
                unlike += run.asymmetry
            shown = [str(value) for value in built] if not parts else versus(built)
            rows.append((name, *shown, f"{worst:.0e}", "yes" if unlike == 0 else "no"))
    head = (
        "order of a pivot",
        "cycles, first sum to rates",
        "to covariances",
        "operations",
        "rates unrefined, worst",
        "symmetric to the bit",
    )
    return table(head, rows)


def residual() -> str:
    """Errors before and after refinements, and what they cost."""
    rows = []
    for low, high in pairwise(BINS):
        worst = np.zeros(5)
        refused = wrongly = later = 0
        beyond = 0.0
        for frame in spread(low, high, FRAMES):
            truth = exact.solve(frame).floats()
            run = engine(frame)
            with np.errstate(all="ignore"):
                outcome = run.run()
                third = run.refine()
                with patch.object(rates_engine, "ResidualUnit", RoundedResidual):
                    rounded = engine(frame)
                    rounded.run()
            stages = [*run.stages, third, rounded.stages[-1]]
            worst = np.maximum(worst, [error(x, truth) for x in stages])
            left = error(run.stages[-1], truth)
            if outcome.ill_conditioned or outcome.rank_deficient:
                refused += 1
                wrongly += left <= BOUND
            later += error(third, truth) > BOUND
            if left > ROUNDING:
                beyond = max(beyond, left / predicted(run))
        shown = [f"{value:.0e}" for value in worst]
        shares = [f"{count / FRAMES:.0%}" for count in (refused, wrongly, later)]
        rows.append((f"{low:g} to {high:g}", *shown, *shares, f"{beyond:.1f}" if beyond else "-"))
    built = cycles()
    cost = []
    for parts in (
        {"first_refinement": list, "second_refinement": list},
        {"second_refinement": list},
        {},
        {"second_refinement": twice},
    ):
        with program_with(**parts):
            cost.append(versus(built)[0])
    rows.append(("cycles to the rates", *cost, "", "", "", "", ""))
    head = (
        "cond(H)",
        "not refined",
        "once",
        "twice (built)",
        "three times",
        "twice, residuals in binary32",
        "refused (built)",
        f"of all: refused, within {BOUND:g}",
        f"after three beyond {BOUND:g}",
        "left after two, over its estimate",
    )
    return table(head, rows)


def predicted(run: Watched) -> float:
    """What the second refinement should leave by the steps of both, over the largest rate."""
    first, step, rate = (run.sizes[track] for track in (Track.FIRST_STEP, Track.STEP, Track.RATE))
    return float(2.0 ** ((2 * step - first - rate) / 8))


_second = rates_program.second_refinement


def twice() -> list[Step]:
    """Second and third refinement."""
    return [*_second(), *_second()]


def ring() -> str:
    """What the drain's order is worth to the engine: the same program behind the sums row by row."""
    built = cycles()
    rows = [("row 0, then by lanes (built)", *(str(value) for value in built[:2]))]
    by_rows = tuple((i, j) for i in range(SIZE + 1) for j in range(i, SIZE + 1))
    for name, order in (("row by row", by_rows), ("lane by lane", by_lane())):
        with patch.object(rates_schedule, "DRAIN_ORDER", order):
            _forget()
            rows.append((name, *versus(built)[:2]))
    _forget()
    return table(("order of the sums", "cycles, first sum to rates", "to covariances"), rows)


def by_lane() -> tuple[tuple[int, int], ...]:
    """Lane i's four slots (i, i + s modulo 7), lane after lane."""
    size = SIZE + 1
    pairs = [sorted((i, (i + s) % size)) for i in range(size) for s in range(4)]
    return tuple((row, column) for row, column in pairs)


def conditioning() -> str:
    """Estimates of cond(H) over the true one, in double, by geometry."""
    rings = [
        ring_rows((name, radius, distance, weighted), k)
        for name in RINGS
        for radius in RADII
        for distance in DISTANCES
        for weighted in (False, True)
        for k in range(60)
    ]
    near = [frame for frame in rings if 500.0 <= condition(frame) <= 8000.0]
    rows = []
    for name, frames in (
        (f"rings, {len(rings)} frames", rings),
        (f"rings, cond(H) 500 to 8000, {len(near)} frames", near),
        ("random H, cond(H) 500 to 8000, 2000 frames", spread(500.0, 8000.0, 2000)),
    ):
        ratios = np.array([estimates(frame) for frame in frames])
        shown = [f"{low:.3f} to {high:.3f}" for low, high in zip(ratios.min(0), ratios.max(0), strict=True)]
        rows.append((name, *shown))
    head = ("frames", "largest diagonals", "v.Av / v.v", "Av.Av / v.Av (built)", "traces")
    return table(head, rows)


def estimates(frame: QuantisedRows) -> list[float]:
    """Each estimate of cond(H) over the true one, v being the column with the largest diagonal element."""
    h, _ = frame.values()
    q, values, back = np.linalg.svd(np.sqrt(frame.w)[:, None] * h, full_matrices=False)
    del q
    found = np.ones(4)
    for powers in (values**2, values**-2):
        matrix = back.T * powers @ back
        place = int(np.argmax(np.diag(matrix)))
        v = matrix[place]
        image = matrix @ v
        found *= [matrix[place, place], v @ image / (v @ v), image @ image / (v @ image), np.trace(matrix)]
    return [float(x) for x in np.sqrt(found) / (values[0] / values[-1])]


def refusals() -> str:
    """Who was refused and why, of `python -m bench.rates`."""
    results = json.loads(RESULTS.read_text(encoding="utf-8")).get("rates") if RESULTS.is_file() else None
    if results is None:
        return "Not run: `python -m bench.rates`."
    groups: list[tuple[str, list[dict[str, Any]]]] = [
        ("rings, unweighted", [cell for cell in results["rings"] if not cell["weighted"]]),
        ("rings, weighted", [cell for cell in results["rings"] if cell["weighted"]]),
    ]
    groups += [
        (f"rings looked for there, {'weighted' if edge['weighted'] else 'unweighted'}", [edge])
        for edge in results["threshold"]
    ]
    groups += [(f"random H, cond(H) {b['from']:g} to {b['to']:g}", [b]) for b in results["random"]]
    rows = []
    for name, entries in groups:
        ratios = [entry["ratio_near"] for entry in entries if entry["ratio_near"]]
        rows.append(
            (
                name,
                str(sum(entry["frames"] for entry in entries)),
                *(
                    str(sum(entry["refused_by"][why] for entry in entries))
                    for why in ("pivot", "condition", "refinement")
                ),
                str(sum(entry["refused_within"] for entry in entries)),
                str(sum(entry["solved_beyond"] for entry in entries)),
                f"{min(r[0] for r in ratios):.3f} to {max(r[1] for r in ratios):.3f}" if ratios else "-",
                f"{max(given(entry) for entry in entries):.1e}",
                str(sum(entry["over_bound"] for entry in entries)),
            )
        )
    head = (
        "frames",
        "number",
        "refused by a pivot",
        f"by cond(H) > {LARGEST_CONDITION:g}",
        "by the refinement",
        "refused below 2000",
        f"solved above {results['sharp'] * LARGEST_CONDITION:g}",
        "estimate / cond(H), for cond(H) 1000 to 4000",
        "largest error given",
        f"given beyond {BOUND:g}",
    )
    return table(head, rows)


def given(entry: dict[str, Any]) -> float:
    """The largest error of a solved frame of a cell or bin."""
    return max(entry.get(name) or 0.0 for name in ("v_z", "omega_z", "driven", "idle", "error"))


MEASURES: dict[str, Callable[[], str]] = {
    "ivisnav-lanes": lanes,
    "exact-residual": residual,
    "ring": ring,
    "conditioning-ivisnav": lambda: f"{conditioning()}\n\n{refusals()}",
}
