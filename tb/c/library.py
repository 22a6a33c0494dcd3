# SPDX-License-Identifier: Apache-2.0
"""The C driver by ctypes: its structures, its errors by name, arrays as it takes them."""

from __future__ import annotations

import ctypes
import re
from ctypes import (
    CFUNCTYPE,
    POINTER,
    Structure,
    byref,
    c_double,
    c_float,
    c_int,
    c_int32,
    c_size_t,
    c_uint32,
    c_uint64,
    c_void_p,
)
from pathlib import Path
from typing import Any

import numpy as np

from scripts.c_build import DRIVER

SIZES = Path(__file__).with_name("sizes.c")
"""To be compiled into the library."""
AUTO = 127
READ = CFUNCTYPE(c_uint32, c_void_p, c_uint32)
WRITE = CFUNCTYPE(None, c_void_p, c_uint32, c_uint32)


def error_names() -> list[str]:
    """The members of relnav_error in their order, without RELNAV_."""
    text = (DRIVER / "relnav_core.h").read_text()
    body = text.partition("typedef enum {")[2].partition("} relnav_error;")[0]
    return re.findall(r"\bRELNAV_(\w+)", re.sub(r"/\*.*?\*/", "", body, flags=re.DOTALL))


ERRORS = error_names()


class Port(Structure):
    _fields_ = [("base", c_void_p), ("read", READ), ("write", WRITE), ("context", c_void_p)]


class Core(Structure):
    _fields_ = [
        ("port", Port),
        *((name, c_uint32) for name in ("build", "failures", "config_offset", "config", "frac", "variance")),
        ("weight_scale", c_double),
        ("frame", c_uint32),
    ]


class Reals(Structure):
    _fields_ = [("doubles", POINTER(c_double)), ("floats", POINTER(c_float))]


class Range(Structure):
    _fields_ = [("low", c_double), ("high", c_double), ("row", c_size_t)]


class Oltae(Structure):
    _fields_ = [("core", Core)]


class OltaeFrame(Structure):
    _fields_ = [("count", c_size_t), ("a", Reals), ("b", Reals), ("w", Reals)]


class OltaeScale(Structure):
    _fields_ = [("frac", c_int), ("weight_scale", c_double), ("weighted", c_int)]


class OltaeRaw(Structure):
    _fields_ = [("flags", c_uint32), ("head", c_uint32 * 6), ("words", c_uint32 * 34)]


class OltaeResult(Structure):
    _fields_ = [
        ("flags", c_uint32),
        ("count", c_uint32),
        ("turn", c_uint32),
        ("weight", c_double),
        ("q", c_float * 3),
        ("q_fixed", c_int32 * 3),
        ("rotation", c_float * 9),
        ("translation", c_float * 3),
        ("rss", c_double),
        ("condition", c_float),
        ("determinant", c_double),
        ("q_cov", c_float * 6),
        ("t_cov", c_float * 6),
        ("cycles_q", c_uint32),
        ("cycles_pose", c_uint32),
        ("cycles_all", c_uint32),
    ]


class Ivisnav(Structure):
    _fields_ = [("core", Core)]


class IvisnavFrame(Structure):
    _fields_ = [("count", c_size_t), ("h", Reals), ("y", Reals), ("w", Reals)]


class IvisnavScale(Structure):
    _fields_ = [("frac_h", c_int), ("frac_y", c_int), ("weight_scale", c_double)]


class IvisnavRaw(Structure):
    _fields_ = [
        ("flags", c_uint32),
        ("head", c_uint32 * 4),
        ("cycles_all", c_uint32),
        ("words", c_uint32 * 28),
    ]


class IvisnavResult(Structure):
    _fields_ = [
        ("flags", c_uint32),
        ("count", c_uint32),
        ("weight", c_double),
        ("condition", c_double),
        ("v", c_float * 3),
        ("omega", c_float * 3),
        ("rss", c_double),
        ("covariance", c_float * 21),
        ("cycles_rates", c_uint32),
        ("cycles_all", c_uint32),
    ]


STRUCTURES: list[type[Structure]] = [
    Port,
    Core,
    Reals,
    Range,
    Oltae,
    OltaeFrame,
    OltaeScale,
    OltaeRaw,
    OltaeResult,
    Ivisnav,
    IvisnavFrame,
    IvisnavScale,
    IvisnavRaw,
    IvisnavResult,
]
FRAMES = {"oltae": OltaeFrame, "ivisnav": IvisnavFrame}
SCALES = {"oltae": OltaeScale, "ivisnav": IvisnavScale}


class CDriver:
    """The functions of the library; those that return a relnav_error return its name."""

    def __init__(self, file: Path) -> None:
        self.file = file
        self._library = ctypes.CDLL(str(file))
        found = (c_size_t * len(STRUCTURES)).in_dll(self._library, "relnav_sizes")
        assert list(found) == [ctypes.sizeof(kind) for kind in STRUCTURES], "other structures"
        plain: dict[str, Any] = {
            "relnav_error_text": ctypes.c_char_p,
            "relnav_float": c_float,
            "relnav_sqrt": c_double,
            "ivisnav_metres_per_second": c_double,
            "oltae_beats": c_size_t,
            "ivisnav_beats": c_size_t,
            "relnav_finite": c_int,
        }
        for name in ("status", "flags", "frame_flags", "take_interrupt"):
            plain[f"relnav_{name}"] = c_uint32
        for name in ("clear_flags", "enable_interrupts", "acknowledge", "soft_reset", "push", "copy_floats"):
            plain[f"relnav_{name}"] = None
        self._plain = plain

    def __getattr__(self, name: str) -> Any:
        function = getattr(self._library, name)
        function.restype = self._plain.get(name, _error)
        return function

    def choose(self, core: str, frame: Structure, *wanted: int) -> tuple[str, Any, int]:
        """(error, scale, row) of oltae_choose or ivisnav_choose."""
        scale, row = SCALES[core](), c_size_t(0)
        points = wanted or ((AUTO,) if core == "oltae" else (AUTO, AUTO))
        error = getattr(self, f"{core}_choose")(byref(frame), *points, byref(scale), byref(row))
        return error, scale, row.value

    def fill(self, core: str, frame: Structure, scale: Structure) -> list[int]:
        """The frame's beats; raises AssertionError where the driver refuses it."""
        count = getattr(self, f"{core}_beats")(byref(frame))
        beats = (c_uint64 * (count + 1))()
        beats[count] = 0xA5A5A5A5  # a guard
        fill = getattr(self, f"{core}_fill")
        error = fill(byref(frame), byref(scale), beats, c_size_t(count))
        assert error == "OK", error
        assert beats[count] == 0xA5A5A5A5
        assert fill(byref(frame), byref(scale), beats, c_size_t(count - 1)) == "NO_SPACE"
        return list(beats[:count])


def _error(value: int) -> str:
    return ERRORS[value]


def reals(values: Any | None) -> Reals:
    """An array as the driver takes it: float32 as floats, all else as doubles. Keeps the array alive."""
    if values is None:
        return Reals()
    array = np.ascontiguousarray(values, None if np.asarray(values).dtype == np.float32 else np.float64)
    single = array.dtype == np.float32
    pointer = array.ctypes.data_as(POINTER(c_float if single else c_double))
    made = Reals(None, pointer) if single else Reals(pointer, None)
    made.array = array
    return made


def frame(core: str, first: Any, second: Any, w: Any | None = None) -> Any:
    """a, b (n, 3) of OLTAE or h (n, 6), y (n,) of iVisNav with optional weights, as the driver takes them."""
    parts = [reals(first), reals(second), reals(w)]
    made: Any = FRAMES[core](len(np.asarray(first)), *parts)
    made.parts = parts  # a structure copies its members, not what they keep alive
    return made
