# SPDX-License-Identifier: Apache-2.0
"""results.json and the tables made of it."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from faults.campaign import Found, by_register, describe
from faults.classes import CLASSES
from scripts.marked import table

RESULTS = Path(__file__).parent / "results.json"
README = Path(__file__).parent / "README.md"
MOST = 200
"""Offenders of a core that results.json lists."""

COLUMNS = {
    "flip-flops": "bits",
    "flips": "trials",
    "masked": "masked",
    "cycles only": "diagnostic",
    "flagged": "flagged",
    "silent": "silent",
    "hang": "hang",
    "next right": "next right",
    "next flagged": "next flagged",
    "next wrong": "next wrong",
    "next hang": "next hang",
    "recovered": "recovered",
    "hard reset": "only a hard reset",
    "stray": "stray answer",
}


def load() -> dict[str, Any]:
    """results.json; empty where there is none."""
    found: dict[str, Any] = json.loads(RESULTS.read_text()) if RESULTS.is_file() else {}
    return found


def save(founds: list[Found], label: str, about: Mapping[str, Any], file: Path = RESULTS) -> None:
    """Put a run's counts under `label`; offenders are listed of the run called `now` only."""
    results = json.loads(file.read_text()) if file.is_file() else {}
    part = results.setdefault(label, {})
    part.update(about)
    for found in founds:
        part.setdefault("cores", {})[found.top] = found.table()
        if label == "now":
            part["cores"][found.top]["offenders"] = [
                describe(found.top, pair) for pair in found.offenders[:MOST]
            ]
    _write(results, file)


def save_costs(rows: list[dict[str, Any]], file: Path = RESULTS) -> None:
    """Put what the protections cost into results.json."""
    results = json.loads(file.read_text()) if file.is_file() else {}
    _write({**results, "costs": rows}, file)


def _write(results: Mapping[str, Any], file: Path) -> None:
    order = ("now", "before", "costs")
    file.write_text(json.dumps({name: results[name] for name in order if name in results}, indent=1) + "\n")


def class_table(cores: Mapping[str, Any]) -> str:
    """Markdown: a row a core and class."""
    rows = [
        [
            top.removesuffix("_top"),
            kind,
            *(str(core["classes"][kind].get(key, 0)) for key in COLUMNS.values()),
        ]
        for top, core in cores.items()
        for kind in CLASSES
    ]
    return table(["core", "class", *COLUMNS], rows)


def module_table(core: Mapping[str, Any], kind: str) -> str:
    """Markdown: a row a module."""
    rows = [
        [f"`{name}`", *(str(row.get(key, 0)) for key in COLUMNS.values())]
        for name, row in core["modules"][kind].items()
        if row["trials"]
    ]
    return table(["module", *COLUMNS], rows)


def comparison(results: Mapping[str, Any]) -> str:
    """Markdown: shares before and now, and what the protections cost."""
    lines = []
    for label, title in (("before", "Without protection"), ("now", "As the RTL is")):
        if label in results:
            part = results[label]
            lines += [
                f"{title} ({part['flips']} flips a control flip-flop, seed {part['seed']}, {part['date']}):",
                "",
            ]
            lines += [class_table(part["cores"]), ""]
    costs = results.get("costs")
    if costs:
        rows = [
            [
                cost["core"].removesuffix("_top"),
                f"{cost['protection']}",
                *(str(cost[k]) for k in ("LUT", "FF", "DSP", "BRAM")),
            ]
            for cost in costs
        ]
        lines += [
            "What a protection costs (xc7, Yosys):",
            "",
            table(["core", "protection", "LUT", "FF", "DSP", "BRAM36"], rows),
        ]
    return "\n".join(lines).rstrip()


def docs_part() -> str:
    """Markdown for docs/verification.md, from results.json; a line that says so where there is none."""
    results = load()
    return comparison(results) if results else "No campaign has been run: `make faults`."


def text(founds: list[Found]) -> str:
    """For the terminal: counts by class, then the offending registers by module."""
    cores = {found.top: found.table() for found in founds}
    lines = [class_table(cores), ""]
    for found in founds:
        for kind, some in found.silent.items():
            most = ", ".join(f"{name} {count}" for name, count in some.most_common(12))
            lines += [f"{found.top}, silent wrong results from {kind}: {most or 'none'}", ""]
        if found.offenders:
            lines.append(f"{found.top}, registers with what may not be (bits: clocks hit):")
        for kind, key, words, pairs in by_register(found):
            bits = Counter(pair[0].trial.bit.name for pair in pairs)
            lines.append(f"  {kind:<13} {key:<44} {len(bits)} bits, {len(pairs)} flips: {'; '.join(words)}")
        lines.append("")
    return "\n".join(lines).rstrip()
