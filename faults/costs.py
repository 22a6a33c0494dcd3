# SPDX-License-Identifier: Apache-2.0
"""What each protection costs on Xilinx 7: a core with it less one without it (syn/synth.py)."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from typing import Any

from sim.sources import RTL
from syn.cores import CORES
from syn.synth import resources, synthesise

PROTECTIONS: dict[str, dict[str, int]] = {
    "VERIFY: second pass, residues of the sums": {"VERIFY": 0},
}
"""Protection -> parameters of a top that leave it out."""

COLUMNS = ("LUT", "FF", "DSP", "BRAM")


def costs(rtl: Path = RTL) -> list[dict[str, Any]]:
    """A row a core and protection that it has: the differences."""
    rows = []
    for core in CORES:
        text = next(file for file in core.sources(rtl) if file.stem == core.top).read_text()
        whole = None
        for name, parameters in PROTECTIONS.items():
            if not all(re.search(rf"\bparameter\s+{parameter}\b", text) for parameter in parameters):
                continue
            builds = replace(core, builds={"full": {}, "without": parameters})
            whole = whole or resources(synthesise(builds, "full", True, rtl).cells)
            without = resources(synthesise(builds, "without", True, rtl).cells)
            rows.append({"core": core.top, "protection": name, **{k: whole[k] - without[k] for k in COLUMNS}})
    return rows
