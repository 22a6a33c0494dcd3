# SPDX-License-Identifier: Apache-2.0
"""A stand-in for the iVisNav core: exact rates rounded to binary32, with cycle counts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from relnav.attitude import FloatArray
from relnav.backends import SIMULATORS, solve
from relnav.frames import Frame
from relnav.ivisnav.backends import solve_rates
from relnav.ivisnav.phase import TimeOfFlight
from relnav.ivisnav.result import RatesResult
from relnav.ivisnav.rows import RateFrame
from relnav.result import PoseResult


def binary32(values: FloatArray) -> FloatArray:
    return values.astype(np.float32).astype(np.float64)


class Standin:
    """spoil: "bit" or "failed" make the RTL's last frame differ from the model, "bound" makes both wrong."""

    def __init__(self, spoil: str = "") -> None:
        self.spoil = spoil
        self.calls: list[str] = []

    def rates(
        self, frames: Sequence[RateFrame], backend: str, sensor: TimeOfFlight, rtl: Path | None
    ) -> list[RatesResult]:
        self.calls.append(backend)
        sigma = sensor.difference_sigma
        double = solve_rates(frames, "double", f0=sensor.f0, dt=sensor.dt, sigma=sigma)
        if backend == "double":
            return double
        simulated = backend in SIMULATORS
        cycles = {"rates": 343, "all": 512} if simulated else None
        results = []
        for r in double:
            if r.v is None or r.omega is None or r.cov is None:
                results.append(r)
                continue
            v, omega, cov = binary32(r.v), binary32(r.omega), binary32(r.cov)
            results.append(replace(r, v=v, omega=omega, cov=cov, cycles=cycles))
        last = results[-1]
        if last.v is None:
            return results
        if self.spoil == "bit" and simulated:
            results[-1] = replace(last, v=np.nextafter(np.float32(last.v), np.float32(1)).astype(float))
        if self.spoil == "failed" and simulated:
            results[-1] = RatesResult(last.frame, last.n, flags=("WATCHDOG",))
        if self.spoil == "bound":
            results[-1] = replace(last, v=last.v + [2e-5 * last.v[2], 0.0, 0.0])
        return results

    def poses(self, frames: Sequence[Frame], backend: str, rtl: Path | None) -> list[PoseResult]:
        self.calls.append(f"poses: {backend}")
        return solve(frames, "double")
