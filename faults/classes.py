# SPDX-License-Identifier: Apache-2.0
"""Control, configuration or data: what classes.toml says of a flip-flop."""

from __future__ import annotations

import tomllib
from collections.abc import Iterable
from dataclasses import dataclass
from fnmatch import fnmatchcase
from pathlib import Path

from faults.flipflops import Bit

TABLE = Path(__file__).parent / "classes.toml"
CONTROL, CONFIGURATION, DATA, MEMORY = CLASSES = ("control", "configuration", "data", "memory")


@dataclass(frozen=True)
class Pattern:
    """A line of the table."""

    kind: str
    module: str
    register: str
    reason: str

    def matches(self, bit: Bit) -> bool:
        """Whether it speaks of this bit."""
        return fnmatchcase(bit.module, self.module) and fnmatchcase(bit.register, self.register)


def patterns(file: Path = TABLE) -> list[Pattern]:
    """The table. Raises SystemExit for an entry without a reason or of an unknown kind."""
    found = []
    for kind, entries in tomllib.loads(file.read_text(encoding="utf-8")).items():
        if kind not in (CONFIGURATION, DATA):
            raise SystemExit(f"faults: {file.name}: {kind} is no class that can be declared")
        for entry in entries:
            if not str(entry.get("reason", "")).strip():
                raise SystemExit(f"faults: {file.name}: {entry.get('module')} has no reason")
            found += [Pattern(kind, entry["module"], name, entry["reason"]) for name in entry["registers"]]
    return found


def classify(bits: Iterable[Bit], table: list[Pattern] | None = None) -> dict[str, list[Bit]]:
    """Class -> its bits. Raises ValueError where two entries of the table disagree on a register."""
    lines = patterns() if table is None else table
    known: dict[str, str] = {}
    found: dict[str, list[Bit]] = {name: [] for name in CLASSES}
    for bit in bits:
        if bit.memory:
            found[MEMORY].append(bit)
            continue
        if bit.key not in known:
            kinds = {line.kind for line in lines if line.matches(bit)}
            if len(kinds) > 1:
                raise ValueError(f"classes.toml calls {bit.key} {' and '.join(sorted(kinds))}")
            known[bit.key] = kinds.pop() if kinds else CONTROL
        found[known[bit.key]].append(bit)
    return found
