# SPDX-License-Identifier: Apache-2.0
"""The simulated backend as a user meets it: one JSON object, one line for an error, a waveform when asked."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from relnav.errors import BackendError
from relnav.frames import make_frame
from relnav.ivisnav.quantise import QuantisedRows
from relnav.quantise import quantise
from relnav.rtlsim import run_frames, run_rate_frames

from sim.runner import RTL, missing

pytestmark = pytest.mark.skipif(missing("icarus") is not None, reason=str(missing("icarus")))
A = np.random.default_rng(1).normal(size=(5, 3))
FRAME = quantise(make_frame(A, A + 1.0))
H = np.vstack((np.eye(6, dtype=np.int64), np.ones((2, 6), dtype=np.int64))) << 20
ROWS = QuantisedRows(H, H @ [1, -2, 3, -4, 5, -6], np.ones(8, dtype=np.int64), 20, 20)


def test_json_is_one_object(tmp_path: Path, simulator: str) -> None:
    rows = [",".join(map(str, [*p, *(p + 1.0), k])) for k in (0, 1) for p in A]
    rows += ["0,0,0,1,1,1,2", "1,0,0,2,1,1,2"]
    (tmp_path / "points.csv").write_text("\n".join(["ax,ay,az,bx,by,bz,frame", *rows, ""]))
    command = [sys.executable, "-m", "relnav.cli", "pose", "points.csv", "--json", "--backend", simulator]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (3, "")
    first, second, few = json.loads(done.stdout)["frames"]
    assert first["flags"] == [] and 0 < first["cycles"]["q"] < first["cycles"]["pose"]
    np.testing.assert_allclose(first["t"], [1.0, 1.0, 1.0], rtol=1e-6)
    assert {**first, "frame": second["frame"]} == second
    assert few["flags"] == ["FEW_POINTS"] and few["R"] is None
    assert [path.name for path in tmp_path.iterdir()] == ["points.csv"]


def replaced(file: str, old: str, new: str) -> Callable[[Path], None]:
    def edit(rtl: Path) -> None:
        text = (rtl / file).read_text()
        assert old in text
        (rtl / file).write_text(text.replace(old, new, 1))

    return edit


@pytest.mark.parametrize(
    ("edit", "message"),
    [
        (
            replaced("oltae/oltae_core.v", "always @(posedge clk) begin", "always @(posedge clk) begn"),
            r"cannot compile the RTL: \S*/mine/oltae/oltae_core\.v:\d+: syntax error",
        ),
        (
            replaced("axi/frame_state.v", "state_next = LOADING;", "state_next = LOADINGG;"),
            r"/mine/axi/frame_state\.v:\d+: .*LOADINGG",
        ),
        (lambda rtl: (rtl / "gram" / "centring.v").unlink(), r"/mine/gram/\w+\.v:\d+: .*centring"),
        (lambda rtl: (rtl / "include" / "relnav_words.vh").unlink(), r"/mine/\S+:\d+: .*relnav_words\.vh"),
        (lambda rtl: (rtl / "oltae" / "oltae_top.v").unlink(), r"mine: holds no oltae_top\.v"),
        (
            replaced("include/oltae_registers.vh", "32'h4F4C5445", "32'h00000005"),
            "no OLTAE core here: ID reads 0x00000005",
        ),
        (
            replaced("axi/axil_slave.v", "capture || (s_axil_rvalid", "(s_axil_rvalid"),
            "not answer the read of 0x000",
        ),
        (
            replaced("axi/frame_loader.v", "s_axis_tready = ", "s_axis_tready = 1'b0 && "),
            "not take the stream's beats",
        ),
        (
            replaced("axi/frame_loader.v", "frame_start = clear", "frame_start = 1'b0"),
            "the OLTAE core was upset",
        ),
        (
            replaced("oltae/oltae_top.v", ".frame_complete(complete)", ".frame_complete(1'b0)"),
            "no result after .* state is DONE",
        ),
    ],
    ids=["syntax", "name", "module", "header", "top", "id", "bus", "stream", "upset", "hang"],
)
def test_other_rtl_that_does_not_work(
    edit: Callable[[Path], None], message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("RELNAV_BUILD", str(tmp_path / "build"))
    rtl = tmp_path / "mine"
    shutil.copytree(RTL, rtl)
    edit(rtl)
    with pytest.raises(BackendError, match=message) as raised:
        run_frames([FRAME], "icarus", rtl_dir=rtl)
    assert "\n" not in str(raised.value)


def test_other_rtl_is_what_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A modified copy gives other numbers; without the copy they are ours again."""
    monkeypatch.setenv("RELNAV_BUILD", str(tmp_path / "build"))
    shutil.copytree(RTL, tmp_path / "mine")
    replaced("oltae/solve_engine.v", "fixed_valid ? fixed : binary32", "fixed_valid ? fixed : ~binary32")(
        tmp_path / "mine"
    )
    (theirs,) = run_frames([FRAME], "icarus", rtl_dir=tmp_path / "mine")
    (ours,) = run_frames([FRAME], "icarus")
    assert tuple(~word & 0xFFFFFFFF for word in ours.T) == theirs.T


@pytest.mark.parametrize(
    ("edit", "message"),
    [
        (lambda rtl: (rtl / "ivisnav" / "ivisnav_top.v").unlink(), r"mine: holds no ivisnav_top\.v"),
        (
            replaced("include/ivisnav_registers.vh", "32'h49564953", "32'h00000005"),
            "no iVisNav core here: ID reads 0x00000005",
        ),
        (
            replaced("ivisnav/ivisnav_core.v", ".frame_end(frame_end)", ".frame_end(1'b0)"),
            "the iVisNav core was upset",
        ),
        (
            replaced("ivisnav/ivisnav_top.v", ".frame_complete(complete)", ".frame_complete(1'b0)"),
            "no result after .* state is DONE",
        ),
    ],
    ids=["top", "id", "upset", "hang"],
)
def test_other_rtl_of_the_rates(
    edit: Callable[[Path], None], message: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("RELNAV_BUILD", str(tmp_path / "build"))
    rtl = tmp_path / "mine"
    shutil.copytree(RTL, rtl)
    edit(rtl)
    with pytest.raises(BackendError, match=message):
        run_rate_frames([ROWS], "icarus", rtl_dir=rtl)


def test_rates_of_an_exact_frame(simulator: str) -> None:
    """y = H x with small integers: x comes back, twice the same."""
    from relnav.ivisnav.raw import raw_to_result

    first, second = run_rate_frames([ROWS, ROWS], simulator)
    assert first == second and first.n == 8 and first.weight == 8
    result = raw_to_result(first, "exact", ROWS)
    assert result.v is not None and result.omega is not None and result.cycles is not None
    assert [*result.v, *result.omega] == [1.0, -2.0, 3.0, -4.0, 5.0, -6.0] and result.rss == 0.0
    assert 0 < result.cycles["rates"] < result.cycles["all"]


def test_no_frames_no_simulation() -> None:
    assert run_frames([], "no such simulator") == [] == run_rate_frames([], "no such simulator")


def test_a_wrong_feed_is_refused() -> None:
    with pytest.raises(BackendError, match="fed by stream or registers, not 'hand'"):
        run_frames([FRAME], "icarus", feed="hand")


@pytest.mark.parametrize("name", ["verilator", "icarus"])
def test_missing_simulator(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("sim.runner.missing", lambda simulator: f"{simulator} is not installed here")
    with pytest.raises(BackendError, match=f"^{name} is not installed here$"):
        run_frames([FRAME], name)


def test_waveform(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Asked for by argument or by RELNAV_WAVES; the states are in it by name."""
    import pywellen

    file = tmp_path / "waves" / "oltae_top.fst"
    run_frames([FRAME], "icarus", waves=file)
    names = {variable.full_name for variable in pywellen.Waveform(str(file)).all_vars()}
    for name in (
        "core.states.state_name",
        "loader.state_name",
        "s_axis_tdata",
        "registers.s_axil_araddr",
        "q_ready",
    ):
        assert any(found.startswith(f"core_harness.top.{name}") for found in names), name
    file.unlink()
    monkeypatch.setenv("RELNAV_WAVES", str(file))
    run_frames([FRAME], "icarus")
    assert file.is_file()
