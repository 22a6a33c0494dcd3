# SPDX-License-Identifier: Apache-2.0
"""The report's one HTML file, pictures inside."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from importlib.resources import files
from typing import Any

import jinja2
import numpy as np

from .. import __version__
from ..comparison import Solutions
from ..result import PoseResult
from .style import Picture
from .summary import PAPER_CYCLES, Row, passed

Group = tuple[str, Sequence[Picture]]


def page(solved: Solutions, rows: Sequence[Row], groups: Sequence[Group]) -> str:
    """The page as text; it refers to nothing outside itself."""
    text = files(__package__).joinpath("page.html.j2").read_text(encoding="utf-8")
    template = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined).from_string(text)
    flight, good = solved.flight, passed(solved)
    return template.render(
        terrain=flight.terrain.name,
        subtitle=(
            f"{len(flight.exposures)} frames of {flight.images} images and LiDAR scans, "
            f"{len(flight.pairs)} relative poses, solved by {solver_name(solved.backend)}"
        ),
        passed=good,
        verdict=verdict(solved),
        problems=_problems(solved),
        cards=_cards(solved),
        rows=rows,
        groups=[(title, [_embedded(picture) for picture in pictures]) for title, pictures in groups],
        frames=_frames(solved),
        method=_method(solved),
        version=__version__,
    )


def solver_name(backend: str) -> str:
    """The backend in words."""
    names = {"fixed": "the bit-exact model", "double": "the golden model in double precision"}
    return names.get(backend, f"the RTL on {backend.capitalize()}")


def verdict(solved: Solutions) -> str:
    """The outcome in one line."""
    if solved.differences:
        return "RTL and bit-exact model differ"
    if solved.bound_broken:
        return "numerical bound broken"
    if solved.backend in ("fixed", "double"):
        return "numerical bound held in every frame"
    return "RTL equals the bit-exact model; numerical bound held in every frame"


def _problems(solved: Solutions) -> list[str]:
    found = [*solved.differences, *(f"frame {name}: q beyond the bound" for name in solved.bound_broken)]
    return found if len(found) <= 30 else [*found[:30], f"and {len(found) - 30} more"]


def _cards(solved: Solutions) -> list[dict[str, Any]]:
    inside = np.concatenate([solved.share_inside("q"), solved.share_inside("t")]).mean()
    t_error, _ = solved.errors("t")
    share = np.median(np.linalg.norm(t_error, axis=1) / np.linalg.norm(solved.true_t, axis=1))
    points = [len(pair.frame.a) for pair in solved.flight.pairs]
    cards: list[dict[str, Any]] = []
    if solved.bit_exact and solved.backend != "fixed":
        differing = len({text.partition(":")[0] for text in solved.differences})
        count = len(solved.core)
        label = "poses in which the RTL equals the model to the bit"
        cards.append(_card(f"{count - differing} / {count}", label, not differing))
    if cycles := [result.cycles for result in solved.core if result.cycles]:
        pose = max(c["pose"] for c in cycles)
        label = f"cycles from the last point to q (paper: {PAPER_CYCLES}); full pose {pose}"
        cards.append(_card(str(max(c["q"] for c in cycles)), label))
    label = "largest relative error of q against the exact solution (bound 1e-7)"
    cards.append(_card(f"{np.max(solved.numerical_error):.0e}", label, not solved.bound_broken))
    cards.append(_card(f"{inside:.1%}", "of the pose components within 3 sigma of the truth"))
    cards.append(_card(f"{share:.2%}", "median error of t, of the distance flown per frame"))
    cards.append(_card(f"{np.median(points):.0f}", f"matched points a pose (fewest {min(points)})"))
    return cards


def _card(value: str, label: str, good: bool | None = None) -> dict[str, Any]:
    return {"value": value, "label": label, "good": good}


def _frames(solved: Solutions) -> list[dict[str, str]]:
    q_error, t_error = (np.linalg.norm(solved.errors(field)[0], axis=1) for field in ("q", "t"))
    return [
        {
            "name": str(result.frame),
            "points": str(result.n),
            "q_error": f"{q_error[k] * 1e6:.2f}",
            "t_error": f"{t_error[k]:.3g}",
            "numerical": f"{solved.numerical_error[k]:.1e}",
            "turn": result.turn or "-",
            "cycles": _cycles(result),
            "flags": ", ".join(result.flags) or "-",
        }
        for k, result in enumerate(solved.core)
    ]


def _cycles(result: PoseResult) -> str:
    return " / ".join(str(result.cycles[key]) for key in ("q", "pose", "all")) if result.cycles else "-"


def _method(solved: Solutions) -> str:
    flight = solved.flight
    return (
        f"Noise, 1 sigma: feature places {flight.view.pixel_sigma:g} px (measured for SIFT on these images), "
        f"ranges {flight.lidar.range_noise:.1e} of the range. Each point's variance is taken as equal along "
        "the axes, the larger of pixel and range error; weights are 1 / variance as 16-bit integers on one "
        f"scale for the whole flight, so that the standard deviation at unit weight, {flight.sigma:.4g} m a "
        f"cloud, makes the core's covariances absolute. Seed {flight.seed}."
    )


def _embedded(picture: Picture) -> dict[str, Any]:
    return {
        "name": picture.name,
        "title": picture.title,
        "caption": picture.caption,
        "paper": picture.paper,
        "data": base64.b64encode(picture.png).decode("ascii") if picture.png else "",
    }
