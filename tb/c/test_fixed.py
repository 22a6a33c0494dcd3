# SPDX-License-Identifier: Apache-2.0
"""The C driver's conversions against the Python package's: every integer, scale, row and error."""

from __future__ import annotations

import functools
import math
import random
import re
import struct
from collections.abc import Callable
from ctypes import byref, c_double, c_int, c_int32, c_uint32
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from relnav.driver import beats_of
from relnav.errors import InputError
from relnav.frames import make_frame
from relnav.ivisnav.driver import beats_of as row_beats_of
from relnav.ivisnav.quantise import Equations, equations, metres_per_second, quantise_rows
from relnav.ivisnav.rows import make_rate_frame
from relnav.model.raw import variance_word
from relnav.quantise import FRAC_MAX, FRAC_MIN, WEIGHT_MAX, quantise

from scripts.c_build import DRIVER
from tb.c.library import ERRORS, CDriver, frame

Floats = NDArray[np.float64]

TINY, LARGE = 5e-324, 1.7976931348623157e308
CORNERS = [
    *(0.0, -0.0, 1.0, -1.0, 0.5, -0.5, 1.5, 2.5, -2.5, TINY, -TINY, 2.0**-1022, LARGE, -LARGE),
    *(sign * (2.0**31 + offset) for sign in (1, -1) for offset in (-1.5, -1, -0.75, -0.5, -0.25, 0, 0.5, 1)),
    *(sign * 2.0**power for sign in (1, -1) for power in (-128, -97, -96, -95, -64, 30, 63, 94, 95, 96)),
    *(math.nextafter(2.0**exponent, 0.0) for exponent in (-72, -71, 0, 31, 32, 95)),
]
REASONS = {
    "too large: no binary point": "TOO_LARGE",
    "too small: binary point": "TOO_SMALL",
    "largest weight, too small": "SMALL_WEIGHTS",
    "would round to 0": "LOST_WEIGHT",
}


def wanted(make: Callable[[], Any]) -> tuple[str, Any, int]:
    """(error as the C driver names it, what came out, row) of the Python package."""
    try:
        return "OK", make(), 0
    except InputError as error:
        row = re.search(r"\brow (\d+)", str(error))
        assert row, error
        return next(name for part, name in REASONS.items() if part in str(error)), None, int(row[1]) - 1


def test_constants() -> None:
    text = (DRIVER / "relnav_fixed.h").read_text()
    for name, value in {"FRAC_MIN": FRAC_MIN, "FRAC_MAX": FRAC_MAX, "WEIGHT_MAX": WEIGHT_MAX}.items():
        assert re.search(rf"RELNAV_{name} = {value}\b", text), name


def test_every_error_has_its_own_text(driver: CDriver) -> None:
    texts = [driver.relnav_error_text(number) for number in range(len(ERRORS) - 1)]
    assert all(texts) and len(set(texts)) == len(texts)
    for number in (-1, len(ERRORS) - 1, 10**6):
        assert driver.relnav_error_text(number) == b"unknown error"


def test_the_readme_tells_every_error(driver: CDriver) -> None:
    section = (DRIVER / "README.md").read_text().partition("\n## Errors\n")[2].partition("\n## ")[0]
    rows = [line.strip("| ").split(" | ") for line in section.splitlines() if line.startswith("| ")]
    texts = [driver.relnav_error_text(number).decode() for number in range(len(ERRORS) - 1)]
    assert [row[:2] for row in rows[1:]] == [list(pair) for pair in zip(ERRORS[:-1], texts, strict=True)]
    assert all(len(row) == 3 for row in rows)


# -------------------------------------------------------------------------------------------------- numbers


def fixed(driver: CDriver, value: float, frac: int) -> tuple[str, int]:
    found = c_int32(0)
    return driver.relnav_to_fixed(c_double(value), frac, byref(found)), found.value


def test_one_number(driver: CDriver) -> None:
    rng = random.Random(1)
    values = CORNERS + [math.ldexp(rng.uniform(-1, 1), rng.randint(-160, 160)) for _ in range(2000)]
    values += [(rng.getrandbits(33) - 2**32) / 2.0 for _ in range(1000)]  # ties
    for value in values:
        near = 31 - math.frexp(value)[1]
        for frac in (0, -64, 95, -1, near, near - 1, near + 1, near - 31, near - 33):
            scaled = np.rint(np.ldexp(value, frac)) if math.frexp(value)[1] + frac < 1024 else math.inf
            fits = -(2.0**31) <= scaled <= 2.0**31 - 1
            expected = ("OK", int(scaled)) if fits else ("TOO_LARGE", 0)
            if not FRAC_MIN <= frac <= FRAC_MAX:
                expected = ("BAD_FRAC", 0)
            assert fixed(driver, value, frac) == expected, (value, frac)
    for value in (math.nan, math.inf, -math.inf):
        assert fixed(driver, value, 0) == ("NOT_FINITE", 0)


def test_square_root(driver: CDriver) -> None:
    rng = random.Random(2)
    values = [abs(value) for value in CORNERS] + [math.inf, 2.0**-1074 * 3, 2.0**52 - 1, 2.0**53 - 1]
    values += [struct.unpack("<d", struct.pack("<Q", rng.getrandbits(63)))[0] for _ in range(5000)]
    values += [float(root) ** 2 * (1 + step * 2.0**-52) for root in range(1, 300) for step in (-1, 0, 1)]
    for value in values:
        if not math.isnan(value):
            assert driver.relnav_sqrt(c_double(value)) == math.sqrt(value), value
    for value in (-1.0, -0.0, math.nan, -math.inf):
        assert driver.relnav_sqrt(c_double(value)) == 0.0


def test_variance(driver: CDriver) -> None:
    rng = random.Random(3)
    limits = [
        2.0**-126,
        2.0**-126 - 2.0**-150,
        2.0**128 - 2.0**103,
        2.0**128 - 2.0**104,
        0.0,
        -0.0,
        1.0,
        -1.0,
    ]
    near = [math.nextafter(value, toward) for value in limits for toward in (-math.inf, math.inf)]
    drawn = [math.ldexp(rng.random(), rng.randint(-140, 140)) for _ in range(2000)]
    for variance in [*limits, *near, *drawn, TINY, LARGE, math.nan, math.inf]:
        for scale in (1.0, 2.0**-40, 65535 / 7.3, 2.0**900):
            word = c_uint32(7)
            found = driver.relnav_variance_word(c_double(variance), c_double(scale), byref(word))
            try:
                expected = ("OK", variance_word(variance, scale))
            except InputError:
                expected = ("BAD_VARIANCE", 7)
            assert (found, word.value) == expected, (variance, scale)


# --------------------------------------------------------------------------------------------------- points


def check_points(driver: CDriver, a: Any, b: Any, w: Any = None) -> str:
    """The frame by both; returns the error's name."""
    made = frame("oltae", a, b, w)
    error, scale, row = driver.choose("oltae", made)
    expected, quantised, at = wanted(lambda: quantise(make_frame(a, b, w)))
    assert error == expected
    if error != "OK":
        assert row == at
        return error
    assert (scale.frac, bool(scale.weighted)) == (quantised.frac, w is not None)
    assert scale.weight_scale == quantised.weight_scale
    assert driver.fill("oltae", made, scale) == beats_of(quantised)
    return "OK"


def spread(rng: np.random.Generator, shape: tuple[int, ...], lowest: int, highest: int) -> Floats:
    """Numbers of both signs whose exponents lie anywhere between."""
    return np.ldexp(rng.uniform(-1, 1, shape), rng.integers(lowest, highest + 1, shape))


@pytest.mark.parametrize("kind", [np.float64, np.float32])
def test_points(driver: CDriver, kind: type[np.floating[Any]]) -> None:
    rng = np.random.default_rng(4)
    errors: set[str] = set()
    ranges = [(0, 0), (-3, 3), (-60, 60), (-100, -70), (90, 100), (-75, -69), (-126, 126)]
    for lowest, highest in ranges:
        for _ in range(60):
            a, b = (spread(rng, (int(rng.integers(1, 9)), 3), lowest, highest).astype(kind) for _ in "ab")
            n = min(len(a), len(b))
            errors.add(check_points(driver, a[:n], b[:n]))
    assert errors == {"OK", "TOO_LARGE", "TOO_SMALL"}


def test_points_at_the_limits(driver: CDriver) -> None:
    rng = random.Random(5)
    for value in CORNERS:
        check_points(driver, [[value] * 3], [[value] * 3])  # all equal
        check_points(driver, [[0, 0, 0], [value, 1, -1]], [[0, 0, 0], [3, -value, TINY]])
    for exponent in range(-70, 100):
        for mantissa in (1, 2**31 - 1, 2**32 - 1, 2**33 - 1, 2**53 - 1, 2**31 - 0.5, -(2**31), -0.5 - 2**31):
            value = math.ldexp(mantissa, exponent - 40)
            check_points(driver, [[value, 0, rng.random()]], [[0, rng.uniform(-1, 1), -value / 3]])


def test_points_that_are_none(driver: CDriver) -> None:
    for bad in (math.nan, math.inf, -math.inf):
        for place in range(6):
            values = np.arange(18.0).reshape(3, 6)
            values[1, place] = values[2, 5] = bad
            made = frame("oltae", values[:, :3].copy(), values[:, 3:].copy())
            error, _, row = driver.choose("oltae", made)
            assert (error, row) == ("NOT_FINITE", 1)
    empty = frame("oltae", np.zeros((0, 3)), np.zeros((0, 3)))
    assert driver.choose("oltae", empty)[0] == "EMPTY"
    long = frame("oltae", np.zeros((65536, 3)), np.zeros((65536, 3)))
    assert driver.choose("oltae", long)[0] == "TOO_LONG"
    long.count = 65535
    assert driver.choose("oltae", long)[0] == "OK"


def test_chosen_binary_point(driver: CDriver) -> None:
    made = frame("oltae", [[1.0, -2.0, 0.3]], [[0.0, 3.5, 2.5]])
    for frac in (-64, -1, 0, 1, 29):
        error, scale, _ = driver.choose("oltae", made, frac)
        assert error == "OK" and scale.frac == frac
        scaled = np.rint(np.ldexp([1.0, -2.0, 0.3, 0.0, 3.5, 2.5], frac)).astype(np.int64) & 0xFFFFFFFF
        assert driver.fill("oltae", made, scale) == [int(scaled[k] | scaled[k + 3] << 32) for k in range(3)]
    for frac, error in ((30, "TOO_LARGE"), (95, "TOO_LARGE"), (96, "BAD_FRAC"), (-65, "BAD_FRAC")):
        assert driver.choose("oltae", made, frac)[0] == error


# -------------------------------------------------------------------------------------------------- weights


def test_weights(driver: CDriver) -> None:
    rng = np.random.default_rng(6)
    cloud = rng.normal(size=(12, 3))
    draws: list[Floats] = [
        np.arange(12.0),
        np.full(12, 65535.0),
        np.full(12, 65536.0),
        np.full(12, -0.0),
        np.array([98304.0, 0.25, *[1.0] * 10]),
        np.array([65535.5, *[2.0] * 11]),
        np.full(12, LARGE),
        np.full(12, 2.0**-900),
        np.full(12, math.nextafter(2.0**-900, 0)),
        np.full(12, TINY),
        np.array([LARGE, TINY, *[LARGE] * 10]),
        np.array([1.0, 2.0**-17, *[1.0] * 10]),
        np.array([1.0, math.nextafter(0.5 / 65535, 0), *[1.0] * 10]),
        np.array([1.0, math.nextafter(0.5 / 65535, 1), *[1.0] * 10]),
        np.array([65535.0, 0.5, *[1.0] * 10]),
        np.array([65535.0, 1.5, *[1.0] * 10]),
    ]
    for _ in range(400):
        exponents = rng.integers(0, int(rng.choice([1, 8, 15, 18])), 12)
        draws.append(np.ldexp(rng.uniform(0.5, 1, 12), exponents + int(rng.integers(-890, 900))))
        draws.append(np.ldexp(rng.integers(1, 300, 12).astype(float), int(rng.integers(-30, 30))))
    errors = {check_points(driver, cloud, cloud[::-1].copy(), weights) for weights in draws}
    errors |= {check_points(driver, cloud, cloud, np.float32(weights)) for weights in draws[:4]}
    assert errors == {"OK", "SMALL_WEIGHTS", "LOST_WEIGHT"}
    for bad in (-1.0, -TINY, math.nan, math.inf):
        weights = np.ones(12)
        weights[7] = bad
        error, _, row = driver.choose("oltae", frame("oltae", cloud, cloud, weights))
        assert (error, row) == ("BAD_WEIGHT", 7)


# ----------------------------------------------------------------------------------------------------- rows


def test_rows_from_beams(driver: CDriver) -> None:
    """h and y of the driver's own, and their integers, are the Python package's."""
    rng = np.random.default_rng(7)
    errors: set[str] = set()
    for round_number in range(200):
        n = int(rng.integers(1, 12))
        wide = 110 if round_number % 4 == 0 else 3
        beams = make_rate_frame(
            spread(rng, (n, 3), -wide, wide),
            spread(rng, (n, 3), -wide, wide),
            spread(rng, (n,), -wide, wide) if round_number % 7 else np.zeros(n),
            rng.uniform(0.1, 9, n) if round_number % 2 else None,
        )
        f0, dt = float(rng.uniform(1e6, 1e8)), float(rng.uniform(1e-4, 1))
        factor = driver.ivisnav_metres_per_second(c_double(f0), c_double(dt))
        assert factor == metres_per_second(f0, dt)
        made: Equations = equations(beams, f0, dt)
        h = np.empty((n, 6))
        for row in range(n):
            assert driver.ivisnav_row(beams.r[row].ctypes, beams.p[row].ctypes, h[row].ctypes) == "OK"
        assert np.array_equal(h, made.h)
        rows = frame("ivisnav", h, factor * beams.dphi, beams.w)
        error, scale, at = driver.choose("ivisnav", rows)
        expected, quantised, place = wanted(functools.partial(quantise_rows, beams, f0, dt))
        errors.add(error)
        assert error == expected
        if error != "OK":
            assert at == place
            continue
        assert (scale.frac_h, scale.frac_y) == (quantised.frac_h, quantised.frac_y)
        assert scale.weight_scale == quantised.weight_scale
        assert driver.fill("ivisnav", rows, scale) == row_beats_of(quantised)
    assert "OK" in errors and len(errors) > 1


def test_rows_that_are_none(driver: CDriver) -> None:
    h, one = np.empty(6), np.ones(3)
    for r, p, error in (
        ((0, -0.0, 0), one, "ZERO_DIRECTION"),
        ((math.nan, 1, 0), one, "NOT_FINITE"),
        ((1, math.inf, 0), one, "NOT_FINITE"),
        ((1, 1, 0), (1, math.nan, 1), "NOT_FINITE"),
        ((1, -1, 0), (LARGE, LARGE, 0), "NOT_FINITE"),
        ((TINY, 0, 0), one, "OK"),
        ((LARGE, LARGE, LARGE), one, "OK"),
    ):
        assert driver.ivisnav_row(np.array(r, float).ctypes, np.array(p, float).ctypes, h.ctypes) == error, r
    for place in range(8):
        values = np.arange(24.0).reshape(3, 8)
        values[1, place] = math.nan
        made = frame("ivisnav", values[:, :6].copy(), values[:, 6].copy(), values[:, 7].copy())
        error, _, row = driver.choose("ivisnav", made)
        assert (error, row) == ("BAD_WEIGHT" if place == 7 else "NOT_FINITE", 1)
    plain = frame("ivisnav", np.eye(6), np.ones(6))
    for points, error in (
        ((30, 0), "OK"),
        ((31, 0), "TOO_LARGE"),
        ((0, 31), "TOO_LARGE"),
        ((0, 96), "BAD_FRAC"),
    ):
        assert driver.choose("ivisnav", plain, *points)[0] == error
    assert driver.choose("ivisnav", frame("ivisnav", np.zeros((0, 6)), np.zeros(0)))[0] == "EMPTY"
    for value, error in ((2.0**100, "TOO_LARGE"), (2.0**-90, "TOO_SMALL")):
        y = np.zeros(6)
        y[2] = value
        assert driver.choose("ivisnav", frame("ivisnav", np.eye(6), y))[::2] == (error, 2)
        assert (
            driver.choose("ivisnav", frame("ivisnav", np.eye(6)[[5, 0, 1, 2, 3, 4]] * value, y))[0] == error
        )
    many = frame("ivisnav", np.zeros((65536, 6)), np.zeros(65536))
    assert driver.choose("ivisnav", many)[0] == "TOO_LONG"


def test_words_to_numbers(driver: CDriver) -> None:
    rng = random.Random(8)
    for word in [0, 1, 0x80000000, 0x3F800000, 0x7F800000, *(rng.getrandbits(32) for _ in range(200))]:
        found = driver.relnav_float(c_uint32(word))
        expected = struct.unpack("<f", struct.pack("<I", word))[0]
        assert found == expected or (math.isnan(found) and math.isnan(expected))
        assert driver.relnav_finite(byref(c_uint32(word)), 1) == int(math.isfinite(expected))
    assert c_int(driver.relnav_finite(None, 0)).value == 1
