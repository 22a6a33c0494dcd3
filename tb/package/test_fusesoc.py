# SPDX-License-Identifier: Apache-2.0
"""The FuseSoC core files, run by FuseSoC: simulation and lint, which can fail, and what synthesis gets."""

from __future__ import annotations

import importlib.util
import os
import shutil
import subprocess
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest
import yaml

from package.cores import cores
from sim.runner import missing, verilator_folder
from sim.sources import ROOT

FUSESOC = Path(sys.executable).with_name("fusesoc")
CORES = {core.name: core for core in cores()}
pytestmark = pytest.mark.skipif(not FUSESOC.is_file(), reason="FuseSoC is not installed (make setup)")


@pytest.fixture
def tree(tmp_path: Path) -> Iterator[Path]:
    """What a core file names, where it may be broken."""
    for name in ("rtl", "vivado"):
        shutil.copytree(ROOT / name, tmp_path / "tree" / name)
    (tmp_path / "tree/sim").mkdir()
    for file in (*ROOT.glob("sim/smoke*"), ROOT / "sim/verilator_waivers.vlt"):
        shutil.copy(file, tmp_path / "tree/sim")
    for name in CORES:
        shutil.copy(ROOT / f"{name}.core", tmp_path / "tree")
    yield tmp_path / "tree"
    shutil.rmtree(tmp_path / "tree")


def run(tree: Path, name: str, target: str, *options: str, parameters: Sequence[str] = ()) -> tuple[int, str]:
    """FuseSoC's exit code and all it said."""
    home = tree.parent / "home"
    home.mkdir(exist_ok=True)
    path = os.pathsep.join(filter(None, [str(verilator_folder() or ""), os.environ["PATH"]]))
    environment = {**os.environ, "PATH": path, "HOME": str(home), "XDG_CACHE_HOME": str(home)}
    environment |= {"XDG_CONFIG_HOME": str(home), "XDG_DATA_HOME": str(home)}
    command = [str(FUSESOC), "--cores-root", str(tree), "run", f"--target={target}"]
    work = ["--work-root", str(tree.parent / "work")]
    done = subprocess.run(
        [*command, *work, *options, f"relnav:cores:{name}", *parameters],
        cwd=home,
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    return done.returncode, done.stdout + done.stderr


def edit(file: Path, old: str, new: str) -> None:
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new, 1))


@pytest.mark.parametrize("name", CORES)
def test_simulation(name: str, tree: Path) -> None:
    """Two frames are the model's; with a spoiled result they are not, and it says where."""
    if reason := missing("icarus"):
        pytest.skip(reason)
    code, said = run(tree, name, "sim")
    assert code == 0 and "PASS: " in said and "FAIL" not in said, said
    edit(tree / "rtl/axi/result_store.v", "memory[address] <= ", "memory[address] <= ~")
    said = run(tree, name, "sim")[1]
    assert "PASS" not in said and "address 100: wrong word, wanted" in said, said


def test_a_core_that_does_nothing(tree: Path) -> None:
    """The bench ends, with FAIL, also where no frame is ever solved."""
    if reason := missing("icarus"):
        pytest.skip(reason)
    edit(tree / "rtl/axi/frame_loader.v", "frame_start = clear", "frame_start = 1'b0")
    said = run(tree, "oltae", "sim")[1]
    assert "FAIL" in said and "no result" in said and "PASS" not in said, said
    (tree / "sim/smoke_oltae.hex").write_text("")
    said = run(tree, "oltae", "sim")[1]
    assert "no step in the script" in said and "PASS" not in said, said


@pytest.mark.parametrize("name", CORES)
def test_lint(name: str, tree: Path) -> None:
    """Clean with all warnings on; a signal that nobody uses is a warning, and a warning is a failure."""
    if reason := missing("verilator"):
        pytest.skip(reason)
    code, said = run(tree, name, "lint")
    assert code == 0 and "%Warning" not in said, said
    edit(tree / f"rtl/{name}/{name}_top.v", "endmodule", "wire nobody_reads;\nendmodule")
    code, said = run(tree, name, "lint")
    assert code != 0 and "nobody_reads" in said, said


def test_lint_of_the_lean_build(tree: Path) -> None:
    if reason := missing("verilator"):
        pytest.skip(reason)
    names = list(CORES["oltae"].module.parameters)
    code, said = run(tree, "oltae", "lint", parameters=[f"--{name}=0" for name in names])
    assert code == 0 and "%Warning" not in said, said
    (options,) = (tree.parent / "work").glob("*.vc")
    lines = options.read_text().splitlines()
    assert set(lines) >= {f"-G{name}=0" for name in names} | {"-Wall", "--lint-only"} and len(names) >= 3


@pytest.mark.parametrize("name", CORES)
def test_synthesis_is_set_up(name: str, tree: Path) -> None:
    """No Vivado here: the project that FuseSoC writes for it names every file, the part and the top."""
    code, said = run(tree, name, "synth", "--setup")
    assert code == 0, said
    (description,) = (tree.parent / "work").glob("*.eda.yml")
    found = yaml.safe_load(description.read_text())
    assert found["toplevel"] == f"{name}_top" and found["flow_options"]["part"] == "xc7z020clg400-1"
    names = {file["name"].partition("0.1.0/")[2] for file in found["files"]}
    core = CORES[name]
    wanted = {str(file.relative_to(ROOT)) for file in (*core.modules, *core.headers)}
    assert names == wanted | {"vivado/clock.xdc"}


@pytest.mark.parametrize("name", CORES)
def test_synthesis_needs_nothing_else(name: str, tree: Path) -> None:
    """A whole design with the options as parameters, says Yosys; not with a file less."""
    if importlib.util.find_spec("pyosys") is None:
        pytest.skip("Yosys is not installed (pyosys: make setup)")
    values = dict.fromkeys(CORES[name].module.parameters, 0)
    code, said = run(tree, name, "synth", "--setup", parameters=[f"--{option}=0" for option in values])
    assert code == 0, said
    work = tree.parent / "work"
    (description,) = work.glob("*.eda.yml")
    found = yaml.safe_load(description.read_text())
    assert {parameter: value["default"] for parameter, value in found["parameters"].items()} == values
    verilog = [file for file in found["files"] if file["file_type"].startswith("verilogSource")]
    folders = {str(Path(file["name"]).parent) for file in verilog if file.get("is_include_file")}
    files = [file["name"] for file in verilog if not file.get("is_include_file")]
    chparam = "".join(f" -set {option} {value}" for option, value in values.items())

    def elaborate(names: Sequence[str]) -> subprocess.CompletedProcess[str]:
        lines = [
            f"read_verilog -defer {' '.join(f'-I{folder}' for folder in folders)} {file}" for file in names
        ]
        lines += [f"chparam{chparam} {found['toplevel']}", f"hierarchy -check -top {found['toplevel']}"]
        (work / "elaborate.ys").write_text("\n".join(lines) + "\n")
        code = "from pyosys import libyosys as y; y.run_pass('script elaborate.ys', y.Design())"
        return subprocess.run(
            [sys.executable, "-c", code], cwd=work, capture_output=True, text=True, check=False
        )

    done = elaborate(files)
    assert done.returncode == 0, done.stdout + done.stderr
    without = [
        file for file in files if not file.endswith("rtl/gram/sign_run.v" if name == "oltae" else "top_bit.v")
    ]
    done = elaborate(without)
    assert (
        len(without) == len(files) - 1
        and done.returncode != 0
        and "not part of the design" in done.stdout + done.stderr
    )
