# SPDX-License-Identifier: Apache-2.0
"""What a frame leaves in the core's registers, and what it means.

Weights. The core counts in integer weights, w = weight_scale * the user's. Its sigma is at unit INTEGER
weight, so VARIANCE is the user's s^2 * weight_scale (the noise of a point, s^2 / w, is then the same).
Covariances are s^2 over weights: with VARIANCE or with rss / (3n - 6), which carries the same factor, they
come out in the user's units and nothing is undone. Undone here: rss and W (one factor each) and det M
(three). All powers of two, hence exact, unless the weights had to be stretched to 65535.
"""

from __future__ import annotations

import math
import struct
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from relnav.attitude import TURN_NAMES, FloatArray, quaternion_of
from relnav.errors import InputError
from relnav.quantise import QuantisedFrame
from relnav.result import FAILURES, FLAG_NAMES, PoseResult

# Where each result starts in the result registers, and how many words it has.
RESULT_LAYOUT: dict[str, tuple[int, int]] = {
    "q": (0, 3),
    "q_fixed": (3, 3),
    "R": (6, 9),
    "T": (15, 3),
    "rss": (18, 1),
    "condition": (19, 1),
    "determinant": (20, 1),
    "q_cov": (22, 6),
    "t_cov": (28, 6),
}
RESULT_WORDS = 34


@dataclass(frozen=True)
class CoreConfig:
    """The CONFIG and VARIANCE registers. Weighted mode follows from the frame: it has weights or not.

    variance: sigma_a^2 + sigma_b^2 at unit weight of the USER, unit^2; 0: the core takes rss / (3n - 6).
    """

    forbid_turns: bool = False
    reapply: bool = False
    covariance: bool = True
    variance: float = 0.0

    def variance_word(self, weight_scale: float = 1.0) -> int:
        """VARIANCE (binary32) for a frame. Raises InputError where it would become 0: that means rss."""
        return variance_word(self.variance, weight_scale)


@dataclass(frozen=True)
class RawResult:
    """Register words of one frame. Numbers are binary32 bit patterns (uint32), but q_fixed: Q15.16 as int32.

    points, weight, turn (0..3), flags (bits of FRAME_FLAGS); q 3, q_fixed 3, R 9 row-major, T 3, rss,
    condition, determinant, q_cov and t_cov 6 each (11 12 13 22 23 33; None where not computed); cycles None
    without hardware.
    """

    points: int = 0
    weight: int = 0
    turn: int = 0
    flags: int = 0
    q: tuple[int, ...] = (0,) * 3
    q_fixed: tuple[int, ...] = (0,) * 3
    R: tuple[int, ...] = (0,) * 9
    T: tuple[int, ...] = (0,) * 3
    rss: int = 0
    condition: int = 0
    determinant: int = 0
    q_cov: tuple[int, ...] | None = None
    t_cov: tuple[int, ...] | None = None
    cycles_q: int | None = None
    cycles_pose: int | None = None
    cycles_all: int | None = None

    @property
    def flag_names(self) -> tuple[str, ...]:
        """Names of the flags that are set."""
        return tuple(name for bit, name in enumerate(FLAG_NAMES) if self.flags >> bit & 1)

    @property
    def failed(self) -> bool:
        """True when the frame left no numbers."""
        return not FAILURES.isdisjoint(self.flag_names)

    def result_words(self) -> list[int]:
        """The 34 result registers as unsigned words, for comparing bit by bit; 0 where not computed."""
        words = [0] * RESULT_WORDS
        for name, (start, count) in RESULT_LAYOUT.items():
            value = getattr(self, name)
            values = (0,) * count if value is None else (value,) if count == 1 else value
            words[start : start + count] = [word & 0xFFFFFFFF for word in values]
        return words


def results_from_words(
    words: Sequence[int], *, covariance: bool = True
) -> dict[str, int | tuple[int, ...] | None]:
    """The keyword arguments of RawResult that the result registers hold, from at least 34 of their words."""
    fields: dict[str, int | tuple[int, ...] | None] = {}
    for name, (start, count) in RESULT_LAYOUT.items():
        values = tuple(words[start : start + count])
        fields[name] = values[0] if count == 1 else values
    fields["q_fixed"] = tuple(word - (1 << 32) if word >> 31 else word for word in words[3:6])
    if not covariance:
        fields["q_cov"] = fields["t_cov"] = None
    return fields


def variance_word(variance: float, weight_scale: float = 1.0) -> int:
    """The VARIANCE register (binary32): the user's variance at unit weight, at unit integer weight.

    0 stays 0. Raises InputError for another value that would become 0 (that means rss) or infinite.
    """
    value = variance * weight_scale
    if value == 0.0 and variance == 0.0:
        return 0
    with np.errstate(over="ignore", under="ignore"):
        rounded = np.float32(value)
    if not (np.isfinite(rounded) and rounded >= np.finfo(np.float32).tiny):
        raise InputError(
            f"the variance at unit integer weight, {value!r}, is not a normal binary32 number: "
            "sigma, or a covariance, is too large or too small"
        )
    return float_to_word(float(rounded))


def floats_of(words: Sequence[int]) -> FloatArray:
    """The binary32 numbers with these bit patterns, (len(words),)."""
    return np.array([word_to_float(word) for word in words])


def symmetric(words: Sequence[int], size: int) -> FloatArray:
    """(size, size) from the binary32 words of an upper triangle, row-major."""
    matrix = np.zeros((size, size))
    rows, columns = np.triu_indices(size)
    matrix[rows, columns] = matrix[columns, rows] = floats_of(words)
    return matrix


def raw_to_pose(raw: RawResult, frame_name: str | int, quantised: QuantisedFrame) -> PoseResult:
    """The typed result: binary32 words as the floats they are, the weights' scale undone where it matters.

    A failed frame has no numbers: its registers still hold the frame before.
    """
    if raw.failed:
        return PoseResult(frame_name, quantised.n, flags=raw.flag_names)
    scale = quantised.weight_scale
    q = floats_of(raw.q)
    finite = bool(np.all(np.isfinite(q)))
    rotation = floats_of(raw.R).reshape(3, 3)
    cycles = None
    if raw.cycles_q is not None and raw.cycles_pose is not None and raw.cycles_all is not None:
        cycles = {"q": raw.cycles_q, "pose": raw.cycles_pose, "all": raw.cycles_all}
    return PoseResult(
        frame=frame_name,
        n=raw.points,
        q=q if finite else None,
        quaternion=quaternion_of(rotation),
        R=rotation,
        t=floats_of(raw.T),
        q_cov=None if raw.q_cov is None or not finite else symmetric(raw.q_cov, 3),
        t_cov=None if raw.t_cov is None else symmetric(raw.t_cov, 3),
        rss=word_to_float(raw.rss) / scale,
        turn=TURN_NAMES[raw.turn],
        flags=raw.flag_names,
        cycles=cycles,
        weight=raw.weight / scale,
        condition=word_to_float(raw.condition),
        determinant=word_to_float(raw.determinant) / scale / scale / scale,
        q_fixed=np.array(raw.q_fixed, dtype=np.float64) / 65536.0,
    )


def float_to_word(value: float) -> int:
    """Bit pattern of value in binary32, to nearest; beyond its range, infinity."""
    try:
        return int(struct.unpack("<I", struct.pack("<f", value))[0])
    except OverflowError:
        return int(struct.unpack("<I", struct.pack("<f", math.copysign(math.inf, value)))[0])


def word_to_float(word: int) -> float:
    """The binary32 number with this bit pattern."""
    return float(struct.unpack("<f", struct.pack("<I", word))[0])
