# SPDX-License-Identifier: Apache-2.0
"""Figures of the proximity manoeuvre: geometry, rates, errors."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..attitude import FloatArray
from ..ivisnav.comparison import BOUND, DRIVEN, CameraRun, RateSolutions, deviations, rates
from ..words import LARGEST_CONDITION
from .pose_figures import core_label, shared_legend
from .style import AXES, BAND, CORE, DOUBLE, GOOD, GRID, INK, MUTED, PAPER, TRUTH, Picture, figure, png

SYMBOLS = ("$v_x$", "$v_y$", "$v_z$", r"$\omega_x$", r"$\omega_y$", r"$\omega_z$")
UNITS = ("m/s", "rad/s")
FLOOR = 1e-9  # percent; what is exactly equal is drawn here
VIEW = 0.25  # rad about z, of the side view
PUBLISHED = 0.8  # percent, the paper's Fig. 7


def geometry_figure(solved: RateSolutions) -> Picture:
    """Beacons, beams and projections, along the axis and from the side, at the start of the manoeuvre."""
    run = solved.run
    beacons, first, last = run.beacons, run.samples[0].distance, run.samples[-1].distance
    starts, ends = beacons.origins, beacons.displacements(first) + [0.0, 0.0, first]
    drawn = figure(10.0, 4.2)
    front, side = drawn.subplots(1, 2, width_ratios=(1.0, 1.35))
    angles = np.linspace(0.0, 2.0 * np.pi, 200)
    radius = float(np.linalg.norm(starts[0]))
    front.plot(radius * np.cos(angles), radius * np.sin(angles), color=MUTED, linewidth=0.8, linestyle=":")
    side.plot([first, first], [-1.1, 1.1], color=INK, linewidth=2.5)
    side.plot([last, last], [-1.1, 1.1], color=INK, linewidth=1.2, linestyle="--")
    side.annotate(
        "", xy=(last, 0.95), xytext=(first, 0.95), arrowprops={"arrowstyle": "->", "color": INK}
    )  # fmt: skip
    side.text(0.5 * (first + last), 1.0, "the manoeuvre", ha="center", va="bottom", color=INK, fontsize=9)
    across = np.array([-np.sin(VIEW), np.cos(VIEW), 0.0])  # from an angle at which no two beams coincide
    for k, (start, end) in enumerate(zip(starts, ends, strict=True)):
        colour = CORE if k % 2 == 0 else DOUBLE
        hand = "counter-clockwise" if k % 2 == 0 else "clockwise"
        label = {"label": f"beam skewed {hand}"} if k < 2 else {}
        front.annotate(
            "", xy=end[:2], xytext=start[:2], arrowprops={"arrowstyle": "-|>", "color": colour, "lw": 1.4}
        )  # fmt: skip
        front.plot(*start[:2], "o", color=colour, markersize=6)
        side.plot([start[2], end[2]], [start @ across, end @ across], color=colour, linewidth=1.2, **label)
        side.plot(end[2], end @ across, "x", color=colour, markersize=6)
        side.plot(start[2], start @ across, "o", color=colour, markersize=5)
        front.text(*(1.18 * start[:2]), str(k + 1), ha="center", va="center", color=MUTED)
    reach = 1.25 * float(np.abs(np.vstack((starts, ends))[:, :2]).max())
    front.set(xlim=(-reach, reach), ylim=(-reach, reach), aspect="equal", xlabel="x, m", ylabel="y, m")
    front.set_title("Beacons (dots) and projections (arrow heads)")
    side.set(xlim=(-0.1, 1.08 * first), ylim=(-1.2, 1.2), xlabel="z, m (sensor to plate)", ylabel="across, m")
    side.set_title(f"From the side: plate at {first:.2f} m, at the end at {last:.2f} m")
    shared_legend(drawn, side)
    conditions = [result.condition for result in solved.double if result.condition]
    text = (
        f"Six beacons on a ring of {radius:g} m, skewed alternately: beams skewed one way only would see v_z "
        f"and omega_z in one fixed ratio, and straight ones no omega_z. cond(H) is {min(conditions):.1f} to "
        f"{max(conditions):.1f} on the way."
    )
    return Picture("geometry", "Beams and plate", text, "", png(drawn))


def driven_figure(solved: RateSolutions) -> Picture:
    """v_z and omega_z: truth, double, core."""
    drawn = figure(10.0, 3.6)
    panels: Sequence[Any] = drawn.subplots(1, 2)
    for axes, channel in zip(panels, DRIVEN, strict=True):
        _rate_lines(axes, solved, channel, 1.0)
        axes.set_title(SYMBOLS[channel])
        axes.set_ylabel(f"{SYMBOLS[channel]}, {UNITS[channel // 3]}")
    shared_legend(drawn, panels[0])
    text = (
        "The axial rates, where motion is induced. The plate comes nearer (negative v_z) and turns "
        "counter-clockwise about the axis; neither rate passes through zero, so that errors can be relative."
    )
    return Picture("fig05_driven", "Rates with motion", text, "5", png(drawn))


def idle_figure(solved: RateSolutions) -> Picture:
    """v_x, v_y, omega_x, omega_y, which the manoeuvre leaves at zero."""
    drawn = figure(10.0, 5.4)
    grid: Any = drawn.subplots(2, 2, sharex=True, sharey="row")
    for axes, channel in zip(grid.ravel(), (0, 1, 3, 4), strict=True):
        _rate_lines(axes, solved, channel, 1e3)
        axes.set_title(SYMBOLS[channel])
    for row, unit in zip(grid, ("velocity, mm/s", "angular velocity, mrad/s"), strict=True):
        row[0].set_ylabel(unit)
        row[0].set_xlabel(""), row[1].set_xlabel("")
    for axes in grid[1]:
        axes.set_xlabel("time, s")
    shared_legend(drawn, grid[0, 0])
    error = solved.numerical_error[:, [0, 1, 3, 4]].max()
    text = (
        "The channels without motion show the noise of the phases, the same in double and in the core: the "
        f"core's own contribution is at most {error:.0e} of the driven channel. In the paper the "
        "quantisation dominates here."
    )
    return Picture("fig06_idle", "Rates without motion", text, "6", png(drawn))


def percent_figure(solved: RateSolutions) -> Picture:
    """Eq. 12 of the driven channels: the core, the paper's order of operations, the paper's arithmetic."""
    times = solved.run.times
    drawn = figure(10.0, 4.2)
    panels: Sequence[Any] = drawn.subplots(1, 2, sharey=True)
    styles = ((PAPER, "s", "-"), (MUTED, "d", "-"))
    for i, axes in enumerate(panels):
        for run, (colour, marker, line) in zip(solved.paper, styles, strict=True):
            axes.semilogy(
                times, np.maximum(solved.percent_errors(run.x)[:, i], FLOOR), line, color=colour,
                marker=marker, markersize=2.5, linewidth=0.9, label=f"the paper's Q15.16, {run.label}",
            )  # fmt: skip
        axes.axhline(PUBLISHED, color=INK, linewidth=1.0, linestyle="--", label="published: below 0.8 %")
        for x, colour, marker, label in (
            (solved.explicit.x, GOOD, "^", "explicit inverse on exact sums"),
            (rates(solved.core), CORE, "o", core_label(solved.backend)),
        ):
            axes.semilogy(
                times, np.maximum(solved.percent_errors(x)[:, i], FLOOR), color=colour,
                marker=marker, markersize=2.5, linewidth=0.9, label=label,
            )  # fmt: skip
        axes.set_title(SYMBOLS[DRIVEN[i]])
        axes.set_xlabel("time, s")
        axes.grid(True, which="major", color=GRID)
    panels[0].set_ylabel("deviation from double (Eq. 12), %")
    shared_legend(drawn, panels[0], columns=3)
    text = (
        "Deviation from double precision on the same rows. The paper's pipeline (Q15.16 products, an "
        "explicit single-precision inverse, Q15.16 again) lives by the scale of the phases; the same inverse "
        "on exact sums shows what the order of operations alone costs; this core factorises, solves and "
        "refines twice with exact residuals."
    )
    return Picture("fig07_percent", "Percentage errors", text, "7", png(drawn))


def condition_figure(solved: RateSolutions) -> Picture:
    """Errors against exact over the condition of the geometry, for the three orders of operations."""
    swept = solved.sweep
    drawn = figure(10.0, 4.2)
    panels: Sequence[Any] = drawn.subplots(1, 2, sharey=True)
    for i, axes in enumerate(panels):
        for errors, colour, marker, label in (
            (swept.paper, PAPER, "s", "the paper's Q15.16, phases scaled by 1024"),
            (swept.explicit, GOOD, "^", "explicit inverse on exact sums"),
            (swept.model, CORE, "o", "this core (bit-exact model)"),
        ):
            axes.loglog(
                swept.condition, np.maximum(100.0 * errors[:, i], FLOOR), color=colour, linestyle="none",
                marker=marker, markersize=4, label=label,
            )  # fmt: skip
        axes.axhline(100.0 * BOUND, color=INK, linewidth=1.0, linestyle="--", label="bound of this core")
        axes.axvline(LARGEST_CONDITION, color=MUTED, linewidth=1.2, linestyle=":")
        axes.text(
            1.07 * LARGEST_CONDITION, 0.02, "refused", rotation=90, ha="left", va="bottom",
            color=MUTED, fontsize=8.5, transform=axes.get_xaxis_transform(),
        )  # fmt: skip
        axes.set_xlabel("cond(H)")
        axes.grid(True, which="major", color=GRID)
    panels[0].set_title(r"Channels with motion, $v_z$ and $\omega_z$")
    panels[1].set_title("Channels without, over those with")
    panels[0].set_ylabel("largest error to exact, %")
    shared_legend(drawn, panels[0])
    text = (
        "Two kinds of rings of .15 to 1 m at 1 to 5 m, without noise. As the geometry gets worse, fixed "
        "point and the explicit inverse spill the driven rates into the idle channels; with the exact "
        "residual the core keeps them apart, up to the conditioning at which it refuses. (What is exactly "
        f"equal is drawn at {FLOOR:.0e} %.)"
    )
    return Picture("condition", "What the order of operations costs", text, "", png(drawn))


def bounds_figure(solved: RateSolutions) -> Picture:
    """Errors of all six rates to the truth inside the core's own 3-sigma bounds."""
    times, truth, core = solved.run.times, solved.run.truth, rates(solved.core)
    sigma = deviations(solved.core)
    share = solved.share_inside()
    drawn = figure(10.0, 5.2)
    grid: Any = drawn.subplots(2, 3, sharex=True)
    for channel, axes in enumerate(grid.ravel()):
        bound, error = 3e3 * sigma[:, channel], 1e3 * (core - truth)[:, channel]
        axes.fill_between(times, -bound, bound, color=BAND, linewidth=0, label=r"$\pm 3\sigma$ of the core")
        axes.axhline(0.0, color=MUTED, linewidth=0.8)
        axes.plot(times, error, color=CORE, marker="o", markersize=2.5, linewidth=0.8, label="error")
        axes.set_title(SYMBOLS[channel])
        axes.set_title(
            f"{share[channel]:.0%} inside", loc="right", fontsize=9, fontweight="normal", color=MUTED
        )
    grid[0, 0].set_ylabel("error of v, mm/s")
    grid[1, 0].set_ylabel(r"error of $\omega$, mrad/s")
    for axes in grid[1]:
        axes.set_xlabel("time, s")
    shared_legend(drawn, grid[0, 0])
    text = (
        f"Core minus truth with the bounds of the core's covariance; the phases' noise scales it. "
        f"{share.mean():.1%} of the components lie inside (99.7 % expected; an exceedance is no failure)."
    )
    return Picture("bounds", "Errors to the truth", text, "", png(drawn))


def camera_figure(solved: RateSolutions, camera: CameraRun) -> Picture:
    """What the camera's projections change in the rates, and their errors."""
    times = solved.run.times
    change = 1e3 * (rates(camera.core) - rates(solved.core))
    drawn = figure(10.0, 3.7)
    panels: Sequence[Any] = drawn.subplots(1, 3)
    for axes, values in zip(panels, (change[:, :3], 1e3 * camera.offset), strict=False):
        for i, (letter, colour) in enumerate(zip(AXES, (DOUBLE, GOOD, CORE), strict=True)):
            axes.plot(
                times, values[:, i], color=colour, marker="o", markersize=2.5, linewidth=0.8, label=letter
            )  # fmt: skip
        axes.axhline(0.0, color=MUTED, linewidth=0.8)
    panels[0].set_title("Change of v by the camera")
    panels[0].set_ylabel("mm/s")
    panels[1].set_title("Error of the pose's t")
    panels[1].set_ylabel("mm")
    panels[2].plot(times, 1e3 * camera.error, color=DOUBLE, marker="o", markersize=2.5, linewidth=0.8)
    for k in camera.images:
        panels[2].axvline(times[k], color=GRID, linewidth=1.2, zorder=0)
    panels[2].set_title(r"Largest error of a $\rho$")
    panels[2].set_ylabel("mm")
    panels[2].set_ylim(bottom=0.0)
    for axes in panels:
        axes.set_xlabel("time, s")
    shared_legend(drawn, panels[0])
    seen, turned = camera.camera, float(np.abs(change[:, 3:]).max()) / 1e3
    text = (
        f"An image every {seen.every} frames (vertical lines): {seen.fiducials} points of the plate with "
        f"{seen.noise * 1e3:g} mm of noise an axis go through the OLTAE core, the beams are cut with the "
        "plane of its pose, and the pose is carried on with the rates of the frames before until the next "
        "image. The change is against the rates with true projections, on the same phases, whose noise is "
        f"{_noise(solved)}. Along its beam a projection may lie anywhere, so that only the pose's t counts: "
        f"its error moves v by omega x that error, and omega by nothing (at most {turned:.0e} rad/s here)."
    )
    return Picture("camera", "Projections from the OLTAE core's pose", text, "", png(drawn))


def _noise(solved: RateSolutions) -> str:
    """The core's median 1 sigma of v_x and omega_x, in words."""
    sigma = 1e3 * np.nanmedian(deviations(solved.core), axis=0)
    return f"{sigma[0]:.2g} mm/s in v_x and {sigma[3]:.2g} mrad/s in omega_x (1 sigma)"


def _rate_lines(axes: Any, solved: RateSolutions, channel: int, unit: float) -> None:
    times = solved.run.times
    values: tuple[tuple[FloatArray, dict[str, Any]], ...] = (
        (rates(solved.double), {"color": DOUBLE, "marker": "o", "ms": 5, "mfc": "none", "ls": "none"}),
        (rates(solved.core), {"color": CORE, "marker": ".", "ms": 5, "ls": "none"}),
    )
    for (x, style), label in zip(values, ("double", core_label(solved.backend)), strict=True):
        axes.plot(times, unit * x[:, channel], label=label, **style)
    axes.plot(
        times, unit * solved.run.truth[:, channel], color=TRUTH, linewidth=1.2, linestyle="--", label="truth"
    )
    axes.set_xlabel("time, s")
