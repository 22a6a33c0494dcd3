# SPDX-License-Identifier: Apache-2.0
"""All trials of a core, their counts, and what may not be."""

from __future__ import annotations

import random
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import asdict, dataclass, field
from fnmatch import fnmatchcase
from typing import Any

from faults.classes import CLASSES, CONFIGURATION, CONTROL, DATA, MEMORY, classify
from faults.flipflops import Bit
from faults.frames import WAYS
from faults.trials import (
    FLAGGED,
    HANG,
    RIGHT,
    SILENT,
    VERDICTS,
    WRONG,
    Model,
    Outcome,
    Trial,
    Window,
    draw,
    run,
    window,
)

CHUNK = 400
"""Trials of one process of the simulator."""
NEXT = ("right", "flagged", "wrong", "hang")


@dataclass(frozen=True)
class Size:
    """How much is tried. flips: of each control and configuration bit; bits: at most so many, None all."""

    flips: int = 32
    data: int = 1000
    memory: int = 300
    bits: int | None = None
    only: str = "*"
    """Pattern of module.register."""
    reading: bool = False
    """Hit while the driver reads frame 1's results, instead of before."""


QUICK = Size(flips=1, data=150, memory=50, bits=300)


@dataclass
class Row:
    """Counts of trials."""

    bits: int = 0
    """Flip-flops that there are."""
    trials: int = 0
    verdicts: Counter[str] = field(default_factory=Counter)
    next: Counter[str] = field(default_factory=Counter)
    recovered: int = 0
    """Frame 1 not right, frame 2 right."""
    released: int = 0
    """Hangs that a soft reset ended: frame 2 was right, or at least the one after it."""
    lost: int = 0
    """Not right even after frame 2's recovery: what only a hard reset ends."""
    stray: int = 0
    """Answers to no request were seen on the bus."""
    interrupt: int = 0
    """The interrupt was wrong, whatever else."""
    offences: int = 0

    def add(self, one: Outcome, kind: str) -> None:
        """Count one."""
        self.trials += 1
        self.verdicts[one.verdict] += 1
        self.next[one.next] += 1
        self.recovered += one.verdict in (FLAGGED, SILENT, HANG) and one.next == RIGHT
        self.released += one.verdict == HANG and RIGHT in (one.next, one.later)
        self.lost += one.later not in ("", RIGHT)
        self.stray += any(word.startswith("stray") for word in one.how)
        self.interrupt += any(word.startswith("interrupt") for word in one.how)
        self.offences += bool(offences(one, kind))

    def table(self) -> dict[str, int]:
        """For results.json."""
        return {
            "bits": self.bits,
            "trials": self.trials,
            **{name: self.verdicts[name] for name in VERDICTS},
            **{f"next {name}": self.next[name] for name in NEXT},
            "recovered": self.recovered,
            "hang ended by soft reset": self.released,
            "only a hard reset": self.lost,
            "stray answer": self.stray,
            "interrupt": self.interrupt,
            "offences": self.offences,
        }


def offences(one: Outcome, kind: str) -> list[str]:
    """What may not be, of a bit of this class."""
    found = []
    if one.verdict == SILENT and kind in (CONTROL, CONFIGURATION):
        found.append("silent wrong result")
    if one.verdict == HANG:
        found.append("hang" if RIGHT in (one.next, one.later) else "hang for good")
    if one.next == WRONG:
        found.append("next frame wrong")
    if one.next == HANG:
        found.append("next frame hangs")
    if one.later not in ("", RIGHT):
        found.append("not right after a soft reset")
    if any(word.startswith("stray") for word in one.how):
        found.append("answer to no request")
    return found


@dataclass
class Found:
    """A core's campaign."""

    top: str
    seed: int
    windows: dict[str, Window]
    classes: dict[str, Row]
    modules: dict[str, dict[str, Row]]
    """Class -> module -> counts."""
    offenders: list[tuple[Outcome, str]]
    silent: dict[str, Counter[str]]
    """Class (data, memory) -> register -> silent wrong results."""

    def table(self) -> dict[str, Any]:
        """For results.json."""
        return {
            "seed": self.seed,
            "clocks": {way: asdict(one) for way, one in self.windows.items()},
            "classes": {kind: row.table() for kind, row in self.classes.items()},
            "modules": {
                kind: {name: _short(row.table()) for name, row in sorted(rows.items())}
                for kind, rows in self.modules.items()
            },
            **{f"silent {kind}": dict(some.most_common()) for kind, some in self.silent.items()},
        }


def _short(table: dict[str, int]) -> dict[str, int]:
    return {name: value for name, value in table.items() if value or name in ("bits", "trials")}


def plan(model: Model, size: Size, seed: int) -> tuple[dict[str, Window], dict[str, list[Bit]], list[Trial]]:
    """Clocks of the ways, bits by class, and the trials."""
    windows = {way.name: window(model, way.name, seed) for way in WAYS[model.top]}
    anywhere: dict[str, tuple[range, ...]] = {way: (range(one.end),) for way, one in windows.items()}
    parts = {way: one.parts for way, one in windows.items()}
    if size.reading:
        parts = anywhere = {way: (range(one.end, one.read),) for way, one in windows.items()}
    classes = classify(bit for bit in model.bits if fnmatchcase(bit.key, size.only))
    trials: list[Trial] = []
    rng = random.Random(f"{seed}/{model.top}")
    for kind in (CONTROL, CONFIGURATION):
        bits = classes[kind]
        if size.bits is not None and size.bits < len(bits):
            bits = rng.sample(bits, size.bits)
        trials += [draw(model.top, parts, bit, k, seed) for k in range(size.flips) for bit in bits]
    for kind, count in ((DATA, size.data), (MEMORY, size.memory)):
        bits = rng.sample(classes[kind], min(count, len(classes[kind])))
        trials += [draw(model.top, anywhere, bit, 0, seed) for bit in bits]
    return windows, classes, trials


def campaign(
    model: Model,
    size: Size,
    seed: int,
    jobs: int,
    progress: Callable[[int, int], None] = lambda done, all_: None,
) -> Found:
    """Everything of one core. Raises BenchFailed where the core is not right without any fault."""
    windows, classes, trials = plan(model, size, seed)
    kinds = {bit.name: kind for kind, bits in classes.items() for bit in bits}
    by_way: dict[str, list[Trial]] = defaultdict(list)
    for trial in trials:
        by_way[trial.way].append(trial)
    chunks = [
        (way, some[start : start + CHUNK], number)
        for way, some in by_way.items()
        for number, start in enumerate(range(0, len(some), CHUNK))
    ]
    outcomes: list[Outcome] = []
    with ThreadPoolExecutor(jobs) as pool:
        for some in pool.map(lambda chunk: run(model, chunk[0], seed, chunk[1], chunk[2]), chunks):
            outcomes += some
            progress(len(outcomes), len(trials))
    return count(model, seed, windows, classes, ((one, kinds[one.trial.bit.name]) for one in outcomes))


def count(
    model: Model,
    seed: int,
    windows: dict[str, Window],
    classes: dict[str, list[Bit]],
    outcomes: Iterable[tuple[Outcome, str]],
) -> Found:
    """The counts of outcomes with their classes."""
    rows = {kind: Row(bits=len(classes[kind])) for kind in CLASSES}
    modules: dict[str, dict[str, Row]] = {kind: {} for kind in CLASSES}
    for kind, bits in classes.items():
        for bit in bits:
            modules[kind].setdefault(bit.module, Row()).bits += 1
    offenders = []
    silent = {kind: Counter[str]() for kind in (DATA, MEMORY)}
    for one, kind in outcomes:
        rows[kind].add(one, kind)
        modules[kind][one.trial.bit.module].add(one, kind)
        if offences(one, kind):
            offenders.append((one, kind))
        if kind in silent and one.verdict == SILENT:
            silent[kind][one.trial.bit.key] += 1
    offenders.sort(key=lambda pair: (pair[1], pair[0].trial.bit.name, pair[0].trial.clock))
    return Found(model.top, seed, windows, rows, modules, offenders, silent)


def command(top: str, trial: Trial) -> str:
    """What repeats a trial."""
    core = top.removesuffix("_top")
    return (
        f"python -m faults --core {core} --flip '{trial.bit.name}' --way {trial.way} "
        f"--clock {trial.clock} --seed {trial.seed}"
    )


def describe(top: str, pair: tuple[Outcome, str]) -> dict[str, Any]:
    """An offender, for results.json."""
    one, kind = pair
    trial = one.trial
    return {
        "flip-flop": trial.bit.name,
        "module": trial.bit.module,
        "class": kind,
        "way": trial.way,
        "clock": trial.clock,
        "seed": trial.seed,
        "offences": offences(one, kind),
        "frame 1": one.verdict,
        "next": one.next,
        **({"later": one.later} if one.later else {}),
        **({"wrong": list(one.wrong)} if one.wrong else {}),
        **({"seen": list(one.how)} if one.how else {}),
        "command": command(top, trial),
    }


def by_register(found: Found) -> list[tuple[str, str, list[str], Sequence[tuple[Outcome, str]]]]:
    """Offending registers: class, module.register, the offences, the trials."""
    groups: dict[tuple[str, str], list[tuple[Outcome, str]]] = defaultdict(list)
    for pair in found.offenders:
        groups[pair[1], pair[0].trial.bit.key].append(pair)
    return [
        (kind, key, sorted({word for one, k in pairs for word in offences(one, k)}), pairs)
        for (kind, key), pairs in sorted(groups.items())
    ]
