# SPDX-License-Identifier: Apache-2.0
"""What goes to the iVisNav core and what comes back; the bit-exact model against exact numbers."""

from __future__ import annotations

import sys
from types import SimpleNamespace

import numpy as np
import pytest
from relnav.errors import BackendError, InputError
from relnav.ivisnav import exact
from relnav.ivisnav.backends import solve_rates
from relnav.ivisnav.beacons import alternate_ring, radial_ring, table_ii, turned_ring
from relnav.ivisnav.quantise import QuantisedRows, metres_per_second, quantise_rows
from relnav.ivisnav.raw import RawRates
from relnav.ivisnav.rows import RateFrame, make_rate_frame
from relnav.model.raw import float_to_word

F0, DT = 20e6, 0.01
FACTOR = metres_per_second(F0, DT)
EMPTY = make_rate_frame(np.zeros((0, 3)), np.zeros((0, 3)), [], name="none")


def frame_of(beacons: object, distance: float, x: np.ndarray, **more: object) -> RateFrame:
    assert hasattr(beacons, "matrix")
    y = beacons.matrix(distance) @ x
    return make_rate_frame(beacons.directions, beacons.displacements(distance), y / FACTOR, **more)


def frames(*names: str | int) -> list[RateFrame]:
    rng = np.random.default_rng(1)
    return [frame_of(alternate_ring(0.5), 2.0, rng.normal(size=6), name=name) for name in names]


def answer(rows: QuantisedRows, variance: float) -> RawRates:
    words = (*(float_to_word(float(k)) for k in range(6)), float_to_word(variance), *(0,) * 21)
    return RawRates(n=rows.n, used=rows.n, words=words)


def run_rate_frames(
    rows: list[QuantisedRows],
    simulator: str,
    *,
    variance: float = 0.0,
    rtl_dir: object = None,
    waves: object = None,
) -> list[RawRates]:
    return [answer(each, variance) for each in rows]


@pytest.mark.parametrize("backend", ["fixed", "icarus"])
def test_frames_in_order_without_the_empty_one(monkeypatch: pytest.MonkeyPatch, backend: str) -> None:
    core = SimpleNamespace(RatesCore=lambda: SimpleNamespace(run=answer))
    monkeypatch.setitem(sys.modules, "relnav.model.rates_core", core)
    monkeypatch.setitem(sys.modules, "relnav.rtlsim", SimpleNamespace(run_rate_frames=run_rate_frames))
    one, two = frames(1, 2)
    first, none, second = solve_rates([one, EMPTY, two], backend, f0=F0, dt=DT, sigma=1e-3)
    assert (first.frame, none.frame, second.frame) == (1, "none", 2)
    assert none.flags == ("FEW_ROWS",) and none.n == 0
    assert second.v is not None and second.v.tolist() == [0, 1, 2]
    # the variance of y, in (m/s)^2, is what the core is given
    assert second.rss == pytest.approx((1e-3 * FACTOR) ** 2, rel=1e-6)


def test_refusals_are_the_same_everywhere(monkeypatch: pytest.MonkeyPatch) -> None:
    good = frames(0)
    huge = make_rate_frame(good[0].r, good[0].p * 1e30, good[0].dphi)
    covariance = make_rate_frame(good[0].r, good[0].p, good[0].dphi, sigma=np.eye(6))
    for backend in ("double", "fixed"):
        with pytest.raises(InputError, match="no binary point"):
            solve_rates([huge], backend, f0=F0, dt=DT)
        for sigma in (0.0, -1.0, float("nan")):
            with pytest.raises(InputError, match=r"sigma = .* is not a finite number > 0"):
                solve_rates(good, backend, f0=F0, dt=DT, sigma=sigma)
        with pytest.raises(InputError, match="binary32"):
            solve_rates(good, backend, f0=F0, dt=DT, sigma=1e-30)
        with pytest.raises(InputError, match="excludes a sigma at unit weight"):
            solve_rates([covariance], backend, f0=F0, dt=DT, sigma=1e-3)
    with pytest.raises(BackendError, match="no backend 'abacus'"):
        solve_rates(good, "abacus", f0=F0, dt=DT)
    with pytest.raises(BackendError, match="needs a simulator"):
        solve_rates(good, "fixed", f0=F0, dt=DT, rtl_dir="rtl")
    with pytest.raises(BackendError, match="no such RTL directory"):
        solve_rates(good, "icarus", f0=F0, dt=DT, rtl_dir="nowhere")
    monkeypatch.setitem(sys.modules, "relnav.rtlsim", SimpleNamespace(run_rate_frames=lambda *_, **__: []))
    with pytest.raises(BackendError, match="0 results for 1 frames"):
        solve_rates(good, "verilator", f0=F0, dt=DT)


def test_model_flags_what_double_flags() -> None:
    good = frame_of(alternate_ring(0.5), 2.0, np.ones(6))
    cases = [
        good,
        EMPTY,
        make_rate_frame(good.r[:5], good.p[:5], good.dphi[:5]),
        make_rate_frame(good.r, good.p, good.dphi, np.zeros(6)),
        make_rate_frame(good.r, good.p, good.dphi, [1, 1, 1, 1, 1, 0]),
        frame_of(table_ii(), 2.0, np.zeros(6)),
        frame_of(radial_ring(0.5), 2.0, np.zeros(6)),
        frame_of(turned_ring(0.15), 2.0, np.ones(6)),
        frame_of(turned_ring(0.15), 5.0, np.ones(6)),
    ]
    one, two = (solve_rates(cases, backend, f0=F0, dt=DT) for backend in ("double", "fixed"))
    # pivots of a singular matrix are noise in binary32, not always too small for a bad one's
    singular = {"RANK_DEFICIENT": "ILL_CONDITIONED"}
    for double, fixed in zip(one, two, strict=True):
        assert fixed.flags in (double.flags, tuple(singular.get(flag, "") for flag in double.flags))
    assert {flag for r in one for flag in r.flags} == {
        "FEW_ROWS", "ZERO_WEIGHT", "RANK_DEFICIENT", "ILL_CONDITIONED",
    }  # fmt: skip
    for double, fixed in zip(one, two, strict=True):
        if double.condition is not None and fixed.condition is not None:
            assert fixed.condition == pytest.approx(double.condition, rel=0.3)


@pytest.mark.parametrize("ring", [alternate_ring, turned_ring])
def test_model_within_the_bound(ring: object) -> None:
    assert callable(ring)
    rng = np.random.default_rng(1)
    for radius in (0.15, 0.5, 1.0):
        for distance in (1.0, 2.0, 5.0):
            x = np.array([0, 0, rng.uniform(0.05, 0.2), 0, 0, rng.uniform(0.05, 0.3)])
            frame = frame_of(ring(radius), distance, x)
            (result,) = solve_rates([frame], f0=F0, dt=DT)
            if result.flags:
                assert result.flags == ("ILL_CONDITIONED",)
                assert np.linalg.cond(ring(radius).matrix(distance)) > 2000
                continue
            assert result.v is not None and result.omega is not None
            truth = exact.solve(quantise_rows(frame, F0, DT)).floats()
            error = np.abs(np.concatenate((result.v, result.omega)) - truth)
            assert (error[:3] <= 1e-5 * abs(x[2])).all() and (error[3:] <= 1e-5 * abs(x[5])).all()


def test_model_gives_doubles_covariance() -> None:
    rng = np.random.default_rng(3)
    frame = frame_of(alternate_ring(0.5, count=10), 2.0, rng.normal(size=6))
    noisy = frame.dphi + 1e-6 * rng.normal(size=10)
    root = 1e-6 * (np.eye(10) + 0.1 * rng.normal(size=(10, 10)))
    weighted = make_rate_frame(frame.r, frame.p, noisy, rng.uniform(0.5, 2, 10))
    whitened = make_rate_frame(frame.r, frame.p, noisy, sigma=root @ root.T)
    for each, sigma in ((weighted, None), (weighted, 1e-6), (whitened, None)):
        one, two = (solve_rates([each], b, f0=F0, dt=DT, sigma=sigma)[0] for b in ("double", "fixed"))
        assert one.cov is not None and two.cov is not None and one.rss is not None and two.rss is not None
        size = np.sqrt(np.outer(np.diag(one.cov), np.diag(one.cov)))
        assert (np.abs(two.cov - one.cov) <= 1e-3 * size).all()
        assert two.rss == pytest.approx(one.rss, rel=1e-3)
