# SPDX-License-Identifier: Apache-2.0
"""Phase differences along laser beams, from a CSV or .npz file (see relnav.records) or from arrays."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from ..attitude import FloatArray
from ..errors import InputError
from ..records import Layout, Placed, Records, make_records, read_records

BEAMS = Layout(
    {"r": ("rx", "ry", "rz"), "p": ("px", "py", "pz"), "dphi": ("dphi",)}, noun="rows", square="sigma"
)
ASYMMETRY = 1e-9  # of a covariance, relative to the two variances: more is a mistake, not rounding
LEAST_PIVOT = 1e-12  # of the correlation matrix' Cholesky factor, squared


@dataclass(frozen=True, eq=False)
class RateFrame(Placed):
    """Beams of one frame: row i says r_i . (v + omega x p_i) by a phase difference.

    r:       (n, 3) directions from the sensor to the projections, any length but zero
    p:       (n, 3) m, displacements rho of the projections from the plate's centre
    dphi:    (n,) rad per interval
    w:       (n,) weights >= 0, inverse variances up to one factor; None for equal ones
    sigma:   (n, n) rad^2, covariance of dphi, positive definite; excludes w
    source:  the file; rows: (n,) each row's number there (1-based); lines: (n,) its line in a CSV
    """

    name: str | int
    r: FloatArray
    p: FloatArray
    dphi: FloatArray
    w: FloatArray | None = None
    sigma: FloatArray | None = None
    source: str = ""
    rows: npt.NDArray[np.int64] | None = None
    lines: npt.NDArray[np.int64] | None = None

    @property
    def n(self) -> int:
        """Rows of the frame."""
        return len(self.r)

    def directions(self) -> FloatArray:
        """r^ (n, 3), unit; no square leaves double's range."""
        scaled = self.r / np.abs(self.r).max(axis=1, keepdims=True)
        unit: FloatArray = scaled / np.linalg.norm(scaled, axis=1, keepdims=True)
        return unit


def read_rate_frames(path: str | Path) -> list[RateFrame]:
    """The frames of a CSV (header rx,ry,rz,px,py,pz,dphi) or .npz (r, p (n, 3), dphi (n,)).

    Both with optional w, frame; an .npz also with sigma (n, n), zero between rows of different frames.
    Raises InputError, one line, for anything that is not such a file.
    """
    return [_frame(records) for records in read_records(path, BEAMS)]


def make_rate_frame(
    r: npt.ArrayLike,
    p: npt.ArrayLike,
    dphi: npt.ArrayLike,
    w: npt.ArrayLike | None = None,
    sigma: npt.ArrayLike | None = None,
    name: str | int = 0,
) -> RateFrame:
    """A checked RateFrame from arrays (n, 3), (n, 3), (n,), optional (n,) and (n, n). Raises InputError."""
    return _frame(make_records(BEAMS, {"r": r, "p": p, "dphi": dphi}, w, sigma, name))


def _frame(records: Records) -> RateFrame:
    arrays = records.arrays
    frame = RateFrame(
        records.name,
        arrays["r"],
        arrays["p"],
        arrays["dphi"],
        records.w,
        records.square,
        records.source,
        records.rows,
        records.lines,
    )
    zero = np.flatnonzero(~frame.r.any(axis=1))
    if zero.size:
        raise frame.error(int(zero[0]), "the direction rx, ry, rz is zero")
    if frame.sigma is not None:
        if frame.w is not None:
            raise InputError(f"{frame.origin}: w and sigma exclude each other: both are weights")
        cholesky(frame)
    return frame


def cholesky(frame: RateFrame) -> tuple[FloatArray, FloatArray]:
    """(d (n,), C (n, n)): sigma = diag(d) C C^T diag(d), d standard deviations in rad, C lower triangular.

    Raises InputError where sigma is not symmetric and positive definite.
    """
    sigma = frame.sigma
    assert sigma is not None
    variances = np.diag(sigma)
    if not (variances > 0.0).all():
        row = int(np.argmin(variances > 0.0))
        raise _refused(frame, f"not positive definite: its variance {row} is {float(variances[row])!r}")
    deviations: FloatArray = np.sqrt(variances)
    with np.errstate(over="ignore"):
        correlation = sigma / deviations[:, None] / deviations
        difference = np.abs(correlation - correlation.T)
    if not (difference <= ASYMMETRY).all():
        i, j = divmod(int(np.argmin(difference <= ASYMMETRY)), frame.n)
        raise _refused(
            frame, f"not symmetric: [{i}, {j}] = {float(sigma[i, j])!r}, [{j}, {i}] = {float(sigma[j, i])!r}"
        )
    try:
        factor = np.linalg.cholesky(0.5 * (correlation + correlation.T))
    except np.linalg.LinAlgError:
        raise _refused(frame, "not positive definite") from None
    if frame.n and float(np.diag(factor).min()) ** 2 < LEAST_PIVOT:
        raise _refused(frame, "not positive definite, to the precision of the numbers given")
    return deviations, np.asarray(factor, dtype=np.float64)


def _refused(frame: RateFrame, reason: str) -> InputError:
    place = f"{frame.source}: frame {frame.name}" if frame.source else f"frame {frame.name}"
    return InputError(f"{place}: sigma is {reason}")
