// SPDX-License-Identifier: Apache-2.0
// Takes frames from the AXI-Stream or from the push register, finds the weights, checks the frame, and feeds the Gram array.
//
// A frame is rows (points) of BEATS beats. Where the weight of a row is:
//   WEIGHTED = 0  nowhere
//   WEIGHTED = 1  in bits 15:0 of a beat in front, in frames that are `weighted`; it is stripped and held (BEATS = 3)
//   WEIGHTED = 2  in bits 47:32 of the row's last beat, always; the beat is handed on as it is
//
// A frame comes from one source. Beats pass without a clock of delay: beat_valid and the ready back are gates of the state, the source's
// valid and beat_ready (a valid never depends on a ready). Opening a frame costs one clock, in which clear and frame_start are high.
//
// clock        0            1        2        3        4                   BEATS = 3. A weight beat in front comes first and is
// source       x0 (waits)   x0       y0       z0       x1 ..               taken here, beat_weight holds it from the next
// state        IDLE         LOAD     LOAD     LOAD     LOAD                clock on
// beat_index   -            0        1        2        0
// outputs      clear, frame_start
//
// The last beat gives one of: frame_end (with beat_last), or frame_dropped with the flags that say why. No pulse is delayed: `accept`
// must fall in the clock after frame_end, and may rise again any clock later. A frame that is dropped gave no beat_last, so the array
// must forget what it has at the next clear. TOO_LONG comes at the first beat too many; the frame is swallowed to its end.
// soft_reset drops whatever is open and takes no beat in its clock; what is left of that frame at the source opens a new one.
`resetall
`default_nettype none

module frame_loader #(
    parameter BEATS    = 3,  // beats of a row, a weight in front not counted: 3 or 4
    parameter LEAST    = 3,  // rows of the shortest frame: 2 to 8
    parameter WEIGHTED = 1   // see above; `weighted` counts only where it is 1
) (
    input wire clk,
    input wire rst,

    input wire accept,     // the core can take a frame: looked at only between frames
    input wire weighted,   // taken over at frame_start
    input wire soft_reset, // pulse

    // stream
    input  wire [63:0] s_axis_tdata,
    input  wire        s_axis_tvalid,
    output wire        s_axis_tready,
    input  wire        s_axis_tlast,

    // push register
    input  wire        push_valid,
    input  wire [63:0] push_data,
    input  wire        push_last,
    output wire        push_ready,
    output wire        push_open,   // a push given now would be taken without waiting for another frame

    // Gram array
    output wire        clear,
    output wire        beat_weighted,  // the open frame has weight beats in front; stable from the clock after clear
    output wire        beat_valid,
    input  wire        beat_ready,
    output wire [63:0] beat_data,
    output wire [ 1:0] beat_index,
    output wire [15:0] beat_weight,    // of the row, right with its last beat; 1 where unweighted
    output wire        beat_last,

    // frame events, pulses
    output wire frame_start,
    output wire frame_end,
    output wire frame_dropped,
    output wire few_rows,       // with frame_dropped
    output wire zero_weight,    // with frame_dropped
    output wire bad_tlast,      // with frame_dropped
    output wire too_long        // frame_dropped comes now or later
);

  localparam [1:0] IDLE = 2'd0, LOAD = 2'd1, SWALLOW = 2'd2;
  localparam LAST = BEATS - 1, BEFORE = LEAST - 1;
  localparam [1:0] LAST_BEAT = LAST[1:0];
  localparam [1:0] WEIGHT_BEAT = 2'd3;  // in front
  localparam [2:0] ALMOST = BEFORE[2:0];

  reg [1:0] state;
  reg from_push;
  reg [1:0] beat;  // the beat awaited
  // Rows complete + 1. Bit 16 rises with row 65535, the last that the core's 16-bit counters carry.
  reg [16:0] count;
  reg enough;  // all but one of the rows needed are complete
  wire some_weight;  // a weight that is not 0 has come, or comes with this beat

  // ---- source

  wire valid = from_push ? push_valid : s_axis_tvalid;
  wire last = from_push ? push_last : s_axis_tlast;
  assign beat_data = from_push ? push_data : s_axis_tdata;

  wire weight_beat = WEIGHTED == 1 && beat == WEIGHT_BEAT;
  wire first = beat == (beat_weighted ? WEIGHT_BEAT : 2'd0);
  wire closing = beat == LAST_BEAT;
  wire full = count[16] && first;
  wire to_array = state == LOAD && !weight_beat && !full && !soft_reset;
  wire taken_here = state == SWALLOW || (state == LOAD && (weight_beat || full));
  wire ready = (to_array && beat_ready) || (taken_here && !soft_reset);
  wire fire = valid && ready;

  assign s_axis_tready = ready && !from_push;
  assign push_ready = ready && from_push;
  assign push_open = state == IDLE ? accept : from_push;

  // ---- Gram array

  wire good = enough && some_weight;

  assign clear = state == IDLE && accept && !soft_reset && (push_valid || s_axis_tvalid);
  assign beat_valid = to_array && valid;
  assign beat_index = beat;
  assign beat_last = last && closing && good;

  // ---- events

  wire ends = fire && last;
  wire ends_row = ends && state == LOAD && closing;  // the last beat is never the first, so never full

  assign frame_start = clear;
  assign frame_end = ends_row && good;
  assign frame_dropped = ends && !frame_end;
  assign few_rows = ends_row && !enough;
  assign zero_weight = ends_row && !some_weight;
  assign bad_tlast = ends && state == LOAD && !closing && !full;
  assign too_long = fire && state == LOAD && full;

  always @(posedge clk) begin
    if (clear) begin
      state     <= LOAD;
      from_push <= push_valid;
      beat      <= WEIGHTED == 1 && weighted ? WEIGHT_BEAT : 2'd0;
      count     <= 17'd1;
      enough    <= 1'b0;
    end else if (fire) begin
      if (last) state <= IDLE;
      else if (full) state <= SWALLOW;
      beat <= closing && !beat_weighted ? 2'd0 : beat + 2'd1;
      if (state == LOAD && closing) begin
        count  <= count + 17'd1;
        enough <= enough || count[2:0] == ALMOST;
      end
    end
    if (rst || soft_reset) state <= IDLE;
  end

  // ---- weights

  generate
    if (WEIGHTED == 1) begin : g_front
      reg mode;
      reg [15:0] weight;
      reg some;
      wire take = fire && weight_beat;
      always @(posedge clk) begin
        if (clear) begin
          mode   <= weighted;
          weight <= 16'd1;
          some   <= !weighted;
        end else if (take) begin
          weight <= beat_data[15:0];
          some   <= some || beat_data[15:0] != 16'd0;
        end
      end
      assign beat_weighted = mode;
      assign beat_weight   = weight;
      assign some_weight   = some;
    end else begin : g_fixed
      assign beat_weighted = 1'b0;
      if (WEIGHTED == 2) begin : g_inside
        reg  some;
        wire here = beat_weight != 16'd0;
        always @(posedge clk)
          if (clear) some <= 1'b0;
          else if (fire && closing) some <= some || here;
        assign beat_weight = beat_data[47:32];
        assign some_weight = some || here;
      end else begin : g_none
        assign beat_weight = 16'd1;
        assign some_weight = 1'b1;
      end
      /* verilator lint_off UNUSEDSIGNAL */
      wire unused = weighted;
      /* verilator lint_on UNUSEDSIGNAL */
    end
  endgenerate

  // synthesis translate_off
  /* verilator lint_off UNUSEDSIGNAL */
  reg [8*8-1:0] state_name;  // for the waves
  /* verilator lint_on UNUSEDSIGNAL */
  always @*
    case (state)
      IDLE: state_name = "IDLE";
      LOAD: state_name = "LOAD";
      SWALLOW: state_name = "SWALLOW";
      default: state_name = "?";
    endcase
  // synthesis translate_on

endmodule

`resetall
