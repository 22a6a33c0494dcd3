# SPDX-License-Identifier: Apache-2.0
"""Puts the RTL, the simulation's files and the last areas into the wheel, as relnav/packaged.

All else is in pyproject.toml. An editable installation needs no copy: relnav.checkout finds the checkout.
"""

from __future__ import annotations

import shutil
from pathlib import Path

from setuptools import setup
from setuptools.command.build_py import build_py

ROOT = Path(__file__).resolve().parent
PACKAGED = (
    "rtl/**/*",
    "sim/__init__.py",
    "sim/runner.py",
    "sim/sources.py",
    "sim/core_harness.v",
    "syn/results.json",
)


class BuildPy(build_py):
    """setuptools' own, and the copy."""

    def _copies(self) -> list[tuple[Path, Path]]:
        target = Path(self.build_lib) / "relnav" / "packaged"
        files = [path for pattern in PACKAGED for path in sorted(ROOT.glob(pattern)) if path.is_file()]
        return [(path, target / path.relative_to(ROOT)) for path in files if "__pycache__" not in path.parts]

    def run(self) -> None:
        """Build, then copy."""
        if self.editable_mode:
            super().run()
            return
        # what an earlier build left may be gone from the sources
        shutil.rmtree(Path(self.build_lib) / "relnav", ignore_errors=True)
        super().run()
        for source, target in self._copies():
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source, target)

    def get_outputs(self, include_bytecode: bool = True) -> list[str]:
        """What was made, for tools that ask."""
        made = super().get_outputs(include_bytecode)
        return made if self.editable_mode else [*made, *(str(target) for _, target in self._copies())]


setup(cmdclass={"build_py": BuildPy})
