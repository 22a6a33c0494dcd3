# SPDX-License-Identifier: Apache-2.0
"""The results as JSON, as Markdown with every hole, and as a page with the sources."""

from __future__ import annotations

import html
import re
from collections.abc import Iterable, Mapping, Sequence
from itertools import groupby
from pathlib import Path
from typing import Any

from coverage.counters import KINDS, Module, Point
from coverage.functional import CoverPoint
from coverage.waivers import Tally
from scripts.marked import table
from sim.sources import fingerprint

Tallies = Mapping[str, Mapping[str, Tally]]
"""module -> kind -> its points."""
_BIT = re.compile(r"(.*)\[(\d+)\]")


def percent(hit: int, total: int) -> str:
    """100.0; "-" where there is nothing to hit. Never rounded up to 100."""
    if not total:
        return "-"
    return f"{min(99.9, round(100 * hit / total, 1)) if hit < total else 100.0:.1f}"


def totals(tallies: Tallies, kind: str) -> tuple[int, int, int]:
    """(hit, waived, all) of every module."""
    of_kind = [tally[kind] for tally in tallies.values()]
    return sum(t.hit for t in of_kind), sum(len(t.waived) for t in of_kind), sum(t.total for t in of_kind)


def results(
    tallies: Tallies, functional: Sequence[CoverPoint], about: Mapping[str, Any], tests: Mapping[str, int]
) -> dict[str, Any]:
    """What results.json says. Of each kind: hit, waived, all."""
    return {
        **about,
        "totals": {kind: totals(tallies, kind) for kind in KINDS},
        "functional": {
            point.name: {"hit": point.hit, "bins": len(point.bins), "holes": point.holes}
            for point in functional
        },
        "tests": dict(sorted(tests.items())),
        "modules": {
            name: {
                "source": fingerprint(name),
                **{kind: [tally[kind].hit, len(tally[kind].waived), tally[kind].total] for kind in KINDS},
            }
            for name, tally in sorted(tallies.items())
        },
    }


# ------------------------------------------------------------------------------------------- Markdown


def row(name: str, counts: Iterable[Sequence[int]]) -> list[str]:
    """A row of the table: of each kind, as counted, and with the waived points left out."""
    cells = [name]
    for hit, waived, total in counts:
        cells += [f"{hit} of {total}" if total else "-", percent(hit, total), percent(hit, total - waived)]
    return cells


HEAD = ["module", *(text for kind in KINDS for text in (kind, "%", "% less waived"))]


def bits(points: Sequence[Point]) -> str:
    """Bits of signals in few words: a[3:0], a[7], b."""
    found: dict[str, list[int]] = {}
    for point in points:
        match = _BIT.fullmatch(point.name)
        found.setdefault(match[1] if match else point.name, []).extend([int(match[2])] if match else [])
    words = []
    for name, numbers in found.items():
        if not numbers:
            words.append(f"`{name}`")
        for _, run in groupby(enumerate(sorted(numbers)), key=lambda pair: pair[1] - pair[0]):
            span = [number for _, number in run]
            words.append(f"`{name}[{span[-1]}:{span[0]}]`" if len(span) > 1 else f"`{name}[{span[0]}]`")
    return ", ".join(words)


def holes(module: Module, tally: Mapping[str, Tally]) -> list[str]:
    """Every hole of a module, one a line."""
    text = module.file.read_text(encoding="utf-8").splitlines()
    lines = []
    for kind in ("line", "branch"):
        for point in tally[kind].holes:
            side = f" {point.name}" if point.name else ""
            lines.append(f"* {kind} {point.line}{side}: `{text[point.line - 1].strip()}`")
    if tally["toggle"].holes:
        lines.append(f"* toggle: {bits(tally['toggle'].holes)}")
    return lines


def markdown(
    modules: Mapping[str, Module],
    tallies: Tallies,
    functional: Sequence[CoverPoint],
    about: Mapping[str, Any],
    problems: Sequence[str],
) -> str:
    """The whole report."""
    whole = [totals(tallies, kind) for kind in KINDS]
    parts = [
        "<!-- Written by `make coverage`; do not edit. -->",
        "# Coverage",
        f"{about['runs']} runs on {about['tool']}. What counts as line, branch, toggle: [README](README.md). "
        "A point counts as waived where [waivers.toml](waivers.toml) says why it cannot be hit.",
        table(HEAD, [row("**all**", whole), *_rows(tallies)]),
    ]
    if problems:
        parts += ["## Problems", "\n".join(f"* {problem}" for problem in problems)]
    parts.append("## Holes")
    for name, tally in sorted(tallies.items()):
        if found := holes(modules[name], tally):
            parts += [f"### {name}", "\n".join(found)]
    parts.append("## Functional coverage")
    rows = [[point.name, f"{point.hit} of {len(point.bins)}", "; ".join(point.holes)] for point in functional]
    parts.append(table(["point", "bins hit", "holes"], rows))
    parts.append("## Waived")
    for name, tally in sorted(tallies.items()):
        if found := _waived(modules[name], tally):
            parts += [f"### {name}", "\n".join(found)]
    return "\n\n".join(parts) + "\n"


def _rows(tallies: Tallies) -> list[list[str]]:
    return [
        row(name, [(tally[kind].hit, len(tally[kind].waived), tally[kind].total) for kind in KINDS])
        for name, tally in sorted(tallies.items())
    ]


def _waived(module: Module, tally: Mapping[str, Tally]) -> list[str]:
    text = module.file.read_text(encoding="utf-8").splitlines()
    lines = []
    for kind in ("line", "branch"):
        for point, waiver in tally[kind].waived.items():
            side = f" {point.name}" if point.name else ""
            lines.append(f"* {kind} {point.line}{side}: `{text[point.line - 1].strip()}`: {waiver.reason}")
    by_reason: dict[str, list[Point]] = {}
    for point, waiver in tally["toggle"].waived.items():
        by_reason.setdefault(waiver.reason, []).append(point)
    lines += [f"* toggle: {bits(points)}: {reason}" for reason, points in by_reason.items()]
    return lines


# ----------------------------------------------------------------------------------------------- HTML

_STYLE = """body{font:14px sans-serif;margin:2em} pre{line-height:1.3} .note{color:#a00}
.hit{background:#e4f4e0} .hole{background:#ffd6d0} .waived{background:#fff3c4} summary{cursor:pointer}
td,th{padding:0 .8em;text-align:right} td:first-child{text-align:left}"""


def page(modules: Mapping[str, Module], tallies: Tallies) -> str:
    """All sources: lines that ran, that did not, that are waived; a hole's kind and name beside it."""
    rows = [
        [row("all", [totals(tallies, kind) for kind in KINDS])],
        [*_rows(tallies)],
    ]
    cells = "".join(
        "<tr>" + "".join(f"<td>{html.escape(cell)}</td>" for cell in one) + "</tr>"
        for group in rows
        for one in group
    )
    head = "".join(f"<th>{text}</th>" for text in HEAD)
    parts = [
        f"<!DOCTYPE html><html lang=en><meta charset=utf-8><title>Coverage</title><style>{_STYLE}</style>",
        f"<h1>Coverage</h1><table><tr>{head}</tr>{cells}</table>",
    ]
    for name, tally in sorted(tallies.items()):
        module = modules[name]
        shown = []
        for number, text in enumerate(module.file.read_text(encoding="utf-8").splitlines(), 1):
            shown.append(_source_line(number, text, module, tally))
        source = "\n".join(shown)
        parts.append(f"<details><summary>{name}</summary><pre>{source}</pre></details>")
    return "\n".join(parts) + "\n"


def _source_line(number: int, text: str, module: Module, tally: Mapping[str, Tally]) -> str:
    points = {kind: [p for p in module.points[kind] if p.line == number] for kind in KINDS}
    missing = {kind: [p for p in tally[kind].holes if p.line == number] for kind in KINDS}
    waived = any(p.line == number for kind in KINDS for p in tally[kind].waived)
    notes = [point.name for point in missing["branch"]]
    if missing["toggle"]:
        notes.append(f"toggle {bits(missing['toggle'])}".replace("`", ""))
    kind = "hole" if any(missing.values()) else "waived" if waived else "hit" if any(points.values()) else ""
    note = f"  <span class=note>{html.escape('; '.join(notes))}</span>" if notes else ""
    return f'<span class="{kind}">{number:5}  {html.escape(text)}</span>{note}'


def write(file: Path, text: str) -> None:
    """Write a file, its folder too."""
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text, encoding="utf-8")
