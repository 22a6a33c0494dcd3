# SPDX-License-Identifier: Apache-2.0
"""`make mutate`: mutants of every module against its tests. See README.md in this folder."""

from __future__ import annotations

import argparse
import contextlib
import json
import multiprocessing
import os
import sys
import time
from collections.abc import Sequence
from dataclasses import asdict
from functools import partial
from pathlib import Path

from mutate.benches import first_tests, modules
from mutate.campaign import BUILD, SEED, Result, fingerprint, probe_folder, run_module
from mutate.netlist import module_file

SAMPLE = 240
"""Mutants of all modules together where none says how many."""
LEAST = 2
GOAL = 95.0


def spread(names: list[str], total: int) -> dict[str, int]:
    """Mutants a module, in proportion to its lines, two at least."""
    lines = {name: len(module_file(name).read_text().splitlines()) for name in names}
    whole = sum(lines.values())
    return {name: max(LEAST, round(total * count / whole)) for name, count in lines.items()}


def _untried(one: Result) -> bool:
    """Whether nothing came of it: no mutant at all, or none that compiles."""
    return len(one.fates) == one.count("invalid")


def table(results: list[Result]) -> str:
    """The rows, as Markdown."""
    rows = [
        "| module | mutants | equivalent | invalid | killed | of them by time | survivors | killed % |",
        "|---|---|---|---|---|---|---|---|",
    ]
    for one in results:
        counts = [
            len(one.fates),
            one.count("equivalent"),
            one.count("invalid"),
            one.count("killed", "timeout"),
            one.count("timeout"),
            one.count("survived"),
        ]
        percent = f"{one.percent:.1f}" if one.fates else one.error.replace("\n", " ")[:80]
        rows.append(f"| {one.module} | {' | '.join(map(str, counts))} | {percent} |")
    return "\n".join(rows)


def save(results: Sequence[Result], start: float) -> None:
    """Write results.json: this run's modules, and those of earlier runs whose text is still the same."""
    BUILD.mkdir(parents=True, exist_ok=True)
    file = BUILD / "results.json"
    rows = {one.module: {**asdict(one), "percent": round(one.percent, 2)} for one in results}
    for row in json.loads(file.read_text())["modules"] if file.is_file() else []:
        if row["module"] in modules() and row["source"] == fingerprint(row["module"]):
            rows.setdefault(row["module"], row)
    minutes = (time.monotonic() - start) / 60
    tried = sum(len(one.fates) for one in results)
    summary = {
        "seed": SEED,
        "goal": GOAL,
        "mutants_per_minute": round(tried / minutes, 1),
        "modules": [rows[name] for name in modules() if name in rows],
    }
    file.write_text(json.dumps(summary, indent=1) + "\n")


def _probe(bench: Path) -> None:
    """Ahead of the mutants, since many modules share a bench; a module says itself that its probe fails."""
    os.nice(5)
    with contextlib.suppress(RuntimeError):
        probe_folder(bench)


def _try(job: tuple[str, int | None], deep: bool, forget: bool) -> Result:
    os.nice(5)
    return run_module(job[0], job[1], deep=deep, forget=forget)


def main() -> int:
    """Run; returns 1 where a module is below 95 % or could not be tried."""
    parser = argparse.ArgumentParser(prog="mutate", description=__doc__)
    parser.add_argument("--module", action="append", help="only these (default: all)")
    parser.add_argument("--mutants", default="", help=f"for each module, or all (default: {SAMPLE} together)")
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
    counts: dict[str, int | None] = dict(spread(names, SAMPLE if len(names) > 1 else 40))
    if args.mutants:
        counts = dict.fromkeys(names, None if args.mutants == "all" else int(args.mutants))
    start = time.monotonic()
    results: list[Result] = []
    with multiprocessing.get_context("fork").Pool(args.jobs, maxtasksperchild=1) as pool:
        benches = sorted({bench for name in names for bench in first_tests(name)})
        for _ in pool.imap_unordered(_probe, benches, 1):
            pass
        jobs = sorted(counts.items(), key=lambda job: -(job[1] or 0))
        for one in pool.imap_unordered(partial(_try, deep=not args.quick, forget=args.forget), jobs, 1):
            results.append(one)
            killed = one.count("killed", "timeout")
            print(
                f"{one.module:<20} {killed:>4} of {one.judged:<4} {one.seconds:6.0f} s  {one.error[:90]}",
                flush=True,
            )
            save(results, start)
    results.sort(key=lambda one: names.index(one.module))
    text, minutes = table(results), (time.monotonic() - start) / 60
    tried = sum(len(one.fates) for one in results)
    print(f"\n{text}\n\n{tried} mutants in {minutes:.1f} minutes, {tried / minutes:.0f} a minute")
    for one in results:
        for fate in one.fates:
            if fate.state in ("survived", "invalid"):
                print(f"{fate.state}: {one.module} #{fate.number}: {fate.key} {fate.wire} ({fate.source})")
    bad = [one.module for one in results if one.percent < GOAL or one.error or _untried(one)]
    if bad:
        print(f"mutate: below {GOAL:g} % or not tried: {', '.join(bad)}", file=sys.stderr)
    return int(bool(bad))


if __name__ == "__main__":
    sys.exit(main())
