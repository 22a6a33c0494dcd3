# SPDX-License-Identifier: Apache-2.0
"""The cores that are synthesised, the Yosys run that both scripts share, and where the results are kept."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from collections.abc import Mapping
from dataclasses import dataclass, field
from importlib.metadata import version
from pathlib import Path
from typing import Any

from sim.sources import ROOT, RTL, reachable, sources

RESULTS = ROOT / "syn" / "results.json"
README = ROOT / "README.md"
BUILD = ROOT / "build" / "syn"


@dataclass(frozen=True)
class Core:
    """A top module: the folders of rtl/ it is made of, its builds, and the numbers it is compared with."""

    top: str
    folders: tuple[str, ...]
    builds: Mapping[str, Mapping[str, int]]
    """Name of a build -> Verilog parameters that differ from the defaults."""
    paper: Mapping[str, float] = field(default_factory=dict)
    """Resources the paper lists, of its own implementation."""
    paper_source: str = ""
    goals: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    """Name of a build -> the most it may take."""

    def sources(self, rtl: Path) -> list[Path]:
        """The Verilog files that the core is made of."""
        return reachable(self.top, sources(*self.folders, rtl_dir=rtl))


CORES = (
    Core(
        top="oltae_top",
        folders=("trust", "axi", "arith", "gram", "oltae"),
        builds={"full": {}, "lean": {"WEIGHTED": 0, "COVARIANCE": 0, "REAPPLY": 0, "VERIFY": 0}},
        paper={"LUT": 5545, "LUTRAM": 153, "FF": 7597, "DSP": 137},
        paper_source="OLTAE paper, Table 1",
        goals={
            "full": {"LUT": 8000, "FF": 11000, "DSP": 68},
            "lean": {"LUT": 5545, "FF": 7597, "DSP": 48},
        },
    ),
    Core(
        top="ivisnav_top",
        folders=("trust", "axi", "arith", "gram", "ivisnav"),
        builds={"full": {}},
        paper={"LUT": 35488, "LUTRAM": 1555, "FF": 14968, "BRAM": 12.5, "DSP": 120},
        paper_source="iVisNav paper, Table I",
        goals={"full": {"LUT": 12000, "FF": 12000, "DSP": 48, "BRAM": 2}},
    ),
)


def find_core(top: str) -> Core:
    """The core of that name; any other module of rtl/ is taken as a core of its own, with its defaults."""
    for core in CORES:
        if core.top == top:
            return core
    folders = tuple(folder.name for folder in sorted(RTL.iterdir()) if folder.is_dir())
    return Core(top=top, folders=folders, builds={"default": {}})


def read_design(core: Core, parameters: Mapping[str, int], rtl: Path) -> list[str]:
    """Yosys commands that read a core and set its parameters."""
    files = [str(file) for file in core.sources(rtl)]
    if not any(Path(file).stem == core.top for file in files):
        raise SystemExit(f"syn: there is no module {core.top} in {', '.join(core.folders)}")
    values = "".join(f" -set {name} {value}" for name, value in parameters.items())
    commands = [f"read_verilog -defer -I{rtl / 'include'} {file}" for file in files]
    commands += [f"chparam{values} {core.top}"] if values else []
    return [*commands, f"hierarchy -check -top {core.top}"]


def run_yosys(name: str, commands: list[str]) -> None:
    """Run commands in a Yosys of their own (pyosys); the script and its log stay in build/syn."""
    BUILD.mkdir(parents=True, exist_ok=True)
    script, log = BUILD / f"{name}.ys", BUILD / f"{name}.log"
    script.write_text("\n".join(commands) + "\n")
    code = f"from pyosys import libyosys as y; y.run_pass({f'script {script}'!r}, y.Design())"
    with log.open("w") as out:
        done = subprocess.run([sys.executable, "-c", code], stdout=out, stderr=subprocess.STDOUT, check=False)
    if done.returncode:
        errors = [line for line in log.read_text(errors="replace").splitlines() if "ERROR" in line]
        raise SystemExit(f"syn: Yosys failed on {name}: {' '.join(errors) or 'no message'} (see {log})")


def yosys_version() -> str:
    """Name and version of the synthesiser."""
    return f"Yosys {version('pyosys')} (pyosys)"


def read_results() -> dict[str, Any]:
    """What the last runs of both scripts left."""
    results: dict[str, Any] = json.loads(RESULTS.read_text()) if RESULTS.is_file() else {}
    return results


def write_results(top: str, part: str, content: Mapping[str, Any]) -> dict[str, Any]:
    """Replace one part (area or timing) of a core's results; returns all results."""
    results = read_results()
    results.setdefault(top, {})[part] = dict(content)
    RESULTS.write_text(json.dumps(results, indent=2, sort_keys=False) + "\n")
    return results


def write_readme(marker: str, text: str) -> bool:
    """Put `text` between the comments `<!-- marker:begin -->` and `:end`; False where the README has none."""
    pattern = re.compile(rf"(<!-- {marker}:begin -->\n).*?(<!-- {marker}:end -->)", re.DOTALL)
    old = README.read_text() if README.is_file() else ""
    if not pattern.search(old):
        print(f"syn: README.md has no <!-- {marker}:begin --> ... <!-- {marker}:end -->: left as it is")
        return False
    new = pattern.sub(lambda match: match.group(1) + text.rstrip("\n") + "\n" + match.group(2), old)
    if new != old:
        README.write_text(new)
    return True
