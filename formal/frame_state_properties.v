// SPDX-License-Identifier: Apache-2.0
// What frame_state promises, for SymbiYosys (frame_state.sby), together with the frame_loader that drives it and core_upsets, connected as
// in the cores; the data path (done, refused), upsets (noticed), the bus (soft_reset, acknowledge) and the sources are free in every clock.
// So nothing is assumed of frame_start, frame_end and frame_dropped: that a frame begins only where one is accepted and ends only where
// it was loaded is proved here too.
//
// ANYWHERE = 1 starts in any state that the registers can be in: so a bounded check sees the watchdog, and (ANYWHERE = 2) that a state
// without a name, which only an upset can bring, is left at once.
`resetall
`default_nettype none

module frame_state_properties #(
    parameter WATCHDOG_BITS = 11,
    parameter BEATS         = 3,
    parameter LEAST         = 3,
    parameter WEIGHTED      = 1,
    parameter ANYWHERE      = 0
) (
    input wire        clk,
    input wire        rst,
    input wire        soft_reset,
    input wire        acknowledge,
    input wire [ 2:0] done,
    input wire        refused,
    input wire        noticed,
    input wire        weighted,
    input wire [63:0] s_axis_tdata,
    input wire        s_axis_tvalid,
    input wire        s_axis_tlast,
    input wire        push_valid,
    input wire [63:0] push_data,
    input wire        push_last,
    input wire        beat_ready
);
  localparam [2:0] IDLE = 3'd0, LOADING = 3'd1, COMPUTE = 3'd2, DONE = 3'd3, VERIFY = 3'd4;
  localparam [15:0] LIMIT = 16'd1 << WATCHDOG_BITS;

  wire accept, frame_start, frame_end, frame_dropped, computing, busy, watchdog, s_axis_tready, push_ready;
  wire loading, verifying, again, redrain, complete, upset, give_up, open;
  wire [15:0] rows;
  wire [2:0] commit, state, ready;
  wire [15:0] cycles_first, cycles_middle, cycles_last;

  frame_loader #(
      .BEATS(BEATS),
      .LEAST(LEAST),
      .WEIGHTED(WEIGHTED)
  ) loader (
      .clk(clk),
      .rst(rst),
      .accept(accept),
      .weighted(weighted),
      .soft_reset(soft_reset),
      .give_up(give_up),
      .s_axis_tdata(s_axis_tdata),
      .s_axis_tvalid(s_axis_tvalid),
      .s_axis_tready(s_axis_tready),
      .s_axis_tlast(s_axis_tlast),
      .push_valid(push_valid),
      .push_data(push_data),
      .push_last(push_last),
      .push_ready(push_ready),
      .push_open(),
      .clear(),
      .beat_weighted(),
      .beat_valid(),
      .beat_ready(beat_ready),
      .beat_data(),
      .beat_index(),
      .beat_weight(),
      .beat_last(),
      .frame_start(frame_start),
      .frame_end(frame_end),
      .frame_dropped(frame_dropped),
      .few_rows(),
      .zero_weight(),
      .bad_tlast(),
      .too_long(),
      .open(open),
      .rows(rows),
      .upset()
  );

  core_upsets upsets (
      .clk(clk),
      .rst(rst),
      .loading(loading),
      .computing(computing),
      .verifying(verifying),
      .again(again),
      .forget(1'b0),
      .ended(1'b0),
      .open(open),
      .frame_rows(rows),
      .array_rows(rows),
      .checked(1'b0),
      .mismatch(1'b0),
      .differ(1'b0),
      .differs(1'b0),
      .repeated(1'b0),
      .refused(1'b0),
      .record(48'd0),
      .record_again(48'd0),
      .elsewhere(noticed),
      .upset(upset),
      .give_up(give_up)
  );

  frame_state #(
      .WATCHDOG_BITS(WATCHDOG_BITS)
  ) dut (
      .clk(clk),
      .rst(rst),
      .soft_reset(soft_reset),
      .acknowledge(acknowledge),
      .accept(accept),
      .frame_start(frame_start),
      .frame_end(frame_end),
      .frame_dropped(frame_dropped),
      .done(done),
      .refused(refused),
      .upset(upset),
      .loading(loading),
      .computing(computing),
      .verifying(verifying),
      .again(again),
      .redrain(redrain),
      .commit(commit),
      .complete(complete),
      .state(state),
      .busy(busy),
      .ready(ready),
      .cycles_first(cycles_first),
      .cycles_middle(cycles_middle),
      .cycles_last(cycles_last),
      .watchdog(watchdog)
  );

  // connected to registers by the script
  wire [ 1:0] loader_state;
  wire [15:0] dut_cycles;
  wire [ 2:0] copy_first, copy_second, copy_third;  // of the voted state

  reg started = 1'b0;
  always @(posedge clk) started <= 1'b1;

  reg [15:0] age;  // clocks in COMPUTE, this one counted; in VERIFY, before this one
  reg [2:0] stands;  // groups that this frame has committed
  reg [15:0] age_first, age_middle, age_last;  // when
  wire solved = state == COMPUTE && done[2] && !refused && !soft_reset && !watchdog && !upset;
  wire lost = busy && (upset || watchdog);
  always @(posedge clk) begin
    age <= solved ? 16'd0 : state == COMPUTE || state == VERIFY ? age + 16'd1 : 16'd1;
    stands <= rst || frame_start || lost ? 3'd0 : state == COMPUTE ? stands | done : stands;
    if (state == COMPUTE && done[0]) age_first <= age;
    if (state == COMPUTE && done[1]) age_middle <= age;
    if (state == COMPUTE && done[2]) age_last <= age;
    if (rst) {age_first, age_middle, age_last} <= 48'd0;
  end

  // an upset takes the state machine back a clock before the loader hears of it
  reg was_given_up;
  always @(posedge clk) was_given_up <= upset;
  wire together = state == LOADING ? open : !open || was_given_up || give_up || loader_state[1];
  wire consistent = state <= VERIFY && together &&
      (state != COMPUTE || (age >= 16'd1 && age <= LIMIT && dut_cycles == age)) &&
      (state != VERIFY || (age <= LIMIT && dut_cycles == age));
  wire same_results = stands == ready && age_first == cycles_first && age_middle == cycles_middle && age_last == cycles_last;
  always @* if (!started) assume (ANYWHERE == 0 ? rst : ANYWHERE == 1 ? consistent && same_results && !upset : state > VERIFY);
  always @* if (!started) assume (copy_first == copy_second && copy_second == copy_third);

  reg [2:0] was_state;
  reg was_reset, was_start, was_end, was_dropped, was_done, was_refused, was_acknowledge, was_watchdog, was_upset, was_solved, was_repeated;
  always @(posedge clk) begin
    was_state <= state;
    was_reset <= rst || soft_reset;
    was_repeated <= state == VERIFY && done[2];
    {was_start, was_end, was_dropped} <= {frame_start, frame_end, frame_dropped};
    {was_done, was_refused, was_acknowledge, was_watchdog} <= {done[2], refused, acknowledge, watchdog};
    {was_upset, was_solved} <= {upset, solved};
  end
  reg past_repeated, past_solved;
  always @(posedge clk) {past_repeated, past_solved} <= {was_repeated, was_solved};

  generate
    if (ANYWHERE == 2) begin : g_upset
      always @(posedge clk) if (started && was_state > VERIFY) upset_left : assert (state == IDLE);
    end else begin : g_promises
      always @(posedge clk) if (started || ANYWHERE != 0) begin
        same_state : assert (consistent);
        named_state : assert (state <= VERIFY);
        accept_when_idle : assert (accept == (state == IDLE || state == DONE));
        busy_told : assert (busy == (state == LOADING || state == COMPUTE || state == VERIFY) && computing == (state == COMPUTE));
        state_told : assert (loading == (state == LOADING) && verifying == (state == VERIFY));
        commit_in_compute : assert (commit == (state == COMPUTE ? done : 3'd0));
        results_told : assert (same_results);
        watchdog_right : assert (watchdog == ((state == COMPUTE || state == VERIFY) && age == LIMIT));
        compute_bounded : assert (!(state == COMPUTE || state == VERIFY) || age <= LIMIT);
        if (!rst) begins_accepted : assert (!frame_start || state == IDLE || state == DONE);
        if (!rst) ends_loaded : assert (!(frame_end || frame_dropped) || state == LOADING || loader_state[1] || was_given_up);
        if (!rst) loads_only : assert (!(s_axis_tvalid && s_axis_tready) && !(push_valid && push_ready) || state == LOADING ||
                                       loader_state[1] || was_given_up);
        never_lost : assert (!(loading && !open));
      end
      always @(posedge clk) if (started) begin
        if (ANYWHERE == 0 && !rst) completes_verified : assert (complete == (state == VERIFY && was_repeated && !soft_reset && !watchdog && !upset));
        if (ANYWHERE == 0 && !$past(rst)) forgets : assert (again == was_solved);
        if (was_reset || was_watchdog || was_upset) reset_to_idle : assert (state == IDLE);
        else
          case (was_state)
            IDLE: idle_left : assert (state == (was_start ? LOADING : IDLE));
            LOADING: loading_left : assert (state == (was_end ? COMPUTE : was_dropped ? IDLE : LOADING));
            COMPUTE: compute_left : assert (state == (was_refused ? IDLE : was_done ? VERIFY : COMPUTE));
            VERIFY: if (ANYWHERE == 0) verify_left : assert (state == (past_repeated ? DONE : VERIFY));
            default: done_held : assert (state == (was_start ? LOADING : was_acknowledge ? IDLE : DONE));
          endcase
      end
    end
  endgenerate
endmodule

`resetall
