# SPDX-License-Identifier: Apache-2.0
"""Poses as a table for the terminal."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .attitude import FloatArray, angle_of
from .result import PoseResult

HEADER = ("frame", "n", "turn", "angle/deg", "q", "t", "3 sigma of t", "rss", "cycles", "flags")
RIGHT = frozenset((1, 3, 7))


def pose_table(results: Sequence[PoseResult]) -> str:
    """One line a frame; rounded, JSON is not. q's sign: a positive q3 turns by a negative angle about z."""
    rows = [HEADER, *(_row(result) for result in results)]
    widths = [max(len(row[i]) for row in rows) for i in range(len(HEADER))]
    lines = [
        "  ".join(row[i].rjust(w) if i in RIGHT else row[i].ljust(w) for i, w in enumerate(widths))
        for row in rows
    ]
    lines.insert(1, "  ".join("-" * width for width in widths))
    return "\n".join(line.rstrip() for line in lines)


def _row(result: PoseResult) -> tuple[str, ...]:
    sigma = None if result.t_cov is None else 3.0 * np.sqrt(np.maximum(np.diag(result.t_cov), 0.0))
    cycles = result.cycles
    return (
        str(result.frame),
        str(result.n),
        result.turn or "-",
        "-" if result.R is None else f"{np.degrees(angle_of(result.R)):.4f}",
        _vector(result.q, "+.7f"),
        _vector(result.t, "+.7g"),
        _vector(sigma, ".2g"),
        "-" if result.rss is None else f"{result.rss:.4g}",
        "-" if cycles is None else f"{cycles['q']}/{cycles['pose']}/{cycles['all']}",
        " ".join(result.flags) or "ok",
    )


def _vector(values: FloatArray | None, form: str) -> str:
    return "-" if values is None else " ".join(format(float(v), form) for v in values)
