# SPDX-License-Identifier: Apache-2.0
"""The cores that are packaged, and what their files say about them."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from relnav import regtool
from relnav.driver import CoreDriver, OltaeDriver
from relnav.ivisnav.driver import IvisnavDriver

from sim.sources import ROOT, reachable, sources

from .verilog import Module, read_module

_INCLUDE = re.compile(r'^\s*`include\s+"([^"]+)"', re.MULTILINE)


@dataclass(frozen=True)
class Core:
    """A core: its name (that of its register description), what it does, its driver."""

    name: str
    title: str
    driver: type[CoreDriver]  # type: ignore[type-arg]
    root: Path = ROOT

    @property
    def top(self) -> str:
        """The Verilog module."""
        return f"{self.name}_top"

    @cached_property
    def modules(self) -> list[Path]:
        """The Verilog files that the core is made of."""
        return reachable(self.top, sources(rtl_dir=self.root / "rtl"))

    @cached_property
    def headers(self) -> list[Path]:
        """The files that these include."""
        return included(self.modules, self.root / "rtl" / "include")

    @cached_property
    def module(self) -> Module:
        """Ports and parameters of the top."""
        return read_module(self.root / "rtl" / self.name / f"{self.top}.v")

    @cached_property
    def registers(self) -> regtool.CoreView:
        """The register description."""
        return regtool.read(self.root / "registers" / f"{self.name}.rdl")


def included(files: Sequence[Path], folder: Path) -> list[Path]:
    """The headers of `folder` that the files include, directly or through one another, in a stable order."""
    found: set[Path] = set()
    waiting = list(files)
    while waiting:
        names = _INCLUDE.findall(waiting.pop().read_text())
        headers = {folder / name for name in names} - found
        found |= headers
        waiting += sorted(headers)
    return sorted(found)


def cores(root: Path = ROOT) -> tuple[Core, ...]:
    """Both cores of a checkout."""
    return (
        Core("oltae", "Pose from matched 3-D points, b = R a + t, with covariances", OltaeDriver, root),
        Core("ivisnav", "Velocity and angular velocity from laser phase shifts", IvisnavDriver, root),
    )
