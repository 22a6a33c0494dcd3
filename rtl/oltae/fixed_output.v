// SPDX-License-Identifier: Apache-2.0
// Q15.16 of a lane's sum whose unit is 2^-17: rounded half up, saturated to 32 bits.
//
// `above` says that the term lay above the accumulator; the sum then holds only its sign. Latency 1 clock.
`resetall
`default_nettype none
module fixed_output (
    input  wire               clk,
    input  wire signed [47:0] sum,
    input  wire               above,
    output reg         [31:0] fixed,
    output wire               saturates   // the sum in this clock does
);
  wire high = above | sum[47:32] != {16{sum[32]}};
  wire [31:0] rounded = sum[32:1] + {31'd0, sum[0]};
  wire carry = ~sum[47] & rounded[31];  // rounding carries out of the top only from 7fffffff.8
  assign saturates = high | carry;
  always @(posedge clk) fixed <= saturates ? {sum[47], {31{~sum[47]}}} : rounded;
endmodule
`resetall
