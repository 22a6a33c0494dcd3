// SPDX-License-Identifier: Apache-2.0
// Plays a file (+stimulus=) into a gram_ring and writes what comes out to another (+response=).
// A line of the stimulus: delay kind index data (hexadecimal). It is presented `delay` clocks after the line before it; a beat stays until
// it is taken.    kind = 64 redrain + 32 checked + 16 wait + 8 rst + 4 clear + 2 beat + last;  wait, checked: the delay counts from item_last,
//   from `checked` on;  redrain: clocks count from here, 0;  rst, clear, redrain: for one clock
// Response, a line each:  item clock row column last moment weight_sum row_count used_count h_bits y_bits weight_bits, clock after the last beat;
//   sums weight_sum row_count used_count | bits h_bits y_bits weight_bits: after the last beat, as early as they are right;
//   checked | waited clock mismatch: at `checked`, waited where a line waits for it;  lost: what a line waits for has not come for 300 clocks;
//   last clock: of the last beat, 0 being the first beat after a clear;   clear: also at rst;   end.
`resetall
`default_nettype none

module gram_ring_player (
    input  wire clk,
    output reg  done
);
  reg [8*256-1:0] name;
  integer stimulus, response, got;
  reg [31:0] delay, kind, index;
  reg [63:0] data;
  reg pending;  // a line is read, but not presented yet
  reg [31:0] since_first, since_last;
  reg begun, ended;

  reg rst, clear, redrain, beat_valid, beat_last;
  reg [63:0] beat_data;
  reg [1:0] beat_index;
  wire beat_ready, item_valid, item_last;
  wire [2:0] item_row, item_column;
  wire signed [95:0] item_moment;
  wire [31:0] weight_sum;
  wire [15:0] row_count, used_count;
  wire [5:0] h_bits, y_bits, weight_bits;
  wire checked, mismatch;
  reg [31:0] waited;

  gram_ring dut (
      .clk(clk),
      .rst(rst),
      .clear(clear),
      .beat_valid(beat_valid),
      .beat_ready(beat_ready),
      .beat_data(beat_data),
      .beat_index(beat_index),
      .beat_last(beat_last),
      .redrain(redrain),
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
      .weight_bits(weight_bits),
      .check(1'b1),
      .checked(checked),
      .mismatch(mismatch),
      .differ()
  );

  initial begin
    done = 0;
    rst = 1;
    clear = 0;
    redrain = 0;
    waited = 0;
    beat_valid = 0;
    beat_last = 0;
    pending = 0;
    begun = 0;
    ended = 0;
    got = $value$plusargs("stimulus=%s", name);
    stimulus = $fopen(name, "r");
    got = $value$plusargs("response=%s", name);
    response = $fopen(name, "w");
  end

  wire beat = beat_valid && beat_ready;

  always @(posedge clk) begin
    // ---- what there is to see
    if (item_valid && !rst)
      $fdisplay(response, "item %0d %0d %0d %0d %h %h %h %h %0d %0d %0d", since_last, item_row, item_column, item_last,
                item_moment, weight_sum, row_count, used_count, h_bits, y_bits, weight_bits);
    if (ended && since_last == 1) $fdisplay(response, "sums %h %h %h", weight_sum, row_count, used_count);
    if (ended && since_last == 6) $fdisplay(response, "bits %0d %0d %0d", h_bits, y_bits, weight_bits);
    if (checked && !rst) $fdisplay(response, "%0s %0d %0d", pending && kind[5] ? "waited" : "checked", since_last, mismatch);
    if (clear || rst) begin
      $fdisplay(response, "clear");
      begun = 0;
      ended = 0;
    end
    since_first = begun ? since_first + 1 : 0;
    since_last  = since_last + 1;
    if (beat) begun = 1;
    if (beat && beat_last) begin
      $fdisplay(response, "last %0d", since_first);
      ended = 1;
      since_last = 1;
    end

    // ---- what comes next
    rst <= 0;
    clear <= 0;
    redrain <= 0;
    if (!beat_valid || beat_ready) begin
      beat_valid <= 0;
      beat_last  <= 0;
      if (!pending && !done) begin
        got = $fscanf(stimulus, "%h %h %h %h\n", delay, kind, index, data);
        pending = got == 4;
        if (!pending) begin
          $fdisplay(response, "end");
          $fclose(response);
          done <= 1;
        end
      end
      if (pending) begin
        if (kind[5:4] != 0) begin
          if (kind[5] ? checked : item_last) kind[5:4] = 0;
          else if (waited == 300) begin
            $fdisplay(response, "lost");
            kind[5:4] = 0;
          end
          waited = kind[5:4] != 0 ? waited + 1 : 0;
        end else if (delay != 0) delay = delay - 1;
        else begin
          {rst, clear, beat_valid, beat_last} <= kind[3:0];
          redrain <= kind[6];
          if (kind[6]) since_last = 0;
          beat_index <= index[1:0];
          beat_data <= data;
          pending = 0;
        end
      end
    end
  end
endmodule

`resetall
