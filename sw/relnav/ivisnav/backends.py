# SPDX-License-Identifier: Apache-2.0
"""One entry to everything that can solve a frame's rates: double, bit-exact model, RTL under a simulator."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ..backends import check_backend, part
from ..errors import BackendError, InputError
from ..model.raw import variance_word
from . import golden
from .quantise import QuantisedRows, equations, is_number, metres_per_second, quantise_equations
from .raw import FLAG_BITS, RawRates, raw_to_result
from .result import RatesResult
from .rows import RateFrame


def solve_rates(
    frames: Sequence[RateFrame],
    backend: str = "fixed",
    *,
    f0: float,
    dt: float,
    sigma: float | None = None,
    rtl_dir: str | Path | None = None,
    waves: Path | None = None,
) -> list[RatesResult]:
    """The rates of the frames, in order; on a simulator they run back to back without a reset.

    f0: modulation frequency, Hz; dt: interval of dphi, s; sigma: standard deviation of dphi at unit weight,
    rad (None: rss scales the covariances; a frame's own covariance does where it has one).
    double solves the values as given, the others their quantisation; what has none is refused by all.
    Raises InputError, BackendError.
    """
    check_backend(backend, rtl_dir)
    variance = unit_variance(frames, f0, dt, sigma)
    rows = [equations(frame, f0, dt) for frame in frames]
    quantised = [quantise_equations(e) for e in rows]
    for frame in quantised:
        variance_word(variance, frame.weight_scale)  # refused for all or for none
    if backend == "double":
        return [golden.estimate(e, variance=variance) for e in rows]
    # A frame without rows has no beat that could end it: the core never sees it.
    seen = [frame for frame in quantised if frame.n]
    if backend == "fixed":
        core = part("model.rates_core").RatesCore()
        raws = [core.run(frame, variance) for frame in seen]
    else:
        raws = _simulated(seen, backend, variance, rtl_dir, waves)
    found = iter(raws)
    empty = RawRates(flags=1 << FLAG_BITS["FEW_ROWS"])
    return [raw_to_result(next(found) if q.n else empty, q.name, q) for q in quantised]


def unit_variance(frames: Sequence[RateFrame], f0: float, dt: float, sigma: float | None) -> float:
    """Variance of y at the user's unit weight, (m/s)^2; 0 where the residuals have to tell.

    With a covariance the weights are its inverse, and the variance at unit weight is 1.
    """
    factor = metres_per_second(f0, dt)
    whitened = [frame for frame in frames if frame.sigma is not None]
    if sigma is None:
        return 1.0 if whitened else 0.0
    if not (is_number(sigma) and math.isfinite(sigma) and sigma > 0.0):
        raise InputError(f"sigma = {sigma!r} is not a finite number > 0")
    if whitened:
        raise InputError(f"{whitened[0].origin}: has a covariance, which excludes a sigma at unit weight")
    variance = (factor * sigma) ** 2
    if variance == 0.0:  # which would leave it to the residuals
        raise InputError(f"sigma = {sigma!r} is too small: its square leaves double's range")
    return variance


def _simulated(
    rows: list[QuantisedRows],
    simulator: str,
    variance: float,
    rtl_dir: str | Path | None,
    waves: Path | None,
) -> list[RawRates]:
    run: Any = part("rtlsim").run_rate_frames
    raws: list[RawRates] = run(rows, simulator, variance=variance, rtl_dir=rtl_dir, waves=waves)
    if len(raws) != len(rows):
        raise BackendError(f"{simulator} returned {len(raws)} results for {len(rows)} frames")
    return raws
