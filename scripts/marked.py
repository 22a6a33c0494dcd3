# SPDX-License-Identifier: Apache-2.0
"""Blocks of a Markdown file that a script fills, between `<!-- NAME:begin -->` and `<!-- NAME:end -->`."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from pathlib import Path


def fill(file: Path, name: str, text: str) -> bool:
    """Replace a block's text; returns whether the file changed. SystemExit where there is no such block."""
    pattern = re.compile(rf"(<!-- {name}:begin -->\n).*?(<!-- {name}:end -->)", re.DOTALL)
    old = file.read_text(encoding="utf-8")
    if not pattern.search(old):
        raise SystemExit(f"{file.name} has no <!-- {name}:begin --> ... <!-- {name}:end -->")
    new = pattern.sub(lambda match: match.group(1) + text.rstrip("\n") + "\n" + match.group(2), old)
    if new != old:
        file.write_text(new, encoding="utf-8")
    return new != old


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A Markdown table."""
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join([*lines, *("| " + " | ".join(row) + " |" for row in rows)])
