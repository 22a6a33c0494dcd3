# SPDX-License-Identifier: Apache-2.0
"""The functional cover points of both cores, and their sampling (cocotb-coverage).

The benches of the cores' tops (tb/common/core_bench.py, tb/<core>/environment.py) and the soak
(tb/soak/observed.py) call `frame`, `flag` and `event` after they have compared what happened with the model.
Nothing is sampled unless RELNAV_COVERAGE names a folder; there each process leaves one XML file, written
again whenever a bin is hit for the first time. A bin's hits count kinds of samples, not samples.
"""

from __future__ import annotations

import math
import os
import struct
import uuid
from collections.abc import Callable, Iterable, Sequence
from dataclasses import astuple, dataclass
from pathlib import Path
from typing import Any

from cocotb_coverage import coverage as library
from relnav.registers import Ivisnav, Oltae

MAPS: dict[str, Any] = {"oltae_top": Oltae, "ivisnav_top": Ivisnav}
LEAST = {"oltae_top": 3, "ivisnav_top": 6}
LONGEST = 65535

STATES = ("IDLE", "loading", "COMPUTE", "DONE", "VERIFY")
EVENTS = {
    "register write": "a write acts",
    "locked write": "a write is ignored, since the core is busy or a push waits",
    "refused write": "SLVERR",
    "register read": "below 0x100",
    "result read": "from 0x100 on",
    "refused read": "SLVERR",
    "beat waits": "tvalid without tready",
    "beat": "taken from the stream",
    "push": "a PUSH is taken",
    "soft reset": "CONTROL.SOFT_RESET acts",
    "hard reset": "rst rises",
    "acknowledge": "CONTROL.ACKNOWLEDGE acts",
    "flags cleared": "a write of ones to FLAGS clears one that is up",
}
NEVER = {
    ("IDLE", "beat"): "the first beat is taken a clock after it has led from IDLE to loading",
    ("IDLE", "locked write"): "a push leads to loading before a second write can act; nothing else is locked",
    ("COMPUTE", "beat"): "tready is down while a frame is computed",
    ("VERIFY", "beat"): "tready is down while a frame is computed",
    ("DONE", "beat"): "the first beat is taken a clock after it has led from DONE to loading",
    ("COMPUTE", "push"): "a PUSH to a busy core is a locked write",
    ("VERIFY", "push"): "a PUSH to a busy core is a locked write",
    ("DONE", "locked write"): "nothing is locked in DONE: no frame is open, none is computed",
}
"""Bins of state x event that cannot be, and why."""


def _float(word: int) -> float:
    value: float = struct.unpack("<f", struct.pack("<I", word & 0xFFFFFFFF))[0]
    return value


# -------------------------------------------------------------------------------------------- classes


def among(value: float, bounds: Sequence[tuple[float, str]], beyond: str) -> str:
    """Name of the first class whose bound is above the value."""
    return next((name for bound, name in bounds if value < bound), beyond)


def n_bounds(least: int) -> list[tuple[float, str]]:
    """Classes of the number of points or rows."""
    return [
        (least + 1, str(least)),
        (least + 2, str(least + 1)),
        (13, f"{least + 2} to 12"),
        (100, "13 to 99"),
        (1000, "100 to 999"),
        (LONGEST, "1000 to 65534"),
    ]


ANGLES = [
    (0.01, "below 0.01"),
    (60.0, "to 60"),
    (120.0, "60 to 120"),
    (179.0, "120 to 179"),
    (179.99, "179 to 179.99"),
]
CONDITIONS = {
    "oltae_top": [(10.0, "below 10"), (1e3, "10 to 1e3"), (1e5, "1e3 to 1e5")],
    "ivisnav_top": [
        (10.0, "below 10"),
        (100.0, "10 to 100"),
        (1000.0, "100 to 1000"),
        (2000.0, "1000 to 2000"),
    ],
}
WEIGHTS = ("none", "all one", "equal", "mixed", "with zeros", "one positive", "span of 2^15 or more")
VARIANCES = ("0", "finite", "denormal", "infinite or NaN", "sign set")
OUTCOMES = ("RANK_DEFICIENT", "ILL_CONDITIONED", "Q_SATURATED")
PLACES = ("-64", "-63 to -1", "0", "1 to 94", "95")


def weight_classes(weights: Sequence[int] | None) -> tuple[str, ...]:
    """All classes that a frame's weights belong to."""
    if weights is None:
        return ("none",)
    positive = [weight for weight in weights if weight]
    if not positive:
        return ()  # ZERO_WEIGHT says so
    found = []
    if len(set(weights)) == 1:
        found.append("all one" if weights[0] == 1 else "equal")
    elif len(set(positive)) > 1:
        found.append("mixed")
    if len(positive) < len(weights):
        found.append("with zeros")
    if len(positive) == 1:
        found.append("one positive")
    if max(positive) >= min(positive) << 15:
        found.append("span of 2^15 or more")
    return tuple(found)


def variance_class(word: int) -> str:
    """Of the word in VARIANCE."""
    if word >> 31 & 1:
        return "sign set"
    exponent = word >> 23 & 255
    if exponent == 255:
        return "infinite or NaN"
    return "finite" if exponent else "denormal" if word else "0"


def place_class(frac: int) -> str:
    """Of a binary point."""
    return among(frac, [(-63, "-64"), (0, "-63 to -1"), (1, "0"), (95, "1 to 94")], "95")


def angle_class(rotation: Sequence[int]) -> str:
    """Of the angle of R, nine binary32 words by rows, degrees."""
    r = [_float(word) for word in rotation]
    if not all(map(math.isfinite, r)):
        return "not finite"
    sine = math.hypot(r[7] - r[5], r[2] - r[6], r[3] - r[1]) / 2
    degrees = math.degrees(math.atan2(sine, (r[0] + r[4] + r[8] - 1) / 2))
    return among(degrees, ANGLES, "179.99 to 180")


def condition_class(top: str, word: int) -> str:
    """Of the word in CONDITION: iVisNav's holds the square."""
    value = _float(word)
    if top == "ivisnav_top":
        value = math.sqrt(value) if value >= 0 else math.inf
    return among(value, CONDITIONS[top], "beyond")


@dataclass(frozen=True)
class Frame:
    """The classes of a frame that came to its end."""

    n: str
    weights: tuple[str, ...]
    feed: str
    places: tuple[str, ...]
    variance: str
    outcome: tuple[str, ...]
    """The flags that it left, or "clean"."""
    condition: str = ""
    angle: str = ""
    turn: str = ""
    config: tuple[bool, bool, bool] = (False, False, False)
    """Turns forbidden, re-applied, with covariances."""

    @property
    def weighted(self) -> str:
        """For the crosses."""
        return "plain" if self.weights == ("none",) else "weighted"


# --------------------------------------------------------------------------------------------- points

TURNS = ("none", "x", "y", "z")
SWITCHES = ("turns forbidden", "re-applied", "with covariances")


def _listed(value: Iterable[Any], one: Any) -> bool:
    return one in value


def _frame_points(top: str) -> list[Any]:
    flags = list(MAPS[top].FLAGS.FIELDS)
    point = library.CoverPoint
    many: dict[str, Any] = {"rel": _listed, "inj": False}
    least = LEAST[top]
    found = [
        point(f"{top}.n", xf=lambda f: f.n, bins=[*(name for _, name in n_bounds(least)), "65535"]),
        point(f"{top}.weights", xf=lambda f: f.weights, bins=list(WEIGHTS)[top == "ivisnav_top" :], **many),
        point(f"{top}.feed", xf=lambda f: f.feed, bins=["stream", "registers"]),
        point(f"{top}.variance", xf=lambda f: f.variance, bins=list(VARIANCES)),
        point(
            f"{top}.outcome",
            xf=lambda f: f.outcome,
            bins=["clean", *(name for name in OUTCOMES if name in flags)],
            **many,
        ),
        point(
            f"{top}.condition",
            xf=lambda f: f.condition,
            bins=[*(name for _, name in CONDITIONS[top]), "beyond"],
        ),
    ]
    for number, name in enumerate(("frac",) if top == "oltae_top" else ("frac_h", "frac_y")):
        found.append(point(f"{top}.{name}", xf=lambda f, k=number: f.places[k], bins=list(PLACES)))
    if top == "oltae_top":
        found += [
            point(
                f"{top}.angle", xf=lambda f: f.angle, bins=[*(name for _, name in ANGLES), "179.99 to 180"]
            ),
            point(f"{top}.turn", xf=lambda f: f.turn, bins=list(TURNS)),
            *(
                point(f"{top}.{name.replace(' ', '_')}", xf=lambda f, k=k: f.config[k], bins=[False, True])
                for k, name in enumerate(SWITCHES)
            ),
            point(f"{top}.weighted", xf=lambda f: f.weighted, bins=["plain", "weighted"]),
            library.CoverCross(
                f"{top}.configuration",
                items=[f"{top}.weighted", *(f"{top}.{name.replace(' ', '_')}" for name in SWITCHES)],
            ),
            library.CoverCross(f"{top}.feed_x_weighted", items=[f"{top}.feed", f"{top}.weighted"]),
            library.CoverCross(f"{top}.turn_x_weighted", items=[f"{top}.turn", f"{top}.weighted"]),
        ]
    return found


def _sampler(points: Sequence[Any]) -> Callable[..., None]:
    """A function whose calls sample the points; crosses after the points they are made of."""

    def sample(*_: Any) -> None:
        """Nothing more."""

    sampling: Callable[..., None] = sample
    for point in reversed(points):
        sampling = point(sampling)
    return sampling


def _flag_points(top: str) -> list[Any]:
    flags = list(MAPS[top].FLAGS.FIELDS)
    return [
        library.CoverPoint(f"{top}.flag", xf=lambda name, how: name, bins=flags),
        library.CoverPoint(f"{top}.flag_change", xf=lambda name, how: how, bins=["raised", "cleared"]),
        library.CoverCross(f"{top}.flag_x_change", items=[f"{top}.flag", f"{top}.flag_change"]),
    ]


def _event_points(top: str) -> list[Any]:
    return [
        library.CoverPoint(f"{top}.state", xf=lambda state, event: state, bins=list(STATES)),
        library.CoverPoint(f"{top}.event", xf=lambda state, event: event, bins=list(EVENTS)),
        library.CoverCross(
            f"{top}.state_x_event", items=[f"{top}.state", f"{top}.event"], ign_bins=list(NEVER)
        ),
    ]


_SAMPLERS = {
    (top, kind): _sampler(points(top))
    for top in MAPS
    for kind, points in (("frame", _frame_points), ("flag", _flag_points), ("event", _event_points))
}
_seen: set[tuple[str, str, object]] = set()
_name = (0, "")


def active() -> bool:
    """Whether anything is sampled."""
    return bool(os.environ.get("RELNAV_COVERAGE"))


def _save() -> None:
    global _name
    if _name[0] != os.getpid():
        _name = (os.getpid(), f"functional-{uuid.uuid4().hex}.xml")
    folder = Path(os.environ["RELNAV_COVERAGE"])
    folder.mkdir(parents=True, exist_ok=True)
    unfinished = folder / f"{_name[1]}.part"  # the process may be killed in mid-writing
    library.coverage_db.export_to_xml(str(unfinished))
    unfinished.replace(folder / _name[1])


def _sample(top: str, kind: str, key: object, *values: object) -> None:
    if not active() or (top, kind, key) in _seen:
        return
    _seen.add((top, kind, key))
    _SAMPLERS[top, kind](*values)
    _save()


# ------------------------------------------------------------------------------------------- sampling


def event(top: str, state: str, what: str) -> None:
    """Something happened at the ports of a core in a state: of STATES and EVENTS. What cannot be raises."""
    if active() and (state, what) in NEVER:
        raise AssertionError(f"{top}: {what} in {state}, but {NEVER[state, what]} (coverage/points.py)")
    _sample(top, "event", (state, what), state, what)


def flag(top: str, names: Iterable[str], how: str = "raised") -> None:
    """Flags were raised, or cleared."""
    for name in names:
        _sample(top, "flag", (name, how), name, how)


def frame(
    top: str,
    *,
    n: int,
    weights: Sequence[int] | None,
    feed: str,
    fracs: Sequence[int],
    variance: int,
    flags: Iterable[str],
    words: Sequence[int | None] | None,
    condition: int | None = None,
    turn: int = 0,
    config: tuple[bool, bool, bool] = (False, False, False),
) -> None:
    """A frame came to its end and was as the model says.

    weights: None where the core takes none; fracs: binary points; variance: word of VARIANCE; words: result
    words of a frame that was solved; condition: word of CONDITION, where it is not among them.
    """
    if not active():
        return
    told = [name for name in flags if name in OUTCOMES]
    angle = turned = ""
    if words is not None and top == "oltae_top":
        condition = words[19]
        angle, turned = angle_class([int(word or 0) for word in words[6:15]]), TURNS[turn]
    found = Frame(
        among(n, n_bounds(LEAST[top]), "65535"),
        weight_classes(weights),
        feed,
        tuple(map(place_class, fracs)),
        variance_class(variance),
        tuple(told) or ("clean",),
        "" if condition is None else condition_class(top, condition),
        angle,
        turned,
        config,
    )
    _sample(top, "frame", astuple(found), found)
