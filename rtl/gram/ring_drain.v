// SPDX-License-Identifier: Apache-2.0
// Reads the sums of the ring's seven lanes out, one a clock for 28 clocks, in the order of `DRAIN_ORDER` of sw/relnav/model/gram_ring.py:
// row 0 first, then rows roughly ascending, no lane twice in a row. Item (i, j) is slot j - i modulo 7 of lane i where that is 3 or less,
// else slot i - j modulo 7 of lane j. A lane's slots come in the order of its ring: lanes 0 to 3 from slot 0, lane 4 from 3, 5 from 2, 6 from 1.
//
// clock (start = -4)   -3  -2  -1   0   1   2   3   4 ... 25  26  27
// item                  0   1   2   3   4   5   6   7                     looked up
// fetch                     0   1   2   3   4   5   6     27              its lane's memory shows set 0
// turn                          0   1   2   3   4   5     26  27          its lane's ring turns, and its memory shows set 1 (`top`)
// reading                           0   1   2   3   4     25  26  27      its sums are at the ring's head
// turns beyond those            6
//                               5   5
//                               4   4   4                                 lanes whose first slot is not the first of the ring
//
// The last step's sums are at the heads in clock -1 at the latest. Not to be started while it runs, or while rows come. It may be started
// again: then every lane's ring stands where its first turn leads to its first slot, and those turns fall away.
`resetall
`default_nettype none

module ring_drain (
    input  wire        clk,
    input  wire        rst,
    input  wire        clear,
    input  wire        start,
    output wire [ 6:0] rotate,
    output wire [20:0] address,      // {set, slot} of each lane's memory
    output wire [ 1:0] turn_low,     // lane_select's `low` and `high` for the lane that turns
    output reg  [ 1:0] turn_high,
    output reg         reading,
    output reg         reading_last,
    output reg  [ 2:0] row,
    output reg  [ 2:0] column,
    output wire [ 1:0] read_low,     // lane_select's for the lane that is read
    output reg  [ 1:0] read_high
);
  // ---- item
  reg looking;
  reg turned;  // the lanes' rings begin with the first slot of each
  reg [4:0] item;
  reg [5:0] item_pair;  // {row, column}

  always @*
    case (item)
      5'd0: item_pair = 6'o00;
      5'd1: item_pair = 6'o06;
      5'd2: item_pair = 6'o01;
      5'd3: item_pair = 6'o05;
      5'd4: item_pair = 6'o02;
      5'd5: item_pair = 6'o04;
      5'd6: item_pair = 6'o03;
      5'd7: item_pair = 6'o11;
      5'd8: item_pair = 6'o16;
      5'd9: item_pair = 6'o12;
      5'd10: item_pair = 6'o15;
      5'd11: item_pair = 6'o13;
      5'd12: item_pair = 6'o22;
      5'd13: item_pair = 6'o14;
      5'd14: item_pair = 6'o26;
      5'd15: item_pair = 6'o23;
      5'd16: item_pair = 6'o33;
      5'd17: item_pair = 6'o24;
      5'd18: item_pair = 6'o34;
      5'd19: item_pair = 6'o25;
      5'd20: item_pair = 6'o35;
      5'd21: item_pair = 6'o44;
      5'd22: item_pair = 6'o36;
      5'd23: item_pair = 6'o45;
      5'd24: item_pair = 6'o55;
      5'd25: item_pair = 6'o46;
      5'd26: item_pair = 6'o56;
      default: item_pair = 6'o66;
    endcase

  wire [2:0] distance = item_pair[2:0] - item_pair[5:3];
  wire wraps = distance[2];  // 4 to 6: the pair is lane column's
  wire [2:0] item_lane = wraps ? item_pair[2:0] : item_pair[5:3];

  // ---- fetch, turn, reading
  reg fetching, fetch_last, turning, turn_last;
  reg [5:0] fetch_pair, turn_pair;
  reg [2:0] fetch_lane;
  reg [1:0] fetch_slot, turn_slot, turn_lane, read_lane;
  reg [6:0] turns;  // turn's lane, one bit

  assign turn_low = turn_lane;
  assign read_low = read_lane;

  always @(posedge clk) begin
    if (start) looking <= 1'b1;
    else if (item == 5'd27) looking <= 1'b0;
    if (start) item <= 5'd0;
    else if (looking) item <= item + 5'd1;
    if (item == 5'd27) turned <= 1'b1;

    fetching      <= looking;
    fetch_last    <= looking && item == 5'd27;
    fetch_pair    <= item_pair;
    fetch_lane    <= item_lane;
    fetch_slot    <= wraps ? ~distance[1:0] : distance[1:0];  // 7 - distance

    turning       <= fetching;
    turn_last     <= fetch_last;
    turn_pair     <= fetch_pair;
    turn_slot     <= fetch_slot;
    turns         <= fetching ? 7'd1 << fetch_lane : 7'd0;
    turn_lane     <= fetch_lane[1:0];
    turn_high     <= fetch_lane[2] ? fetch_lane[1:0] + 2'd1 : 2'd0;

    reading       <= turning;
    reading_last  <= turn_last;
    {row, column} <= turn_pair;
    read_lane     <= turn_lane;
    read_high     <= turn_high;
    if (rst || clear) begin
      looking  <= 1'b0;
      fetching <= 1'b0;
      turning  <= 1'b0;
      turns    <= 7'd0;
      reading  <= 1'b0;
      item     <= 5'd0;
      turned   <= 1'b0;
    end
  end

  // ---- lanes
  wire second = item == 5'd2, third = item == 5'd3, fourth = item == 5'd4;
  wire [6:0] further = {second, second || third, second || third || fourth, 4'd0};
  assign rotate = turns | (turned ? 7'd0 : further);

  genvar lane;
  generate
    for (lane = 0; lane < 7; lane = lane + 1) begin : g_lane
      assign address[3*lane+:3] = turns[lane] ? {1'b1, turn_slot} : {1'b0, fetch_slot};
    end
  endgenerate
endmodule

`resetall
