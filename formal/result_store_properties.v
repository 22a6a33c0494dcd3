// SPDX-License-Identifier: Apache-2.0
// What result_store promises, for SymbiYosys (result_store.sby): a reader sees the word that was last committed, never one that was only
// written, and 0 in every clock but that after its read; with verify nothing is written, and every other word than the one read is told. One index is followed (a task for each group): `seen` is what a reader must get
// there, the other word what the frame under way has written. Every input is free in every clock. A word that a frame leaves out shows
// the frame before the last one: the core must write every word of a group before it commits.
`resetall
`default_nettype none

module result_store_properties #(
    parameter MIDDLE_FIRST = 3,
    parameter LAST_FIRST   = 18,
    parameter INDEX        = 0    // the one followed
) (
    input wire        clk,
    input wire        rst,
    input wire        write_valid,
    input wire [ 5:0] write_index,
    input wire [31:0] write_data,
    input wire [ 2:0] commit,
    input wire        verify,
    input wire        read_valid,
    input wire [ 5:0] read_index
);
  wire [5:0] index = INDEX;
  wire read_wait, differs;
  wire [31:0] read_data;

  result_store #(
      .MIDDLE_FIRST(MIDDLE_FIRST),
      .LAST_FIRST  (LAST_FIRST)
  ) dut (
      .clk(clk),
      .rst(rst),
      .write_valid(write_valid),
      .write_index(write_index),
      .write_data(write_data),
      .commit(commit),
      .verify(verify),
      .differs(differs),
      .read_valid(read_valid),
      .read_index(read_index),
      .read_wait(read_wait),
      .read_data(read_data)
  );

  // connected by the script
  wire [2:0] dut_bank;
  wire [31:0] dut_word_0, dut_word_1;

  reg started = 1'b0;
  always @(posedge clk) started <= 1'b1;
  always @* if (!started) assume (rst && !write_valid);

  // the two words of `index`, in banks 0 and 1, and which one is read
  reg [31:0] word_0 = 32'd0, word_1 = 32'd0;
  reg bank;
  wire mine = index < MIDDLE_FIRST ? commit[0] : index < LAST_FIRST ? commit[1] : commit[2];
  wire [31:0] seen = bank ? word_1 : word_0;
  always @(posedge clk) begin
    if (write_valid && !verify && write_index == index) begin
      if (bank) word_0 <= write_data;
      else word_1 <= write_data;
    end
    bank <= rst ? 1'b0 : bank ^ mine;
  end

  reg was_read, was_mine, was_compared, was_other;
  reg [31:0] expected;
  always @(posedge clk) begin
    was_read <= read_valid && !read_wait;
    was_mine <= read_index == index;
    expected <= seen;
    was_compared <= verify && write_valid && write_index == index && !rst;
    was_other <= write_data != seen;
  end

  always @(posedge clk) if (started) begin
    waits_for_writes : assert (read_wait == write_valid);
    same_bank : assert (bank == (index < MIDDLE_FIRST ? dut_bank[0] : index < LAST_FIRST ? dut_bank[1] : dut_bank[2]));
    same_words : assert (dut_word_0 == word_0 && dut_word_1 == word_1);
    if (!was_read) silent : assert (read_data == 32'd0);
    if (was_read && was_mine) committed_read : assert (read_data == expected);
    if (was_compared) difference_told : assert (differs == was_other);
    if (!$past(verify && write_valid)) no_difference : assert (!differs);
    if ($past(rst)) reset_bank : assert (dut_bank == 3'd0);
  end
endmodule

`resetall
