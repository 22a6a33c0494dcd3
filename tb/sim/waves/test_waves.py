# SPDX-License-Identifier: Apache-2.0
"""The saved GTKWave layout: every signal in it exists, and it opens at the last frame."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from relnav.frames import Frame
from relnav.quantise import quantise
from relnav.rtlsim import run_frames

from sim import runner
from sim.waves import LAYOUT, place_layout

pywellen = pytest.importorskip("pywellen", reason="pywellen is not installed")


@pytest.fixture(scope="module")
def wave(tmp_path_factory: pytest.TempPathFactory) -> Path:
    if reason := runner.missing("icarus"):
        pytest.skip(reason)
    file: Path = tmp_path_factory.mktemp("waves") / "oltae_top.fst"
    a = np.random.default_rng(1).normal(size=(4, 3))
    run_frames([quantise(Frame("one", a, a + 1.0, None))], "icarus", waves=file)
    return file


def test_every_signal_of_the_layout_exists(wave: Path) -> None:
    wanted = re.findall(r"^(?:\+\{[^}]*\} )?(oltae_harness\.\S+)$", LAYOUT.read_text(), re.MULTILINE)
    assert len(wanted) > 40
    found = {}
    for variable in pywellen.Waveform(str(wave)).all_vars():
        found[variable.full_name.split(" ")[0]] = int(variable.bitwidth or 1)
    for name in wanted:
        plain, _, span = name.partition("[")
        assert found.get(plain) == int(span.partition(":")[0] or 0) + 1, name


def test_it_opens_at_the_last_beat(wave: Path) -> None:
    text = place_layout(wave).read_text()
    start = re.search(r"\[timestart\] (\d+)", text)
    marker = re.search(r"^\*-[\d.]+ (\d+) ", text, re.MULTILINE)
    assert start is not None and marker is not None
    assert int(marker[1]) - int(start[1]) == 150_000 and int(start[1]) > 0
