# SPDX-License-Identifier: Apache-2.0
"""The wheel alone, in a folder far from the checkout: it has the RTL and simulates it."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
import zipfile
from collections.abc import Iterator
from pathlib import Path

import pytest

from sim.runner import missing
from sim.sources import ROOT

CSV = "ax,ay,az,bx,by,bz\n1,0,0,0,1,5\n0,2,0,-2,0,5\n0,0,3,0,0,8\n1,1,1,-1,1,6\n"


@pytest.fixture(scope="module")
def installed(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """A folder with the wheel's content, installed by pip from a copy of the checkout's sources."""
    if not any((Path(folder) / "setuptools").is_dir() for folder in sys.path):
        pytest.skip("setuptools, which builds the wheel, is not installed")
    folder = tmp_path_factory.mktemp("wheel")
    source = folder / "source"
    for name in ("rtl", "sim", "syn"):
        shutil.copytree(ROOT / name, source / name, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copytree(
        ROOT / "sw/relnav", source / "sw/relnav", ignore=shutil.ignore_patterns("__pycache__", ".mypy_cache")
    )
    for name in (
        "pyproject.toml",
        "setup.py",
        "MANIFEST.in",
        "README.md",
        "LICENSE",
        "CHANGELOG.md",
        "constraints.txt",
    ):
        shutil.copy(ROOT / name, source / name)
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "-q"]
    environment = {**os.environ, "PIP_NO_INDEX": "1"}
    for command in (
        [*pip, "wheel", "--no-deps", "--no-build-isolation", "-w", str(folder / "dist"), str(source)],
        [
            *pip,
            "install",
            "--no-deps",
            "--target",
            str(folder / "site"),
            "relnav",
            "-f",
            str(folder / "dist"),
        ],
    ):
        done = subprocess.run(
            command, capture_output=True, text=True, check=False, cwd=folder, env=environment
        )
        assert done.returncode == 0, done.stderr
    shutil.rmtree(source)
    yield folder
    shutil.rmtree(folder)


def relnav(installed: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """The wheel's command, in a process that knows nothing of the checkout."""
    work = installed / "work"
    work.mkdir(exist_ok=True)
    (work / "points.csv").write_text(CSV)
    environment = {name: value for name, value in os.environ.items() if not name.startswith("RELNAV_")}
    environment |= {"PYTHONPATH": str(installed / "site"), "XDG_CACHE_HOME": str(installed / "cache")}
    return subprocess.run(
        [sys.executable, "-m", "relnav.cli", *arguments],
        cwd=work,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )


def tree(folder: Path) -> dict[str, bytes]:
    return {
        path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()
    }


def test_what_the_wheel_holds(installed: Path) -> None:
    """All of rtl/ and what simulates it, no more of the checkout, nothing compiled and no link."""
    (wheel,) = (installed / "dist").glob("relnav-*-py3-none-any.whl")
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
        assert not [entry for entry in archive.infolist() if entry.external_attr >> 28 == 0xA]
    packaged = {
        name.removeprefix("relnav/packaged/") for name in names if name.startswith("relnav/packaged/")
    }
    simulation = {
        "sim/__init__.py",
        "sim/runner.py",
        "sim/sources.py",
        "sim/core_harness.v",
        "syn/results.json",
    }
    assert packaged == {f"rtl/{name}" for name in tree(ROOT / "rtl")} | simulation
    assert {
        "relnav/cli.py",
        "relnav/buses/memory_map.py",
        "relnav/py.typed",
        "relnav/report/page.html.j2",
    } <= set(names)
    assert {name.partition("/")[0].partition("-")[0] for name in names} == {"relnav"}
    assert any(name.endswith("licenses/LICENSE") for name in names)


def test_the_rtl_is_copied(installed: Path) -> None:
    done = relnav(installed, "rtl")
    assert done.stdout.strip() == str(installed / "site/relnav/packaged/rtl"), done.stderr
    target = installed / "mine"
    done = relnav(installed, "rtl", "--copy", str(target))
    ours = tree(ROOT / "rtl")
    assert (done.returncode, done.stdout, done.stderr) == (0, f"{len(ours)} files in {target}\n", "")
    assert tree(target) == ours
    done = relnav(installed, "rtl", "--copy", str(target))
    assert (done.returncode, done.stdout) == (2, "") and "is not an empty folder" in done.stderr


@pytest.mark.parametrize("copied", [False, True], ids=["packaged", "copied"])
def test_a_frame_is_simulated(installed: Path, simulator: str, copied: bool) -> None:
    """By the RTL inside the package and by a copy of it; builds go to the user's cache."""
    if copied and simulator == "verilator":
        pytest.skip("one simulator is enough for another folder")
    mine = installed / f"mine-{simulator}"
    where = ["--rtl", str(mine)] if copied else []
    if copied:
        assert relnav(installed, "rtl", "--copy", str(mine)).returncode == 0
    done = relnav(installed, "pose", "points.csv", "--json", "--backend", simulator, *where)
    assert (done.returncode, done.stderr) == (0, "")
    (frame,) = json.loads(done.stdout)["frames"]
    assert frame["flags"] == [] and frame["cycles"]["all"] > frame["cycles"]["pose"] > 0
    model = json.loads(relnav(installed, "pose", "points.csv", "--json").stdout)["frames"][0]
    assert {**frame, "cycles": None} == model
    assert (installed / "cache/relnav" / simulator).is_dir()
    assert not list((installed / "site/relnav/packaged").rglob("*.vvp")), (
        "nothing is built beside the package"
    )


def test_rates_are_simulated(installed: Path) -> None:
    if reason := missing("icarus"):
        pytest.skip(reason)
    file = str(ROOT / "docs/examples/phases.csv")
    done = relnav(installed, "rates", file, "--f0", "20e6", "--dt", "0.01", "--backend", "icarus", "--json")
    first = json.loads(done.stdout)["frames"][0]
    assert first["flags"] == [] and first["cycles"]["rates"] > 0, done.stderr
