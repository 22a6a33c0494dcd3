# SPDX-License-Identifier: Apache-2.0
"""Terrain, rays, mountings, scans and features against what geometry says."""

from __future__ import annotations

from itertools import pairwise
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray
from relnav.attitude import cayley
from relnav.errors import InputError
from relnav.sensor.bearing_angle import bearing_angle_image, bearing_angles
from relnav.sensor.camera import Camera, Ground, Pinhole
from relnav.sensor.features import View, detect, gate, locate, match
from relnav.sensor.flight import Simulator
from relnav.sensor.lidar import Lidar, surface_of
from relnav.sensor.mounting import CAMERA_MOUNTING, LIDAR_MOUNTING, looking_down, rotation_about
from relnav.sensor.raycast import RayCaster
from relnav.sensor.terrain import Terrain, load_terrain
from relnav.sensor.trajectory import BodyPose, approach, crp_of, relative_pose

Array = NDArray[np.float64]

VESTA = Path(__file__).resolve().parents[3] / "shared" / "data" / "dem_vesta_rheasilvia.npz"
SMALL = Pinhole(96, 72)


def tilted_plane(slope: tuple[float, float] = (0.1, -0.2), height: float = 50.0) -> Terrain:
    axis = np.linspace(-1000.0, 1000.0, 41)
    x, y = np.meshgrid(axis, axis)
    return Terrain("plane", axis, axis, height + slope[0] * x + slope[1] * y)


# ---- terrain


def test_default_terrain_is_in_metres() -> None:
    terrain = load_terrain()
    assert terrain.z.shape == (344, 403)
    assert 25e3 < terrain.span < 40e3
    assert terrain.z.min() == 236.0
    assert terrain.z.max() == 1076.0


@pytest.mark.skipif(not VESTA.is_file(), reason="../shared/data is not here")
def test_vesta_is_read_and_its_holes_are_left_out_of_the_mesh() -> None:
    terrain = load_terrain(VESTA)
    assert terrain.span == 440e3
    vertices, faces = terrain.mesh()
    assert np.isfinite(vertices).all()
    assert len(vertices) == np.isfinite(terrain.z).sum()
    assert faces.max() == len(vertices) - 1


def test_generic_layouts_and_falling_axes(tmp_path: Path) -> None:
    x, y = np.array([0.0, 1.0, 2.0]), np.array([5.0, 4.0])
    z = np.arange(6.0).reshape(2, 3)
    np.savez(tmp_path / "xyz.npz", x=x, y=y, z=z)
    read = load_terrain(tmp_path / "xyz.npz")
    assert np.array_equal(read.y, [4.0, 5.0])
    assert np.array_equal(read.z, z[::-1])
    np.savez(tmp_path / "grid.npz", elevation=z, dx=10.0, dy=20.0)
    read = load_terrain(tmp_path / "grid.npz")
    assert np.array_equal(read.x, [0.0, 10.0, 20.0])
    assert np.array_equal(read.z, z[::-1])  # row 0 is the north edge


@pytest.mark.parametrize(
    ("arrays", "reason"),
    [
        ({"x": [0.0, 1.0], "z": np.zeros((2, 2))}, "'y' is missing"),
        ({"height": np.zeros((2, 2))}, "'elevation' is missing"),
        ({"x": [0.0, 1.0], "y": [0.0, 1.0], "z": np.zeros((2, 3))}, "axes y, x have shapes"),
        ({"x": [0.0, 0.0], "y": [0.0, 1.0], "z": np.zeros((2, 2))}, "not strictly monotonic"),
        ({"x": [0.0, np.nan], "y": [0.0, 1.0], "z": np.zeros((2, 2))}, "not strictly monotonic"),
        ({"x": [0.0, 1.0], "y": [0.0, 1.0], "z": np.full((2, 2), np.nan)}, "less than a quarter"),
        ({"x": [0.0], "y": [0.0], "z": np.zeros((1, 1))}, "at least 2 x 2"),
        ({"x": ["a", "b"], "y": [0.0, 1.0], "z": np.zeros((2, 2))}, "real numbers"),
        ({"elevation": np.zeros(4), "dx": 1.0, "dy": 1.0}, "2-D grid"),
        ({"elevation": np.zeros((2, 2)), "dx": [1.0, 2.0], "dy": 1.0}, "single number"),
        ({"elevation": np.zeros((2, 2)), "dx": 0.0, "dy": 1.0}, "not strictly monotonic"),
        ({"x": [0.0, 1.0], "y": [0.0, 1.0], "z": np.array([[None, 1], [2, 3]])}, "not a readable"),
    ],
)
def test_bad_terrain_is_one_clear_line(arrays: dict[str, object], reason: str, tmp_path: Path) -> None:
    path = tmp_path / "bad.npz"
    np.savez(path, **{key: np.asarray(value) for key, value in arrays.items()})  # type: ignore[arg-type]
    with pytest.raises(InputError) as caught:
        load_terrain(path)
    text = str(caught.value)
    assert text.startswith(f"{path}: ")
    assert reason in text
    assert "\n" not in text


@pytest.mark.parametrize("content", [b"", b"hello", b"PK\x03\x04broken"])
def test_unreadable_terrain(content: bytes, tmp_path: Path) -> None:
    path = tmp_path / "file.npz"
    with pytest.raises(InputError, match="no such terrain file"):
        load_terrain(path)
    path.write_bytes(content)
    with pytest.raises(InputError, match="not a readable"):
        load_terrain(path)


def test_a_bare_array_is_no_terrain(tmp_path: Path) -> None:
    np.save(tmp_path / "one.npy", np.zeros((2, 2)))
    with pytest.raises(InputError, match="single array"):
        load_terrain(tmp_path / "one.npy")


# ---- motion


def test_relative_pose_moves_in_x_and_z_and_turns_about_z() -> None:
    poses = approach(load_terrain(), 5).poses()
    rotation, translation = relative_pose(poses[1], poses[2])
    point = np.array([300.0, -200.0, -5000.0])
    assert np.allclose(
        rotation @ point + translation, poses[2].rotation.T @ (poses[1].to_world(point) - poses[2].position)
    )
    assert translation[0] < 0 < translation[2]
    assert abs(translation[1]) < 1e-9
    q = crp_of(rotation)
    assert np.allclose(cayley(q), rotation)
    assert np.allclose(q, [0.0, 0.0, np.tan(np.deg2rad(1.0))])


def test_every_step_of_a_flight_is_the_same() -> None:
    poses = approach(load_terrain(), 25).poses()
    steps = [relative_pose(a, b) for a, b in pairwise(poses)]
    for rotation, translation in steps:
        assert np.allclose(rotation, steps[0][0])
        assert np.allclose(translation, steps[0][1])


def test_mounting_there_and_back() -> None:
    points = np.random.default_rng(0).normal(size=(10, 3))
    for mounting in (CAMERA_MOUNTING, LIDAR_MOUNTING):
        assert np.allclose(mounting.from_body(mounting.to_body(points)), points)
        assert np.isclose(np.linalg.det(mounting.rotation), 1.0)
    down = looking_down((1.0, 2.0, 3.0), (0.0, 0.0, 0.0))
    assert np.allclose(down.to_body(np.array([0.0, 0.0, 10.0])), [1.0, 2.0, -7.0])
    assert np.allclose(rotation_about(2, np.pi / 2) @ [1.0, 0.0, 0.0], [0.0, 1.0, 0.0])


# ---- rays


def test_rays_meet_a_tilted_plane_where_algebra_says() -> None:
    terrain = tilted_plane()
    origin = np.array([12.3, -45.6, 900.0])
    rng = np.random.default_rng(1)
    directions = np.column_stack([rng.uniform(-0.5, 0.5, (500, 2)), -np.ones(500)])
    distance = RayCaster(terrain).cast(origin, directions)
    normal = np.array([-0.1, 0.2, 1.0])
    expected = (50.0 - normal @ origin) / (directions @ normal)
    assert np.allclose(distance, expected, rtol=1e-12)


def test_rays_that_miss_are_nan() -> None:
    rays = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0]])
    distance = RayCaster(tilted_plane()).cast(np.array([0.0, 0.0, 900.0]), rays)
    assert np.array_equal(np.isnan(distance), [True, True, False])


def test_scan_points_lie_on_the_plane() -> None:
    lidar = Lidar(SMALL, LIDAR_MOUNTING, range_noise=0.0, range_floor=0.0)
    pose = BodyPose(rotation_about(2, 0.7), np.array([10.0, 20.0, 800.0]))
    ranges = lidar.scan(RayCaster(tilted_plane()), pose, np.random.default_rng(0))
    x, y, z = pose.to_world(lidar.points(ranges)).reshape(-1, 3).T
    assert np.allclose(z, 50.0 + 0.1 * x - 0.2 * y, atol=1e-9)


def test_range_noise_is_as_declared_and_seeded() -> None:
    caster, pose = RayCaster(tilted_plane()), BodyPose(np.eye(3), np.array([0.0, 0.0, 800.0]))
    quiet = Lidar(SMALL, LIDAR_MOUNTING, 0.0, 0.0).scan(caster, pose, np.random.default_rng(0))
    noisy = Lidar(SMALL, LIDAR_MOUNTING, 1e-3, 0.0)
    first, again = (noisy.scan(caster, pose, np.random.default_rng(5)) for _ in range(2))
    assert np.array_equal(first, again)
    assert 0.95e-3 < np.std(first / quiet - 1.0) < 1.05e-3


# ---- places between pixels


def test_a_feature_is_located_on_the_plane_to_the_last_digit() -> None:
    lidar = Lidar(SMALL, LIDAR_MOUNTING, 0.0, 0.0)
    pose = BodyPose(np.eye(3), np.array([0.0, 0.0, 800.0]))
    surface = surface_of(lidar, lidar.scan(RayCaster(tilted_plane()), pose, np.random.default_rng(0)))
    uv = np.random.default_rng(2).uniform((5, 5), (90, 66), (200, 2))
    points, variance, good = locate(View(SMALL, CAMERA_MOUNTING, 0.1), lidar.mounting, surface, uv)
    assert good.all()
    x, y, z = pose.to_world(points).T
    assert np.allclose(z, 50.0 + 0.1 * x - 0.2 * y, atol=1e-5)  # 1/depth is exact on a plane
    assert np.allclose(SMALL.project(CAMERA_MOUNTING.from_body(points)), uv, atol=1e-9)
    depth = CAMERA_MOUNTING.from_body(points)[:, 2]
    assert np.allclose(np.sqrt(variance), 0.1 / SMALL.focal * depth)


def test_torn_and_missing_ranges_are_refused() -> None:
    lidar = Lidar(SMALL, LIDAR_MOUNTING, 0.0, 0.0)
    ranges = np.full((72, 96), 1000.0)
    ranges[:, 48:] = 1500.0
    ranges[40, 20] = np.nan
    surface = surface_of(lidar, ranges)
    place = np.array(
        [[20.5, 10.5], [47.5, 10.5], [60.5, 10.5], [19.5, 39.5], [-0.1, 5.0], [95.1, 5.0], [np.nan, 5.0]]
    )
    depth, share, good = surface.at(place)
    assert good.tolist() == [True, False, True, False, False, False, False]
    assert 0.249 < share[0] < 0.251
    assert depth[0] < 1000.0 < depth[2] < 1500.0
    assert surface.at(np.array([[95.0, 71.0]]))[2].all()  # the very corner is inside


# ---- images and features


def test_the_picture_is_seeded_textured_and_fixed_to_the_ground() -> None:
    terrain = load_terrain()
    caster, ground = RayCaster(terrain), Ground(terrain, 1)
    camera = Camera(Pinhole(160, 120), CAMERA_MOUNTING)
    pose = approach(terrain, 3).poses()[0]
    first, again = (camera.image(caster, ground, pose, np.random.default_rng(3)) for _ in range(2))
    assert np.array_equal(first, again)
    assert first.dtype == np.uint8
    assert 50 < first.mean() < 150
    assert first.std() > 15


def test_matches_are_unique_and_mutual() -> None:
    rng = np.random.default_rng(4)
    image = np.clip(rng.normal(128, 40, (30, 40)), 0, 255).astype(np.uint8).repeat(6, 0).repeat(6, 1)
    before, after = detect(image[:, :200], 300), detect(image[:, 12:212], 300)
    assert len(np.unique(before.uv, axis=0)) == len(before.uv)
    pairs = match(before, after)
    assert len(pairs) > 20
    assert len(np.unique(pairs[:, 0])) == len(np.unique(pairs[:, 1])) == len(pairs)
    shift = np.median(after.uv[pairs[:, 1]] - before.uv[pairs[:, 0]], axis=0)
    assert np.allclose(shift, [-12.0, 0.0], atol=0.1)


def test_an_empty_picture_has_no_features() -> None:
    nothing = detect(np.zeros((60, 80), dtype=np.uint8), 100)
    assert len(nothing.uv) == 0
    assert match(nothing, nothing).shape == (0, 2)


@pytest.mark.parametrize("outliers", [0, 10, 40])
def test_gating_finds_the_gross_mismatches(outliers: int) -> None:
    rng = np.random.default_rng(6)
    a = rng.uniform(-100, 100, (100, 3))
    b = a @ rotation_about(2, 0.3).T + [1.0, 2.0, 3.0] + rng.normal(0, 0.01, a.shape)
    b[:outliers] += rng.uniform(5, 50, (outliers, 3))
    kept = gate(a, b, np.full(100, 1e-4), np.random.default_rng(0))
    assert not kept[:outliers].any()
    assert kept[outliers:].mean() > 0.95


def test_gating_leaves_at_least_three() -> None:
    rng = np.random.default_rng(7)
    for n in (3, 4, 5):
        a, b = rng.normal(size=(2, n, 3))
        assert gate(a, b, np.ones(n), np.random.default_rng(0)).sum() >= 3


def test_bearing_angle_of_a_sphere_seen_from_its_centre_is_a_right_angle() -> None:
    lidar = Lidar(SMALL, LIDAR_MOUNTING)
    angle = bearing_angles(lidar, np.full((72, 96), 500.0))
    assert np.allclose(angle[3:-3, 3:-3], np.pi / 2, atol=0.02)
    ranges = np.full((72, 96), 500.0)
    ranges[20:30, 20:30] = np.nan
    image = bearing_angle_image(lidar, ranges)
    assert image.shape == (72, 96)
    assert np.isnan(bearing_angles(lidar, ranges)[22:28, 22:28]).all()


@pytest.mark.parametrize("images", ["camera", "bearing-angle"])
def test_matched_points_of_a_pair_obey_the_true_motion(images: str) -> None:
    simulator = Simulator(load_terrain(), 2, images)
    flight = simulator.collect(list(simulator.fly()))
    (pair,) = flight.pairs
    assert len(pair.frame.a) > 100
    assert pair.frame.w is not None
    assert pair.frame.w.max() == 65535
    residual = pair.frame.b - pair.frame.a @ pair.R.T - pair.t
    sigma = np.sqrt(2.0 * flight.sigma**2 / pair.frame.w)
    assert np.all(np.sqrt(np.mean((residual / sigma[:, None]) ** 2, axis=0)) < 1.3)


def test_impossible_flights_are_refused() -> None:
    with pytest.raises(InputError, match="a relative pose needs two"):
        Simulator(load_terrain(), 1)
    with pytest.raises(InputError, match="images: 'sonar'"):
        Simulator(load_terrain(), 2, "sonar")


def test_ground_without_a_feature_is_refused_with_the_frames_named(monkeypatch: pytest.MonkeyPatch) -> None:
    black = detect(np.zeros((60, 80), dtype=np.uint8), 100)
    monkeypatch.setattr("relnav.sensor.flight.detect", lambda image, limit: black)
    simulator = Simulator(tilted_plane(), 2)
    with pytest.raises(InputError, match=r"frames 0 and 1: only 0 .* a pose needs 3"):
        list(simulator.fly())
