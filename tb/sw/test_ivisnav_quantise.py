# SPDX-License-Identifier: Apache-2.0
"""iVisNav's equations and their integers: Eqs. 3 and 7, whitening, binary points, refusals."""

from __future__ import annotations

import numpy as np
import pytest
from relnav.errors import InputError
from relnav.ivisnav.quantise import equations, metres_per_second, quantise_rows
from relnav.ivisnav.rows import RateFrame, make_rate_frame
from relnav.quantise import INPUT_MAX, INPUT_MIN

F0, DT = 20e6, 0.01


def random_frame(seed: int = 1, n: int = 8, *, sigma: bool = False, w: bool = False) -> RateFrame:
    rng = np.random.default_rng(seed)
    root = rng.normal(size=(n, n)) * 1e-3
    return make_rate_frame(
        rng.normal(size=(n, 3)),
        rng.normal(size=(n, 3)),
        rng.normal(size=n) * 1e-2,
        rng.uniform(0.1, 3, n) if w else None,
        root @ root.T + np.diag(rng.uniform(1e-7, 1e-6, n)) if sigma else None,
    )


def test_equations_are_the_physics() -> None:
    # a plate 2 m ahead, moving by (v, omega): the range along r^ grows by r^ . (v + omega x p)
    v, omega = np.array([0.1, -0.2, 0.3]), np.array([0.4, 0.5, -0.6])
    frame = random_frame()
    e = equations(frame, F0, DT)
    unit = frame.r / np.linalg.norm(frame.r, axis=1)[:, None]
    rates = np.sum(unit * (v + np.cross(omega, frame.p)), axis=1)
    np.testing.assert_allclose(e.h @ np.concatenate((v, omega)), rates, rtol=1e-14, atol=1e-15)
    # half a modulation wavelength further, and the phase has gone through 2 pi
    assert metres_per_second(F0, DT) * 2 * np.pi * DT == pytest.approx(299792458.0 / F0 / 2, rel=1e-15)
    np.testing.assert_allclose(e.y, frame.dphi * 299792458.0 / (4 * np.pi * F0 * DT), rtol=1e-15)


def test_integers() -> None:
    for seed in range(20):
        frame = random_frame(seed, w=True)
        e, q = equations(frame, F0, DT), quantise_rows(frame, F0, DT)
        for values, integers, frac in ((e.h, q.h, q.frac_h), (e.y, q.y, q.frac_y)):
            assert np.array_equal(integers, np.rint(values * 2.0**frac))
            finer = np.rint(values * 2.0 ** (frac + 1))
            assert integers.min() >= INPUT_MIN and integers.max() <= INPUT_MAX
            assert finer.min() < INPUT_MIN or finer.max() > INPUT_MAX
        assert frame.w is not None
        np.testing.assert_allclose(q.w / q.weight_scale, frame.w, rtol=3e-4)
        assert q.w.max() == 65535
        h, y = q.values()
        assert np.abs(h - e.h).max() <= 2.0 ** -(q.frac_h + 1) and np.abs(y - e.y).max() <= 2.0 ** -(
            q.frac_y + 1
        )


def test_unweighted_rows_weigh_one() -> None:
    q = quantise_rows(random_frame(), F0, DT)
    assert q.w.tolist() == [1] * 8 and q.weight_scale == 1.0 and q.n == 8


def test_still_plate_and_no_rows() -> None:
    frame = random_frame()
    still = make_rate_frame(frame.r, frame.p, np.zeros(8))
    q = quantise_rows(still, F0, DT)
    assert q.frac_y == 0 and not q.y.any()
    assert quantise_rows(make_rate_frame(np.zeros((0, 3)), np.zeros((0, 3)), []), F0, DT).n == 0


def test_whitening_is_the_weight_matrix() -> None:
    frame = random_frame(3, sigma=True)
    assert frame.sigma is not None
    plain = equations(make_rate_frame(frame.r, frame.p, frame.dphi), F0, DT)
    white = equations(frame, F0, DT)
    inverse = np.linalg.inv(frame.sigma * metres_per_second(F0, DT) ** 2)
    scale = white.weight_scale
    np.testing.assert_allclose(white.h.T @ white.h / scale, plain.h.T @ inverse @ plain.h, rtol=1e-9)
    np.testing.assert_allclose(white.h.T @ white.y / scale, plain.h.T @ inverse @ plain.y, rtol=1e-9)
    assert np.log2(scale) % 2 == 0 and white.w is None
    q = quantise_rows(frame, F0, DT)
    assert q.w.tolist() == [1] * 8 and q.weight_scale == scale


def test_diagonal_covariance_is_weights() -> None:
    frame = random_frame(4)
    variances = np.array([1.0, 4, 16, 1, 4, 16, 64, 1]) * 1e-8
    white = equations(make_rate_frame(frame.r, frame.p, frame.dphi, sigma=np.diag(variances)), F0, DT)
    plain = equations(frame, F0, DT)
    speed = metres_per_second(F0, DT) * np.sqrt(variances)
    np.testing.assert_allclose(white.h, plain.h * (np.sqrt(white.weight_scale) / speed)[:, None], rtol=1e-12)


@pytest.mark.parametrize(
    ("f0", "dt", "message"),
    [
        (0.0, DT, "f0 = 0.0 is not a finite number > 0"),
        (-1.0, DT, "f0 = -1.0 is"),
        (float("nan"), DT, "f0 = nan is"),
        (F0, float("inf"), "dt = inf is"),
        (F0, -0.0, "dt = -0.0 is"),
        (1e-300, 1e-300, "leave double's range"),
        (1e300, 1e300, "leave double's range"),
    ],
)
def test_refused_settings(f0: float, dt: float, message: str) -> None:
    with pytest.raises(InputError, match=message):
        quantise_rows(random_frame(), f0, dt)


@pytest.mark.parametrize(
    ("p", "dphi", "message"),
    [
        (1e30, 1.0, r"row 3 .*: \(p x r\)[xyz] = .* is too large: no binary point from -64 to 95"),
        (1.7e308, 1.0, r"row 3 .* leaves double's range in p x r"),
        (1.0, 1e30, r"row 3 .*: dphi = 1e\+30: its range rate .* m/s is too large"),
        (1.0, 1e-30, r"row 3 .*: dphi = 1e-30: its range rate .* too small: binary point 95"),
        (1.0, 1e308, r"row 3 .*: dphi = 1e\+308 leaves double's range"),
    ],
)
def test_refused_values(p: float, dphi: float, message: str) -> None:
    places, phases = np.zeros((8, 3)), np.zeros(8)
    places[2], phases[2] = [p, -p, p], dphi
    with pytest.raises(InputError, match=message):
        quantise_rows(make_rate_frame(np.ones((8, 3)), places, phases), F0, DT)


def test_refused_weights_and_covariances() -> None:
    frame = random_frame()
    w = np.ones(8)
    w[5] = 1e-9
    with pytest.raises(InputError, match=r"row 6 .* would round to 0"):
        quantise_rows(make_rate_frame(frame.r, frame.p, frame.dphi, w), F0, DT)
    tiny = make_rate_frame(frame.r, frame.p, frame.dphi, sigma=np.eye(8) * 5e-324)
    with pytest.raises(InputError, match="sigma leaves double's range"):
        quantise_rows(tiny, 1e200, 1.0)
