# SPDX-License-Identifier: Apache-2.0
"""RGB-D odometry: the pose core chains a hand-held camera's way through a room.

SIFT features get their 3-D places from the depth image; matches of neighbouring images that belong to one
rigid motion go to the core, weighted by how well they are known. Nothing closes the loop, so errors add up:
that drift is what the table and the picture show.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray
from relnav.attitude import cayley
from relnav.backends import solve
from relnav.comparison import paper_runs
from relnav.errors import InputError
from relnav.frames import Frame, make_frame
from relnav.report.style import CORE, DOUBLE, PAPER, TRUTH, figure
from relnav.sensor.camera import Pinhole
from relnav.sensor.features import View, detect, gate, locate, match
from relnav.sensor.lidar import Surface
from relnav.sensor.mounting import Mounting

from examples.common import Array, NoData, Options, errors, path_of, pose_of, relative, run, show, travel

SEQUENCE = "rgbd_icl_livingroom1"  # Augmented ICL-NUIM, CC BY 3.0
CAMERA = Pinhole(640, 480, float(np.rad2deg(2 * np.arctan(320 / 525))))  # a focal length of 525 pixels
VIEW = View(CAMERA, Mounting(np.eye(3), np.zeros(3)), pixel_sigma=0.5)
DEPTH_SIGMA = 1e-3  # share of the depth
CEILING = 1.6  # m
COLOURS = {"core": CORE, "double": DOUBLE, "OpenCV": "#0ca678", "paper's Q15.16": PAPER}


def odometry(options: Options) -> Figure:
    """Match, solve, chain, compare with the truth."""
    folder = options.data / SEQUENCE
    if not (folder / "poses.npz").is_file():
        raise NoData(f"no {SEQUENCE} in the data folder (--data)")
    truth: Array = np.load(folder / "poses.npz")["T_world_cam"][: options.frames]
    frames = matched(folder, len(truth))
    paper = paper_runs(frames)[0]
    steps = {
        "core": [pose_of(result) for result in solve(frames, options.backend)],
        "double": [pose_of(result) for result in solve(frames, "double")],
        "OpenCV": [opencv(frame) for frame in frames],
        "paper's Q15.16": [(cayley(q), t) for q, t in zip(paper.q, paper.t, strict=True)],
    }
    poses = {name: travel(truth[0], chain) for name, chain in steps.items()}
    path, step = path_of(truth), relative(truth)
    rows = []
    for name, way in poses.items():
        a_pair, (off, turned) = np.median(errors(relative(way), step)[0]), (e[-1] for e in errors(way, truth))
        apart = np.linalg.norm(way[-1, :3, 3] - poses["double"][-1, :3, 3])
        rows.append(
            (
                name,
                f"{1e3 * a_pair:.2f}",
                f"{1e3 * off:.2f}",
                f"{1e2 * off / path[-1]:.2f}",
                f"{turned:.3f}",
                f"{1e3 * apart:.1e}",
            )
        )
    points = [len(frame.a) for frame in frames]
    print(f"{len(truth)} images over {path[-1]:.2f} m, {min(points)} to {max(points)} matched points a pair")
    show(("error", "a pair/mm", "at the end/mm", "drift/%", "turned/deg", "from double/mm"), rows)
    return picture(folder, truth, poses, path)


def matched(folder: Path, count: int) -> list[Frame]:
    """Matched points of each pair of neighbours: a of the image before, b of the one after."""
    frames, before = [], None
    for k in range(count):
        features = detect(image(folder / f"{k:03d}.color.jpg", cv2.IMREAD_GRAYSCALE), 800)
        with np.errstate(divide="ignore"):
            surface = Surface(CAMERA, 1.0 / depth(folder, k), DEPTH_SIGMA)
        after = (features, *locate(VIEW, VIEW.mounting, surface, features.uv))
        if before is not None:
            i, j = match(before[0], after[0]).T
            known = before[3][i] & after[3][j]
            i, j = i[known], j[known]
            a, b, variance = before[1][i], after[1][j], before[2][i] + after[2][j]
            kept = gate(a, b, variance, np.random.default_rng(k))
            weights = np.ceil(65535 * variance[kept].min() / variance[kept])
            frames.append(make_frame(a[kept], b[kept], weights, name=k))
        before = after
    return frames


def depth(folder: Path, k: int) -> Array:
    """Depth (480, 640) m, NaN where unknown."""
    millimetres = image(folder / f"{k:03d}.depth.png", cv2.IMREAD_UNCHANGED).astype(np.float64)
    return np.where(millimetres > 0, millimetres / 1e3, np.nan)


def image(file: Path, how: int) -> NDArray[Any]:
    """An image as OpenCV reads it."""
    found = cv2.imread(str(file), how)
    if found is None:
        raise InputError(f"{file.name}: no image that can be read")
    return found


def opencv(frame: Frame) -> tuple[Array, Array]:
    """(R, t) by OpenCV's closed form, which takes no weights."""
    found = np.asarray(cv2.estimateAffine3D(frame.a, frame.b, force_rotation=True)[0], dtype=np.float64)
    return found[:, :3], found[:, 3]


def picture(folder: Path, truth: Array, poses: dict[str, Array], path: Array) -> Figure:
    """The room from above, put together with the core's poses; the way through it; the drift."""
    drawn = figure(9.0, 8.6)
    room, drift = drawn.subplots(2, 1, height_ratios=(1.6, 1.0))
    cloud, colour = [], []
    for k in range(0, len(truth), 3):
        xyz = CAMERA.grid()[::3, ::3] * depth(folder, k)[::3, ::3, None]
        cloud.append((xyz @ poses["core"][k][:3, :3].T + poses["core"][k][:3, 3]).reshape(-1, 3))
        colour.append(
            image(folder / f"{k:03d}.color.jpg", cv2.IMREAD_COLOR)[::3, ::3, ::-1].reshape(-1, 3) / 255.0
        )
    points, colours = np.concatenate(cloud), np.concatenate(colour)
    order = np.argsort(points[:, 1])  # the world's y is up, so z to the right and x up is the view from above
    order = order[points[order, 1] < CEILING]
    room.scatter(points[order, 2], points[order, 0], c=colours[order], s=1.5, linewidths=0)
    for name, way, style in (
        ("truth", truth, {"color": TRUTH, "linewidth": 4.5}),
        ("core", poses["core"], {"color": CORE}),
    ):
        room.plot(way[:, 2, 3], way[:, 0, 3], label=f"path of the camera: {name}", **style)
    looks = poses["core"][::3]
    room.quiver(
        looks[:, 2, 3], looks[:, 0, 3], looks[:, 2, 2], looks[:, 0, 2], color=CORE, scale=22, width=0.003
    )
    room.set(
        xlabel="z, m",
        ylabel="x, m",
        aspect="equal",
        title="A room from above, put together with the core's poses",
    )
    room.legend(loc="upper right", frameon=True)
    for name, way in poses.items():
        thick = 3.5 if name == "double" else 1.4
        error = 1e3 * errors(way, truth)[0]
        drift.plot(path, error, color=COLOURS[name], label=name, linewidth=thick, zorder=5 - thick)
    drift.set(
        xlabel="distance travelled, m",
        ylabel="error of the position, mm",
        title="Drift: nothing closes the loop",
    )
    drift.legend(loc="upper left")
    return drawn


if __name__ == "__main__":
    sys.exit(run("rgbd_odometry", odometry, __doc__, frames=43))
