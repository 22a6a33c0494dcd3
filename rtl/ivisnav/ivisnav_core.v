// SPDX-License-Identifier: Apache-2.0
// iVisNav core: beats of rows in, results out.
//
//   beats -> gram_ring (28 exact sums w u_i u_j of u = [h; y]) -> rates_engine (normal equations solved in binary32) -> result words
//   frame_state: IDLE -> SEND_DATA -> COMPUTE -> VERIFY -> DONE; two groups of results, rates (v, omega) and all (rss, covariance)
//   A frame that is rank deficient or ill conditioned leaves no result and leads back to IDLE.
// VERIFY (parameter): the exact sums are checked against the beats, and drained and solved twice; any difference is an upset.
//
// clock     0           ..  a               ..  r               ..  s               clocks from the last accepted beat: docs/ivisnav.md,
//           last beat       first item          v and omega         rss and covariance    measured by frame_state's counters
`resetall
`default_nettype none
module ivisnav_core #(
    parameter VERIFY = 1
) (
    input  wire        clk,
    input  wire        rst,
    input  wire        soft_reset,
    input  wire        acknowledge,
    // configuration, stable while busy
    input  wire [ 7:0] config_frac_h,
    input  wire [ 7:0] config_frac_y,
    input  wire [31:0] config_variance,
    // frame_loader
    output wire        accept,
    input  wire        clear,
    input  wire        beat_valid,
    output wire        beat_ready,
    input  wire [63:0] beat_data,
    input  wire [ 1:0] beat_index,
    input  wire        beat_last,
    input  wire        frame_start,
    input  wire        frame_end,
    input  wire        frame_dropped,
    input  wire        frame_open,
    input  wire [15:0] frame_rows,       // as the loader counts them
    output wire        give_up,
    // results
    output wire        write_valid,
    output wire [ 5:0] write_index,
    output wire [31:0] write_data,
    output wire        rates_commit,
    output wire        all_commit,
    output wire        verifying,
    input  wire        differs,
    // status
    output wire [ 2:0] state_code,
    output wire        busy,
    output wire        rates_ready,
    output wire        all_ready,
    output reg  [15:0] rows,
    output reg  [31:0] weight,
    output reg  [31:0] condition,      // of the last frame that was solved or refused as ill conditioned
    output wire [15:0] cycles_rates,
    output wire [15:0] cycles_all,
    output wire        rank_deficient,
    output wire        ill_conditioned,
    output wire        watchdog,
    output wire        complete,
    // upsets
    input  wire        upset_elsewhere,
    output wire        upset
);
  // ------------------------------------------------------------------ state machine
  wire engine_rank_deficient, engine_ill_conditioned, rates_done, all_done;
  wire loading, computing, again, redrain;

  assign rank_deficient  = computing & engine_rank_deficient;
  assign ill_conditioned = computing & engine_ill_conditioned;

  /* verilator lint_off UNUSEDSIGNAL */
  wire [2:0] commit, ready;  // there is no middle group
  wire [15:0] no_cycles;
  /* verilator lint_on UNUSEDSIGNAL */
  assign {all_commit, rates_commit} = {commit[2], commit[0]};
  assign {all_ready, rates_ready} = {ready[2], ready[0]};

  frame_state #(
      .WATCHDOG_BITS(11),
      .VERIFY(VERIFY),
      .LOADING_NAME ("SEND_DATA")
  ) states (
      .clk(clk),
      .rst(rst),
      .soft_reset(soft_reset),
      .acknowledge(acknowledge),
      .accept(accept),
      .frame_start(frame_start),
      .frame_end(frame_end),
      .frame_dropped(frame_dropped),
      .done({all_done, 1'b0, rates_done}),
      .refused(rank_deficient | ill_conditioned),
      .upset(upset),
      .loading(loading),
      .computing(computing),
      .verifying(verifying),
      .again(again),
      .redrain(redrain),
      .commit(commit),
      .complete(complete),
      .state(state_code),
      .busy(busy),
      .ready(ready),
      .cycles_first(cycles_rates),
      .cycles_middle(no_cycles),
      .cycles_last(cycles_all),
      .watchdog(watchdog)
  );

  wire [31:0] weight_sum, engine_condition;
  wire [15:0] row_count, used_count;
  always @(posedge clk) begin
    if (rates_commit) {rows, weight} <= {row_count, weight_sum};
    if (rates_commit | ill_conditioned) condition <= engine_condition;
    if (rst) {rows, weight, condition} <= 80'd0;
  end

  // ------------------------------------------------------------------ upsets
  wire flush = clear | soft_reset;
  wire checked, mismatch, array_differs;  // the sums with the beats
  core_upsets #(
      .RECORD(80),
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
      .frame_rows(frame_rows),
      .array_rows(row_count),
      .checked(checked),
      .mismatch(mismatch),
      .differ(array_differs),
      .differs(differs),
      .repeated(verifying & rates_done),
      .refused(engine_rank_deficient | engine_ill_conditioned),
      .record({rows, weight, condition}),
      .record_again({row_count, weight_sum, engine_condition}),
      .elsewhere(upset_elsewhere),
      .upset(upset),
      .give_up(give_up)
  );

  // ------------------------------------------------------------------ sums
  wire item_valid, item_last;
  wire [2:0] item_row, item_column;
  wire signed [95:0] item_moment;
  wire [5:0] h_bits, y_bits, weight_bits;

  gram_ring #(
      .CHECK(VERIFY)
  ) gram (
      .clk(clk),
      .rst(rst),
      .clear(flush),
      .beat_valid(beat_valid),
      .beat_ready(beat_ready),
      .beat_data(beat_data),
      .beat_index(beat_index),
      .beat_last(beat_last),
      .redrain(redrain),
      .check(1'b1),
      .checked(checked),
      .mismatch(mismatch),
      .differ(array_differs),
      .item_valid(item_valid),
      .item_row(item_row),
      .item_column(item_column),
      .item_last(item_last),
      .item_moment(item_moment),
      .weight_sum(weight_sum),
      .row_count(row_count),
      .used_count(used_count),
      .h_bits(h_bits),
      .y_bits(y_bits),
      .weight_bits(weight_bits)
  );

  // ------------------------------------------------------------------ solve
  reg flushed;  // a clock later, long before the first item: the way from the state through the loader to `clear` is long
  always @(posedge clk) flushed <= flush;

  rates_engine engine (
      .clk(clk),
      .rst(rst | flushed | again),
      .item_valid(item_valid),
      .item_row(item_row),
      .item_column(item_column),
      .item_last(item_last),
      .item_moment(item_moment),
      .h_bits(h_bits),
      .y_bits(y_bits),
      .weight_bits(weight_bits),
      .used_count(used_count),
      .frac_h(config_frac_h),
      .frac_y(config_frac_y),
      .variance(config_variance),
      .write_valid(write_valid),
      .write_index(write_index),
      .write_data(write_data),
      .rates_done(rates_done),
      .all_done(all_done),
      .rank_deficient(engine_rank_deficient),
      .ill_conditioned(engine_ill_conditioned),
      .condition(engine_condition)
  );
endmodule
`resetall
