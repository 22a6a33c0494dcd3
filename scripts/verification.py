# SPDX-License-Identifier: Apache-2.0
"""docs/verification.md from the results that the tools leave in the repository. Runs nothing itself.

python scripts/verification.py
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT), str(ROOT / "sw")]

from coverage.counters import KINDS  # noqa: E402 (the path is set above)
from coverage.report import percent  # noqa: E402
from mutate.benches import TB, first_tests, modules  # noqa: E402
from scripts.marked import table  # noqa: E402
from sim.sources import RTL, fingerprint, module_file  # noqa: E402

PAGE = ROOT / "docs" / "verification.md"
NOT_RUN = "not run"
CHANGED = "\\*"
"""Behind a result of an earlier text of the module."""
Results = Mapping[str, Any]


def load(tool: str) -> Results:
    """The results of a tool; empty where it has not been run."""
    file = ROOT / tool / "results.json"
    found: Results = json.loads(file.read_text(encoding="utf-8")) if file.is_file() else {}
    return found


def sources_of(tool: str, results: Results) -> dict[str, dict[str, str]]:
    """module -> the texts that were tried with it, as module -> fingerprint."""
    if tool == "formal":
        found: dict[str, dict[str, str]] = {}
        for group in results.get("groups", []):
            found.setdefault(group["module"], {}).update(group["sources"])
        return found
    if tool == "mutate":
        return {row["module"]: {row["module"]: row["source"]} for row in results.get("modules", [])}
    return {name: {name: row["source"]} for name, row in results.get("modules", {}).items()}


def is_stale(sources: Mapping[str, str]) -> bool:
    """Whether a module is no longer what was tried."""
    known = modules()
    return any(name not in known or source != fingerprint(name) for name, source in sources.items())


def outdated(tool: str, results: Results) -> list[str]:
    """Modules with a result of an earlier text."""
    return sorted(name for name, sources in sources_of(tool, results).items() if is_stale(sources))


def date(results: Results) -> str:
    """Of the last run, or of the last of the modules' runs; "not kept" where the tool did not write it."""
    rows = results.get("modules", [])
    dates = [row.get("date", "") for row in rows] if isinstance(rows, list) else []
    return str(results.get("date") or max(dates, default="") or ("not kept" if results else "-"))


def stale(module: str, source: str) -> str:
    """A mark where the module is no longer what was tried."""
    return CHANGED if is_stale({module: source}) else ""


def percents(part: int, whole: int) -> str:
    """With the sign."""
    return f"{percent(part, whole)} %"


# ------------------------------------------------------------------------------------------ by module


def tests(results: Results, module: str) -> str:
    """Number of cases, and where they stand if not with the module."""
    try:
        folders = [folder.relative_to(TB).as_posix() for folder in first_tests(module)]
    except ValueError:
        return "none"
    count = sum(results.get("tests", {}).get(folder, 0) for folder in folders)
    inside = [folder.rpartition("/")[2] for folder in folders]
    shown = str(count) if results else NOT_RUN
    return shown if inside == [module] else f"{shown} in {', '.join(inside)}"


def proofs(results: Results, module: str) -> tuple[str, str]:
    """(proofs that pass, broken copies caught)."""
    groups = [group for group in results.get("groups", []) if group["module"] == module]
    if not groups:
        return "-", "-"
    mark = CHANGED if is_stale(sources_of("formal", results)[module]) else ""
    passed = sum(group["status"] == "PASS" for group in groups)
    broken, caught = sum(group["broken"] for group in groups), sum(group["caught"] for group in groups)
    return f"{passed} of {len(groups)}{mark}", f"{caught} of {broken}{mark}" if broken else "-"


def killed_of(row: Results) -> tuple[int, int]:
    """(killed, killable)."""
    killed: int = row["killed"]
    return killed, killed + row["survivors"]


def mutants(results: Results, module: str) -> str:
    """Killed of those that can be."""
    row = next((row for row in results.get("modules", []) if row["module"] == module), None)
    if row is None:
        return NOT_RUN
    killed, killable = killed_of(row)
    return f"{killed} of {killable}{stale(module, row['source'])}"


def covered(results: Results, module: str) -> list[str]:
    """Lines, branches, toggles."""
    row = results.get("modules", {}).get(module)
    if row is None:
        return [NOT_RUN] * len(KINDS)
    mark = stale(module, row["source"])
    return [
        f"{percents(row[kind][0], row[kind][2] - row[kind][1])}{mark}" if row[kind][2] else "-"
        for kind in KINDS
    ]


def upsets(results: Results, module: str) -> str:
    """Flips that went unnoticed with a wrong result, or hung, of all flips of the module in both cores."""
    found = [
        kind[module]
        for core in results.get("now", {}).get("cores", {}).values()
        for kind in core["modules"].values()
        if module in kind
    ]
    flips = sum(row["trials"] for row in found)
    if not flips:
        return "-" if "now" in results else NOT_RUN
    return f"{sum(row.get(name, 0) for row in found for name in ('silent', 'hang'))} of {flips}"


def linked(module: str) -> str:
    """With its source behind it."""
    return f"[`{module}`](../{module_file(module).relative_to(RTL.parent).as_posix()})"


def rows() -> list[list[str]]:
    """Of every module of rtl/, by name."""
    formal, mutation, coverage, faults = map(load, ("formal", "mutate", "coverage", "faults"))
    return [
        [
            linked(module),
            tests(coverage, module),
            *proofs(formal, module),
            mutants(mutation, module),
            *covered(coverage, module),
            upsets(faults, module),
        ]
        for module in sorted(modules())
    ]


# -------------------------------------------------------------------------------------------- headline


def state(tool: str, results: Results) -> list[str]:
    """(date, modules changed since then)."""
    if not results:
        return ["-", "-"]
    late, every = outdated(tool, results), sources_of(tool, results)
    return [date(results), f"{len(late)} of {len(every)}" if late else "none"]


def headline() -> list[list[str]]:
    """What was tried, the figure, its date, what changed since, the command, where more is said."""
    formal, mutation, coverage = load("formal"), load("mutate"), load("coverage")
    found = []
    figure = NOT_RUN
    if coverage:
        figure = f"{sum(coverage['tests'].values())} cases, Icarus, Verilator and Python"
    found.append(["tests", figure, date(coverage), "-", "`make test`", "[tb](../tb/README.md)"])
    figure = NOT_RUN
    if formal:
        figure = (
            f"{formal['passed']} of {formal['proofs']}; {formal['caught']} of {formal['broken']} broken "
            f"copies caught; {formal['seen_failing']} of {formal['assertions']} assertions seen to fail"
        )
    found.append(["proofs", figure, *state("formal", formal), "`make formal`", "[below](#proofs)"])
    figure = NOT_RUN
    if mutation:
        pairs = [killed_of(row) for row in mutation["modules"]]
        killed, killable = sum(pair[0] for pair in pairs), sum(pair[1] for pair in pairs)
        figure = (
            f"{killed} of {killable} mutants killed, {percents(killed, killable)}, in {len(pairs)} modules"
        )
    more = "[mutate](../mutate/README.md)"
    found.append(["mutation", figure, *state("mutate", mutation), "`make mutate`", more])
    more = "[coverage](../coverage/README.md)"
    for kind in KINDS:
        figure = NOT_RUN
        if coverage:
            hit, waived, total = coverage["totals"][kind]
            figure = (
                f"{hit} of {total}, {percents(hit, total)}; "
                f"{percents(hit, total - waived)} without the {waived} waived"
            )
        found.append([f"{kind} coverage", figure, *state("coverage", coverage), "`make coverage`", more])
    figure = NOT_RUN
    if coverage:
        points = coverage["functional"].values()
        hit, bins = sum(point["hit"] for point in points), sum(point["bins"] for point in points)
        figure = f"{hit} of {bins} bins of {len(points)} points, {percents(hit, bins)}"
    found.append(["functional coverage", figure, date(coverage), "-", "`make coverage`", more])
    more = "[faults](../faults/README.md)"
    when = date(load("faults").get("now", {}))
    return found + [[*row, when, "not kept", "`make faults`", more] for row in upset_figures()]


def upset_figures() -> list[tuple[str, str]]:
    """Of each class of flip-flops, both cores together."""
    cores = load("faults").get("now", {}).get("cores", {}).values()
    if not cores:
        return [("upsets", NOT_RUN)]
    found = []
    for kind in ("control", "configuration", "data", "memory"):
        table_of = [core["classes"][kind] for core in cores]

        def total(name: str, of: list[Any] = table_of) -> int:
            return sum(row.get(name, 0) for row in of)

        told = (
            f"{total('trials')} flips in {total('bits')} bits: silent {total('silent')}, "
            f"hang {total('hang')}; next frame wrong {total('next wrong')}, hang {total('next hang')}"
        )
        found.append((f"upsets, {kind}", told))
    return found


# ---------------------------------------------------------------------------------------------- proofs


def proof_rows() -> list[list[str]]:
    """Of every proof: module, what it says, how, result, broken copies."""
    formal = load("formal")
    found = []
    for group in formal.get("groups", []):
        copies = f"{group['caught']} of {group['broken']}" if group["broken"] else "-"
        mark = CHANGED if is_stale(group["sources"]) else ""
        found.append(
            [f"`{group['module']}`", group["about"], group["engine"], f"{group['status']}{mark}", copies]
        )
    return found


# --------------------------------------------------------------------------------------------- missing


def listed(names: Iterable[str]) -> str:
    """In code."""
    return ", ".join(f"`{name}`" for name in sorted(names)) or "none"


def missing() -> list[str]:
    """What is known to be missing, from the results."""
    formal, mutation, coverage, faults = map(load, ("formal", "mutate", "coverage", "faults"))
    every = set(modules())
    found = []
    for tool, results in (("formal", formal), ("mutate", mutation), ("coverage", coverage)):
        if late := outdated(tool, results):
            found.append(f"`make {tool}` tried an earlier text of {listed(late)}.")
    if formal:
        proved = {group["module"] for group in formal["groups"]}
        found.append(f"Proofs: {len(every - proved)} of {len(every)} modules have none of their own.")
        found.append(f"Assertions that no broken copy made fail: {listed(formal['never_failed'])}.")
    if mutation:
        tried = {row["module"]: killed_of(row) for row in mutation["modules"]}
        low = [
            name for name, (killed, killable) in tried.items() if 100 * killed < mutation["goal"] * killable
        ]
        found.append(f"Mutation: below {mutation['goal']:g} %: {listed(low)}.")
        found.append(f"Mutation: not tried: {listed(every - tried.keys())}.")
        survivors = sum(killable - killed for killed, killable in tried.values())
        found.append(f"Mutants that survive and are neither proved nor argued equivalent: {survivors}.")
    if coverage:
        holes = {
            name
            for name, row in coverage["modules"].items()
            for kind in ("line", "branch")
            if sum(row[kind][:2]) < row[kind][2]
        }
        found.append(f"Lines or branches missed in {listed(holes)} ([report](../coverage/report.md)).")
        gaps = [
            f"{name}: {', '.join(point['holes'])}"
            for name, point in coverage["functional"].items()
            if point["holes"]
        ]
        found.append(f"Functional coverage, bins not hit: {'; '.join(gaps) or 'none'}.")
    for core in faults.get("now", {}).get("cores", {}).values():
        silent = sorted(core["silent data"].items(), key=lambda pair: -pair[1])
        if silent:
            found.append(f"Silent upsets of data, most of them in {listed(name for name, _ in silent[:5])}.")
    return found


def text() -> str:
    """The page."""
    head = [
        "module",
        "test cases",
        "proofs",
        "broken copies",
        "mutants killed",
        *KINDS,
        "silent or hung upsets",
    ]
    parts = [
        "<!-- Written by `make verification`; do not edit. -->",
        "# Verification",
        "How far each claim was tried: figures of the last run of each tool, which its command prints again. "
        "This page is made of their results and runs nothing itself.",
        table(["", "figure", "run", "modules changed since", "command", "more"], headline()),
        "* **Tests** compare RTL with bit-exact models; [tb](../tb/README.md).\n"
        "* **Proofs** hold for every input. A *broken copy* of the RTL has a fault put in on purpose: the "
        "proof must fail on it, by the assertion named beforehand.\n"
        "* **Mutants** are netlists with one changed cell or wire; tests kill those on which they fail. "
        "Mutants that cannot be noticed are left out.\n"
        "* **Coverage** by module is without points that [waivers.toml](../coverage/waivers.toml) says, "
        "with the reason, cannot be hit; holes are named in the [report](../coverage/report.md).\n"
        "* **Upsets** are flips of one flip-flop or memory bit in mid-frame: *silent* is a wrong result "
        "without a flag. Both cores together; [what protects them](decisions/upsets.md).",
        "## By module",
        "Cases are those of the module's own bench, or of those named, which try it inside their module. "
        f"-: nothing of the kind. {CHANGED}: the module, or one that the proof reads, has changed since.",
        table(head, rows()),
        "## Proofs",
        "Induction: in every clock of every history. Complete: a combinational module, every input. Bounded: "
        "a pipeline, every input for as many clocks as it has ([kinds](../formal/README.md)).",
        table(["module", "what is proved", "how", "result", "broken copies caught"], proof_rows()),
        "## Known to be missing",
        "\n".join(f"* {line}" for line in missing()),
    ]
    return "\n\n".join(parts) + "\n"


if __name__ == "__main__":
    PAGE.write_text(text(), encoding="utf-8")
    print(f"{PAGE.relative_to(ROOT)} written")
