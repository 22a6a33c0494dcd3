# SPDX-License-Identifier: Apache-2.0
"""output_scale against exact products: every exponent with every scale, both ends of the range, specials."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import numpy.typing as npt
from relnav.model.rates_engine import scaled_word

from tb.arith.floats import SIGN, UINT32, Words, special_words
from tb.common.replay import run_rows
from tb.common.vectors import to_rows

LATENCY = 1
INFINITY = np.uint32(0x7F800000)
FRACTIONS = np.array([0, 1, 0x400000, 0x7FFFFE, 0x7FFFFF], np.uint32)
EVERY = {"icarus": 61, "verilator": 1}  # of the pairs of exponent and scale far from the ends

Scales = npt.NDArray[np.int64]


def scaled(values: Words, scales: Scales) -> Words:
    """value 2^scale in double, where it is exact, then the ends of binary32's range; elements alike."""
    with np.errstate(all="ignore"):
        exact = np.ldexp(values.view(np.float32).astype(np.float64), np.clip(scales, -600, 600))
        words = exact.astype(np.float32).view(np.uint32)
    sign = values & SIGN
    words = np.where(np.abs(exact) < 2.0**-126, sign, words)
    words = np.where(values & INFINITY == 0, sign, words)
    special = values & INFINITY == INFINITY
    return np.where(special, values, words).astype(np.uint32)


def operands(rng: np.random.Generator, every: int) -> tuple[Words, Scales]:
    """Every `every`-th pair of exponent and scale; all within three of an end; special values."""
    exponent, scale = np.divmod(np.arange(0, 256 * 4096, every), 4096)
    scale = scale - 2048
    ends = np.add.outer(np.array([0, 255]), np.arange(-3, 4)).ravel()  # exponents of results
    near = np.arange(256)
    near_exponent = np.repeat(near, len(ends) * len(FRACTIONS))
    near_scale = np.subtract.outer(ends, near).T.ravel().repeat(len(FRACTIONS))
    near_fraction = np.tile(FRACTIONS, len(near) * len(ends))
    fraction = rng.integers(0, 1 << 23, len(exponent), dtype=np.uint32)
    values = np.concatenate(
        [exponent.astype(np.uint32) << 23 | fraction, near_exponent << 23 | near_fraction]
    )
    special = special_words()
    special_scales = np.array([-2048, -300, -126, -1, 0, 1, 127, 300, 2047])
    values = np.concatenate(
        [values ^ (rng.integers(0, 2, len(values)) << 31), special.repeat(len(special_scales))]
    )
    scales = np.concatenate([scale, near_scale, np.tile(special_scales, len(special))])
    return values.astype(np.uint32), scales.astype(np.int64)


def test_output_scale_is_exact(simulator: str, tmp_path: Path) -> None:
    rng = np.random.default_rng(203)
    values, scales = operands(rng, EVERY[simulator])
    valid = rng.random(len(values)) < 0.98
    stimulus = to_rows(valid.astype(np.uint8), values, scales.astype(np.int16).view(np.uint16))
    depth = 1 << len(stimulus).bit_length()
    top = Path(__file__).parent / "output_scale_replay.v"
    cycle, got = run_rows(top, ["ivisnav"], simulator, tmp_path, stimulus, 56, [UINT32], {"DEPTH": depth})
    assert np.array_equal(cycle, np.flatnonzero(valid) + LATENCY)
    wanted = scaled(values, scales)[valid]
    wrong = np.flatnonzero(got != wanted)
    shown = [(f"{values[valid][n]:08x}", int(scales[valid][n]), f"{got[n]:08x}") for n in wrong[:3]]
    assert not wrong.size, shown


def test_model_is_exact() -> None:
    rng = np.random.default_rng(204)
    values, scales = operands(rng, 61)
    wanted = scaled(values, scales)
    found = [
        scaled_word(value, scale)
        for value, scale in zip(values.view(np.float32), scales.tolist(), strict=True)
    ]
    assert np.array_equal(np.array(found, np.uint32), wanted)
