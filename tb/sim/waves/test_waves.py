# SPDX-License-Identifier: Apache-2.0
"""The saved GTKWave layout: every signal in it exists, and it opens at the last frame."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from sim import runner
from sim.waves import CORES, layout, place_layout

pywellen = pytest.importorskip("pywellen", reason="pywellen is not installed")


@pytest.fixture(scope="module", params=CORES)
def wave(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    if reason := runner.missing("icarus"):
        pytest.skip(reason)
    top = str(request.param)
    file: Path = tmp_path_factory.mktemp("waves") / f"{top}.fst"
    CORES[top]("icarus", file)
    return file


def test_every_signal_of_the_layout_exists(wave: Path) -> None:
    text = layout(wave.stem).read_text()
    wanted = re.findall(r"^(?:\+\{[^}]*\} )?(core_harness\.\S+)$", text, re.MULTILINE)
    assert len(wanted) > 40
    found = {}
    for variable in pywellen.Waveform(str(wave)).all_vars():
        found[variable.full_name.split(" ")[0]] = int(variable.bitwidth or 1)
    for name in wanted:
        plain, _, span = name.partition("[")
        assert found.get(plain) == int(span.partition(":")[0] or 0) + 1, name


def test_it_opens_at_the_last_beat(wave: Path) -> None:
    text = place_layout(wave.stem, wave).read_text()
    start = re.search(r"\[timestart\] (\d+)", text)
    marker = re.search(r"^\*-[\d.]+ (\d+) ", text, re.MULTILINE)
    assert start is not None and marker is not None
    assert int(marker[1]) - int(start[1]) == 150_000 and int(start[1]) > 0
