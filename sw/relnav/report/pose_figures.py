# SPDX-License-Identifier: Apache-2.0
"""Figures of the poses: estimates, errors with their bounds, relative errors."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.ticker import MaxNLocator

from ..attitude import FloatArray
from ..comparison import Solutions, relative_percent, stacked
from .style import BAND, CORE, DOUBLE, GRID, MUTED, PAPER, TRUTH, Picture, figure, png

STATES = (("q", 2, "$q_3$"), ("t", 0, "$t_x$"), ("t", 2, "$t_z$"))  # where motion is induced
FLOOR = 1e-9  # percent; what is exactly equal is drawn here


def estimate_figure(solved: Solutions, field: str) -> Picture:
    """q or t of the core, double and truth, one panel a component."""
    truth = solved.true_q if field == "q" else solved.true_t
    unit = 1e3 if field == "q" else 1.0
    truth = unit * truth
    core, double = (unit * stacked(results, field) for results in (solved.core, solved.double))
    frames = _frames(solved)
    drawn = figure(10.0, 3.3)
    panels: Sequence[Any] = drawn.subplots(1, 3)
    for i, axes in enumerate(panels):
        axes.plot(frames, truth[:, i], color=TRUTH, linewidth=1.0, linestyle="--", label="truth", zorder=4)
        axes.plot(frames, double[:, i], "o", color=DOUBLE, markersize=7, mfc="none", label="double")
        axes.plot(frames, core[:, i], ".", color=CORE, markersize=6, label=core_label(solved.backend))
        axes.set_title(_component(field, i))
        _frame_axis(axes, frames)
        _steady(axes, truth[:, i], np.concatenate([core[:, i], double[:, i]]))
    panels[0].set_ylabel("Gibbs vector q, 1e-3" if field == "q" else "t, m")
    shared_legend(drawn, panels[0])
    if field == "q":
        number, name, title = "8", "fig08_attitude", "Attitude estimates"
        text = (
            "The Gibbs vector (CRP) of each frame against the one before. "
            "A positive q3 turns vectors by a negative angle about z."
        )
    else:
        number, name, title = "9", "fig09_translation", "Translation estimates"
        text = "The translation of each frame against the one before, in the later body frame."
    return Picture(name, title, text, number, png(drawn))


def error_figure(solved: Solutions, field: str) -> Picture:
    """Errors of the core against truth inside their 3-sigma bounds."""
    error, sigma = solved.errors(field)
    inside = solved.share_inside(field)
    frames = _frames(solved)
    factor, unit = _error_unit(field, sigma)
    drawn = figure(10.0, 3.3)
    panels: Sequence[Any] = drawn.subplots(1, 3)
    for i, axes in enumerate(panels):
        bound = 3.0 * sigma[:, i] * factor
        axes.fill_between(frames, -bound, bound, color=BAND, linewidth=0, label=r"$\pm 3\sigma$ of the core")
        axes.axhline(0.0, color=MUTED, linewidth=0.8)
        axes.plot(frames, error[:, i] * factor, color=CORE, marker="o", markersize=3.5, label="error")
        axes.set_title(_component(field, i))
        axes.set_title(f"{inside[i]:.0%} inside", loc="right", fontsize=9, fontweight="normal", color=MUTED)
        _frame_axis(axes, frames)
        if np.isfinite(bound).any():
            reach = 1.25 * max(np.nanmax(bound), np.nanmax(np.abs(error[:, i] * factor)))
            axes.set_ylim(-reach, reach)
    panels[0].set_ylabel(f"error of {field}, {unit}")
    shared_legend(drawn, panels[0])
    overall = float(np.mean(inside))
    text = (
        f"Core minus truth with the bounds the core itself computed. {overall:.1%} of the components lie "
        f"inside (99.7 % expected of Gaussian noise; an exceedance is no failure)."
    )
    if field == "q":
        return Picture("fig10_attitude_error", "Attitude errors", text, "10", png(drawn))
    return Picture("fig11_translation_error", "Translation errors", text, "11", png(drawn))


def relative_error_figure(solved: Solutions) -> Picture:
    """Percent of deviation from double on the states with motion: our arithmetic and the paper's."""
    frames = _frames(solved)
    drawn = figure(10.0, 3.6)
    panels: Sequence[Any] = drawn.subplots(1, 3, sharey=True)
    for axes, (field, i, name) in zip(panels, STATES, strict=True):
        reference = stacked(solved.double, field)[:, i]
        for run, style in zip(solved.paper, ("-", ":"), strict=False):
            values = (run.q if field == "q" else run.t)[:, i]
            axes.semilogy(
                frames, np.maximum(relative_percent(values, reference), FLOOR),
                style, color=PAPER, marker="s", markersize=3, label=f"Q15.16, {run.label}",
            )  # fmt: skip
        own = np.maximum(relative_percent(stacked(solved.core, field)[:, i], reference), FLOOR)
        axes.semilogy(frames, own, color=CORE, marker="o", markersize=3.5, label=core_label(solved.backend))
        axes.axhline(7.0, color=MUTED, linewidth=1.0, linestyle="--", label="published by the paper: 7 %")
        axes.set_title(name)
        _frame_axis(axes, frames)
        axes.grid(True, which="major", color=GRID)
    panels[0].set_ylabel("deviation from double, %")
    shared_legend(drawn, panels[0])
    text = (
        "Deviation of each frame from double precision in the states with motion: this core, and the paper's "
        "Q15.16 pipeline fed with the same points at one scale alpha for the whole flight. The paper "
        "publishes at most 7 % for a scale that it calls arbitrary."
    )
    return Picture("fig12_relative_error", "Relative error of the arithmetic", text, "12", png(drawn))


def _frames(solved: Solutions) -> FloatArray:
    return np.array([pair.frame.name for pair in solved.flight.pairs], dtype=np.float64)


def core_label(backend: str) -> str:
    """The backend in a legend."""
    return {"fixed": "bit-exact model", "double": "double"}.get(backend, f"RTL ({backend})")


def _component(field: str, i: int) -> str:
    return f"$q_{i + 1}$" if field == "q" else f"$t_{'xyz'[i]}$"


def _error_unit(field: str, sigma: FloatArray) -> tuple[float, str]:
    if field == "q":
        return 1e6, "1e-6"
    return (1e-3, "km") if np.nanmedian(sigma) > 300.0 else (1.0, "m")


def _frame_axis(axes: Any, frames: FloatArray) -> None:
    axes.set_xlabel("frame")
    axes.xaxis.set_major_locator(MaxNLocator(nbins=6, integer=True))
    axes.set_xlim(frames[0] - 0.6, frames[-1] + 0.6)


def _steady(axes: Any, truth: FloatArray, values: FloatArray) -> None:
    """Room around the truth, so that a constant does not fill the panel with its own noise."""
    spread = max(float(np.nanmax(np.abs(values - np.tile(truth, 2)))), 1e-12)
    centre = float(np.nanmean(truth))
    half = max(3.0 * spread, 1.2 * float(np.nanmax(np.abs(truth - centre))))
    axes.set_ylim(centre - half, centre + half)


def shared_legend(drawn: Any, axes: Any, columns: int | None = None) -> None:
    """One legend under all panels, from one of them."""
    handles, labels = axes.get_legend_handles_labels()
    drawn.legend(handles, labels, loc="outside lower center", ncols=columns or len(labels))
