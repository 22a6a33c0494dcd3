# SPDX-License-Identifier: Apache-2.0
"""What the masters of soak_harness.v do in one episode: four lists of items, from one seed."""

from __future__ import annotations

import random
from dataclasses import dataclass, field

from tb.soak.cores import Core

NONE, WRITES, BEATS, READS, NOT_BUSY, COMPUTING, END = 0, 1, 2, 3, 4, 5, 15
FIRST = -1
NO_RESET = 0xFFFFFFFF
CONTROL, FLAGS, IRQ_ENABLE, IRQ_STATUS, PUSH = 0x00C, 0x014, 0x01C, 0x020, 0x048
DATA_A, DATA_B = 0x040, 0x044
SOFT_RESET, ACKNOWLEDGE = 1, 2
LONGEST = 65535


@dataclass
class Episode:
    """Lines of the harness's files."""

    writes: list[str] = field(default_factory=list)
    reads: list[str] = field(default_factory=list)
    beats: list[str] = field(default_factory=list)
    resets: list[str] = field(default_factory=list)


class Director:
    """Makes an episode. `long` allows frames beyond the longest."""

    def __init__(self, core: Core, rng: random.Random, long: bool = False) -> None:
        self.core, self.rng = core, rng
        self.long = long
        self.episode = Episode()
        self.writes = self.reads = self.beats = 0
        self.hurry = rng.choice([0.0, 0.3, 0.8])  # share of pauses in the stream
        self.patience = rng.choice([0, 0, 3, 30])  # most clocks of back-pressure on an answer
        self.pace = rng.choice([0, 4, 40])  # most idle clocks between accesses
        self.addresses = sorted(core.registers)

    # ------------------------------------------------------------------ items

    def write(
        self, address: int, data: int, strobe: int = 15, wait: tuple[int, int] = (NONE, 0), delay: int = 0
    ) -> None:
        rng = self.rng
        kind, need = wait
        apart = rng.choice([0, 0, rng.randint(0, self.pace)])
        first, second = (delay, delay + apart) if rng.random() < 0.5 else (delay + apart, delay)
        late, ready = rng.randrange(2), rng.randint(0, self.patience)
        self.episode.writes.append(
            f"{kind:x}0{need:05x}{first:03x}{second:03x}{late:x}{ready:03x}{strobe:x}{address:03x}{data:08x}"
        )
        self.writes += 1

    def read(self, address: int, delay: int = 0) -> None:
        late, ready = self.rng.randrange(2), self.rng.randint(0, self.patience)
        self.episode.reads.append(f"0000000{delay:03x}{late:x}{ready:03x}{address:03x}")
        self.reads += 1

    def read_waits(self, kind: int, need: int) -> None:
        self.episode.reads.append(f"{kind:x}1{need:05x}" + "0" * 10)

    def write_waits(self, kind: int, need: int) -> None:
        self.episode.writes.append(f"{kind:x}1{need:05x}" + "0" * 22)

    def beat(self, data: int, last: bool, wait: tuple[int, int] = (NONE, 0), repeats: int = 0) -> None:
        kind, need = wait
        delay = self.rng.randint(1, 12) if self.rng.random() < self.hurry else 0
        self.episode.beats.append(f"{kind:x}0{need:05x}{delay:03x}{repeats:05x}{int(last):x}{data:016x}")
        self.beats += 1

    # ------------------------------------------------------------------ scenes

    def storm_of_reads(self, count: int) -> None:
        rng = self.rng
        for _ in range(count):
            address = rng.choice(self.addresses) if rng.random() < 0.8 else rng.randrange(0x1000)
            self.read(address, rng.randint(0, self.pace))

    def storm_of_writes(self, count: int) -> None:
        """Any register, read-only ones, unmapped and misaligned addresses too; all but soft resets."""
        rng = self.rng
        for _ in range(count):
            address = rng.choice(self.addresses) if rng.random() < 0.7 else rng.randrange(0x1000)
            strobe = rng.choice([15, 15, rng.randrange(16)])
            data = rng.choice([rng.getrandbits(32), rng.getrandbits(4), 0, 0xFFFFFFFF])
            if address == CONTROL:
                data &= ~SOFT_RESET
            if address == self.core.address("VARIANCE") and rng.random() < 0.5:
                continue
            if address == PUSH and rng.random() < 0.7:
                continue  # each that is taken opens a frame
            self.write(address, data, strobe, delay=rng.randint(0, self.pace))

    def configure(self, settings: dict[str, int]) -> None:
        for number, (name, word) in enumerate(settings.items()):
            self.write(self.core.address(name), word, wait=(NOT_BUSY, 3000) if number == 0 else (NONE, 0))
        if self.rng.random() < 0.5:
            self.write(IRQ_ENABLE, self.rng.randrange(4))
        if self.rng.random() < 0.3:
            self.write(FLAGS, 0xFFFFFFFF)
        if self.rng.random() < 0.3:
            self.write(IRQ_STATUS, 3)

    def rows(self) -> int:
        rng, least = self.rng, self.core.least
        return rng.choices(
            [rng.randint(1, least), rng.randint(least, 12), rng.randint(12, 40), rng.randint(100, 400)],
            [2, 10, 3, 0.5],
        )[0]

    def spoil(self, beats: list[int]) -> tuple[list[int], bool]:
        """(beats, whether the last one says so): one frame in six ends early, or not at all."""
        rng = self.rng
        if rng.random() > 0.16:
            return beats, True
        if rng.random() < 0.7:
            return beats[: rng.randint(1, len(beats))], True
        return beats, False

    def frame(self) -> None:
        rng = self.rng
        beats, settings = self.core.frame(rng, self.rows())
        beats, ended = self.spoil(beats)
        if rng.random() < 0.9:
            self.configure(settings)
        if rng.random() < 0.3 and len(beats) < 200:
            self.push(beats, ended)
        else:
            self.stream(beats, ended)
        self.storm_of_reads(rng.choice([0, 5, 60]))
        self.storm_of_writes(rng.choice([0, 0, 3, 30]))
        if rng.random() < 0.35:
            kind = rng.choice([NOT_BUSY, COMPUTING, NONE])
            action = rng.choices([SOFT_RESET, ACKNOWLEDGE, 3], [4, 3, 1])[0]
            if rng.random() < 0.7:
                self.write_waits(BEATS, self.beats)
            self.write(CONTROL, action, wait=(kind, 500), delay=rng.randint(0, rng.choice([3, 400, 1100])))
        if rng.random() < 0.6:
            self.read_waits(BEATS, self.beats)
            self.read_waits(NOT_BUSY, 2500)
            order = list(self.addresses)
            rng.shuffle(order)
            for address in order:
                self.read(address)

    def stream(self, beats: list[int], ended: bool) -> None:
        for number, beat in enumerate(beats):
            wait = (WRITES, self.writes) if number == 0 else (NONE, 0)
            self.beat(beat, ended and number == len(beats) - 1, wait)
        if not ended and self.rng.random() < 0.7:
            self.write(CONTROL, SOFT_RESET, wait=(BEATS, self.beats), delay=self.rng.randint(0, 200))

    def push(self, beats: list[int], ended: bool) -> None:
        """Beats by the registers; now and then another write between, or a stream beside it."""
        rng = self.rng
        if rng.random() < 0.3:
            extra, _ = self.core.frame(rng, self.core.least)
            for number, beat in enumerate(extra):
                self.beat(
                    beat, number == len(extra) - 1, (WRITES, self.writes + 3) if number == 0 else (NONE, 0)
                )
        for number, beat in enumerate(beats):
            self.write(DATA_A, beat & 0xFFFFFFFF, wait=(NOT_BUSY, 2500) if number == 0 else (NONE, 0))
            self.write(DATA_B, beat >> 32)
            self.write(PUSH, int(ended and number == len(beats) - 1), delay=rng.choice([0, 0, 5]))
            if rng.random() < 0.05:
                self.storm_of_writes(1)
        if not ended and rng.random() < 0.7:
            self.write(CONTROL, SOFT_RESET, delay=rng.randint(0, 200))

    def too_long(self) -> None:
        """As many rows as may be, or some more; the same one again and again."""
        rng, core = self.rng, self.core
        more = rng.choice([0, 1, 2, 3, 4465])
        beats, settings = core.frame(rng, 1)
        settings["CONFIG"] = settings.get("CONFIG", 0) & ~1
        if not core.in_front:
            del settings["CONFIG"]
        self.configure(settings)
        self.hurry, late = 0.0, self.hurry
        whole = (LONGEST + more) * core.beats
        self.beat(beats[-1], False, (WRITES, self.writes), repeats=whole - 2)
        self.beat(beats[-1], True)
        self.hurry = late
        self.read_waits(BEATS, self.beats)
        self.read_waits(NOT_BUSY, 2500)
        for address in self.addresses:
            self.read(address)

    def plain(self) -> Episode:
        """One frame that is solved for certain, and nothing else."""
        for axis in range(2 * self.core.least):
            row = [
                (7919 * (axis + 2) * (k + 1) * (axis + k)) % 1999 << 32 | 1 << (axis + k) % 12
                for k in range(3)
            ]
            row += [1 << 32 | axis] * (self.core.beats - 3)
            for number, data in enumerate(row):
                self.beat(data, axis == 2 * self.core.least - 1 and number == len(row) - 1)
        return self.end()

    def run(self) -> Episode:
        rng, episode = self.rng, self.episode
        frames = rng.randint(1, 7)
        for number in range(frames):
            if self.long and number == 0:
                self.too_long()
            else:
                self.frame()
        # whatever still waits at the stream gets through
        for _ in range(2):
            self.write(CONTROL, SOFT_RESET, wait=(BEATS, self.beats))
        self.read_waits(WRITES, self.writes)
        for address in self.addresses:
            self.read(address)
        if rng.random() < 0.4:
            at = 0
            for _ in range(rng.randint(1, 3)):
                at += rng.randint(5, 900 * frames)
                episode.resets.append(f"{at:06x}{rng.choice([0, 1, 5]):02x}")
        return self.end()

    def end(self) -> Episode:
        episode = self.episode
        episode.writes.append("f" + "0" * 28)
        episode.reads.append("f" + "0" * 16)
        episode.beats.append("f" + "0" * 31)
        episode.resets.append(f"{NO_RESET:08x}")
        return episode


def episode_of(core: Core, seed: int, number: int, long: bool) -> Episode:
    """The episode `number` of a run: always the same. FIRST is the one that begins every simulation."""
    if number == FIRST:
        return Director(core, random.Random(1)).plain()
    return Director(core, random.Random(f"{core.top} {seed} {number}"), long).run()
