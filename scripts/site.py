# SPDX-License-Identifier: Apache-2.0
"""MkDocs hooks: the repository's Markdown files as a site, under their own paths, so that their links hold.

Files that pages link to come along; a link to a folder leads to its README, or to a list of its pages.
Formulas become MathML: no script and no network is needed to read them.
"""

from __future__ import annotations

import html
import os
import re
from pathlib import Path
from typing import Any

from latex2mathml.converter import convert
from mkdocs.config.defaults import MkDocsConfig
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

ROOT = Path(__file__).resolve().parent.parent
LINK = re.compile(r"\]\(((?!https?:|#|mailto:)[^)#\s]+)")
WHOLE_LINK = re.compile(r"\[([^\]]*)\]\(([^)#\s]+)\)")
LATER = {ROOT / "coverage/report.md", ROOT / "mutate/results.md"}  # written by runs: no link while absent
FORMULA = re.compile(r'<(span|div) class="arithmatex">\\[(\[](.*?)\\[)\]]</\1>', re.DOTALL)


def leaves(nav: Any) -> list[str]:
    """Paths of all pages of a navigation."""
    if isinstance(nav, str):
        return [nav]
    values = nav.values() if isinstance(nav, dict) else nav
    return [path for value in values for path in leaves(value)]


def present(nav: Any) -> Any:
    """A navigation without pages that are not there, as those that a run writes."""
    if isinstance(nav, list):
        return [kept for entry in nav if (kept := present(entry)) not in (None, {}, [])]
    if isinstance(nav, dict):
        return {name: kept for name, entry in nav.items() if (kept := present(entry)) not in (None, [])}
    return nav if (ROOT / nav).is_file() or "/decisions" in nav else None


def title(page: Path) -> str:
    """First heading."""
    found = re.search(r"^# (.+)$", page.read_text(encoding="utf-8"), re.MULTILINE)
    return found[1] if found else page.stem


def listing(folder: Path) -> str:
    """A page for a folder without one."""
    pages = sorted(folder.glob("*.md"))
    lines = [f"* [{title(page)}]({page.name})" for page in pages]
    return "\n".join([f"# {folder.name.capitalize()}", "", *lines, ""])


def linked(page: Path) -> list[Path]:
    """Files and folders of the repository that a page links to."""
    targets = [page.parent / match for match in LINK.findall(page.read_text(encoding="utf-8"))]
    return [Path(os.path.normpath(target)) for target in targets]


def on_config(config: MkDocsConfig) -> MkDocsConfig:
    """The decisions go into the navigation."""
    decisions = sorted((ROOT / "docs/decisions").glob("*.md"))
    for entry in config.nav or []:
        if "Decisions" in entry:
            entry["Decisions"] = [
                "docs/decisions/README.md",
                *(str(page.relative_to(ROOT)) for page in decisions),
            ]
    config.nav = present(config.nav)
    return config


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Pages and what they link to, under their paths in the repository."""
    for file in list(files):
        if file.src_dir == config.docs_dir:
            files.remove(file)
    waiting = {ROOT / path for path in [*leaves(config.nav), *map(str, config.extra_css)]} | set(
        (ROOT / "docs").rglob("*.md")
    )
    wanted: set[Path] = set()
    folders: set[Path] = set()
    while waiting:
        path = waiting.pop()
        if path in wanted or path in folders:
            continue
        if path.is_dir():
            waiting |= {path / "README.md"}
        elif path.is_file():
            wanted.add(path)
            if path.suffix == ".md":
                waiting |= set(linked(path))
        elif path.name == "README.md":
            folders.add(path.parent)
    for path in sorted(wanted):
        files.append(File.generated(config, str(path.relative_to(ROOT)), abs_src_path=str(path)))
    for folder in sorted(folders):
        if any(folder.glob("*.md")):
            files.append(
                File.generated(config, str(folder.relative_to(ROOT) / "README.md"), content=listing(folder))
            )
    return files


def on_page_markdown(markdown: str, page: Page, config: MkDocsConfig, files: Files) -> str:
    """Links to folders, and to what is not there yet."""
    here = (ROOT / page.file.src_uri).parent

    def lead(found: re.Match[str]) -> str:
        target = Path(os.path.normpath(here / found[1]))
        return f"]({found[1].rstrip('/')}/README.md" if target.is_dir() else found[0]

    def unless_later(found: re.Match[str]) -> str:
        target = Path(os.path.normpath(here / found[2]))
        return found[1] if target in LATER and not target.is_file() else found[0]

    return LINK.sub(lead, WHOLE_LINK.sub(unless_later, markdown))


def on_page_content(text: str, page: Page, config: MkDocsConfig, files: Files) -> str:
    """Formulas as MathML."""

    def formula(found: re.Match[str]) -> str:
        display = "block" if found[1] == "div" else "inline"
        return convert(html.unescape(found[2]).strip(), display=display)

    return FORMULA.sub(formula, text)
