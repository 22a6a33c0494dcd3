# SPDX-License-Identifier: Apache-2.0
"""The rates' microprogram as Verilog; `python -m relnav.model.rates_rom` writes its module."""

from __future__ import annotations

import sys
from pathlib import Path

from relnav.model.rates_program import LANES, Bank, Operation, Step
from relnav.model.rates_schedule import schedule
from relnav.model.rom import assigns, pack, ports

OPERATION_FIELDS = (
    ("x_bank", 2),
    ("x_address", 5),
    ("y_select", 3),
    ("bus_bank", 1),
    ("bus_address", 5),
    ("bus_lane", 3),
    ("indexed", 1),
    ("clamp", 1),
    ("product_write", 1),
    ("product_address", 3),
    ("c_bank", 2),
    ("c_address", 5),
    ("subtract", 1),
    ("sum_lanes", 6),
    ("sum_address", 5),
    ("divide", 1),
    ("load", 1),
    ("track", 3),
    ("output_valid", 1),
    ("output_index", 5),
    ("back", 2),
    ("mark", 2),
)
EARLY_FIELDS = ("bus_bank", "bus_address", "indexed")
"""Fields that are also wanted a clock before, for the bus operand's address."""
TERM_FIELDS = (("term", 1), ("row", 3), ("column", 3), ("first", 1), ("last", 1))
FIELDS = OPERATION_FIELDS + TERM_FIELDS
WIDTH = sum(width for _, width in FIELDS)
EARLY = tuple((f"next_{name}", dict(FIELDS)[name]) for name in EARLY_FIELDS)
ADDRESS = 9  # bits of a ROM address, which is the cycle


def values(step: Step) -> dict[str, int]:
    """Fields of a step's word that are not 0."""
    if not isinstance(step, Operation):
        return {"term": 1, "row": step.row, "column": step.column, "first": step.first, "last": step.last}
    bus = step.bus
    found = {
        "x_bank": step.x[0],
        "x_address": step.x[1],
        "y_select": step.y,
        "clamp": step.clamp,
        "product_write": step.product is not None,
        "product_address": step.product or 0,
        "c_bank": step.c[0],
        "c_address": step.c[1],
        "subtract": step.subtract,
        "divide": step.divide,
        "load": step.load is not None,
        "track": step.track,
        "output_valid": step.output is not None,
        "output_index": step.output or 0,
        "back": step.scale,
        "mark": step.mark,
    }
    if bus is not None:
        assert bus.lane in LANES
        found |= {
            "bus_bank": bus.bank == Bank.A,
            "bus_address": bus.address,
            "bus_lane": bus.lane,
            "indexed": bus.indexed,
        }
    assert step.load is None or (bus is not None and step.load == bus.lane)
    if step.dest is not None:
        found |= {"sum_lanes": sum(1 << lane for lane in step.lanes), "sum_address": step.dest}
    return found


def verilog() -> str:
    """Text of rates_program.v."""
    placed = schedule()
    words: dict[int, dict[str, int]] = {}
    notes: dict[int, list[str]] = {}
    for step, cycle in zip(placed.steps, placed.cycles, strict=True):
        words.setdefault(cycle, {}).update(values(step))
        notes.setdefault(cycle, []).append(step.name)
    assert max(words) < 1 << ADDRESS
    body = "\n".join(
        f"      {ADDRESS}'d{cycle}: word <= {WIDTH}'h{pack(FIELDS, words[cycle]):x};"
        f"  // {', '.join(notes[cycle])}"
        for cycle in sorted(words)
    )
    early = "\n".join(
        line.replace("assign ", "assign next_")
        for line in assigns(FIELDS, "word").splitlines()
        if line.split()[1] in EARLY_FIELDS
    )
    return f"""// SPDX-License-Identifier: Apache-2.0
// Microprogram of the rates engine: one operation of the lanes and one residual term a cycle. Written by
// `python -m relnav.model.rates_rom` from sw/relnav/model/rates_program.py: do not edit.
//
// The address is the cycle, counted from the first moment's; its word is at the outputs two clocks later, none while `run` is low or
// after `rst`.
`resetall
`default_nettype none
module rates_program (
    input  wire       clk,
    input  wire       rst,
    input  wire       run,
    input  wire [{ADDRESS - 1}:0] address,
    // the next word's
{ports(EARLY)}
{ports(FIELDS)[:-1]}
);
  reg [{WIDTH - 1}:0] word, held;
  always @(posedge clk) begin
    case (run ? address : {{{ADDRESS}{{1'b1}}}})
{body}
      default: word <= {WIDTH}'d0;
    endcase
    held <= word;
    if (rst) begin
      word <= {WIDTH}'d0;
      held <= {WIDTH}'d0;
    end
  end
{early}
{assigns(FIELDS, "held")}
endmodule
`resetall
"""  # noqa: E501  (lines of Verilog)


def main() -> None:
    """Write the generated module below the given folder (default rtl/)."""
    root = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parents[3] / "rtl"
    (root / "ivisnav" / "rates_program.v").write_text(verilog(), encoding="utf-8")


if __name__ == "__main__":
    main()
