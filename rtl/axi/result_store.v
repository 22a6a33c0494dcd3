// SPDX-License-Identifier: Apache-2.0
// Result memory, double-buffered: 2 banks x 64 words of 32 bits. A frame writes the hidden bank; a group's commit makes what it wrote
// readable at once, so a reader never sees half a frame, and an aborted frame is never seen at all.
//
// Three groups by index: 0 .. MIDDLE_FIRST - 1, .. LAST_FIRST - 1, .. 63; commit has a bit for each. A commit may come with the group's last
// write or any clock later. Every word of a group must be written before its commit: a word left out shows the frame before the last one.
//
// While `verify` is high the groups all stand, and what is written again is compared with them instead: differs, a clock later.
//
// One port: writing has priority, a read answers one clock after read_valid && !read_wait, and is 0 in every other clock. So each bit
// takes one RAM128X1S (2 LUTs); a second port would double that, two RAMs and a multiplexer even more.
`resetall
`default_nettype none

module result_store #(
    parameter MIDDLE_FIRST = 3,
    parameter LAST_FIRST   = 18,  // = MIDDLE_FIRST: no middle group
    parameter VERIFY       = 1    // 0: no comparison
) (
    input  wire        clk,
    input  wire        rst,
    // the core: one word a clock
    input  wire        write_valid,
    input  wire [ 5:0] write_index,
    input  wire [31:0] write_data,
    input  wire [ 2:0] commit,        // pulses: last, middle, first group
    input  wire        verify,
    output reg         differs,       // pulse
    // the register file
    input  wire        read_valid,
    input  wire [ 5:0] read_index,
    output wire        read_wait,     // hold read_valid and read_index
    output reg  [31:0] read_data
);

  (* ram_style = "distributed" *)
  reg [31:0] memory[0:127];

  integer i;
  initial for (i = 0; i < 128; i = i + 1) memory[i] = 32'd0;

  wire [2:0] bank;  // readable one of each group
  voted_register #(
      .WIDTH(3),
      .RESET(3'd0)
  ) banks (
      .clk(clk),
      .rst(rst),
      .d  (bank ^ commit),
      .q  (bank)
  );

  // each port's bank is looked up for itself, so that write_valid only selects
  wire write_bank = write_index < MIDDLE_FIRST ? bank[0] : write_index < LAST_FIRST ? bank[1] : bank[2];
  wire read_bank = read_index < MIDDLE_FIRST ? bank[0] : read_index < LAST_FIRST ? bank[1] : bank[2];
  wire compare = VERIFY != 0 && verify;
  wire [6:0] address = write_valid ? {write_bank == compare, write_index} : {read_bank, read_index};

  assign read_wait = write_valid;

  always @(posedge clk) begin
    if (write_valid && !compare) memory[address] <= write_data;
    read_data <= read_valid && !write_valid ? memory[address] : 32'd0;
    differs <= compare && write_valid && memory[address] != write_data && !rst;
  end

endmodule

`resetall
