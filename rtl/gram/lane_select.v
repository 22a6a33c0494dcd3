// SPDX-License-Identifier: Apache-2.0
// 7 to 1 multiplexer of a lane sum in two LUT6 a bit (kept apart, merging costs more): lanes 0 to 3 by `low`, then that or lane 4, 5, 6 by `high`.
`resetall
`default_nettype none

(* keep_hierarchy *)
module lane_select #(
    parameter BITS = 48
) (
    input  wire [7*BITS-1:0] lanes,
    input  wire [       1:0] low,
    input  wire [       1:0] high,  // 0: lane `low`, 1 to 3: lane 4 to 6
    output wire [  BITS-1:0] chosen
);
  reg [BITS-1:0] first, second;

  always @* begin
    case (low)
      2'd0: first = lanes[0*BITS+:BITS];
      2'd1: first = lanes[1*BITS+:BITS];
      2'd2: first = lanes[2*BITS+:BITS];
      default: first = lanes[3*BITS+:BITS];
    endcase
    case (high)
      2'd0: second = first;
      2'd1: second = lanes[4*BITS+:BITS];
      2'd2: second = lanes[5*BITS+:BITS];
      default: second = lanes[6*BITS+:BITS];
    endcase
  end
  assign chosen = second;
endmodule

`resetall
