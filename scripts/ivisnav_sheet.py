# SPDX-License-Identifier: Apache-2.0
"""Accuracy, area, registers and the C driver's size of the iVisNav core, into docs/ivisnav.md.

From bench/results.json, syn/results.json, docs/registers-ivisnav.md and sw/c/size.json.

python scripts/ivisnav_sheet.py
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))

from scripts.c_size import CALLED, KINDS, SHARED  # noqa: E402 (the path is set above)
from scripts.marked import fill, table  # noqa: E402

SHEET = ROOT / "docs" / "ivisnav.md"
PAPER = {"LUT": 35488, "FF": 14968, "DSP": 120, "BRAM": 12.5}  # its Table I, xc7z020
GOAL = {"LUT": 12000, "FF": 12000, "DSP": 48, "BRAM": 2}

Json = dict[str, Any]


def load(path: str) -> Json:
    """A JSON file of the checkout, empty where there is none."""
    file = ROOT / path
    found: Json = json.loads(file.read_text(encoding="utf-8")) if file.is_file() else {}
    return found


def number(value: float | None) -> str:
    """One digit; a dash for none."""
    return "-" if value is None else f"{value:.0e}"


def largest(values: list[float | None]) -> float | None:
    """Of those that are there."""
    return max((value for value in values if value is not None), default=None)


def registers(core: str) -> str:
    """The register map, without the fields: the first table of the generated page."""
    page = (ROOT / f"docs/registers-{core}.md").read_text(encoding="utf-8")
    rows = page[page.index("| Address") :].partition("\n\n")[0]
    return f"{rows}\n\nFields of each register: [registers-{core}.md](registers-{core}.md)."


def driver(core: str, size: Json) -> str:
    """Code and stack of the C driver."""
    if not size:
        return "Not measured: `make c`."
    parts = [size["objects"][name] for name in (*SHARED, core)]
    stack = [str(size["stack"][f"{core}_{name}"]) for name in CALLED]
    head = (*KINDS, *(f"stack of `{core}_{name}`" for name in CALLED))
    rows = [[*(str(sum(part[kind] for part in parts)) for kind in KINDS), *stack]]
    return (
        f"{table(head, rows)}\n\nBytes, no heap; {size['compiler']}, `{size['options']}`. Made by `make c`."
    )


def accuracy(bench: Json) -> str:
    """Rings, random H, 3 sigma and rss."""
    found = bench.get("rates")
    if found is None:
        return "Not run: `python -m bench.rates`."
    return "\n\n".join((rings(found), random_matrices(found), coverage(found), residuals(found)))


def rings(found: Json) -> str:
    """One row a ring, radius and distance; unweighted, weighted."""
    rows = []
    plain = [cell for cell in found["rings"] if not cell["weighted"]]
    weighted = [cell for cell in found["rings"] if cell["weighted"]]
    for pair in zip(plain, weighted, strict=True):
        assert [pair[0][key] for key in ("ring", "radius", "distance")] == [
            pair[1][key] for key in ("ring", "radius", "distance")
        ]
        cell = pair[0]
        rows.append(
            (
                f"{cell['ring']}, {cell['radius']:g} m at {cell['distance']:g} m",
                *(f"{c['cond'][0]:.0f} to {c['cond'][1]:.0f}" for c in pair),
                *(number(largest([c[name] for c in pair])) for name in ("v_z", "omega_z", "idle")),
                *(number(c["explicit"]) for c in pair),
                " / ".join(str(c["refused"]) for c in pair),
            )
        )
    count = {cell["frames"] for cell in found["rings"]}
    head = (
        f"ring, {' '.join(map(str, count))} frames each",
        "cond(H)",
        "cond(H), weighted",
        "v_z",
        "omega_z",
        "idle",
        "explicit inverse",
        "the same, weighted",
        "refused / weighted",
    )
    return table(head, rows)


def random_matrices(found: Json) -> str:
    """By cond(H)."""
    return table(
        ("random H, cond(H)", "largest error", "explicit inverse", "refused"),
        [
            (
                f"{b['from']:g} to {b['to']:g}",
                number(b["error"]),
                number(b["explicit"]),
                f"{b['refused'] / b['frames']:.1%}",
            )
            for b in found["random"]
        ],
    )


def coverage(found: Json) -> str:
    """Shares inside 3 sigma."""
    rows = []
    for entry in found["coverage"]:
        shares, ratios = entry["inside"].values(), entry["rms_over_sigma"].values()
        rows.append(
            (
                entry["variance"],
                "{} to {}".format(*entry["rows"]),
                str(entry["trials"]),
                f"{100 * min(shares):.2f} to {100 * max(shares):.2f} %",
                f"{100 * entry['expected']:.2f} %",
                f"{min(ratios):.3f} to {max(ratios):.3f}",
            )
        )
    return table(("variance from", "rows", "trials", "inside 3 sigma", "expected", "rms error / sigma"), rows)


def residuals(found: Json) -> str:
    """rss by noise."""
    return table(
        ("noise of y / rms of y", "rss, largest relative error", "over sum w y^2"),
        [(f"{r['noise']:.0e}", number(r["error"]), number(r["floor"])) for r in found["rss"]],
    )


def area(syn: Json) -> str:
    """Beside the paper's."""
    core = syn.get("ivisnav_top", {})
    rows = [
        ("paper, xc7z020", *(f"{PAPER[name]:g}" for name in PAPER)),
        ("aim", *(f"{GOAL[name]:g}" for name in GOAL)),
    ]
    content = core.get("area")
    if content is None:
        rows.append(("here", "not run: `make synth`", "", "", ""))
    else:
        for build, entry in content["builds"].items():
            total = entry["total"]
            rows.append((f"{build}, xc7, {content['tool']}", *(f"{total[name]:g}" for name in PAPER)))
    timing = core.get("timing", {})
    fmax = timing.get("fmax_mhz") or timing.get("fmax")
    routed = f"\n\nClock: {fmax:.0f} MHz (ECP5-85k, grade 8, routed)." if fmax else ""
    return table(("", *PAPER), rows) + routed


def blocks() -> dict[str, str]:
    """What this script fills."""
    return {
        "registers": registers("ivisnav"),
        "accuracy": accuracy(load("bench/results.json")),
        "area": area(load("syn/results.json")),
        "driver": driver("ivisnav", load("sw/c/size.json")),
    }


def main() -> int:
    """Fill them."""
    texts = blocks()
    changed = [name for name, text in texts.items() if fill(SHEET, name, text)]
    print(f"{SHEET.name}: {', '.join(changed) or 'nothing'} changed")
    return 0


if __name__ == "__main__":
    sys.exit(main())
