# SPDX-License-Identifier: Apache-2.0
"""`relnav rtl` in a checkout, and what is said where an installation has no RTL."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from relnav import checkout, cli
from relnav.errors import BackendError, InputError
from relnav.frames import make_frame
from relnav.quantise import quantise

from sim.sources import ROOT, RTL, reachable, sources


def relnav(*arguments: str) -> int:
    return cli.main(["rtl", *arguments])


def test_the_checkout_is_found(capsys: pytest.CaptureFixture[str]) -> None:
    assert checkout.IS_CHECKOUT and (ROOT, RTL) == (checkout.ROOT, checkout.RTL)
    assert checkout.build_folder() == ROOT / "build"
    assert relnav() == 0
    assert capsys.readouterr().out == f"{RTL}\n"


@pytest.mark.parametrize("core", checkout.CORES)
def test_files_of_a_core(core: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert relnav("--list", "--core", core) == 0
    listed = capsys.readouterr().out.splitlines()
    assert set(listed) == set(map(str, reachable(f"{core}_top", sources())))


def test_all_files(capsys: pytest.CaptureFixture[str]) -> None:
    assert relnav("--list") == 0
    listed = capsys.readouterr().out.splitlines()
    assert set(listed) == {*map(str, sources()), *map(str, RTL.glob("include/*.vh"))}


def test_a_copy(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """To a folder that is not there, or empty; over nothing."""
    count = sum(path.is_file() for path in RTL.rglob("*"))
    (tmp_path / "empty").mkdir()
    for name in ("new/deep", "empty"):
        assert relnav("--copy", str(tmp_path / name)) == 0
        assert capsys.readouterr().out == f"{count} files in {tmp_path / name}\n"
        assert (tmp_path / name / "oltae/oltae_top.v").read_bytes() == (
            RTL / "oltae/oltae_top.v"
        ).read_bytes()
    assert relnav("--copy", str(tmp_path / "empty")) == 2
    assert "is not an empty folder" in capsys.readouterr().err
    (tmp_path / "file").write_text("mine")
    for target in ("file", "file/below"):
        assert relnav("--copy", str(tmp_path / target)) == 2
        error = capsys.readouterr().err
        assert error.startswith(f"relnav: {tmp_path / target}: ") and error.count("\n") == 1
    assert (tmp_path / "file").read_text() == "mine"


def test_what_does_not_go_together(capsys: pytest.CaptureFixture[str]) -> None:
    assert relnav("--core", "oltae") == 2
    assert capsys.readouterr().err == "relnav: --core goes with --list\n"
    for wrong in (["--list", "--copy", "x"], ["--list", "--core", "other"]):
        with pytest.raises(SystemExit) as ended:
            relnav(*wrong)
        assert ended.value.code == 2


def test_an_installation_without_rtl(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    from relnav import rtlsim

    monkeypatch.setattr(checkout, "RTL", tmp_path / "rtl")
    for call in (checkout.rtl_files, lambda: checkout.copy_rtl(tmp_path / "copy")):
        with pytest.raises(BackendError, match=r"has no RTL: \S+/rtl is missing"):
            call()
    monkeypatch.setattr(rtlsim, "ROOT", tmp_path)
    with pytest.raises(BackendError, match="has no RTL to simulate"):
        rtlsim.run_frames([quantise(make_frame([[0.0] * 3] * 3, [[0.0] * 3] * 3))], "icarus")


def test_where_a_wheel_builds(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(checkout, "IS_CHECKOUT", False)
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    assert checkout.build_folder() == tmp_path / "relnav"
    monkeypatch.delenv("XDG_CACHE_HOME")
    assert checkout.build_folder() == Path.home() / ".cache" / "relnav"


def test_an_rtl_folder_that_cannot_be_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(checkout, "RTL", tmp_path)
    monkeypatch.setattr(
        "shutil.copytree", lambda *a, **k: (_ for _ in ()).throw(PermissionError(13, "denied"))
    )
    with pytest.raises(InputError, match="cannot be copied: denied"):
        checkout.copy_rtl(tmp_path / "copy")


def test_a_full_disk(tmp_path: Path) -> None:
    """One line about the first file, not one about each: every file of more than 1 KiB is refused."""
    target = tmp_path / "copy"
    program = (
        "import resource, sys; resource.setrlimit(resource.RLIMIT_FSIZE, (1024, 1024)); "
        "from relnav.cli import main; sys.exit(main(['rtl', '--copy', sys.argv[1]]))"
    )
    done = subprocess.run(
        [sys.executable, "-c", program, str(target)], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith(f"relnav: {target}: the RTL cannot be copied: ")
    assert done.stderr.count("File too large") == 1 and done.stderr.count("\n") == 1
