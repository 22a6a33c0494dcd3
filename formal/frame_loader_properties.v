// SPDX-License-Identifier: Apache-2.0
// What frame_loader promises, for SymbiYosys (frame_loader.sby), in each of the three parameter sets that the cores use. Every input is
// free in every clock: sources may withdraw a beat, `accept` and `weighted` may change at any time, both sources may offer at once.
//
// The model below is a frame by its handshakes at the pins: how many rows are complete, which beat of the row comes next, whether a
// weight was not 0. `dut_*` are the loader's own registers (connected by the script), only to make the induction short.
// ANYWHERE = 1 starts in any state that the model can be in, not at reset: so a bounded check sees row 65536 too.
`resetall
`default_nettype none

module frame_loader_properties #(
    parameter BEATS    = 3,
    parameter LEAST    = 3,
    parameter WEIGHTED = 1,
    parameter ANYWHERE = 0
) (
    input wire        clk,
    input wire        rst,
    input wire        accept,
    input wire        weighted,
    input wire        soft_reset,
    input wire        give_up,
    input wire [63:0] s_axis_tdata,
    input wire        s_axis_tvalid,
    input wire        s_axis_tlast,
    input wire        push_valid,
    input wire [63:0] push_data,
    input wire        push_last,
    input wire        beat_ready
);
  wire s_axis_tready, push_ready, push_open, clear, beat_weighted, beat_valid, beat_last;
  wire frame_start, frame_end, frame_dropped, few_rows, zero_weight, bad_tlast, too_long;
  wire open_told, upset;
  wire [15:0] rows_told;
  wire [63:0] beat_data;
  wire [ 1:0] beat_index;
  wire [15:0] beat_weight;

  frame_loader #(
      .BEATS(BEATS),
      .LEAST(LEAST),
      .WEIGHTED(WEIGHTED)
  ) dut (
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
      .push_open(push_open),
      .clear(clear),
      .beat_weighted(beat_weighted),
      .beat_valid(beat_valid),
      .beat_ready(beat_ready),
      .beat_data(beat_data),
      .beat_index(beat_index),
      .beat_weight(beat_weight),
      .beat_last(beat_last),
      .frame_start(frame_start),
      .frame_end(frame_end),
      .frame_dropped(frame_dropped),
      .few_rows(few_rows),
      .zero_weight(zero_weight),
      .bad_tlast(bad_tlast),
      .too_long(too_long),
      .open(open_told),
      .rows(rows_told),
      .upset(upset)
  );

  // connected to the loader's registers by the script; dut_some only where there is one
  wire [ 1:0] dut_state;
  wire [ 1:0] dut_beat;
  wire [15:0] dut_count;
  wire dut_from_push, dut_enough, dut_some, dut_differ;

  reg started = 1'b0;
  always @(posedge clk) started <= 1'b1;

  // ---- the frame by its handshakes

  reg open;  // between frame_start and the last beat
  reg source;  // 1: push register
  reg mode;  // weight beats in front
  reg over;  // a beat too many has come, or it was given up
  reg ended;  // the last frame ended well
  reg was_given_up;
  reg [16:0] rows;  // complete
  reg [1:0] place;  // of the beat that comes next in its row, a weight in front counted
  reg some;  // a weight that is not 0 has come
  reg [15:0] weight;
  reg [7:0] taken, given, kept;  // beats, modulo 256

  wire take_stream = s_axis_tvalid && s_axis_tready && !rst;
  wire take_push = push_valid && push_ready && !rst;
  wire take = take_stream || take_push;
  wire [63:0] take_data = take_push ? push_data : s_axis_tdata;
  wire take_last = take_push ? push_last : s_axis_tlast;
  wire give = beat_valid && beat_ready && !rst;

  wire in_front = WEIGHTED == 1 && mode && place == 2'd0;
  wire [1:0] final_place = BEATS - 1 + (WEIGHTED == 1 && mode);
  wire closing = place == final_place;
  wire beyond = rows == 17'd65535 && place == 2'd0;  // no row may begin
  wire for_array = !over && !beyond && !in_front;
  wire offered = source ? push_valid : s_axis_tvalid;
  wire offered_last = source ? push_last : s_axis_tlast;
  wire some_now = WEIGHTED == 0 || (WEIGHTED == 1 && (!mode || some)) || (WEIGHTED == 2 && (some || take_data[47:32] != 16'd0));
  wire ends_row = take && take_last && !over && !beyond && closing;
  wire good_end = ends_row && rows + 17'd1 >= LEAST && some_now;

  always @(posedge clk) begin
    if (take) begin
      place <= closing ? 2'd0 : place + 2'd1;
      if (closing && !over) rows <= rows + 17'd1;
      if (beyond) over <= 1'b1;
      if (take_last) open <= 1'b0;
      if (in_front && !over && !beyond) weight <= take_data[15:0];
      if (WEIGHTED == 1 && in_front && !over && !beyond && take_data[15:0] != 16'd0) some <= 1'b1;
      if (WEIGHTED == 2 && closing && take_data[47:32] != 16'd0) some <= 1'b1;
    end
    if (frame_start) begin
      open <= 1'b1;
      source <= push_valid;
      mode <= weighted;
      over <= 1'b0;
      rows <= 17'd0;
      place <= 2'd0;
      some <= 1'b0;
      weight <= 16'd1;
    end
    if (give_up && open) over <= 1'b1;
    was_given_up <= give_up && open && !over && !rst;
    if (rst || soft_reset) open <= 1'b0;
    ended <= !rst && !soft_reset && (ended ? !frame_start : frame_end);

    taken <= taken + {7'd0, take};
    given <= given + {7'd0, give};
    kept  <= kept + {7'd0, take && !for_array};
    if (rst) {taken, given, kept} <= 24'd0;
  end

  wire [1:0] dut_place = WEIGHTED == 1 && mode ? dut_beat + 2'd1 : dut_beat;
  wire consistent = dut_state == {open && over, open && !over} && (!open || (dut_from_push == source &&
      (over || (dut_place == place && dut_count == rows[15:0] && rows < 17'd65535 + (place == 2'd0) && place <= final_place &&
       dut_enough == (rows + 17'd1 >= LEAST) && (WEIGHTED != 1 || (beat_weighted == mode && dut_some == (!mode || some))) &&
       (WEIGHTED != 2 || dut_some == some))))) && (!ended || dut_count == rows[15:0]) && (WEIGHTED != 1 || !dut_differ) && taken == given + kept;
  // the weight of a row stands from the clock after it was taken
  wire weight_held = !open || over || beyond || WEIGHTED != 1 || (beat_weight == (mode ? weight : 16'd1));

  always @* if (!started) assume (ANYWHERE != 0 ? consistent && weight_held : rst);

  // ---- promises

  reg was_reset, was_offered, was_last, was_offered_last;
  reg [63:0] was_data;
  reg [ 1:0] was_index;
  reg [15:0] was_weight;
  always @(posedge clk) begin
    was_reset <= rst;
    was_offered <= beat_valid && !beat_ready && !rst && !soft_reset;
    was_offered_last <= offered_last;
    {was_data, was_index, was_weight, was_last} <= {beat_data, beat_index, beat_weight, beat_last};
  end

  always @(posedge clk) if (started || ANYWHERE != 0) begin
    same_state : assert (consistent);
    same_weight : assert (weight_held);
  end

  always @(posedge clk) if ((started || ANYWHERE != 0) && !rst) begin
    // a frame is opened by a beat that waits, which is not taken yet
    opens : assert (frame_start == (!open && accept && !soft_reset && (push_valid || s_axis_tvalid)));
    clears : assert (clear == frame_start);
    closed_takes_none : assert (open || (!s_axis_tready && !push_ready && !beat_valid));
    open_right : assert (open_told == open);
    if ((open && !over) || ended) rows_right : assert ({1'b0, rows_told} == rows);
    if (started) upset_told : assert (upset == was_given_up);
    abort_takes_none : assert (!give_up || over || (!s_axis_tready && !push_ready && !beat_valid));
    reset_takes_none : assert (!soft_reset || (!s_axis_tready && !push_ready && !beat_valid));
    if (open) one_source : assert (source ? !s_axis_tready : !push_ready);
    push_told : assert (push_open == (open ? source : accept));
    // no beat is lost, doubled, changed or moved
    no_beat_lost : assert (!(take && for_array) || give);
    no_beat_made : assert (!beat_valid || (open && for_array && offered));
    no_beat_twice : assert (!give || take);
    beats_add_up : assert (taken == given + kept);
    if (give) beat_unchanged : assert (beat_data == take_data);
    if (beat_valid) beat_in_place : assert (beat_index == place - {1'b0, WEIGHTED == 1 && mode});
    if (beat_valid && place == final_place)
      weight_right : assert (beat_weight == (WEIGHTED == 2 ? beat_data[47:32] : WEIGHTED == 1 && mode ? weight : 16'd1));
    if (open) mode_right : assert (WEIGHTED == 1 ? beat_weighted == mode || over : !beat_weighted);
    // an offered beat stays as it is while its source keeps it
    if (started && was_offered && !soft_reset && !give_up && offered && beat_data == was_data && offered_last == was_offered_last)
      beat_stays : assert (beat_valid && beat_index == was_index && beat_weight == was_weight && beat_last == was_last);
    // it never stops: a beat that is offered and wanted is taken
    if (open && offered && !soft_reset && !(give_up && !over) && (beat_ready || !for_array)) takes : assert (take);
    // one verdict a frame, with the last beat
    ends_once : assert (frame_end == good_end);
    drops_once : assert (frame_dropped == (take && take_last && !good_end));
    last_marked : assert (frame_end == (give && beat_last));
    few_right : assert (few_rows == (ends_row && rows + 17'd1 < LEAST));
    zero_right : assert (zero_weight == (ends_row && !some_now));
    tlast_right : assert (bad_tlast == (take && take_last && !over && !beyond && !closing));
    long_right : assert (too_long == (take && !over && beyond));
    if (frame_dropped) drop_told : assert (few_rows || zero_weight || bad_tlast || too_long || over);
  end
  always @(posedge clk) if (started && !rst && $past(rst || soft_reset)) closed_by_reset : assert (!open && dut_state == 2'd0);
endmodule

// No valid depends on a ready of the same clock, no ready on a source's valid. Two loaders get the same inputs until one clock, in which
// beat_ready differs (or, with `other`, the offered beats do): all but the readies (or the readies) must still agree.
module frame_loader_dependence #(
    parameter BEATS    = 3,
    parameter LEAST    = 3,
    parameter WEIGHTED = 1
) (
    input wire         clk,
    input wire         differ,
    input wire         other,
    input wire [136:0] inputs,
    input wire [131:0] source_b
);
  reg started = 1'b0, parted = 1'b0;
  always @(posedge clk) begin
    started <= 1'b1;
    parted  <= parted || differ;
  end
  wire [136:0] second = {inputs[136:132], differ && other ? source_b : inputs[131:0]};
  wire ready_a;
  wire [85:0] valids_a, valids_b;
  wire [1:0] readies_a, readies_b;
  wire [39:0] state_a, state_b;
  (* anyseq *) wire ready;
  frame_loader_pins #(BEATS, LEAST, WEIGHTED) a (clk, inputs, ready, valids_a, readies_a, state_a);
  frame_loader_pins #(BEATS, LEAST, WEIGHTED) b (clk, second, ready ^ (differ && !other), valids_b, readies_b, state_b);
  always @* if (!started) assume (inputs[135] && !differ);  // reset
  always @(posedge clk) if (started && !parted) begin
    if (!other) valid_needs_no_ready : assert (valids_a == valids_b);
    if (other) ready_needs_no_valid : assert (readies_a == readies_b);
    same_state : assert (state_a[1:0] == state_b[1:0] && (state_a[1:0] == 2'd0 || state_a == state_b));
  end
endmodule

module frame_loader_pins #(
    parameter BEATS    = 3,
    parameter LEAST    = 3,
    parameter WEIGHTED = 1
) (
    input  wire         clk,
    input  wire [136:0] inputs,
    input  wire         beat_ready,
    output wire [ 85:0] valids,
    output wire [  1:0] readies,
    output wire [ 39:0] state
);
  wire give_up, rst, accept, weighted, soft_reset, s_axis_tvalid, s_axis_tlast, push_valid, push_last;
  wire [63:0] s_axis_tdata, push_data;
  assign {give_up, rst, accept, weighted, soft_reset, s_axis_tvalid, s_axis_tlast, push_valid, push_last, s_axis_tdata, push_data} = inputs;
  wire clear, beat_valid, beat_last, frame_start, beat_weighted, dut_from_push, dut_enough, dut_some;
  wire [63:0] beat_data;
  wire [ 1:0] beat_index, dut_state, dut_beat;
  wire [15:0] beat_weight;
  wire [15:0] dut_count;
  assign valids = {clear, frame_start, beat_valid, {beat_data, beat_index, beat_weight, beat_last} & {83{beat_valid}}};
  assign state = {beat_weight & {16{WEIGHTED == 1}}, beat_weighted, dut_some & WEIGHTED != 0, dut_enough, dut_from_push, dut_count, dut_beat,
                  dut_state};
  frame_loader #(
      .BEATS(BEATS),
      .LEAST(LEAST),
      .WEIGHTED(WEIGHTED)
  ) dut (
      .clk(clk),
      .rst(rst),
      .accept(accept),
      .weighted(weighted),
      .soft_reset(soft_reset),
      .give_up(give_up),
      .s_axis_tdata(s_axis_tdata),
      .s_axis_tvalid(s_axis_tvalid),
      .s_axis_tready(readies[0]),
      .s_axis_tlast(s_axis_tlast),
      .push_valid(push_valid),
      .push_data(push_data),
      .push_last(push_last),
      .push_ready(readies[1]),
      .push_open(),
      .clear(clear),
      .beat_weighted(beat_weighted),
      .beat_valid(beat_valid),
      .beat_ready(beat_ready),
      .beat_data(beat_data),
      .beat_index(beat_index),
      .beat_weight(beat_weight),
      .beat_last(beat_last),
      .frame_start(frame_start),
      .frame_end(),
      .frame_dropped(),
      .few_rows(),
      .zero_weight(),
      .bad_tlast(),
      .too_long(),
      .open(),
      .rows(),
      .upset()
  );
endmodule

`resetall
