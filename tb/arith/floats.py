# SPDX-License-Identifier: Apache-2.0
"""Operand pairs of the binary32 benches, as arrays of 32-bit words, and the comparison with the model."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import numpy.typing as npt
from relnav.model.float32 import Floats

from tb.common.replay import run_rows
from tb.common.vectors import to_rows

Words = npt.NDArray[np.uint32]
Pairs = tuple[Words, Words]
Operation = Callable[[Floats, Floats, bool], Floats]

SIGN = np.uint32(0x80000000)
UINT32 = np.dtype(np.uint32)


def special_words() -> Words:
    """Zeros, denormals, ends of the range, NaNs, powers of two and their neighbours."""
    words = [0, 1, 2, 3, 0x400000, 0x7FFFFE, 0x7FFFFF, 0x800000, 0x800001, 0xFFFFFF, 0x1000000, 0x1000001]
    words += [0x7F7FFFFF, 0x7F7FFFFE, 0x7F000000, 0x7EFFFFFF, 0x7F800000]  # the largest, infinity
    words += [0x7FC00000, 0x7FFFFFFF, 0x7F800001, 0x7FBFFFFF]  # quiet and signalling NaN
    for exponent in (-125, -64, -24, -1, 0, 1, 23, 63, 126):
        one = (exponent + 127) << 23
        words += [one - 1, one, one + 1, one + 0x400000, one + 0x801]
    unsigned = np.unique(np.array(words, np.uint32))
    return np.concatenate([unsigned, unsigned | SIGN])


def all_pairs(words: Words) -> Pairs:
    """Every word with every word."""
    return np.repeat(words, len(words)), np.tile(words, len(words))


def _float(sign: Words, exponent: npt.NDArray[np.int64], fraction: npt.NDArray[np.int64]) -> Words:
    """Words of fields; exponents are kept in 0..254."""
    word = np.clip(exponent, 0, 254) << 23 | (fraction & 0x7FFFFF)
    return word.astype(np.uint32) | (sign & SIGN)


def _significands(rng: np.random.Generator, count: int) -> npt.NDArray[np.int64]:
    """Fractions: random, a few bits at the top, runs of ones down to the end, near the ends."""
    fraction = rng.integers(0, 1 << 23, count)
    short = rng.integers(0, 23, count)
    kind = rng.integers(0, 6, count)
    fraction = np.where(kind == 1, fraction >> short << short, fraction)
    fraction = np.where(kind == 2, fraction | ((1 << short) - 1), fraction)
    fraction = np.where(kind == 3, fraction >> 18, fraction)
    return np.where(kind == 4, 0x7FFFFF - (fraction >> 18), fraction)


def general_pairs(rng: np.random.Generator, count: int) -> Pairs:
    """In equal parts any exponents, near ones, products or quotients at the ends of the range, small ones."""
    signs = rng.integers(0, 1 << 32, (2, count), dtype=np.uint32)
    x, y = (_significands(rng, count) for _ in range(2))
    one, other = (rng.integers(0, 255, count) for _ in range(2))
    kind = rng.integers(0, 4, count)
    step = np.where(rng.random(count) < 0.5, rng.integers(-2, 3, count), rng.integers(-28, 29, count))
    end = rng.choice([127 - 24, 127, 381, 0, -127, 128], count) + rng.integers(-3, 4, count)
    other = np.where(kind == 1, one + step, other)
    other = np.where(kind == 2, np.where(np.abs(end) < 129, one - end, end - one), other)
    one = np.where(kind == 3, rng.integers(0, 28, count), one)
    other = np.where(kind == 3, rng.integers(0, 28, count), other)
    y = np.where((kind == 1) & (rng.random(count) < 0.4), x + rng.integers(-3, 4, count), y)
    any_bits = rng.integers(0, 1 << 32, (2, count), dtype=np.uint32)
    bits = rng.random(count) < 0.15
    return (
        np.where(bits, any_bits[0], _float(signs[0], one, x)),
        np.where(bits, any_bits[1], _float(signs[1], other, y)),
    )


def _normalised(value: npt.NDArray[np.int64]) -> npt.NDArray[np.int64]:
    """Significands of 24 bits (leading one included) from positive integers below 2^53, cut."""
    mantissa, _ = np.frexp(value.astype(np.float64))
    return np.floor(np.ldexp(mantissa, 24)).astype(np.int64)


def halfway_products(rng: np.random.Generator, count: int) -> Pairs:
    """Products of exactly 25 bits (ties), next to one, and next to 2^-126, where rounding up reaches it."""
    length = rng.integers(1, 25, count)
    x = rng.integers(0, 1 << 24, count) % (1 << length) | 1
    y = rng.integers(0, 1 << 25, count) % (1 << (25 - length)) | 1
    edge = rng.random(count) < 0.3
    x_f = np.where(edge, rng.integers(1 << 23, 1 << 24, count), _normalised(x))
    y_f = np.where(edge, np.minimum(((1 << 47) + x_f // 2) // x_f, (1 << 24) - 1), _normalised(y))
    moved = rng.random(count) < 0.5
    y_f = np.clip(y_f + np.where(moved, rng.integers(-2, 3, count), 0), 1 << 23, (1 << 24) - 1)
    exponent = rng.integers(1, 255, count)
    low, any_total = 127 + rng.integers(-26, 3, count), 254 + rng.integers(-120, 131, count)
    total = np.where(rng.random(count) < 0.5, low, any_total)
    signs = rng.integers(0, 1 << 32, (2, count), dtype=np.uint32)
    return _float(signs[0], exponent, x_f), _float(signs[1], total - exponent, y_f)


def halfway_quotients(rng: np.random.Generator, count: int) -> Pairs:
    """Quotients next to a tie, exact ones, and ones below 2^-126."""
    y = rng.integers(1 << 23, 1 << 24, count)
    y = np.where(rng.random(count) < 0.3, y >> 12 << 12, y)
    x = _normalised((rng.integers(1 << 23, 1 << 24, count) * 2 + 1) * (y >> 1)) + rng.integers(-1, 2, count)
    exact = rng.random(count) < 0.3
    length = rng.integers(1, 24, count)
    short = rng.integers(0, 1 << 24, count) % (1 << length) | 1
    x = np.where(exact, _normalised(short * (rng.integers(0, 1 << 24, count) % (1 << (24 - length)) | 1)), x)
    y = np.where(exact, _normalised(short), y)
    ones = rng.random(count) < 0.05
    x = np.where(ones, (1 << 24) - 1 - rng.integers(0, 2, count), np.clip(x, 1 << 23, (1 << 24) - 1))
    y = np.where(ones, (1 << 23) + rng.integers(0, 2, count), y)
    exponent = rng.integers(1, 255, count)
    high, low = 127 + rng.integers(-27, 3, count), -128 + rng.integers(-3, 4, count)
    near = np.where(rng.random(count) < 0.5, high, low)
    total = np.where(rng.random(count) < 0.5, near, rng.integers(-120, 120, count))
    signs = rng.integers(0, 1 << 32, (2, count), dtype=np.uint32)
    return _float(signs[0], exponent, x), _float(signs[1], exponent + total, y)


def halfway_sums(rng: np.random.Generator, count: int) -> Pairs:
    """The smaller operand ends at half the larger one's last place, or beside; or nearly cancels."""
    x = _significands(rng, count)
    distance = rng.integers(0, 28, count)
    half = 1 << np.clip(distance - 1, 0, 24)
    y = (rng.integers(0, 1 << 24, count) | 1 << 23) // (2 * half) * (2 * half) + half
    y = np.clip(y + rng.integers(-1, 2, count), 1 << 23, (1 << 24) - 1)
    cancel = rng.random(count) < 0.4
    y = np.where(cancel, 2 * x + rng.integers(-9, 10, count), y)
    exponent = np.where(rng.random(count) < 0.3, rng.integers(0, 30, count), rng.integers(0, 255, count))
    signs = rng.integers(0, 1 << 32, (2, count), dtype=np.uint32)
    return _float(signs[0], exponent, x), _float(signs[1], exponent - np.where(cancel, 1, distance), y)


def join(*pairs: Pairs) -> Pairs:
    """Several lots of pairs one after the other."""
    return np.concatenate([x for x, _ in pairs]), np.concatenate([y for _, y in pairs])


def check(name: str, got: Words, x: Words, y: Words, operation: Operation, flush: bool) -> None:
    """Compare results with the model, all bits; the message shows the first that differs."""
    expected = operation(x.view(np.float32), y.view(np.float32), flush).view(np.uint32)
    wrong = np.flatnonzero(got != expected)
    if wrong.size:
        n = wrong[0]
        raise AssertionError(
            f"{name}: {wrong.size} of {got.size} differ, the first: "
            f"{x[n]:08x} {y[n]:08x} gives {got[n]:08x}, not {expected[n]:08x}"
        )


def play_pairs(
    top: Path, simulator: str, folder: Path, pairs: Pairs, control: npt.NDArray[np.uint8], latency: int
) -> tuple[Words, Words]:
    """Play pairs, one a clock, through a wrapper with both builds; some clocks are left out.

    `control` (n,) goes with each pair: bit 0 valid, bits above as the wrapper has them. Returns the results
    of DENORMALS = 0 and 1 of the valid pairs, after checking their cycles.
    """
    x, y = pairs
    stimulus = to_rows(control, x, y)
    depth = 1 << max(10, len(stimulus).bit_length())
    cycle, flushed, gradual = run_rows(
        top, ["arith"], simulator, folder, stimulus, 72, [UINT32, UINT32], {"DEPTH": depth}
    )
    assert np.array_equal(cycle, np.flatnonzero(control & 1) + latency)
    return flushed, gradual
