"""The microprogram as Verilog: `python -m relnav.model.rom` writes rtl/oltae/solve_program.v, one line a slot."""

from __future__ import annotations

import sys
from pathlib import Path

from relnav.model import assembler as asm
from relnav.model import pose_program as pose
from relnav.model.schedule import Scheduler

# name, width; most significant first. Slot fields belong to each term, result fields to a dot product's last slot.
SLOT_FIELDS = (
    ("x_address", 6),
    ("x_by_lane", 1),
    ("y_address", 5),
    ("y_by_lane", 1),
    ("alternate", 4),
    ("negate", 4),
    ("enable", 4),
    ("first", 1),
    ("reference", 3),
)
RESULT_FIELDS = (
    ("last", 1),
    ("kind", 2),
    ("half", 1),
    ("write", 2),
    ("source", 3),
    ("dest", 5),
    ("turn_dest", 1),
    ("only_turned", 1),
    ("choose_turn", 1),
    ("track", 2),
    ("divide", 2),
    ("divide_dest", 5),
    ("result_output", 2),
    ("output_index", 6),
    ("mark", 2),
)
FIELDS = SLOT_FIELDS + RESULT_FIELDS
WIDTH = sum(width for _, width in FIELDS)
MARKS = {"": 0, "q": 1, "pose": 2, "all": 3}


def mask(lanes: frozenset[int]) -> int:
    """Bit k for lane k."""
    return sum(1 << lane for lane in lanes)


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
            "reference": dot.reference,
        }
        if last:
            values |= {
                "last": 1,
                "kind": dot.kind,
                "half": dot.half,
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
        word = 0
        for name, width in FIELDS:
            value = int(values.get(name, 0))
            assert 0 <= value < 1 << width, (dot.name, name, value)
            word = word << width | value
        words.append(word)
    return words


def scheduled() -> list[asm.Dot]:
    """The pose program with its cycles."""
    return Scheduler(pose.arrival(), pose.references()).run(pose.program())


def verilog() -> str:
    """Text of solve_program.v."""
    dots = scheduled()
    lines = {}
    for dot in dots:
        for number, word in enumerate(slot_words(dot)):
            note = f"{dot.name} {number + 1}/{len(dot.terms)}"
            lines[dot.cycle + number] = f"      9'd{dot.cycle + number}: word <= {WIDTH}'h{word:x};  // {note}"
    end = dots[-1].end
    ports = "\n".join(
        f"    output wire {f'[{width - 1}:0] ' if width > 1 else ''}{name}," for name, width in FIELDS
    )
    low = WIDTH
    assigns = []
    for name, width in FIELDS:
        low -= width
        span = f"{low + width - 1}:{low}" if width > 1 else f"{low}"
        assigns.append(f"  assign {name} = word[{span}];")
    body = "\n".join(lines[key] for key in sorted(lines))
    return f"""// SPDX-License-Identifier: Apache-2.0
// Microprogram of the solve engine. Written by `python -m relnav.model.rom` from sw/relnav/model/pose_program.py: do not edit.
//
// The word of cycle c is at the outputs in cycle c when `counter` was c one clock earlier. Cycle 0 is the one in which the
// first moment item arrives. Fields after `reference` belong to the dot product that ends with the slot.
`resetall
`default_nettype none
module solve_program (
    input  wire       clk,
    input  wire       run,
    input  wire [8:0] counter,
{ports}
    output wire       finished
);
  reg [{WIDTH - 1}:0] word;
  always @(posedge clk)
    case (run ? counter : 9'd511)
{body}
      default: word <= {WIDTH}'d0;
    endcase
  assign finished = counter == 9'd{end + 1};
{chr(10).join(assigns)}
endmodule
`resetall
"""


def main() -> None:
    """Write the generated module below the given folder (default rtl/)."""
    root = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parents[3] / "rtl"
    (root / "oltae" / "solve_program.v").write_text(verilog(), encoding="utf-8")


if __name__ == "__main__":
    main()
