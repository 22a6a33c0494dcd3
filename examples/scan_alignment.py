# SPDX-License-Identifier: Apache-2.0
"""Scan alignment: two LiDAR scans brought together by feature matches, then step by step (ICP).

The pose core first solves matched features, with the wrong ones among them and without. Then it is the solver
inside an iterative closest point method: each point is matched with its foot on the surface of the other
scan, the core solves thousands of such matches, and again. --frames is the number of these steps.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass
from itertools import islice

import numpy as np
import relnav
from matplotlib.figure import Figure
from relnav.report.style import CORE, DOUBLE, MUTED, figure
from relnav.sensor.features import gate
from relnav.sensor.flight import Simulator
from relnav.sensor.terrain import load_terrain
from relnav.wahba import kabsch
from scipy.spatial import KDTree

from examples.common import Array, NoData, Options, errors, pose_of, rigid, run, show

RECORDED = "pair_smallgicp_lidar.npz"  # two LiDAR scans of koide3/small_gicp, MIT
OVERSHOOT = 1.9  # of the way to the foot: a point may slide along the surface, which plain steps make slow
Pose = tuple[Array, Array]


@dataclass(frozen=True, eq=False)
class Scans:
    """source, target (n, 3) m; a, b: matched features; truth: the pose sought; for the picture: axes to the
    right and up, and box: half its width, half its height, half its depth, m, about the target's median."""

    name: str
    source: Array
    target: Array
    a: Array
    b: Array
    truth: Pose
    reference: str
    axes: tuple[int, int]
    box: tuple[float, float, float]


def alignment(options: Options) -> Figure:
    """Features, features that agree, surfaces; the errors of each."""
    there = (options.data / RECORDED).is_file()
    if options.scans == "recorded" and not there:
        raise NoData(f"no {RECORDED} in the data folder (--data)")
    scans = street(options) if there and options.scans != "terrain" else ground()
    good = gate(scans.a, scans.b, np.ones(len(scans.a)), np.random.default_rng(1))

    def core(a: Array, b: Array) -> Pose:
        return pose_of(relnav.pose(a, b, backend=options.backend))

    apart = (np.eye(3), np.zeros(3))
    first = core(scans.a[good], scans.b[good])
    steps, gaps = closest_points(scans, core, first, options.frames)
    double = closest_points(scans, kabsch, first, options.frames)[0][-1]
    ways = {
        "scans as they are": apart,
        f"all {len(good)} matched features": core(scans.a, scans.b),
        f"the {good.sum()} that agree": first,
        **{f"surfaces, step {k}": steps[k] for k in sorted({1, 2, 5, options.frames}) if k <= options.frames},
        f"step {options.frames} by Kabsch, double": double,
    }
    off, turned = errors([rigid(*way) for way in ways.values()], [rigid(*scans.truth)] * len(ways))
    print(f"{scans.name}: {len(scans.source)} points on {len(scans.target)}; {scans.reference}")
    show(
        ("error", "t/m", "turned/deg"),
        [(n, f"{x:.3f}", f"{y:.4f}") for n, x, y in zip(ways, off, turned, strict=True)],
    )
    print(f"core and double after the last step: t {np.linalg.norm(steps[-1][1] - double[1]):.1e} m apart")
    return picture(scans, {"as they are": apart, "aligned by the core": steps[-1]}, steps, gaps)


def closest_points(
    scans: Scans, solve: Callable[[Array, Array], Pose], pose: Pose, count: int
) -> tuple[list[Pose], Array]:
    """ICP, point to plane: the poses, and the median distance from the surface at each."""
    tree = KDTree(scans.target)
    around = scans.target[tree.query(scans.target, 12)[1]]
    around -= around.mean(axis=1, keepdims=True)
    normals = np.linalg.eigh(np.einsum("nki,nkj->nij", around, around))[1][:, :, 0]
    poses, gaps = [pose], []
    for k in range(count + 1):
        moved = scans.source @ poses[-1][0].T + poses[-1][1]
        away, index = tree.query(moved)
        height = np.sum((moved - scans.target[index]) * normals[index], axis=1)
        gap = float(np.median(np.abs(height)))
        gaps.append(gap)
        near = (away < 3.0 * np.median(away)) & (np.abs(height) < 4.0 * gap)
        foot = moved - OVERSHOOT * height[:, None] * normals[index]
        if k < count:
            poses.append(solve(scans.source[near], foot[near]))
    return poses, np.array(gaps)


def street(options: Options) -> Scans:
    """Two recorded scans of a street."""
    arrays = np.load(options.data / RECORDED)
    source, target, a, b = (arrays[key].astype(np.float64) for key in ("src", "tgt", "corr_src", "corr_tgt"))
    truth = arrays["T_icp"][:3, :3], arrays["T_icp"][:3, 3]
    known = "errors against small_gicp's alignment, itself good to 0.1 to 0.3 degrees"
    return Scans("Street, recorded", source, target, a, b, truth, known, (1, 0), (12.0, 12.0, 9.0))


def ground() -> Scans:
    """Two simulated scans on the way down to a terrain, features from bearing-angle images of the scans."""
    simulator = Simulator(load_terrain(), 25, "bearing-angle")
    (before, _), (after, pair) = islice(simulator.fly(), 2)
    source, target = (simulator.lidar.points(shot.ranges) for shot in (before, after))
    assert pair is not None
    wrong = np.arange(0, len(pair.frame.b), 3)  # the simulator has gated its matches: spoil every third
    b = pair.frame.b.copy()
    b[wrong] = np.roll(b[wrong], 1, axis=0)
    clouds = source[::8, ::8].reshape(-1, 3), target[::2, ::2].reshape(-1, 3)
    known = "errors against the truth"
    return Scans(
        "Terrain, simulated", *clouds, pair.frame.a, b, (pair.R, pair.t), known, (0, 2), (2500.0, 300.0, 60.0)
    )


def picture(scans: Scans, poses: dict[str, Pose], steps: list[Pose], gaps: Array) -> Figure:
    """Both scans before and after; the way of the alignment."""
    drawn = figure(13.0, 4.8)
    *maps, way = drawn.subplots(1, 3, width_ratios=(1.0, 1.0, 0.9))
    order = [*scans.axes, 3 - sum(scans.axes)]
    middle = np.median(scans.target, axis=0)[order]
    for axes, (name, pose) in zip(maps, poses.items(), strict=True):
        moved = scans.source @ pose[0].T + pose[1]
        for cloud, colour, label, size in (
            (scans.target, DOUBLE, "target", 2.5),
            (moved, CORE, "source", 4.0),
        ):
            shown = cloud[:, order]
            shown = shown[np.all(np.abs(shown - middle) < scans.box, axis=1)]
            axes.plot(*shown[:, :2].T, ".", color=colour, markersize=size, label=label)
        axes.set(
            xlabel=f"{'xyz'[order[0]]}, m", ylabel=f"{'xyz'[order[1]]}, m", title=f"{scans.name}: {name}"
        )
        axes.set(
            xlim=middle[0] + np.array([-1, 1]) * scans.box[0],
            ylim=middle[1] + np.array([-1, 1]) * scans.box[1],
        )
        axes.legend(loc="upper right", markerscale=3, frameon=True)
    off, turned = errors([rigid(*step) for step in steps], [rigid(*scans.truth)] * len(steps))
    way.semilogy(off, color=CORE, marker="o", markersize=3, label="error of t, m")
    way.semilogy(turned, color=MUTED, marker="s", markersize=3, label="error of R, degrees")
    way.semilogy(gaps, color=DOUBLE, marker="^", markersize=3, label="median distance from the surface, m")
    way.set(xlabel="step (0: features that agree)", ylabel="m, or degrees", title="Closer at each step")
    way.legend(loc="best")
    return drawn


if __name__ == "__main__":
    sys.exit(run("scan_alignment", alignment, __doc__, frames=20, scans=True))
