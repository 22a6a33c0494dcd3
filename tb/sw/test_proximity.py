# SPDX-License-Identifier: Apache-2.0
"""The proximity manoeuvre end to end without RTL: files, exit codes, comparisons."""

from __future__ import annotations

import json
import re
import sys
from pathlib import Path

import numpy as np
import pytest
from relnav import cli, proximity
from relnav.errors import BackendError, InputError
from relnav.ivisnav.result import RatesResult
from relnav.proximity import run_proximity
from relnav.report import rates as report
from relnav.report.key_table import area_rows, read_area
from relnav.report.rates import PAPER_AREA

from tb.sw.rates_stub import Standin

FIGURES = {"geometry", "fig05_driven", "fig06_idle", "fig07_percent", "condition", "bounds"}


@pytest.fixture
def undrawn(monkeypatch: pytest.MonkeyPatch) -> None:
    """No figures, which take the time."""
    monkeypatch.setattr(report, "draw_groups", lambda drawings, step: [])


def written(out: Path) -> set[str]:
    return {path.name for path in out.iterdir()}


def summary_of(out: Path) -> dict[str, object]:
    value: dict[str, object] = json.loads((out / "summary.json").read_text(), parse_constant=pytest.fail)
    return value


def test_report(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    solvers = Standin()
    assert run_proximity(6, "icarus", tmp_path, camera=True, solvers=solvers, quiet=True) == 0
    assert written(tmp_path) == {
        "report.html",
        "summary.json",
        "camera.png",
        *(f"{name}.png" for name in FIGURES),
    }
    html = (tmp_path / "report.html").read_text()
    assert not re.search(r'(?:src|href)="(?!data:)', html)  # nothing outside itself
    assert html.count("data:image/png;base64,") == len(FIGURES) + 1
    for text in ("the paper's Figure 5", "the paper's Figure 7", "35488 / 1555 / 14968 / 12.5 / 120"):
        assert text in html
    out = capsys.readouterr().out
    assert "PASS: RTL equals the bit-exact model" in out and "12 of 12 frames, every bit" in out
    assert "343 (3.43 us at 100 MHz)" in out
    summary = summary_of(tmp_path)
    assert summary["passed"] is True and summary["bit_exact"] is True
    percent = summary["percent_error_max"]
    assert isinstance(percent, dict) and max(percent["core"]) < 1e-4
    assert max(percent["paper_q15_16"][0]["worst"]) < 3 < max(percent["paper_q15_16"][1]["worst"])
    # the camera's poses and rates come from the same backend; the model carries the pose on
    assert {"poses: icarus", "icarus", "fixed", "double"} == set(solvers.calls)
    assert solvers.calls.count("icarus") == 2 and solvers.calls.count("fixed") == 2 + 6


@pytest.mark.usefixtures("undrawn")
@pytest.mark.parametrize(
    ("spoil", "code", "text"),
    [
        ("bit", 1, "FAIL: RTL and bit-exact model differ"),
        ("failed", 1, "FAIL: RTL and bit-exact model differ"),
        ("bound", 1, "FAIL: numerical bound broken"),
    ],
)
def test_exit_code_says_what_it_must(
    spoil: str, code: int, text: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run_proximity(3, "verilator", tmp_path, solvers=Standin(spoil), quiet=True) == code
    assert text in capsys.readouterr().out
    summary = summary_of(tmp_path)
    assert summary["passed"] is False and (summary["differences"] != []) is (spoil != "bound")
    assert "What failed" in (tmp_path / "report.html").read_text()


@pytest.mark.usefixtures("undrawn")
def test_without_rtl(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run_proximity(2, "double", tmp_path, camera=True, solvers=Standin(), quiet=True) == 0
    out = capsys.readouterr().out
    assert "RTL backends only" in out and "PASS: numerical bound held" in out
    assert summary_of(tmp_path)["bit_exact"] is None


@pytest.mark.usefixtures("undrawn")
def test_the_real_model(tmp_path: Path) -> None:
    assert run_proximity(3, "fixed", tmp_path, quiet=True) == 0
    summary = summary_of(tmp_path)
    errors = summary["numerical_error_max"]
    assert isinstance(errors, list) and max(errors) < 1e-6


def test_a_camera_that_sees_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(proximity, "Camera", lambda: proximity_camera())
    with pytest.raises(BackendError, match="first image gave no pose"):
        run_proximity(2, "double", tmp_path, camera=True, solvers=Standin(), quiet=True)


def proximity_camera() -> object:
    from relnav.ivisnav.camera import Camera

    return Camera(fiducials=2)


def test_frames_without_rates_do_not_move_the_pose() -> None:
    failed = RatesResult(0, 6, flags=("WATCHDOG",))
    good = RatesResult(1, 6, v=np.array([1.0, 0, 0]), omega=np.zeros(3))
    assert [part.tolist() for part in proximity._expected([failed])] == [[0, 0, 0], [0, 0, 0]]
    assert proximity._expected([failed, good])[0].tolist() == [1.0, 0, 0]
    faster = RatesResult(2, 6, v=np.array([3.0, 0, 0]), omega=np.zeros(3))
    assert proximity._expected([good, faster])[0].tolist() == [4.0, 0, 0]


def test_refuses_a_file_for_a_folder(tmp_path: Path) -> None:
    (tmp_path / "out").write_text("")
    for out in (tmp_path / "out", tmp_path / "out" / "deeper"):
        with pytest.raises(InputError, match="out"):
            run_proximity(2, "double", out, solvers=Standin(), quiet=True)


def test_area_of_the_core(tmp_path: Path) -> None:
    total = {"LUT": 11000, "LUTRAM": 900, "FF": 9000, "BRAM": 1, "DSP": 40}
    path = tmp_path / "results.json"
    path.write_text(json.dumps({"ivisnav_top": {"area": {"builds": {"full": {"total": total}}}}}))
    (row,) = area_rows(read_area(path, "ivisnav_top"), PAPER_AREA)
    assert row.here == "11000 / 900 / 9000 / 1 / 40" and row.paper == "35488 / 1555 / 14968 / 12.5 / 120"


def test_options_are_passed_on(monkeypatch: pytest.MonkeyPatch) -> None:
    calls: list[dict[str, object]] = []

    class Proximity:
        @staticmethod
        def run_proximity(**options: object) -> int:
            calls.append(options)
            return 1

    monkeypatch.setitem(sys.modules, "relnav.proximity", Proximity)
    assert cli.main(["proximity", "--frames", "3", "--camera", "--out", "x", "--backend", "fixed"]) == 1
    assert calls == [{"frames": 3, "backend": "fixed", "out": Path("x"), "camera": True, "rtl": None}]
