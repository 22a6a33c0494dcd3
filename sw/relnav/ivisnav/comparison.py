# SPDX-License-Identifier: Apache-2.0
"""One manoeuvre solved every way: core, bit-exact model, double, exact, the paper's arithmetic, truth."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..attitude import FloatArray
from ..comparison import differing_fields
from . import exact, paper_fixed
from .beacons import Beacons, alternate_ring, turned_ring
from .camera import Camera
from .phase import Manoeuvre, Sample, TimeOfFlight
from .quantise import metres_per_second, quantise_rows
from .result import RatesResult
from .rows import RateFrame

BOUND = 1e-5  # relative to the driven channel, for the driven and for the idle
DRIVEN = (2, 5)  # v_z, omega_z
PAPER_SCALES = (1024.0, 1.0)  # of the phase differences before Q15.16: well chosen, and none
SWEEP_RADII, SWEEP_DISTANCES = (0.15, 0.3, 0.5, 1.0), (1.0, 2.0, 3.0, 4.0, 5.0)  # m
CHANNELS = ("v_x", "v_y", "v_z", "omega_x", "omega_y", "omega_z")


@dataclass(frozen=True, eq=False)
class Run:
    """A manoeuvre as flown. sigma: standard deviation of a phase difference, rad."""

    beacons: Beacons
    sensor: TimeOfFlight
    manoeuvre: Manoeuvre
    samples: list[Sample]
    seed: int

    @property
    def frames(self) -> list[RateFrame]:
        """Rows with the true projections."""
        return [sample.frame for sample in self.samples]

    @property
    def times(self) -> FloatArray:
        """(n,) s."""
        return np.array([sample.time for sample in self.samples])

    @property
    def truth(self) -> FloatArray:
        """(n, 6) v, omega in the middle of each interval."""
        return np.array([np.concatenate((sample.v, sample.omega)) for sample in self.samples])


@dataclass(frozen=True, eq=False)
class PaperRates:
    """The paper's arithmetic. x: (n, 6), NaN where a pivot was 0; overflows: frames that saturated."""

    label: str
    x: FloatArray
    overflows: int = 0


@dataclass(frozen=True, eq=False)
class CameraRun:
    """The same phases with projections from the camera's poses.

    Args:
        frames: with those projections. core, model: their rates. error: (n,) m, largest error of a rho.
        offset: (n, 3) m, error of the pose's t, carried on.
        images: frames with an image. pose_flags: of their poses, none when all is well.
        cycles: of the poses to R and t, empty without hardware.
    """

    camera: Camera
    frames: list[RateFrame]
    core: list[RatesResult]
    model: list[RatesResult]
    error: FloatArray
    offset: FloatArray
    images: list[int]
    pose_flags: list[str]
    cycles: list[int]


@dataclass(frozen=True, eq=False)
class Sweep:
    """Geometries from good to bad, noiseless. Errors (n, 2) as of `driven_and_idle`, NaN without rates.

    Args:
        condition: (n,) cond(H). model: the bit-exact model's errors. explicit, paper: see RateSolutions.
    """

    condition: FloatArray
    model: FloatArray
    explicit: FloatArray
    paper: FloatArray


@dataclass(frozen=True, eq=False)
class RateSolutions:
    """Results in the order of the run's samples.

    Args:
        backend: what computed ``core``. model: the bit-exact model's. double: golden model's.
        exact: (n, 6) of the quantised rows, rounded to double. paper: the paper's pipeline at PAPER_SCALES.
        explicit: the paper's order of operations on the core's exact sums.
        sweep: the same over geometries. camera: None without one.
    """

    run: Run
    backend: str
    core: list[RatesResult]
    model: list[RatesResult]
    double: list[RatesResult]
    exact: FloatArray
    paper: list[PaperRates]
    explicit: PaperRates
    sweep: Sweep
    camera: CameraRun | None = None

    @property
    def bit_exact(self) -> bool:
        """Whether the backend is one that has to agree with the model to the bit."""
        return self.backend != "double"

    @property
    def differences(self) -> list[str]:
        """``frame N: field`` for everything in which core and model differ; empty for a double backend."""
        if not self.bit_exact:
            return []
        found = _differences(self.core, self.model, "frame")
        if self.camera is not None:
            found += _differences(self.camera.core, self.camera.model, "camera frame")
        return found

    @property
    def numerical_error(self) -> FloatArray:
        """(n, 6) of the core against exact, each over its vector's driven channel; infinite without rates."""
        error = over_driven(rates(self.core), self.exact)
        return np.where(np.isfinite(error), error, np.inf)

    @property
    def bound_broken(self) -> list[str | int]:
        """Names of the frames beyond the bound."""
        bad = ~(self.numerical_error.max(axis=1) <= BOUND)
        return [result.frame for result, broken in zip(self.core, bad, strict=True) if broken]

    @property
    def passed(self) -> bool:
        """RTL and model agree and the numerical bound holds; 3-sigma exceedances are no failure."""
        return not self.differences and not self.bound_broken

    def percent_errors(self, x: FloatArray) -> FloatArray:
        """(n, 2) Eq. 12 of v_z and omega_z against double, percent."""
        reference = rates(self.double)[:, DRIVEN]
        with np.errstate(divide="ignore", invalid="ignore"):
            found: FloatArray = 100.0 * np.abs(x[:, DRIVEN] - reference) / np.abs(reference)
        return found

    def share_inside(self) -> FloatArray:
        """(6,) share of frames whose error to the truth lies within the core's 3 sigma."""
        inside = np.abs(rates(self.core) - self.run.truth) <= 3.0 * deviations(self.core)
        share: FloatArray = inside.mean(axis=0)
        return share

    def cycles(self, key: str) -> list[int]:
        """Hardware cycles "rates" or "all" of every frame; empty without hardware."""
        return [result.cycles[key] for result in self.core if result.cycles]


def exact_rates(frames: Sequence[RateFrame], sensor: TimeOfFlight) -> FloatArray:
    """(n, 6) exact solutions of the quantised rows."""
    return np.array([exact.solve(quantise_rows(frame, sensor.f0, sensor.dt)).floats() for frame in frames])


def paper_rates(frames: Sequence[RateFrame], sensor: TimeOfFlight) -> list[PaperRates]:
    """The paper's arithmetic at each of PAPER_SCALES."""
    runs = []
    for scale in PAPER_SCALES:
        found = [paper_fixed.solve(frame, sensor.f0, sensor.dt, scale) for frame in frames]
        label = "phases as they are" if scale == 1.0 else f"phases scaled by {scale:g}"
        runs.append(
            PaperRates(
                label, _stack([result.x for result in found]), sum(result.overflow for result in found)
            )
        )
    return runs


def explicit_rates(frames: Sequence[RateFrame], sensor: TimeOfFlight) -> PaperRates:
    """U^-1 D^-1 L^-1 in binary32 on exact sums."""
    rows = [quantise_rows(frame, sensor.f0, sensor.dt) for frame in frames]
    return PaperRates(
        "explicit inverse on exact sums", _stack([paper_fixed.explicit_inverse(each) for each in rows])
    )


def sweep_frames(sensor: TimeOfFlight, rng: np.random.Generator) -> tuple[list[RateFrame], FloatArray]:
    """Frames of SWEEP's geometries at random driven rates, without noise, and cond(H) (n,) of each."""
    frames: list[RateFrame] = []
    conditions: list[float] = []
    for ring in (alternate_ring, turned_ring):
        for radius in SWEEP_RADII:
            for distance in SWEEP_DISTANCES:
                beacons = ring(radius)
                h = beacons.matrix(distance)
                x = np.array([0, 0, -rng.uniform(0.02, 0.12), 0, 0, rng.uniform(0.05, 0.3)])
                dphi = h @ x / metres_per_second(sensor.f0, sensor.dt)
                frames.append(
                    RateFrame(len(frames), beacons.directions, beacons.displacements(distance), dphi)
                )
                conditions.append(float(np.linalg.cond(h)))
    return frames, np.array(conditions)


def sweep(
    frames: Sequence[RateFrame], condition: FloatArray, model: Sequence[RatesResult], sensor: TimeOfFlight
) -> Sweep:
    """The errors of the sweep's frames. model: their rates by the bit-exact model."""
    reference = exact_rates(frames, sensor)

    def errors(x: FloatArray) -> FloatArray:
        return driven_and_idle(over_driven(x, reference))

    paper = _stack([paper_fixed.solve(frame, sensor.f0, sensor.dt, PAPER_SCALES[0]).x for frame in frames])
    return Sweep(condition, errors(rates(model)), errors(explicit_rates(frames, sensor).x), errors(paper))


def over_driven(x: FloatArray, reference: FloatArray) -> FloatArray:
    """(n, 6) errors of x (n, 6), v over the reference's |v_z|, omega over its |omega_z|."""
    error: FloatArray = np.abs(x - reference) / np.repeat(np.abs(reference[:, DRIVEN]), 3, axis=1)
    return error


def driven_and_idle(error: FloatArray) -> FloatArray:
    """(n, 2): the largest of v_z and omega_z, the largest of the other four."""
    return np.column_stack((error[:, DRIVEN].max(axis=1), np.delete(error, DRIVEN, axis=1).max(axis=1)))


def rates(results: Sequence[RatesResult]) -> FloatArray:
    """(n, 6) v, omega, NaN where a frame has none."""
    return _stack(
        [None if r.v is None or r.omega is None else np.concatenate((r.v, r.omega)) for r in results]
    )


def deviations(results: Sequence[RatesResult]) -> FloatArray:
    """(n, 6) standard deviations, NaN where a frame has none."""
    return _stack([None if r.cov is None else np.sqrt(np.maximum(np.diag(r.cov), 0.0)) for r in results])


def _stack(values: Sequence[FloatArray | None]) -> FloatArray:
    missing = np.full(6, np.nan)
    return np.array([missing if value is None else value for value in values])


def _differences(core: Sequence[RatesResult], model: Sequence[RatesResult], noun: str) -> list[str]:
    return [
        f"{noun} {one.frame}: {name}"
        for one, other in zip(core, model, strict=True)
        for name in differing_fields(one, other)
    ]
