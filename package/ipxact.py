# SPDX-License-Identifier: Apache-2.0
"""IP-XACT for the Vivado IP catalogue: vivado/ip/<core>/component.xml, and the parameters' page beside it.

IEEE 1685-2009 (`spirit`), which is the edition that Vivado reads. Bus definitions, view names, the page in
Tcl and what is under vendorExtensions are Vivado's; there was no Vivado at hand to try them on.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from pathlib import Path
from xml.etree import ElementTree as ET

from relnav import regtool
from relnav.vlnv import vlnv

from .cores import Core
from .filelist import NOTICE
from .verilog import Port

SPIRIT = "http://www.spiritconsortium.org/XMLSchema/SPIRIT/1685-2009"
XILINX = "http://www.xilinx.com"
XSI = "http://www.w3.org/2001/XMLSchema-instance"
BYTES = 1 << regtool.ADDRESS_BITS
FAMILIES = ("zynq", "artix7", "kintex7", "virtex7", "spartan7")
ACCESS = {"ro": "read-only", "rw": "read-write", "wo": "write-only", "w1c": "read-write"}
CONSTRAINTS = "vivado/clock.xdc"


def folder(core: Core) -> Path:
    """Where the component lies, relative to the repository."""
    return Path("vivado/ip") / core.name


def gui_file(core: Core) -> str:
    """The parameters' page, relative to the component."""
    return f"xgui/{core.top}_v{vlnv(core.top).rpartition(':')[2].replace('.', '_')}.tcl"


# ------------------------------------------------------------------------------------------------- XML


def _add(parent: ET.Element, tag: str, content: object = None, /, **attributes: object) -> ET.Element:
    element = ET.SubElement(
        parent, f"{{{SPIRIT}}}{tag}", {f"{{{SPIRIT}}}{key}": str(v) for key, v in attributes.items()}
    )
    element.text = None if content is None else str(content)
    return element


def _name(parent: ET.Element, name: str, title: str = "", text: str = "") -> None:
    _add(parent, "name", name)
    if title:
        _add(parent, "displayName", title)
    if text:
        _add(parent, "description", text)


def _reference(parent: ET.Element, kind: str, bus: str) -> None:
    vendor, library, name, version = bus.split(":")
    _add(parent, kind, vendor=vendor, library=library, name=name, version=version)


def _parameters(parent: ET.Element, values: Iterable[tuple[str, object]], prefix: str) -> None:
    parameters = _add(parent, "parameters")
    for name, value in values:
        parameter = _add(parameters, "parameter")
        _add(parameter, "name", name)
        _add(parameter, "value", value, id=f"{prefix}.{name}")


def component(core: Core) -> str:
    """The component's XML."""
    for prefix, uri in (("spirit", SPIRIT), ("xilinx", XILINX), ("xsi", XSI)):
        ET.register_namespace(prefix, uri)
    root = ET.Element(f"{{{SPIRIT}}}component")
    vendor, library, name, version = vlnv(core.top).split(":")
    for tag, text in (("vendor", vendor), ("library", library), ("name", name), ("version", version)):
        _add(root, tag, text)
    _bus_interfaces(root, core.module.ports)
    _memory_map(root, core.registers)
    _model(root, core)
    if core.module.parameters:
        choice = _add(_add(root, "choices"), "choice")
        _add(choice, "name", "built")
        _add(choice, "enumeration", 1, text="built")
        _add(choice, "enumeration", 0, text="left out")
    _file_sets(root, core)
    _add(root, "description", core.title)
    parameters = _add(root, "parameters")
    for parameter, value in core.module.parameters.items():
        entry = _add(parameters, "parameter")
        _name(entry, parameter, parameter)
        _add(
            entry,
            "value",
            value,
            format="long",
            resolve="user",
            id=f"PARAM_VALUE.{parameter}",
            choiceRef="built",
        )
    entry = _add(parameters, "parameter")
    _name(entry, "Component_Name")
    _add(
        entry,
        "value",
        f"{core.top}_v{version.replace('.', '_')}",
        resolve="user",
        id="PARAM_VALUE.Component_Name",
    )
    _vendor_extensions(root, core)
    ET.indent(root)
    head = [
        "<?xml version='1.0' encoding='UTF-8'?>",
        "<!-- SPDX-License-Identifier: Apache-2.0 -->",
        f"<!-- {NOTICE} -->",
    ]
    return "\n".join([*head, ET.tostring(root, encoding="unicode"), ""])


# ------------------------------------------------------------------------------------------------- interfaces


def _bus_interface(
    root: ET.Element,
    name: str,
    bus: str,
    mode: str,
    ports: Sequence[tuple[str, str]],
    parameters: Sequence[tuple[str, object]],
) -> ET.Element:
    """Returns the element of the mode. ports: (logical, physical)."""
    interface = _add(root, "busInterface")
    _add(interface, "name", name)
    _reference(interface, "busType", bus)
    head, _, version = bus.rpartition(":")
    _reference(interface, "abstractionType", f"{head}_rtl:{version}")
    end = _add(interface, mode)
    maps = _add(interface, "portMaps")
    for logical, physical in ports:
        entry = _add(maps, "portMap")
        _add(_add(entry, "logicalPort"), "name", logical)
        _add(_add(entry, "physicalPort"), "name", physical)
    _parameters(interface, parameters, f"BUSIFPARAM_VALUE.{name.upper()}")
    return end


def _bus_interfaces(root: ET.Element, ports: Sequence[Port]) -> None:
    interfaces = _add(root, "busInterfaces")
    names = [port.name for port in ports]
    of_prefix = {
        prefix: [(n.removeprefix(f"{prefix}_").upper(), n) for n in names if n.startswith(f"{prefix}_")]
        for prefix in ("s_axil", "s_axis")
    }
    axi = "xilinx.com:interface:{}:1.0"
    signal = "xilinx.com:signal:{}:1.0"
    end = _bus_interface(
        interfaces,
        "s_axil",
        axi.format("aximm"),
        "slave",
        of_prefix["s_axil"],
        [("PROTOCOL", "AXI4LITE"), ("DATA_WIDTH", 32), ("ADDR_WIDTH", regtool.ADDRESS_BITS)],
    )
    _add(end, "memoryMapRef", memoryMapRef="s_axil")
    (width,) = (port.width for port in ports if port.name == "s_axis_tdata")
    flags = [(f"HAS_{n}", int(n in dict(of_prefix["s_axis"]))) for n in ("TREADY", "TLAST", "TKEEP", "TSTRB")]
    _bus_interface(
        interfaces,
        "s_axis",
        axi.format("axis"),
        "slave",
        of_prefix["s_axis"],
        [("TDATA_NUM_BYTES", width // 8), *flags],
    )
    _bus_interface(
        interfaces,
        "clk",
        signal.format("clock"),
        "slave",
        [("CLK", "clk")],
        [("ASSOCIATED_BUSIF", "s_axil:s_axis"), ("ASSOCIATED_RESET", "rst")],
    )
    _bus_interface(
        interfaces, "rst", signal.format("reset"), "slave", [("RST", "rst")], [("POLARITY", "ACTIVE_HIGH")]
    )
    _bus_interface(
        interfaces,
        "irq",
        signal.format("interrupt"),
        "master",
        [("INTERRUPT", "irq")],
        [("SENSITIVITY", "LEVEL_HIGH")],
    )


# ------------------------------------------------------------------------------------------------- registers


def _memory_map(root: ET.Element, view: regtool.CoreView) -> None:
    memory = _add(_add(root, "memoryMaps"), "memoryMap")
    _add(memory, "name", "s_axil")
    block = _add(memory, "addressBlock")
    _name(block, "registers", view.title, view.text)
    _add(block, "baseAddress", 0)
    _add(block, "range", BYTES)
    _add(block, "width", 32)
    _add(block, "usage", "register")
    for register in view.registers:
        _register(block, register)
    _add(memory, "addressUnitBits", 8)


def _register(block: ET.Element, register: regtool.RegisterView) -> None:
    element = _add(block, "register")
    _name(element, register.name, register.title, register.text)
    if register.count > 1:
        _add(element, "dim", register.count)
    _add(element, "addressOffset", f"0x{register.address:03X}")
    _add(element, "size", 32)
    _add(element, "volatile", str(register.volatile).lower())
    _add(element, "access", ACCESS[register.access])
    if register.reset is not None:
        reset = _add(element, "reset")
        _add(reset, "value", f"0x{register.reset:08X}")
        _add(reset, "mask", f"0x{sum(((1 << f.width) - 1) << f.low for f in register.fields):08X}")
    for field in register.fields:
        entry = _add(element, "field")
        _name(entry, field.name, text=field.text)
        _add(entry, "bitOffset", field.low)
        _add(entry, "bitWidth", field.width)
        _add(entry, "access", ACCESS[register.access])
        if field.choices:
            values = _add(entry, "enumeratedValues")
            for choice in field.choices:
                value = _add(values, "enumeratedValue")
                _name(value, choice.name, text=choice.text)
                _add(value, "value", choice.value)
        if register.access == "w1c":
            _add(entry, "modifiedWriteValue", "oneToClear")


# ------------------------------------------------------------------------------------------------- the rest


def _model(root: ET.Element, core: Core) -> None:
    model = _add(root, "model")
    views = _add(model, "views")
    for name, title, environment, files in (
        ("xilinx_anylanguagesynthesis", "Synthesis", ":vivado.xilinx.com:synthesis", "synthesis"),
        (
            "xilinx_anylanguagebehavioralsimulation",
            "Simulation",
            ":vivado.xilinx.com:simulation",
            "simulation",
        ),
        ("xilinx_xpgui", "Parameters", ":vivado.xilinx.com:xgui.ui", "parameters"),
    ):
        view = _add(views, "view")
        _name(view, name, title)
        _add(view, "envIdentifier", environment)
        if files != "parameters":
            _add(view, "language", "Verilog")
            _add(view, "modelName", core.top)
        _add(_add(view, "fileSetRef"), "localName", files)
    ports = _add(model, "ports")
    for port in core.module.ports:
        entry = _add(ports, "port")
        _add(entry, "name", port.name)
        wire = _add(entry, "wire")
        _add(wire, "direction", port.direction)
        if port.width > 1:
            vector = _add(wire, "vector")
            _add(vector, "left", port.width - 1, format="long")
            _add(vector, "right", 0, format="long")
        definition = _add(_add(wire, "wireTypeDefs"), "wireTypeDef")
        _add(definition, "typeName", "std_logic_vector" if port.width > 1 else "std_logic")
        for files in ("xilinx_anylanguagesynthesis", "xilinx_anylanguagebehavioralsimulation"):
            _add(definition, "viewNameRef", files)
        if port.direction == "in":
            _add(_add(wire, "driver"), "defaultValue", 0, format="long")
    if core.module.parameters:
        parameters = _add(model, "modelParameters")
        for name, value in core.module.parameters.items():
            entry = _add(parameters, "modelParameter", dataType="integer")
            _name(entry, name, name)
            _add(entry, "value", value, format="long", resolve="generated", id=f"MODELPARAM_VALUE.{name}")


def _file_sets(root: ET.Element, core: Core) -> None:
    place = core.root / folder(core)
    sets = _add(root, "fileSets")
    for name in ("synthesis", "simulation"):
        files = _add(sets, "fileSet")
        _add(files, "name", name)
        for path in (*core.headers, *core.modules):
            entry = _add(files, "file")
            _add(entry, "name", Path(os.path.relpath(path, place)).as_posix())
            _add(entry, "fileType", "verilogSource")
            if path in core.headers:
                _add(entry, "isIncludeFile", "true")
        if name == "synthesis":
            entry = _add(files, "file")
            _add(entry, "name", Path(os.path.relpath(core.root / CONSTRAINTS, place)).as_posix())
            _add(entry, "userFileType", "xdc")
            for use in ("USED_IN_synthesis", "USED_IN_out_of_context"):
                _add(entry, "userFileType", use)
    files = _add(sets, "fileSet")
    _add(files, "name", "parameters")
    entry = _add(files, "file")
    _add(entry, "name", gui_file(core))
    _add(entry, "fileType", "tclSource")


def _vendor_extensions(root: ET.Element, core: Core) -> None:
    extensions = ET.SubElement(_add(root, "vendorExtensions"), f"{{{XILINX}}}coreExtensions")
    families = ET.SubElement(extensions, f"{{{XILINX}}}supportedFamilies")
    for family in FAMILIES:
        entry = ET.SubElement(families, f"{{{XILINX}}}family", {f"{{{XILINX}}}lifeCycle": "Beta"})
        entry.text = family
    taxonomies = ET.SubElement(extensions, f"{{{XILINX}}}taxonomies")
    ET.SubElement(taxonomies, f"{{{XILINX}}}taxonomy").text = "/Digital_Signal_Processing"
    ET.SubElement(extensions, f"{{{XILINX}}}displayName").text = core.registers.title.removesuffix(
        " registers"
    )
    ET.SubElement(extensions, f"{{{XILINX}}}coreRevision").text = "1"


def gui(core: Core) -> str:
    """The page of parameters in Vivado, in Tcl: without it, a user's choice would not reach the Verilog."""
    parameters = list(core.module.parameters)
    lines = ["# SPDX-License-Identifier: Apache-2.0", f"# {NOTICE}", "", "proc init_gui { IPINST } {"]
    lines += ['  ipgui::add_param $IPINST -name "Component_Name"']
    if parameters:
        lines += ['  set page [ipgui::add_page $IPINST -name "Parameters"]']
        lines += [
            f'  ipgui::add_param $IPINST -name "{name}" -parent $page -widget comboBox' for name in parameters
        ]
    lines += ["}"]
    for name in parameters:
        user, model = f"PARAM_VALUE.{name}", f"MODELPARAM_VALUE.{name}"
        lines += ["", f"proc update_{user} {{ {user} }} {{}}", ""]
        lines += [f"proc validate_{user} {{ {user} }} {{", "  return true", "}", ""]
        lines += [f"proc update_{model} {{ {model} {user} }} {{"]
        lines += [f"  set_property value [get_property value ${{{user}}}] ${{{model}}}", "}"]
    return "\n".join(lines) + "\n"
