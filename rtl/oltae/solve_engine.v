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
`include "relnav_words.vh"
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
    output reg         chosen,
    output reg  [ 1:0] turn,
    output reg         rank_deficient,
    output reg         ill_conditioned,
    output reg         saturated
);
  // result kinds, references and modes of sw/relnav/model/assembler.py
  localparam [1:0] RAW = 2'd1, FIXED = 2'd2;
  localparam [3:0] REF_OWN = 4'd0, REF_MOMENT = 4'd1, REF_CROSS = 4'd2, REF_QUATERNION = 4'd3, REF_UNIT = 4'd4,
      REF_CENTROID = 4'd5, REF_ROTATED = 4'd6, REF_PROBED = 4'd8, REF_NEWTON = 4'd9, REF_IMAGE = 4'd10, REF_FORM = 4'd11, REF_COFACTOR = 4'd12;
  localparam [2:0] MARK_Q = 3'd1, MARK_POSE = 3'd2, MARK_BASIC = 3'd3, MARK_ALL = 3'd4;
  localparam [1:0] BROADCAST = 2'd2;  // 1: each lane its own
  localparam [1:0] TRACK_QUATERNION = 2'd1, TRACK_CENTROID = 2'd2, TRACK_AFRESH = 2'd3;
  localparam [1:0] DIVIDE = 2'd1, DIVIDE_UNTURNED = 2'd2, DIVIDE_TURNED = 2'd3;
  localparam [2:0] SINGLE = 3'd1, TRIPLE_COLUMN = 3'd3, PAIR = 3'd4, THIRD = 3'd5;
  localparam [47:0] ONE = {1'b0, -12'd33, 35'h200000000};
  localparam signed [13:0] LOWEST = -14'sd2048;
  // Determinant sums below these, in units of 2^-43 of the largest possible: docs/decisions/conditioning.md
  localparam RANK_BITS = `RELNAV_RANK_BITS, ILL_BITS = `RELNAV_ILL_BITS;

  // ------------------------------------------------------------------ program
  reg run;
  reg [9:0] counter, word_address, dot_address;
  reg second_pass;
  reg reapplied;
  wire finished;
  wire [5:0] x_address;
  wire [4:0] y_address;
  wire x_by_lane, y_by_lane, first;
  wire [3:0] alternate, negate, enable;
  wire [3:0] reference_code;
  wire only_estimated, only_first, clamp;
  wire last, half, turn_dest, only_turned, choose_turn;
  wire [2:0] source, result_output, mark;
  wire [1:0] kind, write, track, divide;
  wire [4:0] dest, divide_dest;
  wire [5:0] output_index;

  // A probed dot product runs twice: the first pass finds its largest exponent, then the program goes back to its first slot.
  wire probed = reference_code == REF_PROBED;
  wire rewind = last & probed & ~second_pass;
  wire leaving;  // the re-application is done
  wire [9:0] following;
  wire [9:0] address = !rewind ? following : first ? word_address : dot_address;

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

  wire start = item_valid & item_first & ~item_low;
  always @(posedge clk) begin
    run          <= start | (run & ~finished & ~all_done);
    counter      <= start ? 10'd2 : address + 10'd1;
    word_address <= address;
    if (first) dot_address <= word_address;
    second_pass  <= rewind | (second_pass & ~last);
    reapplied    <= leaving & ~rewind & run | (reapplied & ~start);
    if (rst) run <= 1'b0;
    if (rst | start) {second_pass, reapplied} <= 2'b00;
  end

  // Result fields travel beside the lanes: raw and fixed results leave in cycle 5, `half` acts in 6, the rest in 7.
  reg [1:0] kind_pipe[1:5];
  reg [7:1] live;  // a dot product ends here
  reg half_1, half_2, half_3, half_4, half_5, half_6;
  reg clamp_1, clamp_2, clamp_3, clamp_4, clamp_5, clamp_6;
  reg choose_1, choose_2, choose_3, choose_4, choose_5, choose_6;
  localparam DEST = 23, TAIL = DEST + 5 + 3 + 2;  // bits below and above `dest`
  reg [TAIL-1:0] tail[1:7];
  integer stage;
  always @(posedge clk) begin
    live         <= rst ? 7'd0 : {live[6:1], last & ~rewind};
    kind_pipe[1] <= kind;
    for (stage = 2; stage <= 5; stage = stage + 1) kind_pipe[stage] <= kind_pipe[stage-1];
    {half_1, half_2, half_3, half_4, half_5, half_6} <= {half, half_1, half_2, half_3, half_4, half_5};
    {clamp_1, clamp_2, clamp_3, clamp_4, clamp_5, clamp_6} <= {clamp, clamp_1, clamp_2, clamp_3, clamp_4, clamp_5};
    {choose_1, choose_2, choose_3, choose_4, choose_5, choose_6} <= {choose_turn, choose_1, choose_2, choose_3, choose_4, choose_5};
    tail[1] <= {last & kind == RAW ? 2'd0 : write, source, dest, turn_dest, only_turned, track, divide, divide_dest, result_output, output_index, mark};
    for (stage = 2; stage <= 7; stage = stage + 1) tail[stage] <= tail[stage-1];
  end
  wire [1:0] write_7, track_7, divide_7;
  wire [2:0] source_7, output_7, mark_7;
  wire [4:0] dest_7, divide_dest_7;
  wire turn_dest_7, only_turned_7;
  wire [5:0] output_index_7;
  assign {write_7, source_7, dest_7, turn_dest_7, only_turned_7, track_7, divide_7, divide_dest_7, output_7, output_index_7, mark_7} =
      tail[7];
  wire [1:0] kind_5 = kind_pipe[5];
  wire write_raw = live[5] & kind_5 == RAW;
  wire [4:0] raw_dest;
  wire [5:0] fixed_index;
  wire unused_5;
  assign {raw_dest, fixed_index, unused_5} = {tail[5][DEST+:5], tail[5][3+:6], ^tail[5]};

  // ------------------------------------------------------------------ scales and reference exponents
  reg signed [13:0] moment_scale, cross_scale, quaternion_scale, centroid_scale;
  wire signed [13:0] item_exponent = {{2{item_value[46]}}, item_value[46:35]};
  wire is_trace = item_valid & ~item_low & ~item_value[47] & item_address[2:0] == 3'd0 & item_address[4:3] != 2'd3;
  wire is_cross = item_valid & ~item_low & ~item_value[47] & item_address[2:0] == 3'd5 & item_address[4:3] != 2'd3;
  wire [47:0] bus;
  wire signed [13:0] bus_exponent = {{2{bus[46]}}, bus[46:35]};
  wire unturned = turn == 2'd0;
  wire suppressed = only_turned_7 & unturned;
  wire [4:0] dest_now = {dest_7[4], dest_7[3] | (turn_dest_7 & unturned), dest_7[2:0]};
  wire track_quaternion = live[7] & track_7 == TRACK_QUATERNION & ~suppressed & dest_now[4:2] == 3'd3 & ~bus[47];
  wire track_afresh = live[7] & track_7 == TRACK_AFRESH;
  wire track_centroid = live[7] & track_7 == TRACK_CENTROID & ~bus[47];

  always @(posedge clk) begin
    if (is_trace && (start || item_exponent > moment_scale)) moment_scale <= item_exponent;
    else if (start) moment_scale <= LOWEST;
    if (start) cross_scale <= LOWEST;
    else if (is_cross && item_exponent > cross_scale) cross_scale <= item_exponent;
    if (start) quaternion_scale <= LOWEST;
    else if (track_afresh || (track_quaternion && bus_exponent > quaternion_scale)) quaternion_scale <= bus[47] ? LOWEST : bus_exponent;
    if (start) centroid_scale <= LOWEST;
    else if (track_centroid && bus_exponent > centroid_scale) centroid_scale <= bus_exponent;
  end

  reg signed [13:0] reference, reference_cross;
  reg [3:0] reference_code_1;
  reg probing_1;
  reg own_reference, probing, probed_reference;
  reg estimated;  // no VARIANCE was given
  wire signed [13:0] quaternion_square = quaternion_scale <<< 1;
  always @(posedge clk) begin
    reference_code_1 <= reference_code;
    own_reference    <= reference_code_1 == REF_OWN;
    probing_1        <= probed & ~second_pass;
    probing          <= probing_1;
    probed_reference <= reference_code_1 == REF_PROBED & ~probing_1;
    if (item_valid && item_address == 5'd29) estimated <= item_value[47];
    case (reference_code_1)
      REF_MOMENT: reference <= moment_scale - 14'sd32;
      REF_CROSS: reference <= moment_scale - 14'sd33;
      REF_QUATERNION: reference <= quaternion_square + 14'sd4;
      REF_UNIT: reference <= -14'sd63;
      REF_CENTROID: reference <= centroid_scale - 14'sd29;
      REF_ROTATED: reference <= quaternion_square + centroid_scale + 14'sd35;
      REF_NEWTON: reference <= moment_scale - 14'sd28;
      REF_IMAGE: reference <= moment_scale + quaternion_scale + 14'sd6;
      REF_COFACTOR: reference <= (moment_scale <<< 1) + 14'sd8;
      REF_FORM: reference <= moment_scale + quaternion_square + 14'sd42;
      default: reference <= -14'sd42;  // Q15.16 with one bit for rounding
    endcase
    reference_cross <= reference_code_1 == REF_CROSS ? cross_scale - 14'sd33 : 14'sd0;
  end
  reg cross_2;
  always @(posedge clk) cross_2 <= reference_code_1 == REF_CROSS;

  // ------------------------------------------------------------------ lanes
  wire [47:0] result[0:3];
  wire signed [47:0] sum[0:3];
  wire [3:0] above;  // of the lanes only lane 0 makes Q15.16
  wire divider_done;
  wire [47:0] divider_result;
  reg [4:0] divider_dest;
  wire register_write = start | divider_done | write_raw | (live[7] & write_7 != 2'd0 & ~suppressed);
  wire [4:0] register_address = start ? 5'd0 : divider_done ? divider_dest : write_raw ? raw_dest : dest_now;
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
          .enable(enable[k] & (estimated | ~only_estimated) & ~(only_first & reapply)),
          .first(first),
          .reference(k == 0 && cross_2 ? reference_cross : reference),
          .own_reference(own_reference),
          .probing(probing),
          .probed_reference(probed_reference),
          .half(half_6),
          .clamp(k == 0 ? clamp_6 : 1'b0),
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
  wire divider_start = live[7] & (divide_7 == DIVIDE | (divide_7 == DIVIDE_UNTURNED & unturned) | (divide_7 == DIVIDE_TURNED & ~unturned));
  always @(posedge clk) if (divider_start) divider_dest <= divide_dest_7;
  reciprocal divider (
      .clk(clk),
      .rst(rst | start),
      .start(divider_start),
      .value(bus),
      .done(divider_done),
      .result(divider_result)
  );

  // ------------------------------------------------------------------ choice of the turn: cycles 5 and 6 of the determinants
  reg upper_01, upper_23;
  // Bits below RANK_BITS are noise and not compared.
  reg signed [47:RANK_BITS] best_01, best_23;
  wire signed [47:RANK_BITS] det_0 = sum[0][47:RANK_BITS], det_1 = sum[1][47:RANK_BITS];
  wire signed [47:RANK_BITS] det_2 = sum[2][47:RANK_BITS], det_3 = sum[3][47:RANK_BITS];
  wire better_1 = ~forbid_turns & det_1 > det_0;
  wire better_3 = det_3 > det_2;
  wire take_23 = ~forbid_turns & best_23 > best_01;
  wire signed [47:RANK_BITS] best = take_23 ? best_23 : best_01;
  wire unused = &{1'b0, above[3:1], unused_5, unused_sums};
  wire unused_sums = ^{sum[0], sum[1], sum[2], sum[3]};
  always @(posedge clk) begin
    upper_01 <= better_1;
    upper_23 <= better_3;
    best_01  <= better_1 ? det_1 : det_0;
    best_23  <= better_3 ? det_3 : det_2;
    chosen   <= live[6] & choose_6;
    if (live[6] & choose_6) begin
      turn            <= {take_23, take_23 ? upper_23 : upper_01};
      rank_deficient  <= best[47] | ~|best[46:RANK_BITS];
      ill_conditioned <= ~best[47] & ~|best[46:ILL_BITS] & |best[46:RANK_BITS];
    end
    if (rst) chosen <= 1'b0;
  end

  // ------------------------------------------------------------------ outputs
  // Q15.16: lane 0's sum, rounded half up in cycle 5, written in cycle 6.
  wire signed [47:0] fixed_sum = sum[0];
  wire fixed_high = above[0] | (fixed_sum[47:32] != {16{fixed_sum[32]}});
  wire [31:0] fixed_rounded = fixed_sum[32:1] + {31'd0, fixed_sum[0]};
  // Rounding can carry out of the top only from 7fffffff.8.
  wire fixed_carry = ~fixed_sum[47] & fixed_rounded[31];
  reg fixed_valid;
  reg [31:0] fixed_data;
  reg [5:0] fixed_index_6;
  always @(posedge clk) begin
    fixed_valid <= live[5] & kind_5 == FIXED;
    fixed_index_6 <= fixed_index;
    fixed_data  <= fixed_high | fixed_carry ? {fixed_sum[47], {31{~fixed_sum[47]}}} : fixed_rounded;
    if (start) saturated <= 1'b0;
    else if (live[5] && kind_5 == FIXED) saturated <= saturated | fixed_high | fixed_carry;
    if (rst) fixed_valid <= 1'b0;
  end

  // binary32: three results of the lanes 1 to 3 leave one a cycle
  reg [47:0] queue_1, queue_2;
  reg [2:0] queue_valid;
  reg [5:0] queue_index;
  reg queue_column;
  reg [2:0] queue_mark;
  wire is_float = live[7] & output_7 != 3'd0;
  wire single = output_7 == SINGLE;
  wire [47:0] head = !is_float ? queue_1 : single ? result[0] : result[1];
  always @(posedge clk) begin
    if (is_float) begin
      queue_1      <= result[2];
      queue_2      <= result[3];
      queue_valid  <= single ? 3'b001 : output_7 == PAIR ? 3'b110 : output_7 == THIRD ? 3'b100 : 3'b111;
      queue_index  <= output_index_7;
      queue_column <= output_7 == TRIPLE_COLUMN;
      queue_mark   <= mark_7;
    end else begin
      queue_1     <= queue_2;
      queue_valid <= queue_valid >> 1;
      queue_index <= queue_index + (queue_column ? 6'd3 : 6'd1);
    end
    if (rst | start) queue_valid <= 3'd0;
  end

  wire [31:0] binary32;
  to_binary32 pack (
      .clk(clk),
      .value(head),
      .binary32(binary32)
  );
  reg valid_1;
  reg [5:0] index_1;
  reg [2:0] mark_1;
  always @(posedge clk) begin
    valid_1 <= queue_valid[0];
    index_1 <= queue_index;
    mark_1  <= queue_valid == 3'b001 ? queue_mark : 3'd0;
    if (rst | start) valid_1 <= 1'b0;
  end

  assign write_valid = valid_1 | fixed_valid;
  assign write_index = fixed_valid ? fixed_index_6 : index_1;
  assign write_data  = fixed_valid ? fixed_data : binary32;
  assign q_done      = valid_1 & mark_1 == MARK_Q;
  assign pose_done   = valid_1 & mark_1 == MARK_POSE;
  assign all_done    = valid_1 & (mark_1 == MARK_ALL | (mark_1 == MARK_BASIC & ~covariance));
endmodule
`resetall
