# SPDX-License-Identifier: Apache-2.0
"""The functional coverage of all runs as one: cocotb-coverage's XML files merged, and read."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

from cocotb_coverage.coverage import merge_coverage


@dataclass
class CoverPoint:
    """A cover point or cross: its bins, in order, and those that nothing hit."""

    name: str
    bins: list[str] = field(default_factory=list)
    holes: list[str] = field(default_factory=list)

    @property
    def hit(self) -> int:
        """Number of bins that were hit."""
        return len(self.bins) - len(self.holes)


def read(files: Sequence[Path], merged: Path) -> list[CoverPoint]:
    """Merge the files into `merged`; every point of all cores, by name."""
    if not files:
        return []
    merge_coverage(lambda _: None, str(merged), *map(str, sorted(files)))
    found = []
    for parent in ElementTree.parse(merged).getroot().iter():
        bins = [one for one in parent if "bin" in one.attrib]
        if bins:
            names = [_readable(one.attrib["bin"]) for one in bins]
            holes = [name for name, one in zip(names, bins, strict=True) if one.attrib["hits"] == "0"]
            found.append(CoverPoint(parent.attrib["abs_name"].removeprefix("top."), names, holes))
    return sorted(found, key=lambda point: point.name)


def _readable(name: str) -> str:
    """('IDLE', 'push') -> IDLE x push."""
    if not name.startswith("("):
        return name
    return " x ".join(part.strip().strip("'") for part in name[1:-1].split(","))
