# SPDX-License-Identifier: Apache-2.0
"""Code and stack of the C driver on a Cortex-A9, into sw/c/size.json and the table of sw/c/README.md."""

from __future__ import annotations

import json
import re
import sys
import tempfile
from collections import defaultdict
from pathlib import Path
from typing import Any

from scripts.c_build import ARM, CORTEX_A9, DRIVER, SOURCES, STRICT_FLAGS, missing, run
from scripts.marked import fill, table

SIZES = DRIVER / "size.json"
SHARED = ("relnav_core", "relnav_fixed")
KINDS = ("code", "constants", "variables")
CALLED = ("solve", "fill", "read")
CORES = {"oltae": "OLTAE", "ivisnav": "iVisNav"}
NODE = re.compile(r'^node: \{ title: "([^"]+)" label: "[^"\\]*\\n[^"\\]*\\n(\d+) bytes \(static\)', re.M)
EDGE = re.compile(r'^edge: \{ sourcename: "([^"]+)" targetname: "([^"]+)"', re.M)


def sections(file: Path) -> dict[str, int]:
    """Bytes of code, constants and variables of an object."""
    sizes = dict.fromkeys(KINDS, 0)
    kinds = {"text": "code", "rodata": "constants", "data": "variables", "bss": "variables"}
    for name, size in re.findall(r"^\.(\w+)\S* +(\d+)", run([ARM.replace("gcc", "size"), "-A", file]), re.M):
        if name in kinds:
            sizes[kinds[name]] += int(size)
    return sizes


def stacks(graphs: list[str]) -> dict[str, int]:
    """Function -> bytes of stack, with all that it calls; libgcc, memcpy and memset count as 0."""
    own = {name: int(size) for graph in graphs for name, size in NODE.findall(graph)}
    called: dict[str, set[str]] = defaultdict(set)
    for graph in graphs:
        for source, target in EDGE.findall(graph):
            called[source].add(target)

    def deepest(name: str, above: tuple[str, ...] = ()) -> int:
        if name in above:
            raise SystemExit(f"c_size: {name} calls itself: its stack has no bound")
        return own.get(name, 0) + max((deepest(other, (*above, name)) for other in called[name]), default=0)

    if "__indirect_call" in {target for targets in called.values() for target in targets}:
        raise SystemExit("c_size: a call through a pointer: the stack has no known bound")
    return {name: deepest(name) for name in sorted(own) if ":" not in name}


def measure() -> dict[str, Any]:
    """What goes into size.json."""
    objects: dict[str, dict[str, int]] = {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for source in SOURCES:
            made = folder / f"{source.stem}.o"
            options = ["-Os", *CORTEX_A9, "-fstack-usage", "-fcallgraph-info=su"]
            run([ARM, *STRICT_FLAGS, *options, "-I", DRIVER, "-c", "-o", made, source])
            objects[source.stem] = sections(made)
        graphs = [(folder / f"{source.stem}.ci").read_text() for source in SOURCES]
    compiler = run([ARM, "-dumpfullversion"]).strip()
    return {
        "compiler": f"{ARM} {compiler}",
        "options": " ".join(["-std=c99", "-Os", *CORTEX_A9]),
        "objects": objects,
        "stack": stacks(graphs),
    }


def text(found: dict[str, Any]) -> str:
    """The table for the README."""
    rows = []
    for core, title in CORES.items():
        parts = [found["objects"][name] for name in (*SHARED, core)]
        bytes_of = [sum(part[kind] for part in parts) for kind in KINDS]
        stack = [found["stack"][f"{core}_{name}"] for name in CALLED]
        rows.append([title, *map(str, bytes_of + stack)])
    head = ["driver of", *KINDS, *(f"stack of `_{name}`" for name in CALLED)]
    both = sum(sum(part.values()) for part in found["objects"].values())
    return f"""{table(head, rows)}

Bytes; {found["compiler"]}, `{found["options"]}`. Each row has what both share; both drivers take {both}.
The stack is that of everything called but `memcpy`, `memset` and libgcc. Made by `make c`."""


def main() -> int:
    """Measure and write; 0, also where the compiler is absent: then the last sizes stay."""
    if reason := missing(ARM):
        print(f"c_size: sizes not measured, {reason}")
        return 0
    found = measure()
    SIZES.write_text(json.dumps(found, indent=2) + "\n")
    fill(DRIVER / "README.md", "size", text(found))
    print(text(found))
    return 0


if __name__ == "__main__":
    sys.exit(main())
