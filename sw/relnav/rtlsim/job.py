# SPDX-License-Identifier: Apache-2.0
"""What goes to the simulation's process and what comes back: files in one folder."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any, get_args

import numpy as np

from relnav.driver import Feed
from relnav.model.raw import CoreConfig, RawResult
from relnav.quantise import QuantisedFrame

JOB = "job.npz"
RESULTS = "results.json"


def write(file: Path, frames: Sequence[QuantisedFrame], config: CoreConfig, feed: str) -> None:
    """Write the frames, the configuration of all of them and the way to feed them."""
    if feed not in get_args(Feed):
        raise ValueError(f"frames are fed by {' or '.join(get_args(Feed))}, not {feed!r}")
    head = {
        "config": asdict(config),
        "feed": feed,
        "frames": [{"frac": frame.frac, "weight_scale": frame.weight_scale} for frame in frames],
    }
    arrays: dict[str, Any] = {"head": np.array(json.dumps(head))}
    for number, frame in enumerate(frames):
        arrays[f"a{number}"], arrays[f"b{number}"] = frame.a, frame.b
        if frame.w is not None:
            arrays[f"w{number}"] = frame.w
    np.savez(file, **arrays)


def read(file: Path) -> tuple[list[QuantisedFrame], CoreConfig, Feed]:
    """What `write` wrote."""
    with np.load(file) as stored:
        head = json.loads(str(stored["head"]))
        frames = [
            QuantisedFrame(
                stored[f"a{number}"],
                stored[f"b{number}"],
                stored.get(f"w{number}"),
                each["frac"],
                each["weight_scale"],
            )
            for number, each in enumerate(head["frames"])
        ]
    return frames, CoreConfig(**head["config"]), head["feed"]


def write_results(file: Path, results: Sequence[RawResult]) -> None:
    """Write the results."""
    file.write_text(json.dumps({"results": [asdict(result) for result in results]}))


def write_failure(file: Path, reason: str) -> None:
    """Write why there are none."""
    file.write_text(json.dumps({"failure": reason}))


def read_results(file: Path) -> list[RawResult]:
    """The results that were written."""
    found: list[dict[str, Any]] = json.loads(file.read_text())["results"]
    return [RawResult(**{name: _immutable(value) for name, value in one.items()}) for one in found]


def _immutable(value: Any) -> Any:
    return tuple(value) if isinstance(value, list) else value


def read_failure(file: Path) -> str | None:
    """Why there are no results, where the bench could tell."""
    if not file.is_file():
        return None
    reason: str | None = json.loads(file.read_text()).get("failure")
    return reason
