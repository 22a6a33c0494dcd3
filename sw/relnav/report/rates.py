# SPDX-License-Identifier: Apache-2.0
"""The proximity manoeuvre's report: key table, page, summary."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from .. import __version__
from ..attitude import FloatArray
from ..ivisnav import golden
from ..ivisnav.comparison import (
    BOUND,
    CHANNELS,
    DRIVEN,
    RateSolutions,
    deviations,
    driven_and_idle,
    rates,
)
from ..ivisnav.quantise import equations
from ..ivisnav.result import RatesResult
from ..words import LARGEST_CONDITION
from .files import Drawings, draw_groups, write_files
from .key_table import Row, area_rows, cycle_row, in_seconds, plain_types, read_area
from .page import Cards, FrameTable, card, render, shortened, solver_name
from .rates_figures import (
    PUBLISHED,
    bounds_figure,
    camera_figure,
    condition_figure,
    driven_figure,
    geometry_figure,
    idle_figure,
    percent_figure,
)
from .timing import median_seconds

PAPER_CYCLES = 710  # 7.1 us at 100 MHz
TARGET_CYCLES = 355
PAPER_AREA = {"LUT": 35488, "LUTRAM": 1555, "FF": 14968, "BRAM": 12.5, "DSP": 120}  # Table I
FIGURES = 6  # calls of ``step`` without a camera; one more with


def write_rates_report(
    solved: RateSolutions, out: Path, *, area: Path, step: Callable[[], object] = lambda: None
) -> list[Row]:
    """Write report.html, summary.json and the PNGs into ``out``; returns the key table's rows.

    Args:
        area: syn/results.json; may be missing. step: called after each figure.
    """
    camera = solved.camera
    drawings: Drawings = [
        ("The sensor", [lambda: geometry_figure(solved)]),
        (
            "What the core made of it",
            [
                lambda: driven_figure(solved),
                lambda: idle_figure(solved),
                lambda: percent_figure(solved),
                lambda: condition_figure(solved),
                lambda: bounds_figure(solved),
            ],
        ),
    ]
    if camera is not None:
        drawings = [*drawings, ("With the OLTAE core", [lambda: camera_figure(solved, camera)])]
    groups = draw_groups(drawings, step)
    builds = read_area(area, "ivisnav_top")
    seconds = median_seconds(_normal_equations(solved), range(len(solved.run.samples)), 3)
    rows = key_rows(solved, builds, seconds)
    html = render(_head(solved), rows, groups, _frames(solved))
    summary = summarise(solved, builds, seconds) | {"key_table": [asdict(row) for row in rows]}
    write_files(out, groups, summary, html)
    return rows


def _normal_equations(solved: RateSolutions) -> Callable[[int], object]:
    """Eq. 9 of one frame in numpy, rows in memory to rates."""
    sensor = solved.run.sensor
    prepared = [equations(frame, sensor.f0, sensor.dt) for frame in solved.run.frames]
    return lambda k: np.linalg.solve(*golden.normal_matrix(prepared[k]))


def verdict(solved: RateSolutions) -> str:
    """The outcome in one line."""
    if solved.differences:
        return "RTL and bit-exact model differ"
    if solved.bound_broken:
        return "numerical bound broken"
    if solved.backend in ("fixed", "double"):
        return "numerical bound held in every frame"
    return "RTL equals the bit-exact model; numerical bound held in every frame"


def key_rows(solved: RateSolutions, area: dict[str, dict[str, float]], seconds: float) -> list[Row]:
    """The numbers that matter, beside the paper's."""
    count, rows = len(solved.core), []
    if solved.bit_exact:
        differing = len({text.partition(":")[0] for text in solved.differences})
        total = count + (len(solved.camera.core) if solved.camera else 0)
        name = "model against itself" if solved.backend == "fixed" else "RTL = bit-exact model"
        rows.append(Row(name, "-", f"{total - differing} of {total} frames, every bit", not differing))
    error = solved.numerical_error
    driven, idle = driven_and_idle(error).max(axis=0)
    text = f"{driven:.1e} (bound {BOUND:.0e})"
    rows.append(Row("v_z, omega_z, relative error to exact, max", "-", text, bool(driven <= BOUND)))
    text = f"{idle:.1e} (bound {BOUND:.0e})"
    rows.append(Row("idle channels, error over the driven, max", "-", text, bool(idle <= BOUND)))
    rows.append(
        Row("v_z, omega_z, deviation from double, max", f"{PUBLISHED} %", _worst(solved, rates(solved.core)))
    )
    rows.append(Row(f"  {solved.explicit.label}", "", _worst(solved, solved.explicit.x)))
    rows += [Row(f"  the paper's Q15.16, {run.label}", "", _worst(solved, run.x)) for run in solved.paper]
    rows.append(Row(f"rings to cond(H) {LARGEST_CONDITION:g}, any channel, max", "-", _sweep(solved)))
    rms = _rms(rates(solved.core) - solved.run.truth)
    rows.append(Row("v, rms error to truth, mm/s", "-", _triple(1e3 * rms[:3])))
    rows.append(Row("omega, rms error to truth, mrad/s", "-", _triple(1e3 * rms[3:])))
    rows.append(Row("components inside 3 sigma", "-", f"{solved.share_inside().mean():.1%}"))
    rows += _camera_rows(solved)
    if cycles := solved.cycles("rates"):
        rows.append(cycle_row("v, omega", str(PAPER_CYCLES), cycles, TARGET_CYCLES))
        rows.append(cycle_row("covariance, rss", "-", solved.cycles("all")))
    else:
        rows.append(Row("cycles after the last beat", str(PAPER_CYCLES), "RTL backends only"))
    rows += area_rows(area, PAPER_AREA)
    rows.append(Row("one frame on this CPU: numpy, normal equations", "-", in_seconds(seconds)))
    return rows


def _sweep(solved: RateSolutions) -> str:
    swept = solved.sweep
    within = swept.condition <= LARGEST_CONDITION
    model, explicit, paper = (
        f"{100.0 * errors[within].max():.1g} %" for errors in (swept.model, swept.explicit, swept.paper)
    )
    return f"{model} (explicit inverse {explicit}, Q15.16 {paper})"


def _camera_rows(solved: RateSolutions) -> list[Row]:
    camera = solved.camera
    if camera is None:
        return []
    rms = _rms(rates(camera.core) - solved.run.truth)
    change = _rms(rates(camera.core) - rates(solved.core))
    rows = [
        Row("with the camera's rho: v, rms error, mm/s", "-", _triple(1e3 * rms[:3])),
        Row("with the camera's rho: omega, rms error, mrad/s", "-", _triple(1e3 * rms[3:])),
        Row("  of which the rho's: v, rms, mm/s", "-", _triple(1e3 * change[:3])),
        Row("  of which the rho's: omega, rms, mrad/s", "-", _triple(1e3 * change[3:])),
        Row("the camera's rho, largest error, mm", "-", f"{1e3 * camera.error.max():.2g}"),
    ]
    if camera.cycles:
        rows.append(cycle_row("the camera's R and t (OLTAE core)", "-", camera.cycles))
    return rows


def summarise(solved: RateSolutions, area: dict[str, dict[str, float]], seconds: float) -> dict[str, Any]:
    """Everything the report says, as plain JSON types."""
    run, camera = solved.run, solved.camera
    core, sigma = rates(solved.core), deviations(solved.core)
    double, error = rates(solved.double), solved.numerical_error
    conditions = [result.condition for result in solved.double if result.condition is not None]
    summary: dict[str, Any] = plain_types(
        {
            "relnav": __version__,
            "seed": run.seed,
            "backend": solved.backend,
            "frames": len(run.samples),
            "beacons": run.beacons.name,
            "f0_hz": run.sensor.f0,
            "dt_s": run.sensor.dt,
            "sigma_dphi_rad": run.sensor.difference_sigma,
            "passed": solved.passed,
            "verdict": verdict(solved),
            "bit_exact": (not solved.differences) if solved.bit_exact else None,
            "differences": solved.differences,
            "bound_broken": solved.bound_broken,
            "channels": CHANNELS,
            "numerical_error_max": error.max(axis=0),
            "condition": {"least": min(conditions, default=None), "most": max(conditions, default=None)},
            "share_inside_3_sigma": solved.share_inside(),
            "rms_error": _rms(core - run.truth),
            "percent_error_max": {
                "channels": [CHANNELS[k] for k in DRIVEN],
                "core": solved.percent_errors(core).max(axis=0),
                "explicit_inverse": solved.percent_errors(solved.explicit.x).max(axis=0),
                "paper_q15_16": [
                    {
                        "scale": each.label,
                        "worst": solved.percent_errors(each.x).max(axis=0),
                        "median": np.median(solved.percent_errors(each.x), axis=0),
                        "overflows": each.overflows,
                    }
                    for each in solved.paper
                ],
                "paper_published": PUBLISHED,
            },
            "sweep": {
                "condition": solved.sweep.condition,
                "model": solved.sweep.model,
                "explicit_inverse": solved.sweep.explicit,
                "paper_q15_16": solved.sweep.paper,
            },
            "camera": None
            if camera is None
            else {
                "every": camera.camera.every,
                "noise_m": camera.camera.noise,
                "images": camera.images,
                "pose_flags": camera.pose_flags,
                "pose_cycles": camera.cycles,
                "rho_error_max_m": float(camera.error.max()),
                "rms_error": _rms(rates(camera.core) - run.truth),
                "rms_change": _rms(rates(camera.core) - core),
            },
            "cycles": {key: solved.cycles(key) for key in ("rates", "all")} if solved.cycles("all") else None,
            "paper_cycles": PAPER_CYCLES,
            "area": area or None,
            "paper_area": PAPER_AREA,
            "software_seconds_this_cpu": seconds,
            "per_frame": [
                {
                    **result.to_json(),
                    "time_s": sample.time,
                    "true": run.truth[k],
                    "double": double[k],
                    "exact": solved.exact[k],
                    "sigma": sigma[k],
                    "numerical_error": error[k],
                }
                for k, (result, sample) in enumerate(zip(solved.core, run.samples, strict=True))
            ],
        }
    )
    return summary


def _head(solved: RateSolutions) -> Cards:
    run, sensor, move = solved.run, solved.run.sensor, solved.run.manoeuvre
    return Cards(
        title="proximity manoeuvre",
        heading="Proximity manoeuvre: rates from laser phases",
        subtitle=(
            f"{len(run.samples)} intervals of {sensor.dt * 1e3:g} ms over {move.duration:g} s, six beams "
            f"modulated with {sensor.f0 / 1e6:g} MHz, solved by {solver_name(solved.backend)}"
        ),
        passed=solved.passed,
        verdict=verdict(solved),
        problems=shortened(
            [*solved.differences, *(f"frame {name}: beyond the bound" for name in solved.bound_broken)]
        ),
        cards=_cards(solved),
        method=(
            f"Each phase has noise of {sensor.noise:g} rad (1 sigma), each difference sqrt(2) times that, "
            "known to the core as VARIANCE. One radian in an interval is "
            f"{sensor.wavelength / (4.0 * np.pi * sensor.dt):.1f} m/s. Truth is taken in the middle of the "
            f"interval. Seed {run.seed}."
        ),
    )


def _cards(solved: RateSolutions) -> list[dict[str, Any]]:
    cards = []
    if solved.bit_exact and solved.backend != "fixed":
        differing, count = len({text.partition(":")[0] for text in solved.differences}), len(solved.core)
        total = count + (len(solved.camera.core) if solved.camera else 0)
        label = "frames in which the RTL equals the model to the bit"
        cards.append(card(f"{total - differing} / {total}", label, not differing))
    if cycles := solved.cycles("rates"):
        label = f"cycles from the last beat to v and omega (paper: {PAPER_CYCLES})"
        cards.append(card(str(max(cycles)), f"{label}; everything {max(solved.cycles('all'))}"))
    worst = float(solved.percent_errors(rates(solved.core)).max())
    label = f"largest deviation of v_z, omega_z from double (paper: {PUBLISHED} %)"
    cards.append(card(f"{worst:.0e} %", label))
    label = f"largest relative error against the exact solution (bound {BOUND:.0e})"
    cards.append(card(f"{solved.numerical_error.max():.0e}", label, not solved.bound_broken))
    cards.append(card(f"{solved.share_inside().mean():.1%}", "of the rates within 3 sigma of the truth"))
    if solved.camera is not None:
        label = "largest error of a projection taken from the OLTAE core's pose"
        cards.append(card(f"{1e3 * solved.camera.error.max():.2g} mm", label))
    return cards


COLUMNS = (
    ("frame", True),
    ("time, s", True),
    ("v_z, m/s", True),
    ("omega_z, rad/s", True),
    ("v error, mm/s", True),
    ("omega error, mrad/s", True),
    ("relative error to exact", True),
    ("cycles rates / all", False),
    ("flags", False),
)


def _frames(solved: RateSolutions) -> FrameTable:
    error = rates(solved.core) - solved.run.truth
    v_error, w_error = (1e3 * np.linalg.norm(part, axis=1) for part in (error[:, :3], error[:, 3:]))
    numerical = solved.numerical_error.max(axis=1)
    rows = [
        (
            str(result.frame),
            f"{sample.time:.2f}",
            "-" if result.v is None else f"{result.v[2]:.6f}",
            "-" if result.omega is None else f"{result.omega[2]:.6f}",
            f"{v_error[k]:.2g}",
            f"{w_error[k]:.2g}",
            f"{numerical[k]:.1e}",
            _cycles(result),
            ", ".join(result.flags) or "-",
        )
        for k, (result, sample) in enumerate(zip(solved.core, solved.run.samples, strict=True))
    ]
    return FrameTable(f"{len(rows)} frames", COLUMNS, rows)


def _cycles(result: RatesResult) -> str:
    return f"{result.cycles['rates']} / {result.cycles['all']}" if result.cycles else "-"


def _worst(solved: RateSolutions, x: FloatArray) -> str:
    percent = solved.percent_errors(x).max(axis=0)
    if not np.isfinite(percent).all():
        return "no rates in some frames"
    return ", ".join(f"{value:.2g} %" for value in percent)


def _rms(error: FloatArray) -> FloatArray:
    found: FloatArray = np.sqrt(np.mean(np.square(error), axis=0))
    return found


def _triple(values: FloatArray) -> str:
    return ", ".join(f"{value:.3g}" for value in values)
