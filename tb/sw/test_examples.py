# SPDX-License-Identifier: Apache-2.0
"""Every example runs, says sane numbers and leaves a picture; without its data it says so and is well."""

from __future__ import annotations

import re
import sys
from collections.abc import Callable
from pathlib import Path

import cv2
import pytest
from matplotlib.figure import Figure

from examples import common, landing, proximity, rgbd_odometry, scan_alignment
from scripts.examples import IMAGES, LARGEST, README, RUNS
from sim.sources import ROOT

Run = Callable[..., str]
MODULES = {
    "rgbd_odometry": rgbd_odometry.odometry,
    "scan_alignment": scan_alignment.alignment,
    "landing": landing.landing,
    "proximity": proximity.proximity,
}
NUMBER = r"[-+]?\d+(?:\.\d+)?(?:e[-+]\d+)?"


@pytest.fixture
def run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Run:
    """Runs an example with options, checks exit code and picture, returns what it printed."""

    def run_one(name: str, *options: str) -> str:
        example: Callable[[common.Options], Figure] = MODULES[name]
        monkeypatch.setattr(sys, "argv", [name, "--out", str(tmp_path), *options])
        assert common.run(name, example, "test", frames=2, scans=name == "scan_alignment") == 0
        printed = capsys.readouterr().out
        if not printed.startswith("skipped"):
            drawn = cv2.imread(str(tmp_path / f"{name}.png"))
            assert drawn is not None and min(drawn.shape[:2]) > 400 and drawn.std() > 10
        return printed

    return run_one


def row(printed: str, name: str) -> list[float]:
    """The numbers behind a table's row."""
    found = re.search(rf"^{re.escape(name)}  (.*)$", printed, re.MULTILINE)
    assert found, printed
    return [float(number) for number in re.findall(NUMBER, found[1])]


def test_rgbd_odometry(run: Run) -> None:
    if not (common.DATA / rgbd_odometry.SEQUENCE / "poses.npz").is_file():
        pytest.skip("../shared/data has no RGB-D sequence")
    printed = run("rgbd_odometry", "--frames", "4")
    a_pair, end, drift, turned, from_double = row(printed, "core")
    assert 0 < a_pair < 2 and 0 < end < 4 and 0 < drift < 1 and turned < 0.2
    assert 0 < from_double < 0.01
    assert row(printed, "double")[:4] == [a_pair, end, drift, turned]
    assert row(printed, "paper's Q15.16")[-1] > 10 * from_double


def test_scan_alignment_of_simulated_scans(run: Run) -> None:
    printed = run("scan_alignment", "--scans", "terrain", "--frames", "6")
    apart, wrong, good, last, kabsch = (
        row(
            printed, next(line for line in re.findall(r"^\S.*?(?=  )", printed, re.MULTILINE) if text in line)
        )[0]
        for text in ("as they are", "all ", "that agree", "step 6", "by Kabsch")
    )
    assert apart > 100 > wrong > good > last > 0
    assert last == kabsch


def test_scan_alignment_of_recorded_scans(run: Run) -> None:
    if not (common.DATA / scan_alignment.RECORDED).is_file():
        pytest.skip("../shared/data has no pair of scans")
    printed = run("scan_alignment", "--frames", "5")
    assert row(printed, "scans as they are")[0] > 0.5 > 0.05 > row(printed, "surfaces, step 5")[0]


def test_few_steps_are_shown_as_they_are(run: Run) -> None:
    printed = run("scan_alignment", "--scans", "terrain", "--frames", "2")
    assert re.findall(r"^surfaces, step (\d+)", printed, re.MULTILINE) == ["1", "2"]
    assert "step 2 by Kabsch" in printed


def test_landing(run: Run) -> None:
    printed = run("landing", "--frames", "4")
    error, drift, turned, from_double = row(printed, "core")
    assert 0 < error < 3 and 0 < drift < 0.5 and turned < 0.02 and 0 < from_double < 0.01
    assert row(printed, "double")[:3] == [error, drift, turned]
    inside = re.search(rf"foretold by the core: ({NUMBER}) m; inside: ({NUMBER})%", printed)
    assert inside and error < float(inside[1]) < 10 and float(inside[2]) > 85


def test_proximity(run: Run) -> None:
    printed = run("proximity", "--frames", "60")
    held, both, double = (
        row(printed, name) for name in ("camera alone, pose held", "camera and rates", "  the same in double")
    )
    assert held[1] > 100 and both[1] < 2 and both[3] < 3
    assert both == double


@pytest.mark.parametrize("name", ["rgbd_odometry", "scan_alignment"])
def test_without_its_data_an_example_is_skipped(run: Run, tmp_path: Path, name: str) -> None:
    options = ["--scans", "recorded"] if name == "scan_alignment" else []
    assert run(name, "--data", str(tmp_path / "none"), *options).startswith("skipped: no ")
    assert not (tmp_path / f"{name}.png").exists()


def test_bad_input_is_one_line(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.setattr(sys, "argv", ["landing", "--frames", "1"])
    assert common.run("landing", landing.landing, "test", frames=2) == 2
    assert capsys.readouterr().err == "python -m examples.landing: --frames 1: two are the least\n"


def test_a_bad_option_is_one_line(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, "argv", ["landing", "--backend", "nope"])
    with pytest.raises(SystemExit) as left:
        common.run("landing", landing.landing, "test", frames=2)
    said = capsys.readouterr().err
    assert left.value.code == 2 and said.count("\n") == 1 and "nope" in said


def test_page() -> None:
    page = README.read_text()
    assert set(re.findall(r"<!-- (\w+):begin -->", page)) == RUNS.keys()
    assert {file.stem for file in (ROOT / "examples").glob("*.py")} == MODULES.keys() | {"__init__", "common"}
    for target in re.findall(r"\]\(([^)]+)\)", page):
        file = README.parent / target
        assert file.is_file(), target
        assert file.suffix != ".png" or (
            file.parent == README.parent / "../docs/images" and file.stat().st_size <= LARGEST
        )
    assert IMAGES.is_dir()
