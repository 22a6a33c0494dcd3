# SPDX-License-Identifier: Apache-2.0
"""Every command of every page runs: here, or by another test that is named.

Commands are the `sh` blocks, the `$` lines of `console` and `text` blocks, whose output must be what
follows, indented lines that begin with a command's name, and commands in the running text. Python blocks run
too; the `text` block behind one is its output. docs/integration.md has its own test for its blocks.

What takes long is tested by what it is made of (COVERED names the test), and started here with little work
(SHORT) where it leaves nothing behind.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

from scripts.decisions import MEASURES
from sim.runner import missing
from sim.sources import ROOT

APART = ROOT / "docs/integration.md"  # its blocks: tb/package/test_integration_page.py
OUTSIDE = {".venv", ".git", ".pytest_cache", "build", "out", "site", "dist", "node_modules"}
EVERY_PAGE = sorted(
    page
    for page in ROOT.rglob("*.md")
    if not OUTSIDE & set(page.relative_to(ROOT).parts) and not page.parent.name.endswith(".egg-info")
)
PAGES = [page for page in EVERY_PAGE if page != APART]
FENCE = re.compile(r"^```(\w*)\n(.*?)^```$", re.MULTILINE | re.DOTALL)
RUN_HERE, NO_COMMAND = {"sh", "console", "text", "python"}, {"c", "csv", "dts", "verilog", "json"}
BENCH, CLI, RATES_CLI = "tb/sw/test_bench.py", "tb/sw/test_cli.py", "tb/sw/test_ivisnav_cli.py"
# commands in the order of the first word; what is run elsewhere, and where
COVERED = {
    r"git clone <this repository>.*": "tb/sw/test_checkout.py",
    r"make sim": "tb/sw/test_landing.py",
    r"make sim-ivisnav": "tb/sw/test_proximity.py",
    r"make test( PYTEST_ARGS='-k icarus')?": "tb/sw/test_pages.py",  # this is it
    r"make waves( CORE=ivisnav_top)?": "tb/sim/waves/test_waves.py",
    r"make sim-(centring|gram)": "tb/gram/centring/test_centring.py",
    r"make soak( MINUTES=1)?": "tb/soak/test_soak.py",
    r"make formal( FORMAL_ARGS='[a-z_ ]+')?": "tb/sw/test_formal.py",
    r"(make|python -m) faults( .*)?": "tb/sw/test_faults.py",
    r"(make|python -m) coverage( .*)?": "tb/sw/test_coverage.py",
    r"(make|python -m) mutate( .*)?": "tb/sw/test_mutate.py",
    r"make synth|python syn/synth.py \w+": "tb/syn/test_synth.py",
    r"make timing|python syn/timing.py \w+": "tb/syn/test_timing.py",
    r"make verification": "tb/sw/test_verification.py",
    r"make package": "tb/package/test_package.py",
    r"make (docs|site)": "tb/sw/test_site.py",
    r"make c|cc .*|arm-none-eabi-gcc .*": "tb/c/test_build.py",
    r"make setup-c": "tb/c/test_bare_metal.py",
    r"make examples|\.venv/bin/python -m examples\.\w+( .*)?": "tb/sw/test_examples.py",
    r"python -m bench\.(accuracy|three_sigma|rates)": BENCH,
    r"python -m relnav\.regtool": "tb/sw/test_registers.py",
    r"python -m relnav\.words": "tb/sw/test_words.py",
    r"python -m relnav\.model\.rom": "tb/oltae/solve_program/test_solve_program.py",
    r"python -m relnav\.model\.rates_rom": "tb/ivisnav/rates_program/test_rates_program.py",
    r"fusesoc .*": "tb/package/test_fusesoc.py",
    r"pip install '\.\[sim\]'|relnav rtl": "tb/package/test_wheel.py",
    r"(\.venv/bin/)?relnav pose .*--backend (icarus|verilator)": "tb/package/test_integration_page.py",
    r"relnav pose( FILE)?( --json)?": CLI,
    r"(\.venv/bin/)?relnav rates .*--backend (icarus|verilator)": RATES_CLI,
    r"relnav rates( FILE --f0 HZ --dt S)?": RATES_CLI,
    r"relnav landing": "tb/sw/test_landing.py",
    r"relnav proximity( --camera)?": "tb/sw/test_proximity.py",
    r"echo \$\?": "tb/package/test_integration_page.py",  # of the line before
}
# in the running text; a script by its path alone is only looked for
INLINE = re.compile(
    r"`((?:make|git|relnav|python3?|pip|fusesoc|(?:\.venv/bin|scripts)/[\w.]+)(?: [^`\n]+)?)`"
)
INLINE_COVERED = {
    r"make setup": "tb/sw/test_pages.py",  # every command of SHORT begins with it
    r"make setup sim test waves synth .*": "tb/sw/test_pages.py",  # the changelog's list
    r"make sim-NAME": "tb/gram/centring/test_centring.py",
    r"make help": "tb/sw/test_pages.py",
    r"relnav": CLI,
    r"scripts/decisions\.py .*": "tb/sw/test_pages.py",
    r"scripts/\w+\.(py|sh)": "tb/sw/test_pages.py",
}
# each takes seconds; {folder} is a new one
SHORT = {
    "make help": "make sim-ivisnav",
    "make sim LANDING_ARGS='--frames 2 --backend fixed --out {folder}'": "Report: ",
    "make sim-ivisnav PROXIMITY_ARGS='--frames 2 --backend fixed --out {folder}'": "Report: ",
    "make test JOBS=0 PYTEST_ARGS='-q tb/sw/test_attitude.py'": " passed",
    "make soak CORE=oltae_top SIMULATOR=icarus SEED=5 EPISODE=0": "oltae_top: ",
    "make waves": "build/waves/oltae_top.fst",
    "make sim-mux4 PYTEST_ARGS='-q -k icarus'": " passed",
    "make site": "site: out/site/index.html",
    ".venv/bin/python syn/synth.py mux4": "| `mux4` | 1 |",
    ".venv/bin/python -m mutate --help": "usage: ",
    ".venv/bin/python -m faults --help": "usage: ",
    ".venv/bin/python -m coverage --help": "usage: ",
    ".venv/bin/python -m formal --help": "usage: ",
    ".venv/bin/python -m bench --help": "usage: ",
}
PROGRAMS = r"make|git|relnav|python3?|\.venv/bin/\w+|cd|pip|cc|arm-none-eabi-gcc|fusesoc|vivado|verilator"
INDENTED = re.compile(rf"^    ((?:{PROGRAMS}) .+)$", re.MULTILINE)
SECONDS = 120  # of one block, on a loaded machine
LONG = 600  # of a command of SHORT there


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
    return next((test for pattern, test in COVERED.items() if re.fullmatch(pattern, bare(command))), None)


def bare(command: str) -> str:
    """Without a remark: behind a #, or in a column of its own."""
    return re.sub(r"\s+# .*| {2,}\S.*", "", command.strip())


def inline(page: Path) -> list[str]:
    """Commands in a page's running text."""
    return INLINE.findall(FENCE.sub("", page.read_text(encoding="utf-8")))


def inline_covered(command: str) -> str | None:
    """The test that runs a command of the running text."""
    known = COVERED | INLINE_COVERED
    return next((test for pattern, test in known.items() if re.fullmatch(pattern, command)), None)


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


def test_every_page_is_looked_at() -> None:
    """What the site shows is what is tested, and the page apart has a test of its own."""
    shown = {ROOT / path for path in re.findall(r"[\w/.-]+\.md", (ROOT / "mkdocs.yml").read_text())}
    assert shown - set(EVERY_PAGE) <= {ROOT / "coverage/report.md"}
    assert "docs/integration.md" in (ROOT / "tb/package/test_integration_page.py").read_text()


@pytest.mark.parametrize("page", EVERY_PAGE, ids=lambda page: str(page.relative_to(ROOT)))
def test_every_block_says_what_it_is(page: Path) -> None:
    """A block without a language could hold a command that nobody runs."""
    text = page.read_text(encoding="utf-8")
    assert text.count("\n```") % 2 == 0
    assert {language for language, _ in FENCE.findall(text)} <= RUN_HERE | NO_COMMAND
    assert not re.search(r"^[ \t]+```", text, re.MULTILINE), "an indented block is not seen here"


def test_what_is_left_out_is_tested_elsewhere() -> None:
    shell = [block.text for block in BLOCKS if block.language != "python"]
    left_out = {covered(line) for text in shell for line in text.splitlines()} - {None}
    named = left_out | {inline_covered(command) for page in EVERY_PAGE for command in inline(page)}
    assert named == set(COVERED.values()) | set(INLINE_COVERED.values())
    for test in named:
        assert test and (ROOT / test).is_file(), test


@pytest.mark.parametrize("page", EVERY_PAGE, ids=lambda page: str(page.relative_to(ROOT)))
def test_commands_of_the_running_text(page: Path) -> None:
    for command in inline(page):
        assert inline_covered(command), f"{page.relative_to(ROOT)}: no test is named for `{command}`"
        script, _, rest = command.partition(" ")
        if script.startswith("scripts/"):
            assert (ROOT / script).is_file(), command
        if script == "scripts/decisions.py":
            assert rest in MEASURES, command


def test_make_knows_every_target() -> None:
    """`make -n` says what would be done."""
    lines = [line for block in BLOCKS if block.language != "python" for line in block.text.splitlines()]
    lines += [command for page in EVERY_PAGE for command in inline(page)]
    wanted = {bare(line).replace("NAME", "gram") for line in lines if line.startswith("make ")}
    assert len(wanted) > 20
    for command in wanted:
        words = command.replace("make ", "make -n ", 1)
        done = subprocess.run(["bash", "-c", words], cwd=ROOT, capture_output=True, text=True, check=False)
        assert done.returncode == 0, f"{command}: {done.stderr}"


@pytest.mark.parametrize("command", SHORT)
def test_long_commands_begin(command: str, tmp_path: Path) -> None:
    if not (ROOT / ".venv/bin/python").exists():
        pytest.skip("no .venv in the checkout (make setup)")
    if re.search("icarus|waves", command) and (reason := missing("icarus")):
        pytest.skip(reason)
    # neither this run's pytest nor a screen
    environment = {k: v for k, v in os.environ.items() if not re.match(r"PYTEST_|(WAYLAND_)?DISPLAY$", k)}
    environment["RELNAV_NO_APT"] = "1"
    done = subprocess.run(
        ["bash", "-c", command.format(folder=tmp_path)],
        cwd=ROOT,
        env=environment,
        capture_output=True,
        text=True,
        timeout=LONG,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert SHORT[command] in done.stdout


def page_of(folder: Path, text: str) -> Path:
    """A page with a text."""
    page = folder / "page.md"
    page.write_text(text)
    return page


@pytest.mark.parametrize(
    "text",
    [
        "```sh\nmake no-such-thing\n```\n",
        "```console\n$ relnav pose no-such-file.csv && echo well\nwell\n```\n",
        "    make no-such-thing\n",
        "```python\nimport no_such_thing\n```\n",
        "```python\nprint(1)\n```\n\n```text\n2\n```\n",
    ],
)
def test_a_command_that_does_not_work_is_noticed(text: str, folder: Path) -> None:
    (block,) = blocks(page_of(folder, text))
    assert to_run(block).strip()
    with pytest.raises(AssertionError):
        run(block, folder)


def test_a_new_command_in_the_text_is_noticed(tmp_path: Path) -> None:
    (command,) = inline(page_of(tmp_path, "Then `make no-such-thing` does it.\n"))
    assert inline_covered(command) is None


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
