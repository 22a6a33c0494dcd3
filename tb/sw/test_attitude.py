# SPDX-License-Identifier: Apache-2.0
"""Attitude conversions: the paper's convention, and 180 degrees."""

from __future__ import annotations

import numpy as np
import pytest
from relnav.attitude import (
    IDENTITY,
    TURN_SIGNS,
    angle_of,
    cayley,
    quaternion_of,
    rotation_of,
    skew,
    turn_back,
)

RNG = np.random.default_rng(1)


def test_convention_positive_q3_turns_by_a_negative_angle_about_z() -> None:
    rotation = cayley(np.array([0.0, 0.0, np.tan(np.radians(30.0) / 2)]))
    np.testing.assert_allclose(
        rotation @ [1.0, 0.0, 0.0], [np.cos(np.radians(30)), -np.sin(np.radians(30)), 0.0], atol=1e-15
    )


def test_cayley_is_equation_3() -> None:
    q = RNG.normal(size=3)
    expected = np.linalg.inv(IDENTITY + skew(q)) @ (IDENTITY - skew(q))
    np.testing.assert_allclose(cayley(q), expected, atol=1e-14)
    np.testing.assert_allclose(rotation_of(-3.0, -3.0 * q), expected, atol=1e-14)


@pytest.mark.parametrize("degrees", [0.0, 1e-9, 1.0, 90.0, 120.0, 179.999999, 180.0])
@pytest.mark.parametrize("axis", [(1, 0, 0), (0, -1, 0), (0, 0, 1), (1, 1, 0), (1, -2, 3), (-1, 0, 1)])
def test_quaternion_at_every_angle(degrees: float, axis: tuple[int, int, int]) -> None:
    half = np.radians(degrees) / 2
    direction = np.array(axis) / np.linalg.norm(axis)
    rotation = rotation_of(
        np.cos(half), -np.sin(half) * direction
    )  # R's own quaternion has the vector's other sign
    for given, tolerance in ((rotation, 1e-15), (rotation.astype(np.float32).astype(float), 2e-7)):
        quaternion = quaternion_of(given)
        assert quaternion[0] >= 0
        assert abs(np.linalg.norm(quaternion) - 1) < 1e-15
        expected = np.array([np.cos(half), *np.sin(half) * direction])
        if degrees == 180.0:  # either sign
            expected *= np.sign(expected @ quaternion)
        np.testing.assert_allclose(quaternion, expected, atol=tolerance)
    assert angle_of(rotation) == pytest.approx(2 * half, abs=1e-14)


@pytest.mark.parametrize("turn", range(4))
def test_turn_back_is_a_product_with_the_turn(turn: int) -> None:
    scalar, vector = 0.3, RNG.normal(size=3)
    back = rotation_of(*turn_back(turn, scalar, vector))
    np.testing.assert_allclose(back, rotation_of(scalar, vector) * np.array(TURN_SIGNS[turn]), atol=1e-15)
