# SPDX-License-Identifier: Apache-2.0
"""Latency of the cores in cycles, from their own counters, into the tables of docs/oltae.md and ivisnav.md.

python scripts/latency.py [--simulator icarus|verilator] [--core oltae|ivisnav]
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT), str(ROOT / "sw")]

from relnav.frames import make_frame  # noqa: E402 (the path is set above)
from relnav.model.rates_program import Mark  # noqa: E402
from relnav.model.rates_schedule import schedule  # noqa: E402
from relnav.model.raw import CoreConfig  # noqa: E402
from relnav.quantise import QuantisedFrame, quantise  # noqa: E402
from relnav.rtlsim import run_frames, run_rate_frames  # noqa: E402

from bench.rate_cases import noisy_rows, ring_rows  # noqa: E402
from scripts.marked import fill, table  # noqa: E402

LEAN = {"WEIGHTED": 0, "COVARIANCE": 0, "REAPPLY": 0, "VERIFY": 0}


def frame(weighted: bool, degrees: float) -> QuantisedFrame:
    """Twenty points turned about z."""
    rng, angle = np.random.default_rng(1), np.radians(degrees)
    a = rng.normal(size=(20, 3))
    c, s = np.cos(angle), np.sin(angle)
    b = (
        a @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]).T
        + rng.normal(size=3)
        + 1e-4 * rng.normal(size=a.shape)
    )
    return quantise(make_frame(a, b, rng.integers(1, 100, 20) if weighted else None))


def oltae(simulator: str) -> str:
    """Every build and mode."""
    modes: tuple[tuple[str, dict[str, int], bool, CoreConfig], ...] = (
        ("full, unweighted", {}, False, CoreConfig()),
        ("full, weighted", {}, True, CoreConfig()),
        ("full, unweighted, CONFIG.COVARIANCE = 0", {}, False, CoreConfig(covariance=False)),
        ("full, weighted, CONFIG.COVARIANCE = 0", {}, True, CoreConfig(covariance=False)),
        ("full, unweighted, CONFIG.REAPPLY = 1", {}, False, CoreConfig(reapply=True)),
        ("full, weighted, CONFIG.REAPPLY = 1", {}, True, CoreConfig(reapply=True)),
        ("lean", LEAN, False, CoreConfig(covariance=False)),
    )
    lines = ["| build and mode | q | R and t | everything |", "|---|---:|---:|---:|"]
    for name, parameters, weighted, config in modes:
        frames = [frame(weighted, degrees) for degrees in (20.0, 150.0)]  # the second takes a turn
        results = run_frames(frames, simulator, config=config, parameters=parameters)
        assert [result.turn for result in results] == [0, 3], results
        cells = []
        for key in ("cycles_q", "cycles_pose", "cycles_all"):
            straight, turned = (getattr(result, key) for result in results)
            cells.append(str(straight) if straight == turned else f"{straight} (turned {turned})")
        lines.append(f"| {name} | {' | '.join(cells)} |")
    return "\n".join(lines)


FIRST_SUM = 20  # gram_ring's, from the last beat
MOST_TO_REGISTER = 4


def ivisnav(simulator: str) -> str:
    """Where the cycles go by the schedule, and what the counters say."""
    rows = [ring_rows(("alternately skewed", 0.5, 2.0, weighted), 0) for weighted in (False, True)]
    rows.append(noisy_rows(1, 20, 40)[0])
    ((rates, everything),) = {(r.cycles_rates, r.cycles_all) for r in run_rate_frames(rows, simulator)}
    assert rates is not None and everything is not None
    marks = [schedule().cycle(mark) for mark in (Mark.RATES, Mark.ALL)]
    # behind the program both take the same pipeline: else schedule and RTL are of different times
    (behind,) = {counted - mark - FIRST_SUM for counted, mark in zip((rates, everything), marks, strict=True)}
    assert 0 < behind <= MOST_TO_REGISTER, behind
    return table(
        ("result", "last beat to first sum", "program", "to the register", "counted"),
        [
            (name, str(FIRST_SUM), str(mark), str(behind), str(counted))
            for name, mark, counted in zip(
                ("v and omega", "rss and covariance"), marks, (rates, everything), strict=True
            )
        ],
    )


def main() -> int:
    """Simulate."""
    parser = argparse.ArgumentParser(
        description="latency of the cores, into docs/oltae.md and docs/ivisnav.md"
    )
    parser.add_argument("--simulator", default="icarus", choices=("icarus", "verilator"))
    parser.add_argument("--core", choices=MEASURES, help="one core (default: all)")
    options = parser.parse_args()
    for core in (options.core,) if options.core else MEASURES:
        text = MEASURES[core](options.simulator)
        fill(ROOT / "docs" / f"{core}.md", "latency", text)
        print(f"{core}\n{text}\n")
    return 0


MEASURES = {"oltae": oltae, "ivisnav": ivisnav}


if __name__ == "__main__":
    sys.exit(main())
