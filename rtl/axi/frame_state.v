// SPDX-License-Identifier: Apache-2.0
// State machine of a core around its data path: where the frame is, when it may be committed, how long it took.
//
//   IDLE -> loading (first beat) -> COMPUTE (last beat) -> DONE (all results) -> IDLE (acknowledge) or loading (next frame)
//   An error of the frame, a refusal, the watchdog or a soft reset leads back to IDLE from anywhere.
//
// clock     0           1          ..   c            c + 1
// frame_end x                                                      the last beat is taken at the end of clock 0
// done                                  x                          group's last word is written: commit, in the same clock
// ready                                              x             cycles_* = c from here on
//
// Results come in up to three groups, first, middle and last (bits 0, 1, 2); the last one completes the frame. A group that the core
// has not is left at 0. done and refused count only in COMPUTE, so what an aborted frame still gives is lost.
`resetall
`default_nettype none

module frame_state #(
    parameter WATCHDOG_BITS = 11,               // COMPUTE ends after 2^WATCHDOG_BITS clocks: twice the longest program, or more
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
    output wire        computing,
    output wire [ 2:0] commit,
    // status
    output reg  [ 2:0] state,
    output wire        busy,
    output reg  [ 2:0] ready,           // groups that stand, of the last frame started
    output reg  [15:0] cycles_first,
    output reg  [15:0] cycles_middle,
    output reg  [15:0] cycles_last,
    output wire        watchdog         // pulse
);
  localparam [2:0] IDLE = 3'd0, LOADING = 3'd1, COMPUTE = 3'd2, DONE = 3'd3;

  reg [15:0] cycles;

  assign computing = state == COMPUTE;
  assign watchdog = computing & cycles[WATCHDOG_BITS];
  assign commit = done & {3{computing}};
  assign busy = state == LOADING | computing;
  assign accept = ~busy;

  always @(posedge clk) begin
    case (state)
      IDLE: if (frame_start) state <= LOADING;
      LOADING:
      if (frame_end) state <= COMPUTE;
      else if (frame_dropped) state <= IDLE;
      COMPUTE:
      if (refused) state <= IDLE;
      else if (done[2]) state <= DONE;
      DONE:
      if (frame_start) state <= LOADING;
      else if (acknowledge) state <= IDLE;
      default: state <= IDLE;
    endcase
    if (soft_reset | watchdog | rst) state <= IDLE;

    cycles <= frame_end ? 16'd1 : cycles + 16'd1;
    ready  <= rst | frame_start ? 3'd0 : ready | commit;
    if (commit[0]) cycles_first <= cycles;
    if (commit[1]) cycles_middle <= cycles;
    if (commit[2]) cycles_last <= cycles;
    if (rst) {cycles_first, cycles_middle, cycles_last} <= 48'd0;
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
      default: state_name = "?";
    endcase
  // synthesis translate_on
endmodule

`resetall
