// SPDX-License-Identifier: Apache-2.0
// State machine of a core around its data path: where the frame is, when it may be committed, how long it took, and the second pass that
// verifies it.
//
//   IDLE -> loading (first beat) -> COMPUTE (last beat) -> VERIFY (all results) -> DONE (the same again) -> IDLE (acknowledge) or loading
//   An error of the frame, a refusal, an upset, the watchdog or a soft reset leads back to IDLE from anywhere.
//
// clock     0           1          ..   c            c + 1        c + 2 ..        v            v + 1        v + 2
// frame_end x                                                                                                       the last beat is taken
// done                                  x                                         x                                 group's last word
// ready                                              x            x               x            x            x       cycles_* = c
// again                                              x                                                              forget, but for the sums
// redrain                                                         x                                                 sums drain once more
// complete                                                                                     x
// state     loading     COMPUTE    ..   COMPUTE      VERIFY       VERIFY  ..      VERIFY       VERIFY       DONE
//
// Results come in up to three groups, first, middle and last (bits 0, 1, 2); the last one completes the frame. A group that the core
// has not is left at 0. done and refused count only in COMPUTE, so what an aborted frame still gives is lost; in VERIFY done[2] ends the
// pass, and `upset` must tell a clock later at the latest what it found. VERIFY = 0: no second pass, complete falls with commit[2].
// state, accept and ready are voted; a frame that an upset, or the watchdog, ends has no results.
`resetall
`default_nettype none

module frame_state #(
    // COMPUTE and VERIFY end after 2^WATCHDOG_BITS clocks each: twice the longest program, or more
    parameter WATCHDOG_BITS = 11,
    parameter VERIFY = 1,                       // 0: no second pass
    parameter [9*8-1:0] LOADING_NAME = "LOAD"   // of the second state, for the waves
) (
    input  wire        clk,
    input  wire        rst,
    input  wire        soft_reset,      // pulses
    input  wire        acknowledge,
    // frame_loader
    output wire        accept,
    input  wire        frame_start,
    input  wire        frame_end,
    input  wire        frame_dropped,
    // data path
    input  wire [ 2:0] done,
    input  wire        refused,         // the frame has no solution
    input  wire        upset,           // it cannot be trusted
    output wire        loading,
    output wire        computing,
    output wire        verifying,
    output wire        again,           // pulses
    output wire        redrain,
    output wire [ 2:0] commit,
    output wire        complete,
    // status
    output wire [ 2:0] state,
    output wire        busy,
    output wire [ 2:0] ready,           // groups that stand, of the last frame started
    output reg  [15:0] cycles_first,
    output reg  [15:0] cycles_middle,
    output reg  [15:0] cycles_last,
    output wire        watchdog         // pulse
);
  localparam [2:0] IDLE = 3'd0, LOADING = 3'd1, COMPUTE = 3'd2, DONE = 3'd3, VERIFYING = 3'd4;

  reg [15:0] cycles;  // of the pass
  reg [ 2:0] state_next;
  reg again_1, redrain_1, repeated;

  assign loading = state == LOADING;
  assign computing = state == COMPUTE;
  assign verifying = VERIFY != 0 && state == VERIFYING;
  assign watchdog = (computing | verifying) & cycles[WATCHDOG_BITS];
  assign commit = done & {3{computing}};
  assign busy = loading | computing | verifying;

  wire given_up = soft_reset | watchdog | upset;
  wire solved = computing & done[2] & ~refused & ~given_up;
  assign again = VERIFY != 0 && again_1;
  assign redrain = VERIFY != 0 && redrain_1;
  assign complete = VERIFY != 0 ? verifying & repeated & ~given_up : solved;

  always @* begin
    state_next = state;
    case (state)
      IDLE: if (frame_start) state_next = LOADING;
      LOADING:
      if (frame_end) state_next = COMPUTE;
      else if (frame_dropped) state_next = IDLE;
      COMPUTE:
      if (refused) state_next = IDLE;
      else if (done[2]) state_next = VERIFY != 0 ? VERIFYING : DONE;
      VERIFYING: if (VERIFY == 0) state_next = IDLE;
      else if (repeated) state_next = DONE;
      DONE:
      if (frame_start) state_next = LOADING;
      else if (acknowledge) state_next = IDLE;
      default: state_next = IDLE;
    endcase
    if (given_up) state_next = IDLE;
  end

  voted_register #(
      .WIDTH(3),
      .RESET(IDLE)
  ) state_register (
      .clk(clk),
      .rst(rst),
      .d  (state_next),
      .q  (state)
  );

  // ~busy again: the loader's way from here to the whole core begins at a flip-flop
  voted_register #(
      .WIDTH(1),
      .RESET(1'b1)
  ) accept_register (
      .clk(clk),
      .rst(rst),
      .d  (state_next == IDLE || state_next == DONE),
      .q  (accept)
  );

  voted_register #(
      .WIDTH(3),
      .RESET(3'd0)
  ) ready_register (
      .clk(clk),
      .rst(rst),
      .d  (frame_start | (busy & (upset | watchdog)) ? 3'd0 : ready | commit),
      .q  (ready)
  );

  always @(posedge clk) begin
    cycles    <= frame_end ? 16'd1 : solved ? 16'd0 : cycles + 16'd1;
    again_1   <= solved;
    redrain_1 <= again_1;
    repeated  <= verifying & done[2];
    if (commit[0]) cycles_first <= cycles;
    if (commit[1]) cycles_middle <= cycles;
    if (commit[2]) cycles_last <= cycles;
    if (rst) {again_1, redrain_1, repeated, cycles_first, cycles_middle, cycles_last} <= 51'd0;
  end

  // synthesis translate_off
  /* verilator lint_off UNUSEDSIGNAL */
  reg [9*8-1:0] state_name;  // for the waves
  /* verilator lint_on UNUSEDSIGNAL */
  always @*
    case (state)
      IDLE: state_name = "IDLE";
      LOADING: state_name = LOADING_NAME;
      COMPUTE: state_name = "COMPUTE";
      DONE: state_name = "DONE";
      VERIFYING: state_name = "VERIFY";
      default: state_name = "?";
    endcase
  // synthesis translate_on
endmodule

`resetall
