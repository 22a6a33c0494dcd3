// SPDX-License-Identifier: Apache-2.0
// Normalises a 48-bit signed sum to 35 bits: shifts out its redundant sign bits and counts them.
//
//   mantissa = floor(sum 2^left / 2^13), left = redundant sign bits of sum: 0 for a full-scale value, 47 for 0 and -1
//
// Counting and shifting go together, 16s, then 4s, then 1s: each stage looks at the sign bits the last one left.
// cycle | 0 sum, by 16s | 1 by 4s and 1s: mantissa, left (combinational)
// Latency 1 clock.
`resetall
`default_nettype none
module sum_normaliser (
    input  wire        clk,
    input  wire [47:0] sum,
    output wire [34:0] mantissa,
    output wire [ 5:0] left
);
  function equal_6;
    input [5:0] bits;
    equal_6 = &bits | ~|bits;
  endfunction

  // neighbouring groups share a bit
  wire same_16 = equal_6(sum[47:42]) & equal_6(sum[42:37]) & equal_6(sum[37:32]) & ~(sum[32] ^ sum[31]);
  wire same_32 = same_16 & equal_6(sum[31:26]) & equal_6(sum[26:21]) & equal_6(sum[21:16]) & ~(sum[16] ^ sum[15]);

  reg [1:0] by_16;
  reg [47:0] coarse;
  always @(posedge clk) begin
    by_16 <= {same_32, same_16 & ~same_32};
    coarse[47:16] <= same_32 ? {sum[15:0], 16'd0} : same_16 ? sum[31:0] : sum[47:16];
    coarse[15:0] <= same_16 ? 16'd0 : sum[15:0];
  end

  function [1:0] leading;  // number of leading ones
    input [2:0] bits;
    leading = {&bits[2:1], bits[2] & (~bits[1] | bits[0])};
  endfunction

  function equal_5;
    input [4:0] bits;
    equal_5 = &bits | ~|bits;
  endfunction

  wire [1:0] by_4 = leading({equal_5(coarse[47:43]), equal_5(coarse[43:39]), equal_5(coarse[39:35])});
  wire [47:10] middle;
  mux4 #(
      .WIDTH(38)
  ) fours (
      .select(by_4),
      .in_0(coarse[47:10]),
      .in_1(coarse[43:6]),
      .in_2(coarse[39:2]),
      .in_3({coarse[35:0], 2'd0}),
      .out(middle)
  );
  wire [1:0] by_1 = leading(~(middle[47:45] ^ middle[46:44]));
  mux4 #(
      .WIDTH(35)
  ) ones (
      .select(by_1),
      .in_0(middle[47:13]),
      .in_1(middle[46:12]),
      .in_2(middle[45:11]),
      .in_3(middle[44:10]),
      .out(mantissa)
  );
  assign left = {by_16, by_4, by_1};
endmodule
`resetall
