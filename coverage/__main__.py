# SPDX-License-Identifier: Apache-2.0
"""`make coverage`: the regression on Verilator with all counters on. See README.md in this folder."""

from __future__ import annotations

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import time
from collections import Counter
from pathlib import Path

from coverage import counters, functional, report
from coverage.waivers import Waiver, WaiverError, judge, load
from sim.runner import missing, simulator_version
from sim.sources import ROOT, RTL

BUILD = ROOT / "build" / "coverage"
RAW = BUILD / "raw"
HERE = Path(__file__).parent
GOAL = 98.0
DEMANDED = ("line", "branch")
LONGEST = ("soak", "oltae", "ivisnav")
# one simulator is enough: a test that runs both only to compare them adds nothing here
DESELECTED = "not icarus and not simulators_agree"
# runs that must fail are not counted, so they need not be made
DESELECTED += " and not every_port_is_compared and not broken_core_is_found"


def benches() -> list[str]:
    """Folders of tb/ with tests of RTL, those with the largest builds and the longest runs first."""
    folders = [folder.name for folder in RTL.iterdir() if (ROOT / "tb" / folder.name).is_dir()]
    last = sorted({*folders} - {*LONGEST} - {"include"})
    return [f"tb/{name}" for name in [*LONGEST, *last]]


def pytest(arguments: list[str], *, quiet: bool = False) -> subprocess.CompletedProcess[str]:
    """Run pytest here."""
    command = [sys.executable, "-m", "pytest", *arguments]
    environment = {**os.environ, "RELNAV_COVERAGE": str(RAW)}
    output = subprocess.PIPE if quiet else None
    return subprocess.run(command, cwd=ROOT, env=environment, text=True, stdout=output, check=False)


def count_tests() -> dict[str, int]:
    """Cases of each folder of tb/, both simulators and Python."""
    listed = pytest(["--collect-only", "-q", "tb"], quiet=True).stdout
    files = re.findall(r"^tb/(\S+)/test_\w+\.py::", listed, re.MULTILINE)
    return dict(Counter(files))


def tell(tallies: report.Tallies, points: list[functional.CoverPoint]) -> None:
    """The headline, and which modules and cover points have holes."""
    for kind in counters.KINDS:
        hit, waived, total = report.totals(tallies, kind)
        print(
            f"{kind:<7} {hit} of {total}: {report.percent(hit, total)} %, "
            f"{report.percent(hit, total - waived)} % without the {waived} waived"
        )
    for name, tally in sorted(tallies.items()):
        open_ones = [f"{len(tally[kind].holes)} {kind}" for kind in DEMANDED if tally[kind].holes]
        if open_ones:
            print(f"  holes in {name}: {', '.join(open_ones)}")
    bins, hit = sum(len(point.bins) for point in points), sum(point.hit for point in points)
    print(f"functional {hit} of {bins} bins of {len(points)} points: {report.percent(hit, bins)} %")
    for point in points:
        if point.holes:
            print(f"  holes in {point.name}: {'; '.join(point.holes)}")


def main() -> int:
    """Run; returns 1 where a test fails, a waiver is wrong or lines or branches are below the goal."""
    parser = argparse.ArgumentParser(prog="coverage", description=__doc__)
    parser.add_argument("tests", nargs="*", help="only these files or folders; results.json stays as it is")
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--add", action="store_true", help="keep what the last runs left, add these tests")
    parser.add_argument("--report", action="store_true", help="of the last run again: no test is run")
    args = parser.parse_args()
    if reason := missing("verilator"):
        print(f"coverage: {reason}", file=sys.stderr)
        return 2
    try:
        waivers = load()
    except WaiverError as error:
        print(f"coverage: {error}", file=sys.stderr)
        return 2
    problems: list[str] = []
    started = time.monotonic()
    if not args.report:
        if not args.add:
            shutil.rmtree(RAW, ignore_errors=True)
        options = ["-q", "-n", str(args.jobs), "--dist", "worksteal", "-k", DESELECTED]
        if pytest([*options, *(args.tests or benches())]).returncode:
            problems.append("tests failed; what they did is not counted")
    files = sorted(RAW.glob("*.dat"))
    modules = counters.read(files)
    used: set[Waiver] = set()
    tallies = {name: judge(module, waivers, used) for name, module in modules.items()}
    points = functional.read(sorted(RAW.glob("functional-*.xml")), BUILD / "functional.xml")
    about = {
        "date": time.strftime("%Y-%m-%d"),
        "tool": simulator_version("verilator"),
        "goal": GOAL,
        "runs": len(files),
    }
    if not args.tests:
        problems += [
            f"waiver not needed or out of date: {waiver.file}: {waiver.text or waiver.signals}"
            for waiver in waivers
            if waiver not in used
        ]
        untouched = {file.stem for file in RTL.glob("*/*.v")} - modules.keys()
        problems += [f"no test simulates {name}" for name in sorted(untouched)]
        for kind in DEMANDED:
            hit, waived, total = report.totals(tallies, kind)
            if 100 * hit < GOAL * (total - waived) or not total:
                problems.append(f"{kind} coverage is below {GOAL:g} %")
        found = report.results(tallies, points, about, count_tests())
        report.write(HERE / "results.json", json.dumps(found, indent=1) + "\n")
    place = BUILD if args.tests else HERE
    report.write(place / "report.md", report.markdown(modules, tallies, points, about, problems))
    report.write(BUILD / "report.html", report.page(modules, tallies))
    tell(tallies, points)
    minutes = (time.monotonic() - started) / 60
    print(f"{len(files)} runs, {minutes:.1f} minutes; {place / 'report.md'}, {BUILD / 'report.html'}")
    for problem in problems:
        print(f"coverage: {problem}", file=sys.stderr)
    return int(bool(problems))


if __name__ == "__main__":
    sys.exit(main())
