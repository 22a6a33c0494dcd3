# SPDX-License-Identifier: Apache-2.0
"""Accuracy, area, registers and the C driver's size of the OLTAE core, into docs/oltae.md.

python scripts/oltae_sheet.py
"""

from __future__ import annotations

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))

from scripts.ivisnav_sheet import Json, driver, load, number, registers  # noqa: E402 (the path is set above)
from scripts.marked import fill, table  # noqa: E402

SHEET = ROOT / "docs" / "oltae.md"
KINDS = ("LUT", "FF", "DSP", "BRAM")
PAPER = ("5545", "7597", "137", "-")  # its Table 1, xc7z020
AIMS = {"full": ("8000", "11000", "68", "-"), "lean": ("5545", "7597", "48", "-")}


def accuracy(bench: Json) -> str:
    """Largest errors by kappa(M), and what the search for bad cases found."""
    found = bench.get("accuracy")
    if found is None:
        return "Not run: `make bench`."
    rows = [
        (
            f"{entry['kappa_below']:g}",
            str(entry["cases"]),
            *(number(entry[name]["error"]) for name in ("q", "R", "t", "rss", "q_cov", "t_cov")),
            f"{entry['components_within_1_ulp']:.0%}",
        )
        for entry in found["bins"]
    ]
    head = (
        "kappa(M) below",
        "cases",
        "q",
        "R",
        "t",
        "rss",
        "covariance of q",
        "of t",
        "components of q within 1 ulp",
    )
    worst = found["worst_near"]
    text = (
        f"Below kappa = {found['bound_kappa']:g} and |q| = {found['near']:g}, "
        f"{found['over_bound_near']} frames have an error of q beyond {found['bound']:.0e}. "
        f"The worst ({worst['family']}): {worst['q']:.1e}, n = {worst['n']}, kappa = {worst['kappa']:.0f}, "
        f"noise {worst['noise']:.1f} times the cloud's size."
    )
    return f"{table(head, rows)}\n\n{text}"


def area(syn: Json) -> str:
    """Both builds beside the paper's."""
    core = syn.get("oltae_top", {})
    rows = [("paper, xc7z020", "", *PAPER)]
    content = core.get("area")
    if content is None:
        rows.append(("here", "", "not run: `make synth`", "", "", ""))
    else:
        for build, entry in content["builds"].items():
            left_out = ", ".join(f"{name} = {value}" for name, value in entry["parameters"].items())
            rows.append((f"aim, {build}", "", *AIMS[build]))
            rows.append((build, left_out or "all 1", *(f"{entry['total'][kind]:g}" for kind in KINDS)))
    fmax = core.get("timing", {}).get("fmax_mhz")
    routed = f"\n\nClock of the full build: {fmax:.0f} MHz (ECP5-85k, grade 8, routed)." if fmax else ""
    tool = f"\n\n{content['tool']}, `{content['command']}`." if content else ""
    return table(("build", "parameters", *KINDS), rows) + tool + routed


def blocks() -> dict[str, str]:
    """What this script fills."""
    return {
        "registers": registers("oltae"),
        "accuracy": accuracy(load("bench/results.json")),
        "area": area(load("syn/results.json")),
        "driver": driver("oltae", load("sw/c/size.json")),
    }


def main() -> int:
    """Fill them."""
    texts = blocks()
    changed = [name for name, text in texts.items() if fill(SHEET, name, text)]
    print(f"{SHEET.name}: {', '.join(changed) or 'nothing'} changed")
    return 0


if __name__ == "__main__":
    sys.exit(main())
