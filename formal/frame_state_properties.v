// SPDX-License-Identifier: Apache-2.0
// What frame_state promises, for SymbiYosys (frame_state.sby), together with the frame_loader that drives it, connected as in the cores;
// the data path (done, refused), the bus (soft_reset, acknowledge) and the sources are free in every clock.
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
    input wire        weighted,
    input wire [63:0] s_axis_tdata,
    input wire        s_axis_tvalid,
    input wire        s_axis_tlast,
    input wire        push_valid,
    input wire [63:0] push_data,
    input wire        push_last,
    input wire        beat_ready
);
  localparam [2:0] IDLE = 3'd0, LOADING = 3'd1, COMPUTE = 3'd2, DONE = 3'd3;
  localparam [15:0] LIMIT = 16'd1 << WATCHDOG_BITS;

  wire accept, frame_start, frame_end, frame_dropped, computing, busy, watchdog, s_axis_tready, push_ready;
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
      .too_long()
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
      .computing(computing),
      .commit(commit),
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

  reg started = 1'b0;
  always @(posedge clk) started <= 1'b1;

  reg [15:0] age;  // clocks in COMPUTE, this one counted
  reg [2:0] stands;  // groups that this frame has committed
  reg [15:0] age_first, age_middle, age_last;  // when
  always @(posedge clk) begin
    age <= state == COMPUTE ? age + 16'd1 : 16'd1;
    stands <= rst || frame_start ? 3'd0 : state == COMPUTE ? stands | done : stands;
    if (state == COMPUTE && done[0]) age_first <= age;
    if (state == COMPUTE && done[1]) age_middle <= age;
    if (state == COMPUTE && done[2]) age_last <= age;
    if (rst) {age_first, age_middle, age_last} <= 48'd0;
  end

  wire consistent = state <= DONE && (loader_state != 2'd0) == (state == LOADING) && loader_state != 2'd3 &&
      (state != COMPUTE || (age >= 16'd1 && age <= LIMIT && dut_cycles == age));
  wire same_results = stands == ready && age_first == cycles_first && age_middle == cycles_middle && age_last == cycles_last;
  always @* if (!started) assume (ANYWHERE == 0 ? rst : ANYWHERE == 1 ? consistent && same_results : state > DONE);

  reg [2:0] was_state;
  reg was_reset, was_start, was_end, was_dropped, was_done, was_refused, was_acknowledge, was_watchdog;
  always @(posedge clk) begin
    was_state <= state;
    was_reset <= rst || soft_reset;
    {was_start, was_end, was_dropped} <= {frame_start, frame_end, frame_dropped};
    {was_done, was_refused, was_acknowledge, was_watchdog} <= {done[2], refused, acknowledge, watchdog};
  end

  generate
    if (ANYWHERE == 2) begin : g_upset
      always @(posedge clk) if (started && was_state > DONE) upset_left : assert (state == IDLE);
    end else begin : g_promises
      always @(posedge clk) if (started || ANYWHERE != 0) begin
        same_state : assert (consistent);
        named_state : assert (state == IDLE || state == LOADING || state == COMPUTE || state == DONE);
        accept_when_idle : assert (accept == (state == IDLE || state == DONE));
        busy_told : assert (busy == (state == LOADING || state == COMPUTE) && computing == (state == COMPUTE));
        commit_in_compute : assert (commit == (state == COMPUTE ? done : 3'd0));
        results_told : assert (same_results);
        watchdog_right : assert (watchdog == (state == COMPUTE && age == LIMIT));
        compute_bounded : assert (state != COMPUTE || age <= LIMIT);
        if (!rst) begins_accepted : assert (!frame_start || state == IDLE || state == DONE);
        if (!rst) ends_loaded : assert (!(frame_end || frame_dropped) || state == LOADING);
        if (!rst) loads_only : assert (!(s_axis_tvalid && s_axis_tready) && !(push_valid && push_ready) || state == LOADING);
      end
      always @(posedge clk) if (started) begin
        if (was_reset || was_watchdog) reset_to_idle : assert (state == IDLE);
        else
          case (was_state)
            IDLE: idle_left : assert (state == (was_start ? LOADING : IDLE));
            LOADING: loading_left : assert (state == (was_end ? COMPUTE : was_dropped ? IDLE : LOADING));
            COMPUTE: compute_left : assert (state == (was_refused ? IDLE : was_done ? DONE : COMPUTE));
            default: done_held : assert (state == (was_start ? LOADING : was_acknowledge ? IDLE : DONE));
          endcase
      end
    end
  endgenerate
endmodule

`resetall
