# SPDX-License-Identifier: Apache-2.0
"""What Verilator counted, merged over all runs: the points of every module of rtl/ and which were hit.

A coverage.dat (Verilator 5.48) has a line ``C 'KEYS' COUNT`` a point. KEYS are ``\\x01key\\x02value`` pairs:
f file, l line, n column, t type, o what, S the lines of the statements behind it.

====== ===================================================================== ==============================
kind   a point                                                               hit when
====== ===================================================================== ==============================
line   a source line with statements (no declarations, no `assign`)          all statements on it have run
branch a side of an if, of a case item's if, of a ?: with variable condition it was taken
toggle a bit of a signal of at most 1024 bits; of a memory: of any word      it rose and it fell
====== ===================================================================== ==============================

Points of all instances and of all parameter sets of a module are one where file, line, column and name agree.
What stands between ``synthesis translate_off`` and ``translate_on`` is for the waves and does not count.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass, field
from pathlib import Path

from sim.sources import RTL

KINDS = ("line", "branch", "toggle")
_INDEX = re.compile(r"\[(\d+)\]$")


@dataclass(frozen=True, order=True)
class Point:
    """Something to be covered. column: 0 for a line. name: side of a branch, bit of a signal."""

    line: int
    column: int
    name: str = ""


@dataclass
class Module:
    """The points of a file of rtl/, by kind; True where hit."""

    file: Path
    points: dict[str, dict[Point, bool]] = field(default_factory=lambda: {kind: {} for kind in KINDS})
    unsynthesised: frozenset[int] = frozenset()
    """Lines that do not count."""
    _blocks: dict[tuple[int, int, str], tuple[frozenset[int], int]] = field(default_factory=dict)
    _edges: dict[tuple[int, str], list[int]] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """Of the module."""
        return self.file.stem

    def count(self, keys: dict[str, str], hits: int) -> None:
        """A line of a coverage.dat."""
        line, column, what = int(keys["l"]), int(keys["n"]), keys["o"]
        if line in self.unsynthesised:
            return
        if keys["t"] == "toggle":
            signal, _, edge = what.rpartition(":")
            bit = self._edges.setdefault((line, word_free(signal)), [0, 0])
            bit[edge == "1->0"] += hits
            return
        if keys["t"] == "branch":
            point = Point(line, column, what)
            self.points["branch"][point] = self.points["branch"].get(point, False) or hits > 0
            if what.startswith("cond"):
                return  # a side of a ?: is no statement
        before = self._blocks.get((line, column, what), (frozenset(), 0))
        self._blocks[line, column, what] = (before[0] | spans(keys.get("S", "")), before[1] + hits)

    def close(self) -> None:
        """After the last file: lines and bits from what was counted."""
        lines: dict[int, bool] = {}
        for span, hits in self._blocks.values():
            for number in span:
                lines[number] = lines.get(number, True) and hits > 0
        self.points["line"] = {Point(number, 0): hit for number, hit in sorted(lines.items())}
        self.points["toggle"] = {
            Point(line, 0, signal): all(edges) for (line, signal), edges in sorted(self._edges.items())
        }


def word_free(signal: str) -> str:
    """The bit of a memory without the word's number: a[3][5] -> a[][5]."""
    bit = _INDEX.search(signal)
    if not bit or not _INDEX.search(signal[: bit.start()]):
        return signal
    return _INDEX.sub("[]", signal[: bit.start()]) + bit.group()


def spans(text: str) -> frozenset[int]:
    """Line numbers of "54-55,70"."""
    found: set[int] = set()
    for part in filter(None, text.split(",")):
        first, _, last = part.partition("-")
        found.update(range(int(first), int(last or first) + 1))
    return frozenset(found)


def simulation_only(text: str) -> frozenset[int]:
    """Numbers of the lines that synthesis leaves out."""
    found, out = set(), False
    for number, line in enumerate(text.splitlines(), 1):
        out |= "synthesis translate_off" in line
        if out:
            found.add(number)
        out &= "synthesis translate_on" not in line
    return frozenset(found)


def read(files: Iterable[Path], rtl: Path = RTL) -> dict[str, Module]:
    """Merge coverage.dat files: module -> its points, of the files below `rtl` only.

    What a run counted of a file that has been written since is left out: its lines are others now.
    """
    modules: dict[str, Module] = {}
    inside = f"{rtl.resolve()}/"
    written = {file.relative_to(rtl).as_posix(): file.stat().st_mtime for file in rtl.glob("**/*.v")}
    for file in files:
        ran = file.stat().st_mtime
        with file.open(encoding="utf-8") as text:
            for row in text:
                if not row.startswith("C '"):
                    continue
                packed, _, hits = row[3:].rpartition("' ")
                keys = dict(pair.split("\x02", 1) for pair in packed.split("\x01")[1:])
                if not keys["f"].startswith(inside) or keys["t"] not in KINDS:
                    continue
                place = keys["f"].removeprefix(inside)
                if written.get(place, ran) >= ran:
                    continue
                if place not in modules:
                    text_of = (rtl / place).read_text(encoding="utf-8")
                    modules[place] = Module(rtl / place, unsynthesised=simulation_only(text_of))
                modules[place].count(keys, int(hits))
    for module in modules.values():
        module.close()
    return {module.name: module for _, module in sorted(modules.items())}
