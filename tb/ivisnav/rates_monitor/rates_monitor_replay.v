// SPDX-License-Identifier: Apache-2.0
// rates_monitor under replay: all it says, in every clock that counts.
`resetall
`default_nettype none

module rates_monitor_replay (
    input  wire clk,
    input  wire rst,
    output wire done
);
  wire look, clear, diagonal_valid;
  wire [2:0] diagonal_place, track, lane, moment_place, inverse_place;
  wire [31:0] diagonal, bus, condition;
  wire rank_deficient, stalled, excessive;

  rates_monitor dut (
      .clk(clk),
      .clear(clear),
      .diagonal_valid(diagonal_valid),
      .diagonal_place(diagonal_place),
      .diagonal(diagonal),
      .moment_place(moment_place),
      .track(track),
      .lane(lane),
      .bus(bus),
      .inverse_place(inverse_place),
      .rank_deficient(rank_deficient),
      .stalled(stalled),
      .excessive(excessive),
      .condition(condition)
  );

  replay #(
      .IN_BITS (1 + 1 + 1 + 3 + 32 + 3 + 3 + 32),
      .OUT_BITS(1 + 3 + 3 + 3 + 32)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({look, clear, diagonal_valid, diagonal_place, diagonal, track, lane, bus}),
      .result({
        look && !rst, moment_place, inverse_place, rank_deficient, stalled, excessive, condition
      }),
      .done(done)
  );
endmodule

`resetall
