# SPDX-License-Identifier: Apache-2.0
"""Ports and parameters of a module, read from its head as this project writes it: one to a line."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

_HEAD = re.compile(r"^module (\w+) (?:#\((.*?)^\) )?\((.*?)^\);", re.MULTILINE | re.DOTALL)
_PARAMETER = re.compile(r"parameter (?:integer )?(\w+) *= *(-?\d+),?")
_PORT = re.compile(r"(input|output) +(?:wire|reg) *(?:\[ *(\d+):(\d+)\])? *(\w+),?")


@dataclass(frozen=True)
class Port:
    """A port; width in bits."""

    name: str
    direction: str
    """in or out."""
    width: int


@dataclass(frozen=True)
class Module:
    """A module's name, parameters with their defaults, and ports."""

    name: str
    parameters: dict[str, int]
    ports: tuple[Port, ...]


def read_module(file: Path) -> Module:
    """The head of the module in a file; ValueError for a line that is neither parameter nor port."""
    text = re.sub(r"//[^\n]*", "", file.read_text())
    head = _HEAD.search(text)
    if head is None:
        raise ValueError(f"{file.name}: no module head as expected")
    parameters: dict[str, int] = {}
    ports = []
    for line in filter(None, map(str.strip, (head[2] or "").splitlines())):
        if (found := _PARAMETER.fullmatch(line)) is None:
            raise ValueError(f"{file.name}: no parameter: {line}")
        parameters[found[1]] = int(found[2])
    for line in filter(None, map(str.strip, head[3].splitlines())):
        if (found := _PORT.fullmatch(line)) is None:
            raise ValueError(f"{file.name}: no port: {line}")
        width = int(found[2]) - int(found[3]) + 1 if found[2] else 1
        ports.append(Port(found[4], found[1].removesuffix("put"), width))
    return Module(head[1], parameters, tuple(ports))
