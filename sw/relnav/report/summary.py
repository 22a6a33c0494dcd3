# SPDX-License-Identifier: Apache-2.0
"""The numbers of a landing: one JSON object, and the key table for terminal and page."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from .. import __version__
from ..comparison import Solutions, relative_percent, stacked
from .key_table import Row, area_rows, cycle_row, in_seconds, plain_types
from .pose_figures import STATES
from .timing import Timing

PAPER_CYCLES = 170
PAPER_AREA = {"LUT": 5545, "LUTRAM": 153, "FF": 7597, "DSP": 137}
PAPER_SECONDS_CPU = 2.1e-3  # Intel i7-7800X, 3.5 GHz, MATLAB


def summarise(
    solved: Solutions, timings: Sequence[Timing], area: dict[str, dict[str, float]]
) -> dict[str, Any]:
    """Everything the report says, as plain JSON types."""
    flight = solved.flight
    q_error, q_sigma = solved.errors("q")
    t_error, t_sigma = solved.errors("t")
    cycles = [result.cycles for result in solved.core if result.cycles]
    counts = [len(pair.frame.a) for pair in flight.pairs]
    summary: dict[str, Any] = plain_types(
        {
            "relnav": __version__,
            "terrain": flight.terrain.name,
            "images": flight.images,
            "seed": flight.seed,
            "backend": solved.backend,
            "frames": len(flight.exposures),
            "poses": len(flight.pairs),
            "matches": {"fewest": min(counts), "median": float(np.median(counts)), "most": max(counts)},
            "sigma_unit_weight_m": flight.sigma,
            "passed": passed(solved),
            "bit_exact": (not solved.differences) if solved.bit_exact else None,
            "differences": solved.differences,
            "bound_broken": solved.bound_broken,
            "numerical_error_max": float(np.max(solved.numerical_error)),
            "kappa_max": float(np.max(solved.kappa)),
            "share_inside_3_sigma": {"q": solved.share_inside("q"), "t": solved.share_inside("t")},
            "rms_error": {"q": _rms(q_error), "t_m": _rms(t_error)},
            "relative_error_percent_max": {
                "states": [f"{field}{'123'[i] if field == 'q' else 'xyz'[i]}" for field, i, _ in STATES],
                "core": _worst(solved, None),
                "paper_q15_16": [
                    {"scale": run.label, "alpha": run.alpha, "worst": _worst(solved, k)}
                    for k, run in enumerate(solved.paper)
                ],
                "paper_published": 7.0,
            },
            "cycles": {key: [c[key] for c in cycles] for key in ("q", "pose", "all")} if cycles else None,
            "paper_cycles": PAPER_CYCLES,
            "area": area or None,
            "paper_area": PAPER_AREA,
            "software_seconds_this_cpu": {timing.name: timing.seconds for timing in timings},
            "per_frame": [
                {
                    **result.to_json(),
                    "q_true": pair.q,
                    "t_true": pair.t,
                    "q_double": double.q,
                    "t_double": double.t,
                    "q_sigma": q_sigma[k],
                    "t_sigma": t_sigma[k],
                    "matches": pair.matches,
                    "gated": len(pair.rejected),
                    "kappa": solved.kappa[k],
                    "numerical_error": solved.numerical_error[k],
                }
                for k, (result, pair, double) in enumerate(
                    zip(solved.core, flight.pairs, solved.double, strict=True)
                )
            ],
        }
    )
    return summary


def passed(solved: Solutions) -> bool:
    """RTL and model agree and the numerical bound holds; 3-sigma exceedances are no failure."""
    return not solved.differences and not solved.bound_broken


def key_rows(solved: Solutions, timings: Sequence[Timing], area: dict[str, dict[str, float]]) -> list[Row]:
    """The numbers that matter, beside the paper's."""
    count = len(solved.flight.pairs)
    rows: list[Row] = []
    if solved.bit_exact:
        differing = len({text.partition(":")[0] for text in solved.differences})
        same = f"{count - differing} of {count} poses, every bit"
        name = "model against itself" if solved.backend == "fixed" else "RTL = bit-exact model"
        rows.append(Row(name, "-", same, not differing))
    worst = float(np.max(solved.numerical_error))
    text = f"{worst:.1e} (bound {np.max(solved.numerical_bound):.0e})"
    rows.append(Row("q, relative error to exact, max", "-", text, not solved.bound_broken))
    core = _worst(solved, None)
    rows.append(Row("q3, tx, tz, deviation from double, max", "7 %", f"{max(core):.1e} %"))
    for k, run in enumerate(solved.paper):
        rows.append(Row(f"  the paper's Q15.16, {run.label}", "", f"{_percent(max(_worst(solved, k)))}"))
    for field, unit, factor in (("q", "1e-6", 1e6), ("t", "m", 1.0)):
        error, _ = solved.errors(field)
        rms = ", ".join(f"{value * factor:.3g}" for value in _rms(error))
        rows.append(Row(f"{field}, rms error to truth, {unit}", "-", rms))
    inside = np.concatenate([solved.share_inside("q"), solved.share_inside("t")])
    rows.append(Row("components inside 3 sigma", "all", f"{inside.mean():.1%}"))
    rows += _cycle_rows(solved)
    rows += area_rows(area, PAPER_AREA)
    for k, timing in enumerate(timings):
        paper = f"{PAPER_SECONDS_CPU * 1e3:.1f} ms (MATLAB, i7, q)" if k == 0 else ""
        rows.append(Row(f"one pose on this CPU: {timing.name}", paper, in_seconds(timing.seconds)))
    return rows


def _cycle_rows(solved: Solutions) -> list[Row]:
    cycles = [result.cycles for result in solved.core if result.cycles]
    if not cycles:
        return [Row("cycles after the last beat", str(PAPER_CYCLES), "RTL backends only")]
    rows = []
    for key, name, target in (("q", "q", 100), ("pose", "R and t", 130), ("all", "covariance, rss", None)):
        paper = f"{PAPER_CYCLES} (centred by software)" if key == "q" else "-"
        rows.append(cycle_row(name, paper, [c[key] for c in cycles], target))
    return rows


def _worst(solved: Solutions, paper: int | None) -> list[float]:
    """Largest deviation from double, percent, of the states with motion; inf where a frame gave nothing."""
    worst: list[float] = []
    for field, i, _ in STATES:
        if paper is None:
            values = stacked(solved.core, field)
        else:
            values = solved.paper[paper].q if field == "q" else solved.paper[paper].t
        percent = relative_percent(values, stacked(solved.double, field))[:, i]
        worst.append(float(np.max(np.where(np.isfinite(percent), percent, np.inf))))
    return worst


def _rms(error: Any) -> Any:
    return np.sqrt(np.mean(np.square(error), axis=0))


def _percent(value: float) -> str:
    return f"{value:.2g} %" if np.isfinite(value) else "det M = 0"
