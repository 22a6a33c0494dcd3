// SPDX-License-Identifier: Apache-2.0
// Exact first and second moments of a frame of points: a systolic array of 28 products a point (21 pairs, 6 sums, 1 count), folded onto
// 7 lanes and three clocks.   G = sum w u' u'^T,  m' = sum w u',  u' = u - 2^15,  u = [ax bx ay by az bz]
//
//   in : three beats a point, {b_k, a_k} for k = x, y, z; gaps anywhere. Unweighted one point in 3 clocks (beat_ready never falls in the
//        lean build, nor in an unweighted frame of the WEIGHTED build), weighted one in 6: beat_ready falls for 3 clocks after beat z.
//   out: after the beat with beat_last 21 pairs in 21 clocks, lanes 0 1 2 of the slots 0 1 2, then lanes 3 to 6 of the slots 0 2 1; with
//        slot i = 0..2 and j = i + 1 modulo 3:
//          lane 0 a_i a_i   1 b_i b_i   2 a_i b_i   3 a_i a_j   4 b_i b_j   5 b_i a_j   6 a_i b_j
//        with the two first moments (m') of each. redrain repeats them (from pair_last's clock on).
//
// Latency, clock 0 = the last beat is accepted:            lean   WEIGHTED build: unweighted   weighted frame
//   weight_sum, point_count right from                       1                    1                  1
//   first_moments right from                                 2                    4                  4
//   first pair_valid (slot 0, lane 0)                        7                    9                 12
//   pair_last                                               27                   29                 32
//   redrain at clock 0 -> first pair_valid                   5                    5                  5
//   value m_bz at clock 0 -> checked                        20                   20                 20
// All of them hold until clear.
//
// CHECK: moment_check compares what leaves with the beats, at every drain that is given with `check`. It watches only.
//
// clock         0      1      2      3      4      5      6      7      lean build; the WEIGHTED build has weight_digits in front (2 clocks)
// own lanes    beat z factor product sum    head                        rings turn to slot 0 (gram_drain)
// next lanes          held   factor product sum    head
// drain                                     read   +      +      pair   lane_select and recombine, 3 clocks
//
// rst is enough to start from, clear is still to come before the first frame.
// clear (with or before a frame's first beat) zeroes every sum and forgets whatever is under way, also a half-given point or a drain.
// Beats may not come between beat_last and the next clear. `weighted` is stable from the first beat to the last pair.
`resetall
`default_nettype none
`include "relnav_words.vh"

module gram_array #(
    parameter WEIGHTED = 1,  // 0: every weight is 1, no pre-multiplier, no second pass
    parameter CHECK    = 1   // 0: no moment_check, `checked` and `mismatch` stay 0
) (
    input  wire                                     clk,
    input  wire                                     rst,
    input  wire                                     clear,
    input  wire                                     weighted,
    // beats
    input  wire                                     beat_valid,
    output wire                                     beat_ready,
    input  wire        [                      63:0] beat_data,
    input  wire        [                       1:0] beat_index,
    input  wire        [        `RELNAV_WEIGHT-1:0] beat_weight,   // 1 where unweighted
    input  wire                                     beat_last,
    // pairs
    input  wire                                     redrain,
    output wire                                     pair_valid,
    output wire        [                       1:0] pair_slot,
    output wire        [                       2:0] pair_lane,
    output wire                                     pair_last,
    output wire signed [  `RELNAV_M2(WEIGHTED)-1:0] pair_moment,
    output wire signed [  `RELNAV_M1(WEIGHTED)-1:0] pair_first_i,
    output wire signed [  `RELNAV_M1(WEIGHTED)-1:0] pair_first_j,
    // sums
    output wire        [   `RELNAV_W(WEIGHTED)-1:0] weight_sum,
    output wire        [         `RELNAV_COUNT-1:0] point_count,
    output wire        [         `RELNAV_COUNT-1:0] used_count,      // points whose weight is not 0
    output wire        [6*`RELNAV_M1(WEIGHTED)-1:0] first_moments,   // {b_z, a_z, b_y, a_y, b_x, a_x}
    // check of what leaves against the beats: pairs, and what value_feeder makes of the sums (W, then first moments, m_bz last)
    input  wire                                     check,           // this drain's pairs are to be checked
    input  wire                                     value_valid,
    input  wire        [                       4:0] value_address,
    input  wire signed [  `RELNAV_M1(WEIGHTED)-1:0] value,
    output wire                                     checked,         // pulse: 20 clocks after m_bz
    output wire                                     mismatch,        // pulse, in the same clock
    output wire                                     differ            // a counter had an upset: one clock or more
);
  localparam M1_BITS = `RELNAV_M1(WEIGHTED);
  localparam M2_BITS = `RELNAV_M2(WEIGHTED);
  localparam TERM_BITS = WEIGHTED != 0 ? 48 : 33;

  // ---- steps: what the lanes work on, one a clock
  wire step, step_set, step_last, step_fresh;
  wire [1:0] step_index;
  wire [97:0] x, y;  // {b, a}, each {both, high, low}
  wire term_valid;
  wire signed [TERM_BITS-1:0] term_a, term_b;

  generate
    if (WEIGHTED != 0) begin : g_weights
      reg first_point;

      weight_digits u_digits (
          .clk(clk),
          .rst(rst),
          .clear(clear),
          .weighted(weighted),
          .beat_valid(beat_valid),
          .beat_ready(beat_ready),
          .beat_data(beat_data),
          .beat_index(beat_index),
          .beat_weight(beat_weight),
          .beat_last(beat_last),
          .step(step),
          .step_index(step_index),
          .step_set(step_set),
          .step_last(step_last),
          .x(x),
          .y(y),
          .term_valid(term_valid),
          .term_a(term_a),
          .term_b(term_b)
      );

      always @(posedge clk)
        if (clear) first_point <= 1'b1;
        else if (step && step_index == 2'd2 && (step_set || !weighted)) first_point <= 1'b0;
      assign step_fresh = first_point;
    end else begin : g_plain
      assign beat_ready = 1'b1;
      assign step = beat_valid;
      assign step_index = beat_index;
      assign step_set = 1'b0;
      assign step_fresh = 1'b0;  // the rings are cleared
      assign step_last = beat_last && beat_index == 2'd2;
      assign term_valid = step;

      limb_digits u_a (
          .component(beat_data[31:0]),
          .operand(x[48:0]),
          .shifted(term_a)
      );
      limb_digits u_b (
          .component(beat_data[63:32]),
          .operand(x[97:49]),
          .shifted(term_b)
      );
      assign y = x;
      /* verilator lint_off UNUSEDSIGNAL */
      wire unused = weighted;
      /* verilator lint_on UNUSEDSIGNAL */
    end
  endgenerate

  point_counter #(
      .WEIGHTED(WEIGHTED),
      .WEIGHT_SUM_BITS(`RELNAV_W(WEIGHTED))
  ) u_counter (
      .clk(clk),
      .rst(rst),
      .clear(clear),
      .point(beat_valid && beat_ready && beat_index == 2'd2),
      .weight(beat_weight),
      .weight_sum(weight_sum),
      .count(point_count),
      .used(used_count),
      .differ(differ)
  );

  first_moments #(
      .TERM_BITS(TERM_BITS),
      .M1_BITS  (M1_BITS)
  ) u_first (
      .clk(clk),
      .rst(rst),
      .clear(clear),
      .term_valid(term_valid),
      .term_a(term_a),
      .term_b(term_b),
      .sums(first_moments)
  );

  // ---- lanes
  wire own_valid, own_fresh, next_valid, next_fresh;
  wire [2:0] own_slot, next_slot;
  wire [97:0] held;
  wire next_load_x, next_load_y;

  component_window u_window (
      .clk(clk),
      .rst(rst),
      .clear(clear),
      .beat(step),
      .beat_index(step_index),
      .beat_set(step_set),
      .beat_fresh(step_fresh),
      .beat_x(x),
      .own_valid(own_valid),
      .own_fresh(own_fresh),
      .own_address(own_slot),
      .held(held),
      .next_load_x(next_load_x),
      .next_load_y(next_load_y),
      .next_valid(next_valid),
      .next_fresh(next_fresh),
      .next_address(next_slot)
  );

  wire own_rotate, next_rotate;
  wire [2:0] own_drain, next_drain;
  wire own_skip, own_zero, own_accumulate, own_write;
  wire next_skip, next_zero, next_accumulate, next_write;
  wire [2:0] own_write_address, own_read_address, next_write_address, next_read_address;

  lane_control u_own (
      .clk(clk),
      .rst(rst),
      .clear(clear),
      .slot_valid(own_valid),
      .slot_fresh(own_fresh),
      .slot_address(own_slot),
      .rotate(own_rotate),
      .drain_address(own_drain),
      .skip(own_skip),
      .fresh(own_zero),
      .accumulate(own_accumulate),
      .write(own_write),
      .write_address(own_write_address),
      .read_address(own_read_address)
  );

  lane_control u_next (
      .clk(clk),
      .rst(rst),
      .clear(clear),
      .slot_valid(next_valid),
      .slot_fresh(next_fresh),
      .slot_address(next_slot),
      .rotate(next_rotate),
      .drain_address(next_drain),
      .skip(next_skip),
      .fresh(next_zero),
      .accumulate(next_accumulate),
      .write(next_write),
      .write_address(next_write_address),
      .read_address(next_read_address)
  );

  // Taps, a in bits 48:0 and b in 97:49. Own lanes: a a, b b, a b; next lanes (beat i by beat j): a a, b b, b a, a b.
  wire [7*48-1:0] high, low, both, top;
  genvar lane;
  generate
    for (lane = 0; lane < 7; lane = lane + 1) begin : g_lane
      localparam OWN = lane < 3 ? 1 : 0;
      localparam X_B = lane == 1 || lane == 4 || lane == 5 ? 49 : 0;
      localparam Y_B = lane == 1 || lane == 2 || lane == 4 || lane == 6 ? 49 : 0;
      wire [48:0] x_tap, y_tap;

      assign x_tap = OWN != 0 ? x[X_B+:49] : held[X_B+:49];
      assign y_tap = y[Y_B+:49];

      gram_lane #(
          .WEIGHTED(WEIGHTED),
          .SLOTS(3)
      ) u_lane (
          .clk(clk),
          .clear(clear),
          .hold_x(1'b0),
          .load_x(OWN != 0 ? step : next_load_x),
          .load_y(OWN != 0 ? step : next_load_y),
          .x(x_tap),
          .y(y_tap),
          .skip(OWN != 0 ? own_skip : next_skip),
          .fresh(OWN != 0 ? own_zero : next_zero),
          .accumulate(OWN != 0 ? own_accumulate : next_accumulate),
          .write(OWN != 0 ? own_write : next_write),
          .write_address(OWN != 0 ? own_write_address : next_write_address),
          .read_address(OWN != 0 ? own_read_address : next_read_address),
          .top_load(OWN != 0 ? own_rotate : next_rotate),
          .high(high[48*lane+:48]),
          .low(low[48*lane+:48]),
          .both(both[48*lane+:48]),
          .top(top[48*lane+:48])
      );
    end
  endgenerate

  // ---- drain, two clocks after the last step (its own-lane sums are then one clock away)
  reg last_1, last_2;
  always @(posedge clk) begin
    last_1 <= step && step_last;
    last_2 <= last_1 && !clear;
    if (rst) {last_1, last_2} <= 2'b0;
  end

  wire reading, reading_last;
  wire [1:0] slot, high_select;
  wire [2:0] lane_read;

  gram_drain u_drain (
      .clk(clk),
      .rst(rst),
      .clear(clear),
      .start(last_2 || redrain),
      .own_rotate(own_rotate),
      .own_address(own_drain),
      .next_rotate(next_rotate),
      .next_address(next_drain),
      .reading(reading),
      .reading_last(reading_last),
      .slot(slot),
      .lane(lane_read),
      .high_select(high_select)
  );

  wire [47:0] high_read, low_read, both_read, top_read;
  lane_select u_select_high (
      .lanes(high),
      .low(lane_read[1:0]),
      .high(high_select),
      .chosen(high_read)
  );
  lane_select u_select_low (
      .lanes(low),
      .low(lane_read[1:0]),
      .high(high_select),
      .chosen(low_read)
  );
  lane_select u_select_both (
      .lanes(both),
      .low(lane_read[1:0]),
      .high(high_select),
      .chosen(both_read)
  );
  lane_select u_select_top (
      .lanes(top),
      .low(lane_read[1:0]),
      .high(high_select),
      .chosen(top_read)
  );

  recombine #(
      .WEIGHTED(WEIGHTED),
      .M2_BITS (M2_BITS)
  ) u_recombine (
      .clk(clk),
      .with_top(weighted),
      .high(high_read),
      .low(low_read),
      .both(both_read),
      .top(top_read),
      .moment(pair_moment)
  );

  pair_tags #(
      .M1_BITS(M1_BITS)
  ) u_tags (
      .clk(clk),
      .rst(rst),
      .clear(clear),
      .reading(reading),
      .reading_last(reading_last),
      .slot(slot),
      .lane(lane_read),
      .first_moments(first_moments),
      .pair_valid(pair_valid),
      .pair_slot(pair_slot),
      .pair_lane(pair_lane),
      .pair_last(pair_last),
      .pair_first_i(pair_first_i),
      .pair_first_j(pair_first_j)
  );

  // ---- check: addresses above 27 are no sums of the beats
  localparam [4:0] ADDRESS_LAST = 5'd27;

  generate
    if (CHECK != 0) begin : g_check
      moment_check #(
          .RING(0),
          .ITEM_BITS(M2_BITS),
          .VALUE_BITS(M1_BITS)
      ) u_check (
          .clk(clk),
          .rst(rst),
          .clear(clear),
          .beat(beat_valid && beat_ready),
          .beat_data(beat_data),
          .beat_index(beat_index),
          .beat_weight(WEIGHTED != 0 ? beat_weight : 16'd1),
          .item_valid(pair_valid && check),
          .item_key({1'b0, pair_slot, pair_lane}),
          .item(pair_moment),
          .value_valid(value_valid && value_address[4:2] != 3'd7),
          .value_key({1'b0, value_address}),
          .value_last(value_address == ADDRESS_LAST),
          .value(value),
          .checked(checked),
          .mismatch(mismatch)
      );
    end else begin : g_no_check
      assign checked  = 1'b0;
      assign mismatch = 1'b0;
      /* verilator lint_off UNUSEDSIGNAL */
      wire unused_check = &{check, value_valid, value_address, value};
      /* verilator lint_on UNUSEDSIGNAL */
    end
  endgenerate
endmodule

`resetall
