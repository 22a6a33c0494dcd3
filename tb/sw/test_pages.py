# SPDX-License-Identifier: Apache-2.0
"""Every command of README.md and docs/ runs: here, or by another test that is named.

Commands are the `sh` blocks, the `$` lines of `console` and `text` blocks, whose output must be what
follows, and indented lines that begin with a command's name. Python blocks run too; the `text` block behind
one is its output. docs/integration.md has its own test, the decisions are notes.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

from sim.sources import ROOT

PAGES = [
    ROOT / "README.md",
    *(page for page in sorted((ROOT / "docs").glob("*.md")) if page.stem != "integration"),
]
FENCE = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
# commands in the order of the first word; what is run elsewhere, and where
COVERED = {
    r"git clone <this repository>.*": "tb/sw/test_checkout.py",
    r"make sim": "tb/sw/test_landing.py",
    r"make sim-ivisnav": "tb/sw/test_proximity.py",
    r"make test": "tb/sw/test_pages.py",  # this is it
    r"make waves( CORE=ivisnav_top)?": "tb/sim/waves",
    r"make sim-centring": "tb/gram/centring",
    r"make soak( MINUTES=1)?": "tb/soak/test_soak.py",
    r"make formal( FORMAL_ARGS='srt_digit')?": "tb/sw/test_formal.py",
    r"make faults( FAULTS_ARGS=--quick)?": "tb/sw/test_faults.py",
    r"make coverage": "tb/sw/test_coverage.py",
    r"make mutate": "tb/sw/test_mutate.py",
    r"make synth": "tb/syn/test_synth.py",
    r"(\.venv/bin/)?relnav pose .*--backend (icarus|verilator)": "tb/package/test_integration_page.py",
    r"(\.venv/bin/)?relnav rates .*--backend (icarus|verilator)": "tb/sw/test_ivisnav_cli.py",
    r"echo \$\?": "tb/package/test_integration_page.py",  # of the line before
}
INDENTED = re.compile(r"^    ((?:make|git|relnav|python3?|\.venv/bin/\w+|cd|pip) .+)$", re.MULTILINE)
SECONDS = 120  # of one block, on a loaded machine


@dataclass(frozen=True)
class Block:
    """Commands that are run together, and the output they must have, where the page says it."""

    page: Path
    number: int
    language: str
    text: str
    output: str | None = None

    def __str__(self) -> str:
        return f"{self.page.stem}-{self.number}-{self.language}"


def prompted(text: str) -> list[tuple[str, str]]:
    """Commands after a `$`, each with what follows it."""
    parts = re.split(r"^\$ ", text, flags=re.MULTILINE)[1:]
    return [(command, output) for command, _, output in (part.partition("\n") for part in parts)]


def blocks(page: Path) -> list[Block]:
    """Everything on a page that can be run."""
    text = page.read_text(encoding="utf-8")
    found: list[tuple[str, str, str | None]] = []
    fenced = FENCE.findall(text)
    for index, (language, body) in enumerate(fenced):
        following = fenced[index + 1] if index + 1 < len(fenced) else ("", "")
        if language == "sh":
            found.append((language, body, None))
        elif language == "python":
            found.append((language, body, following[1] if following[0] == "text" else None))
        elif language in ("console", "text"):
            found += [("console", command, output) for command, output in prompted(body)]
    found += [("sh", line + "\n", None) for line in INDENTED.findall(FENCE.sub("", text))]
    return [Block(page, number, *entry) for number, entry in enumerate(found)]


BLOCKS = [block for page in PAGES for block in blocks(page)]


def covered(command: str) -> str | None:
    """The test that runs a command, if not this one."""
    command = re.sub(r"\s+# .*", "", command.strip())
    return next((test for pattern, test in COVERED.items() if re.fullmatch(pattern, command)), None)


def to_run(block: Block) -> str:
    """A block without the lines that are run elsewhere, and without the environment, which the test has."""
    if block.language == "python":
        return block.text
    lines = [line for line in block.text.splitlines(keepends=True) if covered(line) is None]
    return "".join(line for line in lines if line.strip() != ". .venv/bin/activate")


def test_pages_have_commands() -> None:
    found = {block.page.name for block in BLOCKS}
    assert {"README.md", "tutorial.md"} <= found
    assert len([block for block in BLOCKS if to_run(block).strip()]) >= 8


def test_what_is_left_out_is_tested_elsewhere() -> None:
    shell = [block.text for block in BLOCKS if block.language != "python"]
    tests = {covered(line) for text in shell for line in text.splitlines()} - {None}
    assert tests == set(COVERED.values())
    for test in tests:
        assert test and (ROOT / test).exists(), test


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A working folder with what a page's commands expect in a checkout."""
    (tmp_path / "docs").symlink_to(ROOT / "docs")
    (tmp_path / ".venv").mkdir()
    (tmp_path / ".venv" / "bin").symlink_to(Path(sys.executable).parent)
    return tmp_path


@pytest.mark.parametrize(
    "page", sorted({b.page for b in BLOCKS if to_run(b).strip()}), ids=lambda page: page.stem
)
def test_page(page: Path, folder: Path) -> None:
    """The blocks of a page in their order: files stay from block to block."""
    for block in BLOCKS:
        if block.page == page and to_run(block).strip():
            run(block, folder)


def run(block: Block, folder: Path) -> None:
    """A block does what its page says."""
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    environment = os.environ | {"PATH": path, "COLUMNS": "200"}
    text = to_run(block)
    # console: a page may show a status that is not 0
    command = {
        "python": [sys.executable, "-c", text],
        "sh": ["bash", "-euo", "pipefail", "-c", text],
        "console": ["bash", "-c", text],
    }[block.language]
    done = subprocess.run(
        command,
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
        timeout=SECONDS,
        check=False,
    )
    if block.language != "console":
        assert done.returncode == 0, done.stdout + done.stderr
    if block.output is not None:
        assert done.stdout.rstrip() == block.output.rstrip(), done.stderr
    assert "Traceback" not in done.stderr
