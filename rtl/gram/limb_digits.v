// SPDX-License-Identifier: Apache-2.0
// Splits an input u into two signed limbs and shifts it by -2^15 (no clock):
//   u - 2^15 = high * 2^16 + low,   operand = {both, high, low},   both = high + low (17 bits)
// Central moments do not notice the shift; first moments are those of the shifted value (33 bits).
`resetall
`default_nettype none

module limb_digits (
    input  wire        [31:0] component,
    output wire        [48:0] operand,
    output wire signed [32:0] shifted
);
  wire signed [15:0] high = component[31:16];
  wire signed [15:0] low = {~component[15], component[14:0]};
  wire signed [16:0] both = high + low;
  wire signed [16:0] upper = high + $signed({17{low[15]}});  // low's sign bits reach into the upper half

  assign operand = {both, high, low};
  assign shifted = {upper, low};
endmodule

`resetall
