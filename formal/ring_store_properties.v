// SPDX-License-Identifier: Apache-2.0
// A ring of SLOTS accumulators as in gram_lane: mac_cell with a ring_store of SLOTS - 2 words (ring_store.sby). The accumulators stay apart:
// every step adds its product, or nothing while the drain turns the ring, to the accumulator whose turn it is, the others keep what they have.
//
// `kept` are the accumulators by definition, in an array that does not move; `turn` says which comes next. Every input is free in every clock.
`resetall
`default_nettype none

module ring_store_properties #(
    parameter SLOTS = 3,
    parameter BITS  = 48
) (
    input wire               clk,
    input wire               clear,
    input wire               load_x,
    input wire               load_y,
    input wire signed [15:0] x,
    input wire signed [15:0] y,
    input wire               skip,
    input wire               accumulate
);
  wire [BITS-1:0] sum, to_addend;

  mac_cell #(
      .X_BITS(16),
      .Y_BITS(16),
      .SUM_BITS(BITS)
  ) cell (
      .clk(clk),
      .clear(clear),
      .hold_x(1'b0),
      .load_x(load_x),
      .load_y(load_y),
      .x(x),
      .y(y),
      .skip(skip),
      .addend_clear(clear),
      .addend_load(accumulate),
      .addend_in(to_addend),
      .accumulate(accumulate),
      .sum(sum)
  );

  ring_store #(
      .BITS (BITS),
      .DEPTH(SLOTS - 2)
  ) dut (
      .clk(clk),
      .clear(clear),
      .advance(accumulate),
      .from_sum(sum),
      .to_addend(to_addend)
  );

  // connected by the script
  wire signed [31:0] cell_product;
  wire [BITS-1:0] cell_addend;
  wire [(SLOTS-2)*BITS-1:0] dut_ring;  // newest lowest

  reg started = 1'b0, cleared = 1'b0;
  always @(posedge clk) {started, cleared} <= {1'b1, clear};
  always @* if (!started) assume (clear);

  reg [BITS-1:0] kept[0:3];  // SLOTS of them
  reg [1:0] turn;
  wire [BITS-1:0] product = {{BITS - 32{cell_product[31]}}, cell_product};
  integer i;
  always @(posedge clk) begin
    if (accumulate) begin
      kept[turn] <= kept[turn] + product;
      turn <= turn == SLOTS - 1 ? 2'd0 : turn + 2'd1;
    end
    if (clear) begin
      for (i = 0; i < 4; i = i + 1) kept[i] <= 0;
      turn <= 2'd0;
    end
  end

  // the accumulator n turns from now
  function [1:0] after(input integer n);
    after = turn + n >= SLOTS ? turn + n - SLOTS : turn + n;
  endfunction

  always @* if (started) begin
    next_comes : assert (cell_addend == kept[turn]);
    then_comes : assert (to_addend == kept[after(1)]);
    last_is_sum : assert (turn < SLOTS && sum == kept[after(SLOTS-1)]);
    if (SLOTS == 4) newest_waits : assert (dut_ring[BITS-1:0] == kept[after(2)]);
    if (cleared) all_cleared : assert ({sum, cell_addend, dut_ring} == 0);
  end
endmodule

`resetall
