// SPDX-License-Identifier: Apache-2.0
// A weight times a limb plus an addend, in one DSP48E1 with its M and P registers: latency 2 from the factors, 1 from the addend.
`resetall
`default_nettype none

(* keep_hierarchy *)
module weight_product_add #(
    parameter LIMB_BITS = 16
) (
    input  wire                        clk,
    input  wire        [         15:0] weight,
    input  wire signed [LIMB_BITS-1:0] limb,    // below 2^16 in magnitude
    input  wire signed [         47:0] addend,
    output reg signed  [         47:0] total
);
  reg signed [32:0] product;
  wire signed [47:0] extended = {{15{product[32]}}, product};

  always @(posedge clk) begin
    product <= $signed({1'b0, weight}) * limb;
    total   <= extended + addend;
  end
endmodule

`resetall
