# SPDX-License-Identifier: Apache-2.0
"""What the protections cost on Xilinx 7: builds with and without, mapped by Yosys (syn/synth.py)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from sim.sources import RTL
from syn.cores import CORES, read_results
from syn.synth import resources, synthesise

COLUMNS = ("LUT", "FF", "DSP", "BRAM")

BEFORE: dict[str, dict[str, float]] = {
    "oltae_top": {"LUT": 7523, "FF": 6996, "DSP": 61, "BRAM": 2},
    "ivisnav_top": {"LUT": 9678, "FF": 7806, "DSP": 43, "BRAM": 1},
}
"""`make synth` of the RTL that results.json calls `before`: commit f9b0ea1."""

PROTECTIONS: dict[str, dict[str, int]] = {
    "second pass compared, residue of the exact sums (VERIFY)": {"VERIFY": 0},
}
"""Protection -> parameters of a top that leave it out."""

OTHERS = "the rest: voted and twin registers, parities, give-up"
ALL = "all"


def costs() -> list[dict[str, Any]]:
    """Of each core a row a protection, one for those that no parameter leaves out, one for all.

    The whole core's area is the last of `make synth`. Raises SystemExit where there is none.
    """
    rows = []
    for core in CORES:
        try:
            whole = read_results()[core.top]["area"]["builds"]["full"]["total"]
        except KeyError:
            raise SystemExit(
                f"faults: syn/results.json has no full build of {core.top}: make synth"
            ) from None
        left = _less(whole, BEFORE[core.top])
        rows.append({"core": core.top, "protection": ALL, **left})
        for name, parameters in PROTECTIONS.items():
            without = resources(
                synthesise(replace(core, builds={"without": parameters}), "without", True, RTL).cells
            )
            cost = _less(whole, without)
            left = _less(left, cost)
            rows.append({"core": core.top, "protection": name, **cost})
        rows.append({"core": core.top, "protection": OTHERS, **left})
    return rows


def _less(one: Mapping[str, float], other: Mapping[str, float]) -> dict[str, float]:
    return {name: one[name] - other[name] for name in COLUMNS}
