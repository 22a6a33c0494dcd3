# SPDX-License-Identifier: Apache-2.0
"""The time-of-flight sensor, Eqs. 1-7: ranges, phases, and the phase differences of an interval.

lambda = c / f0 is the wavelength of the MODULATION; c is exact; differences are divided by their interval dt,
which Eqs. 4 and 7-9 leave out. The phase follows the patch of the plate that reflects: it advances by
4 pi / lambda times r^ . (v + omega x rho), Eq. 6. The range to a flat plate alone would not: turning a plate
in its own plane does not change it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..attitude import FloatArray
from .beacons import Beacons
from .quantise import SPEED_OF_LIGHT
from .rows import RateFrame

GAUSS_POINTS, GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(5)


@dataclass(frozen=True)
class TimeOfFlight:
    """Settings of the sensor.

    f0:     modulation frequency, Hz;  dt: interval of a phase difference, s
    noise:  standard deviation of one phase, rad
    bits:   of one phase, a turn being 2^bits steps; None: not rounded
    """

    f0: float = 20e6
    dt: float = 0.01
    noise: float = 0.0
    bits: int | None = None

    @property
    def wavelength(self) -> float:
        """lambda, m."""
        return SPEED_OF_LIGHT / self.f0

    @property
    def difference_sigma(self) -> float:
        """Standard deviation of a phase difference, rad, noise and rounding together."""
        step = 0.0 if self.bits is None else 2.0 * np.pi / 2.0**self.bits
        return float(np.sqrt(2.0 * (self.noise**2 + step**2 / 12.0)))

    def phase(self, ranges: npt.ArrayLike) -> FloatArray:
        """Eq. 1: phi = 4 pi r f0 / c, not wrapped; ranges in m."""
        found: FloatArray = 4.0 * np.pi / self.wavelength * np.asarray(ranges, dtype=np.float64)
        return found

    def record(self, phase: FloatArray, rng: np.random.Generator) -> FloatArray:
        """What the sensor gives for true phases: noise, rounding, wrapped into (-pi, pi]."""
        noisy = phase + self.noise * rng.normal(size=phase.shape)
        if self.bits is not None:
            step = 2.0 * np.pi / 2.0**self.bits
            noisy = step * np.rint(noisy / step)
        return wrap(noisy)


def wrap(phase: npt.ArrayLike) -> FloatArray:
    """The phase in (-pi, pi]."""
    value = np.asarray(phase, dtype=np.float64)
    wrapped: FloatArray = np.pi - np.mod(np.pi - value, 2.0 * np.pi)
    return wrapped


def difference(before: FloatArray, after: FloatArray) -> FloatArray:
    """Phase difference of two wrapped records, unwrapped: right while it is within half a turn."""
    return wrap(after - before)


@dataclass(frozen=True)
class Manoeuvre:
    """The bench-top run: the plate comes along z and turns about z, smoothly, neither rate ever zero.

    duration: s;  distance: of the plate at the start, m
    approach, approach_peak: |v_z| at the ends and in the middle, m/s;  turn, turn_peak: omega_z, rad/s
    """

    duration: float = 10.0
    distance: float = 2.0
    approach: float = 0.02
    approach_peak: float = 0.12
    turn: float = 0.05
    turn_peak: float = 0.30

    def velocity(self, t: npt.ArrayLike) -> FloatArray:
        """v (..., 3) m/s at times t (...): a raised cosine towards the sensor."""
        return _along_z(-self._hump(self.approach, self.approach_peak, t, 1))

    def angular_velocity(self, t: npt.ArrayLike) -> FloatArray:
        """omega (..., 3) rad/s: two such waves in the time of one."""
        return _along_z(self._hump(self.turn, self.turn_peak, t, 2))

    def distance_at(self, t: npt.ArrayLike) -> FloatArray:
        """Distance (...) of the plate, m: the integral of v_z."""
        return np.asarray(self.distance - self._integral(self.approach, self.approach_peak, t, 1))

    def angle_at(self, t: npt.ArrayLike) -> FloatArray:
        """Angle (...) of the plate about z, rad: the integral of omega_z."""
        return np.asarray(self._integral(self.turn, self.turn_peak, t, 2))

    def _hump(self, low: float, peak: float, t: npt.ArrayLike, waves: int) -> FloatArray:
        turns = 2.0 * np.pi * waves / self.duration * np.asarray(t, dtype=np.float64)
        return np.asarray(low + (peak - low) * 0.5 * (1.0 - np.cos(turns)))

    def _integral(self, low: float, peak: float, t: npt.ArrayLike, waves: int) -> FloatArray:
        time, speed = np.asarray(t, dtype=np.float64), 2.0 * np.pi * waves / self.duration
        return np.asarray(low * time + (peak - low) * 0.5 * (time - np.sin(speed * time) / speed))


@dataclass(frozen=True, eq=False)
class Sample:
    """One interval. time: its middle, s; there, v, omega (3,) and the plate's distance, m, and angle, rad."""

    frame: RateFrame
    time: float
    v: FloatArray
    omega: FloatArray
    distance: float
    angle: float


def observe(
    beacons: Beacons,
    sensor: TimeOfFlight,
    manoeuvre: Manoeuvre,
    times: Sequence[float],
    rng: np.random.Generator,
) -> list[Sample]:
    """The rows of each interval around the given middles; rho are the true ones, name is the index."""
    samples = []
    for k, time in enumerate(times):
        before = true_phases(beacons, sensor, manoeuvre, time - sensor.dt / 2)
        advance = sensor.phase(travelled(beacons, manoeuvre, time - sensor.dt / 2, time + sensor.dt / 2))
        records = sensor.record(before, rng), sensor.record(before + advance, rng)
        distance = float(manoeuvre.distance_at(time))
        frame = RateFrame(k, beacons.directions, beacons.displacements(distance), difference(*records))
        v, omega = manoeuvre.velocity(time), manoeuvre.angular_velocity(time)
        samples.append(Sample(frame, time, v, omega, distance, float(manoeuvre.angle_at(time))))
    return samples


def true_phases(beacons: Beacons, sensor: TimeOfFlight, manoeuvre: Manoeuvre, time: float) -> FloatArray:
    """Eq. 1 of the ranges (n,), rad."""
    return sensor.phase(beacons.ranges(float(manoeuvre.distance_at(time))))


def travelled(beacons: Beacons, manoeuvre: Manoeuvre, start: float, end: float) -> FloatArray:
    """The integral (n,) of r^ . (v + omega x rho) from start to end, m, to rounding for smooth motion."""
    half = 0.5 * (end - start)
    total = np.zeros(len(beacons.directions))
    for point, weight in zip(GAUSS_POINTS, GAUSS_WEIGHTS, strict=True):
        t = start + half * (1.0 + point)
        rho = beacons.displacements(float(manoeuvre.distance_at(t)))
        patch = manoeuvre.velocity(t) + np.cross(manoeuvre.angular_velocity(t), rho)
        total += half * weight * np.sum(beacons.unit * patch, axis=1)
    return total


def _along_z(z: FloatArray) -> FloatArray:
    return np.stack((np.zeros_like(z), np.zeros_like(z), z), axis=-1)
