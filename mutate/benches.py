# SPDX-License-Identifier: Apache-2.0
"""Which tests a module's mutants must fail: its own, or those of the modules it stands in."""

from __future__ import annotations

import functools
from pathlib import Path

from sim.sources import ROOT, reachable, sources

TB = ROOT / "tb"

BOTH_GRAMS = ["gram/gram_array", "gram/gram_ring"]

INSIDE = {
    "component_select": ["gram/value_feeder", "gram/gram_array"],
    "first_moments": ["gram/gram_array"],
    "gram_lane": BOTH_GRAMS,
    "ivisnav_registers": ["axi/core_registers"],
    "ivisnav_top": ["ivisnav/ivisnav_core"],  # for its own take minutes on Icarus; survivors get to them
    "lane_control": BOTH_GRAMS,
    "lane_select": BOTH_GRAMS,
    "leading_zeros_24": ["arith/float_multiply", "arith/float_divide"],
    "mac_cell": BOTH_GRAMS,
    "oltae_top": ["oltae/oltae_core"],
    "oltae_registers": ["axi/oltae_registers", "axi/core_registers"],
    "point_counter": BOTH_GRAMS,
    "set_store": BOTH_GRAMS,
    "srt_digit": ["arith/reciprocal", "arith/float_divide"],
    "top_bit": ["gram/normaliser", "gram/gram_ring"],
}
"""Module -> folders of tb/, where its own folder or that of the smallest module around it won't do."""

CORES = ("oltae/oltae_top", "ivisnav/ivisnav_top")


def modules() -> list[str]:
    """Every module of rtl/."""
    return [file.stem for file in sources()]


def _own(module: str) -> Path | None:
    found = [file.parent / module for file in sources() if file.stem == module]
    folders = [TB / folder.relative_to(ROOT / "rtl") for folder in found]
    return folders[0] if folders and (folders[0] / f"test_{module}.py").is_file() else None


@functools.cache
def _inside() -> dict[str, frozenset[str]]:
    """Module -> every module that it is made of."""
    files = sources()
    return {top.stem: frozenset(file.stem for file in reachable(top.stem, files)) for top in files}


def around(module: str) -> list[str]:
    """The modules that `module` is somewhere inside, those of the fewest files first."""
    made = _inside()
    outside = [name for name, inside in made.items() if name != module and module in inside]
    return sorted(outside, key=lambda name: (len(made[name]), name))


def first_tests(module: str) -> list[Path]:
    """Folders of the tests that a module's mutants are given to first."""
    if module in INSIDE:
        return [TB / folder for folder in INSIDE[module]]
    own = _own(module)
    if own is not None:
        return [own]
    for name in around(module):
        folder = _own(name)
        if folder is not None:
            return [folder]
    raise ValueError(f"no test has {module} in it")


def core_tests(module: str) -> list[Path]:
    """Folders of the tests of the cores that a module is in."""
    outside = {module, *around(module)}
    return [TB / core for core in CORES if core.rpartition("/")[2] in outside]
