# SPDX-License-Identifier: Apache-2.0
"""What the examples share: options, the printed table, the picture's file."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray
from relnav.attitude import angle_of
from relnav.backends import BACKENDS
from relnav.errors import InputError, RelnavError, one_line
from relnav.report.style import house_style, png
from relnav.result import PoseResult

Array = NDArray[np.float64]

ROOT = Path(__file__).resolve().parent.parent
DATA = ROOT.parent / "shared" / "data"
EXIT_BAD_INPUT = 2


class NoData(Exception):
    """Data that are not part of the project and are not here: the example is skipped."""


class Parser(argparse.ArgumentParser):
    """Errors are one line; --help has the usage."""

    def error(self, message: str) -> NoReturn:
        """What is wrong, and exit code 2."""
        self.exit(EXIT_BAD_INPUT, f"{self.prog}: {one_line(message)}\n")


@dataclass(frozen=True)
class Options:
    """How an example is run. frames: how many of its frames; data: folder of recorded data."""

    backend: str
    frames: int
    data: Path
    out: Path
    scans: str


def run(name: str, example: Callable[[Options], Figure], text: str, frames: int, scans: bool = False) -> int:
    """Run an example on the command line's options and write its picture, out/examples/NAME.png.

    Returns the exit code: 0, also where the data are missing, or 2 after one line on bad input.
    """
    parser = Parser(prog=f"python -m examples.{name}", description=text.partition("\n")[0])
    parser.add_argument("--backend", choices=BACKENDS, default="fixed", help="default: %(default)s")
    parser.add_argument("--frames", type=int, default=frames, metavar="N", help="default: %(default)s")
    parser.add_argument("--data", type=Path, default=DATA, metavar="DIR", help="default: ../shared/data")
    parser.add_argument("--out", type=Path, default=ROOT / "out" / "examples", metavar="DIR")
    if scans:
        parser.add_argument("--scans", choices=("recorded", "terrain"), default="", help="default: recorded")
    options = Options(**{"scans": "", **vars(parser.parse_args())})
    try:
        if options.frames < 2:
            raise InputError(f"--frames {options.frames}: two are the least")
        with house_style():
            drawn = png(example(options))
        options.out.mkdir(parents=True, exist_ok=True)
        (options.out / f"{name}.png").write_bytes(drawn)
    except NoData as reason:
        print(f"skipped: {reason}")
        return 0
    except (RelnavError, OSError) as error:
        print(f"{parser.prog}: {error}", file=sys.stderr)
        return EXIT_BAD_INPUT
    print(f"picture: {name}.png")
    return 0


def show(head: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    """Print a table: first column to the left, numbers to the right."""
    widths = [max(len(row[k]) for row in (head, *rows)) for k in range(len(head))]
    for row in (head, ["-" * width for width in widths], *rows):
        cells = [cell.rjust(width) for cell, width in zip(row, widths, strict=True)]
        print("  ".join([row[0].ljust(widths[0]), *cells[1:]]).rstrip())


def pose_of(result: PoseResult) -> tuple[Array, Array]:
    """(R, t) of a result that has to have them. Raises InputError with the flags of one that has not."""
    if result.R is None or result.t is None:
        raise InputError(f"frame {result.frame} has no pose: {', '.join(result.flags)}")
    return result.R, result.t


def rigid(rotation: Array, translation: Array) -> Array:
    """The 4 x 4 matrix that takes a to R a + t."""
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = rotation, translation
    return matrix


def travel(start: Array, steps: Sequence[tuple[Array, Array]]) -> Array:
    """Poses (n + 1, 4, 4) sensor to world: from the first, on by the relative poses b = R a + t."""
    poses = [start]
    for rotation, translation in steps:
        poses.append(poses[-1] @ np.linalg.inv(rigid(rotation, translation)))
    return np.array(poses)


def errors(poses: Sequence[Array] | Array, truth: Sequence[Array] | Array) -> tuple[Array, Array]:
    """(n,) distances in the unit of the poses (n, 4, 4), and (n,) angles in degrees, from the truth."""
    off = [np.linalg.inv(true) @ pose for pose, true in zip(poses, truth, strict=True)]
    distance = np.array([np.linalg.norm(one[:3, 3]) for one in off])
    return distance, np.rad2deg([angle_of(one[:3, :3]) for one in off])


def path_of(truth: Array) -> Array:
    """(n,) length of the way to each of the poses (n, 4, 4)."""
    steps = np.linalg.norm(np.diff(truth[:, :3, 3], axis=0), axis=1)
    return np.insert(steps.cumsum(), 0, 0.0)


def relative(poses: Array) -> Array:
    """(n - 1, 4, 4): each pose (n, 4, 4) as seen from the one before."""
    return np.linalg.inv(poses[:-1]) @ poses[1:]
