"""The microprogram as Verilog: `python -m relnav.model.rom` writes rtl/oltae/solve_program.v."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from relnav.model import assembler as asm
from relnav.model import newton_program as newton
from relnav.model import pose_program as pose
from relnav.model import statistics_program as statistics
from relnav.model.schedule import Scheduler

# name, width; most significant first. Slot fields are each term's, result fields a dot product's last slot's.
SLOT_FIELDS = (
    ("x_address", 6),
    ("x_by_lane", 1),
    ("y_address", 5),
    ("y_by_lane", 1),
    ("alternate", 4),
    ("negate", 4),
    ("enable", 4),
    ("first", 1),
    ("only_estimated", 1),
    ("only_first", 1),
    ("reference_code", 4),
)
RESULT_FIELDS = (
    ("last", 1),
    ("kind", 2),
    ("half", 1),
    ("clamp", 1),
    ("write", 2),
    ("source", 3),
    ("dest", 5),
    ("turn_dest", 1),
    ("only_turned", 1),
    ("choose_turn", 1),
    ("track", 2),
    ("divide", 2),
    ("divide_dest", 5),
    ("result_output", 3),
    ("output_index", 6),
    ("mark", 3),
)
FIELDS = SLOT_FIELDS + RESULT_FIELDS
WIDTH = sum(width for _, width in FIELDS)
ADDRESS = 10  # bits of a ROM address
DRAIN_EARLIEST = 14  # cycles from `redrain` during which none of its items comes
MARKS = {"": 0, "q": 1, "pose": 2, "basic": 3, "all": 4}


def mask(lanes: frozenset[int]) -> int:
    """Bit k for lane k."""
    return sum(1 << lane for lane in lanes)


Fields = tuple[tuple[str, int], ...]
"""Name and width, the most significant first."""


def pack(fields: Fields, values: Mapping[str, int]) -> int:
    """One word of a microprogram; fields not named are 0."""
    word = 0
    for name, width in fields:
        value = int(values.get(name, 0))
        assert 0 <= value < 1 << width, (name, value)
        word = word << width | value
    assert not set(values) - {name for name, _ in fields}
    return word


def ports(fields: Fields) -> str:
    """A word's fields as output ports."""
    return "\n".join(
        f"    output wire {f'[{width - 1}:0] ' if width > 1 else ''}{name}," for name, width in fields
    )


def assigns(fields: Fields, word: str) -> str:
    """The output ports' assignments from the register `word`."""
    low = sum(width for _, width in fields)
    lines = []
    for name, width in fields:
        low -= width
        span = f"{low + width - 1}:{low}" if width > 1 else f"{low}"
        lines.append(f"  assign {name} = {word}[{span}];")
    return "\n".join(lines)


def slot_words(dot: asm.Dot) -> list[int]:
    """One packed word a term."""
    words = []
    for number, term in enumerate(dot.terms):
        last = number == len(dot.terms) - 1
        values = {
            "x_address": term.x,
            "x_by_lane": term.x_by_lane,
            "y_address": term.y,
            "y_by_lane": term.y_by_lane,
            "alternate": mask(term.alternate),
            "negate": mask(term.negate),
            "enable": mask(term.enable),
            "first": number == 0,
            "only_estimated": term.only_estimated,
            "only_first": term.only_first,
            "reference_code": dot.reference,
            "kind": dot.kind,
        }
        if last:
            values |= {
                "last": 1,
                "half": dot.half,
                "clamp": dot.clamp,
                "write": dot.write,
                "source": dot.source,
                "dest": dot.dest,
                "turn_dest": dot.turn_dest,
                "only_turned": dot.only_turned,
                "choose_turn": dot.choose_turn,
                "track": dot.track,
                "divide": dot.divide,
                "divide_dest": dot.divide_dest or 0,
                "result_output": dot.output,
                "output_index": dot.output_index,
                "mark": MARKS[dot.mark],
            }
        words.append(pack(FIELDS, values))
    return words


DRAIN_LATENCY = 17
"""Cycles from `redrain` to its first item, at most (16 in the lean build)."""


@dataclass(frozen=True)
class Program:
    """The whole program, scheduled: dot products in order, and the re-application called in between."""

    dots: list[asm.Dot]
    newton: list[asm.Dot]
    call: int
    """Number of dot products before the re-application."""
    call_cycle: int
    return_cycle: int
    """Cycle, counted through the re-application, in which the program goes on as if it were `call_cycle`."""
    redrain: int
    """Cycle in which the second drain is asked for."""
    basic: int
    """Number of dot products without the covariances."""

    def in_order(self, reapply: bool) -> list[asm.Dot]:
        """What runs, in the order of execution."""
        return [*self.dots[: self.call], *(self.newton if reapply else []), *self.dots[self.call :]]


def addresses(dots: list[asm.Dot], cycle: int, address: int) -> list[int]:
    """ROM address of each dot product: idle cycles take a place, the second pass of a probed one does not."""
    found = []
    for dot in dots:
        address += dot.cycle - cycle
        found.append(address)
        address += len(dot.terms)
        cycle = dot.end + 1
    return found


def reapplication(prefix: Scheduler, main: list[asm.Dot]) -> tuple[list[asm.Dot], int]:
    """The Newton step scheduled behind the quaternion, and the cycle in which the main program may go on.

    `main`, scheduled without it, expects the quaternion and 1/p_0 when they were ready at first; the return
    is late enough for the new ones, and for writes still under way not to meet `main`'s.
    """
    call = prefix.next_slot
    before = dict(prefix.ready)
    dots = prefix.run(newton.program())
    awaited = [*range(pose.P, pose.P + 4), pose.RECIPROCAL_P0]
    delay = max(prefix.next_slot - call, *(prefix.ready[r] - before[r] for r in awaited))
    later = {d.end + d.latency for d in main if d.write != asm.NO_WRITE}
    later |= {d.end + d.latency + asm.RECIPROCAL_LATENCY for d in main if d.divide != asm.NO_DIVIDE}
    while any(write - delay in later for write in prefix.busy_writes if write > call + delay):
        delay += 1
    return dots, call + delay


def scheduled() -> Program:
    """Pose, statistics and covariances in one schedule, and the re-application."""
    scheduler = Scheduler(pose.arrival(), pose.references())
    dots = scheduler.run(pose.program())
    call = next(number for number, dot in enumerate(dots) if dot.name == "P3") + 1
    call_cycle = dots[call - 1].end + 1
    # the low limbs come after the items whose places they take have been read, and after the call
    last_use = max(dot.end for dot in dots if dot.name.startswith("ca"))
    redrain = max(last_use + 1 - DRAIN_EARLIEST, call_cycle + 1)
    scheduler.ready |= statistics.arrival(redrain + DRAIN_LATENCY)
    dots += scheduler.run(statistics.program(covariance=True))

    prefix = Scheduler(pose.arrival(), pose.references())
    prefix.run(pose.program()[:call])
    step, return_cycle = reapplication(prefix, dots[call:])
    basic = len(pose.program()) + len(statistics.program(covariance=False))
    return Program(dots, step, call, call_cycle, return_cycle, redrain, basic)


@dataclass(frozen=True)
class Layout:
    """The program in its ROM."""

    words: dict[int, tuple[int, str, str]]
    """Address -> word, the parameter without which it is 0 ("" for none), note."""
    call: int
    target: int
    leave: int
    """Of the re-application: addresses as in solve_program.v."""
    redrain: int
    finished: int


def layout() -> Layout:
    """Where everything stands."""
    program = scheduled()
    main = addresses(program.dots, 0, 0)
    target = main[-1] + len(program.dots[-1].terms) + 2
    step = addresses(program.newton, program.call_cycle, target)
    leave = step[-1] + len(program.newton[-1].terms) + program.return_cycle - (program.newton[-1].end + 1)
    assert leave < (1 << ADDRESS) - 1
    words = {}
    placed = zip([*program.dots, *program.newton], [*main, *step], strict=True)
    for number, (dot, start) in enumerate(placed):
        needs = "REAPPLY" if number >= len(program.dots) else "COVARIANCE" if number >= program.basic else ""
        for slot, word in enumerate(slot_words(dot)):
            words[start + slot] = word, needs, f"{dot.name} {slot + 1}/{len(dot.terms)}"
    return Layout(words, program.call_cycle, target, leave, program.redrain, target - 2)


def verilog() -> str:
    """Text of solve_program.v."""
    rom = layout()
    lines = []
    for address, (word, needs, note) in sorted(rom.words.items()):
        value = f"{WIDTH}'h{word:x}"
        if needs:
            value = f"{needs} != 0 ? {value} : {WIDTH}'d0"
        lines.append(f"      {ADDRESS}'d{address}: word <= {value};  // {note}")
    body = "\n".join(lines)
    return f"""// SPDX-License-Identifier: Apache-2.0
// Microprogram of the solve engine. Written by `python -m relnav.model.rom` from sw/relnav/model/pose_program.py and
// statistics_program.py: do not edit.
//
// The word at `address` is at the outputs a clock later; none while `run` is low. Fields after `reference_code` belong to the dot
// product that ends with the slot. `redrain` asks for the low limbs of the moments.
`resetall
`default_nettype none
module solve_program #(
    parameter COVARIANCE = 1,
    parameter REAPPLY    = 1
) (
    input  wire       clk,
    input  wire       run,
    input  wire [{ADDRESS - 1}:0] address,
{ports(FIELDS)}
    // the re-application is called at CALL, starts at TARGET and leaves at LEAVE for CALL
    input  wire [{ADDRESS - 1}:0] counter,
    input  wire       reapply,         // wanted, and not yet done
    output wire       leaving,
    output wire [{ADDRESS - 1}:0] following,  // address after `counter`'s predecessor
    output wire       redrain,
    output wire       finished
);
  reg [{WIDTH - 1}:0] word;
  always @(posedge clk)
    case (run ? address : {{{ADDRESS}{{1'b1}}}})
{body}
      default: word <= {WIDTH}'d0;
    endcase
  localparam [{ADDRESS - 1}:0] CALL = {rom.call}, TARGET = {rom.target}, LEAVE = {rom.leave};
  wire calling = REAPPLY != 0 && reapply && counter == CALL;
  assign leaving = REAPPLY != 0 && counter == LEAVE;
  assign following = calling ? TARGET : leaving ? CALL : counter;
  assign redrain = run & address == {ADDRESS}'d{rom.redrain};
  assign finished = address == {ADDRESS}'d{rom.finished};
{assigns(FIELDS, "word")}
endmodule
`resetall
"""  # noqa: E501  (lines of Verilog)


def main() -> None:
    """Write the generated module below the given folder (default rtl/)."""
    root = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parents[3] / "rtl"
    (root / "oltae" / "solve_program.v").write_text(verilog(), encoding="utf-8")


if __name__ == "__main__":
    main()
