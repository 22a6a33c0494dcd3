// SPDX-License-Identifier: Apache-2.0
// A number of two limbs times one limb in two DSPs, without a fabric adder:
//   result = (low_a * low_b) + (high_a * high_b) * 2^SHIFT
// where either a or b is common to both; low_a, low_b unsigned-or-signed limbs in the DSP's signed ports.
//   out: result signed, 44 + SHIFT bits (the high DSP's total above the low product's SHIFT lowest bits)
// Latency 2 + DELAY. Only the SHIFT bits below are fabric flip-flops.
`resetall
`default_nettype none

module limb_pair_product #(
    parameter SHIFT = 24,
    parameter DELAY = 0
) (
    input  wire                      clk,
    input  wire signed [       24:0] low_a,
    input  wire signed [       17:0] low_b,
    input  wire signed [       24:0] high_a,
    input  wire signed [       17:0] high_b,
    output wire signed [SHIFT+43:0] result
);
  wire signed [42:0] low_product;
  wire signed [43:0] high_total;
  reg [SHIFT-1:0] low_bits;

  digit_product #(
      .DELAY(DELAY)
  ) u_low (
      .clk(clk),
      .multiplicand(low_a),
      .multiplier(low_b),
      .product(low_product)
  );

  digit_product_add #(
      .DELAY(DELAY)
  ) u_high (
      .clk(clk),
      .multiplicand(high_a),
      .multiplier(high_b),
      .addend({{SHIFT{low_product[42]}}, low_product[42:SHIFT]}),
      .total(high_total)
  );

  always @(posedge clk) low_bits <= low_product[SHIFT-1:0];
  assign result = {high_total, low_bits};
endmodule

`resetall
