// SPDX-License-Identifier: Apache-2.0
// OLTAE core: beats of points in, results out, with the state machine of the paper's Fig. 6 around them.
//
//   beats -> gram_array -> moment_stream (centring, butterfly, normaliser) -> solve_engine -> result words
//   frame_state: IDLE -> LOAD -> COMPUTE -> VERIFY -> DONE; three groups of results, q, pose and all
//
// VERIFY (parameter): the exact sums are checked against the beats, and drained and solved twice; any difference is an upset.
//
// Latency in clocks from the last accepted beat: docs/oltae.md, measured by the cycle counters here.
`include "relnav_words.vh"
`resetall
`default_nettype none
module oltae_core #(
    parameter WEIGHTED   = 1,
    parameter COVARIANCE = 1,
    parameter REAPPLY    = 1,
    parameter VERIFY     = 1
) (
    input  wire        clk,
    input  wire        rst,
    input  wire        soft_reset,
    input  wire        acknowledge,
    // configuration, stable while busy
    input  wire        config_forbid_turns,
    input  wire        config_covariance,
    input  wire        config_reapply,
    input  wire [ 7:0] config_frac,
    input  wire [31:0] config_variance,
    // frame_loader
    output wire        accept,
    input  wire        clear,
    input  wire        weighted,
    input  wire        beat_valid,
    output wire        beat_ready,
    input  wire [63:0] beat_data,
    input  wire [ 1:0] beat_index,
    input  wire [15:0] beat_weight,
    input  wire        beat_last,
    input  wire        frame_start,
    input  wire        frame_end,
    input  wire        frame_dropped,
    input  wire        frame_open,
    input  wire [15:0] frame_points,  // as the loader counts them
    output wire        give_up,
    // results
    output wire        write_valid,
    output wire [ 5:0] write_index,
    output wire [31:0] write_data,
    output wire [ 2:0] commit,  // all, pose, q
    output wire        verifying,
    input  wire        differs,
    // status
    output wire [ 2:0] state_code,
    output wire        busy,
    output wire [ 2:0] ready,   // all, pose, q
    output reg  [15:0] points,
    output reg  [31:0] weight,
    output reg  [ 1:0] turn,
    output wire [15:0] cycles_q,
    output wire [15:0] cycles_pose,
    output wire [15:0] cycles_all,
    output wire        rank_deficient,
    output wire        ill_conditioned,
    output wire        saturated,
    output wire        watchdog,
    output wire        complete,
    // upsets
    input  wire        upset_elsewhere,
    output wire        upset
);
  // ------------------------------------------------------------------ state machine
  wire chosen, engine_rank_deficient, engine_ill_conditioned, engine_saturated;
  wire q_done, pose_done, all_done;
  wire [1:0] engine_turn;
  wire loading, computing, again, redrain_all;

  assign rank_deficient  = computing & chosen & engine_rank_deficient;
  assign ill_conditioned = (computing | verifying) & chosen & engine_ill_conditioned;
  assign saturated       = (commit[1] | (verifying & pose_done)) & engine_saturated;

  frame_state #(
      .WATCHDOG_BITS(11),  // the longest program takes half of them
      .VERIFY(VERIFY),
      .LOADING_NAME ("LOAD")
  ) states (
      .clk(clk),
      .rst(rst),
      .soft_reset(soft_reset),
      .acknowledge(acknowledge),
      .accept(accept),
      .frame_start(frame_start),
      .frame_end(frame_end),
      .frame_dropped(frame_dropped),
      .done({all_done, pose_done, q_done}),
      .refused(rank_deficient),
      .upset(upset),
      .loading(loading),
      .computing(computing),
      .verifying(verifying),
      .again(again),
      .redrain(redrain_all),
      .commit(commit),
      .complete(complete),
      .state(state_code),
      .busy(busy),
      .ready(ready),
      .cycles_first(cycles_q),
      .cycles_middle(cycles_pose),
      .cycles_last(cycles_all),
      .watchdog(watchdog)
  );

  // ------------------------------------------------------------------ upsets
  wire flush = clear | soft_reset;
  wire checked, mismatch, array_differs;  // the sums with the beats
  wire [`RELNAV_W(WEIGHTED)-1:0] weight_sum;
  wire [`RELNAV_COUNT-1:0] point_count, used_count;
  wire [31:0] wide_weight = {{(32 - `RELNAV_W(WEIGHTED)) {1'b0}}, weight_sum};
  core_upsets #(
      .RECORD(50),
      .VERIFY(VERIFY)
  ) upsets (
      .clk(clk),
      .rst(rst),
      .loading(loading),
      .computing(computing),
      .verifying(verifying),
      .again(again),
      .forget(flush),
      .ended(all_done),
      .open(frame_open),
      .frame_rows(frame_points),
      .array_rows(point_count),
      .checked(checked),
      .mismatch(mismatch),
      .differ(array_differs),
      .differs(differs),
      .repeated(verifying & q_done),
      .refused(chosen & engine_rank_deficient),
      .record({points, weight, turn}),
      .record_again({point_count, wide_weight, engine_turn}),
      .elsewhere(upset_elsewhere),
      .upset(upset),
      .give_up(give_up)
  );
  always @(posedge clk) begin
    if (commit[0]) begin
      points <= point_count;
      weight <= wide_weight;
      turn   <= engine_turn;
    end
    if (rst) {points, weight, turn} <= 50'd0;
  end

  // ------------------------------------------------------------------ moments
  wire pair_valid, pair_last;
  wire [1:0] pair_slot;
  wire [2:0] pair_lane;
  wire signed [`RELNAV_M2(WEIGHTED)-1:0] pair_moment;
  wire signed [`RELNAV_M1(WEIGHTED)-1:0] pair_first_i, pair_first_j;
  wire [6*`RELNAV_M1(WEIGHTED)-1:0] first_moments;
  wire value_valid;
  wire [4:0] value_address;
  wire signed [`RELNAV_M1(WEIGHTED)-1:0] value;
  wire forget = flush | again;  // all but the sums
  reg flushed;  // a clock later, long before the first item: the way from the state through the loader to `clear` is long
  always @(posedge clk) flushed <= flush;
  wire engine_redrain;
  reg redrain;   // a clock later: the way from the program's address to the lanes is long, and the schedule leaves that clock
  reg low_pass;  // the second drain, for the low limbs
  always @(posedge clk) begin
    redrain  <= engine_redrain & ~forget & ~flushed & ~rst;  // the engine still runs while `flushed`
    low_pass <= (low_pass | redrain) & ~forget & ~rst;
  end

  gram_array #(
      .WEIGHTED(WEIGHTED),
      .CHECK(VERIFY)
  ) gram (
      .clk(clk),
      .rst(rst),
      .clear(flush),
      .weighted(weighted),
      .beat_valid(beat_valid),
      .beat_ready(beat_ready),
      .beat_data(beat_data),
      .beat_index(beat_index),
      .beat_weight(beat_weight),
      .beat_last(beat_last),
      .redrain(redrain | redrain_all),
      .check(~low_pass),
      .value_valid(value_valid),
      .value_address(value_address),
      .value(value),
      .checked(checked),
      .mismatch(mismatch),
      .differ(array_differs),
      .pair_valid(pair_valid),
      .pair_slot(pair_slot),
      .pair_lane(pair_lane),
      .pair_last(pair_last),
      .pair_moment(pair_moment),
      .pair_first_i(pair_first_i),
      .pair_first_j(pair_first_j),
      .weight_sum(weight_sum),
      .point_count(point_count),
      .used_count(used_count),
      .first_moments(first_moments)
  );

  // Exponents of the units: m has FRAC binary places, products of two twice as many; lane 2 (B_ii) is wanted doubled.
  wire signed [11:0] first_scale = -{{4{config_frac[7]}}, config_frac};
  wire signed [11:0] pair_scale = (first_scale <<< 1) + (pair_lane == 3'd2 ? 12'sd1 : 12'sd0);

  wire signed [11:0] value_scale;
  value_feeder #(
      .WEIGHTED(WEIGHTED)
  ) feeder (
      .clk(clk),
      .rst(rst),
      .clear(forget),
      .pair_last(pair_last & pair_valid & ~low_pass),
      .weight_sum(weight_sum),
      .used_count(used_count),
      .first_moments(first_moments),
      .moment_scale(first_scale),
      .variance(config_variance),
      .value_valid(value_valid),
      .value_address(value_address),
      .value(value),
      .value_scale(value_scale)
  );

  reg [`RELNAV_W(WEIGHTED)-1:0] weight_held;  // right clocks before the first pair; the multipliers are far from the counter
  always @(posedge clk) weight_held <= weight_sum;

  wire item_valid, item_zero;
  wire [6:0] item_tag;
  wire [34:0] item_mant;
  wire [11:0] item_exp;
  moment_stream #(
      .WEIGHT_SUM_BITS(`RELNAV_W(WEIGHTED)),
      .M1_BITS(`RELNAV_M1(WEIGHTED)),
      .M2_BITS(`RELNAV_M2(WEIGHTED)),
      .CENTRED_BITS(`RELNAV_CENTRED(WEIGHTED)),
      .VALUE_BITS(`RELNAV_M1(WEIGHTED)),
      .TAG_BITS(7)
  ) stream (
      .clk(clk),
      .rst(rst | flushed | again),
      .low(low_pass),
      .pair_valid(pair_valid),
      .pair_tag({low_pass, 1'b0, pair_slot, pair_lane}),
      .weight_sum(weight_held),
      .pair_moment(pair_moment),
      .pair_first_i(pair_first_i),
      .pair_first_j(pair_first_j),
      .pair_scale(pair_scale),
      .value_valid(value_valid),
      .value_tag({2'b01, value_address}),
      .value(value),
      .value_scale(value_scale),
      .item_valid(item_valid),
      .item_tag(item_tag),
      .item_mant(item_mant),
      .item_exp(item_exp),
      .item_zero(item_zero)
  );

  // ------------------------------------------------------------------ solve
  // lane -> place in the stream bank's block of the slot: T E B2 F H P N at 0 1 6 2 3 4 5
  // low limbs go where no longer needed items are: T B2 P N at 1 7 2 3
  wire item_low = item_tag[6];
  reg [2:0] kind;
  reg wanted;
  always @* begin
    wanted = 1'b1;
    if (item_low)
      case (item_tag[2:0])
        3'd0: kind = 3'd1;
        3'd2: kind = 3'd7;
        3'd5: kind = 3'd2;
        3'd6: kind = 3'd3;
        default: {kind, wanted} = 4'd0;
      endcase
    else
      case (item_tag[2:0])
        3'd0: kind = 3'd0;
        3'd1: kind = 3'd1;
        3'd2: kind = 3'd6;
        default: kind = item_tag[2:0] - 3'd1;
      endcase
  end
  wire [4:0] item_address = item_tag[5] ? item_tag[4:0] : {item_tag[4:3], kind};
  solve_engine #(
      .COVARIANCE(COVARIANCE),
      .REAPPLY(REAPPLY)
  ) engine (
      .clk(clk),
      .rst(rst | flushed | again),
      .forbid_turns(config_forbid_turns),
      .covariance(COVARIANCE != 0 && config_covariance),
      .reapply(REAPPLY != 0 && config_reapply),
      .item_valid(item_valid & wanted),
      .item_first(item_tag == 7'd0),
      .item_low(item_low),
      .redrain(engine_redrain),
      .item_address(item_address),
      .item_value({item_zero, item_exp, item_mant}),
      .write_valid(write_valid),
      .write_index(write_index),
      .write_data(write_data),
      .q_done(q_done),
      .pose_done(pose_done),
      .all_done(all_done),
      .chosen(chosen),
      .turn(engine_turn),
      .rank_deficient(engine_rank_deficient),
      .ill_conditioned(engine_ill_conditioned),
      .saturated(engine_saturated)
  );
endmodule
`resetall
