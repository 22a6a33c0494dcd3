// SPDX-License-Identifier: Apache-2.0
// The operands y of the seven lanes: the seven components of a row, two a clock (a = c0 c2 c4 c6, b = c1 c3 c5 -), go into a ring that
// turns by one lane a clock, so that lane i has component i + s modulo 7 in slot s.
//   pass 0: y = (h + l, h, l)   pass 1: y = (l, l, h)     c = h 2^16 + l,  l = -2^15 .. 2^15-1,  h = -2^15 .. 2^15 (17 bits)
// so that with ring_digits' x   high += v1 h + v2 l,  both += (v1 + v0)(h + l) + v2 l,  low += v0 l,  low's second set += v2 h.
// h + l is c's upper half plus at most 2^15 either way: 17 bits. (Kept apart: merged, Yosys takes a LUT a bit more.)
//
// clock     0   1   2   3   4   5   6   7   8
// pair      0   1   2   3   0*
// load                      1                      pair 3 is one clock old, pairs 2, 1, 0 two, three, four
// y                             0   1   2   3      slot: latency 2 from pair 3
`resetall
`default_nettype none

(* keep_hierarchy *)
module operand_ring (
    input  wire            clk,
    input  wire            second,  // the pair is for pass 1
    input  wire [    63:0] pair,    // {b, a}
    input  wire            load,
    output wire [7*51-1:0] y        // lane i's {both, high, low}, limbs of 17 bits, in bits 51 i and up
);
  // {high, low} of a pair, newest in a_1, b_1
  reg [33:0] a_1, a_2, a_3, a_4, b_1, b_2, b_3, b_4;
  reg second_1;

  wire [16:0] low_a = {pair[15], pair[15:0]};
  wire [16:0] low_b = {pair[47], pair[47:32]};
  wire [16:0] high_a = {pair[31], pair[31:16]} + {16'd0, pair[15]};
  wire [16:0] high_b = {pair[63], pair[63:48]} + {16'd0, pair[47]};

  always @(posedge clk) begin
    a_1 <= second ? {low_a, high_a} : {high_a, low_a};
    b_1 <= second ? {low_b, high_b} : {high_b, low_b};
    {a_2, a_3, a_4} <= {a_1, a_2, a_3};
    {b_2, b_3, b_4} <= {b_1, b_2, b_3};
    second_1 <= second;
  end

  reg [7*34-1:0] ring;
  reg ring_second;

  always @(posedge clk)
    if (load) begin
      ring <= {a_1, b_2, a_2, b_3, a_3, b_4, a_4};
      ring_second <= second_1;
    end else ring <= {ring[33:0], ring[7*34-1:34]};

  genvar lane;
  generate
    for (lane = 0; lane < 7; lane = lane + 1) begin : g_lane
      wire signed [16:0] high = ring[34*lane+17+:17];
      wire signed [16:0] low = ring[34*lane+:17];
      wire signed [16:0] both = high + (ring_second ? 17'sd0 : low);
      assign y[51*lane+:51] = {both, high, low};
    end
  endgenerate
endmodule

`resetall
