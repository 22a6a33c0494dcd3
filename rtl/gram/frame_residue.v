// SPDX-License-Identifier: Apache-2.0
// What the sums of a frame must add up to modulo p = 2^16 + 1, made of the beats alone: one half of moment_check.
//   s = sum over a row's beats of g_k (low half + 2^(2+k) high half),   residue = sum over rows of w (s^2 - 2)
// Words are taken together, never divided: 2^16 = -1 modulo p, so a number is congruent to its 16-bit words with signs + - + -.
//
// clock (row's last beat = 0)  1        2     3        4    5       6     7        8          9        10       11
//                              f_a f_b  v     product  sum  folded        square   w, t       product  low      high
//   f = low word - high word of a half, |f| < 1.5 2^16;  v = f_a + f_b 2^q, below 2^21;  |s| <= 773 * 98303 < 2^27;
//   folded = s[15:0] - s[27:16] in -2^11 .. 2^16 + 2^11;  square < 1.07 2^32;  t = its low word - the rest + 2^17 (= -2), in 0.9 .. 3 2^16;
//   65535^2 t < 3 2^48: `low` wraps, at most twice, seen as its top bit falls (a step is below 2^35), and counted in `high`.
// Rows end three clocks apart or more (the weight waits in steps of three). residue is right 11 clocks after the frame's last beat;
// it is {high, low} = low - high modulo p, as 2^48 = -1.
`resetall
`default_nettype none

module frame_residue #(
    parameter        BEATS   = 3,                          // beats of a row; of 4 the last has no high half
    parameter [23:0] FACTORS = {6'd0, 6'd14, 6'd39, 6'd17}  // {g_3, g_2, g_1, g_0}
) (
    input  wire        clk,
    input  wire        rst,
    input  wire        clear,
    input  wire        beat,         // taken
    input  wire [63:0] beat_data,
    input  wire [ 1:0] beat_index,
    input  wire [15:0] beat_weight,  // right with a row's last beat
    output wire [49:0] residue
);
  localparam [1:0] LAST = BEATS == 4 ? 2'd3 : 2'd2;
  wire last = beat && beat_index == LAST;

  // ---- words of the halves, two's complement numbers: the upper word is signed
  reg signed [17:0] f_a, f_b;
  reg [3:1] valid, fresh;
  reg [9:1] ends;
  reg [1:0] index;
  reg [15:0] weight_1, weight_2, weight_3;

  always @(posedge clk) begin
    f_a   <= {2'd0, beat_data[15:0]} - {{2{beat_data[31]}}, beat_data[31:16]};
    f_b   <= {2'd0, beat_data[47:32]} - {{2{beat_data[63]}}, beat_data[63:48]};
    if (BEATS == 4 && beat_index == 2'd3) f_b <= 18'd0;
    index <= beat_index;
    fresh <= {fresh[2:1], beat_index == 2'd0};
    valid <= {valid[2:1] & {2{!clear}}, beat};
    ends  <= {ends[8:1] & {8{!clear}}, last};
    if (rst) {valid, ends} <= 12'd0;
  end

  // ---- s
  wire signed [21:0] high = {{4{f_b[17]}}, f_b};
  wire signed [21:0] shifted = index[1] ? high <<< 4 : index[0] ? high <<< 3 : high <<< 2;
  wire [5:0] factor = FACTORS[6*index+:6];
  wire signed [30:0] s;

  residue_mac #(
      .X_BITS(18),
      .Y_BITS(22),
      .FACTOR_BITS(7),
      .SUM_BITS(31)
  ) u_row (
      .clk(clk),
      .clear(1'b0),
      .add(valid[3]),
      .fresh(fresh[3]),
      .x(f_a),
      .y(shifted),
      .factor({1'b0, factor}),
      .sum(s)
  );

  // ---- s squared, times the weight
  reg signed [17:0] folded;
  wire [34:0] square;
  wire [47:0] low;
  reg low_top;
  reg [1:0] high_count;

  always @(posedge clk) begin
    folded <= {2'd0, s[15:0]} - {{6{s[27]}}, s[27:16]};
    if (last) weight_1 <= beat_weight;
    if (ends[3]) weight_2 <= weight_1;
    if (ends[6]) weight_3 <= weight_2;

    low_top <= low[47];
    if (low_top && !low[47]) high_count <= high_count + 2'd1;
    if (rst || clear) {low_top, high_count} <= 3'd0;
  end

  residue_square u_square (
      .clk(clk),
      .value(folded),
      .square(square)
  );

  residue_mac #(
      .SUBTRACT(1),
      .X_BITS(19),
      .Y_BITS(20),
      .FACTOR_BITS(17),
      .SUM_BITS(48)
  ) u_frame (
      .clk(clk),
      .clear(rst || clear),
      .add(ends[9]),
      .fresh(1'b0),
      .x({3'b010, square[15:0]}),
      .y({1'b0, square[34:16]}),
      .factor({1'b0, weight_3}),
      .sum(low)
  );

  assign residue = {high_count, low};

  /* verilator lint_off UNUSEDSIGNAL */
  wire unused = &s[30:28];
  /* verilator lint_on UNUSEDSIGNAL */
endmodule

`resetall
