// SPDX-License-Identifier: Apache-2.0
// Sum and difference of two items of a stream; other items pass. Two's complement, modulo 2^(LOW_BITS + HIGH_BITS).
//   in : at most one item a cycle. Flags say what it is:
//        in_first a, in_second b (out: a + b with the tag of a, then a - b with the tag of b), in_plain (out: itself),
//        in_value: a value item, from its own port (out: itself).
//        The tag comes with the flags, the low part one cycle later, the high part another cycle later.
//   out: out_valid, out_tag, out_value whole
// Latency 4 from the flags (3 from the low part); a + b leaves one cycle before a - b.
// b may come any time after a, but nothing may come between them.
//
//   cycle  flags  low   held  last  low sum register
//   0      a
//   1      b      a
//   2      next   b     a
//   3             next  a     b     a + b   = held + low of cycle 2
//   4                   next  next  a - b   = held - last of cycle 3
//   5                               next    = held + 0    (a value item: held was cleared, 0 + value)
// The adder is one 6-input LUT a bit: held + (b | ~last | value | 0).
`resetall
`default_nettype none

module butterfly #(
    parameter LOW_BITS  = 48,
    parameter HIGH_BITS = 50,
    parameter TAG_BITS  = 6
) (
    input wire clk,
    input wire rst,
    // item
    input wire in_first,
    input wire in_second,
    input wire in_plain,
    input wire in_value,
    input wire [TAG_BITS-1:0] in_tag,
    input wire [LOW_BITS-1:0] in_low,  // one cycle later
    input wire [HIGH_BITS-1:0] in_high,  // two cycles later
    input wire [LOW_BITS-1:0] value_low,  // like in_low
    input wire [HIGH_BITS-1:0] value_high,
    // result
    output reg out_valid,
    output reg [TAG_BITS-1:0] out_tag,
    output reg signed [LOW_BITS+HIGH_BITS-1:0] out_value
);
  // ---- control. Number n: n cycles after the flags.
  reg second_1;
  reg plain_1;
  reg value_1;
  reg load_1;  // the held item is over
  reg [1:0] operand_1;  // 3 the item, 2 ~last, 1 value, 0 zero
  reg second_2;
  reg plain_2;
  reg value_2;
  reg load_2;
  reg [1:0] operand_2;
  reg valid_3;

  always @(posedge clk) begin
    second_1  <= in_second;
    plain_1   <= in_plain;
    value_1   <= in_value;
    load_1    <= in_first || in_plain;
    operand_1 <= {in_second || second_1, in_second || value_1};
    second_2  <= second_1;
    plain_2   <= plain_1;
    value_2   <= value_1;
    load_2    <= load_1;
    operand_2 <= operand_1;
    valid_3   <= second_1 || second_2 || plain_2 || value_2;
    out_valid <= valid_3;
    if (rst) begin
      second_1  <= 1'b0;
      plain_1   <= 1'b0;
      value_1   <= 1'b0;
      second_2  <= 1'b0;
      plain_2   <= 1'b0;
      value_2   <= 1'b0;
      valid_3   <= 1'b0;
      out_valid <= 1'b0;
    end
  end

  // ---- tags
  reg [TAG_BITS-1:0] tag_1;
  reg [TAG_BITS-1:0] held_tag;
  reg [TAG_BITS-1:0] last_tag;
  reg [TAG_BITS-1:0] tag_3;
  always @(posedge clk) begin
    tag_1 <= in_tag;
    if (load_1 || value_1) held_tag <= tag_1;
    last_tag <= tag_1;
    tag_3 <= second_2 ? last_tag : held_tag;
    out_tag <= tag_3;
  end

  // ---- low part. The operand is written as AND-OR, which synthesis packs with the adder.
  reg [LOW_BITS-1:0] held_low;
  reg [LOW_BITS-1:0] last_low;
  reg [LOW_BITS-1:0] late_value_low;
  reg [LOW_BITS-1:0] sum_low;
  reg carry;
  wire [LOW_BITS-1:0] operand_low = ({LOW_BITS{operand_1 == 2'd3}} & in_low) |
      ({LOW_BITS{operand_1 == 2'd2}} & ~last_low) | ({LOW_BITS{operand_1 == 2'd1}} & late_value_low);
  wire [LOW_BITS+1:0] low_sum = {1'b0, held_low, 1'b1} + {1'b0, operand_low, second_2};
  always @(posedge clk) begin
    if (value_1) held_low <= {LOW_BITS{1'b0}};
    else if (load_1) held_low <= in_low;
    last_low <= in_low;
    late_value_low <= value_low;
    sum_low <= low_sum[LOW_BITS:1];
    carry <= low_sum[LOW_BITS+1];
    out_value[LOW_BITS-1:0] <= sum_low;
  end

  // ---- high part, a cycle later
  reg [HIGH_BITS-1:0] held_high;
  reg [HIGH_BITS-1:0] last_high;
  reg [HIGH_BITS-1:0] late_value_high;
  wire [HIGH_BITS-1:0] operand_high = ({HIGH_BITS{operand_2 == 2'd3}} & in_high) |
      ({HIGH_BITS{operand_2 == 2'd2}} & ~last_high) | ({HIGH_BITS{operand_2 == 2'd1}} & late_value_high);
  wire [HIGH_BITS:0] high_sum = {held_high, 1'b1} + {operand_high, carry};
  always @(posedge clk) begin
    if (value_2) held_high <= {HIGH_BITS{1'b0}};
    else if (load_2) held_high <= in_high;
    last_high <= in_high;
    late_value_high <= value_high;
    out_value[LOW_BITS+HIGH_BITS-1:LOW_BITS] <= high_sum[HIGH_BITS:1];
  end

  wire unused = &{1'b0, low_sum[0], high_sum[0]};
endmodule

`resetall
