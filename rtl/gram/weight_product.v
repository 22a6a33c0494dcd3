// SPDX-License-Identifier: Apache-2.0
// A weight times a limb, latency 1: one DSP48E1 with its M register.
`resetall
`default_nettype none

(* keep_hierarchy *)
module weight_product (
    input  wire               clk,
    input  wire        [15:0] weight,
    input  wire signed [15:0] limb,
    output reg signed  [31:0] product
);
  // |weight limb| <= (2^16-1) 2^15 < 2^31
  wire signed [32:0] full = $signed({1'b0, weight}) * limb;

  always @(posedge clk) product <= full[31:0];

  /* verilator lint_off UNUSEDSIGNAL */
  wire unused = full[32];
  /* verilator lint_on UNUSEDSIGNAL */
endmodule

`resetall
