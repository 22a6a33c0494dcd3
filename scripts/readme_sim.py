# SPDX-License-Identifier: Apache-2.0
"""Fill the README from runs: table and picture of `make sim`, output of the examples, numbers.

python scripts/readme_sim.py    after `make sim`; uses what `make synth`, `make timing` and bench/ left
"""

from __future__ import annotations

import contextlib
import io
import json
import math
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

from PIL import Image

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT), str(ROOT / "sw")]

from relnav.report.page import solver_name  # noqa: E402 (the path is set above)
from relnav.report.summary import Row, key_table  # noqa: E402

from scripts.marked import fill  # noqa: E402

README = ROOT / "README.md"
PICTURE = ROOT / "docs" / "images" / "landing.png"
EXAMPLE = "docs/examples/points.csv"
LARGEST = 200_000  # bytes of the picture
WIDTH = 1000

Json = dict[str, Any]


def load(path: str) -> Json:
    """A JSON file of the checkout, empty where there is none."""
    file = ROOT / path
    found: Json = json.loads(file.read_text(encoding="utf-8")) if file.is_file() else {}
    return found


def block(text: str, language: str = "text") -> str:
    """A fenced block."""
    return f"```{language}\n{text.rstrip()}\n```"


def sim(summary: Json) -> str:
    """What `make sim` prints at its end."""
    title = (
        f"Landing over {summary['terrain']}: {summary['frames']} frames, {summary['poses']} poses "
        f"by {solver_name(summary['backend'])}"
    )
    outcome = "PASS" if summary["passed"] else "FAIL"
    table = key_table(title, [Row(**row) for row in summary["key_table"]])
    return block(f"{table}\n\n{outcome}: {summary['verdict']}\nReport: out/report.html")


def picture(out: Path) -> None:
    """Ground track and errors of t, one above the other, in few colours."""
    parts = [Image.open(out / name).convert("RGB") for name in ("flight.png", "fig11_translation_error.png")]
    parts = [
        part.resize((WIDTH, round(part.height * WIDTH / part.width)), Image.Resampling.LANCZOS)
        for part in parts
    ]
    whole = Image.new("RGB", (WIDTH, sum(part.height for part in parts)), "white")
    top = 0
    for part in parts:
        whole.paste(part, (0, top))
        top += part.height
    for colours in (192, 128, 96, 64, 48, 32):
        whole.quantize(colours, dither=Image.Dither.NONE).save(PICTURE, optimize=True)
        if PICTURE.stat().st_size <= LARGEST:
            return
    raise SystemExit(f"{PICTURE.name} has more than {LARGEST} bytes")


def pose() -> str:
    """The example through the RTL, as a table."""
    command = [".venv/bin/relnav", "pose", EXAMPLE, "--backend", "verilator"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    if done.returncode != 3:  # one of its frames has no pose
        raise SystemExit(f"{' '.join(command)}: exit {done.returncode}: {done.stderr}")
    shown = f"$ {' '.join(command)}\n{done.stdout}$ echo $?\n{done.returncode}"
    return f"{block((ROOT / EXAMPLE).read_text(), 'csv')}\n\n{block(shown)}"


def python() -> str:
    """What the README's Python example prints."""
    code = re.search(r"```python\n(.*?)```", README.read_text(encoding="utf-8"), re.DOTALL)
    if code is None:
        raise SystemExit("README.md has no Python example")
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        exec(code[1], {})
    return block(printed.getvalue())


def numbers(summary: Json, syn: Json, bench: Json) -> str:
    """The table beside the paper; what has not been run yet says so."""
    rows: list[tuple[str, str, str]] = []
    error = summary["relative_error_percent_max"]
    rows.append(
        ("q3, tx, tz of the landing, deviation from double, max", "7 %", f"{max(error['core']):.1e} %")
    )
    for run in error["paper_q15_16"]:
        worst = [value for value in run["worst"] if value is not None]
        shown = f"{max(worst):.2g} %" if len(worst) == len(run["worst"]) else "no result"
        rows.append((f"the paper's Q15.16 on the same landing, {run['scale']}", "", shown))
    rows.append(
        (
            "relative error of q to the exact solution, landing, max",
            "not given",
            f"{summary['numerical_error_max']:.1e}",
        )
    )
    rows += bench_rows(bench)
    cycles = summary["cycles"]
    rows.append(
        (
            "cycles from the last beat to q",
            f"{summary['paper_cycles']}, of centred points",
            str(max(cycles["q"])),
        )
    )
    rows.append(("to R and t", "software", str(max(cycles["pose"]))))
    rows.append(("to rss and covariances", "software", str(max(cycles["all"]))))
    rows.append(("cycles a point", "several register writes", "3, weighted 6"))
    rows += area_rows(syn)
    lines = [
        "| | paper | here |",
        "|---|---|---|",
        *(f"| {name} | {paper} | {here} |" for name, paper, here in rows),
    ]
    return "\n".join(lines)


def area_rows(syn: Json) -> list[tuple[str, str, str]]:
    """Area of both builds and the routed clock."""
    core = syn.get("oltae_top", {})
    rows = []
    area = core.get("area")
    for build, content in (area or {"builds": {"full": None, "lean": None}})["builds"].items():
        total = content and content["total"]
        shown = (
            " / ".join(f"{total[c]:g}" for c in ("LUT", "FF", "DSP")) if total else "not run: `make synth`"
        )
        rows.append((f"LUT / FF / DSP, xc7, {build} build", "5545 / 7597 / 137", shown))
    timing = core.get("timing")
    fmax = timing and (timing.get("fmax_mhz") or timing.get("fmax"))
    rows.append(
        (
            "clock",
            "100 MHz (xc7z020)",
            f"{fmax:.0f} MHz (ECP5-85k, grade 8, routed)" if fmax else "not run: `make timing`",
        )
    )
    return rows


def bench_rows(bench: Json) -> list[tuple[str, str, str]]:
    """Accuracy by condition number and 3-sigma shares, of bench/."""
    rows: list[tuple[str, str, str]] = []
    if accuracy := bench.get("accuracy"):
        if (worst := accuracy.get("worst_below_quiet")) is not None:
            where = f"kappa(M) < {accuracy['bound_kappa']:g}, angle below {quiet_degrees(accuracy)}"
            rows.append((f"the same, random clouds, {where}, max", "not given", f"{worst['q']:.1e}"))
        for entry in accuracy["bins"]:
            if "R" in entry:
                where = f"any angle, kappa(M) < {entry['kappa_below']:g}"
                rows.append(
                    (
                        f"error of an element of R, {where}, max of {entry['cases']}",
                        "not given",
                        f"{entry['R']['error']:.0e}",
                    )
                )
    else:
        rows.append(("the same, random clouds", "not given", "not run: `python -m bench.accuracy`"))
    if sigma := bench.get("three_sigma"):
        for row in sigma["angles"]:
            shares = row["inside"].values()
            name = f"errors inside 3 sigma, {row['degrees']:g} degrees" + (
                ", re-applied" if row["reapplied"] else ""
            )
            shown = f"{100 * min(shares):.2f} to {100 * max(shares):.2f} %"
            rows.append((f"{name}, {row['trials']} trials", "all of 25 frames", shown))
    else:
        rows.append(("errors inside 3 sigma", "all of 25 frames", "not run: `python -m bench.three_sigma`"))
    return rows


def quiet_degrees(accuracy: Json) -> str:
    """The angle at which |q| reaches the bound up to which its relative error is promised."""
    return f"{math.degrees(2 * math.atan(accuracy['quiet'])):.1f} degrees"


def main() -> int:
    """Fill all blocks."""
    summary = load("out/summary.json")
    if "key_table" not in summary:
        raise SystemExit("out/summary.json is missing or of an older run: make sim")
    picture(ROOT / "out")
    changed = [
        name
        for name, text in (
            ("sim", sim(summary)),
            ("numbers", numbers(summary, load("syn/results.json"), load("bench/results.json"))),
            ("pose", pose()),
            ("python", python()),
        )
        if fill(README, name, text)
    ]
    print(
        f"README.md: {', '.join(changed) or 'nothing'} changed; {PICTURE.name} {PICTURE.stat().st_size} bytes"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
