// SPDX-License-Identifier: Apache-2.0
// IEEE-754 binary32 product, round to nearest, ties to even.
//
//   product = x y rounded once; 0 inf = NaN; every NaN is 7FC00000
//   DENORMALS = 0: a denormal operand counts as zero of its sign; where IEEE's result is denormal, zero of its sign
//   (so exact products from 2^-126 - 2^-150 on become 2^-126, as in IEEE). DENORMALS = 1: gradual underflow.
//
//   |x y| = (x_f y_f) 2^(e_x + e_y - 300), x_f, y_f 24 bits; y_f = y_high 2^17 + y_low: two DSP multipliers, M and P packed
//
// cycle | 0 operands | 1 partial products | 2 product of 48 bits | 3 rounded and packed
// Latency 3, one product a clock; no reset: a pipeline of data. The operands go straight into the multipliers: they should
// come from registers.
// The 24 bits kept are p[47:24] or p[46:23] as p[47] is set or not; with E = e_x + e_y - 127 the result's exponent is
// E + p[47]. At exponent 0 the bits kept count half: nothing but 24 ones rounds to 2^-126, and they always do.
`resetall
`default_nettype none
module float_multiply #(
    parameter DENORMALS = 0
) (
    input  wire        clk,
    input  wire [31:0] x,
    input  wire [31:0] y,
    output reg  [31:0] product
);
  // ---- cycle 1
  wire x_normal = |x[30:23];
  wire y_normal = |y[30:23];
  wire x_some = |x[22:0];
  wire y_some = |y[22:0];
  wire x_zero = ~x_normal & (DENORMALS == 0 | ~x_some);
  wire y_zero = ~y_normal & (DENORMALS == 0 | ~y_some);
  wire x_ones = &x[30:23];
  wire y_ones = &y[30:23];
  // what a zero operand's significand is does not matter
  wire x_hidden = DENORMALS == 0 | x_normal;
  wire y_hidden = DENORMALS == 0 | y_normal;
  wire signed [24:0] x_f = {1'b0, x_hidden, x[22:0]};
  wire signed [17:0] y_low = {1'b0, y[16:0]};
  wire signed [17:0] y_high = {11'd0, y_hidden, y[22:17]};

  reg signed [42:0] low_1, high_1;
  reg negative_1, zero_1, ones_1, nan_1;
  reg [8:0] exponent_1;  // e_x + e_y
  always @(posedge clk) begin
    low_1      <= x_f * y_low;
    high_1     <= x_f * y_high;
    negative_1 <= x[31] ^ y[31];
    zero_1     <= x_zero | y_zero;
    ones_1     <= x_ones | y_ones;
    nan_1      <= (x_ones & x_some) | (y_ones & y_some);
    // a denormal's exponent is 1
    exponent_1 <= {1'b0, x[30:23]} + {1'b0, y[30:23]} + (DENORMALS != 0 & (~x_normal | ~y_normal) ? 9'd1 : 9'd0);
  end

  // ---- cycle 2
  reg signed [42:0] high_2;
  wire signed [42:0] carried = high_1 + {{17{low_1[42]}}, low_1[42:17]};
  reg sticky_2, negative_2, special_2, ones_2, nan_2;
  reg near_over_2, edge_2;
  reg [7:0] base_2;  // E - 1
  wire nan = nan_1 | (ones_1 & zero_1);
  wire signed [10:0] exponent;  // of a product in [1, 2): E, or less for a denormal operand
  wire below = DENORMALS == 0 & exponent < 0;
  wire over = exponent > 254;
  always @(posedge clk) begin
    high_2      <= carried;
    sticky_2    <= |low_1[16:0];
    negative_2  <= negative_1 & ~nan;
    ones_2      <= ones_1 | (over & ~zero_1);
    nan_2       <= nan;
    special_2   <= ones_1 | zero_1 | over | below;
    near_over_2 <= exponent == 254;
    edge_2      <= DENORMALS == 0 & exponent == 0;
  end

  // ---- cycle 3
  wire [47:0] p;
  wire lost;  // something below p
  generate
    if (DENORMALS == 0) begin : g_flush
      assign exponent = $signed({2'b00, exponent_1}) - 11'sd127;
      always @(posedge clk) base_2 <= exponent[7:0] - 8'd1;
      assign p = {high_2[30:0], 17'd0};
      assign lost = sticky_2;
    end else begin : g_gradual
      // The shift is known before the product: left by the operands' leading zeros, as far as the exponent goes,
      // or right where it is below 1. Two denormals make no more than a sticky bit.
      wire [4:0] x_zeros, y_zeros;
      leading_zeros_24 u_x (
          .bits (x_f[23:0]),
          .count(x_zeros)
      );
      leading_zeros_24 u_y (
          .bits (y_f),
          .count(y_zeros)
      );
      wire [23:0] y_f = {y_hidden, y[22:0]};
      reg [4:0] zeros_1;
      reg [16:0] low_2;
      reg [4:0] left, right;
      wire signed [10:0] plain = $signed({2'b00, exponent_1}) - 11'sd127;
      assign exponent = plain - $signed({6'd0, zeros_1});
      wire signed [10:0] short = 11'sd1 - plain;
      always @(posedge clk) begin
        zeros_1 <= x_zeros | y_zeros;
        low_2   <= low_1[16:0];
        base_2  <= exponent < 1 ? 8'd0 : exponent[7:0] - 8'd1;
        left    <= exponent >= 1 ? zeros_1 : plain >= 1 ? plain[4:0] - 5'd1 : 5'd0;
        right   <= plain >= 1 ? 5'd0 : short > 31 ? 5'd31 : short[4:0];
      end
      wire [47:0] whole = {high_2[30:0], low_2};
      assign p = |right ? whole >> right : whole << left;
      assign lost = |(whole & ~(48'hFFFFFFFFFFFF << right));
      wire unused = &{1'b0, short[10:5], sticky_2};
    end
  endgenerate

  wire high = p[47];
  wire hidden = DENORMALS == 0 ? ~high : ~high & p[46];
  wire [22:0] fraction = high ? p[46:24] : p[45:23];
  wire flushed = edge_2 & ~high;  // IEEE's result is denormal or 2^-126
  wire rest = lost | (|p[21:0]);
  wire up = flushed | (high ? p[23] & (p[24] | p[22] | rest) : p[22] & (p[23] | rest));
  // a carry out of the 24 bits leaves zeros below: only the exponent moves
  wire [30:0] rounded = {base_2, fraction} + {6'd0, high, hidden, 23'd0} + {30'd0, up};
  wire infinite = ones_2 | (near_over_2 & high & ~special_2);
  always @(posedge clk) begin
    product[31]    <= negative_2;
    product[30:23] <= (rounded[30:23] & {8{~special_2}}) | {8{infinite}};
    if (special_2 | flushed | (near_over_2 & high)) product[22:0] <= 23'd0;
    else product[22:0] <= rounded[22:0];
    if (nan_2) product[22] <= 1'b1;
  end

  wire unused = &{1'b0, high_2[42:31]};
endmodule
`resetall
