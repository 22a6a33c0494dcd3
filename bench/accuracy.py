# SPDX-License-Identifier: Apache-2.0
"""Errors of the bit-exact model against the exact rational solution of the quantised points, by condition number.

    python -m bench.accuracy [--quick] [--cases N]

The reference solves the turn that the core names. Every case is reproduced by its family and number:
`measure(OltaeCore(), make_case(family, number))`.
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
QUIET = 10.0  # |q| up to which the bound on q holds: 168.6 degrees

Batch = tuple[str, int, int]


def run_batch(batch: Batch) -> list[Errors]:
    """Cases first..last - 1 of a family."""
    family, first, last = batch
    core = OltaeCore()
    return [measure(core, make_case(family, k)) for k in range(first, last)]


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
    """An error, where it means something: the relative one of rss only above its floor."""
    value: float | None = getattr(case, quantity)
    if quantity == "rss" and (case.noise is None or case.noise < NOISY):
        return None
    return value


def bins_of(cases: Sequence[Errors]) -> list[dict[str, Any]]:
    """One entry a bin of kappa: counts, shares within 1 ulp, worst cases."""
    found = []
    for low, high in zip((0.0, *BINS[:-1]), BINS, strict=True):
        inside = [case for case in cases if low <= case.kappa < high]
        with_q = [case for case in inside if case.q is not None]
        entry: dict[str, Any] = {"kappa_below": high, "cases": len(inside), "q_cases": len(with_q)}
        if with_q:
            entry["cases_within_1_ulp"] = sum(case.components == 3 for case in with_q) / len(with_q)
            entry["components_within_1_ulp"] = sum(case.components for case in with_q) / (3 * len(with_q))
        for quantity in QUANTITIES:
            case = worst(inside, quantity)
            if case is not None:
                entry[quantity] = {
                    "error": error(case, quantity),
                    "family": case.family,
                    "number": case.number,
                }
        entry["flags"] = {
            flag: sum(flag in case.flags for case in inside)
            for flag in sorted({flag for case in inside for flag in case.flags})
        }
        found.append(entry)
    return found


def sizes_of(cases: Sequence[Errors]) -> list[dict[str, Any]]:
    """For kappa < 30: the worst error of q by |q|, and over |q|."""
    found = []
    for low, high in zip((0.0, *SIZES[:-1]), SIZES, strict=True):
        inside = [c for c in cases if c.kappa < BOUND_KAPPA and c.size is not None and low <= c.size < high]
        case = worst(inside, "q")
        if case is not None and case.q is not None:
            found.append(
                {
                    "size_below": high if high != float("inf") else None,
                    "cases": len(inside),
                    "q": {"error": case.q, "family": case.family, "number": case.number},
                    "over_bound": sum((c.q or 0.0) > BOUND for c in inside),
                }
            )
    return found


def report(cases: Sequence[Errors]) -> dict[str, Any]:
    """All that is kept."""
    bounded = [case for case in cases if case.kappa < BOUND_KAPPA and case.size is not None]
    quiet = [case for case in bounded if (case.size or 0.0) < QUIET]
    failed = [case for case in cases if not FAILURES.isdisjoint(case.flags) and case.kappa < BINS[-1]]
    everywhere, below = worst(bounded, "q"), worst(quiet, "q")
    return {
        "cases": len(cases),
        "bound": BOUND,
        "bound_kappa": BOUND_KAPPA,
        "over_bound": sum((case.q or 0.0) > BOUND for case in bounded),
        "over_bound_below_quiet": sum((case.q or 0.0) > BOUND for case in quiet),
        "quiet": QUIET,
        "worst": everywhere.to_json() if everywhere else None,
        "worst_below_quiet": below.to_json() if below else None,
        "failed_below_1e6": len(failed),
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
            "q, q_cov, t_cov: norms, relative; R: absolute; t: of |a_bar| + |b_bar|; rss: relative, rms residual",
            f"at least {NOISY:g} of the extent; floor: error of rss over sum w (|a - a_bar|^2 + |b - b_bar|^2)",
            "",
            f"q where kappa(M) < {BOUND_KAPPA:g}, by |q| = tan(angle / 2); over: beyond {BOUND:g}",
            table(["|q|", "cases", "q", "over", "worst"], sizes),
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
    """Measure, print, keep; 1 where the bound is broken below |q| = QUIET."""
    parser = argparse.ArgumentParser(description="accuracy of the bit-exact model against exact rationals")
    parser.add_argument("--quick", action="store_true", help=f"{QUICK} cases, nothing kept")
    parser.add_argument("--cases", type=int, help=f"number of cases (default {CASES})")
    parser.add_argument("--jobs", type=int, default=JOBS, help="processes")
    options = parser.parse_args(arguments)
    found = run(options.cases or (QUICK if options.quick else CASES), options.jobs)
    print(text(found))
    if not options.quick:
        write_results("accuracy", found)
    return 1 if found["over_bound_below_quiet"] else 0


if __name__ == "__main__":
    sys.exit(main())
