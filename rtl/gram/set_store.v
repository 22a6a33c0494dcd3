// SPDX-License-Identifier: Apache-2.0
// Accumulators of a mac_cell in LUTRAM: 2^ADDRESS_BITS of them, one written and one read in a clock; the read is asynchronous.
// Not cleared: the first use of an accumulator reads zero instead (mac_cell's addend_clear).
`resetall
`default_nettype none

module set_store #(
    parameter BITS         = 48,
    parameter ADDRESS_BITS = 3
) (
    input  wire                    clk,
    input  wire                    write,
    input  wire [ADDRESS_BITS-1:0] write_address,
    input  wire [        BITS-1:0] from_sum,
    input  wire [ADDRESS_BITS-1:0] read_address,
    output wire [        BITS-1:0] to_addend
);
  (* ram_style = "distributed" *) reg [BITS-1:0] accumulators[0:(1<<ADDRESS_BITS)-1];

  always @(posedge clk) if (write) accumulators[write_address] <= from_sum;
  assign to_addend = accumulators[read_address];
endmodule

`resetall
