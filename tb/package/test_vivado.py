# SPDX-License-Identifier: Apache-2.0
"""The block design's Tcl in plain tclsh, Vivado's commands replaced by stubs: names, connections, addresses.

What this cannot tell is whether Vivado's own IP takes these properties: its pins are listed here by hand.
"""

from __future__ import annotations

import re
import shutil
import subprocess
from collections import Counter
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
from relnav.buses.axi_dma import AxiDma
from relnav.vlnv import vlnv

from package import ipxact
from package.cores import cores
from sim.sources import ROOT

SCRIPT = ROOT / "vivado/zynq7020.tcl"
CORES = {core.name: core for core in cores()}
pytestmark = pytest.mark.skipif(shutil.which("tclsh") is None, reason="no tclsh (Debian package tcl)")

# cell -> pins: o drives, i is driven, and must be; capitals: interfaces, X: external ones
PINS = {
    "ps": "M_AXI_GP0:O S_AXI_HP0:I DDR:X FIXED_IO:X FCLK_CLK0:o FCLK_RESET0_N:o M_AXI_GP0_ACLK:i "
    "S_AXI_HP0_ACLK:i IRQ_F2P:i",
    "reset": "slowest_sync_clk:i ext_reset_in:i interconnect_aresetn:o peripheral_aresetn:o "
    "peripheral_reset:o",
    "control": "S00_AXI:I M00_AXI:O M01_AXI:O aclk:i aresetn:i",
    "memory": "S00_AXI:I M00_AXI:O aclk:i aresetn:i",
    "dma": "S_AXI_LITE:I M_AXI_MM2S:O M_AXIS_MM2S:O s_axi_lite_aclk:i m_axi_mm2s_aclk:i axi_resetn:i "
    "mm2s_introut:o",
    "interrupts": "In0:i In1:i dout:o",
}
IP = {
    "ps": "xilinx.com:ip:processing_system7:5.5",
    "reset": "xilinx.com:ip:proc_sys_reset:5.0",
    "control": "xilinx.com:ip:smartconnect:1.0",
    "memory": "xilinx.com:ip:smartconnect:1.0",
    "dma": "xilinx.com:ip:axi_dma:7.1",
    "interrupts": "xilinx.com:ip:xlconcat:2.1",
}


def run(
    *arguments: str, progress: str = "100%", slack: str = "0.25", lost: str = ""
) -> tuple[list[list[str]], str]:
    """(commands with their arguments, the error), of the script under the stubs."""
    command = ["tclsh", str(ROOT / "tb/package/vivado_stubs.tcl"), str(SCRIPT), *arguments]
    done = subprocess.run(
        command,
        capture_output=True,
        text=True,
        check=False,
        env={"PROGRESS": progress, "STATS.WNS": slack, "MISSING": lost, "PATH": "/usr/bin:/bin"},
    )
    calls = [line.split("\x1f")[1:] for line in done.stdout.splitlines() if line.startswith("CALL\x1f")]
    assert bool(done.stderr) == bool(done.returncode)
    return calls, done.stderr


@pytest.fixture(params=CORES)
def name(request: pytest.FixtureRequest) -> str:
    return str(request.param)


def pins_of_core(name: str) -> dict[str, str]:
    """The core's, from its component: an interface is a pin of its own where it is of one signal."""
    root = ET.parse(ROOT / ipxact.folder(CORES[name]) / "component.xml").getroot()
    pins = {}
    for interface in root.findall("s:busInterfaces/s:busInterface", {"s": ipxact.SPIRIT}):
        label = interface.findtext("s:name", namespaces={"s": ipxact.SPIRIT}) or ""
        drives = interface.find("s:master", {"s": ipxact.SPIRIT}) is not None
        letter = "o" if drives else "i"
        pins[label] = letter.upper() if label.startswith("s_axi") else letter
    return pins


def test_each_pin_is_connected_once(name: str, tmp_path: Path) -> None:
    calls, error = run(name, str(tmp_path / "project"))
    assert error == ""
    cells = {call[-1]: call[-2] for call in calls if call[0] == "create_bd_cell"}
    assert cells == {**IP, name: vlnv(f"{name}_top")}
    pins = {f"{name}/{pin}": kind for pin, kind in pins_of_core(name).items()}
    for cell, listed in PINS.items():
        pins |= {f"{cell}/{pin}": kind for pin, kind in (entry.split(":") for entry in listed.split())}
    driven: Counter[str] = Counter()
    drivers: Counter[str] = Counter()
    for call in calls:
        if call[0] in ("connect_bd_net", "connect_bd_intf_net"):
            driver, load = call[1:]
            kinds = ("o", "i") if call[0] == "connect_bd_net" else ("O", "I")
            assert (pins[driver], pins[load]) == kinds, call
            driven[load] += 1
            drivers[driver] += 1
        if call[0] == "make_bd_intf_pins_external":
            assert pins[call[-1]] == "X"
            driven[call[-1]] += 1
    assert driven == Counter({pin: 1 for pin, kind in pins.items() if kind in "iIX"})
    assert set(drivers) == {pin for pin, kind in pins.items() if kind in "oO"}
    assert all(count == 1 for pin, count in drivers.items() if pins[pin] == "O")
    interfaces = [call for call in calls if call[0] == "connect_bd_intf_net"]
    assert ["connect_bd_intf_net", "dma/M_AXIS_MM2S", f"{name}/s_axis"] in interfaces


def test_order_and_files(name: str, tmp_path: Path) -> None:
    calls, _ = run(name, str(tmp_path / "project"))
    order = [call[0] for call in calls]
    assert order[0] == "create_project" and calls[0][1:] == [
        f"relnav_{name}",
        str(tmp_path / "project"),
        "-part",
        "xc7z020clg400-1",
    ]
    ((_, _, repository, _),) = (call for call in calls if call[:2] == ["set_property", "ip_repo_paths"])
    assert (Path(repository) / name / "component.xml").is_file()
    places = [
        order.index(step)
        for step in (
            "create_project",
            "update_ip_catalog",
            "create_bd_design",
            "create_bd_cell",
            "connect_bd_intf_net",
            "assign_bd_address",
            "validate_bd_design",
            "save_bd_design",
            "make_wrapper",
            "add_files",
        )
    ]
    assert places == sorted(places) and "launch_runs" not in order


def test_addresses(name: str, tmp_path: Path) -> None:
    """No overlap; the core's segment is named as in the component; the DMA is what the bus takes."""
    calls, _ = run(name, str(tmp_path / "project"))
    found = {}
    for call in calls:
        if call[0] == "assign_bd_address":
            options = dict(zip(call[1:-1:2], call[2:-1:2], strict=True))
            found[call[-1]] = (
                options.get("-offset"),
                options.get("-range"),
                options["-target_address_space"],
            )
    core = f"{name}/s_axil/registers"
    assert found == {
        core: ("0x43C00000", "4K", "ps/Data"),
        "dma/S_AXI_LITE/Reg": ("0x40400000", "64K", "ps/Data"),
        "ps/S_AXI_HP0/HP0_DDR_LOWOCM": (None, None, "dma/Data_MM2S"),
    }
    root = ET.parse(ROOT / ipxact.folder(CORES[name]) / "component.xml").getroot()
    memory = root.find("s:memoryMaps/s:memoryMap", {"s": ipxact.SPIRIT})
    assert memory is not None and [
        memory.findtext(path, namespaces={"s": ipxact.SPIRIT}) for path in ("s:name", "s:addressBlock/s:name")
    ] == ["s_axil", "registers"]
    ((_, _, properties, _),) = (c for c in calls if c[0] == "set_property" and c[-1] == "dma")
    values = dict(re.findall(r"CONFIG\.(\w+) (\S+)", properties))
    default = (AxiDma.__init__.__kwdefaults__ or {})["length_bits"]
    assert int(values["c_sg_length_width"]) == default
    assert values["c_m_axis_mm2s_tdata_width"] == "64" and values["c_include_sg"] == "0"
    assert 1 << default > 65535 * 4 * 8, "the longest frame is one transfer"


def test_with_a_board_and_to_the_bitstream(tmp_path: Path) -> None:
    folder = str(tmp_path / "project")
    calls, error = run("oltae", folder, "tul.com.tw:pynq-z2:part0:1.0", "bitstream")
    assert error == ""
    assert ["set_property", "board_part", "tul.com.tw:pynq-z2:part0:1.0", "project"] in calls
    assert [call[0] for call in calls].count("apply_bd_automation") == 1
    assert "make_bd_intf_pins_external" not in {call[0] for call in calls}
    assert calls[-1][0] == "write_hw_platform" and calls[-1][-1] == f"{folder}/system.xsa"
    assert {file.name for file in Path(folder).glob("relnav.*")} == {"relnav.bit", "relnav.hwh"}


@pytest.mark.parametrize(
    ("found", "message"),
    [
        ({"progress": "40%"}, "the implementation failed"),
        ({"slack": "-0.001"}, "timing is not met: worst negative slack -0.001 ns at 100 MHz"),
        ({"slack": ""}, "timing is not met"),
    ],
)
def test_no_bitstream_is_given_out(found: dict[str, str], message: str, tmp_path: Path) -> None:
    """Of a run that failed, and of one that is too slow."""
    calls, error = run("oltae", str(tmp_path / "project"), "none", "bitstream", **found)
    assert message in error and calls[-1][0] == "get_runs"
    assert not list((tmp_path / "project").glob("relnav.*"))


@pytest.mark.parametrize("lost", ["system_wrapper.bit", "system.hwh"])
def test_a_file_that_the_run_did_not_leave(lost: str, tmp_path: Path) -> None:
    error = run("oltae", str(tmp_path / "project"), "none", "bitstream", lost=lost)[1]
    assert f"{lost} in " in error and "not one" in error


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ([], "usage: "),
        (["other"], "usage: "),
        (["oltae", "x", "none", "bits"], "usage: "),
        (["oltae", "x", "none", "bitstream", "more"], "usage: "),
        (["oltae", str(ROOT / "rtl")], "exists: a project is not written over"),
    ],
)
def test_wrong_arguments(arguments: list[str], message: str) -> None:
    calls, error = run(*arguments)
    assert message in error and not calls


def test_a_command_that_vivado_has_not(tmp_path: Path) -> None:
    """The stubs are all there is: a misspelt command ends the script."""
    shutil.copytree(ROOT / "vivado/ip", tmp_path / "vivado/ip")
    script = tmp_path / "vivado/wrong.tcl"
    script.write_text(SCRIPT.read_text().replace("validate_bd_design", "validate_bd_desing"))
    command = ["tclsh", str(ROOT / "tb/package/vivado_stubs.tcl"), str(script), "oltae", str(tmp_path / "p")]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 1 and 'invalid command name "validate_bd_desing"' in done.stderr


def test_constraints() -> None:
    """One clock, on a port that both cores have, at the frequency of the block design."""
    lines = [line for line in (ROOT / "vivado/clock.xdc").read_text().splitlines() if line[:1] != "#"]
    assert lines == ["create_clock -name clk -period 10.000 [get_ports clk]"]
    assert all("clk" in {port.name for port in core.module.ports} for core in CORES.values())
    assert "set frequency 100\n" in SCRIPT.read_text()
