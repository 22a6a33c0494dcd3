# SPDX-License-Identifier: Apache-2.0
"""Area of the cores on Xilinx 7 series with Yosys: syn/results.json and the table in the README.

    python syn/synth.py              every core, every build
    python syn/synth.py centring     any module of rtl/, printed only

Two runs a build: flattened for the totals, with the hierarchy kept for the shares of the modules (their sum
is a little larger: nothing is optimised across modules).

How cells are counted, as Vivado's "Slice LUTs" does: LUT = LUT1..LUT6, inverters, and the LUTs that serve as
memory or shift register (LUTRAM). BRAM = RAMB36E1, a RAMB18E1 being half of one.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections import Counter
from collections.abc import Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))

from syn.cores import (  # noqa: E402 (the path is set above)
    BUILD,
    CORES,
    Core,
    find_core,
    read_design,
    run_yosys,
    write_readme,
    write_results,
    yosys_version,
)

LUTRAM = {
    "RAM16X1S": 1,
    "RAM32X1S": 1,
    "RAM64X1S": 1,
    "RAM128X1S": 2,
    "RAM256X1S": 4,
    "RAM32X1D": 2,
    "RAM64X1D": 2,
    "RAM128X1D": 4,
    "RAM32M": 4,
    "RAM64M": 4,
    "SRL16": 1,
    "SRL16E": 1,
    "SRLC16E": 1,
    "SRLC32E": 1,
}
LOGIC = {"LUT1", "LUT2", "LUT3", "LUT4", "LUT5", "LUT6", "INV"}
FLIP_FLOPS = {"FDRE", "FDSE", "FDCE", "FDPE", "FDRE_1", "FDSE_1", "FDCE_1", "FDPE_1", "LDCE", "LDPE"}
UNCOUNTED = {"MUXF7", "MUXF8", "BUFG", "IBUF", "OBUF", "GND", "VCC", "$scopeinfo", "$print", "$check"}
COLUMNS = ("LUT", "LUTRAM", "FF", "DSP", "BRAM", "CARRY4")

Cells = Counter[str]


def resources(cells: Mapping[str, int]) -> dict[str, float]:
    """Resources of mapped cells; refuses a cell it doesn't know rather than leave it out."""
    total: dict[str, float] = dict.fromkeys(COLUMNS, 0)
    for cell, count in cells.items():
        if cell in LOGIC:
            total["LUT"] += count
        elif cell in LUTRAM:
            total["LUT"] += count * LUTRAM[cell]
            total["LUTRAM"] += count * LUTRAM[cell]
        elif cell in FLIP_FLOPS:
            total["FF"] += count
        elif cell == "DSP48E1":
            total["DSP"] += count
        elif cell in ("RAMB36E1", "RAMB18E1"):
            total["BRAM"] += count * (1 if cell == "RAMB36E1" else 0.5)
        elif cell == "CARRY4":
            total["CARRY4"] += count
        elif cell not in UNCOUNTED:
            raise SystemExit(f"syn: don't know how to count the cell {cell}")
    return {name: int(value) if value == int(value) else value for name, value in total.items()}


@dataclass
class Module:
    """A module of the mapped design and, merged by name, the modules inside it."""

    name: str
    instances: int = 0
    cells: Cells = field(default_factory=Counter)
    """Cells of all instances, those of the modules inside included."""
    children: dict[str, Module] = field(default_factory=dict)

    def rows(self, depth: int = 0) -> Iterator[tuple[int, Module]]:
        """This module and the ones inside, top-down, the largest first."""
        yield depth, self
        for child in sorted(self.children.values(), key=lambda m: (-resources(m.cells)["LUT"], m.name)):
            yield from child.rows(depth + 1)

    def to_json(self) -> dict[str, Any]:
        """Name, instances, resources and the modules inside."""
        inside = [child.to_json() for child in self.children.values()]
        shown: dict[str, Any] = {"name": self.name, "instances": self.instances, **resources(self.cells)}
        return shown | ({"modules": inside} if inside else {})


def base_name(module: str) -> str:
    """Name in the source of a module that Yosys renamed for its parameters."""
    return module.split("\\")[1] if module.startswith("$paramod") else module.lstrip("\\")


def tree(statistics: Mapping[str, Any], top: str) -> Module:
    """Yosys' statistics, a flat list of modules, as the tree below `top`."""
    modules = {name.removeprefix("\\"): m["num_cells_by_type"] for name, m in statistics["modules"].items()}

    def add(into: Module, name: str, instances: int) -> None:
        into.instances += instances
        for cell, count in modules[name].items():
            kind = cell.removeprefix("\\")
            if kind in modules:
                child = into.children.setdefault(base_name(kind), Module(base_name(kind)))
                before = child.cells.copy()
                add(child, kind, instances * count)
                into.cells.update(child.cells - before)
            else:
                into.cells[kind] += instances * count

    found = Module(top)
    add(found, top, 1)
    return found


def synthesise(core: Core, build: str, flat: bool, rtl: Path) -> Module:
    """Map one build onto xc7 and count."""
    name = f"{core.top}-{build}-{'flat' if flat else 'modules'}"
    statistics = BUILD / f"{name}.json"
    commands = read_design(core, core.builds[build], rtl)
    flatten = "-flatten " if flat else ""
    commands += [f"synth_xilinx -family xc7 {flatten}-noiopad -noclkbuf -top {core.top}"]
    commands += [f"tee -q -o {statistics} stat -json"]
    run_yosys(name, commands)
    return tree(json.loads(statistics.read_text()), core.top)


def area(core: Core, rtl: Path) -> dict[str, Any]:
    """Both runs of every build, as the JSON that is kept."""
    jobs = [(build, flat) for build in core.builds for flat in (True, False)]
    with ThreadPoolExecutor(2) as pool:
        done = dict(zip(jobs, pool.map(lambda job: synthesise(core, job[0], job[1], rtl), jobs), strict=True))
    builds: dict[str, Any] = {}
    for build, parameters in core.builds.items():
        total = done[build, True]
        builds[build] = {
            "parameters": dict(parameters),
            "total": resources(total.cells),
            "cells": dict(sorted(total.cells.items())),
            "by_module": done[build, False].to_json(),
        }
    return {
        "tool": yosys_version(),
        "command": "synth_xilinx -family xc7 -flatten -noiopad -noclkbuf",
        "builds": builds,
        "paper": dict(core.paper),
    }


def table(core: Core, found: Mapping[str, Any], depth: int = 2) -> str:
    """Markdown: totals beside the paper's, then the modules of the first build down to `depth`."""
    columns = COLUMNS[:5]
    names = {"DSP": "DSP48E1", "BRAM": "BRAM36"}
    head = " | ".join(names.get(c, c) for c in columns)
    lines = [f"| `{core.top}` | {head} |", "|---|" + "---:|" * len(columns)]
    for build, content in found["builds"].items():
        goal = core.goals.get(build, {})
        cells = [f"{content['total'][c]}" + (f" (goal {goal[c]:g})" if c in goal else "") for c in columns]
        changed = ", ".join(f"{name}={value}" for name, value in content["parameters"].items())
        lines.append(f"| {build} build{f' ({changed})' if changed else ''} | {' | '.join(cells)} |")
    if core.paper:
        listed = " | ".join(f"{core.paper[c]:g}" if c in core.paper else "not listed" for c in columns)
        lines.append(f"| {core.paper_source} | {listed} |")
    first = next(iter(found["builds"]))
    lines += ["", f"By module, {first} build, submodules included, hierarchy kept:", ""]
    lines += [f"| module | instances | {head} |", "|---|---:|" + "---:|" * len(columns)]

    def rows(module: Mapping[str, Any], level: int) -> None:
        shown = " | ".join(str(module[c]) for c in columns)
        lines.append(f"| {'&nbsp;' * 4 * level}`{module['name']}` | {module['instances']} | {shown} |")
        if level < depth:
            for inner in sorted(module.get("modules", []), key=lambda m: -m["LUT"]):
                rows(inner, level + 1)

    rows(found["builds"][first]["by_module"], 0)
    lines += ["", f"{found['tool']}, `{found['command']}`; LUT includes LUTRAM. Made by `make synth`."]
    return "\n".join(lines) + "\n"


def over_goal(core: Core, found: Mapping[str, Any]) -> list[str]:
    """Where a build takes more than its goal."""
    return [
        f"{core.top} {build}: {name} {found['builds'][build]['total'][name]} > {most:g}"
        for build, goal in core.goals.items()
        for name, most in goal.items()
        if found["builds"][build]["total"][name] > most
    ]


def main(arguments: list[str]) -> int:
    """Synthesise the cores (kept), or the modules named (printed only)."""
    parser = argparse.ArgumentParser(description="area on Xilinx 7 series with Yosys")
    parser.add_argument(
        "tops", nargs="*", help="modules of rtl/; without any, every core, and the results are kept"
    )
    parser.add_argument("--rtl", type=Path, default=ROOT / "rtl", help="folder of the Verilog (default: rtl)")
    parser.add_argument(
        "--set", action="append", default=[], metavar="NAME=VALUE", help="parameter of a module named"
    )
    options = parser.parse_args(arguments)
    rtl = options.rtl.resolve()
    if options.tops:
        parameters = {name: int(value) for name, _, value in (word.partition("=") for word in options.set)}
        for top in options.tops:
            known = find_core(top)
            core = Core(top, known.folders, {"given": parameters} if parameters else known.builds)
            print(table(core, area(core, rtl), depth=9))
        return 0
    texts, complaints = [], []
    for core in CORES:
        found = area(core, rtl)
        write_results(core.top, "area", found)
        texts.append(table(core, found))
        complaints += over_goal(core, found)
    write_readme("area", "\n".join(texts))
    print("\n".join(texts))
    for complaint in complaints:
        print(f"syn: over the goal: {complaint}")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
