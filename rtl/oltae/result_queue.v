// SPDX-License-Identifier: Apache-2.0
// Results of the lanes to the result memory, one a clock: lane 0 alone, or the rows 1 to 3 from the lanes 1 to 3, as binary32.
//
// cycle 7 of a dot product: the results enter | 8 first one rounded | 9 first word out, the others after it
// `mark` leaves with the last word. The schedule keeps two dot products' words apart.
`resetall
`default_nettype none
module result_queue (
    input  wire        clk,
    input  wire        rst,
    input  wire        enter,
    input  wire [ 2:0] places,      // {lane 3, lane 2, lane 1}, or 1 with `single`
    input  wire        single,      // lane 0
    input  wire        column,      // words are 3 apart, not 1
    input  wire [ 5:0] index,       // of the first place
    input  wire [ 2:0] mark,
    input  wire [47:0] result_0,
    input  wire [47:0] result_1,
    input  wire [47:0] result_2,
    input  wire [47:0] result_3,
    output reg         valid,
    output reg  [ 5:0] word_index,
    output reg  [ 2:0] word_mark,
    output wire [31:0] word
);
  reg [47:0] waiting_1, waiting_2;
  reg [2:0] pending;
  reg [5:0] next_index;
  reg by_column;
  reg [2:0] last_mark;
  wire [47:0] head = !enter ? waiting_1 : single ? result_0 : result_1;

  to_binary32 pack (
      .clk(clk),
      .value(head),
      .binary32(word)
  );

  always @(posedge clk) begin
    if (enter) begin
      waiting_1  <= result_2;
      waiting_2  <= result_3;
      pending    <= places;
      next_index <= index;
      by_column  <= column;
      last_mark  <= mark;
    end else begin
      waiting_1  <= waiting_2;
      pending    <= pending >> 1;
      next_index <= next_index + (by_column ? 6'd3 : 6'd1);
    end
    valid      <= pending[0];
    word_index <= next_index;
    word_mark  <= pending == 3'b001 ? last_mark : 3'd0;
    if (rst) {pending, valid} <= 4'd0;
  end
endmodule
`resetall
