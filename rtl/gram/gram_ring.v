// SPDX-License-Identifier: Apache-2.0
// Exact sums of a frame of rows [h0 .. h5 y] with weights: a systolic ring of 7 lanes, 28 products a row in four slots.
//   G_ij = sum w u_i u_j,   u = [h0 h1 h2 h3 h4 h5 y]  (components 0 .. 6)
// Lane i keeps component i times the weight, the components themselves go round: in slot s = 0..3 lane i multiplies (i, i + s modulo 7).
// Two passes a row: with the two lower 16-bit digits of the weighted component, then with its highest (ring_digits, operand_ring).
//
//   in : four beats a row, {h1,h0} {h3,h2} {h5,h4} {w,y} ({high, low 32 bits}; w in bits 47:32, 63:48 ignored); gaps anywhere. beat_ready falls
//        for 4 clocks after a row's last beat: one row in 8 clocks.
//   out: after the beat with beat_last 28 items in 28 consecutive clocks, in the order of ring_drain; item_moment is exact.
//        row_count, used_count (rows whose weight is not 0), weight_sum; h_bits, y_bits, weight_bits (range_bits).
//
// Latency, clock 0 = the last beat is accepted (however the beats before it came):
//   weight_sum, row_count, used_count right from    1
//   h_bits, y_bits, weight_bits right from          6
//   first item_valid                               20
//   item_last                                      47
//   checked                                        68
//   redrain at clock 0 -> first item_valid          7
// All but the items hold until clear.
//
// clock          0     1     2     3     4     5     6     7     8     9     10    11    12    13    14    15    16    17    18    19    20
// beat           3
// pair                 0     1     2     3     0*    1*    2*    3*      * : pass 1
// weighted                         0     1     2     3     0*    1*    2*    3*
// slot (factors)                                           0     1     2     3     0*    1*    2*    3*
// sum                                                                  0     1     2     3     0*    1*    2*    3*
// first item                                                                                   start look  fetch turn  read  +     +     item
//
// Widths (LIMB 2^16, n <= 65535 rows): u = h 2^16 + l with |l| <= 2^15 and |h| <= 2^15 (h = 2^15 occurs: 17 bits), weighted digits |v| <= 2^15. So a
// row adds at most 2 * 2^30 to `high` (v1 h + v2 l), 2^30 to `low` and to its second set: below 2^47 in magnitude over a frame. `both` may wrap;
// both - high - low is right modulo 2^48 and truly sum v1 l + v0 h, at most 65535 * 2 * 2^30, so recombine's proof holds as it stands.
// |G_ij| <= 65535^2 * 2^62 < 2^94.
//
// CHECK: moment_check compares what leaves with the beats, at every drain that is given with `check`. It watches only.
//
// rst does what clear does. clear (before or with a frame's first beat, in any clock) forgets everything, also a half-given row, or a drain: its
// items end with that clock. Beats may not come between beat_last and the next clear.
`resetall
`default_nettype none

module gram_ring #(
    parameter CHECK = 1  // 0: no moment_check, `checked` and `mismatch` stay 0
) (
    input  wire               clk,
    input  wire               rst,
    input  wire               clear,
    // beats
    input  wire               beat_valid,
    output wire               beat_ready,
    input  wire        [63:0] beat_data,
    input  wire        [ 1:0] beat_index,
    input  wire               beat_last,
    // items
    input  wire               redrain,        // give them again
    output reg                item_valid,
    output reg         [ 2:0] item_row,     // row <= column
    output reg         [ 2:0] item_column,
    output reg                item_last,
    output wire signed [95:0] item_moment,
    // of the frame
    output wire        [31:0] weight_sum,
    output wire        [15:0] row_count,
    output wire        [15:0] used_count,
    output wire        [ 5:0] h_bits,
    output wire        [ 5:0] y_bits,
    output wire        [ 5:0] weight_bits,
    // check of what leaves against the beats: items and weight_sum
    input  wire               check,          // this drain's items are to be checked
    output wire               checked,        // pulse: 21 clocks after item_last
    output wire               mismatch,       // pulse, in the same clock
    output wire               differ            // a counter or a range had an upset: one clock or more
);
  wire restart = rst || clear;

  // ---- rows
  wire row, pair_valid, pair_second, pair_last;
  wire [1:0] pair_index;
  wire [63:0] pair;
  wire [15:0] weight;

  row_beats u_beats (
      .clk(clk),
      .rst(rst),
      .clear(clear),
      .beat_valid(beat_valid),
      .beat_ready(beat_ready),
      .beat_data(beat_data),
      .beat_index(beat_index),
      .beat_last(beat_last),
      .row(row),
      .pair_valid(pair_valid),
      .pair_second(pair_second),
      .pair_index(pair_index),
      .pair_last(pair_last),
      .pair(pair),
      .weight(weight)
  );

  wire count_differs, range_differs;
  assign differ = count_differs || range_differs;

  point_counter u_counter (
      .clk(clk),
      .rst(rst),
      .clear(clear),
      .point(row),
      .weight(beat_data[47:32]),
      .weight_sum(weight_sum),
      .count(row_count),
      .used(used_count),
      .differ(count_differs)
  );

  range_bits u_ranges (
      .clk(clk),
      .rst(rst),
      .clear(clear),
      .pair_valid(pair_valid),
      .pair_y(pair_index == 2'd3),
      .pair(pair),
      .weight_sum(weight_sum),
      .h_bits(h_bits),
      .y_bits(y_bits),
      .weight_bits(weight_bits),
      .differ(range_differs)
  );

  // ---- operands: x on two buses, y in the ring
  reg valid_1, valid_2, second_1, second_2, last_1, last_2;
  reg [1:0] index_1, index_2;

  always @(posedge clk) begin
    {second_1, second_2} <= {pair_second, second_1};
    {index_1, index_2}   <= {pair_index, index_1};
    {last_1, last_2}     <= {pair_last, last_1};
    {valid_1, valid_2}   <= {pair_valid, valid_1};
    if (restart) {valid_1, valid_2} <= 2'b0;
  end

  wire [47:0] biased_a, biased_b;
  wire [48:0] x_a, x_b;
  wire [7*51-1:0] y;

  weighted_value #(
      .SHIFT(0)
  ) u_value_a (
      .clk(clk),
      .weight(weight),
      .component(pair[31:0]),
      .biased(biased_a)
  );
  weighted_value #(
      .SHIFT(0)
  ) u_value_b (
      .clk(clk),
      .weight(weight),
      .component(pair[63:32]),
      .biased(biased_b)
  );
  ring_digits u_digits_a (
      .second(second_2),
      .biased(biased_a),
      .x(x_a)
  );
  ring_digits u_digits_b (
      .second(second_2),
      .biased(biased_b),
      .x(x_b)
  );
  operand_ring u_operands (
      .clk(clk),
      .second(pair_second),
      .pair(pair),
      .load(index_1 == 2'd3),
      .y(y)
  );

  // ---- slots: four clocks from the pass's last pair on
  wire [3:0] arrives = 4'd1 << index_2;
  wire load = valid_2 && index_2 == 2'd3;
  reg slot_valid, slot_set, slot_fresh, slot_last, first_row;
  reg [1:0] slot;

  always @(posedge clk) begin
    if (load) begin
      slot_valid <= 1'b1;
      slot       <= 2'd0;
      slot_set   <= second_2;
      slot_fresh <= first_row;
      slot_last  <= last_2 && second_2;
      first_row  <= first_row && !second_2;
    end else begin
      slot <= slot + 2'd1;
      if (slot == 2'd3) slot_valid <= 1'b0;
    end
    if (restart) begin
      slot_valid <= 1'b0;
      first_row  <= 1'b1;
    end
  end

  // ---- lanes
  wire [6:0] rotate, accumulate;
  wire [20:0] drain_address, read_address;
  wire skip, fresh, write;
  wire [2:0] write_address;
  wire [7*48-1:0] high, low, both, top;

  lane_control #(
      .LANES(7)
  ) u_control (
      .clk(clk),
      .rst(rst),
      .clear(clear),
      .slot_valid(slot_valid),
      .slot_fresh(slot_fresh),
      .slot_address({slot_set, slot}),
      .rotate(rotate),
      .drain_address(drain_address),
      .skip(skip),
      .fresh(fresh),
      .accumulate(accumulate),
      .write(write),
      .write_address(write_address),
      .read_address(read_address)
  );

  genvar lane;
  generate
    for (lane = 0; lane < 7; lane = lane + 1) begin : g_lane
      gram_lane #(
          .WEIGHTED(1),
          .SLOTS(4),
          .Y_BITS(17),
          .X_HOLD(lane < 6 ? 1 : 0),
          .TOP_KEPT(0)
      ) u_lane (
          .clk(clk),
          .clear(restart),
          .hold_x(arrives[lane/2]),
          .load_x(load),
          .load_y(1'b1),
          .x(lane % 2 == 0 ? x_a : x_b),
          .y(y[51*lane+:51]),
          .skip(skip),
          .fresh(fresh),
          .accumulate(accumulate[lane]),
          .write(write),
          .write_address(write_address),
          .read_address(read_address[3*lane+:3]),
          .top_load(1'b0),
          .high(high[48*lane+:48]),
          .low(low[48*lane+:48]),
          .both(both[48*lane+:48]),
          .top(top[48*lane+:48])
      );
    end
  endgenerate

  // ---- drain
  wire reading, reading_last;
  wire [2:0] row_read, column_read;
  wire [1:0] turn_low, turn_high, read_low, read_high;

  ring_drain u_drain (
      .clk(clk),
      .rst(rst),
      .clear(clear),
      .start((slot_valid && slot_last && slot == 2'd2) || redrain),
      .rotate(rotate),
      .address(drain_address),
      .turn_low(turn_low),
      .turn_high(turn_high),
      .reading(reading),
      .reading_last(reading_last),
      .row(row_read),
      .column(column_read),
      .read_low(read_low),
      .read_high(read_high)
  );

  wire [47:0] high_read, low_read, both_read, top_turn;
  reg [47:0] top_read;

  lane_select u_select_high (
      .lanes(high),
      .low(read_low),
      .high(read_high),
      .chosen(high_read)
  );
  lane_select u_select_low (
      .lanes(low),
      .low(read_low),
      .high(read_high),
      .chosen(low_read)
  );
  lane_select u_select_both (
      .lanes(both),
      .low(read_low),
      .high(read_high),
      .chosen(both_read)
  );
  lane_select u_select_top (
      .lanes(top),
      .low(turn_low),
      .high(turn_high),
      .chosen(top_turn)
  );

  always @(posedge clk) top_read <= top_turn;

  recombine u_recombine (
      .clk(clk),
      .with_top(1'b1),
      .high(high_read),
      .low(low_read),
      .both(both_read),
      .top(top_read),
      .moment(item_moment)
  );

  // ---- what goes with a moment through recombine's three clocks
  reg item_1, item_2, end_1, end_2;
  reg [5:0] place_1, place_2;

  always @(posedge clk) begin
    {item_1, item_2, item_valid} <= {reading, item_1, item_2};
    {end_1, end_2, item_last} <= {reading && reading_last, end_1, end_2};
    {place_1, place_2, item_row, item_column} <= {row_read, column_read, place_1, place_2};
    if (restart) {item_1, item_2, item_valid, end_1, end_2, item_last} <= 6'b0;
  end

  // ---- check: after the last item the sum of the weights
  generate
    if (CHECK != 0) begin : g_check
      localparam [5:0] KEY_WEIGHT = 6'd58;
      reg weight_follows;

      always @(posedge clk) weight_follows <= item_last && check && !restart;

      moment_check #(
          .RING(1),
          .ITEM_BITS(96),
          .VALUE_BITS(33)
      ) u_check (
          .clk(clk),
          .rst(rst),
          .clear(clear),
          .beat(beat_valid && beat_ready),
          .beat_data(beat_data),
          .beat_index(beat_index),
          .beat_weight(beat_data[47:32]),
          .item_valid(item_valid && check),
          .item_key({item_row, item_column}),
          .item(item_moment),
          .value_valid(weight_follows),
          .value_key(KEY_WEIGHT),
          .value_last(1'b1),
          .value({1'b0, weight_sum}),
          .checked(checked),
          .mismatch(mismatch)
      );
    end else begin : g_no_check
      assign checked  = 1'b0;
      assign mismatch = 1'b0;
      /* verilator lint_off UNUSEDSIGNAL */
      wire unused_check = check;
      /* verilator lint_on UNUSEDSIGNAL */
    end
  endgenerate
endmodule

`resetall
