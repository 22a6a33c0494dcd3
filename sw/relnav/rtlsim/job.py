# SPDX-License-Identifier: Apache-2.0
"""What goes to the simulation's process and what comes back: files in one folder.

Frames and results are dataclasses of the core (`cores.CORES`); a frame's fields are arrays, numbers or None.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import Any, get_args

import numpy as np

from relnav.driver import Feed

from .cores import CORES

JOB = "job.npz"
RESULTS = "results.json"
UNUSED = "name"
"""Field of a frame that the core has no use for."""


@dataclass(frozen=True)
class Job:
    """Frames for one core, the options of all of them and the way to feed them."""

    core: str
    frames: list[Any]
    options: Mapping[str, Any]
    feed: Feed


def write(file: Path, core: str, frames: Sequence[Any], options: Mapping[str, Any], feed: str) -> None:
    """Write a job. ValueError for an unknown feed."""
    if feed not in get_args(Feed):
        raise ValueError(f"frames are fed by {' or '.join(get_args(Feed))}, not {feed!r}")
    arrays: dict[str, Any] = {}
    plain: list[dict[str, Any]] = []
    for number, frame in enumerate(frames):
        values = {field.name: getattr(frame, field.name) for field in fields(frame) if field.name != UNUSED}
        arrays |= {f"{name}{number}": v for name, v in values.items() if isinstance(v, np.ndarray)}
        plain.append({name: v for name, v in values.items() if not isinstance(v, np.ndarray)})
    head = {"core": core, "options": dict(options), "feed": feed, "frames": plain}
    np.savez(file, head=np.array(json.dumps(head)), **arrays)


def read(file: Path) -> Job:
    """What `write` wrote."""
    with np.load(file) as stored:
        head = json.loads(str(stored["head"]))
        kind = CORES[head["core"]].frame
        frames = []
        for number, plain in enumerate(head["frames"]):
            names = {field.name for field in fields(kind)} - plain.keys() - {UNUSED}
            frames.append(kind(**plain, **{name: stored[f"{name}{number}"] for name in names}))
    return Job(head["core"], frames, head["options"], head["feed"])


def write_results(file: Path, results: Sequence[Any]) -> None:
    """Write the results."""
    file.write_text(json.dumps({"results": [asdict(result) for result in results]}))


def write_failure(file: Path, reason: str) -> None:
    """Write why there are none."""
    file.write_text(json.dumps({"failure": reason}))


def read_results(file: Path, core: str) -> list[Any]:
    """The results that were written."""
    found: list[dict[str, Any]] = json.loads(file.read_text())["results"]
    kind = CORES[core].result
    return [kind(**{name: _immutable(value) for name, value in one.items()}) for one in found]


def _immutable(value: Any) -> Any:
    return tuple(value) if isinstance(value, list) else value


def read_failure(file: Path) -> str | None:
    """Why there are no results, where the bench could tell."""
    if not file.is_file():
        return None
    reason: str | None = json.loads(file.read_text()).get("failure")
    return reason
