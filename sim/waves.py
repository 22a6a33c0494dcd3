# SPDX-License-Identifier: Apache-2.0
"""For `make waves`: a short simulation of oltae_top where there is no waveform yet, and its GTKWave layout.

python -m sim.waves          two small frames, the waveform to build/waves
python -m sim.waves FILE     the saved layout moved to FILE's last complete frame; prints where it is
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pywellen
from relnav.frames import Frame
from relnav.quantise import quantise
from relnav.rtlsim import run_frames

from sim.runner import ROOT, SIMULATORS, missing

WAVES = ROOT / "build" / "waves" / "oltae_top.fst"
LAYOUT = ROOT / "sim" / "oltae_top.gtkw"
FRAME_END = "oltae_harness.top.frame_end"
BEFORE = 150_000  # ps shown before the last beat: 15 clocks


def simulate() -> int:
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


def place_layout(wave: Path) -> Path:
    """A copy of the layout beside the waveform that opens at the last frame's last beat, the marker on it."""
    signals = [v for v in pywellen.Waveform(str(wave)).all_vars() if v.full_name == FRAME_END]
    ends = [int(time) for signal in signals for time, level in signal.signal if level == 1]
    text = LAYOUT.read_text()
    if ends:
        lines = text.splitlines()
        for number, line in enumerate(lines):
            if line.startswith("[timestart]"):
                lines[number] = f"[timestart] {max(0, ends[-1] - BEFORE)}"
            elif line.startswith("*"):
                zoom, _, others = line.split(" ", 2)
                lines[number] = f"{zoom} {ends[-1]} {others}"
        text = "\n".join(lines) + "\n"
    placed = wave.with_suffix(".gtkw")
    placed.write_text(text)
    return placed


def main(arguments: list[str]) -> int:
    """Simulate, or place the layout for the file named."""
    if not arguments:
        return simulate()
    print(place_layout(Path(arguments[0]).resolve()).relative_to(ROOT))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
