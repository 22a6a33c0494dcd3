# SPDX-License-Identifier: Apache-2.0
"""oltae_core within its top: a few frames of every kind, quick enough to try many mutants."""

from __future__ import annotations

import random
from dataclasses import replace

import pytest
from relnav.model.core import OltaeCore
from relnav.model.raw import CoreConfig
from relnav.rtlsim import run_frames

from tb.oltae.frames import random_frame

FULL = {"WEIGHTED": 1, "COVARIANCE": 1, "REAPPLY": 1, "VERIFY": 1}
LEAN = dict.fromkeys(FULL, 0)
CASES = {
    "full": (FULL, CoreConfig(covariance=True, variance=2.0), "stream"),
    "reapplied": (FULL, CoreConfig(forbid_turns=True, reapply=True, covariance=True), "registers"),
    "lean": (LEAN, CoreConfig(covariance=False), "stream"),
}


@pytest.mark.parametrize("case", CASES)
def test_a_few_frames(case: str, simulator: str) -> None:
    """Bit for bit the model's; too few points and a singular set among them; one latency for each kind."""
    parameters, config, feed = CASES[case]
    weighted = parameters is FULL
    rng = random.Random(case)
    kinds = [("pose", 4), ("far", 3), ("small", 2), ("extreme", 5), ("random", 3)]
    frames = [random_frame(rng, n, weighted and n != 4, kind) for kind, n in kinds]
    frames.insert(2, replace(frames[0], b=frames[0].b * 0))
    model = OltaeCore(weighted=weighted)
    expected = [model.run(frame, config) for frame in frames]
    assert {len(one.flag_names) > 0 for one in expected} == {False, True}
    results = run_frames(frames, simulator, config=config, feed=feed, parameters=parameters)
    cycles = set()
    for frame, result, want in zip(frames, results, expected, strict=True):
        assert replace(result, cycles_q=None, cycles_pose=None, cycles_all=None) == want
        if not want.failed:
            cycles.add((frame.w is None, result.cycles_q, result.cycles_pose, result.cycles_all))
    assert len(cycles) == len({unweighted for unweighted, *_ in cycles})
