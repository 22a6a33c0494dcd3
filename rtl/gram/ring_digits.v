// SPDX-License-Identifier: Apache-2.0
// The operand x = {both, high, low} of a weighted component v = v2 2^32 + v1 2^16 + v0 (weighted_value) in the two passes of a row (no clock):
//   pass 0: (v1 + v0, v1, v0)      pass 1: (v2, v2, v2)
// One adder for both: v1 + v0, or biased[47:32] + biased[31], which is v2.
`resetall
`default_nettype none

module ring_digits (
    input  wire        second,
    input  wire [47:0] biased,
    output wire [48:0] x
);
  wire signed [15:0] first = second ? biased[47:32] : biased[31:16];
  wire signed [15:0] added = second ? {15'd0, biased[31]} : {~biased[15], biased[14:0]};
  wire signed [16:0] both = first + added;

  assign x = {both, second ? both[15:0] : first, second ? both[15:0] : added};
endmodule

`resetall
