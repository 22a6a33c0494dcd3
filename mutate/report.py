# SPDX-License-Identifier: Apache-2.0
"""results.json and results.md: a row a module, of the largest sample of its present text."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from mutate.benches import CORES, first_tests, modules
from mutate.campaign import PROVED, SEED, Result
from mutate.trial import relative
from sim.sources import fingerprint

HERE = Path(__file__).parent
RESULTS = HERE / "results.json"
TABLE = HERE / "results.md"
GOAL = 95.0

Row = dict[str, Any]


def row(one: Result) -> Row:
    """What results.json says of a module."""
    own = {f"test_{bench.name}.py" for bench in first_tests(one.module)}
    cores = {f"test_{Path(core).name}.py" for core in CORES} - own
    killers = Counter(fate.by for fate in one.fates if fate.state in ("killed", "timeout"))
    tried = [fate for fate in one.fates if fate.seconds]
    return {
        "module": one.module,
        "source": one.source,
        "mutants": len(one.fates),
        "killed": one.count("killed", "timeout"),
        "by_time": one.count("timeout"),
        "by_cores": sum(count for test, count in killers.items() if test.partition("::")[0] in cores),
        "equivalent": one.count("equivalent"),
        "proved": sum(fate.reason == PROVED for fate in one.fates),
        "invalid": one.count("invalid"),
        "survivors": one.count("survived"),
        "percent": round(one.percent, 2),
        "seconds_before": round(one.before, 1),
        "seconds_each": round(sum(fate.seconds for fate in tried) / max(1, len(tried)), 2),
        "tests": dict(killers.most_common()),
        "unfit": sorted(map(relative, one.unfit)),
        "open": [
            {"key": fate.key, "wire": fate.wire, "source": fate.source}
            for fate in one.fates
            if fate.state == "survived"
        ],
        "equivalents": [
            {"key": fate.key, "reason": fate.reason} for fate in one.fates if fate.state == "equivalent"
        ],
    }


def load() -> list[Row]:
    """The rows of results.json of the modules that there are; `current`: whether it is the present text's."""
    if not RESULTS.is_file():
        return []
    rows: list[Row] = json.loads(RESULTS.read_text())["modules"]
    there = set(modules())
    return [_dated(one) for one in rows if one["module"] in there]


def _dated(one: Row) -> Row:
    return {**one, "current": one["source"] == fingerprint(one["module"])}


def load_probes() -> dict[str, float]:
    """Folder of tests -> seconds of the processor that its probe takes, as far as known."""
    found = json.loads(RESULTS.read_text()) if RESULTS.is_file() else {}
    return dict(found.get("probes", {}))


def save(results: Sequence[Result]) -> None:
    """Put a run's rows in, except where the row there is of a larger sample of the same text."""
    probes = load_probes()
    for result in results:
        probes.update({bench: seconds for bench, seconds in result.probes.items() if seconds})
    rows = {one["module"]: one for one in load()}
    for result in results:
        new, old = _dated(row(result)), rows.get(result.module)
        if result.error or nothing(result) or (old and old["current"] and _larger(old, new)):
            continue
        if old and old["current"]:  # what found its builds there took less
            new["seconds_before"] = max(new["seconds_before"], old["seconds_before"])
        rows[result.module] = new
    found = [rows[name] for name in modules() if name in rows]
    TABLE.write_text(table(found, [name for name in modules() if name not in rows]))
    for one in found:
        one.pop("current", None)
    whole = {"seed": SEED, "goal": GOAL, "probes": dict(sorted(probes.items())), "modules": found}
    RESULTS.write_text(json.dumps(whole, indent=1) + "\n")


def _larger(old: Row, new: Row) -> bool:
    return bool(old["mutants"] > new["mutants"] and old["percent"] <= new["percent"])


def nothing(one: Result) -> bool:
    """Whether nothing came of it: no mutant at all, or none that compiles."""
    return len(one.fates) == one.count("invalid")


def late(one: Result) -> bool:
    """Whether the run's end came before the module's first mutant."""
    return not one.fates and one.left > 0


def below(one: Result) -> bool:
    """Whether a module fails `make mutate`."""
    return one.percent < GOAL or bool(one.error) or (nothing(one) and not late(one))


def _line(words: Sequence[object]) -> str:
    return f"| {' | '.join(map(str, words))} |"


def table(rows: Sequence[Row], untried: Sequence[str] = ()) -> str:
    """results.md. untried: modules without a row."""
    heads = ["module", "mutants", "killed", "by time", "by cores only", "equivalent", "invalid", "survivors"]
    counts = ["mutants", "killed", "by_time", "by_cores", "equivalent", "invalid", "survivors"]
    lines = [_line([*heads, "killed %"]), "|---" * 9 + "|"]
    for one in rows:
        stale = "" if one.get("current", True) else " (of an earlier text)"
        lines.append(_line([one["module"] + stale, *(one[key] for key in counts), f"{one['percent']:.1f}"]))
    whole = [sum(one[key] for one in rows) for key in counts]
    judged = whole[1] + whole[-1]
    lines.append(_line([f"{len(rows)} modules", *whole, f"{100 * whole[1] / judged:.1f}" if judged else ""]))
    parts = [
        "# Mutants and what became of them",
        "Made by `make mutate`; [README.md](README.md) says what the columns are.",
        "\n".join(lines),
    ]
    if untried:
        parts.append(f"Not tried yet: {', '.join(untried)}.")
    opened = [f"* {one['module']}: `{fate['key']}` {fate['wire']}" for one in rows for fate in one["open"]]
    if opened:
        parts += ["## Survivors", "\n".join(line.rstrip() for line in opened)]
    named = [
        f"* {one['module']}: `{fate['key']}`: {fate['reason']}"
        for one in rows
        for fate in one["equivalents"]
        if fate["reason"] != PROVED
    ]
    if named:
        proved = sum(one["proved"] for one in rows)
        parts += [f"## Equivalent ({proved} more are proved by SAT)", "\n".join(named)]
    unfit = [f"* {one['module']}: `{test}`" for one in rows for test in one.get("unfit", [])]
    if unfit:
        parts += ["## Tests that look inside, and cannot be run on the netlist", "\n".join(unfit)]
    return "\n\n".join(parts) + "\n"
