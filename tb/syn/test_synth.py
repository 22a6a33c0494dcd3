# SPDX-License-Identifier: Apache-2.0
"""Counting of mapped cells, the tree of modules, and the README's markers."""

from pathlib import Path

import pytest

from syn import cores
from syn.synth import Module, resources, tree


def test_lutram_counts_as_luts() -> None:
    cells = {"LUT6": 10, "INV": 1, "RAM32M": 2, "RAM64X1D": 1, "SRL16E": 3, "FDRE": 7, "FDSE": 1}
    found = resources(cells | {"DSP48E1": 4, "RAMB18E1": 1, "RAMB36E1": 2, "CARRY4": 5, "MUXF7": 9})
    assert found == {"LUT": 24, "LUTRAM": 13, "FF": 8, "DSP": 4, "BRAM": 2.5, "CARRY4": 5}


def test_an_unknown_cell_is_refused() -> None:
    with pytest.raises(SystemExit, match="FANCY"):
        resources({"FANCY": 1})


def test_instances_multiply_down_the_tree() -> None:
    statistics = {
        "modules": {
            "\\top": {"num_cells_by_type": {"\\lane": 2, "$paramod\\cell\\W=s32'1": 1, "LUT2": 1}},
            "\\lane": {"num_cells_by_type": {"$paramod\\cell\\W=s32'1": 3, "$paramod\\cell\\W=s32'0": 1}},
            "$paramod\\cell\\W=s32'1": {"num_cells_by_type": {"DSP48E1": 1}},
            "$paramod\\cell\\W=s32'0": {"num_cells_by_type": {"FDRE": 5}},
        }
    }
    top = tree(statistics, "top")
    shown = [(depth, module.name, module.instances) for depth, module in top.rows()]
    assert shown == [(0, "top", 1), (1, "cell", 1), (1, "lane", 2), (2, "cell", 8)]
    assert resources(top.cells) == {"LUT": 1, "LUTRAM": 0, "FF": 10, "DSP": 7, "BRAM": 0, "CARRY4": 0}
    assert isinstance(top, Module)


def test_the_readme_keeps_what_is_outside_the_markers(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    readme = tmp_path / "README.md"
    readme.write_text("a\n<!-- area:begin -->\nold\n<!-- area:end -->\nz\n")
    monkeypatch.setattr(cores, "README", readme)
    assert cores.write_readme("area", r"new \1")
    assert readme.read_text() == "a\n<!-- area:begin -->\nnew \\1\n<!-- area:end -->\nz\n"
    assert not cores.write_readme("timing", "new")
