# SPDX-License-Identifier: Apache-2.0
"""Poses and rates as tables for the terminal."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from .attitude import FloatArray, angle_of
from .ivisnav.result import RatesResult
from .result import PoseResult

HEADER = ("frame", "n", "turn", "angle/deg", "q", "t", "3 sigma of t", "rss", "cycles", "flags")
RIGHT = frozenset((1, 3, 7))


RATES_HEADER = (
    "frame",
    "n",
    "v, m/s",
    "omega, rad/s",
    "3 sigma of v, omega",
    "rss",
    "cond",
    "cycles",
    "flags",
)
RATES_RIGHT = frozenset((1, 5, 6))


def pose_table(results: Sequence[PoseResult]) -> str:
    """One line a frame; rounded, JSON is not. q's sign: a positive q3 turns by a negative angle about z."""
    return _table([HEADER, *(_row(result) for result in results)], RIGHT)


def rates_table(results: Sequence[RatesResult]) -> str:
    """One line a frame; rounded, JSON is not."""
    return _table([RATES_HEADER, *(_rates_row(result) for result in results)], RATES_RIGHT)


def _table(rows: Sequence[tuple[str, ...]], right: frozenset[int]) -> str:
    """Aligned columns under a header, its first row; right: numbers of the columns aligned to the right."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    lines = [
        "  ".join(row[i].rjust(w) if i in right else row[i].ljust(w) for i, w in enumerate(widths))
        for row in rows
    ]
    lines.insert(1, "  ".join("-" * width for width in widths))
    return "\n".join(line.rstrip() for line in lines)


def _row(result: PoseResult) -> tuple[str, ...]:
    cycles = result.cycles
    return (
        str(result.frame),
        str(result.n),
        result.turn or "-",
        "-" if result.R is None else f"{np.degrees(angle_of(result.R)):.4f}",
        _vector(result.q, "+.7f"),
        _vector(result.t, "+.7g"),
        _vector(_three_sigma(result.t_cov), ".2g"),
        "-" if result.rss is None else f"{result.rss:.4g}",
        "-" if cycles is None else f"{cycles['q']}/{cycles['pose']}/{cycles['all']}",
        " ".join(result.flags) or "ok",
    )


def _rates_row(result: RatesResult) -> tuple[str, ...]:
    sigma = _three_sigma(result.cov)
    cycles = result.cycles
    return (
        str(result.frame),
        str(result.n),
        _vector(result.v, "+.7g"),
        _vector(result.omega, "+.7g"),
        "-" if sigma is None or not np.all(np.isfinite(sigma)) else _vector(sigma, ".2g"),
        "-" if result.rss is None else f"{result.rss:.4g}",
        "-" if result.condition is None else f"{result.condition:.4g}",
        "-" if cycles is None else f"{cycles['rates']}/{cycles['all']}",
        " ".join(result.flags) or "ok",
    )


def _three_sigma(covariance: FloatArray | None) -> FloatArray | None:
    if covariance is None:
        return None
    sigma: FloatArray = 3.0 * np.sqrt(np.maximum(np.diag(covariance), 0.0))
    return sigma


def _vector(values: FloatArray | None, form: str) -> str:
    return "-" if values is None else " ".join(format(float(v), form) for v in values)
