// SPDX-License-Identifier: Apache-2.0
// Exact signed product of two 35-bit mantissas on four DSP multipliers.
//
//   x = xh 2^17 + xl, xh signed 18 bits, xl unsigned 17 bits (as an 18-bit signed operand its top bit is 0)
//   product = xh yh 2^34 + (xh yl + xl yh) 2^17 + xl yl, 70 bits signed
//
// cycle | 0 operands      | 1 x_r, y_r | 2 partial products | 3 product
// Latency: product is valid 3 clocks after the operands are presented. No reset: a pipeline of data.
// Each partial sum is one product plus the part of the previous sum above its low 17 bits: the DSP48E1's own adder.
`resetall
`default_nettype none
module product_tile (
    input  wire               clk,
    input  wire signed [34:0] x,
    input  wire signed [34:0] y,
    output wire signed [69:0] product
);
  reg signed [17:0] x_high, y_high, x_low, y_low;
  reg signed [35:0] low_low, high_low, low_high, high_high, top;
  reg [33:0] bottom;

  // |xh yl| + |xl yh| + xl yl / 2^17 < 2^35 + 2^17: 37 bits signed.
  wire signed [36:0] low_carry = {{18{low_low[35]}}, low_low[35:17]};
  wire signed [36:0] middle_1 = high_low + low_carry;
  wire signed [36:0] middle = low_high + middle_1;
  wire signed [35:0] middle_carry = {{16{middle[36]}}, middle[36:17]};

  always @(posedge clk) begin
    x_high    <= x[34:17];
    x_low     <= {1'b0, x[16:0]};
    y_high    <= y[34:17];
    y_low     <= {1'b0, y[16:0]};
    low_low   <= x_low * y_low;
    high_low  <= x_high * y_low;
    low_high  <= x_low * y_high;
    high_high <= x_high * y_high;
    bottom    <= {middle[16:0], low_low[16:0]};
    top       <= high_high + middle_carry;
  end

  assign product = {top, bottom};
endmodule
`resetall
