# SPDX-License-Identifier: Apache-2.0
"""Accuracy, conditioning and 3-sigma bounds of the iVisNav core's bit-exact model.

    python -m bench.rates [--quick]

The reference is the exact solution of the quantised rows. cond(H) is that of sqrt(W) H, in double. Errors
of rings: v_z and omega_z relative, the other components of v over v_z, of omega over omega_z; of random H:
the largest component's over the largest rate. Frames: bench/rate_cases.py.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise, product
from time import perf_counter
from typing import Any, TypeVar

import numpy as np
from relnav.attitude import FloatArray
from relnav.ivisnav import exact
from relnav.ivisnav.quantise import QuantisedRows
from relnav.ivisnav.raw import RawRates, raw_to_result
from relnav.model.gram_ring import gram_ring
from relnav.model.rates_core import RatesCore
from relnav.model.rates_explicit import explicit_rates
from relnav.model.rates_scale import FrameScale
from relnav.words import LARGEST_CONDITION
from scipy.stats import t as student

from bench.common import JOBS, number, spread_out, table, write_results
from bench.rate_cases import (
    DISTANCES,
    RADII,
    RINGS,
    Cell,
    noisy_rows,
    random_rows,
    residual_rows,
    ring_rows,
)

BOUND = 1e-5
RANDOM_BOUND = 2e-5  # the refinements' end is estimated from their steps, for random H sometimes too well
SHARP = 1.03  # beyond this times the threshold every ring has to be refused
NEAR = (1000.0, 4000.0)  # cond(H) about the threshold, where the estimate has to be sharp
TRIALS, QUICK = 60, 4  # of a cell
THRESHOLD = (1900.0, 2120.0)  # of cond(H): rings looked for, of MOST at the most
MOST, RINGS_THERE = 3000, 100
CONDITIONS = (1.0, 10.0, 100.0, 300.0, 1000.0, 2000.0, 1e4)  # ends of the bins of random H
RANDOM = 400  # frames of a bin
GIVEN, ESTIMATED = 4000, 1000  # trials with VARIANCE and without
GIVEN_ROWS, ESTIMATED_ROWS = (6, 24), (26, 46)
NOISES = (1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8)  # of y, relative to its rms
FRAMES = 40  # of a noise
BATCH = 20
SIGMAS = 3.0
DEVIATIONS = 4.0  # of a share inside 3 sigma, from the one expected, that count as chance
CHANNELS = ("v_x", "v_y", "v_z", "omega_x", "omega_y", "omega_z")
DRIVEN, IDLE = (2, 5), (0, 1, 3, 4)

Batch = tuple[Any, int, int]
Result = TypeVar("Result")


@dataclass(frozen=True)
class Outcome:
    """One frame against the exact solution. x (6,) and rss: None where the core gave none.

    cond: of sqrt(W) H;  estimate: the core's own, None where it has none
    explicit: x of the paper's order of operations in the same binary32, without refinement
    energy: sum of w y^2, of which rss is a part
    """

    cond: float
    estimate: float | None
    flags: tuple[str, ...]
    truth: FloatArray
    x: FloatArray | None
    explicit: FloatArray
    rss: float | None
    true_rss: float
    energy: float

    @property
    def ratio(self) -> float | None:
        """Estimate over cond."""
        return None if self.estimate is None else self.estimate / self.cond


def measure(core: RatesCore, rows: QuantisedRows) -> Outcome:
    """Run the model, the exact solution and the explicit inverse."""
    raw: RawRates = core.run(rows)
    result = raw_to_result(raw, 0, rows)
    solution = exact.solve(rows)
    _, y = rows.values()
    sums = gram_ring(rows.h, rows.y, rows.w)
    scale = FrameScale.of(sums, rows.frac_h, rows.frac_y)
    with np.errstate(all="ignore"):
        explicit, _ = explicit_rates(sums.moments, scale)
    return Outcome(
        condition(rows),
        result.condition,
        result.flags,
        solution.floats(),
        None if result.v is None or result.omega is None else np.concatenate((result.v, result.omega)),
        explicit.astype(np.float64),
        None if result.rss is None else result.rss * rows.weight_scale,
        float(solution.rss),
        float(np.sum(rows.w * y**2)),
    )


def condition(rows: QuantisedRows) -> float:
    """cond(sqrt(W) H)."""
    h, _ = rows.values()
    singular = np.linalg.svd(np.sqrt(rows.w)[:, None] * h, compute_uv=False)
    return float(singular[0] / singular[-1])


def channels(x: FloatArray, truth: FloatArray) -> FloatArray:
    """(6,) errors, each over the driven channel of its vector."""
    error: FloatArray = np.abs(x - truth) / np.repeat(np.abs(truth[list(DRIVEN)]), 3)
    return error


def overall(x: FloatArray, truth: FloatArray) -> float:
    """The largest error over the largest rate."""
    return float(np.abs(x - truth).max() / np.abs(truth).max())


def largest(values: Sequence[float]) -> float | None:
    """None of none, and where one is not finite, which JSON does not have."""
    return max(values) if values and np.isfinite(values).all() else None


def conditioning(cases: Sequence[Outcome]) -> dict[str, Any]:
    """Who was refused, why, rightly or not, and how sharp the estimate is: for all frames and NEAR.

    refused_by: the pivots, the estimate of cond(H), and the rest: refinements that did not converge.
    """
    refused = [case for case in cases if case.x is None]
    deficient = sum("RANK_DEFICIENT" in case.flags for case in refused)
    excessive = sum((case.estimate or 0.0) > LARGEST_CONDITION for case in refused)
    return {
        "frames": len(cases),
        "cond": [min(case.cond for case in cases), max(case.cond for case in cases)],
        "refused": len(refused),
        "refused_by": {
            "pivot": deficient,
            "condition": excessive,
            "refinement": len(refused) - deficient - excessive,
        },
        "refused_within": sum(case.cond <= LARGEST_CONDITION for case in refused),
        "solved_beyond": sum(case.cond > SHARP * LARGEST_CONDITION and case.x is not None for case in cases),
        "ratio": extremes([case.ratio for case in cases]),
        "ratio_near": extremes([case.ratio for case in cases if NEAR[0] <= case.cond <= NEAR[1]]),
    }


def extremes(values: Sequence[float | None]) -> list[float] | None:
    """The least and the largest of those that are there and finite."""
    found = [value for value in values if value is not None and np.isfinite(value)]
    return [min(found), max(found)] if found else None


# ---- rings


def run_rings(batch: Batch) -> list[Outcome]:
    """Cases first..last - 1 of a cell."""
    cell, first, last = batch
    core = RatesCore()
    return [measure(core, ring_rows(cell, k)) for k in range(first, last)]


def cell_report(cell: Cell, cases: Sequence[Outcome]) -> dict[str, Any]:
    """Largest errors of the solved frames; holds: the bounds do, within cond(H) <= 2000 and beyond."""
    errors = [channels(case.x, case.truth) for case in cases if case.x is not None]
    inside = [case for case in cases if case.cond <= LARGEST_CONDITION]
    found: dict[str, Any] = dict(zip(("ring", "radius", "distance", "weighted"), cell, strict=True))
    found |= conditioning(cases)
    for name, which in (("v_z", [2]), ("omega_z", [5]), ("idle", list(IDLE))):
        found[name] = largest([float(error[which].max()) for error in errors])
    found["explicit"] = largest([float(channels(c.explicit, c.truth).max()) for c in inside])
    found["rss_floor"] = largest([c.rss / c.energy for c in cases if c.rss is not None])
    found["over_bound"] = sum(float(error.max()) > BOUND for error in errors)
    found["holds"] = not (found["over_bound"] or found["refused_within"] or found["solved_beyond"])
    return found


def rings(trials: int, processes: int) -> list[dict[str, Any]]:
    """Every ring, radius, distance, unweighted and weighted."""
    cells: list[Cell] = list(product(RINGS, RADII, DISTANCES, (False, True)))
    return [
        cell_report(cell, cases)
        for cell, cases in gathered(run_rings, [(cell, trials) for cell in cells], "rings", processes)
    ]


# ---- rings about the threshold


def run_threshold(job: tuple[bool, int]) -> list[Outcome]:
    """The first rings, unweighted or weighted, whose cond(H) is within THRESHOLD."""
    weighted, count = job
    core = RatesCore()
    found: list[Outcome] = []
    for k in range(TRIALS, TRIALS + MOST):  # the first ones are in the cells
        rows = ring_rows(("alternately turned", 0.15 if not weighted else 0.5, 5.0, weighted), k)
        if THRESHOLD[0] <= condition(rows) <= THRESHOLD[1]:
            found.append(measure(core, rows))
        if len(found) == count:
            break
    return found


def threshold(count: int, processes: int) -> list[dict[str, Any]]:
    """How sharp the refusal is, and the errors next to it: no bound, the cells have that."""
    jobs = [(weighted, count) for weighted in (False, True)]
    found = []
    for (weighted, _), cases in zip(
        jobs, spread_out(run_threshold, jobs, "threshold", processes), strict=True
    ):
        errors = np.array([channels(case.x, case.truth) for case in cases if case.x is not None])
        driven, idle = errors[:, list(DRIVEN)].max(axis=1), errors[:, list(IDLE)].max(axis=1)
        found.append(
            {
                "weighted": weighted,
                **conditioning(cases),
                "least_refused": min((case.cond for case in cases if case.x is None), default=None),
                "largest_solved": max(case.cond for case in cases if case.x is not None),
                "driven": float(driven.max()),
                "idle": float(idle.max()),
                "over_bound": int(np.count_nonzero(np.maximum(driven, idle) > BOUND)),
            }
        )
    return found


# ---- random H


def run_random(batch: Batch) -> list[Outcome]:
    """Cases first..last - 1 of a bin."""
    (low, high), first, last = batch
    core = RatesCore()
    places = [np.random.default_rng([round(low), k]).random() for k in range(first, last)]
    return [
        measure(core, random_rows(low * (high / low) ** place, k))
        for k, place in zip(range(first, last), places, strict=True)
    ]


def random_report(bounds: tuple[float, float], cases: Sequence[Outcome]) -> dict[str, Any]:
    """One bin of cond(H)."""
    errors = [overall(case.x, case.truth) for case in cases if case.x is not None]
    return {
        "from": bounds[0],
        "to": bounds[1],
        **conditioning(cases),
        "error": largest(errors),
        "over_bound": sum(error > BOUND for error in errors),
        "explicit": largest([overall(case.explicit, case.truth) for case in cases]),
        "holds": max(errors, default=0.0) <= RANDOM_BOUND,
    }


def random_matrices(trials: int, processes: int) -> list[dict[str, Any]]:
    """By bins of cond(H)."""
    bins = list(pairwise(CONDITIONS))
    return [
        random_report(bounds, cases)
        for bounds, cases in gathered(run_random, [(b, trials) for b in bins], "random H", processes)
    ]


# ---- 3 sigma


def run_coverage(batch: Batch) -> list[tuple[FloatArray, float]]:
    """((6,) errors over predicted standard deviations, expected share) of solved trials."""
    given, first, last = batch
    core = RatesCore()
    found = []
    for k in range(first, last):
        rows, x, variance = noisy_rows(k, *(GIVEN_ROWS if given else ESTIMATED_ROWS))
        result = raw_to_result(core.run(rows, variance if given else 0.0), 0, rows)
        if result.v is None or result.omega is None or result.cov is None:
            continue
        sigmas = np.sqrt(np.diag(result.cov))
        share = 1.0 - 2.0 * float(student.sf(SIGMAS, np.inf if given else rows.n - 6))
        found.append(((np.concatenate((result.v, result.omega)) - x) / sigmas, share))
    return found


def coverage(given: int, estimated: int, processes: int) -> list[dict[str, Any]]:
    """Shares inside 3 sigma by component, with the one that Student's distribution expects."""
    found = []
    for kind, trials in ((True, given), (False, estimated)):
        ((_, cases),) = gathered(run_coverage, [(kind, trials)], "3 sigma", processes)
        errors = np.array([error for error, _ in cases])
        expected = float(np.mean([share for _, share in cases]))
        inside = np.mean(np.abs(errors) <= SIGMAS, axis=0)
        allowed = DEVIATIONS * float(np.sqrt(expected * (1.0 - expected) / len(errors)))
        found.append(
            {
                "variance": "VARIANCE" if kind else "rss / (n - 6)",
                "rows": list(GIVEN_ROWS if kind else ESTIMATED_ROWS),
                "trials": trials,
                "without_result": trials - len(errors),
                "expected": round(expected, 5),
                "inside": dict(zip(CHANNELS, inside.round(5).tolist(), strict=True)),
                "rms_over_sigma": dict(
                    zip(CHANNELS, np.sqrt(np.mean(errors**2, axis=0)).round(4).tolist(), strict=True)
                ),
                "holds": bool(np.all(np.abs(inside - expected) <= allowed)),
            }
        )
    return found


# ---- rss


def run_residuals(batch: Batch) -> list[Outcome]:
    """Cases first..last - 1 of a noise."""
    noise, first, last = batch
    core = RatesCore()
    return [measure(core, residual_rows(noise, k)) for k in range(first, last)]


def residuals(trials: int, processes: int) -> list[dict[str, Any]]:
    """Largest relative error of rss by noise."""
    found = []
    for noise, cases in gathered(run_residuals, [(n, trials) for n in NOISES], "rss", processes):
        solved = [(case, case.rss) for case in cases if case.rss is not None]
        found.append(
            {
                "noise": noise,
                "frames": len(solved),
                "error": largest([abs(rss - case.true_rss) / case.true_rss for case, rss in solved]),
                "floor": largest([abs(rss - case.true_rss) / case.energy for case, rss in solved]),
            }
        )
    return found


# ---- all


def gathered(
    work: Callable[[Batch], list[Result]], counts: Sequence[tuple[Any, int]], title: str, processes: int
) -> list[tuple[Any, list[Result]]]:
    """Each key with the results of its cases 0..count - 1."""
    jobs = [(key, k, min(k + BATCH, count)) for key, count in counts for k in range(0, count, BATCH)]
    done = spread_out(work, jobs, title, processes)
    found: dict[Any, list[Result]] = {key: [] for key, _ in counts}
    for (key, _, _), part in zip(jobs, done, strict=True):
        found[key] += part
    return list(found.items())


def run(quick: bool = False, processes: int = JOBS) -> dict[str, Any]:
    """Measure all."""
    started = perf_counter()
    part = TRIALS // QUICK if quick else 1
    cells = rings(TRIALS // part, processes)
    edge = threshold(RINGS_THERE // part, processes)
    bins = random_matrices(RANDOM // part, processes)
    shares = coverage(GIVEN // part, ESTIMATED // part, processes)
    rss = residuals(FRAMES // part, processes)
    return {
        "bound": BOUND,
        "random_bound": RANDOM_BOUND,
        "largest_condition": LARGEST_CONDITION,
        "sharp": SHARP,
        "rings": cells,
        "threshold": edge,
        "random": bins,
        "coverage": shares,
        "rss": rss,
        "holds": all(entry["holds"] for entry in (*cells, *bins, *shares)),
        "seconds": round(perf_counter() - started, 1),
    }


def span(values: Sequence[float] | None, form: str = ".4g") -> str:
    """From the least to the largest."""
    return "-" if values is None else " to ".join(format(value, form) for value in values)


def verdict(entry: dict[str, Any]) -> str:
    """Of its bounds."""
    return "yes" if entry["holds"] else "NO"


def text(found: dict[str, Any]) -> str:
    """The tables."""
    limits = ("refused", "refused_within", "solved_beyond")
    heads = ["refused", "below 2000", f"solved > {SHARP * LARGEST_CONDITION:g}", "estimate / cond"]
    cells = [
        [
            f"{c['ring']}, {c['radius']:g} m at {c['distance']:g} m"
            + (", weighted" if c["weighted"] else ""),
            span(c["cond"]),
            *(number(c[name]) for name in ("v_z", "omega_z", "idle", "explicit", "rss_floor")),
            *(str(c[name]) for name in limits),
            span(c["ratio"], ".3f"),
            verdict(c),
        ]
        for c in found["rings"]
    ]
    edge = [
        [
            "weighted" if e["weighted"] else "unweighted",
            str(e["frames"]),
            number(e["least_refused"], ".1f"),
            number(e["largest_solved"], ".1f"),
            span(e["ratio"], ".3f"),
            number(e["driven"]),
            number(e["idle"]),
            str(e["over_bound"]),
        ]
        for e in found["threshold"]
    ]
    bins = [
        [
            f"{b['from']:g} to {b['to']:g}",
            str(b["frames"]),
            number(b["error"]),
            str(b["over_bound"]),
            number(b["explicit"]),
            *(str(b[name]) for name in limits),
            span(b["ratio"], ".3f"),
            verdict(b),
        ]
        for b in found["random"]
    ]
    shares = [
        [
            f"{s['variance']}, {s['rows'][0]} to {s['rows'][1]} rows",
            str(s["trials"]),
            *(f"{100 * s['inside'][channel]:.2f}" for channel in CHANNELS),
            f"{100 * s['expected']:.2f}",
            span([min(s["rms_over_sigma"].values()), max(s["rms_over_sigma"].values())], ".3f"),
            verdict(s),
        ]
        for s in found["coverage"]
    ]
    rss = [[f"{r['noise']:.0e}", number(r["error"]), number(r["floor"])] for r in found["rss"]]
    return "\n".join(
        [
            f"rings, largest errors of the solved frames (bound {BOUND:g}):",
            table(
                ["ring", "cond(H)", "v_z", "omega_z", "idle", "explicit", "rss / wy2", *heads, "holds"], cells
            ),
            "",
            f"rings with cond(H) {THRESHOLD[0]:g} to {THRESHOLD[1]:g}, least refused, largest solved:",
            table(
                ["", "frames", "refused", "solved", "estimate / cond", "driven", "idle", f"over {BOUND:g}"],
                edge,
            ),
            "",
            f"random H, largest error over largest rate (bound {RANDOM_BOUND:g}):",
            table(["cond(H)", "frames", "error", f"over {BOUND:g}", "explicit", *heads, "holds"], bins),
            "",
            "errors inside the core's own 3 sigma, per cent:",
            table(["variance", "trials", *CHANNELS, "expected", "rms / sigma", "holds"], shares),
            "",
            "rss, largest relative error, and over sum w y^2:",
            table(["noise / rms of y", "relative", "floor"], rss),
        ]
    )


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure, print, keep; 1 where a bound is broken."""
    parser = argparse.ArgumentParser(description="accuracy and conditioning of the iVisNav core's model")
    parser.add_argument("--quick", action="store_true", help="a fifteenth of the cases, nothing kept")
    parser.add_argument("--jobs", type=int, default=JOBS, help="processes")
    options = parser.parse_args(arguments)
    found = run(options.quick, options.jobs)
    print(text(found))
    if not options.quick:
        write_results("rates", found)
    return 0 if found["holds"] else 1


if __name__ == "__main__":
    sys.exit(main())
