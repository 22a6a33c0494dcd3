# SPDX-License-Identifier: Apache-2.0
"""`make faults`: single-event upsets in both cores. See README.md in this folder."""

from __future__ import annotations

import argparse
import sys
import time
from dataclasses import replace
from datetime import UTC, datetime
from itertools import groupby
from pathlib import Path

from faults import report
from faults.campaign import QUICK, Found, Size, campaign, command, offences
from faults.classes import classify
from faults.costs import costs
from faults.frames import WAYS, episode
from faults.trials import BenchFailed, Model, Outcome, Trial, build, run, window
from scripts.marked import fill
from sim import runner
from sim.sources import RTL


def _one(model: Model, args: argparse.Namespace) -> int:
    """One flip, told."""
    bit = next((bit for bit in model.bits if bit.name == args.flip), None)
    if bit is None:
        near = [one.name for one in model.bits if args.flip.partition("[")[0] in one.name][:5]
        print(
            f"faults: {model.top} has no flip-flop {args.flip}{'; ' if near else ''}{', '.join(near)}",
            file=sys.stderr,
        )
        return 2
    kind = next(kind for kind, bits in classify([bit]).items() if bits)
    ways = [way.name for way in WAYS[model.top]]
    if args.way and args.way not in ways:
        print(f"faults: {model.top} has no way {args.way}; there are {', '.join(ways)}", file=sys.stderr)
        return 2
    bad = 0
    for way in [args.way] if args.way else ways:
        times = window(model, way, args.seed)
        some = range(times.end, times.read) if args.reading else range(times.end)
        if args.clock is not None:
            some = range(args.clock, args.clock + 1)
            if not 0 <= args.clock < times.read:
                print(f"faults: {way} takes {times.read} clocks to the last result", file=sys.stderr)
                return 2
        outcomes = run(model, way, args.seed, [Trial(bit, way, clock, args.seed) for clock in some])
        outcomes.sort(key=lambda one: one.trial.clock)
        bad += sum(bool(offences(one, kind)) for one in outcomes)
        names = [result.name for result in episode(model.top, way, args.seed).results]
        if args.clock is not None:
            _tell(outcomes[0], kind, names)
            continue
        print(f"{way}: loaded at {times.loaded}, end at {times.end}")
        same = groupby(outcomes, lambda one: (one.verdict, one.next, one.later, tuple(offences(one, kind))))
        for (verdict, next_, later, words), group in same:
            clocks = [one.trial.clock for one in group]
            what = f"{verdict}, next {next_}{', later ' + later if later else ''}"
            print(f"  clock {clocks[0]}..{clocks[-1]}: {what}{' !!! ' if words else ''}{'; '.join(words)}")
    print(f"{bit.name} ({kind}, {bit.module}): {bad} flips do what may not be")
    return int(bool(bad))


def _tell(one: Outcome, kind: str, names: list[str]) -> None:
    """One outcome, frame by frame. names: of the results."""
    later = f", later {one.later}" if one.later else ""
    print(f"{one.trial.way}, clock {one.trial.clock}: frame 1 {one.verdict}, next {one.next}{later}")
    for number, seen in enumerate(one.frames, 1):
        wrong = seen.wrong | seen.diagnostic
        shown = " ".join(name for k, name in enumerate(names) if wrong >> k & 1) or "-"
        print(f"  frame {number}: flags 0x{seen.flags:x}, {seen.clocks} clocks, wrong: {shown}")
    for word in (*one.how, *offences(one, kind)):
        print(f"  {word}")


def main() -> int:
    """Run; returns 1 where something happened that may not be."""
    parser = argparse.ArgumentParser(prog="faults", description=__doc__)
    parser.add_argument(
        "--core", choices=("both", *(top.removesuffix("_top") for top in WAYS)), default="both"
    )
    parser.add_argument(
        "--flips", type=int, default=Size.flips, help="of each control and configuration flip-flop"
    )
    parser.add_argument("--data", type=int, default=Size.data, help="flip-flops of data, one flip each")
    parser.add_argument("--memory", type=int, default=Size.memory, help="bits of memories")
    parser.add_argument(
        "--only", default="*", help="pattern of module.register, as in 'axil_slave.*'; nothing is kept"
    )
    parser.add_argument("--reading", action="store_true", help="hit while results are read; nothing is kept")
    parser.add_argument("--quick", action="store_true", help="a sample; nothing is kept")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument(
        "--rtl", type=Path, default=RTL, help="another rtl/ folder; nothing is kept without --label"
    )
    parser.add_argument("--label", choices=("now", "before"), help="keep the counts in results.json so")
    parser.add_argument("--costs", action="store_true", help="no flips: what the protections cost, by Yosys")
    parser.add_argument("--flip", help="one flip-flop, by name")
    parser.add_argument("--way", help="of --flip: of the frames (default: all)")
    parser.add_argument("--clock", type=int, help="of --flip: from frame 1's first beat (default: all)")
    args = parser.parse_args()
    if args.costs:
        report.save_costs(costs())
        fill(report.README, "faults", report.docs_part())
        return 0
    why = runner.missing("verilator")
    if why:
        print(f"faults: {why}", file=sys.stderr)
        return 2
    if not args.rtl.is_dir():
        print(f"faults: {args.rtl} is no folder", file=sys.stderr)
        return 2
    tops = [top for top in WAYS if args.core in ("both", top.removesuffix("_top"))]
    if args.flip and len(tops) > 1:
        print("faults: --flip needs --core", file=sys.stderr)
        return 2
    size = QUICK if args.quick else Size(args.flips, args.data, args.memory)
    size = replace(size, only=args.only, reading=args.reading)
    whole = size == Size() and args.seed == 1
    founds: list[Found] = []
    start = time.monotonic()
    try:
        for top in tops:
            model = build(top, args.rtl)
            if args.flip:
                return _one(model, args)

            def progress(done: int, every: int, top: str = top) -> None:
                if sys.stderr.isatty():
                    print(f"\r{top}: {done} of {every} flips", end="", file=sys.stderr, flush=True)

            founds.append(campaign(model, size, args.seed, args.jobs, progress))
            if sys.stderr.isatty():
                print(file=sys.stderr)
    except BenchFailed as error:
        print(f"faults: {error}", file=sys.stderr)
        return 2
    minutes = (time.monotonic() - start) / 60
    print(report.text(founds))
    trials = sum(row.trials for found in founds for row in found.classes.values())
    print(f"\n{trials} flips in {minutes:.1f} minutes")
    label = args.label or ("now" if whole and args.rtl == RTL else None)
    if label:
        about = {"date": datetime.now(UTC).date().isoformat(), "flips": size.flips, "seed": args.seed}
        report.save(founds, label, about)
        fill(report.README, "faults", report.docs_part())
    bad = [(found.top, pair) for found in founds for pair in found.offenders]
    if bad:
        top, (one, _) = bad[0]
        print(
            f"faults: {len(bad)} flips do what may not be; the first: {command(top, one.trial)}",
            file=sys.stderr,
        )
    return int(bool(bad))


if __name__ == "__main__":
    sys.exit(main())
