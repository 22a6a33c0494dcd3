# SPDX-License-Identifier: Apache-2.0
"""Errors of the bit-exact model against the exact solution of the quantised points, by condition.

    python -m bench.accuracy [--quick] [--cases N]

The reference solves the turn that the core names. Every case is reproduced by its family and number:
`measure(OltaeCore(), make_case(family, number))`.

q = N / D of a turned frame has a small divisor near 180 degrees, so that its error grows with |q| although
the rotation's does not: q is told by |q| as well, and by condition only below |q| = NEAR.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from time import perf_counter
from typing import Any

from relnav.model.core import OltaeCore
from relnav.result import FAILURES

from bench.clouds import FAMILIES, SHARE, make_case
from bench.common import JOBS, number, spread_out, table, write_results
from bench.measure import NOISY, Errors, measure

BINS = (3.0, 30.0, 1e3, 3e4, 1e6)
BOUND, BOUND_KAPPA = 1e-7, 30.0
SIZES = (1.0, 10.0, 1e2, 1e3, 1e4, 1e6, float("inf"))  # of |q|: tan of half the angle
CASES, QUICK = 12000, 240
BATCH = 40
QUANTITIES = ("q", "R", "t", "rss", "floor", "q_cov", "t_cov")
NEAR = 10.0  # |q| of 168.6 degrees

BROKEN = "BROKEN"

Batch = tuple[str, int, int]


def run_batch(batch: Batch) -> list[Errors]:
    """Cases first..last - 1 of a family."""
    family, first, last = batch
    core = OltaeCore()
    found = []
    for k in range(first, last):
        case = make_case(family, k)
        try:
            found.append(measure(core, case))
        except ArithmeticError as broken:  # the model's own proof of its word lengths
            found.append(Errors(family, k, case.frame.n, 0, (BROKEN, str(broken)), 1.0))
    return found


def batches(cases: int) -> list[Batch]:
    """About `cases` cases, dealt out to the families by their share."""
    total = sum(SHARE.get(family, 1.0) for family in FAMILIES)
    found = []
    for family in FAMILIES:
        count = max(1, round(cases * SHARE.get(family, 1.0) / total))
        step = 1 if family.startswith("many") else BATCH
        found += [(family, k, min(k + step, count)) for k in range(0, count, step)]
    return sorted(found, key=lambda batch: not batch[0].startswith("many"))  # the long ones first


def worst(cases: Sequence[Errors], quantity: str) -> Errors | None:
    """The case with the largest error."""
    told = [case for case in cases if error(case, quantity) is not None]
    return max(told, key=lambda case: error(case, quantity) or 0.0, default=None)


def error(case: Errors, quantity: str) -> float | None:
    """An error, where it means something: of rss above its floor, of q below |q| = NEAR."""
    value: float | None = getattr(case, quantity)
    if quantity in ("q", "q_cov") and (case.size is None or case.size >= NEAR):
        return None
    if quantity == "rss" and (case.noise is None or case.noise < NOISY):
        return None
    return value


def named(case: Errors, value: float | None) -> dict[str, Any]:
    """An error and the case it belongs to; null for infinity, which JSON does not have."""
    finite = value is not None and value != float("inf")
    return {"error": value if finite else None, "family": case.family, "number": case.number}


def bins_of(cases: Sequence[Errors]) -> list[dict[str, Any]]:
    """One entry a bin of kappa: counts, shares within 1 ulp, worst cases."""
    found = []
    for low, high in zip((0.0, *BINS[:-1]), BINS, strict=True):
        inside = [case for case in cases if low <= case.kappa < high]
        with_q = [case for case in inside if case.size is not None and case.size < NEAR]
        entry: dict[str, Any] = {"kappa_below": high, "cases": len(inside), "q_cases": len(with_q)}
        if with_q:
            entry["cases_within_1_ulp"] = sum(case.components == 3 for case in with_q) / len(with_q)
            entry["components_within_1_ulp"] = sum(case.components for case in with_q) / (3 * len(with_q))
        for quantity in QUANTITIES:
            case = worst(inside, quantity)
            if case is not None:
                entry[quantity] = named(case, error(case, quantity))
        entry["flags"] = {
            flag: sum(flag in case.flags for case in inside)
            for flag in sorted({flag for case in inside for flag in case.flags})
        }
        found.append(entry)
    return found


def sizes_of(cases: Sequence[Errors]) -> list[dict[str, Any]]:
    """For kappa < 30: the worst error of q by |q|."""
    found = []
    for low, high in zip((0.0, *SIZES[:-1]), SIZES, strict=True):
        inside = [c for c in cases if c.kappa < BOUND_KAPPA and c.size is not None and low <= c.size < high]
        case = max(inside, key=lambda c: c.q or 0.0, default=None)
        if case is not None:
            found.append(
                {
                    "size_below": high if high != float("inf") else None,
                    "cases": len(inside),
                    "q": named(case, case.q),
                    "over_bound": sum((c.q or 0.0) > BOUND for c in inside),
                }
            )
    return found


def report(cases: Sequence[Errors]) -> dict[str, Any]:
    """All that is kept."""
    bounded = [case for case in cases if case.kappa < BOUND_KAPPA and case.size is not None]
    near = [case for case in bounded if (case.size or 0.0) < NEAR]
    far = [case for case in bounded if (case.size or 0.0) >= SIZES[2] and case.q not in (None, float("inf"))]
    failed = [case for case in cases if not FAILURES.isdisjoint(case.flags) and case.kappa < BINS[-1]]
    return {
        "cases": len(cases),
        "bound": BOUND,
        "bound_kappa": BOUND_KAPPA,
        "near": NEAR,
        "over_bound": sum((case.q or 0.0) > BOUND for case in bounded),
        "over_bound_near": sum((case.q or 0.0) > BOUND for case in near),
        "worst_near": max(near, key=lambda case: case.q or 0.0).to_json() if near else None,
        "slope": max(((case.q or 0.0) / (case.size or 1.0) for case in far), default=None),
        "failed_below_1e6": [case.to_json() for case in failed],
        "broken": [case.to_json() for case in cases if BROKEN in case.flags],
        "turn_loss": max((case.turn_loss for case in bounded), default=0.0),
        "bins": bins_of(cases),
        "sizes": sizes_of(cases),
    }


def text(found: dict[str, Any]) -> str:
    """The tables."""
    header = ["kappa(M)", "cases", "q in 1 ulp", "components", *QUANTITIES, "ILL_COND."]
    rows = []
    for entry in found["bins"]:
        row = [f"< {entry['kappa_below']:g}", str(entry["cases"])]
        row += [number(entry.get(name), ".1%") for name in ("cases_within_1_ulp", "components_within_1_ulp")]
        row += [number(entry[name]["error"]) if name in entry else "-" for name in QUANTITIES]
        rows.append([*row, str(entry["flags"].get("ILL_CONDITIONED", 0))])
    sizes = [
        [
            f"< {entry['size_below']:g}" if entry["size_below"] else "beyond",
            str(entry["cases"]),
            number(entry["q"]["error"]),
            str(entry["over_bound"]),
            f"{entry['q']['family']} #{entry['q']['number']}",
        ]
        for entry in found["sizes"]
    ]
    return "\n".join(
        [
            "largest errors against the exact solution of the quantised points:",
            table(header, rows),
            f"q, q_cov (|q| < {NEAR:g}), t_cov: norms, relative; R: absolute; t: over |a_bar| + |b_bar|;",
            f"rss: relative, rms residual at least {NOISY:g} of the extent; floor: over that of R = 0",
            "",
            f"q where kappa(M) < {BOUND_KAPPA:g}, by |q| = tan(angle / 2); over: beyond {BOUND:g}",
            table(["|q|", "cases", "q", "over", "worst"], sizes),
            f"|dq| / |q| where |q| > 100: at most {number(found['slope'])} |q|",
            f"det M of the turn taken: at most {number(found['turn_loss'])} below the largest there",
            f"frames with kappa < {BINS[-1]:g} refused: {len(found['failed_below_1e6'])}",
            f"frames that broke a word length of the model: {len(found['broken'])}",
        ]
    )


def run(cases: int = CASES, processes: int = JOBS) -> dict[str, Any]:
    """Measure."""
    started = perf_counter()
    work: Callable[[Batch], list[Errors]] = run_batch
    found = report(
        [case for batch in spread_out(work, batches(cases), "accuracy", processes) for case in batch]
    )
    return found | {"seconds": round(perf_counter() - started, 1)}


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure, print, keep; 1 where the bound is broken below |q| = NEAR."""
    parser = argparse.ArgumentParser(description="accuracy of the bit-exact model against exact rationals")
    parser.add_argument("--quick", action="store_true", help=f"{QUICK} cases, nothing kept")
    parser.add_argument("--cases", type=int, help=f"number of cases (default {CASES})")
    parser.add_argument("--jobs", type=int, default=JOBS, help="processes")
    options = parser.parse_args(arguments)
    found = run(options.cases or (QUICK if options.quick else CASES), options.jobs)
    print(text(found))
    if not options.quick:
        write_results("accuracy", found)
    return 1 if found["over_bound_near"] or found["broken"] else 0


if __name__ == "__main__":
    sys.exit(main())
