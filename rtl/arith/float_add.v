// SPDX-License-Identifier: Apache-2.0
// IEEE-754 binary32 sum or difference, round to nearest, ties to even.
//
//   sum = x + y, or x - y where `subtract`, rounded once; inf - inf = NaN; every NaN is 7FC00000
//   DENORMALS = 0: a denormal operand counts as zero of its sign; a denormal result (always exact) is zero of its sign
//   DENORMALS = 1: gradual underflow
//
//   large +- small, |large| >= |small|; small moved right by the difference of the exponents, two bits and a sticky bit
//   kept below the 24 (after a shift of 2 or more the sum loses one leading bit at most, so these suffice)
//
// cycle | 0 operands | 1 large, small | 2 small moved, all but one place | 3 sum, moved left by 0, 8, 16 or 24
//       | 4 normalised, rounded and packed
// Latency 4, one sum a clock; no reset: a pipeline of data.
`resetall
`default_nettype none
module float_add #(
    parameter DENORMALS = 0
) (
    input  wire        clk,
    input  wire [31:0] x,
    input  wire [31:0] y,
    input  wire        subtract,
    output reg  [31:0] sum
);
  // ---- cycle 1: order by magnitude
  wire y_negative = y[31] ^ subtract;
  wire x_normal = |x[30:23];
  wire y_normal = |y[30:23];
  wire x_some = |x[22:0];
  wire y_some = |y[22:0];
  wire x_ones = &x[30:23];
  wire y_ones = &y[30:23];
  wire opposite = x[31] ^ y_negative;
  wire swap = y[30:0] > x[30:0];
  // a denormal's exponent is 1, its leading bit 0
  wire [7:0] x_exponent = {x[30:24], x[23] | (DENORMALS != 0 & ~x_normal)};
  wire [7:0] y_exponent = {y[30:24], y[23] | (DENORMALS != 0 & ~y_normal)};
  wire x_keep = DENORMALS != 0 | x_normal;
  wire y_keep = DENORMALS != 0 | y_normal;
  wire [7:0] small_exponent = swap ? x_exponent : y_exponent;

  reg [7:0] exponent_1;
  reg [23:0] large_1, small_1;
  reg [7:0] distance_1;
  reg minus_1, negative_1, ones_1, nan_1, zeros_1;
  always @(posedge clk) begin
    exponent_1 <= swap ? y_exponent : x_exponent;
    large_1    <= swap ? {y_normal, y[22:0]} : {x_normal, x[22:0]};
    small_1    <= swap ? {x_normal, x[22:0] & {23{x_keep}}} : {y_normal, y[22:0] & {23{y_keep}}};
    distance_1 <= (swap ? y_exponent : x_exponent) - small_exponent;
    minus_1    <= opposite;
    negative_1 <= swap ? y_negative : x[31];
    ones_1     <= x_ones | y_ones;
    nan_1      <= (x_ones & x_some) | (y_ones & y_some) | (x_ones & y_ones & opposite);
    zeros_1    <= ~(x_normal | y_normal);  // with DENORMALS = 0 only, both count as zero
  end

  // ---- cycle 2: 24 bits and three below moved right, by 8 or 16 or 24, then by 2 or 4 or 6
  wire [1:0] eights = distance_1[4:3];
  wire [3:0] moved_out;  // by 0, 8, 16, 24: anything below the place 7 under the last of the 24
  wire [30:0] by_8;
  mux4 #(
      .WIDTH(31)
  ) u_by_8 (
      .select(eights),
      .in_0({small_1, 7'd0}),
      .in_1({8'd0, small_1[23:1]}),
      .in_2({16'd0, small_1[23:9]}),
      .in_3({24'd0, small_1[23:17]}),
      .out(by_8)
  );
  assign moved_out = {|small_1[16:0], |small_1[8:0], small_1[0], 1'b0};
  wire [26:0] by_2;  // 24 bits, guard, round and the one that the last place may move out
  mux4 #(
      .WIDTH(27)
  ) u_by_2 (
      .select(distance_1[2:1]),
      .in_0(by_8[30:4]),
      .in_1({2'd0, by_8[30:6]}),
      .in_2({4'd0, by_8[30:8]}),
      .in_3({6'd0, by_8[30:10]}),
      .out(by_2)
  );
  wire [3:0] below = {|by_8[9:0], |by_8[7:0], |by_8[5:0], |by_8[3:0]};
  wire beyond = |distance_1[7:5];

  reg [7:0] exponent_2;
  reg [23:0] large_2;
  reg [26:0] small_2;
  reg odd_2, sticky_2, minus_2, negative_2, ones_2, nan_2, zeros_2;
  always @(posedge clk) begin
    exponent_2 <= exponent_1;
    large_2    <= large_1;
    odd_2      <= distance_1[0];
    minus_2    <= minus_1;
    negative_2 <= negative_1 & ~nan_1 & ~(DENORMALS == 0 & zeros_1 & minus_1);
    ones_2     <= ones_1;
    nan_2      <= nan_1;
    zeros_2    <= zeros_1;
    // by 32 and more the small operand changes nothing, not even as a sticky bit
    if (beyond) begin
      small_2  <= 27'd0;
      sticky_2 <= 1'b0;
    end else begin
      small_2  <= by_2;
      sticky_2 <= moved_out[eights] | below[distance_1[2:1]];
    end
  end

  // ---- cycle 3: 28 bits: carry, 24, guard, round, sticky
  wire [26:0] aligned = {
    odd_2 ? {1'b0, small_2[26:2]} : small_2[26:1], sticky_2 | small_2[0] | (odd_2 & small_2[1])
  };
  wire [28:0] total = {1'b0, large_2, 3'd0, 1'b1} + {{28{minus_2}} ^ {1'b0, aligned}, minus_2};
  wire [27:0] s = total[28:1];
  wire [27:0] marked;  // s with a bit that ends the shift where the exponent is 1
  wire [2:0] any = {|marked[27:20], |marked[19:12], |marked[11:4]};
  wire [1:0] coarse = any[2] ? 2'd0 : any[1] ? 2'd1 : any[0] ? 2'd2 : 2'd3;
  wire [27:0] s_by_8;
  mux4 #(
      .WIDTH(28)
  ) u_s_by_8 (
      .select(coarse),
      .in_0(s),
      .in_1({s[19:0], 8'd0}),
      .in_2({s[11:0], 16'd0}),
      .in_3({s[3:0], 24'd0}),
      .out(s_by_8)
  );

  reg [27:0] sum_3;
  reg [1:0] coarse_3;
  reg [7:0] exponent_3;
  reg minus_3, negative_3, special_3, ones_3, nan_3, near_over_3;
  always @(posedge clk) begin
    sum_3       <= s_by_8;
    coarse_3    <= coarse;
    exponent_3  <= exponent_2;
    minus_3     <= minus_2;
    negative_3  <= negative_2;
    special_3   <= ones_2 | (DENORMALS == 0 & zeros_2);
    ones_3      <= ones_2;
    nan_3       <= nan_2;
    near_over_3 <= exponent_2 == 8'd254;
  end

  // ---- cycle 4
  wire [7:0] front;  // the eight leading bits, with the mark
  wire [2:0] fine;
  assign fine[2] = ~|front[7:4];
  assign fine[1] = fine[2] ? ~|front[3:2] : ~|front[7:6];
  assign fine[0] = ~front[7] & (front[6] | ~front[5] & (front[4] | ~front[3] & (front[2] | ~front[1])));
  wire [27:0] by_two;
  mux4 #(
      .WIDTH(28)
  ) u_by_two (
      .select(fine[2:1]),
      .in_0(sum_3),
      .in_1({sum_3[25:0], 2'd0}),
      .in_2({sum_3[23:0], 4'd0}),
      .in_3({sum_3[21:0], 6'd0}),
      .out(by_two)
  );
  wire [27:0] normal = fine[0] ? {by_two[26:0], 1'b0} : by_two;
  // exponent less the shift: the biased exponent but one, as the leading bit adds one
  wire [8:0] base = {1'b0, exponent_3} - {4'd0, coarse_3, fine};
  // Rounded where the leading bit is 27, 26 or 25. A sum that cancels further is exact, its bits 1 and 0 are not set.
  wire up = sum_3[27] ? sum_3[3] & (sum_3[4] | (|sum_3[2:0])) :
      sum_3[26] ? sum_3[2] & (sum_3[3] | (|sum_3[1:0])) : sum_3[1] & (sum_3[2] | sum_3[0]);
  wire leading = DENORMALS == 0 | normal[27];
  wire [30:0] rounded = {base[7:0], normal[26:4]} + {7'd0, leading, 23'd0} + {30'd0, up};
  wire none = DENORMALS == 0 ? ~|front : ~|sum_3;
  wire over = near_over_3 & sum_3[27] & coarse_3 == 2'd0;
  wire flushed = none | (DENORMALS == 0 & base[8]);
  wire infinite = ones_3 | (over & ~special_3);
  always @(posedge clk) begin
    sum[31]    <= negative_3 & ~(none & ~special_3 & minus_3);
    sum[30:23] <= (rounded[30:23] & {8{~special_3 & ~flushed}}) | {8{infinite}};
    if (special_3 | flushed | over) sum[22:0] <= 23'd0;
    else sum[22:0] <= rounded[22:0];
    if (nan_3) sum[22] <= 1'b1;
  end

  generate
    if (DENORMALS == 0) begin : g_flush
      assign marked = s;
      assign front  = sum_3[27:20];
      wire unused = &{1'b0, marked[3:0]};
    end else begin : g_gradual
      reg [27:0] mark_2;
      reg [7:0] front_3;
      assign marked = s | mark_2;
      assign front  = front_3;
      always @(posedge clk) begin
        mark_2 <= exponent_1 > 8'd27 ? 28'd0 : 28'h8000000 >> exponent_1[4:0];
        case (coarse)
          2'd0: front_3 <= marked[27:20];
          2'd1: front_3 <= marked[19:12];
          2'd2: front_3 <= marked[11:4];
          default: front_3 <= {marked[3:0], 4'd0};
        endcase
      end
    end
  endgenerate

  wire unused = &{1'b0, total[0], base[8], normal[3:0]};
endmodule
`resetall
