# SPDX-License-Identifier: Apache-2.0
"""waivers.toml: points that cannot be hit, each with its reason."""

from __future__ import annotations

import re
import tomllib
from dataclasses import dataclass
from fnmatch import fnmatch
from pathlib import Path

from coverage.counters import KINDS, Module, Point
from sim.sources import RTL

FILE = Path(__file__).parent / "waivers.toml"
_KEYS = {"file", "kind", "text", "side", "signals", "reason"}


class WaiverError(ValueError):
    """waivers.toml says something that it may not; the message says where."""


@dataclass(frozen=True)
class Waiver:
    """One entry."""

    file: str
    """Below rtl/; for toggles a pattern such as */*.v too."""
    kind: str
    reason: str
    text: str = ""
    """The whole source line without the space around it: after an edit the waiver no longer counts."""
    side: str = ""
    """Of a branch (if, else, cond_then, cond_else, elsif); none: all of the line."""
    signals: str = ""
    """Regular expression of whole names of bits, as the report prints them."""

    def fits(self, place: str, lines: list[str], kind: str, point: Point) -> bool:
        """Whether a point of the file `place` (below rtl/) is meant."""
        if kind != self.kind or not fnmatch(place, self.file):
            return False
        if self.text and lines[point.line - 1].strip() != self.text:
            return False
        if self.signals:
            return re.fullmatch(self.signals, point.name) is not None
        return not self.side or point.name == self.side


def load(file: Path = FILE) -> list[Waiver]:
    """Every waiver; raises WaiverError for one that would waive more than it says."""
    found = []
    for number, entry in enumerate(tomllib.loads(file.read_text(encoding="utf-8")).get("waiver", []), 1):
        where = f"{file.name}, waiver {number} ({entry.get('file', 'no file')})"
        if unknown := entry.keys() - _KEYS:
            raise WaiverError(f"{where}: unknown key {', '.join(sorted(unknown))}")
        if entry.get("kind") not in KINDS:
            raise WaiverError(f"{where}: kind is not one of {', '.join(KINDS)}")
        if not entry.get("file") or not entry.get("reason"):
            raise WaiverError(f"{where}: file or reason is missing")
        if entry["kind"] != "toggle" and (not entry.get("text") or not (RTL / entry["file"]).is_file()):
            raise WaiverError(f"{where}: a {entry['kind']} needs a file of rtl/ and the text of its line")
        if entry["kind"] == "toggle" and not entry.get("signals"):
            raise WaiverError(f"{where}: a toggle needs signals")
        found.append(Waiver(**entry))
    return found


@dataclass
class Tally:
    """The points of one kind of a module."""

    hit: int
    waived: dict[Point, Waiver]
    holes: list[Point]

    @property
    def total(self) -> int:
        """All points."""
        return self.hit + len(self.waived) + len(self.holes)


def judge(module: Module, waivers: list[Waiver], used: set[Waiver]) -> dict[str, Tally]:
    """Hit, waived or a hole: every point of a module, by kind. Waivers that were needed go to `used`."""
    place = module.file.relative_to(RTL).as_posix()
    lines = module.file.read_text(encoding="utf-8").splitlines()
    tallies = {}
    for kind, points in module.points.items():
        waived: dict[Point, Waiver] = {}
        holes: list[Point] = []
        for point in sorted(point for point, hit in points.items() if not hit):
            waiver = next((one for one in waivers if one.fits(place, lines, kind, point)), None)
            if waiver:
                waived[point] = waiver
                used.add(waiver)
            else:
                holes.append(point)
        tallies[kind] = Tally(len(points) - len(waived) - len(holes), waived, holes)
    return tallies
