// SPDX-License-Identifier: Apache-2.0
// recombine against exact integers, for all limb sums that 65535 points can give (recombine.sby). A product of two limbs is at most 2^30,
// so high, low and each of the two cross sums lie within 65535 * 2^30; `both` is what a 48-bit accumulator makes of high + cross + low,
// which may wrap. top is free: upper = top + floor(high / 2^16) must fit 48 bits, as it does by the same bound on top.
`resetall
`default_nettype none

module recombine_properties #(
    parameter WEIGHTED = 1,
    parameter M2_BITS  = 96
) (
    input wire               clk,
    input wire               with_top,
    input wire signed [47:0] high,
    input wire signed [47:0] low,
    input wire signed [47:0] cross_1,
    input wire signed [47:0] cross_2,
    input wire signed [47:0] top
);
  localparam signed [47:0] BOUND = 48'sd65535 <<< 30;
  wire signed [127:0] exact_cross = $signed(cross_1) + $signed({{80{cross_2[47]}}, cross_2});
  wire [47:0] both = high + low + cross_1 + cross_2;  // modulo 2^48
  wire signed [M2_BITS-1:0] moment;

  always @* begin
    assume (high <= BOUND && high >= -BOUND && low <= BOUND && low >= -BOUND && top <= BOUND && top >= -BOUND);
    assume (cross_1 <= BOUND && cross_1 >= -BOUND && cross_2 <= BOUND && cross_2 >= -BOUND);
  end

  recombine #(
      .WEIGHTED(WEIGHTED),
      .M2_BITS(M2_BITS)
  ) dut (
      .clk(clk),
      .with_top(with_top),
      .high(high),
      .low(low),
      .both(both),
      .top(top),
      .moment(moment)
  );

  wire signed [127:0] wide_top = top, wide_high = high, wide_low = low;
  wire signed [127:0] exact = (WEIGHTED != 0 && with_top ? wide_top <<< 48 : 128'sd0) + (wide_high <<< 32) + (exact_cross <<< 16) + wide_low;
  reg signed [127:0] exact_1, exact_2, exact_3;
  reg [1:0] clocks = 2'd0;
  always @(posedge clk) begin
    {exact_1, exact_2, exact_3} <= {exact, exact_1, exact_2};
    if (clocks != 2'd3) clocks <= clocks + 2'd1;
  end
  wire signed [127:0] wide_moment = moment;
  always @(posedge clk) if (clocks == 2'd3) moment_exact : assert (wide_moment == exact_3);
endmodule

`resetall
