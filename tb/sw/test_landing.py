# SPDX-License-Identifier: Apache-2.0
"""The landing end to end without RTL: files, exit codes, comparisons, waveform."""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from relnav import landing
from relnav.backends import solve
from relnav.comparison import Solutions, differing_fields
from relnav.errors import InputError
from relnav.frames import Frame
from relnav.landing import Solver, run_landing
from relnav.model.raw import CoreConfig
from relnav.report.key_table import Row, read_area
from relnav.report.page import page
from relnav.report.style import house_style
from relnav.report.summary import key_rows, summarise
from relnav.report.waveform import waveform_figure
from relnav.result import PoseResult
from relnav.sensor.flight import Flight, Simulator
from relnav.sensor.terrain import load_terrain

FIGURES = (
    "flight", "fig01_matches", "fig02_clouds", "fig08_attitude", "fig09_translation", "fig10_attitude_error",
    "fig11_translation_error", "fig12_relative_error",
)  # fmt: skip


def core_like(result: PoseResult, **changes: object) -> PoseResult:
    """A double result as a core gives it: binary32, with cycle counts."""
    fields = ("q", "R", "t", "q_cov", "t_cov")
    rounded = {name: np.asarray(getattr(result, name), np.float32).astype(float) for name in fields}
    return replace(result, **rounded, **changes)  # type: ignore[arg-type]


def solver_with(spoil: str = "") -> Solver:
    """A stand-in for every backend: golden numbers in binary32; spoil makes the RTL's last frame wrong."""

    def stand_in(
        frames: Sequence[Frame], backend: str, config: CoreConfig, rtl: Path | None
    ) -> list[PoseResult]:
        double = solve(frames, "double", config=config)
        if backend == "double":
            return double
        cycles = {"q": 97, "pose": 121, "all": 160} if backend != "fixed" else None
        results = [core_like(result, cycles=cycles) for result in double]
        last = results[-1]
        assert last.q is not None
        if spoil == "bit" and backend != "fixed":
            results[-1] = replace(last, q=np.nextafter(np.float32(last.q), np.float32(1)).astype(float))
        if spoil == "bound":  # both the same, both wrong
            results[-1] = replace(last, q=last.q * (1 + 3e-7))
        if spoil == "failed" and backend != "fixed":
            results[-1] = PoseResult(last.frame, last.n, flags=("WATCHDOG",))
        if spoil == "truth":  # far outside 3 sigma, yet numerically as it should be
            assert last.q_cov is not None
            results[-1] = replace(last, q_cov=last.q_cov * 1e-12)
        return results

    return stand_in


@pytest.fixture(scope="module")
def flown() -> Flight:
    """Three frames, flown once for all tests that only look at exit codes."""
    simulator = Simulator(load_terrain(), 3)
    return simulator.collect(list(simulator.fly()))


@pytest.mark.parametrize(
    ("spoil", "code", "text"),
    [
        ("", 0, "PASS: RTL equals the bit-exact model"),
        ("bit", 1, "FAIL: RTL and bit-exact model differ"),
        ("bound", 1, "FAIL: numerical bound broken"),
        ("failed", 1, "FAIL: RTL and bit-exact model differ"),
        ("truth", 0, "PASS"),
    ],
)
def test_exit_code_says_what_it_must(
    spoil: str,
    code: int,
    text: str,
    flown: Flight,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    seen: list[Solutions] = []

    def no_report(solved: Solutions, *_: object, **__: object) -> list[Row]:
        seen.append(solved)
        return key_rows(solved, [], {})

    monkeypatch.setattr(landing, "_fly", lambda simulator, bar: flown)
    monkeypatch.setattr(landing, "write_report", no_report)
    monkeypatch.setattr(landing, "time_solvers", lambda frames: [])
    assert run_landing(None, 3, "icarus", tmp_path, solver=solver_with(spoil), quiet=True) == code
    assert text in capsys.readouterr().out
    summary = json.loads(json.dumps(summarise(seen[0], [], {}), allow_nan=False))
    assert summary["passed"] is (code == 0)
    assert (summary["differences"] != []) is (spoil in ("bit", "failed"))
    assert (summary["share_inside_3_sigma"]["q"] == [0.5] * 3) is (spoil in ("truth", "failed"))
    assert ("What failed" in page(seen[0], [], [])) is (code == 1)


def test_landing_in_double_writes_a_self_contained_report(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(landing, "WAVES", tmp_path / "none")
    out = tmp_path / "report"
    assert run_landing(None, 3, "double", out, solver=solver_with()) == 0
    written = {path.name for path in out.iterdir()}
    assert written == {"report.html", "summary.json", *(f"{name}.png" for name in FIGURES)}
    for name in FIGURES:
        assert (out / f"{name}.png").read_bytes().startswith(b"\x89PNG")
    html = (out / "report.html").read_text()
    assert html.count("data:image/png;base64,") == len(FIGURES)
    assert not re.search(r'(src|href)="(?!data:)', html)
    assert "http" not in re.sub(r'base64,[^"]*', "", html)
    assert str(tmp_path) not in html
    summary = json.loads((out / "summary.json").read_text())
    assert (summary["frames"], summary["poses"], len(summary["per_frame"])) == (3, 2, 2)
    assert summary["bit_exact"] is None
    assert summary["matches"]["fewest"] >= 3
    assert summary["numerical_error_max"] < 1e-7
    for frame in summary["per_frame"]:
        assert np.allclose(frame["q"], frame["q_true"], atol=1e-3)
        assert np.allclose(frame["t"], frame["t_true"], atol=2.0)
    streams = capsys.readouterr()
    assert "one pose on this CPU: numpy" in streams.out
    assert "100%" in streams.err  # the progress bar


def test_bad_input_leaves_nothing_behind(tmp_path: Path) -> None:
    with pytest.raises(InputError):
        run_landing(tmp_path / "absent.npz", 3, "double", tmp_path / "out", quiet=True)
    assert not (tmp_path / "out").exists()
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="needs a folder"):
        run_landing(None, 3, "double", tmp_path / "file", quiet=True)


def test_the_last_bit_counts() -> None:
    one = PoseResult(1, 5, q=np.array([0.0, 1.0, 2.0]), turn="none", rss=1.0)
    assert differing_fields(one, replace(one, cycles={"q": 1, "pose": 2, "all": 3})) == []
    assert one.q is not None
    assert differing_fields(one, replace(one, q=np.nextafter(one.q, 9.0))) == ["q"]
    assert differing_fields(one, replace(one, q=None, turn="x", flags=("Q_SATURATED",))) == [
        "q",
        "turn",
        "flags",
    ]


def test_area_is_read_from_the_synthesis_results(tmp_path: Path) -> None:
    path = tmp_path / "results.json"
    assert read_area(path) == {}
    path.write_text("[]")
    assert read_area(path) == {}
    total = {"LUT": 5000, "LUTRAM": 10, "FF": 7000, "DSP": 48}
    path.write_text(json.dumps({"oltae_top": {"area": {"builds": {"lean": {"total": total}}}}}))
    assert read_area(path) == {"lean": total}


# ---- waveform


def vcd(path: Path) -> Path:
    """A frame of four beats, q ready 30 cycles after the last, pose 40, all 50."""
    names = (
        "clk",
        "s_axis_tvalid",
        "s_axis_tready",
        "s_axis_tlast",
        "state",
        "q_ready",
        "pose_ready",
        "all_ready",
    )
    codes = dict(zip(names, "!abcdefg", strict=True))
    lines = ["$timescale 1ns $end", "$scope module oltae_top $end"]
    lines += [f"$var wire {3 if n == 'state' else 1} {c} {n} $end" for n, c in codes.items()]
    lines += ["$upscope $end", "$enddefinitions $end"]
    for cycle in range(100):
        since = cycle - 20  # cycles after the edge that takes the last beat
        wires = {
            "s_axis_tvalid": 15 <= cycle < 20, "s_axis_tready": cycle < 20, "s_axis_tlast": cycle == 19,
            "q_ready": since >= 30, "pose_ready": since >= 40, "all_ready": since >= 50,
        }  # fmt: skip
        state = 0 if cycle < 15 else 1 if since < 0 else 2 if since < 50 else 3
        lines += [f"#{10 * cycle}", "1!", f"b{state:03b} {codes['state']}"]
        lines += [f"{int(level)}{codes[name]}" for name, level in wires.items()]
        lines += [f"#{10 * cycle + 5}", "0!"]
    path.write_text("\n".join(lines) + "\n")
    return path


def test_waveform_is_drawn(tmp_path: Path) -> None:
    pytest.importorskip("pywellen", reason="pywellen is not installed")
    with house_style():
        picture = waveform_figure(vcd(tmp_path / "oltae_top.vcd"))
    assert picture.png is not None
    assert "state by name" in picture.caption


@pytest.mark.parametrize("content", [None, "", "no waveform", "$enddefinitions $end\n#0\n"])
def test_waveform_that_cannot_be_drawn_says_why(content: str | None, tmp_path: Path) -> None:
    path = tmp_path / "oltae_top.vcd"
    if content is not None:
        path.write_text(content)
    picture = waveform_figure(path)
    assert picture.png is None
    assert picture.caption.startswith("Not drawn: ")
