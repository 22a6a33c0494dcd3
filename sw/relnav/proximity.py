# SPDX-License-Identifier: Apache-2.0
"""The iVisNav paper's bench-top manoeuvre, end to end: beams, phases, rates, report."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Protocol

import numpy as np
from tqdm import tqdm

from .attitude import FloatArray
from .backends import check_backend, installed_simulator, solve
from .checkout import ROOT
from .errors import BackendError
from .frames import Frame
from .ivisnav.backends import solve_rates
from .ivisnav.beacons import alternate_ring
from .ivisnav.camera import Camera, PlatePose, image_indices
from .ivisnav.comparison import (
    CameraRun,
    RateSolutions,
    Run,
    Sweep,
    exact_rates,
    explicit_rates,
    paper_rates,
    sweep,
    sweep_frames,
)
from .ivisnav.phase import Manoeuvre, TimeOfFlight, observe
from .ivisnav.result import RatesResult
from .ivisnav.rows import RateFrame
from .report.files import make_folder, progress, refuse_file
from .report.key_table import key_table
from .report.page import solver_name
from .report.rates import FIGURES, verdict, write_rates_report
from .result import PoseResult

AREA = ROOT / "syn" / "results.json"
EXIT_DIFFERENT = 1
SENSOR = TimeOfFlight(f0=20e6, dt=0.01, noise=1e-6)
RING_RADIUS = 0.5


class Solvers(Protocol):
    """What computes rates and poses."""

    def rates(
        self, frames: Sequence[RateFrame], backend: str, sensor: TimeOfFlight, rtl: Path | None
    ) -> list[RatesResult]:
        """Rates of the frames, in order."""

    def poses(self, frames: Sequence[Frame], backend: str, rtl: Path | None) -> list[PoseResult]:
        """Poses of the images, in order."""


class Backends:
    """The real ones."""

    def rates(
        self, frames: Sequence[RateFrame], backend: str, sensor: TimeOfFlight, rtl: Path | None
    ) -> list[RatesResult]:
        """See Solvers."""
        sigma = sensor.difference_sigma
        return solve_rates(frames, backend, f0=sensor.f0, dt=sensor.dt, sigma=sigma, rtl_dir=rtl)

    def poses(self, frames: Sequence[Frame], backend: str, rtl: Path | None) -> list[PoseResult]:
        """See Solvers."""
        return solve(frames, backend, rtl_dir=rtl)


def run_proximity(
    frames: int = 100,
    backend: str | None = None,
    out: Path | None = None,
    camera: bool = False,
    rtl: Path | None = None,
    *,
    seed: int = 1,
    solvers: Solvers | None = None,
    quiet: bool = False,
) -> int:
    """Fly, solve, compare, report.

    Args:
        frames: intervals over the manoeuvre. backend: None for a simulator that is installed.
        out: folder of the report, default ``out/proximity``. rtl: another copy of the RTL.
        camera: solve again with projections from the OLTAE core's poses.
        seed: of every noise. solvers: in place of the backends, for tests. quiet: no progress bar.

    Returns:
        0; 1 when RTL and model differ or the numerical bound is broken (never for a 3-sigma exceedance).

    Raises:
        InputError, BackendError: one line; nothing has been written.
    """
    out = Path("out") / "proximity" if out is None else out
    backend = backend or installed_simulator()
    solvers = solvers or Backends()
    check_backend(backend, rtl)
    refuse_file(out)
    make_folder(out)
    kinds = list(dict.fromkeys([backend, "fixed", "double"]))
    with progress(len(kinds) + 3 + (4 if camera else 0) + FIGURES, quiet) as bar:
        run = fly(frames, seed)
        results: dict[str, list[RatesResult]] = {}
        for kind in kinds:
            bar.set_description_str(f"rates: {kind}", refresh=False)
            results[kind] = solvers.rates(run.frames, kind, run.sensor, rtl if kind == backend else None)
            bar.update()
        bar.set_description_str("rates: exact, Q15.16", refresh=False)
        solved = RateSolutions(
            run,
            backend,
            results[backend],
            results["fixed"],
            results["double"],
            exact_rates(run.frames, run.sensor),
            paper_rates(run.frames, run.sensor),
            explicit_rates(run.frames, run.sensor),
            _sweep(run, solvers),
        )
        bar.update(3)
        if camera:
            solved = replace(solved, camera=_with_camera(run, backend, solvers, rtl, bar))
        bar.set_description_str("drawing", refresh=False)
        rows = write_rates_report(solved, out, area=AREA, step=bar.update)
        bar.set_description_str("done")
    print(key_table(f"Proximity manoeuvre: {len(run.samples)} frames by {solver_name(backend)}", rows))
    for problem in solved.differences[:5]:
        print(f"  differs from the model: {problem}")
    print(f"\n{'PASS' if solved.passed else 'FAIL'}: {verdict(solved)}\nReport: {out / 'report.html'}")
    return 0 if solved.passed else EXIT_DIFFERENT


def fly(frames: int, seed: int, sensor: TimeOfFlight = SENSOR) -> Run:
    """The manoeuvre's phases; intervals spread evenly over it."""
    beacons, manoeuvre = alternate_ring(RING_RADIUS), Manoeuvre()
    times = manoeuvre.duration * (np.arange(frames) + 0.5) / frames
    samples = observe(beacons, sensor, manoeuvre, times.tolist(), np.random.default_rng(seed))
    return Run(beacons, sensor, manoeuvre, samples, seed)


def _sweep(run: Run, solvers: Solvers) -> Sweep:
    frames, condition = sweep_frames(run.sensor, np.random.default_rng(run.seed + 2))
    return sweep(frames, condition, solvers.rates(frames, "fixed", run.sensor, None), run.sensor)


def _with_camera(run: Run, backend: str, solvers: Solvers, rtl: Path | None, bar: tqdm[None]) -> CameraRun:
    """The same phases, projections from the camera.

    Each frame needs the rates of the one before, which would be a simulation a frame. The bit-exact model
    carries the pose on instead; that the RTL's bits are the same is then checked on all frames at once.
    """
    camera, rng = Camera(), np.random.default_rng(run.seed + 1)
    images = image_indices(run.samples, camera)
    bar.set_description_str(f"poses: {backend}", refresh=False)
    photographs = [camera.photograph(run.samples[k], rng) for k in images]
    poses = dict(zip(images, solvers.poses(photographs, backend, rtl), strict=True))
    bar.update()
    bar.set_description_str("carrying the pose on", refresh=False)
    propagator = "double" if backend == "double" else "fixed"
    frames: list[RateFrame] = []
    model: list[RatesResult] = []
    offsets: list[FloatArray] = []
    plate: PlatePose | None = None
    for k, sample in enumerate(run.samples):
        if plate is not None:
            v, omega = _expected(model[-2:])
            plate = plate.moved(v, omega, sample.time - run.samples[k - 1].time)
        pose = poses.get(k)
        if pose is not None and pose.R is not None and pose.t is not None:
            plate = PlatePose(pose.R, pose.t)
        if plate is None:
            raise BackendError("the camera's first image gave no pose")
        offsets.append(plate.t - [0.0, 0.0, sample.distance])
        frames.append(replace(sample.frame, p=plate.displacements(run.beacons)))
        model += solvers.rates(frames[-1:], propagator, run.sensor, None)
    bar.update()
    bar.set_description_str(f"rates with camera: {backend}", refresh=False)
    core = model if backend == propagator else solvers.rates(frames, backend, run.sensor, rtl)
    bar.update()
    true = [sample.frame.p for sample in run.samples]
    error = [np.linalg.norm(one.p - other, axis=1).max() for one, other in zip(frames, true, strict=True)]
    return CameraRun(
        camera,
        frames,
        core,
        model,
        np.array(error),
        np.array(offsets),
        images,
        sorted({flag for pose in poses.values() for flag in pose.flags}),
        [pose.cycles["pose"] for pose in poses.values() if pose.cycles],
    )


def _expected(last: Sequence[RatesResult]) -> tuple[FloatArray, FloatArray]:
    """Rates half a frame after the last, on the line through the last two; those that failed are left out."""
    known = [(r.v, r.omega) for r in last if r.v is not None and r.omega is not None]
    if not known:
        return np.zeros(3), np.zeros(3)
    (v, omega), (v_before, omega_before) = known[-1], known[0]
    return 1.5 * v - 0.5 * v_before, 1.5 * omega - 0.5 * omega_before
