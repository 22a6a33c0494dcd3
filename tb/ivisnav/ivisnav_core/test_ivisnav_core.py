# SPDX-License-Identifier: Apache-2.0
"""ivisnav_core within its top: a few frames of every kind, quick enough to try many mutants."""

from __future__ import annotations

import random
from dataclasses import replace

import pytest
from relnav.ivisnav.quantise import QuantisedRows
from relnav.model.rates_core import RatesCore
from relnav.rtlsim import run_rate_frames

from tb.ivisnav.frames import random_rows


@pytest.mark.parametrize(("feed", "variance"), [("stream", 2.0), ("registers", 0.0)])
def test_a_few_frames(feed: str, variance: float, simulator: str) -> None:
    """Bit for bit the model's; too few rows and a singular set among them; one latency."""
    rng = random.Random(feed)
    model = RatesCore()

    def good(n: int) -> QuantisedRows:
        while True:
            frame = replace(random_rows(rng, n, "rates"), frac_h=30, frac_y=30)
            if not model.run(frame, variance).failed:
                return frame

    frames = [good(7), random_rows(rng, 6, "random"), random_rows(rng, 5, "small"), good(8), good(12)]
    frames.insert(2, replace(frames[0], h=frames[0].h * 0))
    expected = [model.run(frame, variance) for frame in frames]
    assert model.run(frames[0], variance + 0.5).words != expected[0].words
    cycles = set()
    results = run_rate_frames(frames, simulator, variance=variance, feed=feed)
    for result, want in zip(results, expected, strict=True):
        assert result.flag_names == want.flag_names
        if want.failed:
            assert result.words is None
            continue
        assert replace(result, used=want.used, cycles_rates=None, cycles_all=None) == want
        cycles.add((result.cycles_rates, result.cycles_all))
    assert cycles == {(345, 472)}
