# SPDX-License-Identifier: Apache-2.0
"""Proximity: both cores together. Rates from laser phases carry a pose on between a slow camera's images.

A plate comes near and turns. Now and then the camera sees its fiducials, and OLTAE makes a pose of them; at
every frame iVisNav makes rates of the beams' phase differences, which move that pose on to the next image.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from relnav.attitude import angle_of
from relnav.backends import solve
from relnav.ivisnav.backends import solve_rates
from relnav.ivisnav.camera import Camera, PlatePose, about_z
from relnav.ivisnav.comparison import Run, deviations, rates
from relnav.proximity import fly
from relnav.report.style import CORE, DOUBLE, MUTED, TRUTH, figure

from examples.common import Array, Options, pose_of, run, show

CAMERA = Camera(every=20)
DRIVEN = (("approach v_z, mm/s", 2), ("turn omega_z, mrad/s", 5))


def proximity(options: Options) -> Figure:
    """Measure, solve, carry the pose on, compare with the truth."""
    flown, rng = fly(options.frames, seed=1), np.random.default_rng(2)
    sensor, samples = flown.sensor, flown.samples
    photographs = [CAMERA.photograph(sample, rng) for sample in samples[:: CAMERA.every]]
    images, motions = {}, {}
    for backend in dict.fromkeys((options.backend, "double")):
        images[backend] = [PlatePose(*pose_of(result)) for result in solve(photographs, backend)]
        motions[backend] = solve_rates(
            flown.frames, backend, f0=sensor.f0, dt=sensor.dt, sigma=sensor.difference_sigma
        )
    core, found = options.backend, {name: rates(motion) for name, motion in motions.items()}
    still = np.zeros_like(found[core])
    ways = {
        "camera alone, pose held": carried(flown, images[core], still, CAMERA.every),
        "camera and rates": carried(flown, images[core], found[core], CAMERA.every),
        "  the same in double": carried(flown, images["double"], found["double"], CAMERA.every),
        "first image, then rates": carried(flown, images[core], found[core], len(samples)),
    }
    off = {name: errors_of(flown, way) for name, way in ways.items()}
    print(f"{len(samples)} intervals in {flown.manoeuvre.duration:g} s, {len(images[core])} images")
    rows = [
        (name, *(f"{value:.3f}" for error in both for value in (np.median(error), error.max())))
        for name, both in off.items()
    ]
    show(("error, median and max", "place/mm", "max", "turn/mrad", "max"), rows)
    error, sigma = found[core] - flown.truth, deviations(motions[core])
    apart = np.abs(found[core] - found["double"]).max(axis=0)
    for title, k in DRIVEN:
        rms = 1e3 * np.sqrt(np.mean(error[:, k] ** 2))
        print(f"{title}: {rms:.3f} rms from the truth, {1e3 * apart[k]:.1e} at most from double")
    print(f"all six rates inside 3 sigma: {np.mean(np.abs(error) <= 3.0 * sigma):.1%}")
    return picture(flown, found[core], sigma, off)


def carried(flown: Run, images: Sequence[PlatePose], rate: Array, every: int) -> list[PlatePose]:
    """The plate's pose at each frame: an image's, or the last one moved on by the mean of two rates."""
    poses = [images[0]]
    for k in range(1, len(rate)):
        mean = (rate[k - 1] + rate[k]) / 2.0
        moved = poses[-1].moved(mean[:3], mean[3:], flown.times[k] - flown.times[k - 1])
        poses.append(moved if k % every else images[k // CAMERA.every])
    return poses


def errors_of(flown: Run, way: Sequence[PlatePose]) -> tuple[Array, Array]:
    """Distance, mm, and angle, mrad, of poses from the true ones, (n,) each."""
    place = [
        np.linalg.norm(pose.t - [0.0, 0.0, s.distance]) for pose, s in zip(way, flown.samples, strict=True)
    ]
    turn = [angle_of(pose.R @ about_z(s.angle).T) for pose, s in zip(way, flown.samples, strict=True)]
    return 1e3 * np.array(place), 1e3 * np.array(turn)


def picture(flown: Run, found: Array, sigma: Array, off: dict[str, tuple[Array, Array]]) -> Figure:
    """The beams, the rates, and what becomes of the pose with and without them."""
    drawn = figure(13.0, 6.0)
    halves: Any = drawn.subfigures(1, 2, width_ratios=(1.0, 2.2))
    left, right = halves
    room = left.add_subplot(projection="3d")
    start, away = flown.beacons.origins, flown.samples[0].distance
    end = flown.samples[0].frame.p + [0.0, 0.0, away]
    plate = CAMERA.size * np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]) + [0, 0, away]
    room.plot_trisurf(*plate.T, triangles=[[0, 1, 2], [0, 2, 3]], color=DOUBLE, alpha=0.15)
    for label, at, colour in (
        ("sensor", start.min(axis=0) - [0.5, 0.5, 0], TRUTH),
        ("plate", plate[0], DOUBLE),
    ):
        room.text(*at, f"{label}  ", color=colour, ha="right")
    for one, other in zip(start, end, strict=True):
        room.plot(*np.array([one, other]).T, color=CORE, linewidth=1.4)
    room.scatter(*start.T, color=TRUTH)
    room.scatter(*end.T, color=CORE)
    room.set(xlabel="x, m", ylabel="y, m", title="Six laser beams")
    room.set_zlabel("z, m", labelpad=10)
    room.set(xticks=(-1, 0, 1), yticks=(-1, 0, 1), zticks=(0.0, 0.5, 1.0, 1.5), zlim=(0.0, away))
    room.set_box_aspect((1, 1, 1), zoom=0.82)
    panels = right.subplots(2, 2, sharex=True)
    for axes, (title, k) in zip(panels[0], DRIVEN, strict=True):
        axes.plot(flown.times, 1e3 * flown.truth[:, k], color=TRUTH, linewidth=3.0, label="true")
        axes.plot(flown.times, 1e3 * found[:, k], ".", color=CORE, label="iVisNav core")
        axes.set(title=title.split(",")[0], ylabel=title)
    panels[0][0].legend(loc="center")
    colours = (MUTED, CORE, DOUBLE, TRUTH)
    for axes, quantity, title in zip(panels[1], (0, 1), ("place, mm", "turn, mrad"), strict=True):
        for colour, (name, both) in zip(colours, off.items(), strict=True):
            axes.semilogy(
                flown.times,
                both[quantity],
                color=colour,
                label=name,
                linewidth=3.0 if colour == DOUBLE else 1.3,
                zorder=1 if colour == DOUBLE else 2,
            )
        axes.set(title=f"Error of the plate's {title.split(',')[0]}", xlabel="time, s", ylabel=title)
    right.legend(*panels[1][0].get_legend_handles_labels(), loc="outside lower center", ncols=4)
    return drawn


if __name__ == "__main__":
    sys.exit(run("proximity", proximity, __doc__, frames=100))
