# SPDX-License-Identifier: Apache-2.0
"""Simulate two small frames on oltae_top and leave the waveform in build/waves (for `make waves`)."""

from __future__ import annotations

import sys

import numpy as np
from relnav.frames import Frame
from relnav.quantise import quantise
from relnav.rtlsim import run_frames

from sim.runner import ROOT, SIMULATORS, missing

WAVES = ROOT / "build" / "waves" / "oltae_top.fst"


def main() -> int:
    """Twelve points turned by 0.3 rad about z and moved, twice."""
    simulator = next((name for name in reversed(SIMULATORS) if missing(name) is None), None)
    if simulator is None:
        print("waves: no simulator is installed here", file=sys.stderr)
        return 2
    a = np.random.default_rng(1).normal(size=(12, 3))
    turn = np.array([[np.cos(0.3), -np.sin(0.3), 0], [np.sin(0.3), np.cos(0.3), 0], [0, 0, 1]])
    frames = [quantise(Frame(name, a, a @ turn.T + 0.5, None)) for name in (0, 1)]
    run_frames(frames, simulator, waves=WAVES)
    return 0


if __name__ == "__main__":
    sys.exit(main())
