// SPDX-License-Identifier: Apache-2.0
// One limb product plus a number that comes one cycle later: one DSP48E1 with its M and P registers.
//   in : multiplicand, multiplier signed; addend signed, one cycle later (the neighbour limb's product, shifted)
//   out: total = multiplicand * multiplier + addend
// Latency 2 + DELAY from the factors, 1 from the addend; DELAY as in digit_product.
// |product| <= 2^41 and |addend| <= 2^42 keep the total inside 44 bits.
`resetall
`default_nettype none

(* keep_hierarchy *)
module digit_product_add #(
    parameter DELAY = 0
) (
    input  wire               clk,
    input  wire signed [24:0] multiplicand,
    input  wire signed [17:0] multiplier,
    input  wire signed [42:0] addend,
    output reg  signed [43:0] total
);
  wire signed [24:0] a;
  wire signed [17:0] b;
  reg signed  [42:0] product;

  generate
    if (DELAY == 0) begin : g_direct
      assign a = multiplicand;
      assign b = multiplier;
    end else begin : g_registered
      reg signed [24:0] a_held;
      reg signed [17:0] b_held;
      always @(posedge clk) begin
        a_held <= multiplicand;
        b_held <= multiplier;
      end
      assign a = a_held;
      assign b = b_held;
    end
  endgenerate

  always @(posedge clk) begin
    product <= a * b;
    total   <= product + addend;
  end
endmodule

`resetall
