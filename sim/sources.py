# SPDX-License-Identifier: Apache-2.0
"""Which Verilog files a module needs. One module a file, the file named after it."""

from __future__ import annotations

import hashlib
import os
import re
from collections.abc import Mapping, Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
RTL = ROOT / "rtl"

_COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)


def sources(*folders: str, rtl_dir: Path | None = None) -> list[Path]:
    """Every Verilog file of the named folders of rtl/ (all of them when none is named), in a stable order."""
    rtl = rtl_dir or RTL
    found = [rtl / name for name in folders] if folders else sorted(d for d in rtl.iterdir() if d.is_dir())
    return [file for folder in found for file in sorted(folder.glob("*.v"))]


def module_file(module: str) -> Path:
    """The module's file in rtl/; raises ValueError where there is none."""
    (file,) = RTL.glob(f"*/{module}.v")
    return file


def fingerprint(module: str) -> str:
    """Of a module's text without comments and blanks, to tell results of an earlier text."""
    text = _COMMENT.sub("", module_file(module).read_text())
    lines = [" ".join(line.split()) for line in text.splitlines()]
    return hashlib.sha256("\n".join(lines).encode()).hexdigest()[:12]


def reachable(top: str, files: Sequence[Path], defines: Mapping[str, object] | None = None) -> list[Path]:
    """Those of `files` that module `top` is made of, in the same order; all where no file has its name.

    Any mention of a module's name outside comments counts, which errs on the side of a file too many; one
    through a macro of `defines` too. RELNAV_REPLACE="module=file" puts another file in a module's place.
    """
    replaced = dict(pair.split("=") for pair in os.environ.get("RELNAV_REPLACE", "").split())
    files = [Path(replaced.get(file.stem, file)) for file in files]
    by_name = {file.stem: file for file in files}
    if top not in by_name:
        return list(files)
    found, open_names = {top}, [top]
    while open_names:
        text = _COMMENT.sub("", by_name[open_names.pop()].read_text())
        for macro, value in (defines or {}).items():
            text = re.sub(rf"`{macro}\b", str(value).replace("\\", r"\\"), text)
        mentioned = (set(re.findall(r"\b[A-Za-z_]\w*\b", text)) & by_name.keys()) - found
        found |= mentioned
        open_names += sorted(mentioned)
    return [file for file in files if file.stem in found]
