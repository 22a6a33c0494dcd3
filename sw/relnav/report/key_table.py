# SPDX-License-Identifier: Apache-2.0
"""The key table of a run, for terminal and page, and what goes into it; the same for every core."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

CLOCK_HZ = 100e6  # both papers'


@dataclass(frozen=True)
class Row:
    """One line of the key table. good: None where there is nothing to pass."""

    name: str
    paper: str
    here: str
    good: bool | None = None


def read_area(path: Path, top: str = "oltae_top") -> dict[str, dict[str, float]]:
    """Totals of the top's builds in syn/results.json as {build: {LUT, FF, DSP, ...}}; empty without them."""
    try:
        builds = json.loads(path.read_text(encoding="utf-8"))[top]["area"]["builds"]
        return {name: dict(build["total"]) for name, build in builds.items()}
    except (OSError, ValueError, LookupError, TypeError, AttributeError):
        return {}


def cycle_row(
    name: str, paper: str, values: Sequence[int], target: int | None = None, *, clock: float = CLOCK_HZ
) -> Row:
    """Counted cycles. A missed target is told, but a slow core is not a wrong one: the run still passes."""
    span = f"{min(values)}" if min(values) == max(values) else f"{min(values)} to {max(values)}"
    text = f"{span} ({max(values) / clock * 1e6:.2f} us at {clock / 1e6:.0f} MHz)"
    met = target is not None and max(values) <= target
    if target is not None and not met:
        text += f", target {target} missed"
    return Row(f"cycles to {name}", paper, text, met or None)


def area_rows(area: Mapping[str, Mapping[str, float]], published: Mapping[str, float]) -> list[Row]:
    """Resources of each build beside the published ones, whose keys are shown."""
    paper = " / ".join(f"{count:g}" for count in published.values())
    name = " / ".join(published)
    if not area:
        return [Row(f"{name}, xc7z020", paper, "not synthesised yet: make synth")]
    counts = {
        build: " / ".join(f"{total.get(key, 0):g}" for key in published) for build, total in area.items()
    }
    return [Row(f"{name}, {build} build", paper, text) for build, text in counts.items()]


def in_seconds(value: float) -> str:
    """A short time in words."""
    return f"{value * 1e6:.0f} us" if value < 1e-3 else f"{value * 1e3:.1f} ms"


def key_table(title: str, rows: Sequence[Row]) -> str:
    """The key table for a terminal."""
    cells = [("", "paper", "here"), *((row.name, row.paper, row.here) for row in rows)]
    width = [max(len(cell[i]) for cell in cells) for i in range(3)]
    marks = [""] + [{True: "ok", False: "FAIL", None: ""}[row.good] for row in rows]
    lines = [
        f"  {cell[0]:<{width[0]}}  {cell[1]:<{width[1]}}  {cell[2]:<{width[2]}}  {mark}".rstrip()
        for cell, mark in zip(cells, marks, strict=True)
    ]
    rule = "  " + "-" * (sum(width) + 8)
    return "\n".join([title, lines[0], rule, *lines[1:]])


def plain_types(value: Any) -> Any:
    """The value of plain JSON types: it has neither arrays nor infinities."""
    if isinstance(value, dict):
        return {key: plain_types(child) for key, child in value.items()}
    if isinstance(value, np.ndarray | list | tuple):
        return [plain_types(child) for child in (value.tolist() if isinstance(value, np.ndarray) else value)]
    if isinstance(value, np.generic):
        value = value.item()
    if isinstance(value, float) and not np.isfinite(value):
        return None
    return value
