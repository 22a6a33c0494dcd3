// SPDX-License-Identifier: Apache-2.0
// Result memory, double-buffered: 2 banks x 64 words of 32 bits. A frame writes the hidden bank; a group's commit makes what it wrote
// readable at once, so a reader never sees half a frame, and an aborted frame is never seen at all.
//
// Groups by index: 0..2 q, 3..17 pose (q in Q15.16 with it), 18..63 all. A commit may come with the group's last write or any clock later.
// Every word of a group must be written before its commit: a word left out shows the frame before the last one.
//
// One port: writing has priority, a read answers one clock after read_valid && !read_wait, and is 0 in every other clock. So each bit
// takes one RAM128X1S (2 LUTs); a second port would double that, two RAMs and a multiplexer even more.
`resetall
`default_nettype none

module result_store (
    input  wire        clk,
    input  wire        rst,
    // the core: one word a clock
    input  wire        write_valid,
    input  wire [ 5:0] write_index,
    input  wire [31:0] write_data,
    input  wire        q_commit,      // pulses
    input  wire        pose_commit,
    input  wire        all_commit,
    // the register file
    input  wire        read_valid,
    input  wire [ 5:0] read_index,
    output wire        read_wait,     // hold read_valid and read_index
    output reg  [31:0] read_data
);

  localparam POSE_FIRST = 3, ALL_FIRST = 18;

  (* ram_style = "distributed" *)
  reg [31:0] memory[0:127];

  integer i;
  initial for (i = 0; i < 128; i = i + 1) memory[i] = 32'd0;

  // readable bank of each group
  reg q_bank, pose_bank, all_bank;

  wire [5:0] index = write_valid ? write_index : read_index;
  wire readable = index < POSE_FIRST ? q_bank : index < ALL_FIRST ? pose_bank : all_bank;
  wire [6:0] address = {readable ^ write_valid, index};

  assign read_wait = write_valid;

  always @(posedge clk) begin
    if (write_valid) memory[address] <= write_data;
    read_data <= read_valid && !write_valid ? memory[address] : 32'd0;
    q_bank    <= q_bank ^ q_commit;
    pose_bank <= pose_bank ^ pose_commit;
    all_bank  <= all_bank ^ all_commit;
    if (rst) begin
      q_bank    <= 1'b0;
      pose_bank <= 1'b0;
      all_bank  <= 1'b0;
    end
  end

endmodule

`resetall
