# SPDX-License-Identifier: Apache-2.0
"""Run the examples and fill examples/README.md: what each prints, pictures where no recorded data are used.

python -m scripts.examples [NAME ...]
"""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from PIL import Image

from scripts.marked import fill

ROOT = Path(__file__).resolve().parent.parent
README = ROOT / "examples" / "README.md"
IMAGES = ROOT / "docs" / "images"
# The picture of a run that uses recorded data is not kept: the data are not the project's.
RUNS = {
    "rgbd_odometry": (("rgbd_odometry",), False),
    "scan_alignment": (("scan_alignment",), False),
    "scan_alignment_terrain": (("scan_alignment", "--scans", "terrain"), True),
    "landing": (("landing",), True),
    "proximity": (("proximity",), True),
}
LARGEST = 150_000  # bytes of a picture
WIDTH = 1100


def main(names: list[str]) -> int:
    """Run those named, or all; an example that is skipped leaves its block as it is."""
    if unknown := set(names) - RUNS.keys():
        raise SystemExit(f"no example {', '.join(sorted(unknown))}: one of {', '.join(RUNS)}")
    for name in names or RUNS:
        (module, *options), kept = RUNS[name]
        command = ["python", "-m", f"examples.{module}", *options]
        done = subprocess.run(
            [sys.executable, *command[1:]], cwd=ROOT, capture_output=True, text=True, check=False
        )
        print(f"{name}: {done.stdout or done.stderr}", end="" if done.stdout or done.stderr else "\n")
        if done.returncode != 0:
            return done.returncode
        if not done.stdout.startswith("skipped"):
            fill(README, name, f"```text\n$ .venv/bin/{' '.join(command)}\n{done.stdout}```")
            if kept:
                shrink(ROOT / "out" / "examples" / f"{module}.png", IMAGES / f"example_{module}.png")
    return 0


def shrink(source: Path, target: Path) -> None:
    """The picture in few colours, small enough for the repository."""
    picture = Image.open(source).convert("RGB")
    height = round(picture.height * WIDTH / picture.width)
    picture = picture.resize((WIDTH, height), Image.Resampling.LANCZOS)
    for colours in (128, 96, 64, 48, 32, 16):
        picture.quantize(colours, Image.Quantize.MAXCOVERAGE, dither=Image.Dither.NONE).save(
            target, optimize=True
        )
        if target.stat().st_size <= LARGEST:
            return
    raise SystemExit(f"{target.name} has more than {LARGEST} bytes")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
