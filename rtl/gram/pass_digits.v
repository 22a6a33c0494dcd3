// SPDX-License-Identifier: Apache-2.0
// The operands {both, high, low} of one component in the two passes of a weighted point (no clock), v = v2 2^32 + v1 2^16 + v0 the weighted
// value, h, l the limbs of the plain one:
//   pass 0: x = (v1 + v0, v1, v0)   y = (h + l, h, l)
//   pass 1: x = (v2, v2, v2)        y = (l, l, h)        of the beat three beats before
// so that  high += v1 h + v2 l,  both += (v1 + v0)(h + l) + v2 l,  low += v0 l,  low's second set += v2 h:  both - high - low is the middle
// sum as ever, high weighs 2^32 and the second set 2^48.
`resetall
`default_nettype none

module pass_digits (
    input  wire        second,
    input  wire [31:0] biased,       // weighted_value's, without v2
    input  wire [31:0] limbs,        // {h, l}
    input  wire [15:0] past_digit,   // v2 three beats before
    input  wire [31:0] past_limbs,
    output wire [48:0] x,
    output wire [48:0] y
);
  wire signed [15:0] x_high = second ? past_digit : biased[31:16];
  wire signed [15:0] x_low = second ? past_digit : {~biased[15], biased[14:0]};
  wire signed [15:0] x_rest = second ? 16'sd0 : x_low;
  wire signed [16:0] x_both = x_high + x_rest;

  wire signed [15:0] y_high = second ? past_limbs[15:0] : limbs[31:16];
  wire signed [15:0] y_low = second ? past_limbs[31:16] : limbs[15:0];
  wire signed [15:0] y_rest = second ? 16'sd0 : y_low;
  wire signed [16:0] y_both = y_high + y_rest;

  assign x = {x_both, x_high, x_low};
  assign y = {y_both, y_high, y_low};
endmodule

`resetall
