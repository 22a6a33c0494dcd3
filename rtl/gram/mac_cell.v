// SPDX-License-Identifier: Apache-2.0
// One product accumulated in one DSP48E1: every register and the adder pack into it (A, B, M, C, P).
//   sum <= product + addend,  product = x * y (0 with skip), all modulo 2^SUM_BITS
// Latency 3 from x, y: factors at clock 1, product at 2, sum at 3; 1 from the addend register to sum.
// X_HOLD = 1: x waits in a register of its own (hold_x), from which load_x takes it: the DSP's second input register.
// The accumulator lives outside: sum goes through a store back to addend_in, so that one cell keeps several sums.
`resetall
`default_nettype none

(* keep_hierarchy *)
module mac_cell #(
    parameter X_BITS   = 16,
    parameter Y_BITS   = 16,
    parameter SUM_BITS = 48,
    parameter X_HOLD   = 0
) (
    input  wire                       clk,
    input  wire                       clear,         // zero sum
    input  wire                       hold_x,        // where X_HOLD = 1
    input  wire                       load_x,
    input  wire                       load_y,
    input  wire signed [  X_BITS-1:0] x,
    input  wire signed [  Y_BITS-1:0] y,
    input  wire                       skip,          // no factors: product is 0
    input  wire                       addend_clear,
    input  wire                       addend_load,
    input  wire signed [SUM_BITS-1:0] addend_in,
    input  wire                       accumulate,    // load sum
    output reg signed  [SUM_BITS-1:0] sum
);
  reg signed [X_BITS-1:0] x_factor;
  reg signed [Y_BITS-1:0] y_factor;
  reg signed [X_BITS+Y_BITS-1:0] product;
  reg signed [SUM_BITS-1:0] addend;
  wire signed [X_BITS-1:0] x_held;
  wire signed [SUM_BITS-1:0] extended = {{SUM_BITS - X_BITS - Y_BITS{product[X_BITS+Y_BITS-1]}}, product};

  generate
    if (X_HOLD != 0) begin : g_hold
      reg signed [X_BITS-1:0] x_waiting;
      always @(posedge clk) if (hold_x) x_waiting <= x;
      assign x_held = x_waiting;
    end else begin : g_direct
      assign x_held = x;
      /* verilator lint_off UNUSEDSIGNAL */
      wire unused = hold_x;
      /* verilator lint_on UNUSEDSIGNAL */
    end
  endgenerate

  always @(posedge clk) begin
    if (load_x) x_factor <= x_held;
    if (load_y) y_factor <= y;

    if (skip) product <= 0;
    else product <= x_factor * y_factor;

    if (addend_clear) addend <= 0;
    else if (addend_load) addend <= addend_in;

    if (clear) sum <= 0;
    else if (accumulate) sum <= extended + addend;
  end
endmodule

`resetall
