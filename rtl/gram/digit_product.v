// SPDX-License-Identifier: Apache-2.0
// One limb product, one DSP48E1 with its M register.
//   in : multiplicand, multiplier  signed (25 x 18 bits: the DSP's own size; an unsigned limb leaves the sign bit 0)
//   out: product = multiplicand * multiplier
// Latency 1 + DELAY; DELAY (0 or 1) fills the DSP's input registers, so a late limb waits at no cost.
// The hierarchy is kept so that synthesis maps every module of this kind to exactly one DSP.
`resetall
`default_nettype none

(* keep_hierarchy *)
module digit_product #(
    parameter DELAY = 0
) (
    input  wire               clk,
    input  wire signed [24:0] multiplicand,
    input  wire signed [17:0] multiplier,
    output reg  signed [42:0] product
);
  wire signed [24:0] a;
  wire signed [17:0] b;

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

  always @(posedge clk) product <= a * b;
endmodule

`resetall
