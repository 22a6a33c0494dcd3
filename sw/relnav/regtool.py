# SPDX-License-Identifier: Apache-2.0
"""Writes every view of the registers from the SystemRDL descriptions in registers/.

    python -m relnav.regtool            write them
    python -m relnav.regtool --check    exit 1 when a committed one differs

For each ``registers/<core>.rdl`` (one address map, called like the file):

    rtl/include/<core>_registers.vh     addresses, fields, reset words, is_mapped(); included inside a module
    sw/c/<core>_registers.h             C99: a volatile struct whose read-only members are const
    docs/registers-<core>.md            the register page

and for all of them together

    sw/relnav/registers.py
    rtl/include/common_registers.vh     what is the same in every core, for the RTL that they share

So a further core only adds its file to registers/.

Needs systemrdl-compiler. Our own emitters: peakrdl's C header names a shared register
type by a hash and knows no const, and its register block is SystemVerilog.
"""

from __future__ import annotations

import argparse
import re
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from systemrdl.compiler import RDLCompiler
from systemrdl.messages import MessagePrinter, RDLCompileError
from systemrdl.node import AddrmapNode, FieldNode, RegNode
from systemrdl.rdltypes.builtin_enums import OnWriteType

from relnav import __version__

ROOT = Path(__file__).resolve().parents[2]
ADDRESS_BITS = 12


class DescriptionError(ValueError):
    """A register description that cannot be used; the message names file and cause."""


@dataclass(frozen=True)
class Choice:
    """One named value of a field."""

    name: str
    value: int
    text: str


@dataclass(frozen=True)
class FieldView:
    """One field of a register."""

    name: str
    low: int
    width: int
    text: str
    signed: bool
    kind: str
    """Name of the field's enumeration, empty without one."""
    choices: tuple[Choice, ...]


@dataclass(frozen=True)
class RegisterView:
    """One register, or `count` equal ones in a row."""

    name: str
    title: str
    text: str
    address: int
    count: int
    access: str
    """ro, rw, wo or w1c."""
    reset: int | None
    """Word after reset; None where hardware decides."""
    volatile: bool
    """Whether hardware changes what is read."""
    fields: tuple[FieldView, ...]

    @property
    def addresses(self) -> range:
        """Byte address of every word."""
        return range(self.address, self.address + 4 * self.count, 4)


@dataclass(frozen=True)
class CoreView:
    """One core's address map."""

    name: str
    title: str
    text: str
    registers: tuple[RegisterView, ...]

    @property
    def size(self) -> int:
        """One past the last byte."""
        return self.registers[-1].addresses[-1] + 4

    @property
    def kinds(self) -> dict[str, FieldView]:
        """One field for each enumeration."""
        return {f.kind: f for r in reversed(self.registers) for f in reversed(r.fields) if f.kind}


# ------------------------------------------------------------------------------------------------- reading


class _Raise(MessagePrinter):
    """Keeps the compiler's first complaint instead of printing it."""

    def __init__(self) -> None:
        self.complaint = ""

    def print_message(self, severity: object, text: str, src_ref: object) -> None:
        self.complaint = self.complaint or text


def version_word(version: str = __version__) -> int:
    """0x00MMmmpp of "M.m.p"."""
    match = re.match(r"(\d+)\.(\d+)\.(\d+)", version)
    if not match:
        raise DescriptionError(f"version {version!r} is not of the form M.m.p")
    major, minor, patch = (int(part) for part in match.groups())
    return major << 16 | minor << 8 | patch


def read(file: Path, version: str = __version__) -> CoreView:
    """Compile one SystemRDL file; DescriptionError on anything that the emitters could not express."""
    printer = _Raise()
    compiler = RDLCompiler(message_printer=printer)
    try:
        compiler.compile_file(str(file))
        root = compiler.elaborate(top_def_name=file.stem, parameters={"VERSION_WORD": version_word(version)})
    except RDLCompileError as error:
        raise DescriptionError(f"{file.name}: {printer.complaint or error}") from None
    top = root.top
    registers = tuple(sorted(_registers(top, file), key=lambda register: register.address))
    if not registers or registers[-1].addresses[-1] >= 1 << ADDRESS_BITS:
        raise DescriptionError(f"{file.name}: no registers, or some beyond {ADDRESS_BITS} address bits")
    return CoreView(file.stem, _text(top, "name"), _text(top, "desc"), registers)


def _text(node: AddrmapNode | RegNode | FieldNode, which: str) -> str:
    return " ".join(str(node.get_property(which) or "").split())


def _registers(top: AddrmapNode, file: Path) -> Iterator[RegisterView]:
    for node in top.children(unroll=False):
        if not isinstance(node, RegNode) or node.get_property("regwidth") != 32:
            raise DescriptionError(f"{file.name}: {node.inst_name} is not a plain 32-bit register")
        shape = node.array_dimensions or []
        if len(shape) > 1 or (shape and node.array_stride != 4):
            raise DescriptionError(
                f"{file.name}: {node.inst_name}: only rows of adjacent words are supported"
            )
        fields = list(node.fields())
        resets = [field.get_property("reset") for field in fields]
        known = [
            value << field.low for value, field in zip(resets, fields, strict=True) if isinstance(value, int)
        ]
        yield RegisterView(
            name=node.inst_name,
            title=_text(node, "name"),
            text=_text(node, "desc"),
            address=node.raw_absolute_address if shape else node.absolute_address,
            count=shape[0] if shape else 1,
            access=_access(fields),
            reset=sum(known) if len(known) == len(fields) else None,
            volatile=any(field.is_sw_readable and field.is_hw_writable for field in fields),
            fields=tuple(_field(field) for field in fields),
        )


def _access(fields: Sequence[FieldNode]) -> str:
    if any(field.get_property("onwrite") == OnWriteType.woclr for field in fields):
        return "w1c"
    readable = any(field.is_sw_readable for field in fields)
    writable = any(field.is_sw_writable for field in fields)
    return "rw" if readable and writable else "wo" if writable else "ro"


def _field(node: FieldNode) -> FieldView:
    encoding = node.get_property("encode")
    choices = (
        tuple(Choice(m.name, m.value, " ".join((m.rdl_desc or "").split())) for m in encoding)
        if encoding
        else ()
    )
    kind = encoding.type_name.removesuffix("_e") if encoding else ""
    signed = bool(node.get_property("twos_complement", default=False))
    return FieldView(node.inst_name, node.low, node.width, _text(node, "desc"), signed, kind, choices)


# ------------------------------------------------------------------------------------------------- writing


def _notice(core: str) -> str:
    return f"Written by `python -m relnav.regtool` from registers/{core}.rdl; do not edit."


def verilog(core: CoreView) -> str:
    """The include file for the RTL: localparams and a function, no macros."""
    lines = [*_verilog_head(_notice(core.name), " is_mapped takes the word address."), *_localparams(core)]
    lines += ["/* verilator lint_on UNUSEDPARAM */", "", "function is_mapped;"]
    lines += [f"  input [{ADDRESS_BITS - 3}:0] word;", "  case (word)"]
    words = [f"{ADDRESS_BITS - 2}'h{a // 4:03X}" for register in core.registers for a in register.addresses]
    for start in range(0, len(words), 10):
        more = start + 10 < len(words)
        lines.append(f"    {', '.join(words[start : start + 10])}{',' if more else ': is_mapped = 1;'}")
    lines += ["    default: is_mapped = 0;", "  endcase", "endfunction"]
    return "\n".join(lines) + "\n"


def common_verilog(cores: Sequence[CoreView]) -> str:
    """The include file for RTL that serves every core: the localparams that all of them have alike."""
    first, *others = (_localparams(core) for core in cores)
    same = [line for line in first if all(line in lines for lines in others)]
    head = _verilog_head(_notice("*"), " what every core has alike.")
    return "\n".join([*head, *same, "/* verilator lint_on UNUSEDPARAM */"]) + "\n"


def _verilog_head(notice: str, more: str) -> list[str]:
    return [
        "// SPDX-License-Identifier: Apache-2.0",
        f"// {notice}",
        f"// To be included inside a module. Byte addresses;{more}",
        "/* verilator lint_off UNUSEDPARAM */",
    ]


def _localparams(core: CoreView) -> list[str]:
    """One line for each address, count, reset word, place of a field and value of an enumeration."""
    lines = []
    for register in core.registers:
        address = f"{ADDRESS_BITS}'h{register.address:03X}"
        lines.append(f"localparam [{ADDRESS_BITS - 1}:0] {register.name}_ADDRESS = {address};")
        if register.count > 1:
            lines.append(f"localparam integer {register.name}_COUNT = {register.count};")
        if register.reset is not None:
            lines.append(f"localparam [31:0] {register.name}_RESET = 32'h{register.reset:08X};")
        for field in register.fields:
            if field.width == 32:
                continue
            lines.append(f"localparam integer {register.name}_{field.name}_LSB = {field.low};")
            if field.width > 1:
                lines.append(f"localparam integer {register.name}_{field.name}_WIDTH = {field.width};")
    for kind, of in core.kinds.items():
        for choice in of.choices:
            size = f"[{of.width - 1}:0] "
            lines.append(f"localparam {size}{kind.upper()}_{choice.name} = {of.width}'d{choice.value};")
    return lines


def c_header(core: CoreView) -> str:
    """The C99 header: register struct, field masks, and a compile-time check of every offset."""
    upper = core.name.upper()
    lines = [
        "/* SPDX-License-Identifier: Apache-2.0",
        f" * {_notice(core.name)} */",
        f"#ifndef {upper}_REGISTERS_H",
        f"#define {upper}_REGISTERS_H",
        "",
        "#include <stddef.h>",
        "#include <stdint.h>",
        "",
        f"/* {core.title}, at {upper}_AT(base address). const members are read-only. */",
        "typedef volatile struct {",
    ]
    position = 0
    for register in core.registers:
        if register.address > position:
            lines.append(f"    const uint32_t reserved_{position:03x}[{(register.address - position) // 4}];")
        const = "const " if register.access == "ro" else ""
        row = f"[{register.count}]" if register.count > 1 else ""
        member = f"{const}uint32_t {register.name}{row};"
        lines.append(f"    {member:<34}/* 0x{register.address:03X} {register.access:<3} {register.title} */")
        position = register.addresses[-1] + 4
    lines += [
        f"}} {core.name}_registers;",
        "",
        f"#define {upper}_AT(base) (({core.name}_registers *)(uintptr_t)(base))",
        "",
    ]
    for register in core.registers:
        prefix = f"{upper}_{register.name}"
        if register.access == "ro" and register.reset is not None:
            lines.append(f"#define {prefix}_VALUE UINT32_C(0x{register.reset:08X})")
        for field in register.fields:
            if field.width == 32:
                continue
            mask = ((1 << field.width) - 1) << field.low
            short = re.split("[;:]", field.text)[0]
            lines.append(f"#define {prefix}_{field.name} UINT32_C(0x{mask:08X}) /* {short} */")
            if field.width > 1:
                lines.append(f"#define {prefix}_{field.name}_SHIFT {field.low}")
    for kind, of in core.kinds.items():
        lines.append("")
        lines.append("enum {")
        lines += [f"    {upper}_{kind.upper()}_{c.name} = {c.value}, /* {c.text} */" for c in of.choices]
        lines.append("};")
    lines += ["", "/* The compiler stops here when the struct is not laid out as the hardware is. */"]
    lines.append(f"typedef char {core.name}_layout[(")
    checks = [f"offsetof({core.name}_registers, {r.name}) == 0x{r.address:03X}" for r in core.registers]
    checks.append(f"sizeof({core.name}_registers) == 0x{core.size:03X}")
    lines.append(" &&\n".join(f"    {check}" for check in checks))
    lines += [") ? 1 : -1];", "", "#endif"]
    return "\n".join(lines) + "\n"


def _class_name(name: str) -> str:
    return "".join(part.capitalize() for part in name.split("_"))


def python(cores: Sequence[CoreView]) -> str:
    """The Python module: a class per core, in it a class per register and per enumeration."""
    lines = [
        "# SPDX-License-Identifier: Apache-2.0",
        "# ruff: noqa: E501, N801, RUF012",
        '"""Written by `python -m relnav.regtool` from registers/*.rdl; do not edit."""',
        "",
        "from enum import IntEnum",
        "",
        "from relnav.registermap import Field, Register",
    ]
    for core in cores:
        lines += [
            "",
            "",
            f"class {_class_name(core.name)}:",
            f'    """{core.title}."""',
            "",
            f"    SIZE = 0x{core.size:03X}",
        ]
        for kind, of in core.kinds.items():
            lines += ["", f"    class {_class_name(kind)}(IntEnum):"]
            lines += [f'        """Values of {kind}."""', ""]
            lines += [f"        {choice.name} = {choice.value}  # {choice.text}" for choice in of.choices]
        for register in core.registers:
            lines += [
                "",
                f"    class {register.name}(Register):",
                f'        """{register.title}. {register.text}'.rstrip(" ") + '"""',
                "",
            ]
            lines += [f"        ADDRESS = 0x{register.address:03X}", f'        ACCESS = "{register.access}"']
            if register.reset is not None:
                lines.append(f"        RESET = 0x{register.reset:08X}")
            if register.count > 1:
                lines.append(f"        COUNT = {register.count}")
            for field in register.fields:
                signed = ", signed=True" if field.signed else ""
                lines.append(f"        {field.name} = Field({field.low}, {field.width}{signed})")
            members = ", ".join(f'"{field.name}": {field.name}' for field in register.fields)
            one = f"        FIELDS = {{{members}}}"
            if len(one) > 110:
                one = "\n".join(
                    [
                        "        FIELDS = {",
                        *(f'            "{f.name}": {f.name},' for f in register.fields),
                        "        }",
                    ]
                )
            lines.append(one)
    return "\n".join(lines) + "\n"


def markdown(core: CoreView) -> str:
    """The register page: the map, then every register with more to say than one line."""
    lines = [f"<!-- {_notice(core.name)} -->", f"# {core.title}", "", core.text, ""]
    lines += ["| Address | Name | Access | Reset | |", "|---|---|---|---|---|"]
    for register in core.registers:
        reset = "" if register.reset is None else f"`0x{register.reset:08X}`" if register.reset else "0"
        first, last = register.addresses[0], register.addresses[-1]
        where = f"`0x{first:03X}`" if register.count == 1 else f"`0x{first:03X}`-`0x{last:03X}`"
        row = f"[{register.count}]" if register.count > 1 else ""
        text = f"**{register.title}.** {register.text}".rstrip().replace("|", "\\|")
        lines.append(f"| {where} | `{register.name}{row}` | {register.access} | {reset} | {text} |")
    lines += ["", "Access: ro read-only, rw read and write, wo write-only (reads 0), w1c write 1 to clear."]
    for register in core.registers:
        if (
            len(register.fields) == 1
            and register.fields[0].width in (16, 32)
            and not register.fields[0].choices
        ):
            continue
        lines += ["", f"## {register.name}", "", "| Bits | Field | |", "|---|---|---|"]
        for field in register.fields:
            high = field.low + field.width - 1
            bits = f"{high}:{field.low}" if field.width > 1 else f"{field.low}"
            values = "; ".join(f"{c.value} `{c.name}` {c.text}" for c in field.choices)
            lines.append(f"| {bits} | `{field.name}` | {field.text}{': ' + values if values else ''} |")
    return "\n".join(lines) + "\n"


# ------------------------------------------------------------------------------------------------- main


def outputs(root: Path = ROOT, version: str = __version__) -> dict[Path, str]:
    """Every generated file, relative to the repository, and what it must hold."""
    files = sorted((root / "registers").glob("*.rdl"))
    if not files:
        raise DescriptionError(f"no description in {root / 'registers'}")
    cores = [read(file, version) for file in files]
    made = {
        Path("sw/relnav/registers.py"): python(cores),
        Path("rtl/include/common_registers.vh"): common_verilog(cores),
    }
    for core in cores:
        made[Path(f"rtl/include/{core.name}_registers.vh")] = verilog(core)
        made[Path(f"sw/c/{core.name}_registers.h")] = c_header(core)
        made[Path(f"docs/registers-{core.name}.md")] = markdown(core)
    return made


def stale(root: Path = ROOT, version: str = __version__) -> list[Path]:
    """Generated files that are missing or differ from their description."""
    made = outputs(root, version)
    return [
        name
        for name, text in made.items()
        if not (root / name).is_file() or (root / name).read_text() != text
    ]


def main(arguments: Sequence[str] | None = None) -> int:
    """Write the files, or with --check only compare. 0 all well, 1 stale, 2 a wrong description."""
    parser = argparse.ArgumentParser(
        prog="python -m relnav.regtool", description="Generate every view of the registers."
    )
    parser.add_argument("--check", action="store_true", help="compare only; exit 1 when a file is stale")
    parser.add_argument(
        "--root", type=Path, default=ROOT, help="repository (default: the one this file is in)"
    )
    options = parser.parse_args(arguments)
    try:
        old = stale(options.root)
        if not options.check:
            for name, text in outputs(options.root).items():
                (options.root / name).parent.mkdir(parents=True, exist_ok=True)
                (options.root / name).write_text(text)
    except (DescriptionError, OSError) as error:
        print(f"regtool: {error}", file=sys.stderr)
        return 2
    for name in old:
        print(
            f"{'stale' if options.check else 'written'}: {name}",
            file=sys.stderr if options.check else sys.stdout,
        )
    return int(options.check and bool(old))


if __name__ == "__main__":
    sys.exit(main())
