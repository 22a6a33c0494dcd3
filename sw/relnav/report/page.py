# SPDX-License-Identifier: Apache-2.0
"""The report's one HTML file, pictures inside."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.resources import files
from typing import Any

import jinja2
import numpy as np

from .. import __version__
from ..comparison import Solutions
from ..result import PoseResult
from .key_table import Row
from .style import Picture
from .summary import PAPER_CYCLES, passed

Group = tuple[str, Sequence[Picture]]


@dataclass(frozen=True)
class Cards:
    """What a page says before its pictures.

    Args:
        title: of the window. heading, subtitle: of the page. verdict: the outcome in one line.
        problems: what failed. cards: from ``card``. method: how the run was made.
    """

    title: str
    heading: str
    subtitle: str
    passed: bool
    verdict: str
    problems: Sequence[str]
    cards: Sequence[dict[str, Any]]
    method: str


@dataclass(frozen=True)
class FrameTable:
    """Every frame's numbers. columns: (name, whether a number); rows: a cell a column."""

    summary: str
    columns: Sequence[tuple[str, bool]]
    rows: Sequence[Sequence[str]]


def render(head: Cards, rows: Sequence[Row], groups: Sequence[Group], frames: FrameTable) -> str:
    """A page as text, for any core; it refers to nothing outside itself."""
    text = files(__package__).joinpath("page.html.j2").read_text(encoding="utf-8")
    template = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined).from_string(text)
    columns = [{"name": name, "number": number} for name, number in frames.columns]
    return template.render(
        **vars(head),
        rows=rows,
        groups=[(title, [_embedded(picture) for picture in pictures]) for title, pictures in groups],
        frames={
            "summary": frames.summary,
            "columns": columns,
            "rows": [list(zip(columns, row, strict=True)) for row in frames.rows],
        },
        version=__version__,
    )


def page(solved: Solutions, rows: Sequence[Row], groups: Sequence[Group]) -> str:
    """The landing's page."""
    flight = solved.flight
    head = Cards(
        title=f"landing: {flight.terrain.name}",
        heading=f"Landing over {flight.terrain.name}",
        subtitle=(
            f"{len(flight.exposures)} frames of {flight.images} images and LiDAR scans, "
            f"{len(flight.pairs)} relative poses, solved by {solver_name(solved.backend)}"
        ),
        passed=passed(solved),
        verdict=verdict(solved),
        problems=_problems(solved),
        cards=_cards(solved),
        method=_method(solved),
    )
    return render(head, rows, groups, _frames(solved))


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
    return shortened(
        [*solved.differences, *(f"frame {name}: q beyond the bound" for name in solved.bound_broken)]
    )


def shortened(found: list[str]) -> list[str]:
    """A list that fits a page."""
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
        cards.append(card(f"{count - differing} / {count}", label, not differing))
    if cycles := [result.cycles for result in solved.core if result.cycles]:
        pose = max(c["pose"] for c in cycles)
        label = f"cycles from the last point to q (paper: {PAPER_CYCLES}); full pose {pose}"
        cards.append(card(str(max(c["q"] for c in cycles)), label))
    label = "largest relative error of q against the exact solution (bound 1e-7)"
    cards.append(card(f"{np.max(solved.numerical_error):.0e}", label, not solved.bound_broken))
    cards.append(card(f"{inside:.1%}", "of the pose components within 3 sigma of the truth"))
    cards.append(card(f"{share:.2%}", "median error of t, of the distance flown per frame"))
    cards.append(card(f"{np.median(points):.0f}", f"matched points a pose (fewest {min(points)})"))
    return cards


def card(value: str, label: str, good: bool | None = None) -> dict[str, Any]:
    """A number with what it is; good None where there is nothing to pass."""
    return {"value": value, "label": label, "good": good}


FRAME_COLUMNS = (
    ("frame", True),
    ("points", True),
    ("q error, 1e-6", True),
    ("t error, m", True),
    ("relative error to exact", True),
    ("turn", False),
    ("cycles q / pose / all", False),
    ("flags", False),
)


def _frames(solved: Solutions) -> FrameTable:
    q_error, t_error = (np.linalg.norm(solved.errors(field)[0], axis=1) for field in ("q", "t"))
    rows = [
        (
            str(result.frame),
            str(result.n),
            f"{q_error[k] * 1e6:.2f}",
            f"{t_error[k]:.3g}",
            f"{solved.numerical_error[k]:.1e}",
            result.turn or "-",
            _cycles(result),
            ", ".join(result.flags) or "-",
        )
        for k, result in enumerate(solved.core)
    ]
    return FrameTable(f"{len(rows)} poses", FRAME_COLUMNS, rows)


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
