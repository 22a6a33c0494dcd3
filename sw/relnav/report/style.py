# SPDX-License-Identifier: Apache-2.0
"""One look for every figure."""

from __future__ import annotations

import io
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import matplotlib as mpl
from matplotlib.figure import Figure as MplFigure

INK = "#1d2733"
MUTED = "#6b7785"
GRID = "#e3e7ec"
CORE = "#d9480f"  # what the hardware (or the backend) gave
DOUBLE = "#1971c2"
TRUTH = "#1d2733"
PAPER = "#862e9c"
GOOD = "#2b8a3e"
BAD = "#c92a2a"
BAND = "#fde3d3"  # 3-sigma, a tint of CORE
AXES = ("x", "y", "z")

_SETTINGS: dict[Any, Any] = {  # matplotlib wants its keys as literals
    "font.family": "DejaVu Sans",
    "font.size": 9.5,
    "axes.titlesize": 10.5,
    "axes.titleweight": "bold",
    "axes.titlelocation": "left",
    "axes.labelsize": 9.5,
    "axes.edgecolor": "#aab4bf",
    "axes.labelcolor": INK,
    "axes.titlecolor": INK,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.axisbelow": True,
    "grid.color": GRID,
    "grid.linewidth": 0.8,
    "xtick.color": MUTED,
    "ytick.color": MUTED,
    "text.color": INK,
    "legend.frameon": False,
    "legend.fontsize": 9,
    "lines.linewidth": 1.4,
    "figure.dpi": 100,
    "savefig.dpi": 140,
    "figure.facecolor": "white",
    "axes.formatter.useoffset": False,
}


@dataclass(frozen=True)
class Picture:
    """A drawn figure.

    Args:
        name: file name without .png. title, caption: for the page.
        paper: number of the paper's figure, or "".
        png: the file's bytes; None when it could not be drawn, and then the caption says why.
    """

    name: str
    title: str
    caption: str
    paper: str
    png: bytes | None


@contextmanager
def house_style() -> Iterator[None]:
    """Everything drawn inside has the report's look."""
    with mpl.rc_context(_SETTINGS):
        yield


def figure(width: float, height: float) -> MplFigure:
    """A figure of ``width`` x ``height`` inches that needs no screen and no pyplot."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    drawn = MplFigure(figsize=(width, height), layout="constrained")
    FigureCanvasAgg(drawn)
    return drawn


def png(drawn: MplFigure) -> bytes:
    """The figure as a PNG without dates in it, so that equal runs give equal files."""
    buffer = io.BytesIO()
    drawn.savefig(buffer, format="png", metadata={"Software": None})
    return buffer.getvalue()
