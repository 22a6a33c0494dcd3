// SPDX-License-Identifier: Apache-2.0
// Pairs the three beats of a point: `own` lanes multiply a beat by itself, `next` lanes a beat by its neighbour.
// Operands without multiplexers: the factor registers are the cells' own, filled at the right clock by their enables.
//   own : x = y = the beat that comes                 slots 0, 1, 2 with beats 0, 1, 2
//   next: x = held (the beat before, never beat 2), y = the beat that comes (never beat 0)
//         beat 1 comes:  x = beat 0, y = beat 1       slot 0
//         beat 2 comes:  x stays,    y = beat 2       slot 2 (x is its second component, y its first)
//         one clock on:  x = beat 1, y stays          slot 1, while the next point's beat 0 may come
//
// clock          0      1      2      3      4
// beat           0      1      2      0'     1'
// held                  0      1      1      0'
// next factors                 0,1    0,2    1,2      -> order 0, 2, 1
// own factors           0      1      2      0'
//
// Only a first beat may come at `clear`; what was under way is forgotten.
`resetall
`default_nettype none

module component_window (
    input  wire        clk,
    input  wire        rst,
    input  wire        clear,
    input  wire        beat,
    input  wire [ 1:0] beat_index,
    input  wire        beat_set,          // second pass of a weighted point
    input  wire        beat_fresh,        // first point of the frame
    input  wire [97:0] beat_x,            // {b, a}, each {both, high, low}
    // own lanes
    output reg         own_valid,
    output reg         own_fresh,
    output reg  [ 2:0] own_address,       // {set, slot}
    // next lanes
    output reg  [97:0] held,
    output wire        next_load_x,
    output wire        next_load_y,
    output reg         next_valid,
    output reg         next_fresh,
    output reg  [ 2:0] next_address
);
  reg trailing;  // beat 2 came a clock ago: slot 1 is due

  assign next_load_x = (beat && beat_index == 2'd1) || trailing;
  assign next_load_y = beat && beat_index != 2'd0;

  always @(posedge clk) begin
    if (beat && beat_index != 2'd2) held <= beat_x;
    trailing    <= beat && beat_index == 2'd2 && !rst;
    own_valid   <= beat && !rst;
    own_fresh   <= beat_fresh;
    own_address <= {beat_set, beat_index};
    next_valid  <= (next_load_y || (trailing && !clear)) && !rst;
    if (trailing) begin
      next_fresh   <= own_fresh;
      next_address <= {own_address[2], 2'd1};
    end else begin
      next_fresh   <= beat_fresh;
      next_address <= {beat_set, beat_index[1], 1'b0};  // beat 1: slot 0, beat 2: slot 2
    end
  end
endmodule

`resetall
