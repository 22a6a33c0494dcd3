// SPDX-License-Identifier: Apache-2.0
// The square of a signed 18-bit number in one DSP48E1, latency 2.
`resetall
`default_nettype none

(* keep_hierarchy *)
module residue_square (
    input  wire               clk,
    input  wire signed [17:0] value,
    output reg         [34:0] square  // at most 2^34
);
  reg signed [35:0] product;

  always @(posedge clk) begin
    product <= value * value;
    square  <= product[34:0];
  end

  /* verilator lint_off UNUSEDSIGNAL */
  wire unused = product[35];
  /* verilator lint_on UNUSEDSIGNAL */
endmodule

`resetall
