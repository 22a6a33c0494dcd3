// SPDX-License-Identifier: Apache-2.0
// residue_mac with any product but that by 1, for the proofs of item_residue: those hold whatever a coefficient makes of a term.
`resetall
`default_nettype none

module residue_mac #(
    parameter SUBTRACT    = 0,
    parameter X_BITS      = 18,
    parameter Y_BITS      = 18,
    parameter FACTOR_BITS = 17,
    parameter SUM_BITS    = 40
) (
    input  wire                          clk,
    input  wire                          clear,
    input  wire                          add,
    input  wire                          fresh,
    input  wire signed [     X_BITS-1:0] x,
    input  wire signed [     Y_BITS-1:0] y,
    input  wire signed [FACTOR_BITS-1:0] factor,
    output reg signed  [   SUM_BITS-1:0] sum
);
  localparam TERM_BITS = (X_BITS > Y_BITS ? X_BITS : Y_BITS) + 1;
  (* anyseq *) wire signed [SUM_BITS-1:0] any_product;
  reg signed [TERM_BITS-1:0] term;
  reg by_one;
  reg signed [SUM_BITS-1:0] product;
  wire signed [TERM_BITS-1:0] wide_x = x, wide_y = y;
  wire signed [SUM_BITS-1:0] wide_term = term;
  always @(posedge clk) begin
    term <= SUBTRACT != 0 ? wide_x - wide_y : wide_x + wide_y;
    by_one <= factor == 1;
    product <= by_one ? wide_term : any_product;
    if (clear) sum <= 0;
    else if (add) sum <= product + (fresh ? {SUM_BITS{1'b0}} : sum);
  end
endmodule

`resetall
