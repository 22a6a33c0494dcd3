# SPDX-License-Identifier: Apache-2.0
"""One entry to everything that can solve a frame: double, bit-exact integers, RTL under a simulator."""

from __future__ import annotations

import importlib
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from . import golden
from .checkout import ROOT
from .errors import BackendError
from .frames import Frame
from .model.raw import CoreConfig, RawResult, raw_to_pose
from .quantise import QuantisedFrame, quantise
from .result import PoseResult

SIMULATORS = ("icarus", "verilator")
BACKENDS = ("double", "fixed", *SIMULATORS)


def solve(
    frames: Sequence[Frame],
    backend: str = "fixed",
    *,
    config: CoreConfig | None = None,
    rtl_dir: str | Path | None = None,
    waves: Path | None = None,
) -> list[PoseResult]:
    """The poses of the frames, in order; on a simulator they run back to back without a reset.

    double solves the values as given, the others their quantisation; what has none is refused by all.
    waves: where a simulator leaves its waveform (rtlsim.run_frames).
    Raises InputError, BackendError.
    """
    config = config or CoreConfig()
    check_backend(backend, rtl_dir)
    quantised = [quantise(frame) for frame in frames]
    for frame in quantised:
        config.variance_word(frame.weight_scale)  # refused for all or for none
    if backend == "double":
        return [_double(frame, config) for frame in frames]
    # A frame without points has no beat that could end it: the core never sees it.
    seen = [frame for frame in quantised if frame.n]
    if backend == "fixed":
        raws = iter(_fixed(seen, config))
    else:
        raws = iter(_simulated(seen, backend, rtl_dir, config, waves))
    empty = RawResult(flags=1)
    return [raw_to_pose(next(raws) if frame.n else empty, frame.name, frame) for frame in quantised]


def check_backend(backend: str, rtl_dir: str | Path | None) -> None:
    """Raises BackendError for an unknown backend, and for RTL that is not there or that it can't simulate."""
    if backend not in BACKENDS:
        raise BackendError(f"no backend {backend!r}: one of {', '.join(BACKENDS)}")
    if rtl_dir is not None and backend not in SIMULATORS:
        raise BackendError(f"other RTL needs a simulator: backend {' or '.join(SIMULATORS)}, not {backend}")
    if rtl_dir is not None and not Path(rtl_dir).is_dir():
        raise BackendError(f"{rtl_dir}: no such RTL directory")


def _double(frame: Frame, config: CoreConfig) -> PoseResult:
    return golden.estimate(
        frame.a,
        frame.b,
        frame.w,
        forbid_turns=config.forbid_turns,
        reapplied=config.reapply,
        variance=config.variance,
        frame=frame.name,
    )


def _fixed(frames: list[QuantisedFrame], config: CoreConfig) -> list[RawResult]:
    core = part("model.core").OltaeCore()
    return [core.run(frame, config) for frame in frames]


def _simulated(
    frames: list[QuantisedFrame],
    simulator: str,
    rtl_dir: str | Path | None,
    config: CoreConfig,
    waves: Path | None,
) -> list[RawResult]:
    run_frames = part("rtlsim").run_frames
    raws: list[RawResult] = run_frames(frames, simulator, rtl_dir=rtl_dir, config=config, waves=waves)
    if len(raws) != len(frames):
        raise BackendError(f"{simulator} returned {len(raws)} results for {len(frames)} frames")
    return raws


def part(name: str) -> Any:
    """A part of the package that only some backends need, loaded when they do."""
    try:
        return importlib.import_module(f"relnav.{name}")
    except ImportError as error:
        raise BackendError(f"this backend cannot be loaded: {error}") from None


def installed_simulator() -> str:
    """Verilator, which is quick, else Icarus."""
    if not (ROOT / "sim" / "runner.py").is_file():  # the package without its RTL
        return "fixed"
    if str(ROOT) not in sys.path:
        sys.path.append(str(ROOT))
    try:
        from sim.runner import missing
    except ImportError:  # without cocotb
        return "fixed"

    return next((name for name in ("verilator", "icarus") if not missing(name)), "fixed")
