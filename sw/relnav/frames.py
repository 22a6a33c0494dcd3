# SPDX-License-Identifier: Apache-2.0
"""Matched points from a CSV or .npz file (see records.py) or from arrays."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from .attitude import FloatArray
from .records import Layout, Placed, Records, make_records, read_records

POINTS = Layout({"a": ("ax", "ay", "az"), "b": ("bx", "by", "bz")}, noun="points")


@dataclass(frozen=True, eq=False)
class Frame(Placed):
    """Matched points of one frame, in any length unit.

    a, b:    (n, 3), finite
    w:       (n,) weights >= 0, finite, the inverse variances up to one factor; None for unweighted
    source:  the file; rows: (n,) each point's row there (1-based); lines: (n,) its line in a CSV
    """

    name: str | int
    a: FloatArray
    b: FloatArray
    w: FloatArray | None = None
    source: str = ""
    rows: npt.NDArray[np.int64] | None = None
    lines: npt.NDArray[np.int64] | None = None


def read_frames(path: str | Path) -> list[Frame]:
    """The frames of a CSV (header ax,ay,az,bx,by,bz) or .npz (a, b (n, 3)), both with optional w, frame.

    Raises InputError, one line, for anything that is not such a file or holds a value that is not finite.
    """
    return [_frame(records) for records in read_records(path, POINTS)]


def make_frame(
    a: npt.ArrayLike, b: npt.ArrayLike, w: npt.ArrayLike | None = None, name: str | int = 0
) -> Frame:
    """A checked Frame from arrays (n, 3), (n, 3) and optional (n,)."""
    return _frame(make_records(POINTS, {"a": a, "b": b}, w, name=name))


def _frame(r: Records) -> Frame:
    return Frame(r.name, r.arrays["a"], r.arrays["b"], r.w, r.source, r.rows, r.lines)
