// SPDX-License-Identifier: Apache-2.0
// Which two of the components c0..c5 = ax bx ay by az bz a drained pair is made of (no clock), j = slot + 1 modulo 3:
//   lane 0 a_i a_i   1 b_i b_i   2 a_i b_i   3 a_i a_j   4 b_i b_j   5 b_i a_j   6 a_i b_j
`resetall
`default_nettype none

module pair_components (
    input  wire [1:0] slot,
    input  wire [2:0] lane,
    output wire [2:0] first,
    output reg  [2:0] second
);
  wire [1:0] after = slot == 2'd2 ? 2'd0 : slot + 2'd1;

  assign first = {slot, lane == 3'd1 || lane == 3'd4 || lane == 3'd5};
  always @*
    case (lane)
      3'd0: second = {slot, 1'b0};
      3'd1, 3'd2: second = {slot, 1'b1};
      3'd3, 3'd5: second = {after, 1'b0};
      default: second = {after, 1'b1};
    endcase
endmodule

`resetall
