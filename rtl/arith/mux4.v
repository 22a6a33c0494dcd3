// SPDX-License-Identifier: Apache-2.0
// Four-way multiplexer, one 6-input LUT a bit.
//
// Kept apart so that it stays one: in a shifter the mapper would share 2:1 halves among the bits and take a third more.
`resetall
`default_nettype none
(* keep_hierarchy *)
module mux4 #(
    parameter WIDTH = 1
) (
    input  wire [      1:0] select,
    input  wire [WIDTH-1:0] in_0,
    input  wire [WIDTH-1:0] in_1,
    input  wire [WIDTH-1:0] in_2,
    input  wire [WIDTH-1:0] in_3,
    output wire [WIDTH-1:0] out
);
  assign out = select[1] ? (select[0] ? in_3 : in_2) : select[0] ? in_1 : in_0;
endmodule
`resetall
