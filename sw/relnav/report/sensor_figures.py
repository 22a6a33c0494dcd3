# SPDX-License-Identifier: Apache-2.0
"""Figures of what the sensors saw: the flight, matched features, point clouds."""

from __future__ import annotations

from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import LightSource
from numpy.typing import NDArray

from ..attitude import FloatArray
from ..sensor.flight import Exposure, Flight
from .style import BAD, CORE, INK, MUTED, Picture, figure, png

LINES_SHOWN = 70
LABEL_BOX = {"facecolor": "white", "alpha": 0.7, "linewidth": 0, "boxstyle": "round,pad=0.1"}


def flight_figure(flight: Flight) -> Picture:
    """The ground track with the camera's footprints, and height over time."""
    drawn = figure(10.0, 4.3)
    plan, side = drawn.subplots(1, 2, width_ratios=[1.15, 1.0])
    terrain, km = flight.terrain, 1e-3
    shade = LightSource(315, 40).shade(
        np.nan_to_num(terrain.z, nan=float(np.nanmin(terrain.z))),
        cmap=mpl.colormaps["gist_earth"],
        vert_exag=2.0 if terrain.span < 1e5 else 1.0,
        dx=terrain.spacing,
        dy=terrain.spacing,
        blend_mode="soft",
        fraction=0.8,
    )
    shade[..., :3] = 0.55 * shade[..., :3] + 0.45  # pale, so that the track stands out
    extent = (terrain.x[0] * km, terrain.x[-1] * km, terrain.y[0] * km, terrain.y[-1] * km)
    plan.imshow(shade, extent=extent, origin="lower", interpolation="bilinear")
    track = np.array([exposure.pose.position for exposure in flight.exposures]) * km
    count = len(track)
    # each label on a side of its own
    for k, side_of, offset, across, up in (
        (0, (0.0, 1.0), (0, 4), "center", "bottom"),
        (count // 2, (0.0, -1.0), (0, -4), "center", "top"),
        (count - 1, (1.0, 0.0), (4, 0), "left", "center"),
    ):
        outline = _footprint(flight, flight.exposures[k]) * km
        plan.plot(*np.vstack([outline, outline[:1]]).T, color=INK, linewidth=1.0)
        plan.annotate(
            f"frame {k}", outline[np.argmax(outline @ np.array(side_of))], textcoords="offset points",
            xytext=offset, ha=across, va=up, fontsize=8, bbox=LABEL_BOX,
        )  # fmt: skip
    plan.plot(track[:, 0], track[:, 1], color=CORE, marker="o", markersize=2.5, linewidth=1.2)
    plan.set(title="Ground track and camera footprints", xlabel="x, km", ylabel="y, km")
    plan.grid(False)

    second = np.arange(count) * flight.trajectory.dt
    ground = [float(np.nanmin(e.ranges)) * km for e in flight.exposures]
    side.plot(second, track[:, 2], color=CORE, marker="o", markersize=3, label="height of the spacecraft")
    below = track[:, 2] - np.array(ground)
    bottom = float(below.min() - 0.04 * np.ptp(track[:, 2]))
    side.fill_between(second, bottom, below, color="#d8d2c4", linewidth=0)
    side.plot(second, below, color="#8a7f66", label="nearest ground")
    side.set(title="Approach", xlabel="time, s", ylabel="z, km", ylim=(bottom, None))
    side.legend(loc="upper right")
    velocity, rate = flight.trajectory.velocity, np.rad2deg(flight.trajectory.yaw_rate)
    caption = (
        f"{count} frames at {1 / flight.trajectory.dt:g} Hz over {terrain.name}. Constant rates in the body: "
        f"{velocity[0]:.1f} m/s along x, {velocity[2]:.1f} m/s along z, {rate:.2f} deg/s about z."
    )
    return Picture("flight", "The approach", caption, "", png(drawn))


def match_figure(flight: Flight, index: int) -> Picture:
    """Both images of a pair side by side, matched features joined by lines."""
    pair = flight.pairs[index]
    before, after = flight.exposures[index], flight.exposures[index + 1]
    height, width = before.image.shape
    gap = 12
    canvas = np.full((height, 2 * width + gap), 255, dtype=np.uint8)
    canvas[:, :width], canvas[:, width + gap :] = before.image, after.image
    drawn = figure(10.0, 10.0 * height / (2 * width + gap) + 0.45)
    axes = drawn.subplots()
    axes.imshow(canvas, cmap="gray", vmin=0, vmax=255, interpolation="nearest")
    shift = np.array([width + gap, 0.0])
    shown = _spread(pair.uv_a, LINES_SHOWN)
    colours = mpl.colormaps["turbo"](0.08 + 0.84 * pair.uv_a[shown, 1] / height)
    segments = np.stack([pair.uv_a[shown], pair.uv_b[shown] + shift], axis=1)
    axes.add_collection(LineCollection(list(segments), colors=colours, linewidths=0.7, alpha=0.85))
    for uv in (pair.uv_a, pair.uv_b + shift):
        axes.scatter(uv[:, 0], uv[:, 1], s=5, color="#ffd43b", linewidths=0)
        axes.scatter(uv[shown, 0], uv[shown, 1], s=16, facecolors="none", edgecolors=colours, linewidths=1.0)
    for uv in (pair.rejected[:, :2], pair.rejected[:, 2:] + shift):
        axes.scatter(uv[:, 0], uv[:, 1], s=13, marker="x", color=BAD, linewidths=0.9)
    axes.set_axis_off()
    name = index
    for x, text in ((width / 2, f"frame {name}"), (1.5 * width + gap, f"frame {name + 1}")):
        axes.annotate(
            text, (x, -7), ha="center", va="bottom", annotation_clip=False, fontsize=9.5, color=MUTED
        )
    source = "camera images" if flight.images == "camera" else "images made of the point clouds alone"
    caption = (
        f"{pair.matches} unique mutual SIFT matches between two {source}; {len(pair.uv_a)} are kept (yellow; "
        f"{len(shown)} of them joined by lines), {len(pair.rejected)} fit no one rigid motion (red crosses)."
    )
    return Picture("fig01_matches", "Matched features", caption, "1", png(drawn))


def cloud_figure(flight: Flight, index: int) -> Picture:
    """The two scans of a pair, each in its own body frame, with the matched points."""
    pair = flight.pairs[index]
    clouds = [flight.lidar.points(flight.exposures[k].ranges) for k in (index, index + 1)]
    unit, name = (1e-3, "km") if np.nanmax(np.abs(clouds[0])) > 3e3 else (1.0, "m")
    sparse = [cloud[::4, ::4].reshape(-1, 3) * unit for cloud in clouds]
    sparse = [cloud[np.isfinite(cloud).all(axis=1)] for cloud in sparse]
    drawn = figure(10.0, 4.5)
    for k, (cloud, points) in enumerate(zip(sparse, (pair.frame.a, pair.frame.b), strict=True)):
        low, high = np.percentile(cloud[:, 2], [0.5, 99.5])
        room = 0.15 * (high - low)
        axes: Any = drawn.add_subplot(1, 2, k + 1, projection="3d")
        # each cloud in its own colours: the same ground has the same colour in both
        axes.scatter(*cloud.T, c=cloud[:, 2], s=1.6, cmap="cividis", vmin=low, vmax=high, linewidths=0)
        axes.scatter(*(points * unit).T, s=7, color=CORE, linewidths=0, depthshade=False)
        axes.set_title(f"frame {index + k} (z in {name})", y=0.98)
        axes.set(xlabel=f"x, {name}", ylabel=f"y, {name}", zlim=(low - room, high + room))
        axes.tick_params(labelsize=8)
        axes.view_init(elev=38, azim=-62)
        axes.set_box_aspect((4, 3, 1.5), zoom=0.98)
        for axis in (axes.xaxis, axes.yaxis, axes.zaxis):
            axis.set_pane_color((1, 1, 1, 0))
    caption = (
        f"Every fourth row and column of the LiDAR scans {index} and {index + 1}, in the body frame, and the "
        f"{len(pair.frame.a)} matched points (orange): the input of one pose. "
        f"Range noise {flight.lidar.range_noise:.1e} of the range."
    )
    return Picture("fig02_clouds", "Point clouds", caption, "2", png(drawn))


def _footprint(flight: Flight, exposure: Exposure) -> FloatArray:
    """Ground places (4, 2) m of the view's corners: the scan's own corner points, in the world."""
    cloud = exposure.pose.to_world(flight.lidar.points(exposure.ranges))
    corners = [_nearest_return(cloud, *corner) for corner in ((0, 0), (0, -1), (-1, -1), (-1, 0))]
    return np.array(corners)[:, :2]


def _nearest_return(cloud: FloatArray, row: int, column: int) -> FloatArray:
    """The corner's point, or the next one along the diagonal that returned."""
    height, width = cloud.shape[:2]
    for step in range(min(height, width) // 2):
        point: FloatArray = cloud[row - step if row else step, column - step if column else step]
        if np.isfinite(point).all():
            return point
    return np.full(3, np.nan)


def _spread(uv: FloatArray, count: int) -> NDArray[np.int64]:
    """About ``count`` indices whose places are far from each other: greedy, farthest first."""
    if len(uv) <= count:
        return np.arange(len(uv))
    chosen = [int(np.argmin(uv.sum(axis=1)))]
    distance = np.linalg.norm(uv - uv[chosen[0]], axis=1)
    while len(chosen) < count:
        chosen.append(int(np.argmax(distance)))
        distance = np.minimum(distance, np.linalg.norm(uv - uv[chosen[-1]], axis=1))
    return np.array(chosen)
