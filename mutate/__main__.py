# SPDX-License-Identifier: Apache-2.0
"""`make mutate`: mutants of every module against its tests. See README.md in this folder."""

from __future__ import annotations

import argparse
import math
import multiprocessing
import os
import sys
import time
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial

from mutate import report
from mutate.benches import TB, first_tests, modules
from mutate.campaign import Result, run_module
from mutate.trial import processor

MINUTES, END = 8.0, 9.5
"""That the sample of all modules is to take where the processors are free; no mutant is begun after END."""
LEAST, MOST = 2, 30
"""Mutants of a module in that sample."""
UNKNOWN = (20.0, 2.0)
"""Seconds before the first mutant and for each, of a module that results.json doesn't have."""
UNKNOWN_PROBE = 6.0
"""Of a folder of tests that it doesn't have."""


@dataclass(frozen=True)
class Cost:
    """What a module takes of the processor, in seconds."""

    before: float
    """Netlists, builds, tests with the right netlist, and its part of the probes that it shares."""
    each: float
    """A mutant."""


def costs(names: Sequence[str], rows: Sequence[report.Row], probes: Mapping[str, float]) -> dict[str, Cost]:
    """What the modules take, by what `rows` and `probes` (folder of tests -> seconds) tell."""
    known = {row["module"]: row for row in rows}
    folders = {name: [str(bench.relative_to(TB)) for bench in first_tests(name)] for name in names}
    shared = Counter(bench for benches in folders.values() for bench in benches)
    found = {}
    for name in names:
        before, each = UNKNOWN
        if name in known:
            before, each = known[name]["seconds_before"], max(0.1, known[name]["seconds_each"])
        before += sum(probes.get(bench, UNKNOWN_PROBE) / shared[bench] for bench in folders[name])
        found[name] = Cost(before, each)
    return found


def sample(found: Mapping[str, Cost], seconds: float) -> dict[str, int]:
    """Mutants of each module in so many seconds of the processor, the dearest module first.

    Every module's mutants get the same time, with LEAST and MOST as bounds.
    """

    def counts(share: float) -> dict[str, int]:
        return {name: min(MOST, max(LEAST, int(share / cost.each))) for name, cost in found.items()}

    def whole(name: str, count: int) -> float:
        return found[name].before + count * found[name].each

    best = counts(0.0)
    for share in range(1, 4000):
        more = counts(share / 4)
        if sum(whole(name, count) for name, count in more.items()) > seconds:
            break
        best = more
    return dict(sorted(best.items(), key=lambda one: -whole(*one)))


def _try(job: tuple[str, int | None], deep: bool, forget: bool, end: float) -> Result:
    os.nice(5)
    return run_module(job[0], job[1], deep=deep, forget=forget, end=end)


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
    start, end = time.monotonic(), math.inf
    if args.mutants:
        if args.mutants != "all" and not args.mutants.isdecimal():
            parser.error(f"MUTANTS: a number or all, not {args.mutants}")
        counts = dict.fromkeys(names, None if args.mutants == "all" else int(args.mutants))
    elif not args.module:
        known = costs(names, report.load(), report.load_probes())
        counts = dict(sample(known, 60 * MINUTES * args.jobs))
        end = start + 60 * END
        whole = sum(known[name].before + (count or 0) * known[name].each for name, count in counts.items())
        few = [name for name, count in counts.items() if count == LEAST]
        print(f"{sum(filter(None, counts.values()))} mutants of {len(names)} modules", end=", ")
        print(f"about {whole / 60:.1f} minutes of the processor in a fresh checkout", flush=True)
        if few:
            print(f"{LEAST} only, being dear: {', '.join(sorted(few))}", flush=True)
    results: list[Result] = []
    with multiprocessing.get_context("fork").Pool(args.jobs, maxtasksperchild=1) as pool:
        for one in pool.imap_unordered(
            partial(_try, deep=not args.quick, forget=args.forget, end=end), counts.items(), 1
        ):
            results.append(one)
            killed = one.count("killed", "timeout")
            print(f"{one.module:<20} {killed:>4} of {one.judged:<4} {one.error[:90]}".rstrip(), flush=True)
            report.save([one])
        pool.close()
        pool.join()  # what they have taken is known then
    results.sort(key=lambda one: names.index(one.module))
    minutes = (time.monotonic() - start) / 60
    tried = sum(len(one.fates) for one in results)
    print(f"\n{report.table([report.row(one) for one in results])}")
    print(f"{tried} mutants in {minutes:.1f} minutes, {processor() / 60:.1f} of the processor")
    left = {one.module: one.left for one in results if one.left}
    if left:
        print(f"{sum(left.values())} mutants not begun within {END:g} minutes: {', '.join(sorted(left))}")
    bad = [one.module for one in results if report.below(one)]
    if bad:
        print(f"mutate: below {report.GOAL:g} % or not tried: {', '.join(bad)}", file=sys.stderr)
    return int(bool(bad))


if __name__ == "__main__":
    sys.exit(main())
