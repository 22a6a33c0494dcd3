# SPDX-License-Identifier: Apache-2.0
"""The command line as a user meets it: output, exit codes, one line on stderr."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import relnav
from relnav import cli, golden
from relnav.attitude import cayley
from relnav.errors import BackendError, InputError

KEYS = {"frame", "n", "q", "quaternion", "R", "t", "q_cov", "t_cov", "rss", "turn", "flags", "cycles"}
ROOT = Path(__file__).resolve().parents[2]


def run(*arguments: object, check: int = 0) -> subprocess.CompletedProcess[str]:
    done = subprocess.run(
        [sys.executable, "-m", "relnav.cli", *map(str, arguments)],
        cwd=ROOT / "sw",
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
    )
    assert done.returncode == check, done.stderr
    return done


def strict(text: str) -> dict[str, list[dict[str, object]]]:
    """JSON proper: no NaN, no Infinity."""
    value: dict[str, list[dict[str, object]]] = json.loads(
        text, parse_constant=lambda word: pytest.fail(word)
    )
    return value


@pytest.fixture
def three_frames(tmp_path: Path) -> Path:
    """Frame 0 well, frame 1 of two points, frame 2 turned by 180 degrees about z."""
    rng = np.random.default_rng(1)
    a = rng.normal(size=(10, 3))
    b = a @ cayley(np.array([0.1, 0.2, 0.3])).T + [1.0, 2.0, 3.0]
    rows = [(0, *p, *q) for p, q in zip(a, b, strict=True)]
    rows += [(1, 0, 0, 0, 0, 0, 0), (1, 1, 0, 0, 1, 0, 0)]
    rows += [(2, x, y, z, -x, -y, z) for x, y, z in ((1, 2, 3), (-4, 0, 2), (5, -1, 1), (0, 3, -7))]
    path = tmp_path / "three.csv"
    lines = [",".join(map(repr, map(float, row))) for row in rows]
    path.write_text("frame,ax,ay,az,bx,by,bz\n" + "\n".join(lines) + "\n")
    return path


def test_json(three_frames: Path) -> None:
    done = run("pose", three_frames, "--backend", "double", "--json", check=3)
    assert done.stderr == ""
    value = strict(done.stdout)
    assert set(value) == {"frames"}
    good, few, half = value["frames"]
    assert all(set(frame) == KEYS for frame in value["frames"])
    assert (good["frame"], good["n"], good["turn"], good["flags"], good["cycles"]) == (
        0,
        10,
        "none",
        [],
        None,
    )
    np.testing.assert_allclose(np.array(good["q"]), [0.1, 0.2, 0.3], atol=1e-12)
    np.testing.assert_allclose(np.array(good["t"]), [1.0, 2.0, 3.0], atol=1e-12)
    assert few["flags"] == ["FEW_POINTS"] and few["n"] == 2
    assert all(few[key] is None for key in KEYS - {"frame", "n", "flags"})
    assert half["q"] is None and half["turn"] == "z" and half["flags"] == ["Q_SATURATED"]
    np.testing.assert_allclose(np.array(half["quaternion"]), [0, 0, 0, 1], atol=1e-15)


def test_table(three_frames: Path) -> None:
    lines = run("pose", three_frames, "--backend", "double", check=3).stdout.splitlines()
    assert len(lines) == 5 and lines[0].split()[:3] == ["frame", "n", "turn"]
    assert lines[2].endswith(" ok") and lines[3].endswith(" FEW_POINTS") and lines[4].endswith(" Q_SATURATED")
    assert "+0.1000000 +0.2000000 +0.3000000" in lines[2] and "180.0000" in lines[4]


def test_sigmas_scale_the_covariance(three_frames: Path) -> None:
    def t_cov(*options: object) -> np.ndarray:
        value = strict(run("pose", three_frames, "--backend", "double", "--json", *options, check=3).stdout)
        return np.array(value["frames"][0]["t_cov"])

    one = t_cov("--sigma-a", 3)
    np.testing.assert_allclose(t_cov("--sigma-b", 4, "--sigma-a", "3.0"), one * 25 / 9, rtol=1e-12)
    assert t_cov()[0, 0] < 1e-20  # from the residuals, of which there are none


def test_options_reach_the_backend(tmp_path: Path) -> None:
    rng = np.random.default_rng(2)
    a = rng.normal(size=(20, 3))
    b = a @ cayley(np.array([0.0, 0.0, 2.0])).T + 0.05 * rng.normal(size=a.shape)
    np.savez(tmp_path / "p.npz", a=a, b=b, w=rng.uniform(1, 2, 20))
    forbidden, reapplied, plain = (
        strict(run("pose", tmp_path / "p.npz", "--backend", "double", "--json", *options).stdout)["frames"][0]
        for options in (["--forbid-turns"], ["--reapply"], [])
    )
    assert (forbidden["turn"], reapplied["turn"], plain["turn"]) == ("none", "z", "z")
    assert isinstance(reapplied["rss"], float) and isinstance(plain["rss"], float)
    assert reapplied["rss"] < plain["rss"]


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ("ax,ay,az,bx,by\n1,2,3,4,5\n", ["missing column bz"]),
        ("ax,ay,az,bx,by,bz\n1,2,3,4,5,6\n1,2,nan,4,5,6\n", ["row 2 (line 3)", "az = nan"]),
        (
            "ax,ay,az,bx,by,bz\n1,2,3,4,5,6\n1,2,3,4,1e30,6\n",
            ["row 2 (line 3)", "by = 1e+30", "binary point"],
        ),
        (
            "ax,ay,az,bx,by,bz,w\n1,2,3,4,5,6,1\n1,2,3,4,5,6,1e-9\n",
            ["row 2 (line 3)", "w = 1e-09", "round to 0"],
        ),
        ("", ["empty file"]),
        (None, ["cannot be read", "No such file"]),
    ],
)
def test_bad_input_is_one_line_and_exit_2(tmp_path: Path, content: str | None, words: list[str]) -> None:
    path = tmp_path / "bad.csv"
    if content is not None:
        path.write_text(content)
    for options in (["--backend", "double"], ["--json"]):
        done = run("pose", path, *options, check=2)
        assert done.stdout == "" and done.stderr.count("\n") == 1
        assert done.stderr.startswith(f"relnav: {path}: ") and all(word in done.stderr for word in words)


@pytest.mark.parametrize(
    "arguments",
    [
        [],
        ["fly"],
        ["pose"],
        ["pose", "x.csv", "--backend", "abacus"],
        ["pose", "x.csv", "--sigma-a", "nan"],
        ["pose", "x.csv", "--sigma-a", "-1"],
        ["pose", "x.csv", "--sigma-a", "one"],
        ["pose", "x.csv", "--sigma-a", "0"],
        ["pose", "three.csv", "--rtl", "nowhere"],
        ["pose", "three.csv", "--rtl", "nowhere", "--backend", "icarus"],
        ["landing", "--rtl", "nowhere", "--backend", "icarus"],
        ["proximity", "--rtl", "nowhere", "--backend", "icarus"],
        ["proximity", "--rtl", ".", "--backend", "fixed"],
        ["landing", "--frames", "0"],
        ["landing", "--images", "drawn"],
    ],
)
def test_bad_arguments_are_one_line_and_exit_2(
    arguments: list[str], three_frames: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    arguments = [str(three_frames) if word == "three.csv" else word for word in arguments]
    try:
        code = cli.main(arguments)
    except SystemExit as stop:
        code = int(str(stop.code))
    out, err = capsys.readouterr()
    assert code == 2 and out == "" and err.count("\n") == 1 and err.startswith("relnav")


def test_version_and_help(capsys: pytest.CaptureFixture[str]) -> None:
    for arguments, expected in ((["--version"], relnav.__version__), (["pose", "--help"], "--sigma-a")):
        with pytest.raises(SystemExit) as stop:
            cli.main(arguments)
        assert stop.value.code == 0 and expected in capsys.readouterr().out


@pytest.mark.parametrize(
    ("header", "said"),
    [
        ("ax,ay,az,bx,by,bz", ""),
        ("ax,ay,az,bx,by,bz,weight", "column 'weight' ignored; known are ax, ay, az, bx, by, bz, w, frame"),
        ("W,ax,ay,az,bx,by,bz,,Frame", "columns 'W', 'Frame' ignored; known are"),
        (
            "ax,ay,az,bx,by,bz," + ",".join(f"c{i}" for i in range(9)),
            "'c0', 'c1', 'c2', 'c3', 'c4' and 4 more",
        ),
    ],
)
def test_columns_that_are_ignored_are_named_in_one_line(header: str, said: str, tmp_path: Path) -> None:
    rows = np.random.default_rng(1).uniform(1, 2, (5, header.count(",") + 1))
    file = tmp_path / "points.csv"
    file.write_text("\n".join([header, *(",".join(map(str, row)) for row in rows)]) + "\n")
    done = run("pose", file, "--backend", "double")
    assert said in done.stderr and done.stderr.count("\n") == (said != "")
    assert done.stderr.startswith("relnav: warning: " if said else "") and "Warning" not in done.stderr


def test_arrays_that_are_ignored_are_named(tmp_path: Path) -> None:
    a = np.random.default_rng(1).normal(size=(5, 3))
    np.savez(tmp_path / "points.npz", a=a, b=a, weights=np.ones(5))
    done = run("pose", tmp_path / "points.npz", "--backend", "double")
    assert "array 'weights' ignored; known are a, b, w, frame\n" in done.stderr


def test_closed_pipe(three_frames: Path) -> None:
    command = f"{sys.executable} -m relnav.cli pose {three_frames} --backend double | true"
    done = subprocess.run(
        ["bash", "-c", command], cwd=ROOT / "sw", capture_output=True, text=True, check=True
    )
    assert done.stderr == ""


def test_landing_is_passed_on(monkeypatch: pytest.MonkeyPatch) -> None:
    calls: list[dict[str, object]] = []

    class Landing:
        @staticmethod
        def run_landing(**options: object) -> int:
            calls.append(options)
            return 1

    monkeypatch.setitem(sys.modules, "relnav.landing", Landing)
    assert cli.main(["landing", "--frames", "3", "--terrain", "t.npz", "--images", "bearing-angle"]) == 1
    assert (
        calls[0]["frames"] == 3
        and calls[0]["images"] == "bearing-angle"
        and calls[0]["terrain"] == Path("t.npz")
    )


def test_from_python() -> None:
    rng = np.random.default_rng(3)
    a = rng.normal(size=(10, 3))
    result = relnav.pose(a.tolist(), a + [0, 0, 1], np.ones(10), backend="double", sigma_a=0.1)
    assert result.t is not None and result.flags == ()
    np.testing.assert_allclose(result.t, [0, 0, 1], atol=1e-14)
    expected = golden.estimate(a, a + [0, 0, 1], np.ones(10), variance=0.1**2)
    assert result.t_cov is not None and expected.t_cov is not None
    np.testing.assert_allclose(result.t_cov, expected.t_cov)
    assert relnav.pose(a[:2], a[:2], backend="double").flags == ("FEW_POINTS",)
    assert relnav.pose(np.zeros((0, 3)), np.zeros((0, 3)), backend="double").flags == ("FEW_POINTS",)
    for arguments in ({"sigma_a": -1.0}, {"sigma_a": float("nan")}, {"sigma_b": 0.0}, {"w": [1.0]}):
        with pytest.raises(InputError):
            relnav.pose(a, a, backend="double", **arguments)
    with pytest.raises(BackendError):
        relnav.pose(a, a, backend="abacus")
