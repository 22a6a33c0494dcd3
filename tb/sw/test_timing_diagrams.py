# SPDX-License-Identifier: Apache-2.0
"""The timing diagrams of the data sheets are what the cores do, and their pictures are up to date."""

from __future__ import annotations

import itertools
import os
import re
import subprocess
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import pytest
import yaml

from scripts.wavedrom_svg import SOURCES, render, target
from sim.runner import missing
from sim.sources import ROOT

STATES = {"IDLE": "0", "LOAD": "1", "SEND_DATA": "1", "COMPUTE": "2", "DONE": "3", "VERIFY": "4"}
PREFIXES = ("s_axil_", "s_axis_")


@dataclass(frozen=True)
class Scene:
    """Where the bench shows what a diagram draws."""

    core: str
    name: str
    macros: tuple[str, ...]
    skip: int = 0
    """Clocks of the scene before the first that is drawn."""


PLAIN = ("BEATS=9", "PAUSE=4", "FIRST=q_ready", "SECOND=pose_ready")
WEIGHTED = ("BEATS=12", "PAUSE=5", "FIRST=q_ready", "SECOND=pose_ready", "WEIGHTED")
ROWS = ("BEATS=24", "PAUSE=4", "FIRST=rates_ready", "SECOND=rates_ready")
SCENES = {
    "axi_write": Scene("oltae", "write", PLAIN),
    "axi_read": Scene("oltae", "read", PLAIN),
    "oltae_stream": Scene("oltae", "stream", PLAIN),
    "oltae_stream_weighted": Scene("oltae", "stream", WEIGHTED),
    "oltae_results": Scene("oltae", "results", PLAIN),
    "push": Scene("oltae", "push", PLAIN),
    "ivisnav_stream": Scene("ivisnav", "stream", ROWS),
    "ivisnav_last": Scene("ivisnav", "stream", ROWS, 38),
    "ivisnav_results": Scene("ivisnav", "results", ROWS),
}
DRAWINGS = sorted(SOURCES.glob("*.json5"))


def test_every_drawing_has_a_scene() -> None:
    assert {drawing.stem for drawing in DRAWINGS} == set(SCENES)


@pytest.mark.parametrize("drawing", DRAWINGS, ids=lambda drawing: str(drawing.stem))
def test_pictures_are_up_to_date(drawing: Path) -> None:
    pytest.importorskip("wavedrom")
    assert target(drawing).read_text() == render(drawing), "python scripts/wavedrom_svg.py"


@cache
def played(core: str, macros: tuple[str, ...], folder: Path) -> list[tuple[str, dict[str, str]]]:
    """Scene and signals of every clock that the bench shows."""
    run = folder / f"{core}_{len(macros)}_{macros[0]}.vvp"
    defines = [f"-DRELNAV_TOP={core}_top", *(f"-DRELNAV_{macro}" for macro in macros)]
    bench = os.path.relpath(ROOT / "tb/sw/waves.v", ROOT / "rtl")
    compile_ = ["iverilog", "-g2005", *defines, "-s", "waves", "-o", str(run), "-c", f"{core}.f", bench]
    subprocess.run(compile_, cwd=ROOT / "rtl", check=True)
    shown = subprocess.run(["vvp", "-n", str(run)], capture_output=True, text=True, check=True).stdout
    lines = [line.split() for line in shown.splitlines() if "=" in line]
    return [(name, dict(pair.split("=", 1) for pair in pairs)) for name, *pairs in lines]


def drawn(drawing: Path) -> list[dict[str, str]]:
    """Signals of every column of a diagram; lanes of data, and clk, are left out."""
    lanes: dict[str, list[str]] = {}
    for lane in yaml.safe_load(drawing.read_text())["signal"]:
        name, labels = lane["name"], iter(lane.get("data", ()))
        columns: list[str] = []
        for prefix in PREFIXES:
            name = name.removeprefix(prefix)
        labelled = "data" in lane
        if name == "clk" or (labelled and name != "state"):
            continue
        for letter in lane["wave"]:
            if letter in ".|":
                columns.append(columns[-1])
            else:
                columns.append(STATES[next(labels).strip()] if labelled else letter)
        lanes[name.removesuffix("_ready")] = columns
    return [dict(zip(lanes, values, strict=True)) for values in zip(*lanes.values(), strict=True)]


def steps(columns: list[dict[str, str]]) -> list[dict[str, str]]:
    """Where anything changes."""
    return [column for column, _ in itertools.groupby(columns)]


@pytest.mark.parametrize("drawing", DRAWINGS, ids=lambda drawing: str(drawing.stem))
def test_the_core_does_what_is_drawn(drawing: Path, tmp_path_factory: pytest.TempPathFactory) -> None:
    if reason := missing("icarus"):
        pytest.skip(reason)
    scene = SCENES[drawing.stem]
    picture = drawn(drawing)
    folder = tmp_path_factory.getbasetemp()
    clocks: list[dict[str, Any]] = [
        {signal: values[{"rates": "q"}.get(signal, signal)] for signal in picture[0]}
        for name, values in played(scene.core, scene.macros, folder)
        if name == scene.name
    ][scene.skip :]
    assert len(picture) > 5 and len(picture[0]) >= 3
    if "|" in re.findall(r"wave: '(p[^']*)'", drawing.read_text())[0]:  # time is left out
        assert steps(picture) == steps(clocks)
    else:
        assert picture == clocks[: len(picture)]
