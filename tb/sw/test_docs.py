# SPDX-License-Identifier: Apache-2.0
"""The documents against the tree: modules listed, links that lead somewhere, blocks that scripts can fill."""

from __future__ import annotations

import re
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from relnav.registers import Ivisnav, Oltae

from scripts import ivisnav_sheet, oltae_sheet, readme_sim
from scripts.marked import fill
from sim.sources import ROOT, sources

PAGES = [
    ROOT / "README.md",
    ROOT / "CHANGELOG.md",
    *sorted((ROOT / "docs").rglob("*.md")),
    ROOT / "rtl/README.md",
    ROOT / "tb/README.md",
    ROOT / "sw/c/README.md",
]
MARKERS = {
    "sw/c/README.md": {"size"},
    "README.md": {
        "sim",
        "proximity",
        "pose",
        "rates",
        "python",
        "cores",
        "numbers",
        "ivisnav",
        "area",
        "timing",
    },
    "docs/oltae.md": {"registers", "latency", "accuracy", "area", "driver"},
    "docs/ivisnav.md": {"registers", "latency", "accuracy", "area", "driver"},
}


def test_rtl_readme_names_every_module_and_no_other() -> None:
    text = (ROOT / "rtl/README.md").read_text()
    tree = "".join(line for line in text.splitlines(keepends=True) if line.startswith("    "))
    listed = {
        name
        for names in re.findall(r"^ +((?:[a-z]\w*, )*[a-z]\w*)(?= |$)", tree, re.MULTILINE)
        for name in names.split(", ")
    }
    assert listed == {file.stem for file in sources()}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_links_lead_somewhere(page: Path) -> None:
    for target in re.findall(r"\]\(([^)]+)\)", page.read_text()):
        if not target.startswith(("http", "#")):
            assert (page.parent / target.partition("#")[0]).exists(), target


def test_every_block_is_there() -> None:
    for page, names in MARKERS.items():
        assert set(re.findall(r"<!-- (\w+):begin -->", (ROOT / page).read_text())) == names


@pytest.mark.parametrize("sheet", [oltae_sheet, ivisnav_sheet])
def test_data_sheets_have_the_present_results(sheet: ModuleType) -> None:
    """Registers, area, accuracy and the driver's size, from the files that their runs left."""
    page = sheet.SHEET.read_text()
    for name, text in sheet.blocks().items():
        shown = page.partition(f"<!-- {name}:begin -->\n")[2].partition(f"<!-- {name}:end -->")[0]
        assert shown == text.rstrip("\n") + "\n", f"{name}: make docs"


SECTIONS = (
    *("What it computes", "Block diagram", "Parameters and ports", "Formats", "Timing", "State machine"),
    *("Registers", "Latency", "Area", "Accuracy", "Errors", "Limits", "C driver", "Integration"),
)


@pytest.mark.parametrize(("page", "core"), [("oltae", Oltae), ("ivisnav", Ivisnav)])
def test_a_data_sheet_says_all(page: str, core: Any) -> None:
    """Its sections, and what each flag means and asks for."""
    text = (ROOT / f"docs/{page}.md").read_text()
    assert [title for title in re.findall(r"^## (.+)$", text, re.MULTILINE) if title != "Results"] == [
        *SECTIONS
    ]
    errors = text.partition("## Errors")[2].partition("## Limits")[0]
    rows = [line.strip("| ").split(" | ") for line in errors.splitlines() if re.match(r"\| [A-Z_]+ \|", line)]
    assert {row[0] for row in rows} == set(core.FLAGS.FIELDS)
    assert all(len(row) == 5 and all(row) for row in rows)


@pytest.mark.parametrize(
    ("block", "builds"),
    [
        ("cores", [("oltae_top", "full"), ("oltae_top", "lean"), ("ivisnav_top", "full")]),
        ("numbers", [("oltae_top", "full"), ("oltae_top", "lean")]),
        ("ivisnav", [("ivisnav_top", "full")]),
    ],
)
def test_readme_has_the_present_areas_and_clocks(block: str, builds: list[tuple[str, str]]) -> None:
    """`make docs` writes them from syn/results.json; both pages of numbers must be of one run."""
    text = (
        (ROOT / "README.md").read_text().split(f"<!-- {block}:begin -->")[1].split(f"<!-- {block}:end -->")[0]
    )
    syn = readme_sim.load("syn/results.json")
    for top, build in builds:
        assert readme_sim.area(syn, top, build) in text
        assert readme_sim.clock(syn, top) in text


def test_fill(tmp_path: Path) -> None:
    page = tmp_path / "page.md"
    page.write_text("a\n<!-- x:begin -->\nold\n<!-- x:end -->\nb\n")
    assert fill(page, "x", "new \\1") and not fill(page, "x", "new \\1")
    assert page.read_text() == "a\n<!-- x:begin -->\nnew \\1\n<!-- x:end -->\nb\n"
    with pytest.raises(SystemExit, match="no <!-- y:begin"):
        fill(page, "y", "")
