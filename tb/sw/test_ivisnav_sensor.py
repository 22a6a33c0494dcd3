# SPDX-License-Identifier: Apache-2.0
"""The iVisNav sensor: wrapping, phases of a moving plate, noise, and the camera's projections."""

from __future__ import annotations

import numpy as np
import pytest
from relnav import golden as oltae_golden
from relnav.ivisnav import golden
from relnav.ivisnav.beacons import alternate_ring, turned_ring
from relnav.ivisnav.camera import Camera, PlatePose, about_z, rotation
from relnav.ivisnav.phase import Manoeuvre, TimeOfFlight, difference, observe, travelled, true_phases, wrap
from relnav.ivisnav.quantise import equations

RING = alternate_ring(0.5)
TIMES = np.linspace(0.5, 9.5, 7).tolist()


def test_wrap_is_half_open() -> None:
    values = np.array([0.0, np.pi, -np.pi, 3 * np.pi, 3.5, -3.5, 100.0])
    wrapped = wrap(values)
    assert (wrapped > -np.pi).all() and (wrapped <= np.pi).all()
    assert wrapped[1] == wrapped[2] == np.pi
    np.testing.assert_allclose(np.exp(1j * wrapped), np.exp(1j * values), atol=1e-13)


def test_differences_are_unwrapped_up_to_half_a_turn() -> None:
    rng = np.random.default_rng(1)
    before, step = rng.uniform(-50, 50, 1000), rng.uniform(-3.14, 3.14, 1000)
    np.testing.assert_allclose(difference(wrap(before), wrap(before + step)), step, atol=1e-12)


def test_phase_of_a_range() -> None:
    sensor = TimeOfFlight(f0=20e6)
    assert sensor.wavelength == pytest.approx(14.9896229)
    assert sensor.phase(sensor.wavelength / 2) == pytest.approx(2 * np.pi)  # there and back
    assert true_phases(RING, sensor, Manoeuvre(), 0.0) == pytest.approx(sensor.phase(2.0 * np.hypot(1, 0.25)))


def test_motion_is_the_integral_of_its_rates() -> None:
    move = Manoeuvre()
    t = np.linspace(0.0, move.duration, 20001)
    v, omega = move.velocity(t), move.angular_velocity(t)
    assert not v[:, :2].any() and not omega[:, :2].any()
    assert v[:, 2].max() < -0.01 and omega[:, 2].min() > 0.01  # a relative error needs a rate
    mean = np.diff(move.distance_at(t)) / np.diff(t)
    np.testing.assert_allclose(mean, 0.5 * (v[1:, 2] + v[:-1, 2]), atol=1e-7)
    mean = np.diff(move.angle_at(t)) / np.diff(t)
    np.testing.assert_allclose(mean, 0.5 * (omega[1:, 2] + omega[:-1, 2]), atol=1e-7)


def test_patches_move_as_a_rigid_body() -> None:
    """A patch of the plate, carried by the true motion for a very short time, gives the phase's advance."""
    move, dt = Manoeuvre(), 1e-4
    for beacons in (RING, turned_ring(0.5)):
        for t in TIMES:
            here = float(move.distance_at(t - dt / 2))
            patch = beacons.displacements(here)
            turned = patch @ about_z(float(move.angle_at(t + dt / 2) - move.angle_at(t - dt / 2))).T
            moved = turned + [0.0, 0.0, float(move.distance_at(t + dt / 2))] - patch - [0.0, 0.0, here]
            along = np.sum(beacons.unit * moved, axis=1)
            size = np.abs(along).max()
            np.testing.assert_allclose(
                travelled(beacons, move, t - dt / 2, t + dt / 2), along, atol=1e-3 * size
            )


def test_rates_of_a_noiseless_run() -> None:
    sensor = TimeOfFlight()
    for sample in observe(RING, sensor, Manoeuvre(), TIMES, np.random.default_rng(1)):
        result = golden.estimate(equations(sample.frame, sensor.f0, sensor.dt))
        assert result.v is not None and result.omega is not None
        # what is left is the change of the rates within the interval
        np.testing.assert_allclose(result.v, sample.v, atol=3e-5 * abs(sample.v[2]))
        np.testing.assert_allclose(result.omega, sample.omega, atol=3e-5 * abs(sample.omega[2]))


@pytest.mark.parametrize(
    "sensor", [TimeOfFlight(noise=1e-5), TimeOfFlight(bits=18), TimeOfFlight(noise=1e-5, bits=16)]
)
def test_noise_has_the_size_it_says(sensor: TimeOfFlight) -> None:
    rng = np.random.default_rng(2)
    phases, step = rng.uniform(-50, 50, 20000), rng.uniform(-1, 1, 20000)
    error = difference(sensor.record(phases, rng), sensor.record(phases + step, rng)) - step
    assert np.std(error) == pytest.approx(sensor.difference_sigma, rel=0.03)


# ---- camera


def test_projections_of_the_true_pose_are_the_true_ones() -> None:
    for distance in (0.7, 2.0):
        pose = PlatePose(about_z(0.7), np.array([0.0, 0.0, distance]))
        np.testing.assert_allclose(pose.displacements(RING), RING.displacements(distance), atol=1e-15)
    tilted = PlatePose(rotation(np.array([0.1, -0.2, 0.3])), np.array([0.05, 0.02, 1.5]))
    rho = tilted.displacements(RING)
    np.testing.assert_allclose(rho @ tilted.R[:, 2], 0.0, atol=1e-15)  # on the plate
    np.testing.assert_allclose(
        np.cross(rho + tilted.t - RING.origins, RING.unit), 0.0, atol=1e-15
    )  # on the beam


def test_rotation_and_its_motion() -> None:
    np.testing.assert_allclose(about_z(np.pi / 2) @ [1, 0, 0], [0, 1, 0], atol=1e-15)
    omega, v = np.array([0.1, 0.2, -0.3]), np.array([1.0, 0.0, 0.0])
    pose = PlatePose(np.eye(3), np.zeros(3)).moved(v, omega, 2.0).moved(v, -omega, 2.0)
    np.testing.assert_allclose(pose.R, np.eye(3), atol=1e-15)
    np.testing.assert_allclose(pose.t, [4.0, 0, 0])
    assert np.array_equal(rotation(np.zeros(3)), np.eye(3))


def test_the_camera_sees_the_pose() -> None:
    camera = Camera(noise=1e-9)
    (sample,) = observe(RING, TimeOfFlight(), Manoeuvre(), [3.0], np.random.default_rng(1))
    frame = camera.photograph(sample, np.random.default_rng(2))
    result = oltae_golden.estimate(frame.a, frame.b)
    assert result.R is not None and result.t is not None and not result.failed
    np.testing.assert_allclose(result.R, about_z(sample.angle), atol=1e-8)
    np.testing.assert_allclose(result.t, [0.0, 0.0, sample.distance], atol=1e-8)
