# SPDX-License-Identifier: Apache-2.0
"""oltae_top, full and lean, on both simulators: benches at its ports, and long frames by the user's way."""

from __future__ import annotations

import random
from dataclasses import replace

import numpy as np
import pytest
from relnav.model.core import OltaeCore
from relnav.model.raw import CoreConfig, RawResult
from relnav.quantise import INPUT_MIN, QuantisedFrame
from relnav.rtlsim import run_frames

from sim.runner import SIMULATORS, build_and_test, missing, sources
from tb.oltae.frames import observe, random_frame

BUILDS = {
    "full": {"WEIGHTED": 1, "COVARIANCE": 1, "REAPPLY": 1, "VERIFY": 1},
    "lean": {"WEIGHTED": 0, "COVARIANCE": 0, "REAPPLY": 0, "VERIFY": 0},
}
# Icarus simulates some 3000 clocks a second, a twentieth of Verilator's
THOROUGH = {"FRAMES": "64", "STEP": "7"}
QUICK = {"FRAMES": "14", "STEP": "149"}
LONGEST = 65535


@pytest.mark.parametrize("bench", ["frames", "flags", "states"])
@pytest.mark.parametrize("build", BUILDS)
def test_ports(build: str, bench: str, simulator: str) -> None:
    """The cocotb tests of oltae_top_*_bench."""
    build_and_test(
        "oltae_top",
        sources(),
        f"oltae_top_{bench}_bench",
        simulator=simulator,
        parameters=BUILDS[build],
        env={"FULL": str(int(build == "full")), **(THOROUGH if simulator == "verilator" else QUICK)},
    )


def check(
    frames: list[QuantisedFrame],
    got: list[RawResult],
    config: CoreConfig,
    *,
    weighted: bool = True,
    feed: str = "stream",
) -> None:
    """Bit for bit the model's; one latency each for weighted and unweighted frames."""
    model = OltaeCore(weighted=weighted)
    cycles: dict[bool, set[tuple[int | None, ...]]] = {False: set(), True: set()}
    for number, (frame, result) in enumerate(zip(frames, got, strict=True)):
        expected = model.run(frame, config)
        if not expected.failed:
            cycles[frame.w is not None].add((result.cycles_q, result.cycles_pose, result.cycles_all))
        plain = replace(result, cycles_q=None, cycles_pose=None, cycles_all=None)
        assert plain == expected, f"frame {number}, n {frame.n}, frac {frame.frac}"
        observe(frame, config, feed, result)
    assert all(len(found) <= 1 for found in cycles.values()), cycles


@pytest.mark.parametrize("build", BUILDS)
def test_longest_frames(build: str) -> None:
    """65535 points, the largest sums there can be, and one point too many; on Verilator for its speed."""
    if reason := missing("verilator"):
        pytest.skip(reason)
    full = build == "full"
    lowest = np.full((LONGEST, 3), INPUT_MIN, dtype=np.int64)
    corner = lowest.copy()
    corner[:2] = [[0, INPUT_MIN, -1], [-1, 0, INPUT_MIN]]
    heaviest = np.full(LONGEST, 65535, dtype=np.int64)
    rng = random.Random(1)
    frames = [
        random_frame(rng, LONGEST, False, "pose"),
        random_frame(rng, LONGEST + 1, False, "small"),
        QuantisedFrame(lowest, lowest, None, 0),
        QuantisedFrame(corner, corner, None, 95),
        random_frame(rng, 3, False, "pose"),
    ]
    if full:
        frames.insert(2, random_frame(rng, LONGEST, True, "random"))
        frames += [QuantisedFrame(corner, corner, heaviest, -64), random_frame(rng, 4, True, "pose")]
    config = CoreConfig(covariance=full)
    check(
        frames,
        run_frames(frames, "verilator", config=config, parameters=BUILDS[build]),
        config,
        weighted=full,
    )


@pytest.mark.parametrize("feed", ["stream", "registers"])
def test_simulators_agree(feed: str) -> None:
    """The same words and the same cycles from both, and the model's."""
    if reason := next(filter(None, map(missing, SIMULATORS)), None):
        pytest.skip(reason)
    rng = random.Random(feed)
    frames = [random_frame(rng) for _ in range(12)]
    config = CoreConfig(variance=2.0, reapply=feed == "registers")
    icarus, verilator = (run_frames(frames, name, config=config, feed=feed) for name in SIMULATORS)
    assert icarus == verilator
    check(frames, icarus, config, feed=feed)
