# SPDX-License-Identifier: Apache-2.0
"""Fill the README from runs: tables and pictures of both simulations, output of the examples, numbers.

python scripts/readme_sim.py    after `make sim sim-ivisnav`; uses what synth, timing and bench left
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

from relnav.report.key_table import Row, key_table  # noqa: E402
from relnav.report.page import solver_name  # noqa: E402 (the path is set above)

from scripts.marked import fill  # noqa: E402
from tb.soak.cores import ivisnav_again, oltae_again  # noqa: E402

README = ROOT / "README.md"
IMAGES = ROOT / "docs" / "images"
PICTURES = {
    IMAGES / "landing.png": ("out/flight.png", "out/fig11_translation_error.png"),
    IMAGES / "proximity.png": ("out/proximity/fig05_driven.png", "out/proximity/fig07_percent.png"),
}
POINTS = "docs/examples/points.csv"
PHASES = "docs/examples/phases.csv"
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


def proximity(summary: Json) -> str:
    """What `make sim-ivisnav` prints at its end."""
    title = f"Proximity manoeuvre: {summary['frames']} frames by {solver_name(summary['backend'])}"
    outcome = "PASS" if summary["passed"] else "FAIL"
    table = key_table(title, [Row(**row) for row in summary["key_table"]])
    return block(f"{table}\n\n{outcome}: {summary['verdict']}\nReport: out/proximity/report.html")


def picture(target: Path, names: tuple[str, ...]) -> None:
    """Pictures of a report, one above the other, in few colours."""
    parts = [Image.open(ROOT / name).convert("RGB") for name in names]
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
        whole.quantize(colours, dither=Image.Dither.NONE).save(target, optimize=True)
        if target.stat().st_size <= LARGEST:
            return
    raise SystemExit(f"{target.name} has more than {LARGEST} bytes")


def example(file: str, *command: str) -> str:
    """An example file and its result by the RTL, as a table."""
    words = [".venv/bin/relnav", command[0], file, *command[1:], "--backend", "verilator"]
    done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=False)
    if done.returncode != 3:  # one of its frames has no result
        raise SystemExit(f"{' '.join(words)}: exit {done.returncode}: {done.stderr}")
    shown = f"$ {' '.join(words)}\n{done.stdout}$ echo $?\n{done.returncode}"
    return f"{block((ROOT / file).read_text(), 'csv')}\n\n{block(shown)}"


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


def area(syn: Json, top: str, build: str) -> str:
    """LUT / FF / DSP / BRAM of a build."""
    builds = syn.get(top, {}).get("area", {}).get("builds", {})
    total = builds.get(build, {}).get("total")
    if not total:
        return "not run: `make synth`"
    return " / ".join(f"{total[kind]:g}" for kind in ("LUT", "FF", "DSP", "BRAM"))


def clock(syn: Json, top: str) -> str:
    """Routed clock of a core."""
    fmax = syn.get(top, {}).get("timing", {}).get("fmax_mhz")
    return f"{fmax:.0f} MHz (ECP5-85k, grade 8)" if fmax else "not run: `make timing`"


def to_done(everything: int, again: int) -> int:
    """Clocks from the last beat to the interrupt.

    The second pass begins `again` clocks behind the last result and takes as long; DONE and the interrupt are
    a clock each. `make soak` compares this clock by clock.
    """
    return everything + again + everything + 2


def cores(landing: Json, manoeuvre: Json, syn: Json) -> str:
    """Both cores and both papers, side by side."""
    cycles, rates = landing["cycles"], manoeuvre["cycles"]
    deviation = max(landing["relative_error_percent_max"]["core"])
    rate_deviation = max(manoeuvre["percent_error_max"]["core"])
    driven = max(manoeuvre["numerical_error_max"][k] for k in (2, 5))
    rows = (
        ("result", "q", "q, R, t, rss, covariances", "v, omega", "v, omega, rss, covariance, cond(H)"),
        ("deviation from double, max", "7 %", f"{deviation:.1e} %", "0.8 %", f"{rate_deviation:.1e} %"),
        (
            "relative error to exact, max",
            "",
            f"{landing['numerical_error_max']:.1e} (q)",
            "",
            f"{driven:.1e} (v_z, omega_z)",
        ),
        (
            "cycles from the last beat to the result",
            f"{landing['paper_cycles']} (q, centred by software)",
            f"{max(cycles['q'])} (q), {max(cycles['pose'])} (R, t)",
            f"{manoeuvre['paper_cycles']}",
            f"{max(rates['rates'])}",
        ),
        (
            "to covariance and rss",
            "software",
            f"{max(cycles['all'])}",
            "not given",
            f"{max(rates['all'])}",
        ),
        (
            "to DONE and the interrupt: all of it computed twice and compared",
            "-",
            f"{to_done(max(cycles['all']), oltae_again(weighted=True))}",
            "-",
            f"{to_done(max(rates['all']), ivisnav_again(weighted=True))}",
        ),
        ("cycles a point or row", "several register writes", "3, weighted 6", "register writes", "8"),
        (
            "LUT / FF / DSP / BRAM36, xc7",
            "5545 / 7597 / 137 / -",
            f"{area(syn, 'oltae_top', 'full')}; lean {area(syn, 'oltae_top', 'lean')}",
            "35488 / 14968 / 120 / 12.5",
            area(syn, "ivisnav_top", "full"),
        ),
        (
            "clock, routed",
            "100 MHz (xc7z020)",
            clock(syn, "oltae_top"),
            "100 MHz (xc7z020)",
            clock(syn, "ivisnav_top"),
        ),
    )
    head = "| | OLTAE paper | `oltae_top` | iVisNav paper | `ivisnav_top` |\n|---|---|---|---|---|\n"
    return head + "\n".join(f"| {' | '.join(row)} |" for row in rows)


def area_rows(syn: Json) -> list[tuple[str, str, str]]:
    """Area of both OLTAE builds and the routed clock."""
    rows = [
        (
            f"LUT / FF / DSP / BRAM36, xc7, {build} build",
            "5545 / 7597 / 137 / -",
            area(syn, "oltae_top", build),
        )
        for build in ("full", "lean")
    ]
    return [*rows, ("clock", "100 MHz (xc7z020)", clock(syn, "oltae_top"))]


def ivisnav_numbers(manoeuvre: Json, syn: Json, bench: Json) -> str:
    """iVisNav beside its paper; what has not been run yet says so."""
    percent = manoeuvre["percent_error_max"]
    rows: list[tuple[str, str, str]] = [
        (
            "v_z, omega_z of the manoeuvre, deviation from double, max",
            f"{percent['paper_published']:g} %",
            f"{max(percent['core']):.1e} %",
        )
    ]
    rows += [
        (f"the paper's Q15.16 on the same manoeuvre, {run['scale']}", "", f"{max(run['worst']):.2g} %")
        for run in percent["paper_q15_16"]
    ]
    rows.append(
        ("the paper's explicit inverse on our exact sums", "", f"{max(percent['explicit_inverse']):.1e} %")
    )
    if rates := bench.get("rates"):
        rows += rate_bench_rows(rates)
    else:
        rows.append(("rings and random H", "not given", "not run: `python -m bench.rates`"))
    cycles = manoeuvre["cycles"]
    rows += [
        (
            "cycles from the last beat to v and omega",
            f"{manoeuvre['paper_cycles']}",
            f"{max(cycles['rates'])}",
        ),
        ("to rss and covariance", "not given", f"{max(cycles['all'])}"),
        (
            "LUT / FF / DSP / BRAM36, xc7",
            "35488 / 14968 / 120 / 12.5",
            area(syn, "ivisnav_top", "full"),
        ),
        ("clock", "100 MHz (xc7z020)", clock(syn, "ivisnav_top")),
    ]
    lines = [f"| {name} | {paper} | {here} |" for name, paper, here in rows]
    return "\n".join(["| | paper | here |", "|---|---|---|", *lines])


def explicit(cell: Json) -> str:
    """The explicit inverse's error on the same frames, where it means something."""
    return f"; explicit inverse {cell['explicit']:.0e}" if cell["explicit"] is not None else ""


def rate_bench_rows(rates: Json) -> list[tuple[str, str, str]]:
    """Rings and random H of bench/rates.py."""
    rows = []
    for weighted in (False, True):
        cells = [cell for cell in rates["rings"] if cell["weighted"] == weighted]
        frames, refused = (sum(cell[key] for cell in cells) for key in ("frames", "refused"))
        driven = max(max(cell["v_z"], cell["omega_z"]) for cell in cells)
        idle = max(cell["idle"] for cell in cells)
        kind = "weights 1 to 65535" if weighted else "weights 1"
        rows.append(
            (
                f"rings .15 to 1 m at 1 to 5 m, {kind}: error of v_z, omega_z / idle, max of {frames}",
                "not given",
                f"{driven:.1e} / {idle:.1e} ({refused} refused, cond(H) beyond 2000)",
            )
        )
    rows += [
        (
            f"random H, cond(H) {cell['from']:g} to {cell['to']:g}: error, max of {cell['frames']}",
            "not given",
            f"{cell['error']:.1e} ({cell['refused']} refused{explicit(cell)})",
        )
        for cell in rates["random"]
    ]
    for cell in rates["coverage"]:
        shares = cell["inside"].values()
        rows.append(
            (
                f"errors inside 3 sigma by {cell['variance']}, {cell['trials']} trials",
                "not given",
                f"{100 * min(shares):.2f} to {100 * max(shares):.2f} %",
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
    landing, manoeuvre = load("out/summary.json"), load("out/proximity/summary.json")
    for found, command in ((landing, "make sim"), (manoeuvre, "make sim-ivisnav")):
        if "key_table" not in found:
            raise SystemExit(f"out/ has no summary, or one of an older run: {command}")
    for target, names in PICTURES.items():
        picture(target, names)
    syn, bench = load("syn/results.json"), load("bench/results.json")
    texts = {
        "cores": cores(landing, manoeuvre, syn),
        "sim": sim(landing),
        "pose": example(POINTS, "pose"),
        "python": python(),
        "proximity": proximity(manoeuvre),
        "rates": example(PHASES, "rates", "--f0", "20e6", "--dt", "0.01"),
        "numbers": numbers(landing, syn, bench),
        "ivisnav": ivisnav_numbers(manoeuvre, syn, bench),
    }
    changed = [name for name, text in texts.items() if fill(README, name, text)]
    sizes = ", ".join(f"{target.name} {target.stat().st_size} bytes" for target in PICTURES)
    print(f"README.md: {', '.join(changed) or 'nothing'} changed; {sizes}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
