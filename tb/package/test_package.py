# SPDX-License-Identifier: Apache-2.0
"""What `make package` writes is current, complete and made of the sources alone."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest
import yaml
from relnav.registers import Ivisnav, Oltae
from relnav.vlnv import vlnv

from package.__main__ import main, outputs, stale
from package.cores import Core, cores, included
from package.smoke import AWAIT, BEAT, END, EXPECT, LAST_BEAT, WRITE
from package.verilog import Port, read_module
from sim.runner import missing, verilator_folder
from sim.sources import ROOT, reachable, sources

CORES = {core.name: core for core in cores()}


@pytest.fixture(params=CORES)
def core(request: pytest.FixtureRequest) -> Core:
    return CORES[str(request.param)]


def test_generated_files_are_current() -> None:
    assert stale() == [], "run make package"


def closure(core: Core) -> tuple[set[str], set[str]]:
    """(modules, headers) as paths in the repository, by sim/sources.py and the files' own lines."""
    modules = reachable(core.top, sources())
    headers = {
        name
        for file in modules
        for name in re.findall(r'^`include "(\w+\.vh)"', file.read_text(), re.MULTILINE)
    } | {
        name
        for file in modules
        for name in re.findall(r'^ +`include "(\w+\.vh)"', file.read_text(), re.MULTILINE)
    }
    return {str(file.relative_to(ROOT)) for file in modules}, {f"rtl/include/{name}" for name in headers}


def test_file_lists_are_what_the_simulation_compiles(core: Core) -> None:
    modules, headers = closure(core)
    assert len(modules) > 40 and len(headers) >= 2
    lines = (ROOT / f"rtl/{core.name}.f").read_text().splitlines()
    flat = [line for line in lines if not line.startswith(("//", "+"))]
    assert {f"rtl/{line}" for line in flat} == modules and len(flat) == len(modules)
    assert [line for line in lines if line.startswith("+")] == ["+incdir+include"]
    files = yaml.safe_load((ROOT / f"{core.name}.core").read_text())["filesets"]["rtl"]["files"]
    assert {file for file in files if isinstance(file, str)} == modules
    assert {name for file in files if isinstance(file, dict) for name in file} == headers
    assert set(map(str, (file.relative_to(ROOT) for file in core.headers))) == headers
    both = [set(map(str, (f.relative_to(ROOT) for f in c.modules))) for c in CORES.values()]
    others = {str(file.relative_to(ROOT)) for file in sources()} - both[0] - both[1]
    assert not {name for name in others if "/oltae/" in name or "/ivisnav/" in name}, "in no core"


def test_icarus_takes_the_flat_list(core: Core) -> None:
    if reason := missing("icarus"):
        pytest.skip(reason)
    command = ["iverilog", "-g2005", "-tnull", "-s", core.top, "-c", f"{core.name}.f"]
    done = subprocess.run(command, cwd=ROOT / "rtl", capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout + done.stderr) == (0, "")


def test_verilator_takes_the_flat_list_from_anywhere(core: Core, tmp_path: Path) -> None:
    if reason := missing("verilator"):
        pytest.skip(reason)
    tool, waivers = f"{verilator_folder()}/verilator", ROOT / "sim/verilator_waivers.vlt"
    command = [tool, "--lint-only", "-Wall", "--quiet", str(waivers), "-F", str(ROOT / f"rtl/{core.name}.f")]
    done = subprocess.run(
        [*command, "--top-module", core.top], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stdout + done.stderr) == (0, "")


@pytest.fixture
def copy(tmp_path: Path) -> Path:
    """The part of the checkout that the generator reads."""
    for name in ("rtl", "registers"):
        shutil.copytree(ROOT / name, tmp_path / name)
    return tmp_path


def test_a_change_is_noticed(copy: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A port, a parameter, a register, a module more: every view follows, and --check fails until it does."""
    assert main(["--root", str(copy)]) == 0
    made = outputs(copy)
    assert len(made) == 10 and all((copy / name).read_text() == text for name, text in made.items())
    assert {name: text for name, text in made.items() if (ROOT / name).read_text() != text} == {}
    capsys.readouterr()
    file = copy / "rtl/oltae/fixed_output.v"
    (copy / "rtl/oltae/one_more.v").write_text("module one_more (input wire clk);\nendmodule\n")
    file.write_text(file.read_text() + "// an\nmodule other; one_more one (.clk(1'b0)); endmodule\n")
    assert set(map(str, stale(copy))) == {"rtl/oltae.f", "oltae.core", "vivado/ip/oltae/component.xml"}
    assert main(["--root", str(copy), "--check"]) == 1
    assert "stale: oltae.core" in capsys.readouterr().err
    assert main(["--root", str(copy)]) == 0 and stale(copy) == []
    assert "oltae/one_more.v" in (copy / "rtl/oltae.f").read_text()
    top = copy / "rtl/ivisnav/ivisnav_top.v"
    text = top.read_text().replace(
        "    output wire        irq\n", "    output wire        irq,\n    input wire [3:0] user\n"
    )
    top.write_text(text)
    assert set(map(str, stale(copy))) == {"vivado/ip/ivisnav/component.xml"}
    description = copy / "registers/ivisnav.rdl"
    assert main(["--root", str(copy)]) == 0
    description.write_text(description.read_text().replace("DATA_B @ 0x044", "DATA_B @ 0x04C"))
    assert set(map(str, stale(copy))) == {"vivado/ip/ivisnav/component.xml"}


def test_module_heads(tmp_path: Path) -> None:
    file = tmp_path / "m.v"
    file.write_text(
        "// module x (\nmodule m #(\n    parameter A = 1,  // one\n    parameter integer B = -7\n) (\n"
        "    // clock\n    input  wire clk,\n    output reg  [11:0] d\n);\nendmodule\n"
    )
    found = read_module(file)
    assert found.name == "m" and found.parameters == {"A": 1, "B": -7}
    assert found.ports == (Port("clk", "in", 1), Port("d", "out", 12))
    text = file.read_text()
    for wrong in (
        text.replace("reg  [11:0]", "reg signed"),
        text.replace("= 1", "= X"),
        "module m;\nendmodule\n",
    ):
        file.write_text(wrong)
        with pytest.raises(ValueError, match=r"^m\.v: no "):
            read_module(file)


def test_headers_of_headers(tmp_path: Path) -> None:
    (tmp_path / "a.vh").write_text('`include "b.vh"\n')
    (tmp_path / "b.vh").write_text('// `include "no.vh"\n`include "a.vh"\n')
    (tmp_path / "m.v").write_text('  `include "a.vh"\n')
    assert [file.name for file in included([tmp_path / "m.v"], tmp_path)] == ["a.vh", "b.vh"]


def test_the_smoke_script_asks_for_everything(core: Core) -> None:
    """Two frames, one by each way; every result register is compared after each of them."""
    lines = (ROOT / f"sim/smoke_{core.name}.hex").read_text().splitlines()
    steps = [(int(line[0], 16), int(line[1:4], 16), int(line[4:], 16)) for line in lines]
    registers = Oltae if core.name == "oltae" else Ivisnav
    operations = [operation for operation, _, _ in steps]
    assert operations.count(AWAIT) == 2 and operations.count(LAST_BEAT) == 1 and operations[-1] == END
    assert (
        0
        < operations.count(BEAT)
        < sum((operation, address) == (WRITE, registers.PUSH.ADDRESS) for operation, address, _ in steps)
    )
    waits = [index for index, operation in enumerate(operations) if operation == AWAIT]
    for start, end in ((waits[0], waits[1]), (waits[1], len(steps))):
        read = {address: data for operation, address, data in steps[start:end] if operation == EXPECT}
        assert set(range(0x100, registers.SIZE, 4)) <= read.keys()
        assert len({data for address, data in read.items() if address >= 0x100}) > 20, "numbers, not zeros"
    assert all(line == line.lower() and len(line) == 20 for line in lines)


def test_one_name_for_a_core(core: Core) -> None:
    """FuseSoC, the IP catalogue and PYNQ call it alike."""
    description = yaml.safe_load((ROOT / f"{core.name}.core").read_text())
    vendor, library, name, version = vlnv(core.top).split(":")
    assert description["name"].startswith(f"{vendor}:{library}:{core.name}:{version}.") and name == core.top
