# SPDX-License-Identifier: Apache-2.0
"""Plots of the measured accuracy (bench/results.json), as SVG into docs/images.

python scripts/plots.py
"""

from __future__ import annotations

import hashlib
import io
import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

ROOT = Path(__file__).resolve().parent.parent
RESULTS = ROOT / "bench/results.json"
IMAGES = ROOT / "docs/images"
LARGEST = 100_000  # bytes of a picture

Json = dict[str, Any]


def grid(axes: Axes, title: str, x: str, y: str) -> None:
    """Words and grid of one plot."""
    axes.set_title(title, fontsize=10)
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    axes.grid(alpha=0.3)


def two() -> tuple[Figure, Axes, Axes]:
    """Two plots side by side."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(9.6, 3.6), layout="constrained")
    return figure, left, right


def oltae(found: Json) -> Figure:
    """Largest errors over kappa(M); shares inside 3 sigma over the angle."""
    figure, left, right = two()
    bins = found["accuracy"]["bins"]
    kappa = [entry["kappa_below"] for entry in bins]
    names = {"q": "q", "R": "R", "t": "t", "q_cov": "covariance of q", "rss": "rss"}
    for (key, name), marker in zip(names.items(), "osD^v", strict=True):
        left.loglog(kappa, [entry[key]["error"] for entry in bins], marker + "-", label=name, lw=1, ms=5)
    bound, limit = found["accuracy"]["bound"], found["accuracy"]["bound_kappa"]
    left.plot([kappa[0] / 2, limit], [bound, bound], "k--", lw=1, label="bound of q")
    grid(
        left,
        "largest relative error to the exact solution",
        "kappa(M) below",
        "relative error",
    )
    left.legend(fontsize=8)
    angles = found["three_sigma"]["angles"]
    for place, entry in enumerate(angles):
        for name, share in entry["inside"].items():
            colour, shift = ("C0", -0.08) if name.startswith("q") else ("C1", 0.08)
            label = {"q1": "components of q", "t1": "components of t"}.get(name) if place == 0 else None
            right.plot(place + shift, 100 * share, "o", color=colour, ms=4, label=label)
    right.axhline(99.73, color="k", ls="--", lw=1, label="Gaussian, 99.73 %")
    right.set_xticks(
        range(len(angles)),
        [f"{a['degrees']:g}°" + ("\nre-applied" if a["reapplied"] else "") for a in angles],
    )
    right.set_ylim(99.3, 100)
    grid(
        right,
        f"errors inside 3 sigma, {angles[0]['trials']} trials each",
        "angle of the rotation",
        "inside, percent",
    )
    right.legend(fontsize=8, loc="upper right")
    return figure


def ivisnav(found: Json) -> Figure:
    """Errors over cond(H), ours and of an explicit inverse; rss over the noise."""
    figure, left, right = two()
    rates = found["rates"]
    # of a ring the largest of both driven rates, where all frames were given
    for key, name, colour in (("explicit", "explicit inverse", "C1"), (None, "core", "C0")):
        for random, marker in ((False, "o"), (True, "s")):
            cells = rates["random"] if random else rates["rings"]
            points = []
            for cell in cells:
                own = cell.get("error") if random else max((cell["v_z"] or 0.0), (cell["omega_z"] or 0.0))
                value = cell[key] if key else own
                if value:
                    points.append((cell["cond"][1], value))
            label = f"{name}, {'random H' if random else 'rings'}"
            left.loglog(*zip(*points, strict=True), marker, color=colour, ms=4, label=label, mfc="none")
    left.axvline(rates["largest_condition"], color="k", ls=":", lw=1, label="refused beyond")
    left.axhline(rates["bound"], color="k", ls="--", lw=1, label="bound")
    grid(
        left,
        "largest relative error to the exact solution",
        "largest cond(H) in a row of the tables",
        "relative error",
    )
    left.set_ylim(2e-8, 2e3)
    left.legend(fontsize=7, ncols=2, loc="upper left")
    noise = [entry["noise"] for entry in rates["rss"]]
    right.loglog(noise, [entry["error"] for entry in rates["rss"]], "o-", label="relative to rss", lw=1)
    right.loglog(noise, [entry["floor"] for entry in rates["rss"]], "s-", label="relative to sum w y^2", lw=1)
    grid(right, "error of the residual sum of squares", "noise of y / rms of y", "relative error")
    right.legend(fontsize=8)
    return figure


PLOTS: dict[str, tuple[Callable[[Json], Figure], tuple[str, ...]]] = {
    "accuracy_oltae": (oltae, ("accuracy", "three_sigma")),
    "accuracy_ivisnav": (ivisnav, ("rates",)),
}


def digest(name: str, found: Json) -> str:
    """Of what a plot shows, to see whether the picture is old."""
    parts = {key: {k: v for k, v in found[key].items() if k != "seconds"} for key in PLOTS[name][1]}
    return hashlib.sha256(json.dumps(parts, sort_keys=True).encode()).hexdigest()[:16]


def draw(name: str, found: Json) -> str:
    """The picture."""
    with matplotlib.rc_context({"svg.hashsalt": name, "svg.fonttype": "none", "font.family": "DejaVu Sans"}):
        figure = PLOTS[name][0](found)
        file = io.StringIO()
        nothing = dict.fromkeys(("Date", "Creator", "Format", "Type"))
        figure.savefig(file, format="svg", metadata=nothing | {"Source": f"data {digest(name, found)}"})
        plt.close(figure)
    return "\n".join(line.rstrip() for line in file.getvalue().splitlines()) + "\n"


def main() -> int:
    """Write both."""
    found: Json = json.loads(RESULTS.read_text(encoding="utf-8"))
    for name in PLOTS:
        file, text = IMAGES / f"{name}.svg", draw(name, found)
        if len(text) > LARGEST:
            raise SystemExit(f"{file.name} has {len(text)} bytes, more than {LARGEST}")
        if not file.is_file() or file.read_text(encoding="utf-8") != text:
            file.write_text(text, encoding="utf-8")
            print(f"{file.relative_to(ROOT)} written, {len(text)} bytes")
    return 0


if __name__ == "__main__":
    sys.exit(main())
