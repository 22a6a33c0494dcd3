// SPDX-License-Identifier: Apache-2.0
// Reads the sums out, 21 clocks without a gap, and leaves the rings as it found them. The traces come first, because the solve engine's
// common scale waits for them; the next lanes' slots follow in the order of their rings, 0 2 1.
//
// clock (start = -2)   -1  0  1  2  3  4  5  6  7  8  9 10 11 12 13 14 15 16 17 18 19 20
// lane                     0  1  2  0  1  2  0  1  2  3  4  5  6  3  4  5  6  3  4  5  6      reading: the lane's sums are at the ring's head
// slot                     0  0  0  1  1  1  2  2  2  0  0  0  0  2  2  2  2  1  1  1  1
// own_rotate            1        1        1                                                    (one turn each, the third is home)
// next_rotate                                      1           1           1
//
// In the WEIGHTED build the low cells keep their sums in a memory, read at `*_address` = {set, slot}: set 0 a clock before the ring turns
// (it travels through addend and sum like a ring's), set 1 in the clock of the turn, kept by the lane (`top_load` is the turn).
// Not to be started while it runs, or while beats come.
`resetall
`default_nettype none

module gram_drain (
    input  wire       clk,
    input  wire       rst,
    input  wire       clear,
    input  wire       start,
    output wire       own_rotate,
    output wire [2:0] own_address,
    output wire       next_rotate,
    output wire [2:0] next_address,
    output wire       reading,
    output wire       reading_last,
    output reg  [1:0] slot,
    output reg  [2:0] lane,
    output reg  [1:0] high_select   // lane_select's `high`; `low` is lane[1:0]
);
  reg prepare;
  reg busy;
  reg [1:0] own_slot, next_slot;  // to be turned to

  wire own = busy && lane < 3'd3;
  wire next = busy && lane >= 3'd3;
  wire own_ends = own && lane == 3'd2;
  wire next_ends = next && lane == 3'd6;

  assign reading = busy;
  assign reading_last = next_ends && slot == 2'd1;
  assign own_rotate = prepare || (own_ends && slot != 2'd2);
  assign own_address = {!(start || (own && lane == 3'd1)), own_slot};
  assign next_rotate = (own_ends && slot == 2'd2) || (next_ends && slot != 2'd1);
  assign next_address = {!((own && lane == 3'd1) || (next && lane == 3'd5)), next_slot};

  always @(posedge clk) begin
    prepare <= start;
    if (prepare) busy <= 1'b1;
    else if (reading_last) busy <= 1'b0;
    if (own_rotate) own_slot <= own_slot == 2'd2 ? 2'd0 : own_slot + 2'd1;
    if (next_rotate) next_slot <= next_slot == 2'd0 ? 2'd2 : next_slot - 2'd1;
    if (busy) begin
      lane <= own_ends && slot != 2'd2 ? 3'd0 : next_ends ? (slot == 2'd1 ? 3'd0 : 3'd3) : lane + 3'd1;
      if (own_ends) slot <= slot == 2'd2 ? 2'd0 : slot + 2'd1;
      if (next_ends) slot <= slot == 2'd0 ? 2'd2 : slot == 2'd2 ? 2'd1 : 2'd0;
      // Slot 2 has its first component in y: lanes 5 and 6 trade places.
      case (lane)
        3'd3: high_select <= 2'd1;
        3'd4: high_select <= slot == 2'd2 ? 2'd3 : 2'd2;
        3'd5: high_select <= slot == 2'd2 ? 2'd2 : 2'd3;
        default: high_select <= 2'd0;
      endcase
    end
    if (rst || clear) begin
      prepare     <= 1'b0;
      busy        <= 1'b0;
      lane        <= 3'd0;
      slot        <= 2'd0;
      own_slot    <= 2'd0;
      next_slot   <= 2'd0;
      high_select <= 2'd0;
    end
  end
endmodule

`resetall
