// SPDX-License-Identifier: Apache-2.0
// Moves the lanes of one group: valid, address and first-use flag of a slot travel with its factors, product and sum.
//   clock 0: slot_valid, the factors are in the cells      skip low, read_address
//   clock 1: the product is there                          accumulate
//   clock 2: the sum is there                              write, write_address
// While no slot comes the drain moves the ring (rotate: sum <= 0 + addend) and reads at its own address: each of the group's LANES lanes
// by itself.
`resetall
`default_nettype none

module lane_control #(
    parameter LANES = 1  // that the drain moves one by one
) (
    input  wire               clk,
    input  wire               rst,
    input  wire               clear,
    // slot at the factors
    input  wire               slot_valid,
    input  wire               slot_fresh,    // first point of the frame
    input  wire [        2:0] slot_address,  // {set, slot}
    // drain
    input  wire [  LANES-1:0] rotate,
    input  wire [3*LANES-1:0] drain_address,
    // to the lanes
    output wire               skip,
    output wire               fresh,
    output wire [  LANES-1:0] accumulate,
    output reg                write,
    output reg  [        2:0] write_address,
    output wire [3*LANES-1:0] read_address
);
  reg product_valid;
  reg [2:0] product_address;

  assign skip = !slot_valid;
  assign fresh = slot_valid && slot_fresh;
  assign accumulate = {LANES{product_valid}} | rotate;
  assign read_address = slot_valid ? {LANES{slot_address}} : drain_address;

  always @(posedge clk) begin
    product_valid   <= slot_valid && !clear && !rst;
    product_address <= slot_address;
    write           <= product_valid && !clear && !rst;
    write_address   <= product_address;
  end
endmodule

`resetall
