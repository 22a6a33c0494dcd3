# SPDX-License-Identifier: Apache-2.0
"""The landing's report: one self-contained HTML file, its figures as PNGs, its numbers as JSON."""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence
from dataclasses import asdict
from pathlib import Path

from ..comparison import Solutions
from .page import page, verdict
from .pose_figures import error_figure, estimate_figure, relative_error_figure
from .sensor_figures import cloud_figure, flight_figure, match_figure
from .style import Picture, house_style
from .summary import Row, key_rows, read_area, summarise
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
    draw: list[tuple[str, list[Callable[[], Picture]]]] = [
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
    groups: list[tuple[str, list[Picture]]] = []
    with house_style():
        for title, figures in draw:
            pictures: list[Picture] = []
            for make in figures:
                pictures.append(make())
                step()
            groups.append((title, pictures))
    builds = read_area(area)
    rows = key_rows(solved, timings, builds)
    html = page(solved, rows, groups)
    summary = summarise(solved, timings, builds)
    summary |= {"verdict": verdict(solved), "key_table": [asdict(row) for row in rows]}
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
    return rows


FIGURES = 9  # calls of ``step``
