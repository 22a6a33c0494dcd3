# SPDX-License-Identifier: Apache-2.0
"""The quantiser: the finest binary point that fits, weights, and what it refuses."""

from __future__ import annotations

import numpy as np
import pytest
from relnav.errors import InputError
from relnav.frames import make_frame
from relnav.quantise import INPUT_MAX, INPUT_MIN, QuantisedFrame, quantise


def frame_of(largest: float, *others: float, w: list[float] | None = None) -> QuantisedFrame:
    values = np.zeros(9)
    values[: 1 + len(others)] = largest, *others
    return quantise(make_frame(values.reshape(3, 3), np.zeros((3, 3)), w))


@pytest.mark.parametrize(
    ("value", "frac"),
    [
        (1.0, 30),
        (-1.0, 31),  # -2^31 is a 32-bit number, 2^31 is not
        (1.0 - 2.0**-31, 31),
        (1.0 - 2.0**-33, 30),  # would round up to 2^31
        (float(INPUT_MAX), 0),
        (float(INPUT_MIN), 0),
        (2.0**31 - 0.5, -1),
        (2.0**-65, 95),
        (2.0**-70, 95),
        (2.0**94, -64),
        (-(2.0**95), -64),
        (0.0, 0),
    ],
)
def test_finest_binary_point(value: float, frac: int) -> None:
    quantised = frame_of(value)
    assert quantised.frac == frac
    assert quantised.a[0, 0] == np.rint(value * 2.0**frac)


def test_finest_for_random_values() -> None:
    rng = np.random.default_rng(1)
    for exponent in rng.uniform(-60, 90, 300):
        values = rng.uniform(-1, 1, (6, 3)) * 2.0**exponent
        quantised = quantise(make_frame(values[:3], values[3:]))
        both = np.vstack((quantised.a, quantised.b))
        assert both.min() >= INPUT_MIN and both.max() <= INPUT_MAX
        finer = np.rint(np.ldexp(values, quantised.frac + 1))
        assert quantised.frac == 95 or finer.min() < INPUT_MIN or finer.max() > INPUT_MAX
        assert np.abs(np.vstack(quantised.values()) - values).max() <= 2.0 ** -(quantised.frac + 1)


@pytest.mark.parametrize("value", [2.0**95, 1e30, -1e308, 2.0**95 - 2.0**63 / 4])
def test_too_large(value: float) -> None:
    with pytest.raises(
        InputError, match=r"^frame 0: row 2 \(index 1\): ax = .* no binary point from -64 to 95"
    ):
        frame_of(0.0, 0.0, 0.0, value)


@pytest.mark.parametrize("value", [5e-324, 1e-300, -1e-25])
def test_too_small(value: float) -> None:
    with pytest.raises(InputError, match=r"row 1 .* too small"):
        frame_of(value)


@pytest.mark.parametrize(
    ("w", "integers", "scale"),
    [
        ([0.0, 1.0, 65535.0], [0, 1, 65535], 1.0),
        ([0.0, 0.0, 0.0], [0, 0, 0], 1.0),
        ([0.25, 0.5, 1.0], [8192, 16384, 32768], 32768.0),  # exact: a power of two
        ([98304.0, 65536.0, 0.0], [49152, 32768, 0], 0.5),
        ([65536.0, 1.0, 2.0], [65535, 1, 2], 65535 / 65536),
        ([0.1, 0.2, 0.3], [21845, 43690, 65535], 65535 / 0.3),
        ([1e-5, 1.0, 1.0], [1, 65535, 65535], 65535.0),
        ([1e300, 3e299, 0.0], [65535, 19660, 0], 65535 / 1e300),
        ([1.5e-200, 1e-200, 1e-201], [65535, 43690, 4369], 65535 / 1.5e-200),
    ],
)
def test_weights(w: list[float], integers: list[int], scale: float) -> None:
    quantised = frame_of(1.0, w=w)
    assert quantised.w is not None and quantised.w.tolist() == integers
    assert quantised.weight_scale == pytest.approx(scale, rel=1e-15)


def test_no_weights() -> None:
    quantised = frame_of(1.0)
    assert quantised.w is None and quantised.weight_scale == 1.0


@pytest.mark.parametrize(
    ("w", "reason"),
    [([1.0, 1e-6, 1.0], "row 2 .* would round to 0"), ([1e-300, 0.0, 0.0], "row 1 .* too small to scale")],
)
def test_refused_weights(w: list[float], reason: str) -> None:
    with pytest.raises(InputError, match=reason):
        frame_of(1.0, w=w)
