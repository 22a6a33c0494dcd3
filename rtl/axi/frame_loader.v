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
// give_up takes no beat of a frame that loads either; the frame is swallowed to its end, where frame_dropped comes without a flag. It may stay.
//
// Upsets: state, source, beat and mode are voted; a flip of the rest makes a flag at worst. A row's weight, held for the row, has a twin;
// `upset` tells in the next clock of a weight that changed while a frame was loading, and of a frame given up, so that none goes without
// a flag. The rows are counted once: `rows` is there to be compared with the array's count.
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
    input wire give_up,      // give the open frame up

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
    output wire too_long,       // frame_dropped comes now or later

    // trust
    output wire        open,   // a frame is, or is being swallowed
    output wire [15:0] rows,   // complete, of the open frame; after frame_end until the next clear
    output reg         upset   // the frame was given up, or the weight held had changed
);

  // both states with the upper bit are SWALLOW
  localparam [1:0] IDLE = 2'd0, LOAD = 2'd1, SWALLOW = 2'd2;
  localparam LAST = BEATS - 1, BEFORE = LEAST - 2;
  localparam [1:0] LAST_BEAT = LAST[1:0];
  localparam [1:0] WEIGHT_BEAT = 2'd3;  // in front
  localparam [2:0] ALMOST = BEFORE[2:0];

  wire [1:0] state;
  wire from_push;
  wire [1:0] beat;  // the beat awaited
  reg [15:0] count;  // rows complete; the core's counters carry no more
  reg enough;  // all but one of the rows needed are complete
  wire load = state == LOAD;
  wire swallow = state[1];
  wire hold = soft_reset || (give_up && load);
  wire some_weight;  // a weight that is not 0 has come, or comes with this beat

  // ---- source

  wire valid = from_push ? push_valid : s_axis_tvalid;
  wire last = from_push ? push_last : s_axis_tlast;
  assign beat_data = from_push ? push_data : s_axis_tdata;

  wire weight_beat = WEIGHTED == 1 && beat == WEIGHT_BEAT;
  wire first = beat == (beat_weighted ? WEIGHT_BEAT : 2'd0);
  wire closing = beat == LAST_BEAT;
  wire full = count == 16'hFFFF && first;
  wire to_array = load && !weight_beat && !full && !hold;
  wire taken_here = swallow || (load && (weight_beat || full));
  wire ready = (to_array && beat_ready) || (taken_here && !hold);
  wire fire = valid && ready;

  assign s_axis_tready = ready && !from_push;
  assign push_ready = ready && from_push;
  assign push_open = !open ? accept : from_push;

  // ---- Gram array

  wire good = enough && some_weight;

  assign open = load || swallow;
  assign rows = count;
  assign clear = !open && accept && !soft_reset && (push_valid || s_axis_tvalid);
  assign beat_valid = to_array && valid;
  assign beat_index = beat;
  assign beat_last = last && closing && good;

  // ---- events

  wire ends = fire && last;
  wire ends_row = ends && load && closing;  // the last beat is never the first, so never full

  assign frame_start = clear;
  assign frame_end = ends_row && good;
  assign frame_dropped = ends && !frame_end;
  assign few_rows = ends_row && !enough;
  assign zero_weight = ends_row && !some_weight;
  assign bad_tlast = ends && load && !closing && !full;
  assign too_long = fire && load && full;

  reg [1:0] next_state;
  always @* begin
    next_state = state;
    if (clear) next_state = LOAD;
    else if (fire && last) next_state = IDLE;
    else if ((fire && load && full) || (give_up && load)) next_state = SWALLOW;
    if (soft_reset) next_state = IDLE;
  end

  wire row_done = fire && load && closing;

  voted_register #(
      .WIDTH(5),
      .RESET(5'd0)
  ) state_register (
      .clk(clk),
      .rst(rst),
      .d({
        next_state,
        clear ? push_valid : from_push,
        clear ? (WEIGHTED == 1 && weighted ? WEIGHT_BEAT : 2'd0) : fire ? (closing && !beat_weighted ? 2'd0 : beat + 2'd1) : beat
      }),
      .q({state, from_push, beat})
  );

  always @(posedge clk)
    if (clear) begin
      count  <= 16'd0;
      enough <= 1'b0;
    end else if (row_done) begin
      count  <= count + 16'd1;
      enough <= enough || count[2:0] == ALMOST;
    end

  // ---- weights

  wire differ;
  always @(posedge clk) upset <= (differ || give_up) && load && !rst;

  generate
    if (WEIGHTED == 1) begin : g_front
      wire mode;
      reg some;
      wire take = fire && weight_beat;
      voted_register #(
          .WIDTH(1),
          .RESET(1'b0)
      ) mode_register (
          .clk(clk),
          .rst(rst),
          .d  (clear ? weighted : mode),
          .q  (mode)
      );
      always @(posedge clk)
        if (clear) some <= !weighted;
        else if (take) some <= some || beat_data[15:0] != 16'd0;
      twin_register #(
          .WIDTH(16),
          .RESET(16'd1)
      ) weight_register (
          .clk(clk),
          .rst(rst || clear),
          .load(take),
          .d(beat_data[15:0]),
          .q(beat_weight),
          .differ(differ)
      );
      assign beat_weighted = mode;
      assign some_weight   = some;
    end else begin : g_fixed
      assign beat_weighted = 1'b0;
      assign differ = 1'b0;
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
      default: state_name = "SWALLOW";
    endcase
  // synthesis translate_on

endmodule

`resetall
