# SPDX-License-Identifier: Apache-2.0
"""Every block of docs/integration.md is run: the shell's in a copy of the checkout, Python's on stand-ins."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from relnav.buses import memory_map
from relnav.buses.memory_map import UioBus
from relnav.driver import OltaeDriver
from relnav.ivisnav.driver import IvisnavDriver
from relnav.vlnv import vlnv

from sim.runner import missing
from sim.sources import ROOT
from tb.sw.model_core import MODELS, CoreDevice, SolvingCore, WatchedMap

PAGE = ROOT / "docs/integration.md"
BLOCKS = re.findall(r"^```(\w*)\n(.*?)^```$", PAGE.read_text(), re.MULTILINE | re.DOTALL)
SHELL = [
    (text, BLOCKS[index + 1][1] if BLOCKS[index + 1 : index + 2] and BLOCKS[index + 1][0] == "text" else "")
    for index, (language, text) in enumerate(BLOCKS)
    if language == "sh"
]
# the first block puts the tools on the PATH: every other begins with it
PATHS = SHELL[0][0]
PYTHON = [text for language, text in BLOCKS if language == "python"]
TREE = (
    *("rtl", "sim", "syn", "vivado", "registers", "docs", "sw/relnav", "oltae.core", "ivisnav.core"),
    *("pyproject.toml", "setup.py", "MANIFEST.in", "README.md", "LICENSE", "CHANGELOG.md", "constraints.txt"),
)
VIVADO = """#!/bin/sh
[ "$1 $2 $3 $5" = "-mode batch -source -tclargs" ] || exit 9
script=$4; shift 5
exec env PROGRESS=100% STATS.WNS=0.1 MISSING= tclsh "{stubs}" "$script" "$@"
"""
SYSTEM = ("/usr/local/bin", "/usr/bin", "/bin")
NEEDS = {"iverilog": "icarus", "icarus": "icarus", "verilator": "verilator", "target=lint": "verilator"}


def test_the_page_has_its_blocks() -> None:
    languages = [language for language, _ in BLOCKS]
    assert (
        languages.count("sh") >= 5
        and languages.count("python") == 3
        and set(languages)
        <= {
            "sh",
            "text",
            "python",
            "dts",
        }
    )


@pytest.fixture
def checkout(tmp_path: Path) -> Iterator[Path]:
    """A copy of what the commands look at."""
    ignore = shutil.ignore_patterns("__pycache__", ".mypy_cache")
    for name in TREE:
        target = tmp_path / "tree" / name
        target.parent.mkdir(parents=True, exist_ok=True)
        if (ROOT / name).is_dir():
            shutil.copytree(ROOT / name, target, ignore=ignore)
        else:
            shutil.copy(ROOT / name, target)
    yield tmp_path / "tree"
    shutil.rmtree(tmp_path / "tree")


@pytest.mark.parametrize("number", range(len(SHELL)))
def test_shell(number: int, checkout: Path) -> None:
    commands, expected = SHELL[number]
    reasons = {missing(simulator) for word, simulator in NEEDS.items() if word in commands}
    if found := [reason for reason in reasons if reason]:
        pytest.skip(found[0])
    if "fusesoc" in commands and not Path(sys.executable).with_name("fusesoc").is_file():
        pytest.skip("FuseSoC is not installed (make setup)")
    if not (Path(sys.prefix) / "bin/activate").is_file():
        pytest.skip("no virtual environment (make setup)")
    if "vivado -mode" in commands and shutil.which("tclsh") is None:
        pytest.skip("no tclsh (Debian package tcl)")
    home = checkout.parent / "home"
    tools = home / "bin"
    tools.mkdir(parents=True)
    (tools / "vivado").write_text(VIVADO.format(stubs=ROOT / "tb/package/vivado_stubs.tcl"))
    (tools / "vivado").chmod(0o755)
    (checkout / ".venv").symlink_to(sys.prefix)
    # what the system has; the rest of the PATH is the page's own affair
    path = [str(tools), *SYSTEM]
    kept = {
        name: value for name, value in os.environ.items() if not name.startswith(("RELNAV_", "VIRTUAL_ENV"))
    }
    environment = kept | {"PATH": os.pathsep.join(path), "HOME": str(home), "PIP_NO_INDEX": "1"}
    environment |= {f"XDG_{name}_HOME": str(home) for name in ("CACHE", "CONFIG", "DATA")}
    environment |= {"PIP_DISABLE_PIP_VERSION_CHECK": "1"}
    done = subprocess.run(
        ["bash", "-e", "-c", (PATHS if number else "") + commands],
        cwd=checkout,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "FAIL" not in done.stdout and "%Warning" not in done.stderr
    for line in expected.splitlines():
        assert line in done.stdout.splitlines(), done.stdout


def files(folder: Path, monkeypatch: pytest.MonkeyPatch, driver: type[Any]) -> SolvingCore:
    """Files for the devices that the page names; a core behind /dev/uio0 and at 0x43C00000 of /dev/mem."""
    core = SolvingCore(driver, MODELS[driver])
    entries = folder / "sys/uio0/maps/map0"
    entries.mkdir(parents=True)
    (entries / "size").write_text("0x1000\n")
    (entries / "offset").write_text("0x0\n")
    names = {"/dev/uio0": "uio0", "/dev/mem": "mem", "/dev/udmabuf0": "buffer"}
    for name in names.values():
        (folder / name).write_bytes(bytes(1 << 21))
    asked: list[tuple[str, int, int]] = []

    class PageMap(WatchedMap):
        def __init__(self, file: str | Path, offset: int, size: int) -> None:
            place = folder / names[str(file)] if str(file) in names else Path(file)
            asked.append((place.name, offset, size))
            super().__init__(place, 0 if place.name == "mem" else offset, size)
            self.device = (
                CoreDevice(core) if (place.name, offset) in (("uio0", 0), ("mem", 0x43C0_0000)) else None
            )

    monkeypatch.setattr(memory_map, "MemoryMap", PageMap)
    monkeypatch.setattr(
        memory_map, "UioBus", lambda device: UioBus(folder / names[device], sysfs=folder / "sys")
    )
    monkeypatch.setattr(UioBus, "idle", lambda self: None)
    vars(core)["asked"] = asked
    return core


def test_python_uio(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    core = files(tmp_path, monkeypatch, OltaeDriver)
    space: dict[str, Any] = {}
    exec(compile(PYTHON[0], str(PAGE), "exec"), space)
    assert len(core.frames) == 1 and space["pose"].flags == ()
    assert abs(space["pose"].t - [1.0, 2.0, 3.0]).max() < 1e-6
    assert capsys.readouterr().out == f"{space['pose'].t} ()\n" and space["pose"].n == 20


def test_python_dma(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    core = files(tmp_path, monkeypatch, IvisnavDriver)
    read_text = Path.read_text
    place = "/sys/class/u-dma-buf/udmabuf0/phys_addr"
    monkeypatch.setattr(
        Path, "read_text", lambda self, *a: "0x1f400000\n" if str(self) == place else read_text(self, *a)
    )
    space: dict[str, Any] = {}
    exec(compile(PYTHON[1], str(PAGE), "exec"), space)
    assert space["dma"].physical == 0x1F40_0000 and space["dma"].capacity >= 2_097_120
    assert vars(core)["asked"] == [
        ("buffer", 0, 1 << 21),
        ("mem", 0x4040_0000, 0x10000),
        ("mem", 0x43C0_0000, 4096),
    ]


def test_python_pynq(monkeypatch: pytest.MonkeyPatch) -> None:
    """The overlay makes its objects from what `bindto` names, as pynq does."""
    core, classes = SolvingCore(OltaeDriver, MODELS[OltaeDriver]), {}

    class DefaultIP:
        bindto: list[str]

        def __init_subclass__(cls) -> None:
            classes.update(dict.fromkeys(cls.bindto, cls))

        def read(self, offset: int) -> int:
            return core.read(offset)

    class Overlay:
        def __init__(self, bitstream: str) -> None:
            self.oltae = classes[vlnv("oltae_top")]()
            self.dma = type("Dma", (), {"sendchannel": None})()

    package = ModuleType("pynq")
    vars(package).update(DefaultIP=DefaultIP, Overlay=Overlay, allocate=None)
    monkeypatch.setitem(sys.modules, "pynq", package)
    monkeypatch.delitem(sys.modules, "relnav.buses.pynq", raising=False)
    space: dict[str, Any] = {}
    exec(compile(PYTHON[2], str(PAGE), "exec"), space)
    monkeypatch.delitem(sys.modules, "relnav.buses.pynq")
    assert set(classes) == {vlnv("oltae_top"), vlnv("ivisnav_top")}
    assert type(space["driver"]) is OltaeDriver
