# SPDX-License-Identifier: Apache-2.0
"""The campaign of upsets: its table of classes, what it counts, and a few flips."""

from __future__ import annotations

import random
import re
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import pytest

from faults import classes
from faults.campaign import Row, offences
from faults.classes import CONFIGURATION, CONTROL, DATA, classify, patterns
from faults.flipflops import Bit, bits_of
from faults.frames import WAYS
from faults.trials import BUILD, Model, Outcome, Seen, Trial, build, draw, run, window
from sim.runner import missing
from sim.sources import ROOT, RTL

STEERS = re.compile(
    r"[._](valid|tag|state|busy|address|index|mark|pending|live)(_\d+)?$|\.(run|lane|slot|done|last)(_\d+)?$"
)
"""Names of what steers."""


@pytest.fixture(scope="module")
def bits(tmp_path_factory: pytest.TempPathFactory) -> dict[str, list[Bit]]:
    pytest.importorskip("pyosys", reason="pyosys is not installed")
    return {top: bits_of(top, RTL, tmp_path_factory.mktemp(top)) for top in WAYS}


@pytest.fixture(scope="module")
def model() -> Model:
    why = missing("verilator")
    if why:
        pytest.skip(why)
    pytest.importorskip("pyosys", reason="pyosys is not installed")
    return build("oltae_top")


# ---------------------------------------------------------------------------------------------- classes


def test_every_line_of_the_table_speaks_of_a_register(bits: dict[str, list[Bit]]) -> None:
    keys = {bit.key: bit for found in bits.values() for bit in found if not bit.memory}.values()
    idle = [line for line in patterns() if not any(line.matches(bit) for bit in keys)]
    assert not idle


def test_every_flip_flop_has_one_class(bits: dict[str, list[Bit]]) -> None:
    for found in bits.values():
        sorted_out = classify(found)
        assert sum(map(len, sorted_out.values())) == len(found) == len({bit.name for bit in found})
        assert all(sorted_out.values())


def test_nothing_that_steers_is_called_data(bits: dict[str, list[Bit]]) -> None:
    data = {bit.key for found in bits.values() for bit in classify(found)[DATA]}
    assert not {key for key in data if STEERS.search(key)}


@pytest.mark.parametrize(
    ("top", "name", "kind"),
    [
        ("oltae_top", "sequencer.counter", CONTROL),
        ("oltae_top", "solve_program.word", CONTROL),
        ("ivisnav_top", "rates_program.word", CONTROL),
        ("ivisnav_top", "mac_cell.sum", DATA),
    ],
)
def test_classes(bits: dict[str, list[Bit]], top: str, name: str, kind: str) -> None:
    some = [bit for bit in bits[top] if bit.key == name]
    assert some and classify(some)[kind] == some


@pytest.mark.parametrize(
    "text",
    [
        '[[data]]\nmodule = "a"\nregisters = ["b"]\nreason = " "\n',
        '[[control]]\nmodule = "a"\nregisters = ["b"]\nreason = "c"\n',
    ],
)
def test_bad_table(tmp_path: Path, text: str) -> None:
    file = tmp_path / "classes.toml"
    file.write_text(text)
    with pytest.raises(SystemExit, match=r"faults: classes\.toml"):
        patterns(file)


def test_a_register_of_two_classes_is_refused() -> None:
    line = classes.Pattern(DATA, "m", "*", "")
    with pytest.raises(ValueError, match="configuration and data"):
        classify([BIT], [line, replace(line, kind=CONFIGURATION)])


# ---------------------------------------------------------------------------------------------- counts

BIT = Bit("m.r", "m", "r", False, "m", "top.m", "r", -1, 0)
GOOD = Seen(0, 0, False, False, False, False, False, 100, 0, 0)


@pytest.mark.parametrize(
    ("seen", "verdict"),
    [
        (GOOD, "masked"),
        (replace(GOOD, diagnostic=1), "diagnostic"),
        (replace(GOOD, wrong=2, diagnostic=1), "silent"),
        (replace(GOOD, wrong=2, flags=1), "flagged"),
        (replace(GOOD, differs=True), "flagged"),
        (replace(GOOD, error=True, wrong=1), "flagged"),
        (replace(GOOD, end=1, flags=256), "flagged"),
        (replace(GOOD, end=3), "flagged"),
        (replace(GOOD, end=2), "hang"),
        (replace(GOOD, end=2, flags=32), "flagged"),
        (replace(GOOD, dead=True, flags=1), "hang"),
    ],
)
def test_verdict(seen: Seen, verdict: str) -> None:
    assert seen.verdict == verdict


def _outcome(verdict: str, next_: str, later: str = "", how: tuple[str, ...] = ()) -> Outcome:
    return Outcome(Trial(BIT, "stream", 0, 1), verdict, next_, later, how=how)


@pytest.mark.parametrize(
    ("one", "kind", "bad"),
    [
        (_outcome("masked", "right"), CONTROL, []),
        (_outcome("flagged", "right"), CONTROL, []),
        (_outcome("flagged", "flagged", "right"), CONTROL, []),
        (_outcome("silent", "right"), DATA, []),
        (_outcome("silent", "right"), CONTROL, ["silent wrong result"]),
        (_outcome("silent", "right"), CONFIGURATION, ["silent wrong result"]),
        (_outcome("hang", "right"), DATA, ["hang"]),
        (
            _outcome("hang", "hang", "hang"),
            DATA,
            ["hang for good", "next frame hangs", "not right after a soft reset"],
        ),
        (_outcome("masked", "wrong", "right"), DATA, ["next frame wrong"]),
        (_outcome("masked", "right", how=("stray in frame 1",)), DATA, ["answer to no request"]),
    ],
)
def test_offences(one: Outcome, kind: str, bad: list[str]) -> None:
    assert offences(one, kind) == bad
    row = Row()
    row.add(one, kind)
    table = row.table()
    assert table[one.verdict] == table[f"next {one.next}"] == table["trials"] == 1
    assert table["offences"] == bool(bad)
    assert table["recovered"] == (one.verdict in ("flagged", "silent", "hang") and one.next == "right")


# ---------------------------------------------------------------------------------------------- flips


def _draw(model: Model, some: Sequence[Bit], count: int) -> list[Trial]:
    parts = {"stream": window(model, "stream", 1).parts}
    return [
        draw(model.top, parts, bit, k, 1) for k, bit in enumerate(random.Random(1).sample(list(some), count))
    ]


def test_a_sample_does_nothing_that_may_not_be(model: Model) -> None:
    kinds = classify(model.bits)
    for kind, count in ((CONTROL, 20), (CONFIGURATION, 8), (DATA, 10)):
        trials = _draw(model, kinds[kind], count)
        found = run(model, "stream", 1, trials)
        assert {one.trial.bit.name for one in found} == {trial.bit.name for trial in trials}
        assert not [one for one in found if offences(one, kind)]


def test_a_flip_acts_and_comes_again(model: Model) -> None:
    # accumulators, in every clock: some flips are noticed, or wrong; to the end or not, the same
    bit = next(bit for bit in model.bits if bit.key == "mac_cell.sum")
    trials = [Trial(bit, "stream", clock, 1) for clock in range(0, 60, 2)]
    first = run(model, "stream", 1, trials)
    again = run(model, "stream", 1, trials, whole=True)
    assert any(one.verdict not in ("masked", "diagnostic") for one in first)
    assert [(one.trial.clock, one.verdict, one.next) for one in first] == [
        (one.trial.clock, one.verdict, one.next) for one in again
    ]


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--flip", "core.x"], "--flip needs --core"),
        (["--rtl", "no/such"], "is no folder"),
        (["--core", "oltae", "--flip", "core.nothing"], "has no flip-flop core.nothing"),
        (["--core", "oltae", "--flip", "core.points[0]", "--way", "no"], "has no way no"),
    ],
)
def test_bad_arguments(model: Model, arguments: list[str], message: str) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "faults", *arguments], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert done.returncode == 2
    assert message in done.stderr and len(done.stderr.strip().splitlines()) == 1
    assert BUILD.is_dir()
