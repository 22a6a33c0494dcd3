# SPDX-License-Identifier: Apache-2.0
"""`make mutate`: mutants of every module against its tests. See README.md in this folder."""

from __future__ import annotations

import argparse
import multiprocessing
import os
import sys
import time
from collections.abc import Sequence
from functools import partial

from mutate import report
from mutate.benches import modules
from mutate.campaign import Result, run_module

MINUTES = 8.0
"""That the sample of all modules is to take where the processors are free: ten with what is not foreseen."""
LEAST, MOST = 2, 30
"""Mutants of a module in that sample."""
UNKNOWN = (20.0, 2.0)
"""Seconds before the first mutant and for each, of a module that results.json doesn't have."""


def sample(names: Sequence[str], rows: Sequence[report.Row], seconds: float) -> dict[str, int]:
    """Mutants of each module in so many seconds of the processor, by the costs that `rows` tell.

    Every module's mutants get the same time, with LEAST and MOST as bounds.
    """
    costs = dict.fromkeys(names, UNKNOWN)
    for row in rows:
        if row["module"] in costs:
            costs[row["module"]] = (row["seconds_before"], max(0.1, row["seconds_each"]))

    def counts(share: float) -> dict[str, int]:
        return {name: min(MOST, max(LEAST, int(share / each))) for name, (_, each) in costs.items()}

    best = counts(0.0)
    for share in range(1, 2000):
        found = counts(share / 2)
        if sum(before + found[name] * each for name, (before, each) in costs.items()) > seconds:
            break
        best = found
    return best


def _try(job: tuple[str, int | None], deep: bool, forget: bool) -> Result:
    os.nice(5)
    return run_module(job[0], job[1], deep=deep, forget=forget)


def main() -> int:
    """Run; returns 1 where a module is below 95 % or could not be tried."""
    parser = argparse.ArgumentParser(prog="mutate", description=__doc__)
    parser.add_argument("--module", action="append", help="only these (default: all)")
    parser.add_argument(
        "--mutants", default="", help="of each module, or all (default: what fits ten minutes)"
    )
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument(
        "--quick", action="store_true", help="survivors are not given to Verilator and the cores"
    )
    parser.add_argument("--forget", action="store_true", help="try again what earlier runs have tried")
    args = parser.parse_args()
    names = [name for word in args.module or [] for name in word.replace(",", " ").split()] or modules()
    unknown = set(names) - set(modules())
    if unknown:
        parser.error(f"no such module: {', '.join(sorted(unknown))}")
    counts: dict[str, int | None] = dict.fromkeys(names, 40)
    if args.mutants:
        if args.mutants != "all" and not args.mutants.isdecimal():
            parser.error(f"MUTANTS: a number or all, not {args.mutants}")
        counts = dict.fromkeys(names, None if args.mutants == "all" else int(args.mutants))
    elif not args.module:
        counts = dict(sample(names, report.load(), 60 * MINUTES * args.jobs))
    start = time.monotonic()
    results: list[Result] = []
    with multiprocessing.get_context("fork").Pool(args.jobs, maxtasksperchild=1) as pool:
        for one in pool.imap_unordered(
            partial(_try, deep=not args.quick, forget=args.forget), counts.items(), 1
        ):
            results.append(one)
            killed = one.count("killed", "timeout")
            print(f"{one.module:<20} {killed:>4} of {one.judged:<4} {one.error[:90]}".rstrip(), flush=True)
            report.save([one])
    results.sort(key=lambda one: names.index(one.module))
    minutes = (time.monotonic() - start) / 60
    tried = sum(len(one.fates) for one in results)
    print(f"\n{report.table([report.row(one) for one in results])}")
    print(f"{tried} mutants in {minutes:.1f} minutes, {tried / minutes:.0f} a minute")
    bad = [one.module for one in results if report.below(one)]
    if bad:
        print(f"mutate: below {report.GOAL:g} % or not tried: {', '.join(bad)}", file=sys.stderr)
    return int(bool(bad))


if __name__ == "__main__":
    sys.exit(main())
