# SPDX-License-Identifier: Apache-2.0
"""Latency of oltae_top in cycles, from its own counters, into the table of docs/oltae.md.

python scripts/latency.py [--simulator icarus|verilator]
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT), str(ROOT / "sw")]

from relnav.frames import make_frame  # noqa: E402 (the path is set above)
from relnav.model.raw import CoreConfig  # noqa: E402
from relnav.quantise import QuantisedFrame, quantise  # noqa: E402
from relnav.rtlsim import run_frames  # noqa: E402

from scripts.marked import fill  # noqa: E402

LEAN = {"WEIGHTED": 0, "COVARIANCE": 0, "REAPPLY": 0}


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


def main() -> int:
    """Simulate every build and mode."""
    parser = argparse.ArgumentParser(description="latency of oltae_top, into docs/oltae.md")
    parser.add_argument("--simulator", default="icarus", choices=("icarus", "verilator"))
    simulator = parser.parse_args().simulator
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
    fill(ROOT / "docs" / "oltae.md", "latency", "\n".join(lines))
    print("\n".join(lines))
    return 0


if __name__ == "__main__":
    sys.exit(main())
