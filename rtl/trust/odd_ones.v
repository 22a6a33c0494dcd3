// SPDX-License-Identifier: Apache-2.0
// Is the number of ones odd: parity, combinational, six bits to a LUT6 in every level (of a plain reduction synthesis makes LUT4s).
//
//   odd = ^bits, WIDTH up to 216
`resetall
`default_nettype none

module odd_ones #(
    parameter WIDTH = 36
) (
    input  wire [WIDTH-1:0] bits,
    output wire             odd
);
  localparam GROUPS = (WIDTH + 5) / 6, MORE = (GROUPS + 5) / 6;
  wire [6*GROUPS-1:0] all = {{6 * GROUPS - WIDTH{1'b0}}, bits};
  wire [6*MORE-1:0] groups;
  wire [MORE-1:0] more;

  genvar i;
  generate
    for (i = 0; i < 6 * MORE; i = i + 1) begin : g_groups
      if (i < GROUPS) begin : g_used
        assign groups[i] = ^all[6*i+:6];
      end else begin : g_none
        assign groups[i] = 1'b0;
      end
    end
    for (i = 0; i < MORE; i = i + 1) begin : g_more
      assign more[i] = ^groups[6*i+:6];
    end
  endgenerate

  assign odd = ^more;

endmodule

`resetall
