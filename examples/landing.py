# SPDX-License-Identifier: Apache-2.0
"""Landing by dead reckoning: camera and LiDAR look down, the pose core chains the way to the ground.

`make sim` checks each pose by itself; here they are put end to end, as for a navigator who has nothing else.
The core's covariances foretell how far the chain may stray: 3 sigma of the position, frame by frame.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.colors import LightSource
from matplotlib.figure import Figure
from relnav.attitude import cayley, skew
from relnav.backends import solve
from relnav.comparison import paper_runs
from relnav.model.raw import CoreConfig
from relnav.report.style import BAND, CORE, DOUBLE, PAPER, TRUTH, figure
from relnav.result import PoseResult
from relnav.sensor.flight import Flight, Simulator
from relnav.sensor.terrain import load_terrain

from examples.common import Array, Options, errors, path_of, pose_of, rigid, run, show, travel

COLOURS = {"core": CORE, "double": DOUBLE, "paper's Q15.16": PAPER}


def landing(options: Options) -> Figure:
    """Fly, solve, chain, compare with the truth."""
    simulator = Simulator(load_terrain(), options.frames)
    flight = simulator.collect(list(simulator.fly()))
    frames = [pair.frame for pair in flight.pairs]
    config = CoreConfig(variance=2.0 * flight.sigma**2)  # of b - R a at unit weight
    core, double = (solve(frames, backend, config=config) for backend in (options.backend, "double"))
    paper = paper_runs(frames)[0]

    truth = np.array([rigid(shot.pose.rotation, shot.pose.position) for shot in flight.exposures])
    ways = {
        "core": travel(truth[0], [pose_of(result) for result in core]),
        "double": travel(truth[0], [pose_of(result) for result in double]),
        "paper's Q15.16": travel(truth[0], [(cayley(q), t) for q, t in zip(paper.q, paper.t, strict=True)]),
    }
    path, sigma = path_of(truth), spread(ways["core"], core, flight)
    rows = []
    for name, way in ways.items():
        off, turned = (error[-1] for error in errors(way, truth))
        apart = np.linalg.norm(way[-1, :3, 3] - ways["double"][-1, :3, 3])
        rows.append((name, f"{off:.2f}", f"{1e2 * off / path[-1]:.3f}", f"{turned:.4f}", f"{apart:.1e}"))
    print(
        f"{len(truth)} frames, {path[-1]:.0f} m of way down to {flight.terrain.name}, each pose of "
        f"{min(len(f.a) for f in frames)} to {max(len(f.a) for f in frames)} points"
    )
    show(("error at the end", "position/m", "drift/%", "turned/deg", "from double/m"), rows)
    inside = np.abs(ways["core"][1:, :3, 3] - truth[1:, :3, 3]) <= 3.0 * sigma[1:]
    foretold = 3.0 * np.linalg.norm(sigma[-1])
    print(
        f"3 sigma of the last position, foretold by the core: {foretold:.2f} m; inside: {inside.mean():.1%}"
    )
    return picture(flight, truth, ways, sigma)


def spread(way: Array, results: Sequence[PoseResult], flight: Flight) -> Array:
    """Standard deviations (n + 1, 3) m of the chained positions, world axes.

    About its points' centroid a pose's turn and shift are independent. The turn moves all that follows,
    with a lever from that centroid. That neighbouring pairs share an image is left out, which errs upwards.
    """
    variances = np.zeros((len(way), 3, 3))
    for j, (result, pair) in enumerate(zip(results, flight.pairs, strict=True)):
        w, axes, (r, _) = pair.frame.w, way[j, :3, :3], pose_of(result)
        assert w is not None and result.q_cov is not None
        turn, shift = 4.0 * r.T @ result.q_cov @ r, 2.0 * flight.sigma**2 / w.sum() * np.eye(3)  # angle: 2 q
        for k in range(j + 1, len(way)):
            lever = skew(axes.T @ (way[k, :3, 3] - way[j, :3, 3]) - w @ pair.frame.a / w.sum())
            variances[k] += axes @ (lever @ turn @ lever.T + shift) @ axes.T
    return np.sqrt(np.diagonal(variances, axis1=1, axis2=2))


def picture(flight: Flight, truth: Array, ways: dict[str, Array], sigma: Array) -> Figure:
    """The way over the terrain, and the errors of the position with what the core foretells."""
    drawn = figure(12.0, 5.6)
    halves: Any = drawn.subfigures(1, 2, width_ratios=(1.0, 1.1))
    left, right = halves
    ground, terrain = left.subplots(), flight.terrain
    shade = LightSource(azdeg=320, altdeg=40).hillshade(terrain.z, dx=terrain.spacing, dy=terrain.spacing)
    extent = tuple(1e-3 * end for end in (terrain.x[0], terrain.x[-1], terrain.y[0], terrain.y[-1]))
    ground.imshow(shade, cmap="gray", extent=extent, origin="lower", vmin=-0.3)
    ground.plot(*1e-3 * truth[:, :2, 3].T, color=TRUTH, linewidth=5.0, label="true")
    ground.plot(
        *1e-3 * ways["core"][:, :2, 3].T, color=CORE, marker="o", markersize=3, label="chained by the core"
    )
    view = flight.view.pinhole
    corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * [view.width, view.height] / (2.0 * view.focal)
    for k in (0, -1):
        height = truth[k, 2, 3]
        seen = (
            truth[k, :2, 3]
            + (height - terrain.highest_within(terrain.span / 6)) * corners @ truth[k, :2, :2].T
        )
        ground.plot(*1e-3 * np.vstack([seen, seen[:1]]).T, color=DOUBLE, linewidth=2.0)
        ground.annotate(
            f"seen from {1e-3 * height:.1f} km",
            1e-3 * seen[np.argmax(seen[:, 1])],
            (4, 4),
            textcoords="offset points",
            color=DOUBLE,
            weight="bold",
            bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 1.5},
        )
    middle = 1e-3 * terrain.centre
    ground.set(xlim=middle[0] + np.array([-8, 8]), ylim=middle[1] + np.array([-8, 8]))
    ground.grid(False)
    ground.set(xlabel="east, km", ylabel="north, km", title=f"The way down to {terrain.name}")
    ground.legend(loc="lower right", frameon=True)
    time = np.arange(len(truth)) * flight.trajectory.dt
    panels = right.subplots(3, 1, sharex=True)
    for k, (axes, title) in enumerate(zip(panels, ("east", "north", "up"), strict=True)):
        axes.fill_between(
            time, -3 * sigma[:, k], 3 * sigma[:, k], color=BAND, label="3 sigma, foretold by the core"
        )
        for name, way in ways.items():
            thick = 3.5 if name == "double" else 1.4
            axes.plot(
                time,
                way[:, k, 3] - truth[:, k, 3],
                color=COLOURS[name],
                linewidth=thick,
                label=name,
                zorder=5 - thick,
            )
        axes.set(ylabel=f"{title}, m")
    panels[0].set_title("Error of the position, chained")
    right.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=4)
    panels[-1].set_xlabel("time, s")
    return drawn


if __name__ == "__main__":
    sys.exit(run("landing", landing, __doc__, frames=25))
