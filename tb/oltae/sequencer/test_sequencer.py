# SPDX-License-Identifier: Apache-2.0
"""sequencer on random programs: plain and probed dot products, idle cycles, call and return, stop, reset.

The section that is called stands anywhere in the memory.
"""

from __future__ import annotations

import random
from dataclasses import dataclass, field
from pathlib import Path

from tb.common.replay import run
from tb.common.vectors import pack

WIDTHS = [1, 1, 1, 1, 1, 10, 4, 10, 10, 10, 10]
FIRST_WORD = 2  # cycle, and address, of the first word
SIZE = 1024
Slot = tuple[int, int] | None
"""(address, probing) of a cycle's word, None in an idle cycle."""


@dataclass
class Section:
    """Dot products and idle words at consecutive addresses from `start` on."""

    start: int
    words: list[int] = field(default_factory=list)
    played: list[Slot] = field(default_factory=list)

    @property
    def end(self) -> int:
        return self.start + len(self.words)

    def idle(self) -> None:
        self.words.append(0)
        self.played.append(None)

    def dot(self, slots: int, probed: int) -> None:
        places = range(self.end, self.end + slots)
        for place in places:
            first, last = place == places[0], place == places[-1]
            self.words.append(8 | first << 2 | last << 1 | probed)
        passes = (1, 0) if probed else (0,)
        self.played += [(place, probing) for probing in passes for place in places]


def section(rng: random.Random, start: int) -> Section:
    """Up to 16 words; probed dot products at its ends are as likely as anywhere."""
    made = Section(start)
    while len(made.words) < 10:
        if rng.random() < 0.2:
            made.idle()
        else:
            made.dot(rng.choice([1, 1, 2, 3, 6]), rng.randrange(2))
    return made


def test_sequencer(simulator: str, tmp_path: Path) -> None:
    rng = random.Random(66)
    stimulus: list[int] = []
    expected: list[tuple[int, list[int]]] = []
    program: dict[int, int] = {}

    for _ in range(120):
        before = section(rng, FIRST_WORD)
        after = section(rng, before.end)
        # the program ends before the step begins
        step = section(rng, rng.choice([after.end + rng.randint(2, 6), rng.randrange(64, SIZE - 32)]))
        places = [before.end, step.start, step.end, after.end]
        program = {address: 0 for address, word in program.items() if word}  # of the one before
        for part in (before, after, step):
            program.update(enumerate(part.words, part.start))

        def cycle(
            clear: int = 0,
            start: int = 0,
            stop: int = 0,
            reapply: int = 0,
            write: tuple[int, int, int] = (0, 0, 0),
            places: list[int] = places,
        ) -> None:
            fields = [clear, start, stop, reapply, *write, *places]
            stimulus.append(pack(zip(fields, WIDTHS, strict=True)))

        for address, word in program.items():
            cycle(write=(1, address, word))
        for _ in range(3):  # the same program again, without a reset
            reapply = rng.randrange(2)
            played = [(slot, 0) for slot in before.played]
            played += [(slot, 0) for slot in step.played if reapply]
            played += [(slot, reapply) for slot in after.played]
            length = len(played) + 1  # stopped by `finished` in the cycle of the last word
            cut = rng.choice(["", "", "", "stop", "clear"])
            ended = rng.randrange(1, length) if cut else length
            started = len(stimulus)
            cycle(start=1, reapply=reapply)
            for number in range(1, length + rng.randint(2, 9)):
                hit = int(number == ended)
                cycle(clear=hit * (cut == "clear"), stop=hit * (cut == "stop"), reapply=reapply)
            last = ended + (cut != "clear")  # the word fetched in the cycle of the stop is out after it
            for number, (slot, applied) in enumerate(played, FIRST_WORD):
                if slot is not None and number <= last:
                    expected.append((started + number, [*slot, applied]))
    top = Path(__file__).parent / "sequencer_replay.v"
    got = run(top, ["oltae"], simulator, tmp_path, stimulus, sum(WIDTHS), [10, 1, 1], {})
    for mine, theirs in zip(got, expected, strict=False):
        assert mine == theirs
    assert len(got) == len(expected)
