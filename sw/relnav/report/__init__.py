# SPDX-License-Identifier: Apache-2.0
"""The landing's report: one self-contained HTML file, its figures as PNGs, its numbers as JSON."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import asdict
from pathlib import Path

from ..comparison import Solutions
from .files import Drawings, draw_groups, write_files
from .key_table import Row, read_area
from .page import page, verdict
from .pose_figures import error_figure, estimate_figure, relative_error_figure
from .sensor_figures import cloud_figure, flight_figure, match_figure
from .summary import key_rows, summarise
from .timing import Timing
from .waveform import waveform_figure


def write_report(
    solved: Solutions,
    timings: Sequence[Timing],
    out: Path,
    *,
    waves: Path,
    area: Path,
    step: Callable[[], object] = lambda: None,
) -> list[Row]:
    """Write report.html, summary.json and the PNGs into ``out``; returns the key table's rows.

    Args:
        waves: FST of the simulation. area: syn/results.json. Either may be missing.
        step: called after each figure.
    """
    flight, middle = solved.flight, len(solved.flight.pairs) // 2
    draw: Drawings = [
        (
            "What the sensors saw",
            [
                lambda: flight_figure(flight),
                lambda: match_figure(flight, middle),
                lambda: cloud_figure(flight, middle),
            ],
        ),
        (
            "What the core made of it",
            [
                lambda: waveform_figure(waves),
                lambda: estimate_figure(solved, "q"),
                lambda: estimate_figure(solved, "t"),
                lambda: error_figure(solved, "q"),
                lambda: error_figure(solved, "t"),
                lambda: relative_error_figure(solved),
            ],
        ),
    ]
    groups = draw_groups(draw, step)
    builds = read_area(area)
    rows = key_rows(solved, timings, builds)
    html = page(solved, rows, groups)
    summary = summarise(solved, timings, builds)
    summary |= {"verdict": verdict(solved), "key_table": [asdict(row) for row in rows]}
    write_files(out, groups, summary, html)
    return rows


FIGURES = 9  # calls of ``step``
