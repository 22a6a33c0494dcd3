# SPDX-License-Identifier: Apache-2.0
"""What the soak knows of each core: its map, its beats, its latencies, its model, its random frames."""

from __future__ import annotations

import functools
import inspect
import random
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from relnav.driver import beats_of as oltae_beats
from relnav.ivisnav.driver import beats_of as ivisnav_beats
from relnav.ivisnav.quantise import QuantisedRows
from relnav.model.core import OltaeCore
from relnav.model.gram_ring import gram_ring
from relnav.model.rates_engine import RatesEngine
from relnav.model.rates_program import Mark
from relnav.model.rates_scale import FrameScale
from relnav.model.rates_schedule import schedule
from relnav.model.raw import CoreConfig
from relnav.quantise import QuantisedFrame
from relnav.registermap import Register
from relnav.registers import Ivisnav, Oltae

from tb.ivisnav.frames import random_rows
from tb.oltae.frames import random_frame

BUSY_WRITE = "BUSY_WRITE"


@dataclass(frozen=True)
class Settings:
    """The configuration registers as a frame finds them. config: 0 where there is no CONFIG."""

    config: int
    frac: int
    variance: int


@dataclass(frozen=True)
class Solved:
    """What a complete frame leaves. words: the result registers, None where nothing is said of one."""

    words: tuple[int | None, ...] = ()
    flags: frozenset[str] = frozenset()
    weight: int = 0
    extra: int = 0
    """Word of TURN or CONDITION; of CONDITION also where the frame is refused."""


@dataclass(frozen=True)
class Core:
    """One core, full build."""

    top: str
    map: Any
    beats: int
    least: int
    in_front: bool
    """Whether a weight may come in a beat of its own, where CONFIG says so."""
    fracs: int
    groups: tuple[range, ...]
    counters: tuple[str | None, ...]
    """Register of each group's cycles."""
    count: str
    few: str
    extra: str
    solve: Callable[[list[tuple[int, ...]], bool, Settings], Solved]
    """(rows of beats, a weight's in front where weighted; weighted; settings) -> what stands in the end."""
    latency: Callable[[bool, int], tuple[int, ...]]
    """(weighted, CONFIG) -> clocks from the last beat to each group."""
    again: Callable[[bool], int]
    """(weighted) -> clocks from the last group to the second pass's "last beat"."""
    frame: Callable[[random.Random, int], tuple[list[int], dict[str, int]]]
    """(rng, rows) -> beats and the registers to set before."""
    build: int
    behind: range
    """Clocks that `latency` leaves open, the same for all frames."""
    registers: Mapping[int, type[Register]] = field(default_factory=dict)
    """Of every address that is mapped."""

    def address(self, name: str) -> int:
        """Of a register."""
        address: int = getattr(self.map, name).ADDRESS
        return address

    def flag(self, name: str) -> int:
        """Bit of a flag."""
        mask: int = self.map.FLAGS.FIELDS[name].mask
        return mask


def mapped(register_map: Any) -> dict[int, type[Register]]:
    """Every address of a map."""
    found = {}
    for _, register in inspect.getmembers(register_map, inspect.isclass):
        if issubclass(register, Register):
            found.update({register.element(index): register for index in range(register.COUNT)})
    return found


# ---------------------------------------------------------------------------------------------------- OLTAE

WEIGHTED, FORBID_TURNS, REAPPLY, COVARIANCE = (1 << bit for bit in range(4))
COVARIANCES = range(22, 34)


@dataclass(frozen=True)
class WordConfig(CoreConfig):
    """A configuration with any word in VARIANCE."""

    word: int = 0

    def variance_word(self, weight_scale: float = 1.0) -> int:
        """The word."""
        return self.word


@functools.cache
def oltae() -> OltaeCore:
    """The full build's model."""
    return OltaeCore()


def _byte(word: int) -> int:
    return word - 256 if word & 128 else word


def oltae_solve(rows: list[tuple[int, ...]], weighted: bool, settings: Settings) -> Solved:
    """OLTAE's model of a complete frame."""
    points = np.array([row[-3:] for row in rows], dtype=np.uint64)
    a = points.astype(np.uint32).view(np.int32).astype(np.int64)
    b = (points >> np.uint64(32)).astype(np.uint32).view(np.int32).astype(np.int64)
    w = np.array([row[0] & 0xFFFF for row in rows], dtype=np.int64) if weighted else None
    config, covariance = settings.config, bool(settings.config & COVARIANCE)
    found = oltae().run(
        QuantisedFrame(a, b, w, _byte(settings.frac)),
        WordConfig(bool(config & FORBID_TURNS), bool(config & REAPPLY), covariance, word=settings.variance),
    )
    if found.failed:
        return Solved(flags=frozenset(found.flag_names))
    words: list[int | None] = [*found.result_words()]
    if not covariance:  # what stands there is not said
        words[COVARIANCES.start :] = [None] * len(COVARIANCES)
    return Solved(tuple(words), frozenset(found.flag_names), found.weight, found.turn)


@functools.cache
def oltae_latency(weighted: bool, config: int) -> tuple[int, ...]:
    """docs/oltae.md."""
    q = 96 + 3 * weighted + (133 if config & REAPPLY else 0)
    return q, q + 34, q + 34 + (703 if config & COVARIANCE else 289)


def oltae_again(weighted: bool) -> int:
    """The second pass waits less for its first sum than the first one for its last beat: docs/oltae.md."""
    return -5 if weighted else -2


def oltae_frame(rng: random.Random, n: int) -> tuple[list[int], dict[str, int]]:
    """A random frame, and its configuration."""
    frame = random_frame(rng, n)
    if rng.random() < 0.15:  # nearly on a line or in one place: from well conditioned to hopeless
        squeeze = np.array([rng.randint(0, 31) for _ in range(3)])
        frame = replace(frame, a=frame.a >> squeeze, b=frame.b >> squeeze)
    config = rng.randrange(16) & ~WEIGHTED | (WEIGHTED if frame.w is not None else 0)
    if rng.random() < 0.5:
        config &= ~FORBID_TURNS
    return oltae_beats(frame), {"CONFIG": config, "FRAC": frame.frac & 0xFF, "VARIANCE": variance(rng)}


# -------------------------------------------------------------------------------------------------- iVisNav


def ivisnav_solve(rows: list[tuple[int, ...]], weighted: bool, settings: Settings) -> Solved:
    """iVisNav's model of a complete frame."""
    beats = np.array(rows, dtype=np.uint64)
    low = beats.astype(np.uint32).view(np.int32).astype(np.int64)
    high = (beats >> np.uint64(32)).astype(np.uint32).view(np.int32).astype(np.int64)
    h = np.empty((len(rows), 6), dtype=np.int64)
    h[:, 0::2], h[:, 1::2] = low[:, :3], high[:, :3]
    y, w = low[:, 3], high[:, 3] & 0xFFFF
    frac_h, frac_y = _byte(settings.frac & 0xFF), _byte(settings.frac >> 8 & 0xFF)
    data = QuantisedRows(h, y, w, frac_h, frac_y)
    sums = gram_ring(data.h, data.y, data.w)
    scale = FrameScale.of(sums, frac_h, frac_y, settings.variance)
    with np.errstate(all="ignore"):
        found = RatesEngine(sums.moments, scale, sums.used_count, settings.variance).run()
    if found.rank_deficient:
        return Solved(flags=frozenset({"RANK_DEFICIENT"}))
    if found.ill_conditioned:
        return Solved(flags=frozenset({"ILL_CONDITIONED"}), extra=found.condition)
    assert found.words is not None
    return Solved(tuple(found.words), frozenset(), sums.weight_sum, found.condition)


@functools.cache
def ivisnav_latency(weighted: bool, config: int) -> tuple[int, ...]:
    """The ring's part and the program's schedule, as scripts/latency.py counts; `behind` them comes the same
    pipeline for both, whose depth the first episode of a simulation shows.
    """
    return tuple(FIRST_SUM + schedule().cycle(mark) for mark in (Mark.RATES, Mark.ALL))


def ivisnav_again(weighted: bool) -> int:
    """As oltae_again, for docs/ivisnav.md."""
    return -11


FIRST_SUM = 20  # of gram_ring, from the last beat
MOST_BEHIND = 4


def ivisnav_frame(rng: random.Random, n: int) -> tuple[list[int], dict[str, int]]:
    """A random frame, and its configuration."""
    frame = random_rows(rng, n)
    beats = ivisnav_beats(frame)
    if rng.random() < 0.3:  # bits that are ignored
        beats[3::4] = [beat | rng.getrandbits(16) << 48 for beat in beats[3::4]]
    frac = (frame.frac_y & 0xFF) << 8 | frame.frac_h & 0xFF
    return beats, {"FRAC": frac, "VARIANCE": variance(rng)}


# ----------------------------------------------------------------------------------------------------- both


def variance(rng: random.Random) -> int:
    """A word for VARIANCE: mostly a number that makes sense, else any word, infinities and NaNs too."""
    if rng.random() < 0.5:
        return 0
    if rng.random() < 0.7:
        return rng.choice([0x3F800000, 0x2B8CBCCC, 0x61A21A5D, 0x00800000, 0x7F7FFFFF])
    return rng.choice([rng.getrandbits(32), 0xBF800000, 0x80000000, 0x00000001, 0x7F800000, 0x7FC00000])


CORES: dict[str, Core] = {
    "oltae_top": Core(
        "oltae_top",
        Oltae,
        beats=3,
        least=3,
        in_front=True,
        fracs=1,
        groups=(range(3), range(3, 18), range(18, 34)),
        counters=("CYCLES_Q", "CYCLES_POSE", "CYCLES_ALL"),
        count="POINTS",
        few="FEW_POINTS",
        extra="TURN",
        solve=oltae_solve,
        latency=oltae_latency,
        again=oltae_again,
        frame=oltae_frame,
        build=0x230F,
        behind=range(1),
        registers=mapped(Oltae),
    ),
    "ivisnav_top": Core(
        "ivisnav_top",
        Ivisnav,
        beats=4,
        least=6,
        in_front=False,
        fracs=2,
        groups=(range(6), range(6, 28)),
        counters=("CYCLES_RATES", "CYCLES_ALL"),
        count="ROWS",
        few="FEW_ROWS",
        extra="CONDITION",
        solve=ivisnav_solve,
        latency=ivisnav_latency,
        again=ivisnav_again,
        frame=ivisnav_frame,
        build=0x1808,
        behind=range(1, MOST_BEHIND + 1),
        registers=mapped(Ivisnav),
    ),
}
