// SPDX-License-Identifier: Apache-2.0
// The six first moments: sums of the terms of each beat, three sums of a and three of b in two rings that turn with the beats.
//   in : term_valid with term_a, term_b (beats 0, 1, 2 of a point in turn)
//   out: sums = {b2, a2, b1, a1, b0, a0}, complete two clocks after a point's last term
// A term of TERM_BITS summed 65535 times fits TERM_BITS + 16 bits; shifted inputs (33 bits) fit 48: 65535 (2^31 + 2^15) < 2^47.
`resetall
`default_nettype none

module first_moments #(
    parameter TERM_BITS = 48,  // 33 where WEIGHTED = 0
    parameter M1_BITS   = 64   // 48 where WEIGHTED = 0
) (
    input  wire                        clk,
    input  wire                        rst,
    input  wire                        clear,
    input  wire                        term_valid,
    input  wire signed [TERM_BITS-1:0] term_a,
    input  wire signed [TERM_BITS-1:0] term_b,
    output wire        [6*M1_BITS-1:0] sums
);
  reg valid;
  reg signed [TERM_BITS-1:0] a, b;
  wire signed [M1_BITS-1:0] wide_a = {{M1_BITS - TERM_BITS{a[TERM_BITS-1]}}, a};
  wire signed [M1_BITS-1:0] wide_b = {{M1_BITS - TERM_BITS{b[TERM_BITS-1]}}, b};
  reg signed [M1_BITS-1:0] a0, a1, a2, b0, b1, b2;

  assign sums = {b2, a2, b1, a1, b0, a0};

  always @(posedge clk) begin
    valid <= term_valid && !rst;
    a     <= term_a;
    b     <= term_b;
    if (clear) begin
      {a0, a1, a2} <= 0;
      {b0, b1, b2} <= 0;
    end else if (valid) begin
      {a0, a1, a2} <= {a1, a2, a0 + wide_a};
      {b0, b1, b2} <= {b1, b2, b0 + wide_b};
    end
  end
endmodule

`resetall
