// SPDX-License-Identifier: Apache-2.0
// Exact signed product of two 35-bit mantissas on four DSP multipliers.
//
//   x = xh 2^17 + xl, xh signed 18 bits, xl unsigned 17 bits (as an 18-bit signed operand its top bit is 0)
//   product = xh yh 2^34 + (xh yl + xl yh) 2^17 + xl yl, 70 bits signed
//
// cycle | 0 operands      | 1 x_r, y_r | 2 partial products | 3 product
// Latency: product is valid 3 clocks after the operands are presented. No reset: a pipeline of data.
`resetall
`default_nettype none
module product_tile (
    input  wire               clk,
    input  wire signed [34:0] x,
    input  wire signed [34:0] y,
    output wire signed [69:0] product
);
  reg signed [17:0] x_high, y_high, x_low, y_low;
  reg signed [35:0] high_high, high_low, low_high;
  reg [33:0] low_low;
  reg signed [69:0] sum;

  // xh yl + xl yh < 2^36 in magnitude: 37 bits signed.
  wire signed [36:0] middle = high_low + low_high;

  always @(posedge clk) begin
    x_high    <= x[34:17];
    x_low     <= {1'b0, x[16:0]};
    y_high    <= y[34:17];
    y_low     <= {1'b0, y[16:0]};
    high_high <= x_high * y_high;
    high_low  <= x_high * y_low;
    low_high  <= x_low * y_high;
    low_low   <= x_low[16:0] * y_low[16:0];
    // low_low < 2^34 fills the bits below high_high exactly: one adder joins the middle.
    sum       <= $signed({high_high, low_low}) + $signed({{16{middle[36]}}, middle, 17'd0});
  end

  assign product = sum;
endmodule
`resetall
