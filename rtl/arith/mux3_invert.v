// SPDX-License-Identifier: Apache-2.0
// Three-way multiplexer with a complement, one 6-input LUT a bit. Kept apart for the reason given in mux4.
`resetall
`default_nettype none
(* keep_hierarchy *)
module mux3_invert #(
    parameter WIDTH = 1
) (
    input  wire [      1:0] select,  // 0, 1 or 2
    input  wire             invert,
    input  wire [WIDTH-1:0] in_0,
    input  wire [WIDTH-1:0] in_1,
    input  wire [WIDTH-1:0] in_2,
    output wire [WIDTH-1:0] out
);
  assign out = (select[1] ? in_2 : select[0] ? in_1 : in_0) ^ {WIDTH{invert}};
endmodule
`resetall
