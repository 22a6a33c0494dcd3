# SPDX-License-Identifier: Apache-2.0
"""ivisnav_top on both simulators: benches at its ports, and long frames by the user's way."""

from __future__ import annotations

import random
from dataclasses import replace

import numpy as np
import pytest
from relnav.ivisnav.quantise import QuantisedRows
from relnav.ivisnav.raw import RawRates
from relnav.model.rates_core import RatesCore
from relnav.quantise import INPUT_MIN
from relnav.rtlsim import run_rate_frames

from sim.runner import SIMULATORS, build_and_test, missing, sources
from tb.ivisnav.frames import observe, random_rows

# Icarus simulates some 3000 clocks a second, a twentieth of Verilator's
THOROUGH = {"FRAMES": "64", "STEP": "7"}
QUICK = {"FRAMES": "14", "STEP": "149"}
LONGEST = 65535


@pytest.mark.parametrize("bench", ["frames", "flags", "states"])
def test_ports(bench: str, simulator: str) -> None:
    """The cocotb tests of ivisnav_top_*_bench."""
    build_and_test(
        "ivisnav_top",
        sources(),
        f"ivisnav_top_{bench}_bench",
        simulator=simulator,
        env=THOROUGH if simulator == "verilator" else QUICK,
    )


def check(frames: list[QuantisedRows], got: list[RawRates], variance: float, *, feed: str = "stream") -> None:
    """Bit for bit the model's; one latency."""
    model = RatesCore()
    cycles: set[tuple[int | None, ...]] = set()
    for number, (frame, result) in enumerate(zip(frames, got, strict=True)):
        expected = model.run(frame, variance)
        told = f"frame {number}, n {frame.n}, fracs {frame.frac_h} {frame.frac_y}"
        assert result.flag_names == expected.flag_names, told
        observe(frame, variance, feed, result)
        if expected.failed:
            assert result.words is None, told
            continue
        cycles.add((result.cycles_rates, result.cycles_all))
        assert replace(result, used=expected.used, cycles_rates=None, cycles_all=None) == expected, told
    assert len(cycles) <= 1, cycles


def test_longest_frames() -> None:
    """65535 rows, the largest sums there can be, and one row too many; on Verilator for its speed."""
    if reason := missing("verilator"):
        pytest.skip(reason)
    lowest = np.full((LONGEST, 6), INPUT_MIN, dtype=np.int64)
    corner = lowest.copy()
    corner[:6] = np.where(np.eye(6, dtype=bool), INPUT_MIN, 0)
    heaviest = np.full(LONGEST, 65535, dtype=np.int64)
    rng = random.Random(1)
    frames = [
        random_rows(rng, LONGEST, "rates"),
        random_rows(rng, LONGEST + 1, "small"),
        QuantisedRows(lowest, lowest[:, 0], heaviest, 0, 0),
        QuantisedRows(corner, corner[:, 1], heaviest, 95, -64),
        random_rows(rng, 6, "rates"),
        random_rows(rng, LONGEST, "random"),
    ]
    check(frames, run_rate_frames(frames, "verilator"), 0.0)


@pytest.mark.parametrize("feed", ["stream", "registers"])
def test_simulators_agree(feed: str) -> None:
    """The same words and the same cycles from both, and the model's."""
    if reason := next(filter(None, map(missing, SIMULATORS)), None):
        pytest.skip(reason)
    rng = random.Random(feed)
    frames = [random_rows(rng) for _ in range(12)]
    icarus, verilator = (run_rate_frames(frames, name, variance=2.0, feed=feed) for name in SIMULATORS)
    assert icarus == verilator
    check(frames, icarus, 2.0, feed=feed)
