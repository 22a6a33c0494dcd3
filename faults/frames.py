# SPDX-License-Identifier: Apache-2.0
"""What the cores work on while they are hit: frames of every kind, with what the models say of them."""

from __future__ import annotations

import functools
import random
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from relnav.driver import OltaeDriver
from relnav.driver import beats_of as oltae_beats
from relnav.ivisnav.driver import IvisnavDriver
from relnav.ivisnav.driver import beats_of as ivisnav_beats

from tb.ivisnav.frames import random_rows
from tb.oltae.frames import random_frame
from tb.soak.cores import CORES as SOAK
from tb.soak.cores import COVARIANCE, FORBID_TURNS, REAPPLY, WEIGHTED, Core, Settings

FLOAT_1E_6 = 0x358637BD
BOTH_INTERRUPTS = 3
RESULTS = 0x100
"""Address of the first result word."""
BOUND = 8192
"""Clocks of a frame after which the driver gives it up: more than any frame and the watchdog take."""
PATIENCE = 256
"""Clocks that an access of the bus may take."""


@dataclass(frozen=True)
class Way:
    """How a trial's frames come. Frame 0 goes before, frame 1 is hit, frame 2 follows."""

    name: str
    config: int = 0
    variance: int = 0
    push: tuple[bool, bool, bool] = (False, False, False)
    gap: int = 0
    """Clocks between two beats of frame 1's stream."""


WAYS: dict[str, tuple[Way, ...]] = {
    "oltae_top": (
        Way("stream", COVARIANCE, push=(False, False, True)),
        Way("weighted", WEIGHTED | COVARIANCE, FLOAT_1E_6, push=(True, False, False)),
        Way("gaps", COVARIANCE | FORBID_TURNS, FLOAT_1E_6, gap=5),
        Way("reapply", WEIGHTED | COVARIANCE | REAPPLY, push=(False, False, True)),
        Way("push", COVARIANCE | REAPPLY, FLOAT_1E_6, push=(False, True, False)),
        Way("push-weighted", WEIGHTED | COVARIANCE, push=(True, True, True)),
    ),
    "ivisnav_top": (
        Way("stream", push=(False, False, True)),
        Way("gaps", variance=FLOAT_1E_6, push=(True, False, False), gap=5),
        Way("push", variance=FLOAT_1E_6, push=(False, True, False)),
        Way("push-push", push=(True, True, True)),
    ),
}


@dataclass(frozen=True)
class Result:
    """A register that is read of each frame."""

    name: str
    address: int
    diagnostic: bool = False
    """Cycles: a number about the frame, not of it."""


@dataclass(frozen=True)
class Episode:
    """A way with its data."""

    way: Way
    plan: tuple[str, ...]
    """Lines of upset_bench.cpp's plan, all but the trials."""
    results: tuple[Result, ...]
    wanted: tuple[tuple[int | None, ...], ...]
    """Of each frame the results' words, from the model; None for diagnostic numbers."""


def _driver(top: str) -> Any:
    return {"oltae_top": OltaeDriver, "ivisnav_top": IvisnavDriver}[top]


def _rows(core: Core, beats: Sequence[int], weighted: bool) -> list[tuple[int, ...]]:
    width = core.beats + (core.in_front and weighted)
    return [tuple(beats[start : start + width]) for start in range(0, len(beats), width)]


def _beats(
    core: Core, rng: random.Random, settings: Settings, weighted: bool
) -> tuple[list[int], tuple[int, ...]]:
    """Beats of a frame that the core solves without any flag, and what comes of them: results, n, W, ..."""
    while True:
        n = rng.randint(core.least + 1, 12)
        if core.in_front:
            frame = random_frame(rng, n, weighted)
            beats = oltae_beats(frame)
        else:
            beats = ivisnav_beats(random_rows(rng, n))
        solved = core.solve(_rows(core, beats, weighted), weighted, settings)
        if solved.words and not solved.flags:
            if None in solved.words:
                raise ValueError("every way has covariances")
            return beats, (*(word or 0 for word in solved.words), n, solved.weight, solved.extra)


@functools.cache
def episode(top: str, name: str, seed: int) -> Episode:
    """The frames of a way. Raises KeyError for a way that the core has not."""
    way = {way.name: way for way in WAYS[top]}[name]
    core, rng = SOAK[top], random.Random(f"{seed}/{top}/{name}")
    registers, weighted = core.map, bool(way.config & WEIGHTED) or not core.in_front
    frac = 0x1010 if core.fracs == 2 else 0x10
    settings = Settings(way.config, frac, way.variance)
    configuration = {"FRAC": frac, "VARIANCE": way.variance, "IRQ_ENABLE": BOTH_INTERRUPTS}
    if core.in_front:
        configuration = {"CONFIG": way.config, **configuration}
    count = sum(len(group) for group in core.groups)
    named = [(k, core.registers[RESULTS + 4 * k], RESULTS + 4 * k) for k in range(count)]
    kept = [k for k, register, _ in named if register.__name__ != "SPARE"]
    results = [
        Result(f"{register.__name__}[{(address - register.ADDRESS) // 4}]", address)
        for k, register, address in named
        if k in kept
    ]
    results += [Result(name, core.address(name)) for name in (core.count, "WEIGHT", core.extra)]
    counters = [Result(name, core.address(name), True) for name in core.counters if name]
    status, fields = registers.STATUS, registers.FLAGS.FIELDS
    failures = _driver(top).FAILURE_BITS | (fields["UPSET"].mask if "UPSET" in fields else 0)
    numbers = {
        "patience": PATIENCE,
        "bound": BOUND,
        "control": registers.CONTROL.ADDRESS,
        "soft_reset": registers.CONTROL.encode(SOFT_RESET=1),
        "flags": registers.FLAGS.ADDRESS,
        "every_flag": sum(field.mask for field in fields.values()),
        "failures": failures,
        "frame_flags": registers.FRAME_FLAGS.ADDRESS,
        "irq_status": registers.IRQ_STATUS.ADDRESS,
        "status": status.ADDRESS,
        "frame_mask": status.FIELDS["FRAME"].mask,
        "state_mask": status.FIELDS["STATE"].mask,
        "state_done": status.FIELDS["STATE"].put(registers.State.DONE),
        "all_ready": status.FIELDS["ALL_READY"].mask,
        "push_ready": status.FIELDS["PUSH_READY"].mask,
        "data_a": registers.DATA_A.ADDRESS,
        "data_b": registers.DATA_B.ADDRESS,
        "push": registers.PUSH.ADDRESS,
        "push_last": registers.PUSH.encode(LAST=1),
    }
    plan = [f"set {name} {value:x}" for name, value in numbers.items()]
    plan += [f"configure {core.address(name):x} {word:x}" for name, word in configuration.items()]
    plan += [f"result {one.address:x} {int(one.diagnostic)}" for one in [*results, *counters]]
    wanted = []
    for number, push in enumerate(way.push):
        beats, words = _beats(core, rng, settings, weighted)
        gap = way.gap if number == 1 else 0
        plan.append(f"frame {int(push)} {gap:x} {' '.join(f'{beat:x}' for beat in beats)}")
        kept_words = [words[k] for k in kept] + list(words[len(named) :])
        wanted.append((*kept_words, *(None for _ in counters)))
    return Episode(way, tuple(plan), (*results, *counters), tuple(wanted))
