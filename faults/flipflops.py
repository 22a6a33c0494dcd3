# SPDX-License-Identifier: Apache-2.0
"""Every flip-flop and memory of a core by bit, from Yosys, with the name under which Verilator keeps it.

Yosys reads the RTL (`proc`), which tells the registers of each module, flattens it and drops what drives
nothing. Nothing is merged or retimed, so every bit is one of a register that the source declares.
"""

from __future__ import annotations

import json
import re
import subprocess
import sys
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from sim.sources import reachable, sources

MARK = "relnav_register"
COPIES = ("voted_register", "twin_register")
"""Modules of rtl/trust that are registers: they count as registers of the module that they are in."""


@dataclass(frozen=True)
class Bit:
    """A flip-flop, or a bit of a memory."""

    name: str
    """As in core.engine.tail[3][17]: hierarchical, element of an array, bit from the lowest (of a vector)."""
    module: str
    """The module type that it belongs to."""
    register: str
    """Its name in there, generate blocks in front; without element and bit. Of COPIES: instance.register."""
    memory: bool
    declared: str
    """The module type whose text declares `variable`."""
    scope: str
    """Of the simulator, from the top."""
    variable: str
    element: int
    """-1 where it is no array."""
    bit: int

    @property
    def key(self) -> str:
        """What the classes' patterns are matched with: module.register."""
        return f"{self.module}.{self.register}"


def yosys(folder: Path, name: str, commands: Sequence[str]) -> None:
    """Run commands in a Yosys of their own in `folder`. Raises RuntimeError with its message."""
    script, log = folder / f"{name}.ys", folder / f"{name}.log"
    script.write_text("\n".join(commands) + "\n")
    code = f"from pyosys import libyosys as y; y.run_pass('script {script.name}', y.Design())"
    with log.open("w") as out:
        done = subprocess.run(
            [sys.executable, "-c", code], cwd=folder, stdout=out, stderr=subprocess.STDOUT, check=False
        )
    if done.returncode:
        errors = [line for line in log.read_text(errors="replace").splitlines() if "ERROR" in line]
        raise RuntimeError(f"Yosys: {' '.join(errors)[:300] or 'no message'} (see {log})")


def bits_of(top: str, rtl: Path, folder: Path) -> list[Bit]:
    """Flip-flops, then bits of the memories that are written, both by name. folder: for Yosys' files."""
    folder.mkdir(parents=True, exist_ok=True)
    rtl = rtl.resolve()
    files = reachable(top, sources(rtl_dir=rtl))
    yosys(
        folder,
        "flipflops",
        [
            f"read_verilog -I{rtl / 'include'} {' '.join(map(str, files))}",
            f"hierarchy -top {top}",
            "setattr -mod -unset keep_hierarchy *",
            "proc -norom",
            "select -set q t:$dff %co1:+[Q] w:* %i",
            f"setattr -set {MARK} 1 @q",
            "write_json hierarchy.json",
            "flatten",
            "opt_expr",
            "opt_clean",
            "simplemap t:$dff",
            "opt_clean",
            "write_json flat.json",
        ],
    )
    hierarchy: dict[str, Any] = json.loads((folder / "hierarchy.json").read_text())["modules"]
    flat: dict[str, Any] = json.loads((folder / "flat.json").read_text())["modules"][top]
    instances = dict(_instances(hierarchy, top))
    found = sorted(_flip_flops(flat, instances, top), key=lambda bit: _natural(bit.name))
    return found + sorted(_memories(flat, instances, top), key=lambda bit: _natural(bit.name))


def _natural(name: str) -> list[tuple[int, str]]:
    return [(int(part), "") if part.isdigit() else (-1, part) for part in re.split(r"(\d+)", name) if part]


def _instances(
    modules: Mapping[str, Any], top: str, path: str = "", module: str = ""
) -> Iterator[tuple[str, str]]:
    """Path of each instance -> name of its module in the source."""
    module = module or top
    attributes = modules[module]["attributes"]
    yield path, str(attributes.get("hdlname", module)).lstrip("\\")
    for name, cell in modules[module]["cells"].items():
        if cell["type"] in modules:
            yield from _instances(modules, top, f"{path}.{name}" if path else name, cell["type"])


def _split(name: str, instances: Mapping[str, str]) -> tuple[str, str]:
    """Path of the instance, and what is in it."""
    parts = name.split(".")
    for count in range(len(parts) - 1, -1, -1):
        path = ".".join(parts[:count])
        if path in instances:
            return path, ".".join(parts[count:])
    raise AssertionError("the top is an instance too")


def _bit(
    top: str, instances: Mapping[str, str], name: str, element: int | None, bit: int, width: int, memory: bool
) -> Bit:
    """name: hierarchical, without element and bit. width: of the vector."""
    path, register = _split(name, instances)
    module = declared = instances[path]
    if declared in COPIES:
        around, inside = _split(path, {key: value for key, value in instances.items() if key != path})
        module, register = instances[around], f"{inside}.{register}"
    full = name + ("" if element is None else f"[{element}]") + (f"[{bit}]" if width > 1 else "")
    before, _, variable = name.rpartition(".")
    return Bit(
        name=full,
        module=module,
        register=register,
        memory=memory,
        declared=declared,
        scope=f"{top}.{before}" if before else top,
        variable=variable,
        element=-1 if element is None else element,
        bit=bit,
    )


def _flip_flops(flat: Mapping[str, Any], instances: Mapping[str, str], top: str) -> Iterator[Bit]:
    cells = flat["cells"].values()
    kinds = {cell["type"] for cell in cells if re.search(r"dff|latch|\$sr\b", cell["type"], re.IGNORECASE)}
    if kinds - {"$_DFF_P_"}:
        raise RuntimeError(
            f"storage of a kind that is not counted: {', '.join(sorted(kinds - {'$_DFF_P_'}))}"
        )
    nets = {cell["connections"]["Q"][0] for cell in cells if cell["type"] == "$_DFF_P_"}
    for name, wire in flat["netnames"].items():
        if MARK not in wire["attributes"]:
            continue
        plain, element = name, None
        array = re.fullmatch(r"(.*[^\]])\[(\d+)\]", name.rpartition(".")[2])
        if array:  # Yosys makes registers of a small array
            plain, element = name[: name.rindex("[")], int(array.group(2))
        for bit, net in enumerate(wire["bits"]):
            if net in nets:
                nets.remove(net)
                yield _bit(top, instances, plain, element, bit, len(wire["bits"]), False)
    if nets:
        raise RuntimeError(f"{len(nets)} flip-flops have no name in the source")


def _memories(flat: Mapping[str, Any], instances: Mapping[str, str], top: str) -> Iterator[Bit]:
    cells = flat["cells"].values()
    for name in {
        cell["parameters"]["MEMID"].lstrip("\\") for cell in cells if cell["type"].startswith("$memwr")
    }:
        memory = flat["memories"][name]
        for element in range(memory["start_offset"], memory["start_offset"] + memory["size"]):
            for bit in range(memory["width"]):
                yield _bit(top, instances, name, element, bit, memory["width"], True)
