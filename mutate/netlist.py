# SPDX-License-Identifier: Apache-2.0
"""A file that stands in for a module and holds all its mutants: +relnav_mutant=K chooses one, 0 none.

The module keeps its header. Inside, each set of parameters that a test uses has a netlist of its own (Yosys:
proc, constants folded, dead logic removed), into which `mutate -ctrl` has put every mutation with the number
that switches it on; any other set of parameters has the original. So one build serves all mutants.

For a test that uses one set only there is a second stand-in, which is that netlist itself: registers and
instances stand where the source has them, so that a bench may look at them and flip them.
"""

from __future__ import annotations

import random
import re
import subprocess
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import zip_longest
from pathlib import Path

from sim.sources import RTL, module_file, reachable, sources

CONTROL = "relnav_mutant"
CONTROL_BITS = 24
CLOCK = "clk"
PARALLEL = " // synopsys parallel_case"
POOL = 40
"""Mutants that Yosys is asked for at least; a sample is their beginning."""

Values = tuple[tuple[str, str], ...]
"""Parameter -> Verilog literal, in the order of the header."""

_COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)


@dataclass(frozen=True)
class Header:
    """Where a module's header stands in its file, and what it says."""

    start: int
    parameters: tuple[str, ...]
    parameters_text: str
    """What stands between #( and )."""
    parameters_at: int
    ports: tuple[str, ...]
    ports_text: str


@dataclass(frozen=True)
class Mutant:
    """One mutation, as `mutate -list` told it."""

    number: int
    """Of +relnav_mutant."""
    values: Values
    """The parameters of the netlist that it is in."""
    mode: str
    """inv, const0, const1; cnot0, cnot1: inverted while another bit of the port is 0, 1."""
    cell: str
    port: str
    bit: int
    control: int | None
    """The other bit of cnot0 and cnot1."""
    wire: str
    """The net of the source's own that it is on, with the bit; empty where it has no name."""
    source: str
    """file:line.column-line.column of the statement."""
    part: int
    """Which netlist of the stand-in."""
    line: str
    """The command."""

    @property
    def key(self) -> str:
        """What names it in equivalents.toml; the same as long as the module's file stays the same."""
        place = f"{self.cell} {self.port}[{self.bit}]" + ("" if self.control is None else f"/{self.control}")
        return " ".join([self.mode, place, *(f"{name}={value}" for name, value in self.values)])


def _blank(text: str) -> str:
    """Comments as spaces, so that places stay."""
    return _COMMENT.sub(lambda match: re.sub(r"[^\n]", " ", match.group()), text)


def _close(text: str, place: int) -> int:
    """Place of the bracket that closes the one at `place`."""
    depth = 0
    for at in range(place, len(text)):
        depth += {"(": 1, ")": -1}.get(text[at], 0)
        if depth == 0:
            return at
    raise ValueError("a bracket is not closed")


def _pieces(text: str) -> list[tuple[int, str]]:
    """The parts between commas outside brackets, each with its place."""
    found, depth, start = [], 0, 0
    for at, letter in enumerate(text + ","):
        depth += (letter in "([{") - (letter in ")]}")
        if letter == "," and not depth:
            found.append((start, text[start:at]))
            start = at + 1
    return [piece for piece in found if piece[1].strip()]


def read_header(text: str, module: str) -> Header:
    """Take a module's ANSI header apart."""
    blank = _blank(text)
    match = re.search(rf"\bmodule\s+{module}\b\s*", blank)
    if match is None:
        raise ValueError(f"there is no module {module}")
    at, parameters_at, parameters_text = match.end(), match.end(), ""
    if blank[at] == "#":
        start = blank.index("(", at)
        at = _close(blank, start)
        parameters_at, parameters_text = start + 1, blank[start + 1 : at]
    start = blank.index("(", at)
    ports_text = blank[start + 1 : _close(blank, start)]
    names = tuple(piece.partition("=")[0].split()[-1] for _, piece in _pieces(parameters_text))
    ports = tuple(piece.split()[-1] for _, piece in _pieces(ports_text))
    return Header(match.start(), names, parameters_text, parameters_at, ports, ports_text)


def with_values(text: str, header: Header, values: Mapping[str, str]) -> str:
    """The file with other defaults of its parameters; every line stays where it is."""
    for place, piece in reversed(_pieces(header.parameters_text)):
        declared, _, _ = piece.partition("=")
        if declared.split()[-1] not in values:
            continue
        start = header.parameters_at + place
        lines = "\n" * piece.count("\n", len(declared))
        text = (
            text[:start] + f"{declared}= {values[declared.split()[-1]]}{lines}" + text[start + len(piece) :]
        )
    return text


def write_probe(module: str, file: Path, report: Path) -> None:
    """A copy of the module that adds a line with its parameters to `report` at every instance's start."""
    text = module_file(module).read_text()
    header = read_header(text, module)
    shown = []
    for _, piece in _pieces(header.parameters_text):
        declared = piece.partition("=")[0]
        shown.append((declared.split()[-1], "%h" if "[" in declared else "%0d"))
    form = " ".join(f"{name}={form}" for name, form in shown)
    names = "".join(f", {name}" for name, _ in shown)
    probe = (
        f'integer relnav_probe; initial begin relnav_probe = $fopen("{report}", "a");'
        f' $fdisplay(relnav_probe, "{module} {form}"{names}); $fclose(relnav_probe); end\n'
    )
    end = _blank(text).rindex("endmodule")
    file.write_text(text[:end] + probe + text[end:])


def read_probe(line: str) -> tuple[str, Values]:
    """The module and the parameters of a line."""
    module, *words = line.split()
    header = read_header(module_file(module).read_text(), module)
    pieces = [piece.partition("=")[0] for _, piece in _pieces(header.parameters_text)]
    vectors = {declared.split()[-1] for declared in pieces if "[" in declared}
    pairs = [word.partition("=")[::2] for word in words]
    # text as a parameter has no value that Icarus shows; it keeps its default
    return module, tuple(
        (name, f"{4 * len(x)}'h{x}" if name in vectors else x) for name, x in pairs if x and x != name
    )


def _others(module: str) -> list[Path]:
    """The files of what is inside a module."""
    return [file for file in reachable(module, sources()) if file.stem != module]


def _yosys(folder: Path, name: str, commands: Sequence[str], seconds: int = 600) -> None:
    """Run commands in a Yosys of their own (pyosys) in `folder`, with so many seconds of the processor."""
    script, log = folder / f"{name}.ys", folder / f"{name}.log"
    script.write_text("\n".join(commands) + "\n")
    limit = f"import resource as r; r.setrlimit(r.RLIMIT_CPU, ({seconds}, {seconds}))"
    code = f"{limit}; from pyosys import libyosys as y; y.run_pass('script {script.name}', y.Design())"
    with log.open("w") as out:
        done = subprocess.run(
            [sys.executable, "-c", code],
            cwd=folder,
            stdout=out,
            stderr=subprocess.STDOUT,
            check=False,
        )
    if done.returncode:
        errors = [line for line in log.read_text(errors="replace").splitlines() if "ERROR" in line]
        raise RuntimeError(f"Yosys: {' '.join(errors)[:300] or 'no message'} (see {log})")


def _parse(line: str, number: int, values: Values, part: int) -> Mutant:
    """A line of `mutate -list`."""
    found: dict[str, str] = {}
    words = line.split()[1:]
    for option, word in zip(words[::2], words[1::2], strict=True):
        found.setdefault(option, word)  # of several sources the first: the wire's, else the cell's
    wire = f"{found['-wire']}[{found.get('-wirebit', 0)}]" if "-wire" in found else ""
    sources_found = [word for option, word in zip(words[::2], words[1::2], strict=True) if option == "-src"]
    return Mutant(
        number,
        values,
        found["-mode"],
        found["-cell"],
        found["-port"],
        int(found["-portbit"]),
        int(found["-ctrlbit"]) if "-ctrlbit" in found else None,
        wire,
        sources_found[-1] if sources_found else "",
        part,
        line,
    )


_CELL = re.compile(r"^ *cell \S+ (\S+)$")
_GIVES = re.compile(r"^( *connect \\Q )(.*)$")
_PORT = re.compile(r"^    connect \\\S+ ")
_WIRE = re.compile(r"^ *wire ((?:(?:width|offset) -?\d+ |signed |upto )*)(\\\S+)$")
_INSTANCE = re.compile(
    r"^  [A-Za-z_]\w* (?:#\(\n(?:    .*\n)*  \) )?\\([\w.]+)\.(\w+)  \(\n(?:    .*\n)*  \);\n", re.M
)
_CONSTANT = re.compile(r"^ *connect (\S+) (\d+)(?:'([01xz]+))?$")


def _constants(netlist: str) -> dict[tuple[str, str], str]:
    """Cell and port -> bits, the most significant first, of the ports of an RTLIL text that are constants."""
    found, cell = {}, ""
    for line in netlist.splitlines():
        if match := _CELL.match(line):
            cell = match[1].removeprefix("\\")
        elif match := _CONSTANT.match(line):
            bits = f"{int(match[2]):032b}" if match[3] is None else match[3].rjust(int(match[2]), match[3][0])
            found[cell, match[1].removeprefix("\\")] = bits
    return found


def _registers(netlist: str) -> dict[str, str]:
    """Flip-flop -> the wire of the source's own that it is the whole of, in an RTLIL text."""
    found, cell, clocked = {}, "", False
    for line in netlist.splitlines():
        if match := _CELL.match(line):
            cell, clocked = match[1], line.split()[1].startswith("$dff")
        elif clocked and (match := _GIVES.match(line)) and re.fullmatch(r"\\\S+", match[2]):
            found[cell] = match[2]
    return found


def keep_registers(before: str, after: str) -> str:
    """A module's RTLIL after `mutate`, each register with its name again; what reads it reads `<name>__read`.

    A mutation of a flip-flop's output puts logic between it and the wire of its name; a bench that flips
    the register by name would then find a net. Output ports keep their names.
    """
    registers = _registers(before)
    ports = {line.split()[-1] for line in after.splitlines() if re.match(r" *wire .*(input|output) \d", line)}
    moved, cell, lines = {}, "", []
    for line in after.splitlines():
        if match := _CELL.match(line):
            cell = match[1]
        name = registers.get(cell, "")
        if name and name not in ports and (match := _GIVES.match(line)) and match[2] != name:
            moved[name] = match[2]
            line = match[1] + name
            cell = ""
        lines.append(line)
    if not moved:
        return after
    token = re.compile("(" + "|".join(map(re.escape, moved)) + r")(?=[\s\]}]|$)")

    def read(text: str) -> str:
        return token.sub(lambda match: f"{match[1]}__read", text)

    def connected(line: str) -> str:
        port = _PORT.match(line)
        if port:  # of a cell: the name of its port stays
            return port[0] + read(line[port.end() :])
        return read(line) if line.startswith("  connect ") else line

    out = []
    for line in lines:
        wire, gives = _WIRE.match(line), _GIVES.match(line)
        if wire and wire[2] in moved:
            out += [line, f"  wire {wire[1]}{wire[2]}__read"]
        else:
            out.append(line if gives and gives[2] in moved else connected(line))
    end = max(place for place, line in enumerate(out) if line == "end")
    out[end:end] = [f"  connect {read(given)} {name}" for name, given in moved.items()]
    return "\n".join(out) + "\n"


def _possible(line: str, constants: Mapping[tuple[str, str], str]) -> bool:
    """Not on a clock, which would come late in every mutant, nor on a memory's first contents, a constant.

    Nor what changes nothing: a constant tied to its own value, an inversion on a condition that is constant.
    """
    words = dict(zip(line.split()[1::2], line.split()[2::2], strict=False))
    place = words["-cell"].removeprefix("\\"), words["-port"].removeprefix("\\")
    bits = constants.get(place, "")[::-1]
    same, other = bits[int(words["-portbit"]) :][:1], bits[int(words.get("-ctrlbit", 0)) :][:1]
    value = words["-mode"][-1]
    if words["-mode"].startswith("const") and same == value:
        return False
    if words["-mode"].startswith("cnot") and other in ("0", "1") and other != value:
        return False
    clocked = any(f" {place} " in line for place in (f"-wire {CLOCK}", "-port CLK", f"-port {CLOCK}"))
    return not clocked and "meminit" not in line.split(" -cell ")[-1].split()[0]


def make(
    module: str, used: Sequence[Values], count: int | None, seed: int, folder: Path
) -> tuple[Path, list[Path], list[Mutant]]:
    """Write the stand-ins of a module with `count` mutants (None: all there are), spread over all of `used`.

    A smaller sample of the same seed is the beginning of a larger one, up to POOL mutants.
    Returns the file for any set, those of the single sets (`Mutant.part`) and the mutants.
    Raises RuntimeError with Yosys' message.
    """
    folder.mkdir(parents=True, exist_ok=True)
    original = module_file(module)
    text = original.read_text()
    header = read_header(text, module)
    order = list(used)
    random.Random(seed).shuffle(order)
    chosen = order if count is None else order[:count]
    each = 10_000_000 if count is None else -(-max(POOL, count) // min(len(order), max(POOL, count)))
    listed = []
    for place, values in enumerate(chosen):
        part = folder / f"part{place}"
        part.mkdir(exist_ok=True)
        (part / original.name).write_text(with_values(text, header, dict(values)))
        read = [
            f"read_verilog -I{RTL / 'include'} {original.name}",
            *(f"read_verilog -lib -I{RTL / 'include'} {file}" for file in _others(module)),
            f"proc -norom {module}",
            *[f"opt_expr -mux_undef {module}", f"opt_clean {module}"] * 3,
            "write_rtlil netlist.il",
            f"select {module}; write_rtlil -selected module.il; select -clear",
        ]
        # a quarter more, for those on the clock
        some = each if count is None else each + each // 4 + 20
        _yosys(part, "list", [*read, f"mutate -list {some} -seed {seed + place} -o list.txt {module}"])
        constants = _constants((part / "netlist.il").read_text())
        lines = [line for line in (part / "list.txt").read_text().splitlines() if _possible(line, constants)]
        listed.append(lines[:each])
    rounds = zip_longest(*([(place, line) for line in lines] for place, lines in enumerate(listed)))
    turns = [turn for turns in rounds for turn in turns if turn is not None][:count]
    mutants = [_parse(line, k, chosen[place], place) for k, (place, line) in enumerate(turns, 1)]
    netlists, single = [], []
    for place, values in enumerate(chosen):
        part = folder / f"part{place}"
        apply = ["read_rtlil netlist.il"]
        for mutant in mutants:
            if mutant.part == place:
                control = f"mutate -ctrl {CONTROL} {CONTROL_BITS} {mutant.number} "
                apply.append(mutant.line.replace("mutate ", control, 1))
        if len(apply) == 1:  # nothing to mutate: an input that nothing reads
            apply.append(f"select -module {module}; add -input {CONTROL} {CONTROL_BITS}; select -clear")
        apply += [f"select {module}", "write_rtlil -selected mutated.il"]
        _yosys(part, "apply", apply)
        named = keep_registers((part / "module.il").read_text(), (part / "mutated.il").read_text())
        (part / "mutated.il").write_text(named)
        _yosys(part, "write", ["read_rtlil mutated.il", "write_verilog -noattr netlist.v"])
        # where two branches match, the simulators take the first: so must the proofs
        netlist = (part / "netlist.v").read_text().replace(PARALLEL, "")
        (part / "netlist.v").write_text(netlist)
        netlists.append(re.sub(rf"\bmodule {module}\b", f"module {module}__{place}", netlist, count=1))
        single.append(part / "single" / original.name)
        single[-1].parent.mkdir(exist_ok=True)
        single[-1].write_text(_single(module, text, header, values, netlist))
    file = folder / original.name
    file.write_text(_stand_in(module, text, header, chosen, netlists))
    return file, single, mutants


def proved_equivalent(module: str, mutant: Mutant, folder: Path, seconds: int = 20) -> bool:
    """Whether SAT proves that a mutation changes no output and no next state, whatever the state.

    Registers are cut: what they give is free. The instances inside are cut too (no input of one may change),
    and where that does not prove it, they are taken in with their registers. False: not proved, for whatever
    reason (what only cannot be reached is not proved so). folder: of `make`.
    """
    flat = [False, True] if _others(module) else [False]
    return any(_proved(module, mutant, folder, seconds, taken_in) for taken_in in flat)


def _proved(module: str, mutant: Mutant, folder: Path, seconds: int, flat: bool) -> bool:
    part = folder / f"part{mutant.part}"
    box = "" if flat else "-lib "
    commands = ["read_verilog netlist.v"]
    commands += [f"read_verilog {box}-I{RTL / 'include'} {file}" for file in _others(module)]
    commands += [f"hierarchy -top {module}", "proc -norom"]
    if flat:
        kept = ["setattr -mod -unset keep_hierarchy *", f"setattr -unset keep_hierarchy {module}/t:*"]
        commands += [*kept, "flatten"]
    commands += [
        "opt_clean",
        f"memory_collect {module}",
        f"memory_map {module}",
        f"simplemap {module}/t:$dff",
        f"cd {module}",
        "autoname",
        "rename -hide t:$* t:$_DFF_P_ %d",  # expose cuts at cells that have names,
        "rename -hide w:* i:* %d o:* %d",  # and makes outputs of nets that have some
        "cd ..",
        f"opt_clean -purge {module}",  # single flip-flops that nothing reads
        f"expose -evert {module}",
        f"copy {module} gold",
        f"copy {module} gate",
    ]
    for name, value in (("gold", 0), ("gate", mutant.number)):
        commands += [
            f"cd {name}",
            f"delete -port w:{CONTROL}",
            f"connect -set {CONTROL} {CONTROL_BITS}'d{value}",
            "cd ..",
        ]
    commands += [
        "miter -equiv -make_outputs gold gate miter",
        "flatten miter",
        "opt -fast miter",
        "sat -verify -prove trigger 0 miter",
    ]
    name = "flat" if flat else "cut"
    try:
        _yosys(part, name, commands, seconds)
    except RuntimeError:
        return False
    return "SUCCESS!" in (part / f"{name}.log").read_text(errors="replace")


_CHOICE = f"""  reg [{CONTROL_BITS - 1}:0] {CONTROL};
  initial if (!$value$plusargs("{CONTROL}=%d", {CONTROL})) {CONTROL} = 0;
"""


def _single(module: str, text: str, header: Header, values: Values, netlist: str) -> str:
    """The netlist of one set of parameters in the module's place; its parameters change nothing."""
    with_defaults = read_header(with_values(text, header, dict(values)), module)
    parameters = f" #({with_defaults.parameters_text})" if header.parameters else ""
    ports = ", ".join(header.ports)
    netlist = re.sub(
        rf"\bmodule {module}\b[^;]*;\n", f"module {module}{parameters} ({ports});\n", netlist, count=1
    )
    netlist = re.sub(
        rf"  input \[[0-9:]+\] {CONTROL};\n  wire \[[0-9:]+\] {CONTROL};\n", _CHOICE, netlist, count=1
    )
    return f"{text[: header.start]}{_scopes(netlist)}\n`resetall\n"


def _scopes(netlist: str) -> str:
    r"""Instances of generated blocks (\block.name, but for those with an index) in blocks of that name."""
    blocks: dict[str, list[str]] = {}
    for match in _INSTANCE.finditer(netlist):
        path, name = match[1], match[2]
        blocks.setdefault(path, []).append(match[0].replace(f"\\{path}.{name} ", name, 1))
    netlist = _INSTANCE.sub("", netlist)
    found = []
    for path, instances in sorted(blocks.items()):
        names = path.split(".")
        begins = "".join(f"if (1) begin : {name}\n" for name in names)
        found.append(f"  generate {begins}{''.join(instances)}{'end ' * len(names)}endgenerate\n")
    end = netlist.rindex("endmodule")
    return netlist[:end] + "".join(found) + netlist[end:]


def _stand_in(
    module: str, text: str, header: Header, chosen: Sequence[Values], netlists: Sequence[str]
) -> str:
    ports = ", ".join(f".{port}({port})" for port in header.ports)
    parameters = f" #({header.parameters_text})" if header.parameters else ""
    branches = []
    for place, values in enumerate(chosen):
        same = " && ".join(f"{name} == {value}" for name, value in values) or "1"
        branches.append(
            f"if ({same}) begin : g_{place}\n"
            f"    {module}__{place} u_mutants ({ports}, .{CONTROL}({CONTROL}));\n  end else "
        )
    passed = ", ".join(f".{name}({name})" for name in header.parameters)
    passed = f" #({passed})" if passed else ""
    ports_text = re.sub(r"\breg\b", "wire", header.ports_text)
    renamed = text[: header.start] + re.sub(
        rf"\bmodule(\s+){module}\b", rf"module\g<1>{module}__original", text[header.start :], count=1
    )
    return (
        f"{text[: header.start]}module {module}{parameters} ({ports_text});\n"
        f"{_CHOICE}  generate {''.join(branches)}begin : g_original\n"
        f"    {module}__original{passed} u_original ({ports});\n  end endgenerate\n"
        f"endmodule\n`resetall\n{'`resetall'.join(netlists)}\n`resetall\n{renamed}"
    )
