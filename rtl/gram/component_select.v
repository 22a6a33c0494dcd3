// SPDX-License-Identifier: Apache-2.0
// 6 to 1 multiplexer of the first moments (no clock), two LUT6 a bit.
`resetall
`default_nettype none

(* keep_hierarchy *)
module component_select #(
    parameter BITS = 64
) (
    input  wire [6*BITS-1:0] components,
    input  wire [       2:0] index,       // 0 to 5
    output wire [  BITS-1:0] chosen
);
  reg [BITS-1:0] first;

  always @*
    case (index[1:0])
      2'd0: first = components[0*BITS+:BITS];
      2'd1: first = components[1*BITS+:BITS];
      2'd2: first = components[2*BITS+:BITS];
      default: first = components[3*BITS+:BITS];
    endcase
  assign chosen = !index[2] ? first : index[0] ? components[5*BITS+:BITS] : components[4*BITS+:BITS];
endmodule

`resetall
