// SPDX-License-Identifier: Apache-2.0
// Takes rows of four beats {c1,c0} {c3,c2} {c5,c4} {w,c6} and presents each row twice, a beat a clock, with its weight: pass 0, pass 1.
//
// clock        0   1   2   3   4   5   6   7   8   9  10
// beat         3   -   -   -   -   0'  1'  2'  3'  -   -      - : beat_ready low
// pair             0   1   2   3   0*  1*  2*  3*  0'  1'     * : pass 1 (second)
//
// Latency 1 from a row's last beat to its pair 0. One row's memory will do: beat k is taken no earlier than the clock that shows pair k of
// pass 1, and that was read a clock before. A row in 8 clocks; a row's last beat is never taken before the lanes are free, so what follows
// it has a constant latency.
// A beat taken with clear belongs to the new frame; rows under way are forgotten.
`resetall
`default_nettype none

module row_beats (
    input  wire        clk,
    input  wire        rst,
    input  wire        clear,
    input  wire        beat_valid,
    output wire        beat_ready,
    input  wire [63:0] beat_data,
    input  wire [ 1:0] beat_index,
    input  wire        beat_last,
    output wire        row,          // its last beat is taken
    output wire        pair_valid,
    output wire        pair_second,
    output wire [ 1:0] pair_index,
    output reg         pair_last,    // of the frame's last row
    output wire [63:0] pair,
    output reg  [15:0] weight
);
  reg active;
  reg [2:0] step;  // {second, index}
  wire beat = beat_valid && beat_ready;
  wire [2:0] step_next = active ? step + 3'd1 : 3'd0;
  wire [63:0] stored;
  reg [63:0] shown;

  assign beat_ready = !active || step[2];
  assign row = beat && beat_index == 2'd3;
  assign pair_valid = active;
  assign {pair_second, pair_index} = step;
  assign pair = shown;

  set_store #(
      .BITS(64),
      .ADDRESS_BITS(2)
  ) u_store (
      .clk(clk),
      .write(beat),
      .write_address(beat_index),
      .from_sum(beat_data),
      .read_address(step_next[1:0]),
      .to_addend(stored)
  );

  always @(posedge clk) begin
    shown <= stored;
    if (row) begin
      active    <= 1'b1;
      pair_last <= beat_last;
      weight    <= beat_data[47:32];
    end else if (step == 3'd7) active <= 1'b0;
    step <= step_next;
    if (rst || clear) begin
      active <= 1'b0;
      step   <= 3'd0;
    end
  end
endmodule

`resetall
