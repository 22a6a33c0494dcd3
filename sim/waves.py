# SPDX-License-Identifier: Apache-2.0
"""For `make waves`: a short simulation of a core where there is no waveform yet, and its GTKWave layout.

python -m sim.waves TOP         two small frames through oltae_top or ivisnav_top, the waveform to build/waves
python -m sim.waves TOP FILE    the core's saved layout moved to FILE's last complete frame; prints its place
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pywellen
from relnav.frames import Frame
from relnav.ivisnav.quantise import QuantisedRows
from relnav.quantise import quantise
from relnav.rtlsim import run_frames, run_rate_frames

from sim.runner import ROOT, SIMULATORS, missing

FOLDER = ROOT / "build" / "waves"
FRAME_END = "core_harness.top.frame_end"
BEFORE = 150_000  # ps shown before the last beat: 15 clocks


def pose_frames(simulator: str, waves: Path) -> None:
    """Twelve points turned by 0.3 rad about z and moved, twice."""
    a = np.random.default_rng(1).normal(size=(12, 3))
    turn = np.array([[np.cos(0.3), -np.sin(0.3), 0], [np.sin(0.3), np.cos(0.3), 0], [0, 0, 1]])
    frames = [quantise(Frame(name, a, a @ turn.T + 0.5, None)) for name in (0, 1)]
    run_frames(frames, simulator, waves=waves)


def rate_frames(simulator: str, waves: Path) -> None:
    """Twelve rows of a plate seen from the front, twice."""
    generator = np.random.default_rng(1)
    p = generator.uniform(-1.0, 1.0, (12, 3))
    r = p + generator.uniform(-1.0, 1.0, (12, 3)) + [0.0, 0.0, 5.0]
    r /= np.linalg.norm(r, axis=1)[:, None]
    h = np.hstack((r, np.cross(p, r)))
    y = h @ [0.1, -0.2, 0.3, 0.02, 0.01, -0.03]
    integers = [np.rint(np.ldexp(values, 28)).astype(np.int64) for values in (h, y)]
    frame = QuantisedRows(integers[0], integers[1], np.ones(12, np.int64), 28, 28)
    run_rate_frames([frame, frame], simulator, waves=waves)


CORES: dict[str, Callable[[str, Path], None]] = {"oltae_top": pose_frames, "ivisnav_top": rate_frames}


def layout(top: str) -> Path:
    """The core's saved GTKWave layout."""
    return ROOT / "sim" / f"{top}.gtkw"


def simulate(top: str) -> int:
    """Two frames, the waveform to build/waves."""
    simulator = next((name for name in reversed(SIMULATORS) if missing(name) is None), None)
    if simulator is None:
        print("waves: no simulator is installed here", file=sys.stderr)
        return 2
    CORES[top](simulator, FOLDER / f"{top}.fst")
    return 0


def place_layout(top: str, wave: Path) -> Path:
    """A copy of the layout beside the waveform that opens at the last frame's last beat, the marker on it."""
    signals = [v for v in pywellen.Waveform(str(wave)).all_vars() if v.full_name == FRAME_END]
    ends = [int(time) for signal in signals for time, level in signal.signal if level == 1]
    text = layout(top).read_text()
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
    if not arguments or arguments[0] not in CORES:
        print(f"waves: which core? {' or '.join(CORES)}", file=sys.stderr)
        return 2
    if len(arguments) == 1:
        return simulate(arguments[0])
    print(place_layout(arguments[0], Path(arguments[1]).resolve()).relative_to(ROOT))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
