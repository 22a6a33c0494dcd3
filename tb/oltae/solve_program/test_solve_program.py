# SPDX-License-Identifier: Apache-2.0
"""solve_program: the word of every address in every build, and the way through the re-application."""

from __future__ import annotations

import random
from pathlib import Path

import pytest
from relnav.model.rom import ADDRESS, WIDTH, Layout, layout

from tb.common.replay import run
from tb.common.vectors import pack

LAST = (1 << ADDRESS) - 1


def beside(rom: Layout, running: bool, address: int, counter: int, reapply: bool, built: bool) -> list[int]:
    """leaving, following, redrain, finished; built: whether there is a re-application."""
    leaving = built and counter == rom.leave
    calling = built and reapply and counter == rom.call
    following = rom.target if calling else rom.call if leaving else counter
    return [leaving, following, running and address == rom.redrain, address == rom.finished]


@pytest.mark.parametrize("reapply_built", [1, 0])
@pytest.mark.parametrize("covariance_built", [1, 0])
def test_every_address(covariance_built: int, reapply_built: int, simulator: str, tmp_path: Path) -> None:
    """Running and not, with the counter anywhere, and at the addresses of the re-application."""
    rom, rng = layout(), random.Random(5)
    built = {"": 1, "COVARIANCE": covariance_built, "REAPPLY": reapply_built}
    marks = [rom.call, rom.target, rom.leave, rom.finished, rom.redrain]
    cases = [(run, a, rng.choice([a, *marks]), rng.randrange(2)) for a in range(LAST) for run in (1, 0)]
    cases += [(run, 0, counter, wish) for run in (1, 0) for counter in marks for wish in (1, 0)]
    rng.shuffle(cases)
    stimulus = [pack([(1, 1), (r, 1), (a, ADDRESS), (c, ADDRESS), (w, 1)]) for r, a, c, w in cases]
    top = Path(__file__).parent / "solve_program_replay.v"
    widths = [1, ADDRESS, 1, 1, WIDTH]
    bits = 3 + 2 * ADDRESS
    parameters = {"COVARIANCE": covariance_built, "REAPPLY": reapply_built}
    got = run(top, ["oltae"], simulator, tmp_path, stimulus, bits, widths, parameters)
    assert len(got) == len(cases)
    for (cycle, fields), (number, (running, address, counter, wish)) in zip(
        got, enumerate(cases), strict=True
    ):
        word, needs, _ = rom.words.get(address, (0, "", ""))
        expected = beside(rom, bool(running), address, counter, bool(wish), bool(reapply_built))
        expected.append(word if running and built[needs] else 0)
        assert (cycle, fields) == (number + 1, [int(value) for value in expected]), (address, counter)
