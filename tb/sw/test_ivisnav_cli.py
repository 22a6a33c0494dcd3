# SPDX-License-Identifier: Apache-2.0
"""`relnav rates` as a user meets it: output, exit codes, one line on stderr; and relnav.rates."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import relnav
from relnav import cli
from relnav.errors import BackendError, InputError
from relnav.ivisnav.beacons import alternate_ring
from relnav.ivisnav.quantise import metres_per_second

ROOT = Path(__file__).resolve().parents[2]
KEYS = {"frame", "n", "v", "omega", "cov", "rss", "flags", "cycles", "condition"}
SETTINGS = ("--f0", "20e6", "--dt", "0.01")
FACTOR = metres_per_second(20e6, 0.01)
X = np.array([0.0, 0.0, -0.1, 0.0, 0.0, 0.2])
EXAMPLE = ROOT / "docs" / "examples" / "phases.csv"


def run(capsys: pytest.CaptureFixture[str], *arguments: object, check: int = 0) -> tuple[str, str]:
    try:
        code = cli.main(["rates", *map(str, arguments)])
    except SystemExit as stop:
        code = int(str(stop.code))
    out, err = capsys.readouterr()
    assert code == check, err
    return out, err


def strict(text: str) -> list[dict[str, object]]:
    value = json.loads(text, parse_constant=lambda word: pytest.fail(word))
    assert set(value) == {"frames"}
    frames: list[dict[str, object]] = value["frames"]
    return frames


def rows(count: int, noise: float = 0.0) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Directions, projections, phases of a ring at 2 m."""
    ring = alternate_ring(0.5, count=count)
    y = ring.matrix(2.0) @ X + noise * np.random.default_rng(1).normal(size=count)
    return ring.directions, ring.displacements(2.0), y / FACTOR


def test_json(capsys: pytest.CaptureFixture[str]) -> None:
    for backend in ("double", "fixed"):
        out, err = run(capsys, EXAMPLE, *SETTINGS, "--json", "--backend", backend, check=3)
        good, bad = strict(out)
        assert err == "" and set(good) == set(bad) == KEYS
        assert (good["frame"], good["n"], good["flags"], good["cycles"]) == ("skewed", 8, [], None)
        np.testing.assert_allclose(np.array(good["v"]), X[:3], atol=2e-3)
        np.testing.assert_allclose(np.array(good["omega"]), X[3:], atol=2e-3)
        assert np.array(good["cov"]).shape == (6, 6)
        assert bad["flags"] == ["RANK_DEFICIENT"] and bad["n"] == 6
        assert all(bad[key] is None for key in ("v", "omega", "cov", "rss", "cycles"))


def test_table(capsys: pytest.CaptureFixture[str]) -> None:
    out, _ = run(capsys, EXAMPLE, *SETTINGS, "--backend", "double", check=3)
    lines = out.splitlines()
    assert len(lines) == 4 and lines[0].split()[:4] == ["frame", "n", "v,", "m/s"]
    assert lines[2].endswith(" ok") and lines[3].endswith(" RANK_DEFICIENT") and "-0.10005" in lines[2]


def test_a_command_of_its_own() -> None:
    command = [sys.executable, "-m", "relnav.cli", "rates", str(EXAMPLE), *SETTINGS, "--backend", "double"]
    done = subprocess.run(command, cwd=ROOT / "sw", capture_output=True, text=True, timeout=60, check=False)
    assert done.returncode == 3 and done.stderr == "" and "RANK_DEFICIENT" in done.stdout


def test_sigma_and_degrees_of_freedom(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    r, p, dphi = rows(6)
    np.savez(tmp_path / "six.npz", r=r, p=p, dphi=dphi)

    def covariance(*options: object) -> object:
        out, _ = run(capsys, tmp_path / "six.npz", *SETTINGS, "--json", *options)
        return strict(out)[0]["cov"]

    for backend in ("double", "fixed"):
        assert covariance("--backend", backend) is None
        one, two = (np.array(covariance("--backend", backend, "--sigma", s)) for s in ("1e-6", "2e-6"))
        np.testing.assert_allclose(two, 4 * one, rtol=1e-5)
        expected = np.linalg.inv(alternate_ring(0.5).matrix(2.0)) * FACTOR * 1e-6
        np.testing.assert_allclose(np.diag(one), np.diag(expected @ expected.T), rtol=1e-4)


def test_full_covariance_from_a_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    r, p, dphi = rows(8, 1e-3)
    root = 1e-6 * np.tril(np.random.default_rng(2).normal(size=(8, 8)) + 4 * np.eye(8))
    np.savez(tmp_path / "full.npz", r=r, p=p, dphi=dphi, sigma=root @ root.T)
    found = []
    for backend in ("double", "fixed"):
        out, _ = run(capsys, tmp_path / "full.npz", *SETTINGS, "--json", "--backend", backend)
        found.append(strict(out)[0])
    np.testing.assert_allclose(np.array(found[0]["v"]), np.array(found[1]["v"]), rtol=1e-5, atol=1e-7)
    h = alternate_ring(0.5, count=8).matrix(2.0)
    expected = np.linalg.inv(h.T @ np.linalg.inv(FACTOR**2 * root @ root.T) @ h)
    np.testing.assert_allclose(np.array(found[0]["cov"]), expected, rtol=1e-6, atol=1e-9 * expected.max())
    _, err = run(capsys, tmp_path / "full.npz", *SETTINGS, "--sigma", "1e-6", check=2)
    assert "excludes a sigma" in err and err.count("\n") == 1


@pytest.mark.parametrize(
    ("content", "words"),
    [
        ("rx,ry,rz,px,py,pz\n1,2,3,4,5,6\n", ["missing column dphi"]),
        ("rx,ry,rz,px,py,pz,dphi\n1,2,3,4,5,6,7\n1,2,nan,4,5,6,7\n", ["row 2 (line 3)", "rz = nan"]),
        ("rx,ry,rz,px,py,pz,dphi\n0,0,0,4,5,6,7\n", ["row 1 (line 2)", "direction"]),
        ("rx,ry,rz,px,py,pz,dphi\n1,2,3,4e40,5,6,7\n", ["row 1 (line 2)", "too large"]),
        ("", ["empty file"]),
        (None, ["cannot be read"]),
    ],
)
def test_bad_input_is_one_line_and_exit_2(
    tmp_path: Path, content: str | None, words: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "bad.csv"
    if content is not None:
        path.write_text(content)
    for options in (["--backend", "double"], ["--json"]):
        out, err = run(capsys, path, *SETTINGS, *options, check=2)
        assert out == "" and err.count("\n") == 1
        assert err.startswith(f"relnav: {path}: ") and all(word in err for word in words)


@pytest.mark.parametrize(
    "arguments",
    [
        [],
        [EXAMPLE],
        [EXAMPLE, "--f0", "20e6"],
        [EXAMPLE, "--f0", "0", "--dt", "1"],
        [EXAMPLE, "--f0", "20e6", "--dt", "nan"],
        [EXAMPLE, "--f0", "x", "--dt", "1"],
        [EXAMPLE, *SETTINGS, "--sigma", "0"],
        [EXAMPLE, *SETTINGS, "--sigma", "-1"],
        [EXAMPLE, *SETTINGS, "--backend", "abacus"],
        [EXAMPLE, *SETTINGS, "--rtl", "nowhere"],
        [EXAMPLE, *SETTINGS, "--rtl", "nowhere", "--backend", "icarus"],
    ],
)
def test_bad_arguments_are_one_line_and_exit_2(
    arguments: list[object], capsys: pytest.CaptureFixture[str]
) -> None:
    out, err = run(capsys, *arguments, check=2)
    assert out == "" and err.count("\n") == 1 and err.startswith("relnav")


def test_few_rows_are_a_flag(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "few.csv"
    path.write_text("rx,ry,rz,px,py,pz,dphi\n" + "1,2,3,4,5,6,0.1\n" * 5)
    for backend in ("double", "fixed"):
        out, _ = run(capsys, path, *SETTINGS, "--json", "--backend", backend, check=3)
        assert strict(out)[0]["flags"] == ["FEW_ROWS"] and strict(out)[0]["n"] == 5


def test_from_python() -> None:
    r, p, dphi = rows(8, 1e-4)
    for backend in ("double", "fixed"):
        result = relnav.rates(r.tolist(), p, dphi, 20e6, 0.01, np.ones(8), backend=backend, sigma=1e-6)
        assert result.flags == () and result.v is not None and result.omega is not None
        np.testing.assert_allclose(np.concatenate((result.v, result.omega)), X, atol=2e-3)
        white = relnav.rates(r, p, dphi, f0=20e6, dt=0.01, covariance=1e-12 * np.eye(8), backend=backend)
        assert white.cov is not None and result.cov is not None
        size = np.diag(result.cov).max()
        np.testing.assert_allclose(white.cov, result.cov, rtol=1e-4, atol=1e-6 * size)
    assert relnav.rates(r[:5], p[:5], dphi[:5], 20e6, 0.01, backend="double").flags == ("FEW_ROWS",)
    bad: tuple[dict[str, object], ...] = (
        {"sigma": -1.0},
        {"covariance": np.ones((8, 8))},
        {"covariance": np.eye(8), "w": np.ones(8)},
        {"covariance": np.eye(8), "sigma": 1.0},
        {"w": [1.0]},
        {"f0": -1.0},
        {"dt": float("nan")},
    )
    for arguments in bad:
        with pytest.raises(InputError):
            relnav.rates(r, p, dphi, **{"f0": 20e6, "dt": 0.01, "backend": "double", **arguments})  # type: ignore[arg-type]
    with pytest.raises(BackendError):
        relnav.rates(r, p, dphi, 20e6, 0.01, backend="abacus")


@pytest.mark.parametrize(("redirect", "words"), [(">/dev/full", "could not be written"), (">&-", "closed")])
def test_output_that_cannot_be_written(redirect: str, words: str) -> None:
    command = f"{sys.executable} -m relnav.cli rates {EXAMPLE} --f0 20e6 --dt .01 {redirect}"
    done = subprocess.run(["bash", "-c", command], capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert words in done.stderr and len(done.stderr.splitlines()) == 1


def test_sigma_whose_square_vanishes_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    _, err = run(capsys, EXAMPLE, *SETTINGS, "--sigma", "1e-200", check=2)
    assert "too small" in err
