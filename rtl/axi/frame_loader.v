// SPDX-License-Identifier: Apache-2.0
// Takes frames from the AXI-Stream or from the push register, strips and holds the weights, checks the frame, and feeds the Gram array.
//
// A frame comes from one source. Beats pass without a clock of delay: beat_valid and the ready back are gates of the state, the source's
// valid and beat_ready (a valid never depends on a ready). Opening a frame costs one clock, in which clear and frame_start are high.
//
// clock        0            1        2        3        4                   weighted: the weight beat comes first and is
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
    parameter WEIGHTED = 1  // 0: builds no weights, `weighted` is ignored
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
    output wire        beat_weighted,  // mode of the open frame, stable from the clock after clear
    output wire        beat_valid,
    input  wire        beat_ready,
    output wire [63:0] beat_data,
    output wire [ 1:0] beat_index,
    output wire [15:0] beat_weight,
    output wire        beat_last,

    // frame events, pulses
    output wire frame_start,
    output wire frame_end,
    output wire frame_dropped,
    output wire few_points,     // with frame_dropped
    output wire zero_weight,    // with frame_dropped
    output wire bad_tlast,      // with frame_dropped
    output wire too_long        // frame_dropped comes now or later
);

  localparam [1:0] IDLE = 2'd0, LOAD = 2'd1, SWALLOW = 2'd2;
  localparam [1:0] WEIGHT_BEAT = 2'd3;  // the others are x, y, z = 0, 1, 2

  reg [1:0] state;
  reg from_push;
  reg [1:0] beat;  // the beat awaited
  // Points complete + 1. Bit 16 rises with point 65535, the last that the core's 16-bit counters carry.
  reg [16:0] count;
  reg enough;  // two points are complete
  wire some_weight;  // a weight that is not 0 has come

  // ---- source

  wire valid = from_push ? push_valid : s_axis_tvalid;
  wire last = from_push ? push_last : s_axis_tlast;
  assign beat_data = from_push ? push_data : s_axis_tdata;

  wire weight_beat = WEIGHTED != 0 && beat == WEIGHT_BEAT;
  wire first = beat == (beat_weighted ? WEIGHT_BEAT : 2'd0);
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
  assign beat_last = last && beat == 2'd2 && good;

  // ---- events

  wire ends = fire && last;
  wire ends_point = ends && state == LOAD && beat == 2'd2;  // beat 2 is never the first, so never full

  assign frame_start = clear;
  assign frame_end = ends_point && good;
  assign frame_dropped = ends && !frame_end;
  assign few_points = ends_point && !enough;
  assign zero_weight = ends_point && !some_weight;
  assign bad_tlast = ends && state == LOAD && beat != 2'd2 && !full;
  assign too_long = fire && state == LOAD && full;

  always @(posedge clk) begin
    if (clear) begin
      state     <= LOAD;
      from_push <= push_valid;
      beat      <= WEIGHTED != 0 && weighted ? WEIGHT_BEAT : 2'd0;
      count     <= 17'd1;
      enough    <= 1'b0;
    end else if (fire) begin
      if (last) state <= IDLE;
      else if (full) state <= SWALLOW;
      beat <= beat == 2'd2 && !beat_weighted ? 2'd0 : beat + 2'd1;
      if (state == LOAD && beat == 2'd2) begin
        count  <= count + 17'd1;
        enough <= enough || count[1];
      end
    end
    if (rst || soft_reset) state <= IDLE;
  end

  // ---- weights

  generate
    if (WEIGHTED != 0) begin : weights
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
    end else begin : no_weights
      assign beat_weighted = 1'b0;
      assign beat_weight   = 16'd1;
      assign some_weight   = 1'b1;
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
