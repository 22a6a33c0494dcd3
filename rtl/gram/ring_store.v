// SPDX-License-Identifier: Apache-2.0
// The fabric part of a ring of accumulators: DEPTH registers between a mac_cell's sum and its addend, moved together with them.
// With the cell's own two (sum and addend) the ring keeps DEPTH + 2 accumulators.
`resetall
`default_nettype none

module ring_store #(
    parameter BITS  = 48,
    parameter DEPTH = 1
) (
    input  wire            clk,
    input  wire            clear,
    input  wire            advance,
    input  wire [BITS-1:0] from_sum,
    output wire [BITS-1:0] to_addend
);
  reg [DEPTH*BITS-1:0] ring;  // newest lowest

  assign to_addend = ring[DEPTH*BITS-1-:BITS];

  generate
    if (DEPTH == 1) begin : g_one
      always @(posedge clk)
        if (clear) ring <= 0;
        else if (advance) ring <= from_sum;
    end else begin : g_more
      always @(posedge clk)
        if (clear) ring <= 0;
        else if (advance) ring <= {ring[(DEPTH-1)*BITS-1:0], from_sum};
    end
  endgenerate
endmodule

`resetall
