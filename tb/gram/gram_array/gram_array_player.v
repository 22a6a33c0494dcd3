// SPDX-License-Identifier: Apache-2.0
// Plays frames from a file (+stimulus=) into a gram_array and writes what comes out to another (+response=).
// A line: kind repeat gap weight beat_x beat_y beat_z (hexadecimal)
//   kind 0: points, 1: points, the last of which ends the frame (then waits for pair_last), 2: clear, gap clocks ahead of the next line
//   (with the next beat itself for gap 0), weight = mode, 3: redrain, 4: one point given up after its first `repeat` beats, 5: rst,
//   6: as 1, but the next line follows gap clocks after the last beat, 7: as 4, with a clear in the clock after its last beat,
//   8: wait until the drain is checked, 9: as 3, but this drain is checked
// gap: up to that many idle clocks before every beat (random).
// Response, a line each:  pair clock slot lane last moment first_i first_j weight_sum point_count first_moments, clock after the last beat;
//   sums weight_sum point_count | first first_moments: once after the last beat, as early as they are right;  clear;  end;
//   checked | waited clock mismatch: at `checked`, waited where line 8 waits;  lost: neither came, nor pair_last, for 300 clocks.
`resetall
`default_nettype none
`include "relnav_words.vh"

module gram_array_player #(
    parameter WEIGHTED = 1
) (
    input  wire clk,
    output reg  done
);
  localparam READ = 0, PLAY = 1, WAIT = 2, PAUSE = 3, CHECK = 4;

  reg [8*256-1:0] name;
  integer stimulus, response, got;
  integer state;
  reg [31:0] kind, repeats, gap, idle, weight, clocks;
  reg [63:0] words[0:2];
  reg [63:0] x, y, z;
  reg first;

  reg rst, clear, weighted, beat_valid, beat_last, redrain;
  reg [63:0] beat_data;
  reg [15:0] beat_weight;
  reg [1:0] beat_index;
  wire beat_ready, pair_valid, pair_last;
  wire [1:0] pair_slot;
  wire [2:0] pair_lane;
  wire signed [`RELNAV_M2(WEIGHTED)-1:0] pair_moment;
  wire signed [`RELNAV_M1(WEIGHTED)-1:0] pair_first_i, pair_first_j;
  wire [`RELNAV_W(WEIGHTED)-1:0] weight_sum;
  wire [15:0] point_count;
  wire [6*`RELNAV_M1(WEIGHTED)-1:0] first_moments;
  reg check;
  wire checked, mismatch, value_valid;
  wire [15:0] used_count;
  wire [4:0] value_address;
  wire [`RELNAV_M1(WEIGHTED)-1:0] value;

  gram_array #(
      .WEIGHTED(WEIGHTED)
  ) dut (
      .clk(clk),
      .rst(rst),
      .clear(clear),
      .weighted(weighted),
      .beat_valid(beat_valid),
      .beat_ready(beat_ready),
      .beat_data(beat_data),
      .beat_index(beat_index),
      .beat_weight(beat_weight),
      .beat_last(beat_last),
      .redrain(redrain),
      .pair_valid(pair_valid),
      .pair_slot(pair_slot),
      .pair_lane(pair_lane),
      .pair_last(pair_last),
      .pair_moment(pair_moment),
      .pair_first_i(pair_first_i),
      .pair_first_j(pair_first_j),
      .weight_sum(weight_sum),
      .point_count(point_count),
      .used_count(used_count),
      .first_moments(first_moments),
      .check(check),
      .value_valid(value_valid),
      .value_address(value_address),
      .value(value),
      .checked(checked),
      .mismatch(mismatch)
  );

  value_feeder #(
      .WEIGHTED(WEIGHTED)
  ) feeder (
      .clk(clk),
      .rst(rst),
      .clear(clear),
      .pair_last(pair_last && pair_valid && check),
      .weight_sum(weight_sum),
      .used_count(used_count),
      .first_moments(first_moments),
      .moment_scale(12'd0),
      .variance(32'd0),
      .value_valid(value_valid),
      .value_address(value_address),
      .value(value),
      .value_scale()
  );

  initial begin
    done = 0;
    state = READ;
    rst = 1;
    clear = 0;
    weighted = 0;
    beat_valid = 0;
    beat_last = 0;
    redrain = 0;
    check = 1;
    beat_index = 0;
    first = 0;
    got = $value$plusargs("stimulus=%s", name);
    stimulus = $fopen(name, "r");
    got = $value$plusargs("response=%s", name);
    response = $fopen(name, "w");
  end

  // The beat `beat_index` comes now, or idles first.
  task offer;
    input [31:0] wait_clocks;
    begin
      beat_valid <= wait_clocks == 0;
      idle <= wait_clocks;
    end
  endtask

  reg [31:0] wait_now;
  reg [1:0] index_now;

  always @(posedge clk) begin
    clocks <= clocks + 1;
    rst <= 0;
    clear <= 0;
    redrain <= 0;
    if (pair_valid && !rst)
      $fdisplay(response, "pair %0d %0d %0d %0d %h %h %h %h %h %h", clocks, pair_slot, pair_lane, pair_last, pair_moment,
                pair_first_i, pair_first_j, weight_sum, point_count, first_moments);
    if (checked) $fdisplay(response, "%0s %0d %0d", state == CHECK ? "waited" : "checked", clocks, mismatch);
    if (clear) $fdisplay(response, "clear");
    if (state == WAIT && kind == 1 && clocks == 1) $fdisplay(response, "sums %h %h", weight_sum, point_count);
    if (state == WAIT && kind == 1 && clocks == (WEIGHTED != 0 ? 4 : 2)) $fdisplay(response, "first %h", first_moments);
    case (state)
      READ: begin
        got = $fscanf(stimulus, "%h %h %h %h %h %h %h\n", kind, repeats, gap, weight, x, y, z);
        if (got != 7) begin
          if (!done) begin
            $fdisplay(response, "end");
            $fclose(response);
          end
          done <= 1;
        end else begin
          words[0] = x;
          words[1] = y;
          words[2] = z;
          case (kind)
            2: begin
              clear <= 1;
              check <= 1;
              weighted <= weight[0];
              if (gap == 0) first = 1;
              else begin
                idle <= gap;
                state <= PAUSE;
              end
              if (gap == 0) begin
                // the clear lasts one clock, that of the next line's first beat
                got = $fscanf(stimulus, "%h %h %h %h %h %h %h\n", kind, repeats, gap, weight, x, y, z);
                words[0] = x;
                words[1] = y;
                words[2] = z;
              end
            end
            3, 9: begin
              redrain <= 1;
              check <= kind == 9;
              clocks <= 0;
              state <= WAIT;
            end
            5: begin
              rst <= 1;
              idle <= 2;
              state <= PAUSE;
            end
            8: state <= CHECK;
            default: ;
          endcase
          if (kind == 0 || kind == 1 || kind == 4 || kind == 6 || kind == 7) begin
            wait_now = first || gap == 0 ? 0 : $urandom;
            if (gap != 0 && !first) wait_now = wait_now % (gap + 1);
            first = 0;
            beat_index <= 0;
            beat_data <= words[0];
            beat_weight <= weight[15:0];
            beat_last <= 0;
            offer(wait_now);
            state <= PLAY;
          end
        end
      end
      PLAY:
      if (!beat_valid) begin
        if (idle <= 1) beat_valid <= 1;
        idle <= idle - 1;
      end else if (beat_ready) begin
        beat_valid <= 0;
        beat_last <= 0;
        if (beat_last) begin
          clocks <= 1;
          idle   <= gap;
          state  <= kind == 6 ? PAUSE : WAIT;
        end else if ((kind == 4 || kind == 7) && beat_index + 1 == repeats) begin
          clear <= kind == 7;
          state <= READ;
        end else if (beat_index == 2 && repeats == 1) state <= READ;
        else begin
          if (beat_index == 2) repeats = repeats - 1;
          index_now = beat_index == 2 ? 0 : beat_index + 1;
          beat_index <= index_now;
          beat_data <= words[index_now];
          beat_last <= (kind == 1 || kind == 6) && repeats == 1 && index_now == 2;
          wait_now = gap == 0 ? 0 : $urandom;
          if (gap != 0) wait_now = wait_now % (gap + 1);
          offer(wait_now);
        end
      end
      WAIT, CHECK:
      if (state == WAIT ? pair_last : checked) state <= READ;
      else if (clocks > 300) begin
        $fdisplay(response, "lost");
        state <= READ;
      end
      default: begin
        idle <= idle - 1;
        if (idle <= 1) state <= READ;
      end
    endcase
  end
endmodule

`resetall
