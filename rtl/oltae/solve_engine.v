// SPDX-License-Identifier: Apache-2.0
// Solve engine: four float dot-product lanes, a reciprocal divider and a microprogram turn the centred moments into
// q, R and t by Cramer's rule (rtl/oltae/solve_program.v; equations in sw/relnav/model/pose_program.py).
//
//   items    {address, value} of the moment stream, one a cycle; the first one (item_first) is cycle 0 of the program
//   outputs  q, R, t as binary32 and q as Q15.16, each with its index in the result memory
//
// Lane k solves turn k until the largest determinant chooses, then row k. The program has no interlock: its schedule
// (sw/relnav/model/schedule.py) proves every operand ready and every write and output alone.
// Widths: exponents 12 bits, references 14; determinants compare as 48-bit sums of one common unit.
`resetall
`default_nettype none
module solve_engine #(
    parameter COVARIANCE = 1,  // 0 leaves the covariances' part of the program out
    parameter REAPPLY    = 1   // 0 leaves the re-application out
) (
    input  wire        clk,
    input  wire        rst,
    input  wire        forbid_turns,
    input  wire        covariance,     // wanted
    input  wire        reapply,        // wanted
    // moment stream
    input  wire        item_valid,
    input  wire        item_first,
    input  wire        item_low,       // a low limb, of the second drain
    input  wire [ 4:0] item_address,
    input  wire [47:0] item_value,
    output wire        redrain,        // asks for the low limbs
    // results
    output wire        write_valid,
    output wire [ 5:0] write_index,
    output wire [31:0] write_data,
    output wire        q_done,
    output wire        pose_done,
    output wire        all_done,
    // status, valid from `chosen` on
    output wire        chosen,
    output wire [ 1:0] turn,
    output wire        rank_deficient,
    output wire        ill_conditioned,
    output reg         saturated
);
  // result kinds and modes of sw/relnav/model/assembler.py
  localparam [1:0] RAW = 2'd1, FIXED = 2'd2;
  localparam [3:0] PROBED = 4'd8;
  localparam [1:0] BROADCAST = 2'd2;  // 1: each lane its own
  localparam [1:0] TRACK_QUATERNION = 2'd1, TRACK_CENTROID = 2'd2, TRACK_AFRESH = 2'd3;
  localparam [1:0] DIVIDE = 2'd1, DIVIDE_UNTURNED = 2'd2, DIVIDE_TURNED = 2'd3;
  localparam [2:0] SINGLE = 3'd1, TRIPLE_COLUMN = 3'd3, PAIR = 3'd4, THIRD = 3'd5;
  localparam [2:0] MARK_Q = 3'd1, MARK_POSE = 3'd2, MARK_BASIC = 3'd3, MARK_ALL = 3'd4;
  localparam [47:0] ONE = {1'b0, -12'd33, 35'h200000000};
  localparam [4:0] ADDRESS_VARIANCE = 5'd29;

  wire start = item_valid & item_first & ~item_low;

  // ------------------------------------------------------------------ program
  wire run, finished, leaving, reapplied, probing;
  wire [9:0] counter, address, following;
  wire [5:0] x_address, output_index;
  wire [4:0] y_address, dest, divide_dest;
  wire x_by_lane, y_by_lane, first, last, only_estimated, only_first;
  wire [3:0] alternate, negate, enable, reference_code;
  wire half, clamp, turn_dest, only_turned, choose_turn;
  wire [2:0] source, result_output, mark;
  wire [1:0] kind, write, track, divide;

  sequencer sequence_slots (
      .clk(clk),
      .rst(rst),
      .start(start),
      .stop(finished | all_done),
      .first(first),
      .last(last),
      .probed(reference_code == PROBED),
      .probing(probing),
      .run(run),
      .counter(counter),
      .following(following),
      .leaving(leaving),
      .address(address),
      .reapplied(reapplied)
  );

  solve_program #(
      .COVARIANCE(COVARIANCE),
      .REAPPLY(REAPPLY)
  ) microprogram (
      .clk(clk),
      .run(run),
      .address(address),
      .x_address(x_address),
      .x_by_lane(x_by_lane),
      .y_address(y_address),
      .y_by_lane(y_by_lane),
      .alternate(alternate),
      .negate(negate),
      .enable(enable),
      .first(first),
      .only_estimated(only_estimated),
      .only_first(only_first),
      .reference_code(reference_code),
      .last(last),
      .kind(kind),
      .half(half),
      .clamp(clamp),
      .write(write),
      .source(source),
      .dest(dest),
      .turn_dest(turn_dest),
      .only_turned(only_turned),
      .choose_turn(choose_turn),
      .track(track),
      .divide(divide),
      .divide_dest(divide_dest),
      .result_output(result_output),
      .output_index(output_index),
      .mark(mark),
      .counter(counter),
      .reapply(reapply & ~reapplied),
      .leaving(leaving),
      .following(following),
      .redrain(redrain),
      .finished(finished)
  );

  // ------------------------------------------------------------------ result fields travel beside the lanes
  // Raw and fixed results leave in cycle 5, `half` and `clamp` act in 6, the rest in 7. Bit n - 1 of a pipe is cycle n.
  localparam INDEX = 3, DEST = 23, TAIL = DEST + 5 + 3 + 2;  // places of fields in a tail
  reg [6:0] live;  // a dot product ends here
  reg [4:0] raw_pipe, fixed_pipe, choose_pipe;
  reg [5:0] half_pipe, clamp_pipe;
  reg [TAIL-1:0] tail[1:7];
  integer stage;
  always @(posedge clk) begin
    live        <= {live[5:0], last & ~probing} & {7{~rst}};
    raw_pipe    <= {raw_pipe[3:0], kind == RAW};
    fixed_pipe  <= {fixed_pipe[3:0], kind == FIXED};
    choose_pipe <= {choose_pipe[3:0], choose_turn};
    half_pipe   <= {half_pipe[4:0], half};
    clamp_pipe  <= {clamp_pipe[4:0], clamp};
    tail[1] <= {
      kind == RAW ? 2'd0 : write, source, dest,  // a raw result has been written by then
      turn_dest, only_turned, track, divide, divide_dest, result_output, output_index, mark
    };
    for (stage = 2; stage <= 7; stage = stage + 1) tail[stage] <= tail[stage-1];
  end
  wire write_raw = live[4] & raw_pipe[4];
  wire write_fixed = live[4] & fixed_pipe[4];
  wire [TAIL-1:0] tail_5 = tail[5];
  wire live_7 = live[6];
  wire [1:0] write_7, track_7, divide_7;
  wire [2:0] source_7, output_7, mark_7;
  wire [4:0] dest_7, divide_dest_7;
  wire turn_dest_7, only_turned_7;
  wire [5:0] output_index_7;
  assign {write_7, source_7, dest_7,
          turn_dest_7, only_turned_7, track_7, divide_7, divide_dest_7, output_7, output_index_7, mark_7} = tail[7];

  // ------------------------------------------------------------------ references
  wire [47:0] bus;
  wire unturned = turn == 2'd0;
  wire suppressed = only_turned_7 & unturned;
  wire [4:0] dest_now = {dest_7[4], dest_7[3] | (turn_dest_7 & unturned), dest_7[2:0]};
  wire signed [13:0] common, reference_0;
  wire own, probing_2, probed_2;

  reference_exponent references (
      .clk(clk),
      .start(start),
      .item_valid(item_valid & ~item_low),
      .item_address(item_address),
      .item_value(item_value),
      .track_afresh(live_7 & track_7 == TRACK_AFRESH),
      // D is part of the quaternion only where it goes there
      .track_quaternion(live_7 & track_7 == TRACK_QUATERNION & ~suppressed & dest_now[4:2] == 3'd3),
      .track_centroid(live_7 & track_7 == TRACK_CENTROID),
      .bus(bus),
      .code(reference_code),
      .probing(probing),
      .common(common),
      .lane_0(reference_0),
      .own(own),
      .probing_2(probing_2),
      .probed_2(probed_2)
  );

  reg estimated;  // no VARIANCE was given
  always @(posedge clk) if (item_valid && item_address == ADDRESS_VARIANCE) estimated <= item_value[47];
  wire counts = (estimated | ~only_estimated) & ~(only_first & reapply);

  // ------------------------------------------------------------------ lanes
  wire [47:0] result[0:3];
  wire signed [47:0] sum[0:3];
  wire [3:0] above;  // of the lanes only lane 0 makes Q15.16
  wire divider_done;
  wire [47:0] divider_result;
  reg [4:0] divider_dest;
  wire register_write = start | divider_done | write_raw | (live_7 & write_7 != 2'd0 & ~suppressed);
  wire [4:0] register_address = start ? 5'd0 : divider_done ? divider_dest : write_raw ? tail_5[DEST+:5] : dest_now;
  wire register_broadcast = start | divider_done | write_7 == BROADCAST;

  genvar k;
  generate
    for (k = 0; k < 4; k = k + 1) begin : lane
      dot_lane #(
          .LANE(k),
          .WIDE(k == 0)
      ) dot (
          .clk(clk),
          .x_address(x_address),
          .x_by_lane(x_by_lane),
          .y_address(y_address),
          .y_by_lane(y_by_lane),
          .alternate(alternate[k]),
          .negate(negate[k]),
          .enable(enable[k] & counts),
          .first(first),
          .reference(k == 0 ? reference_0 : common),
          .own_reference(own),
          .probing(probing_2),
          .probed_reference(probed_2),
          .round_raw(raw_pipe[3]),
          .half(half_pipe[5]),
          .clamp(k == 0 ? clamp_pipe[5] : 1'b0),
          .write(register_write),
          .write_address(register_address),
          .write_broadcast(register_broadcast),
          .write_raw(write_raw),
          .broadcast(bus),
          .stream_write(item_valid),
          .stream_address(item_address),
          .stream_value(item_value),
          .result(result[k]),
          .sum(sum[k]),
          .overflow(above[k])
      );
    end
  endgenerate

  wire [1:0] source_lane = source_7[2] ? turn : source_7[1:0];
  assign bus = start ? ONE : divider_done ? divider_result : result[source_lane];

  // ------------------------------------------------------------------ divider
  wire divider_start = live_7 &
      (divide_7 == DIVIDE | (divide_7 == DIVIDE_UNTURNED & unturned) | (divide_7 == DIVIDE_TURNED & ~unturned));
  always @(posedge clk) if (divider_start) divider_dest <= divide_dest_7;
  reciprocal divider (
      .clk(clk),
      .rst(rst | start),
      .start(divider_start),
      .value(bus),
      .done(divider_done),
      .result(divider_result)
  );

  turn_choice choice (
      .clk(clk),
      .rst(rst),
      .valid(live[4] & choose_pipe[4]),
      .forbid_turns(forbid_turns),
      .det_0(sum[0]),
      .det_1(sum[1]),
      .det_2(sum[2]),
      .det_3(sum[3]),
      .chosen(chosen),
      .turn(turn),
      .rank_deficient(rank_deficient),
      .ill_conditioned(ill_conditioned)
  );

  // ------------------------------------------------------------------ outputs
  wire [31:0] fixed, binary32;
  wire saturates, word_valid;
  reg fixed_valid;
  reg [5:0] fixed_index;
  wire [5:0] word_index;
  wire [2:0] word_mark;
  fixed_output fixed_point (
      .clk(clk),
      .sum(sum[0]),
      .above(above[0]),
      .fixed(fixed),
      .saturates(saturates)
  );
  always @(posedge clk) begin
    fixed_valid <= write_fixed & ~rst;
    fixed_index <= tail_5[INDEX+:6];
    saturated   <= ((write_fixed & saturates) | saturated) & ~start;
  end

  result_queue queue (
      .clk(clk),
      .rst(rst | start),
      .enter(live_7 & output_7 != 3'd0),
      .places(output_7 == SINGLE ? 3'b001 : output_7 == PAIR ? 3'b110 : output_7 == THIRD ? 3'b100 : 3'b111),
      .single(output_7 == SINGLE),
      .column(output_7 == TRIPLE_COLUMN),
      .index(output_index_7),
      .mark(mark_7),
      .result_0(result[0]),
      .result_1(result[1]),
      .result_2(result[2]),
      .result_3(result[3]),
      .valid(word_valid),
      .word_index(word_index),
      .word_mark(word_mark),
      .word(binary32)
  );

  assign write_valid = word_valid | fixed_valid;
  assign write_index = fixed_valid ? fixed_index : word_index;
  assign write_data  = fixed_valid ? fixed : binary32;
  assign q_done      = word_valid & word_mark == MARK_Q;
  assign pose_done   = word_valid & word_mark == MARK_POSE;
  assign all_done    = word_valid & (word_mark == MARK_ALL | (word_mark == MARK_BASIC & ~covariance));

  wire unused = &{1'b0, above[3:1], tail_5};
endmodule
`resetall
