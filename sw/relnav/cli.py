# SPDX-License-Identifier: Apache-2.0
"""The command line. Exit codes: 0 well, 1 RTL and model differ, 2 bad input, 3 a frame has no result."""

from __future__ import annotations

import argparse
import importlib
import json
import math
import os
import sys
import warnings
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NoReturn, TypeVar

from . import __version__
from .backends import BACKENDS, solve
from .checkout import CORES, RTL, copy_rtl, rtl_files
from .errors import BackendError, IgnoredWarning, RelnavError, one_line
from .frames import read_frames
from .ivisnav.backends import solve_rates
from .ivisnav.result import RatesResult
from .ivisnav.rows import read_rate_frames
from .model.raw import CoreConfig
from .result import PoseResult
from .table import pose_table, rates_table

AnyResult = TypeVar("AnyResult", PoseResult, RatesResult)
Frames = TypeVar("Frames")

EXIT_BAD_INPUT = 2
EXIT_NO_RESULT = 3


class _Parser(argparse.ArgumentParser):
    """Errors are one line; `relnav ... --help` has the usage."""

    def error(self, message: str) -> NoReturn:
        self.exit(EXIT_BAD_INPUT, f"{self.prog}: {one_line(message)}\n")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command; returns the exit code."""
    parser = _parser()
    options = parser.parse_args(arguments)
    if sys.stdout is None:
        print("relnav: standard output is closed", file=sys.stderr)
        return EXIT_BAD_INPUT
    try:
        code: int = options.run(options)
        sys.stdout.flush()
        return code
    except RelnavError as error:
        print(f"relnav: {error}", file=sys.stderr)
        return EXIT_BAD_INPUT
    except BrokenPipeError:  # `relnav pose ... | head`: nobody reads on, and nobody is to be told
        _discard_output()
        return 0
    except OSError as error:  # a full disk
        print(f"relnav: the result could not be written: {error.strerror or error}", file=sys.stderr)
        _discard_output()
        return EXIT_BAD_INPUT


def _discard_output() -> None:
    """What is still buffered goes nowhere, so that the interpreter's end has nothing to complain about."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def pose_command(options: argparse.Namespace) -> int:
    """Poses of a file's frames, as a table or as JSON. Prints only when all is solved."""
    config = CoreConfig(
        forbid_turns=options.forbid_turns,
        reapply=options.reapply,
        variance=_variance(options.sigma_a, options.sigma_b),
    )
    results = solve(_read(read_frames, options.file), options.backend, config=config, rtl_dir=options.rtl)
    return _print_results(results, pose_table, options.json)


def rates_command(options: argparse.Namespace) -> int:
    """Rates of a file's frames, as a table or as JSON. Prints only when all is solved."""
    results = solve_rates(
        _read(read_rate_frames, options.file),
        options.backend,
        f0=options.f0,
        dt=options.dt,
        sigma=options.sigma,
        rtl_dir=options.rtl,
    )
    return _print_results(results, rates_table, options.json)


def _read(reader: Callable[[Path], Frames], file: Path) -> Frames:
    """The frames of a file; a line on standard error names columns that are ignored."""
    with warnings.catch_warnings(record=True) as noted:
        warnings.simplefilter("always", IgnoredWarning)
        frames = reader(file)
    for one in noted:
        if issubclass(one.category, IgnoredWarning):
            print(f"relnav: warning: {one_line(one.message)}", file=sys.stderr)
        else:
            warnings.warn_explicit(one.message, one.category, one.filename, one.lineno)
    return frames


def _print_results(
    results: Sequence[AnyResult], table: Callable[[Sequence[AnyResult]], str], as_json: bool
) -> int:
    """The results on standard output, and the exit code they mean."""
    if as_json:
        text = json.dumps({"frames": [result.to_json() for result in results]}, allow_nan=False)
    else:
        text = table(results)
    print(text)
    return EXIT_NO_RESULT if any(result.failed for result in results) else 0


def landing_command(options: argparse.Namespace) -> int:
    """The landing of the paper, sensors to report."""
    code: int = _part("landing").run_landing(
        terrain=options.terrain,
        frames=options.frames,
        backend=options.backend,
        out=options.out,
        images=options.images,
        rtl=options.rtl,
    )
    return code


def proximity_command(options: argparse.Namespace) -> int:
    """The manoeuvre of the iVisNav paper, beams to report."""
    code: int = _part("proximity").run_proximity(
        frames=options.frames,
        backend=options.backend,
        out=options.out,
        camera=options.camera,
        rtl=options.rtl,
    )
    return code


def rtl_command(options: argparse.Namespace) -> int:
    """The Verilog that this installation has: its folder, its files, a copy."""
    if options.core is not None and not options.list:
        raise RelnavError("--core goes with --list")
    if options.copy is not None:
        print(f"{copy_rtl(options.copy)} files in {options.copy}")
        return 0
    files = rtl_files(options.core)
    print("\n".join(map(str, files)) if options.list else RTL)
    return 0


def _part(name: str) -> Any:
    """A command's module, with all it needs, loaded when it is used."""
    try:
        return importlib.import_module(f"relnav.{name}")
    except ImportError as error:
        raise BackendError(f"the {name} cannot be loaded: {error}") from None


def _variance(sigma_a: float | None, sigma_b: float | None) -> float:
    """sigma_a^2 + sigma_b^2; 0, which leaves it to the residuals, only where neither is given."""
    if sigma_a is None and sigma_b is None:
        return 0.0
    variance = (sigma_a or 0.0) ** 2 + (sigma_b or 0.0) ** 2
    if not sigma_a and not sigma_b:
        raise RelnavError("--sigma-a and --sigma-b must not both be 0")
    if variance == 0.0:
        raise RelnavError("--sigma-a and --sigma-b are too small: their squares leave double's range")
    return variance


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(
        prog="relnav",
        description="Relative navigation: poses from matched 3-D points, rates from laser phases.",
    )
    parser.add_argument("--version", action="version", version=f"relnav {__version__}")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")

    pose = commands.add_parser("pose", help="pose of each frame in a CSV or .npz file")
    pose.add_argument(
        "file",
        type=Path,
        metavar="FILE",
        help="CSV with header ax,ay,az,bx,by,bz, or .npz with a, b (n,3); both with optional w, frame",
    )
    _add_backend(pose)
    pose.add_argument("--sigma-a", type=_sigma, metavar="S", help="standard deviation of a at unit weight")
    pose.add_argument("--sigma-b", type=_sigma, metavar="S", help="standard deviation of b at unit weight")
    pose.add_argument(
        "--forbid-turns", action="store_true", help="solve the points as they are, never turned first"
    )
    pose.add_argument("--reapply", action="store_true", help="apply Eq. 25 once more: Wahba's optimum")
    pose.set_defaults(run=pose_command)

    rates = commands.add_parser(
        "rates", help="velocity and angular velocity from phase differences in a file"
    )
    rates.add_argument(
        "file",
        type=Path,
        metavar="FILE",
        help="CSV with header rx,ry,rz,px,py,pz,dphi, or .npz with r, p (n,3), dphi (n,); "
        "both with optional w, frame; .npz also with sigma (n,n)",
    )
    rates.add_argument("--f0", type=float, required=True, metavar="HZ", help="modulation frequency, Hz")
    rates.add_argument("--dt", type=float, required=True, metavar="S", help="interval of dphi, s")
    _add_backend(rates)
    rates.add_argument(
        "--sigma", type=_sigma, metavar="S", help="standard deviation of dphi at unit weight, rad"
    )
    rates.set_defaults(run=rates_command)

    landing = commands.add_parser("landing", help="the paper's landing: terrain, sensors, RTL, report")
    landing.add_argument(
        "--terrain", type=Path, metavar="FILE", help="elevation data, .npz (default: matplotlib's)"
    )
    landing.add_argument(
        "--frames", type=_count, default=25, metavar="N", help="default: %(default)s, one a second"
    )
    landing.add_argument("--backend", choices=BACKENDS, help="default: a simulator that is installed")
    landing.add_argument("--out", type=Path, metavar="DIR", help="where the report goes")
    landing.add_argument(
        "--images",
        choices=("camera", "bearing-angle"),
        default="camera",
        help="camera images, or images made of the point cloud alone (default: %(default)s)",
    )
    landing.add_argument("--rtl", type=Path, metavar="DIR", help="simulate this copy of the RTL")
    landing.set_defaults(run=landing_command)

    proximity = commands.add_parser("proximity", help="the iVisNav paper's manoeuvre: beams, RTL, report")
    proximity.add_argument(
        "--frames", type=_count, default=100, metavar="N", help="intervals, default: %(default)s"
    )
    proximity.add_argument("--backend", choices=BACKENDS, help="default: a simulator that is installed")
    proximity.add_argument("--out", type=Path, metavar="DIR", help="where the report goes")
    proximity.add_argument(
        "--camera", action="store_true", help="projections from the pose of the OLTAE core, besides the true"
    )
    proximity.add_argument("--rtl", type=Path, metavar="DIR", help="simulate this copy of the RTL")
    proximity.set_defaults(run=proximity_command)

    rtl = commands.add_parser("rtl", help="the folder of the cores' Verilog, its files, or a copy of it")
    what = rtl.add_mutually_exclusive_group()
    what.add_argument("--copy", type=Path, metavar="DIR", help="copy it to this new folder")
    what.add_argument("--list", action="store_true", help="list the files, one a line")
    rtl.add_argument("--core", choices=CORES, help="only the modules of this core (with --list)")
    rtl.set_defaults(run=rtl_command)
    return parser


def _add_backend(command: argparse.ArgumentParser) -> None:
    """The options of every command that solves a file's frames."""
    command.add_argument(
        "--backend", choices=BACKENDS, default="fixed", help="default: %(default)s, the bit-exact model"
    )
    command.add_argument(
        "--json", action="store_true", help="one JSON object on standard output instead of a table"
    )
    command.add_argument("--rtl", type=Path, metavar="DIR", help="simulate this copy of the RTL")


def _sigma(text: str) -> float:
    value = float(text)
    if not (math.isfinite(value) and value >= 0.0):
        raise argparse.ArgumentTypeError(f"{text} is not a finite number >= 0")
    return value


# argparse names a type by its __name__ where int() or float() refuses the text
_sigma.__name__ = "number"


def _count(text: str) -> int:
    value = int(text)
    if value < 1:
        raise argparse.ArgumentTypeError(f"{text} is not a whole number >= 1")
    return value


_count.__name__ = "whole number"


if __name__ == "__main__":
    sys.exit(main())
