# SPDX-License-Identifier: Apache-2.0
"""From phases to the equations y = h . (v, omega), and to the integers the core takes."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from ..attitude import FloatArray
from ..errors import InputError
from ..quantise import IntArray, finest_frac, quantise_weights
from .rows import RateFrame, cholesky

SPEED_OF_LIGHT = 299_792_458.0  # m/s, exact; the paper's 2.99e8 would cost 0.27 %


@dataclass(frozen=True, eq=False)
class Equations:
    """One frame as equations y = h x, x = (v, omega), in double.

    h:             (n, 6) rows [r^; p x r^] (1 and m); y: (n,) range rates, m/s
    w:             (n,) weights as given, or None; None after whitening
    weight_scale:  weights of the equations over the user's: 1, or 4^k of a whitened frame, whose user's
                   weight is the inverse of y's covariance, (m/s)^-2
    frame:         where they come from
    """

    h: FloatArray
    y: FloatArray
    w: FloatArray | None
    weight_scale: float
    frame: RateFrame

    @property
    def n(self) -> int:
        """Rows."""
        return len(self.y)


@dataclass(frozen=True, eq=False)
class QuantisedRows:
    """One frame as the core is fed.

    h:             (n, 6) integers of 32 bits; value = integer * 2^-frac_h
    y:             (n,) integers of 32 bits; m/s = integer * 2^-frac_y
    w:             (n,) integers 0..65535
    frac_h, frac_y: binary points, -64..95
    weight_scale:  w = round(weight_scale * the user's weight); the VARIANCE register holds the user's
                   variance of y at unit weight times weight_scale
    name:          the frame's label
    """

    h: IntArray
    y: IntArray
    w: IntArray
    frac_h: int
    frac_y: int
    weight_scale: float = 1.0
    name: str | int = 0

    @property
    def n(self) -> int:
        """Rows in the frame."""
        return len(self.y)

    def values(self) -> tuple[FloatArray, FloatArray]:
        """h (n, 6), y (n,) as floats: what the integers stand for, exact in double."""
        return (
            np.ldexp(self.h.astype(np.float64), -self.frac_h),
            np.ldexp(self.y.astype(np.float64), -self.frac_y),
        )


def is_number(value: object) -> bool:
    """Whether it is one real number that a double can hold."""
    try:
        return isinstance(value, (int, float, np.integer, np.floating)) and isinstance(float(value), float)
    except OverflowError:
        return False


def metres_per_second(f0: float, dt: float) -> float:
    """c / (4 pi f0 dt): range rate of one radian an interval (Eq. 3). f0 in Hz, dt in s.

    Raises InputError for what is not positive and finite.
    """
    for name, value in (("f0", f0), ("dt", dt)):
        if not is_number(value):
            raise InputError(f"{name} = {value!r} is not a number")
        if not (math.isfinite(value) and value > 0.0):
            raise InputError(f"{name} = {value!r} is not a finite number > 0")
    factor = SPEED_OF_LIGHT / (4.0 * math.pi) / f0 / dt
    if not (math.isfinite(factor) and factor > 0.0):
        raise InputError(f"f0 = {f0!r} and dt = {dt!r} leave double's range: c / (4 pi f0 dt) = {factor!r}")
    return factor


def equations(frame: RateFrame, f0: float, dt: float) -> Equations:
    """Eqs. 7 and 3: h = [r^; p x r^], y = c / (4 pi f0) dphi / dt; whitened where there is a covariance.

    f0: modulation frequency, Hz; dt: interval, s. Raises InputError.
    """
    factor = metres_per_second(f0, dt)
    with np.errstate(over="ignore", invalid="ignore"):
        unit = frame.directions()
        h = np.hstack((unit, np.cross(frame.p, unit)))
        y = factor * frame.dphi
        if not np.isfinite(h).all():
            row, column = divmod(int(np.argmin(np.isfinite(h))), 6)
            raise _too_large(frame, row, column)
        if not np.isfinite(y).all():
            raise _too_large(frame, int(np.argmin(np.isfinite(y))), None)
    if frame.sigma is None or not frame.n:
        return Equations(h, y, frame.w, 1.0, frame)
    deviations, factor_c = cholesky(frame)
    speeds = factor * deviations  # y's standard deviations
    largest = float(speeds.max())
    if not (2.0**-500 < largest < 2.0**500 and float(speeds.min()) > 2.0**-500):
        raise InputError(f"{frame.origin}: sigma leaves double's range in (m/s)^2")
    scale = 2.0 ** round(math.log2(largest))  # keeps whitened rows about as large as the others
    rows = np.column_stack((h, y)) * (scale / speeds)[:, None]
    whitened = np.asarray(np.linalg.solve(factor_c, rows), dtype=np.float64)
    return Equations(whitened[:, :6], whitened[:, 6], None, scale * scale, frame)


def quantise_rows(frame: RateFrame, f0: float, dt: float) -> QuantisedRows:
    """The finest binary points that fit 32 bits, one for h and one for y; weights as OLTAE's, 1 without.

    Raises InputError, naming the row, for values that no binary point from -64 to 95 fits and for a positive
    weight that would round to 0.
    """
    return quantise_equations(equations(frame, f0, dt))


def quantise_equations(e: Equations) -> QuantisedRows:
    """The same from the equations. Raises InputError."""
    frame = e.frame
    if e.n == 0:
        return QuantisedRows(
            e.h.astype(np.int64), e.y.astype(np.int64), np.zeros(0, np.int64), 0, 0, 1.0, frame.name
        )

    def refuse_h(reason: str) -> InputError:
        row, column = divmod(int(np.argmax(np.abs(e.h))), 6)
        value = float(e.h[row, column])
        if frame.sigma is not None:
            return frame.error(row, f"the whitened row's {value!r} is {reason}")
        return frame.error(row, f"{_name(column)} = {value!r} is {reason}")

    def refuse_y(reason: str) -> InputError:
        row = int(np.argmax(np.abs(e.y)))
        kind = "range rate" if frame.sigma is None else "whitened range rate"
        return frame.error(
            row, f"dphi = {float(frame.dphi[row])!r}: its {kind} {float(e.y[row])!r} m/s is {reason}"
        )

    frac_h = finest_frac(float(e.h.min()), float(e.h.max()), refuse_h)
    frac_y = finest_frac(float(e.y.min()), float(e.y.max()), refuse_y)
    weights, scale = (None, 1.0) if e.w is None else quantise_weights(frame)
    return QuantisedRows(
        h=np.rint(np.ldexp(e.h, frac_h)).astype(np.int64),
        y=np.rint(np.ldexp(e.y, frac_y)).astype(np.int64),
        w=np.ones(e.n, dtype=np.int64) if weights is None else weights,
        frac_h=frac_h,
        frac_y=frac_y,
        weight_scale=scale * e.weight_scale,
        name=frame.name,
    )


def _name(column: int) -> str:
    return ("rx", "ry", "rz", "(p x r)x", "(p x r)y", "(p x r)z")[column]


def _too_large(frame: RateFrame, row: int, column: int | None) -> InputError:
    if column is None:
        return frame.error(row, f"dphi = {float(frame.dphi[row])!r} leaves double's range in m/s")
    return frame.error(row, f"p = {frame.p[row].tolist()} leaves double's range in p x r")
