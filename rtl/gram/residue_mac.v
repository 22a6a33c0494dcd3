// SPDX-License-Identifier: Apache-2.0
// (x + y) * factor, or (x - y) * factor, accumulated, in one DSP48E1 with its pre-adder and all its registers.
//   sum <= (fresh ? 0 : sum) + (x +- y) * factor     modulo 2^SUM_BITS
// Latency 3: terms and factor at clock 0, their sum at 1, product at 2 (the clock of `add` and `fresh`), sum at 3.
`resetall
`default_nettype none

(* keep_hierarchy *)
module residue_mac #(
    parameter SUBTRACT    = 0,
    parameter X_BITS      = 18,
    parameter Y_BITS      = 18,
    parameter FACTOR_BITS = 17,
    parameter SUM_BITS    = 40
) (
    input  wire                          clk,
    input  wire                          clear,  // zero sum
    input  wire                          add,
    input  wire                          fresh,  // start from zero with this product
    input  wire signed [     X_BITS-1:0] x,
    input  wire signed [     Y_BITS-1:0] y,
    input  wire signed [FACTOR_BITS-1:0] factor,
    output reg signed  [   SUM_BITS-1:0] sum
);
  localparam TERM_BITS = (X_BITS > Y_BITS ? X_BITS : Y_BITS) + 1;
  localparam PRODUCT_BITS = TERM_BITS + FACTOR_BITS;
  reg signed [TERM_BITS-1:0] term;
  reg signed [FACTOR_BITS-1:0] held;
  reg signed [PRODUCT_BITS-1:0] product;
  wire signed [SUM_BITS-1:0] extended = {{SUM_BITS - PRODUCT_BITS{product[PRODUCT_BITS-1]}}, product};
  wire signed [SUM_BITS-1:0] base = fresh ? {SUM_BITS{1'b0}} : sum;

  wire signed [TERM_BITS-1:0] wide_x = {{TERM_BITS - X_BITS{x[X_BITS-1]}}, x};
  wire signed [TERM_BITS-1:0] wide_y = {{TERM_BITS - Y_BITS{y[Y_BITS-1]}}, y};

  always @(posedge clk) begin
    if (SUBTRACT != 0) term <= wide_x - wide_y;
    else term <= wide_x + wide_y;
    held    <= factor;
    product <= term * held;
    if (clear) sum <= 0;
    else if (add) sum <= extended + base;
  end
endmodule

`resetall
