# SPDX-License-Identifier: Apache-2.0
"""The site of `make docs`: builds without a warning, needs no network, shows the present results."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
import yaml

from scripts import figures, plots
from sim.sources import ROOT


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Built as `make site` does, elsewhere."""
    build = pytest.importorskip("mkdocs.commands.build")
    pytest.importorskip("material")
    pytest.importorskip("latex2mathml")
    from mkdocs.config import load_config

    folder = tmp_path_factory.mktemp("site")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("NO_MKDOCS_2_WARNING", "1")
        config = load_config(str(ROOT / "mkdocs.yml"), site_dir=str(folder), strict=True)
        config.plugins.on_startup(command="build", dirty=False)
        build.build(config)  # Abort where there was a warning
    return folder


def pages(site: Path) -> list[Path]:
    found = sorted(site.rglob("*.html"))
    assert len(found) > 30
    return found


def test_every_page_of_docs_is_there(site: Path) -> None:
    for page in (ROOT / "docs").rglob("*.md"):
        assert (site / page.relative_to(ROOT).with_suffix(".html")).is_file(), page
    assert (site / "index.html").is_file() and (site / "docs/decisions/index.html").is_file()


def test_nothing_is_loaded_from_elsewhere(site: Path) -> None:
    for page in pages(site):
        text = page.read_text()
        assert not re.search(r'<(script|img|iframe)[^>]+src="?(https?:)?//', text), page
        assert not re.search(r'<link[^>]+rel="?(stylesheet|preconnect)"?[^>]+href="?(https?:)?//', text), page


def test_pictures_and_links_lead_somewhere(site: Path) -> None:
    for page in pages(site):
        if page.name == "404.html":
            continue
        for target in re.findall(r'(?:src|href)="([^"#?]+)"', page.read_text()):
            if not re.match(r"[a-z]+:", target):
                assert (page.parent / target).exists(), f"{page.relative_to(site)}: {target}"


def test_formulas_are_rendered(site: Path) -> None:
    text = (site / "docs/theory.html").read_text()
    formulas = re.findall(r"<math.*?</math>", text, re.DOTALL)
    assert len(formulas) > 100 and "arithmatex" not in text
    assert not [formula for formula in formulas if "\\" in formula]


@pytest.mark.parametrize("name", figures.FIGURES)
def test_figures_are_up_to_date(name: str) -> None:
    old = (figures.IMAGES / f"{name}.svg").read_text()
    assert old == figures.FIGURES[name](), "python scripts/figures.py"


@pytest.mark.parametrize("name", plots.PLOTS)
def test_plots_are_of_the_present_results(name: str) -> None:
    found = json.loads(plots.RESULTS.read_text())
    text = (plots.IMAGES / f"{name}.svg").read_text()
    assert f"data {plots.digest(name, found)}" in text, "python scripts/plots.py"
    assert len(text) < plots.LARGEST


def test_navigation_names_every_page_of_docs() -> None:
    text = (ROOT / "mkdocs.yml").read_text()
    assert yaml.safe_load(text)["nav"]
    for page in (ROOT / "docs").glob("*.md"):
        assert f"docs/{page.name}" in text, page
