# SPDX-License-Identifier: Apache-2.0
"""Drawing a report's figures and writing its files, for any core."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

from tqdm import tqdm

from ..errors import InputError
from .style import Picture, house_style

Drawings = Sequence[tuple[str, Sequence[Callable[[], Picture]]]]
Drawn = list[tuple[str, list[Picture]]]


def draw_groups(drawings: Drawings, step: Callable[[], object]) -> Drawn:
    """The pictures of each titled group; step is called after each."""
    groups: Drawn = []
    with house_style():
        for title, figures in drawings:
            pictures: list[Picture] = []
            for make in figures:
                pictures.append(make())
                step()
            groups.append((title, pictures))
    return groups


def write_files(out: Path, groups: Drawn, summary: dict[str, Any], html: str) -> None:
    """report.html, summary.json and the PNGs; a picture that could not be drawn leaves none."""
    numbers = json.dumps(summary, indent=1, allow_nan=False)
    # everything is made before anything is written
    out.mkdir(parents=True, exist_ok=True)
    for _, pictures in groups:
        for picture in pictures:
            target = out / f"{picture.name}.png"
            if picture.png is None:
                target.unlink(missing_ok=True)  # of an earlier run
            else:
                target.write_bytes(picture.png)
    (out / "summary.json").write_text(numbers + "\n", encoding="utf-8")
    (out / "report.html").write_text(html, encoding="utf-8")


def refuse_file(out: Path) -> None:
    """Raises InputError where the report's folder is a file."""
    if out.exists() and not out.is_dir():
        raise InputError(f"{out}: is a file; the report needs a folder")


def make_folder(out: Path) -> None:
    """The report's folder. Raises InputError where it cannot be made."""
    try:
        out.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"{out}: no folder for the report: {error.strerror}") from None


def progress(total: int, quiet: bool) -> tqdm[None]:
    """A bar on standard error for the given number of steps."""
    return tqdm(
        total=total,
        disable=quiet,
        file=sys.stderr,
        bar_format="{desc:<28} {percentage:3.0f}% |{bar:30}| {elapsed}",
        mininterval=0.1 if sys.stderr.isatty() else 5.0,  # a log is not a screen
    )
