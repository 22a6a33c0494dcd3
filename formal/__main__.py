# SPDX-License-Identifier: Apache-2.0
"""All proofs and all broken copies: `python -m formal [MODULE ...]` (make formal).

A line per property group; build/formal/results.json and results.md keep all lines, of earlier runs too, and
once they have them all formal/results.json says it in short, for docs/verification.md.
Ends with 1 where a proof fails or a broken copy passes, with 2 where a tool is missing.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path

from formal.runner import (
    BUILD,
    RTL,
    Broken,
    DoesNotFit,
    Group,
    Outcome,
    ToolsMissing,
    caught,
    labels,
    run,
    run_broken,
    sources,
    table,
    tools,
)
from formal.targets import GROUPS
from sim.sources import fingerprint

SHORT = Path(__file__).parent / "results.json"
HEAD = ("module", "properties", "engine", "depth", "time", "result", "broken copies caught")


def fingerprints(module: str) -> dict[str, str]:
    """Of every module that the proofs of `module` read: the proof is of all of them."""
    names = sorted(Path(file).stem for file in sources(module) if file.endswith(".v"))
    return {name: fingerprint(name) for name in names}


def report(group: Group, proof: Outcome, pairs: list[tuple[Broken, Outcome]]) -> dict[str, object]:
    """What results.json says of one group."""
    return {
        "module": group.module,
        "sources": fingerprints(group.module),
        "task": group.proof,
        "about": group.about,
        "engine": proof.engine,
        "depth": proof.depth,
        "seconds": round(proof.seconds, 1),
        "status": proof.status,
        "failed": list(proof.failed),
        "broken": [
            {
                "file": broken.file,
                "old": broken.old,
                "new": broken.new,
                "task": broken.task,
                "label": broken.label,
                "caught": caught(broken, outcome),
                "status": outcome.status,
                "failed": list(outcome.failed),
                "seconds": round(outcome.seconds, 1),
            }
            for broken, outcome in pairs
        ],
    }


def line(entry: dict[str, object]) -> tuple[str, ...]:
    """One row of the table."""
    broken = entry["broken"]
    assert isinstance(broken, list)
    found = sum(bool(item["caught"]) for item in broken)
    return (
        str(entry["module"]),
        str(entry["about"]),
        str(entry["engine"]),
        str(entry["depth"]),
        f"{entry['seconds']} s",
        str(entry["status"]),
        f"{found} of {len(broken)}" if broken else "-",
    )


def merged(entries: list[dict[str, object]]) -> list[dict[str, object]]:
    """The new entries among those of earlier runs, which kept the other modules."""
    new = {(str(entry["module"]), str(entry["task"])): entry for entry in entries}
    file = BUILD / "results.json"
    old = json.loads(file.read_text())["groups"] if file.exists() else []
    everything = {(str(entry["module"]), str(entry["task"])): entry for entry in old} | new
    keys = ((group.module, group.proof) for group in GROUPS)
    return [everything[key] for key in keys if key in everything]


def summarise(entries: list[dict[str, object]], seconds: float) -> dict[str, object]:
    """What results.json says: totals, which assertions no broken copy made fail, and the entries."""
    asserted: set[tuple[str, str]] = set()
    seen: set[tuple[str, str]] = set()
    copies: list[dict[str, object]] = []
    for entry in entries:
        broken = entry["broken"]
        assert isinstance(broken, list)
        copies += broken
        failed = {name for copy in broken for name in copy["failed"]}
        for file, names in labels(str(entry["module"])).items():
            asserted |= {(file, name) for name in names}
            seen |= {(file, name) for name in names & failed}
    return {
        "date": time.strftime("%Y-%m-%d"),
        "proofs": len(entries),
        "passed": sum(entry["status"] == "PASS" for entry in entries),
        "broken": len(copies),
        "caught": sum(bool(copy["caught"]) for copy in copies),
        "assertions": len(asserted),
        "seen_failing": len(seen),
        "never_failed": sorted(f"{file}: {name}" for file, name in asserted - seen),
        "seconds": round(seconds, 1),
        "groups": entries,
    }


def in_short(summary: dict[str, object]) -> dict[str, object]:
    """The summary without times, and of the broken copies their numbers: what stands in the repository."""
    groups = summary["groups"]
    assert isinstance(groups, list)
    kept = ("date", "proofs", "passed", "broken", "caught", "assertions", "seen_failing", "never_failed")
    return {
        **{name: summary[name] for name in kept},
        "groups": [
            {name: group[name] for name in ("module", "sources", "task", "about")}
            | {name: group[name] for name in ("engine", "depth", "status")}
            | {"broken": len(group["broken"]), "caught": sum(copy["caught"] for copy in group["broken"])}
            for group in groups
        ],
    }


def main() -> int:
    """Run them, two at a time; see above for the exit code."""
    parser = argparse.ArgumentParser(description="formal proofs of single modules")
    parser.add_argument(
        "modules", nargs="*", metavar="MODULE", help=f"of {', '.join(sorted({g.module for g in GROUPS}))}"
    )
    parser.add_argument("--jobs", type=int, default=2, help="runs at the same time (2)")
    options = parser.parse_args()
    known = {group.module for group in GROUPS}
    if wrong := [name for name in options.modules if name not in known]:
        parser.error(f"no proofs of {', '.join(wrong)}; there are some of {', '.join(sorted(known))}")
    try:
        tools()
    except ToolsMissing as error:
        print(f"formal: {error}", file=sys.stderr)
        return 2
    groups = [group for group in GROUPS if not options.modules or group.module in options.modules]
    started = time.monotonic()
    entries: list[dict[str, object]] = []
    bad: list[str] = []
    with ThreadPoolExecutor(max(1, options.jobs)) as pool:
        pending: list[tuple[Group, Future[Outcome], list[Future[Outcome]]]] = []
        number = 0
        for group in groups:
            proof = pool.submit(run, group.module, group.proof, BUILD / group.module / group.proof, RTL)
            copies = []
            for broken in group.broken:
                number += 1
                copies.append(pool.submit(run_broken, group.module, number, broken))
            pending.append((group, proof, copies))
        for group, proof, copies in pending:
            pairs: list[tuple[Broken, Outcome]] = []
            for broken, copy in zip(group.broken, copies, strict=True):
                try:
                    pairs.append((broken, copy.result()))
                except DoesNotFit as error:
                    bad.append(f"broken copy does not fit: {error}")
                    pairs.append((broken, Outcome("DOES NOT FIT", "", 0, 0.0, (), BUILD)))
            outcome = proof.result()
            entry = report(group, outcome, pairs)
            entries.append(entry)
            print("  ".join(line(entry)), flush=True)
            if outcome.status != "PASS":
                what = f"{outcome.status} {' '.join(outcome.failed)}"
                bad.append(f"{group.module} {group.proof}: {what} in {outcome.folder}")
            for broken, result in pairs:
                if result.status != "DOES NOT FIT" and not caught(broken, result):
                    what = f"{result.status}, failed: {' '.join(result.failed) or 'none'}"
                    bad.append(
                        f"broken copy not caught by {broken.label} ({what}): {group.module}: {broken.new!r}"
                    )
    seconds = time.monotonic() - started
    if len(groups) < len(GROUPS):
        entries = merged(entries)
    summary = summarise(entries, seconds)
    BUILD.mkdir(parents=True, exist_ok=True)
    (BUILD / "results.json").write_text(json.dumps(summary, indent=1) + "\n")
    if len(entries) == len(GROUPS) and all("sources" in entry for entry in entries):
        SHORT.write_text(json.dumps(in_short(summary), indent=1) + "\n")
    (BUILD / "results.md").write_text(table([HEAD, *(line(entry) for entry in entries)]) + "\n")
    for text in bad:
        print(f"formal: {text}", file=sys.stderr)
    print(
        f"formal: {summary['passed']} of {summary['proofs']} proofs; "
        f"{summary['caught']} of {summary['broken']} broken copies caught; "
        f"{summary['assertions']} assertions, {summary['seen_failing']} of them seen to fail; "
        f"{seconds:.0f} s; {len(bad)} problems"
    )
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
