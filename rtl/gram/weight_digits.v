// SPDX-License-Identifier: Apache-2.0
// Front end of the WEIGHTED array: multiplies each beat by its weight and presents it once (unweighted) or twice (weighted: the three
// beats of a point with their lower digits, then the three again with the highest digit: no new beat for three clocks).
//   in : beat accepted (beat_valid, with beat_ready high)
//   out: step with index, set (pass), last (the frame's last step), operands x, y = {b, a} as pass_digits says; latency 2 clocks
//   terms: weight * (u - 2^15), valid with term_valid (first pass)
//
// clock    0   1   2   3   4   5   6   7   8   9   10
// beat     0   1   2   -   -   -   0'  1'  2'  -   -     - : beat_ready low
// step             0   1   2   0*  1*  2*  0'  1'  2'    * : second pass
`resetall
`default_nettype none

module weight_digits (
    input  wire               clk,
    input  wire               rst,
    input  wire               clear,
    input  wire               weighted,
    input  wire               beat_valid,
    output wire               beat_ready,
    input  wire        [63:0] beat_data,
    input  wire        [ 1:0] beat_index,
    input  wire        [15:0] beat_weight,
    input  wire               beat_last,
    output wire               step,
    output wire        [ 1:0] step_index,
    output wire               step_set,
    output wire               step_last,
    output wire        [97:0] x,
    output wire        [97:0] y,
    output wire               term_valid,
    output wire signed [47:0] term_a,
    output wire signed [47:0] term_b
);
  localparam [47:0] BIAS = 48'h8000;

  // ---- beats: held off while a point goes through its second pass
  reg [1:0] pause;
  wire beat = beat_valid && beat_ready;
  wire point = beat && beat_index == 2'd2;

  assign beat_ready = pause == 2'd0;
  always @(posedge clk)
    if (rst || clear) pause <= 2'd0;
    else if (point && weighted) pause <= 2'd3;
    else if (!beat_ready) pause <= pause - 2'd1;

  // ---- two clocks beside the products
  wire [63:0] limbs = {beat_data[63:48], ~beat_data[47], beat_data[46:32],
                       beat_data[31:16], ~beat_data[15], beat_data[14:0]};
  reg valid_1, valid_2;
  reg last_1, last_2;
  reg [1:0] index_1, index_2;
  reg [63:0] limbs_1, limbs_2;

  always @(posedge clk) begin
    {valid_1, valid_2} <= {beat, valid_1 && !clear};
    {last_1, last_2}   <= {beat_last, last_1};
    {index_1, index_2} <= {beat_index, index_1};
    {limbs_1, limbs_2} <= {limbs, limbs_1};
    if (rst) {valid_1, valid_2} <= 2'b0;
  end

  wire [47:0] biased_a, biased_b;

  weighted_value u_value_a (
      .clk(clk),
      .weight(beat_weight),
      .component(beat_data[31:0]),
      .biased(biased_a)
  );

  weighted_value u_value_b (
      .clk(clk),
      .weight(beat_weight),
      .component(beat_data[63:32]),
      .biased(biased_b)
  );

  // ---- second pass: the three clocks after a weighted point's last beat
  reg second;
  reg second_last;  // of the frame's last point
  reg [1:0] second_index;

  always @(posedge clk) begin
    if (valid_2 && index_2 == 2'd2) begin
      second       <= weighted;
      second_last  <= last_2;
      second_index <= 2'd0;
    end else if (second) begin
      second       <= second_index != 2'd2;
      second_index <= second_index + 2'd1;
    end
    if (rst || clear) second <= 1'b0;
  end

  assign step = (valid_2 || second) && !clear;
  assign step_set = second;
  assign step_index = second ? second_index : index_2;
  assign step_last = second ? second_last && second_index == 2'd2 : last_2 && index_2 == 2'd2 && !weighted;

  // ---- the beats of a point, three steps back: limbs and highest digits; the digit's carry is added on the way
  reg [63:0] past_limbs_1, past_limbs_2, past_limbs_3;
  reg [16:0] upper_a, upper_b;  // {digit, carry}
  reg [15:0] digit_a_2, digit_a_3, digit_b_2, digit_b_3;

  always @(posedge clk)
    if (step) begin
      {past_limbs_1, past_limbs_2, past_limbs_3} <= {limbs_2, past_limbs_1, past_limbs_2};
      upper_a <= biased_a[47:31];
      upper_b <= biased_b[47:31];
      digit_a_2 <= upper_a[16:1] + {15'd0, upper_a[0]};
      digit_b_2 <= upper_b[16:1] + {15'd0, upper_b[0]};
      digit_a_3 <= digit_a_2;
      digit_b_3 <= digit_b_2;
    end

  pass_digits u_digits_a (
      .second(second),
      .biased(biased_a[31:0]),
      .limbs(limbs_2[31:0]),
      .past_digit(digit_a_3),
      .past_limbs(past_limbs_3[31:0]),
      .x(x[48:0]),
      .y(y[48:0])
  );

  pass_digits u_digits_b (
      .second(second),
      .biased(biased_b[31:0]),
      .limbs(limbs_2[63:32]),
      .past_digit(digit_b_3),
      .past_limbs(past_limbs_3[63:32]),
      .x(x[97:49]),
      .y(y[97:49])
  );

  assign term_valid = valid_2 && !clear;
  assign term_a = biased_a - BIAS;
  assign term_b = biased_b - BIAS;
endmodule

`resetall
