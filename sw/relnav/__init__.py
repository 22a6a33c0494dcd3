# SPDX-License-Identifier: Apache-2.0
"""Relative navigation: pose from matched 3-D points, rates from laser phases.

In double, in the cores' bit-exact arithmetic and in their simulated RTL.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:  # numpy and the rest are loaded by the first call, not by `import relnav`
    from pathlib import Path

    from numpy.typing import ArrayLike

    from .ivisnav.result import RatesResult
    from .result import PoseResult

__version__ = "0.1.0"


def pose(
    a: ArrayLike,
    b: ArrayLike,
    w: ArrayLike | None = None,
    backend: str = "fixed",
    *,
    sigma_a: float | None = None,
    sigma_b: float | None = None,
    forbid_turns: bool = False,
    reapply: bool = False,
    rtl: str | Path | None = None,
) -> PoseResult:
    """The pose b = R a + t of matched points a, b (n, 3), weights w (n,): inverse variances up to one factor.

    backend: "double", "fixed" (the core's arithmetic, bit by bit), "icarus", "verilator" (its RTL).
    sigma_a, sigma_b: standard deviations at unit weight; without them the residuals scale the covariances.
    rtl: simulate this copy of the RTL.
    Check `flags` of the result: a frame that cannot be solved has None for its numbers.
    Raises relnav.errors.InputError, BackendError.
    """
    from .backends import solve
    from .errors import InputError
    from .frames import make_frame
    from .model.raw import CoreConfig

    for name, sigma in (("sigma_a", sigma_a), ("sigma_b", sigma_b)):
        if sigma is not None and not 0.0 <= sigma < float("inf"):
            raise InputError(f"{name} = {sigma!r} is not a finite number >= 0")
    variance = (sigma_a or 0.0) ** 2 + (sigma_b or 0.0) ** 2
    if variance == 0.0 and not (sigma_a is None and sigma_b is None):
        raise InputError("sigma_a and sigma_b must not both be 0")
    config = CoreConfig(forbid_turns=forbid_turns, reapply=reapply, variance=variance)
    return solve([make_frame(a, b, w)], backend, config=config, rtl_dir=rtl)[0]


def rates(
    r: ArrayLike,
    p: ArrayLike,
    dphi: ArrayLike,
    f0: float,
    dt: float,
    w: ArrayLike | None = None,
    *,
    sigma: float | None = None,
    covariance: ArrayLike | None = None,
    backend: str = "fixed",
    rtl: str | Path | None = None,
) -> RatesResult:
    """The rates v, omega that make dphi = 4 pi f0 / c r^ . (v + omega x p) dt of six or more laser beams.

    r (n, 3): directions, any length; p (n, 3): m, where the beams meet the plate, from its centre, same axes.
    dphi (n,): rad per interval; f0: modulation frequency, Hz; dt: interval, s.
    w (n,): weights, inverse variances up to one factor, or covariance (n, n): of dphi, rad^2, not both.
    sigma: standard deviation of dphi at unit weight, rad; without it and without covariance the residuals
    scale cov, which needs more than six rows.
    backend: "double", "fixed" (the core's arithmetic, bit by bit), "icarus", "verilator" (its RTL).
    rtl: simulate this copy of the RTL.
    Check `flags` of the result: a frame that cannot be solved has None for its numbers.
    Raises relnav.errors.InputError, BackendError.
    """
    from .ivisnav.backends import solve_rates
    from .ivisnav.rows import make_rate_frame

    frame = make_rate_frame(r, p, dphi, w, covariance)
    return solve_rates([frame], backend, f0=f0, dt=dt, sigma=sigma, rtl_dir=rtl)[0]
