# SPDX-License-Identifier: Apache-2.0
"""The binary32 units against netlists that Yosys' symfpu pass writes: they share nothing with ours."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from relnav.model.float32 import NAN

from sim.runner import ROOT, missing
from tb.arith.floats import (
    UINT32,
    Words,
    all_pairs,
    general_pairs,
    halfway_products,
    halfway_quotients,
    halfway_sums,
    join,
    special_words,
)
from tb.common.replay import run_rows
from tb.common.vectors import to_rows

OPERATIONS = ("mul", "add", "div")
COUNT = 25_000
"""Pairs of each of four kinds, besides the special ones."""
LATENCY = 14


@pytest.fixture(scope="module")
def netlists() -> list[Path]:
    """The three netlists, round to nearest even, below build/; skips where Yosys has no such pass."""
    pytest.importorskip("pyosys", reason="pyosys is not installed")
    folder = ROOT / "build" / "symfpu"
    folder.mkdir(parents=True, exist_ok=True)
    steps = []
    for operation in OPERATIONS:
        steps += [f"symfpu -op {operation} -rm RNE", "chformal -remove", f"rename symfpu symfpu_{operation}"]
        steps += [f"write_verilog -noattr {folder}/symfpu_{operation}.v", "design -reset"]
    code = f"from pyosys import libyosys as y\nd = y.Design()\nfor s in {steps!r}: y.run_pass(s, d)"
    made = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    said = made.stdout + made.stderr
    if "No such command: symfpu" in said:
        pytest.skip("this Yosys has no pass symfpu")
    assert made.returncode == 0, said[-2000:]
    return [folder / f"symfpu_{operation}.v" for operation in OPERATIONS]


def canonical(words: Words) -> Words:
    """Every NaN as the one that ours give."""
    return np.where((words & 0x7FFFFFFF) > 0x7F800000, np.uint32(NAN), words)


@pytest.mark.parametrize("simulator", ["verilator"])
@pytest.mark.skipif(missing("verilator") is not None, reason=missing("verilator") or "")
def test_units_equal_symfpu_netlists(simulator: str, netlists: list[Path], tmp_path: Path) -> None:
    rng = np.random.default_rng(77)
    kinds = (general_pairs, halfway_products, halfway_quotients, halfway_sums)
    x, y = join(all_pairs(special_words()), *(kind(rng, COUNT) for kind in kinds))
    control = np.ones(len(x), np.uint8)
    top = Path(__file__).parent / "float_reference_replay.v"
    stimulus = to_rows(control, x, y)
    # a row has the results of three different pairs: the last pairs' quotients follow the last products
    cycle, *columns = run_rows(
        top, ["arith"], simulator, tmp_path, stimulus, 72, [UINT32] * 6, {"DEPTH": 1 << 18}, netlists
    )
    assert np.array_equal(cycle, np.arange(len(x)) + LATENCY)
    for name, ours, theirs in zip(OPERATIONS, columns[0::2], columns[1::2], strict=True):
        wrong = np.flatnonzero(ours != canonical(theirs))
        assert not wrong.size, f"{name}: row {wrong[0]}: {ours[wrong[0]]:08x}, symfpu {theirs[wrong[0]]:08x}"
        assert len(np.unique(theirs)) > COUNT  # two constants would be equal too
