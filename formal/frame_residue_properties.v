// SPDX-License-Identifier: Apache-2.0
// frame_residue at its full width (frame_residue.sby), in steps, modulo p = 2^16 + 1. Not by divisions: a multiple of p is found that makes
// the two sides equal.
//
//   row     what a beat adds to s is the product of g_k and a term that is low half + 2^(2+k) high half, as each half is its f + p times its
//           upper word
//   fold    folded = s - p (upper word of s);  t = square - 2 - p (upper part of the square - 2)
//   total   residue is the exact sum of all products t w of a frame, though its lower part wraps: {high, low}, for up to 65535 rows of products
//           below 2^34 (0 < t < 2^18, w < 2^16); an increase that is not counted yet is pending for one clock
//
// Every product is anything (cutpoints): that of a residue_mac is proved in residue_mac.sby. PART 0: row and fold; 1: total; 2: total,
// from any state that the proof allows.
`resetall
`default_nettype none

module frame_residue_properties #(
    parameter        PART    = 0,
    parameter        BEATS   = 3,
    parameter [23:0] FACTORS = {6'd0, 6'd14, 6'd39, 6'd17}
) (
    input wire        clk,
    input wire        rst,
    input wire        clear,
    input wire        beat,
    input wire [63:0] beat_data,
    input wire [ 1:0] beat_index,
    input wire [15:0] beat_weight
);
  wire [49:0] residue;
  frame_residue #(
      .BEATS  (BEATS),
      .FACTORS(FACTORS)
  ) dut (
      .clk(clk),
      .rst(rst),
      .clear(clear),
      .beat(beat),
      .beat_data(beat_data),
      .beat_index(beat_index),
      .beat_weight(beat_weight),
      .residue(residue)
  );

  // connected by the script
  wire signed [22:0] row_term;
  wire signed [6:0] row_factor;
  wire signed [30:0] dut_s;
  wire signed [17:0] dut_folded;
  wire [34:0] dut_square;
  wire signed [20:0] frame_term;
  wire signed [37:0] frame_product;
  wire [9:1] dut_ends;
  wire dut_low_top;

  reg [2:0] age = 3'd0;
  always @(posedge clk) age <= age == 3'd7 ? age : age + 3'd1;

  function signed [63:0] by_p(input signed [63:0] number);
    by_p = (number <<< 16) + number;
  endfunction

  generate
    if (PART == 0) begin : g_row
      // halves of the beat; of four beats the last has no high one
      wire no_high = BEATS == 4 && beat_index == 2'd3;
      wire [63:0] data = {no_high ? 32'd0 : beat_data[63:32], beat_data[31:0]};
      wire signed [63:0] low = {{32{data[31]}}, data[31:0]}, high = {{32{data[63]}}, data[63:32]};
      wire [2:0] shift = {1'b0, beat_index} + 3'd2;
      wire signed [63:0] low_less = low - by_p(low >>> 16), high_less = high - by_p(high >>> 16);  // congruent
      wire [5:0] factor = FACTORS[6*beat_index+:6];
      reg signed [63:0] expected_1, expected_2;
      reg [5:0] factor_1, factor_2;
      wire signed [63:0] added = row_term;
      reg signed [63:0] s_1;
      wire signed [63:0] s = {{36{dut_s[27]}}, dut_s[27:0]};
      wire signed [63:0] folded = dut_folded;
      reg [34:0] square_1;
      wire signed [63:0] term = frame_term;
      wire signed [63:0] square_upper = {45'd0, square_1[34:16]};
      always @* assume (beat_index < BEATS);
      always @(posedge clk) begin
        {expected_1, expected_2} <= {low_less + (high_less <<< shift), expected_1};
        {factor_1, factor_2} <= {factor, factor_1};
        s_1 <= s;
        square_1 <= dut_square;
      end
      always @* begin
        if (age >= 3'd2) row_right : assert (added == expected_2 && row_factor == {1'b0, factor_2});
        if (age >= 3'd1) folded_right : assert (s_1 == folded + by_p(s_1 >>> 16));
        if (age >= 3'd1) term_right : assert (term == {29'd0, square_1} - 2 - by_p(square_upper - 2));
      end
    end else begin : g_total
      always @* assume (frame_product >= 0 && frame_product < 38'sh400000000);
      reg [15:0] rows;
      reg [51:0] total;
      always @(posedge clk) begin
        if (dut_ends[9]) begin
          total <= total + {14'd0, frame_product};
          rows <= rows + 16'd1;
        end
        if (rst || clear) {total, rows} <= 68'd0;
      end
      always @* assume ((age == 3'd0 && PART != 2) || rows != 16'hFFFF || !dut_ends[9]);
      wire pending = dut_low_top && !residue[47];
      wire [51:0] bound = {2'd0, rows, 34'd0};
      wire exact = {2'd0, residue[49:48] + {1'b0, pending}, residue[47:0]} == total && total <= bound;
      always @* if (age == 3'd0) assume (PART == 2 ? exact : rst);
      always @* if (age != 3'd0) total_right : assert (exact);
    end
  endgenerate
endmodule

`resetall
