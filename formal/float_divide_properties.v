// SPDX-License-Identifier: Apache-2.0
// float_divide at its full width, for every pair of operands (float_divide.sby): the quotient is x / y rounded once, as IEEE-754 says. With
// srt_digit by its contract (srt_digit_contract.v), which srt_digit.sby proves. No multiplier: products grow by the recurrence of the digits.
//
//   x_f, y_f: normalised significands, D = 4 y_f; after k digits, q <- 8 q + v and product <- 8 product + v D, so product = q D by construction:
//   8^k x_f = product + r, |r| <= 4/7 D; after nine digits 2^27 x_f = floor D + rest, 0 <= rest < D: floor is x_f / y_f 2^25 rounded down
//   x_f / y_f is in (1/2, 2): from the first digit on q is at least 8^(k-1), where it is that r is above 0, and at most 8^k / 2, where it is
//   that r is below 0; so floor is in 2^24 .. 2^26 - 1
//
// The reference rounds the exact value, floor and whether something is left, on the grid of binary32: to the nearest multiple of the unit
// 2^u, u = -149 at least, ties to even; DENORMALS = 0 then takes what is below 2^-126 for zero.
// ANYWHERE = 1 starts in any state that the proof allows: a bounded check of few clocks then sees every cycle of a division.
`resetall
`default_nettype none

module float_divide_properties #(
    parameter DENORMALS = 0,
    parameter ANYWHERE  = 0,
    parameter PART      = 0   // 0: all; 1: operands, remainder; 2: digits; 3: rounding and time; 4: what they end with
) (
    input wire        clk,
    input wire        rst,
    input wire        start,
    input wire [31:0] x,
    input wire [31:0] y
);
  localparam [3:0] LOAD = DENORMALS != 0 ? 4'd2 : 4'd0;  // cycle before the first digit
  localparam [3:0] DIGITS = LOAD + 4'd10;  // all digits are there
  localparam [3:0] LAST = DENORMALS != 0 ? 4'd13 : 4'd10;  // rounding
  wire done;
  wire [31:0] quotient;

  float_divide #(
      .DENORMALS(DENORMALS)
  ) dut (
      .clk(clk),
      .rst(rst),
      .start(start),
      .x(x),
      .y(y),
      .done(done),
      .quotient(quotient)
  );

  // connected by the script
  wire [3:0] dut_step;
  wire [23:0] dut_divisor, dut_x_f, dut_y_f;
  wire [26:0] dut_remainder;
  wire [25:0] dut_whole, dut_less;
  wire signed [9:0] dut_difference;
  wire [2:0] dut_size;
  wire dut_positive, dut_fits, dut_negative, dut_nan, dut_infinite, dut_zero;
  wire dut_above_128, dut_is_128, dut_below_m127, dut_is_m127, dut_is_m126;  // DENORMALS = 0
  wire [23:0] dut_x_raw, dut_y_raw;  // these, DENORMALS = 1
  wire [4:0] dut_x_zeros, dut_y_zeros;
  wire [7:0] dut_x_exponent, dut_y_exponent;
  wire [24:0] dut_kept;
  wire dut_kept_sticky;
  wire signed [10:0] dut_exponent;

  reg started = 1'b0;
  always @(posedge clk) started <= 1'b1;

  reg [3:0] age;  // 0: no division; else clocks since start
  reg [31:0] a, b;  // its operands

  // ---- operands: {exponent, significand of 24 bits with its top bit set, where the number is not 0}
  function [33:0] normal(input [31:0] number);
    integer i;
    reg signed [9:0] exponent;
    reg [23:0] bits;
    begin
      exponent = {2'd0, number[30:23]};
      bits = {1'b1, number[22:0]};
      if (DENORMALS != 0 && exponent == 0) begin
        exponent = 10'sd1;
        bits[23] = 1'b0;
        for (i = 0; i < 23; i = i + 1)
          if (!bits[23]) begin
            bits = bits << 1;
            exponent = exponent - 10'sd1;
          end
      end
      normal = {exponent, bits};
    end
  endfunction
  reg [67:0] normal_held;  // made once where it takes a loop
  wire signed [9:0] a_exponent, b_exponent;
  wire [23:0] a_bits, b_bits;
  assign {a_exponent, a_bits, b_exponent, b_bits} = DENORMALS != 0 ? normal_held : {normal(a), normal(b)};
  wire signed [9:0] difference = a_exponent - b_exponent;

  wire a_zero = DENORMALS != 0 ? a[30:0] == 31'd0 : a[30:23] == 8'd0;
  wire b_zero = DENORMALS != 0 ? b[30:0] == 31'd0 : b[30:23] == 8'd0;
  wire a_nan = a[30:0] > 31'h7F800000;
  wire b_nan = b[30:0] > 31'h7F800000;
  wire a_infinite = a[30:0] == 31'h7F800000;
  wire b_infinite = b[30:0] == 31'h7F800000;
  wire invalid = a_nan || b_nan || (a_zero && b_zero) || (a_infinite && b_infinite);
  wire to_infinity = a_infinite || b_zero;
  wire to_zero = a_zero || b_infinite;
  wire ordinary = !(invalid || to_infinity || to_zero);

  // ---- digits
  wire dividing = age > LOAD && age <= DIGITS;
  wire [3:0] digits = age - LOAD - 4'd1;  // that stand, while dividing
  reg [52:0] product;  // of q and D; modulo 2^53, which holds it
  reg [52:0] power;
  reg [28:0] q;
  wire [52:0] d = {27'd0, b_bits, 2'd0};
  wire [52:0] r = {{26{dut_remainder[26]}}, dut_remainder};
  wire below_0 = dut_remainder[26];
  wire remainder_right = power == product + r && power == {29'd0, a_bits} << (3 * digits);
  wire [28:0] digit = {26'd0, dut_size};
  wire [52:0] multiple = dut_size == 3'd0 ? 53'd0 : dut_size == 3'd1 ? d : dut_size == 3'd2 ? d << 1 : dut_size == 3'd3 ? (d << 1) + d : d << 2;
  wire [25:0] below = ~(26'h3FFFFFF << (3 * digits));  // bits of the digits that stand; above it is what was there before
  wire [28:0] less = q - 29'd1;
  wire [28:0] least = 29'd1 << (3 * (digits - 4'd1));
  wire [28:0] most = least << 2;
  wire in_range = digits == 4'd0 ? q == 29'd0 && product == 53'd0 :
      (q > least || (q == least && !below_0 && r != 53'd0)) && (q < most || (q == most && below_0));

  // ---- after the last digit: rounded down
  wire [28:0] floor = below_0 ? less : q;
  wire [52:0] product_floor = below_0 ? product - d : product;
  wire [52:0] rest = below_0 ? r + d : r;
  wire [26:0] exact_now = {floor[25:0], rest != 53'd0};  // x / y = this 2^(difference - 26), a last bit 1 for "and something"
  reg [26:0] exact_held;
  always @(posedge clk) exact_held <= exact_now;
  wire [26:0] value = LAST == DIGITS ? exact_now : exact_held;

  // ---- the reference: to the nearest multiple of 2^unit, ties to even
  wire signed [15:0] place = {{6{difference[9]}}, difference} - 16'sd26;  // of value's last bit
  wire signed [15:0] unit_normal = place + (value[26] ? 16'sd3 : 16'sd2);
  wire signed [15:0] unit = unit_normal < -16'sd149 ? -16'sd149 : unit_normal;
  wire signed [15:0] cut = unit - place;  // bits that leave; at least 2
  wire [4:0] shift = cut > 16'sd28 ? 5'd28 : cut[4:0];
  wire [31:0] multiples = {5'd0, value} >> shift;
  wire [31:0] remains = {5'd0, value} - (multiples << shift);
  wire [31:0] half = 32'd1 << (shift - 5'd1);
  wire up = remains > half || (remains == half && multiples[0]);
  wire [15:0] units_above = unit + 16'sd149;
  wire [47:0] encoded = {9'd0, units_above, 23'd0} + {16'd0, multiples} + {47'd0, up};  // exponent and fraction as one number
  wire [30:0] finite = encoded >= 48'h7F800000 ? 31'h7F800000 : DENORMALS == 0 && encoded < 48'h00800000 ? 31'd0 : encoded[30:0];
  wire [31:0] expected = invalid ? 32'h7FC00000 : {a[31] ^ b[31], to_infinity ? 31'h7F800000 : to_zero ? 31'd0 : finite};

  reg due;  // a result
  reg [31:0] expected_held, was;
  reg was_rounding;
  wire rounding = age == LAST && !start;
  always @(posedge clk) begin
    if (start) begin
      {a, b} <= {x, y};
      normal_held <= {normal(x), normal(y)};
    end
    age <= rst ? 4'd0 : start ? 4'd1 : age == 4'd0 || age == LAST ? 4'd0 : age + 4'd1;
    if (DENORMALS != 0 ? age == LOAD : start) {product, q, power} <= {82'd0, 29'd0, DENORMALS != 0 ? a_bits : {1'b1, x[22:0]}};
    else begin
      power <= power << 3;
      product <= (product << 3) + (dut_positive ? multiple : -multiple);
      q <= (q << 3) + (dut_positive ? digit : -digit);
    end
    due <= rounding && !rst;
    expected_held <= expected;
    was <= quotient;
    was_rounding <= rounding || (ANYWHERE == 0 && !started);
  end

  // ---- what the registers hold
  wire kinds_right = dut_negative == ((a[31] ^ b[31]) && !invalid) && dut_nan == invalid &&
      dut_infinite == (to_infinity || a_nan) && dut_zero == (to_zero || b_nan);
  wire raw_right = dut_x_raw << dut_x_zeros == a_bits && a_exponent == $signed({2'd0, dut_x_exponent}) - $signed({5'd0, dut_x_zeros}) &&
      dut_y_raw << dut_y_zeros == b_bits && b_exponent == $signed({2'd0, dut_y_exponent}) - $signed({5'd0, dut_y_zeros});
  wire proper = a_bits[23] && b_bits[23] && a_exponent > -10'sd23 && b_exponent > -10'sd23 && a_exponent < 10'sd255 && b_exponent < 10'sd255;
  wire normal_right = dut_difference == difference && (DENORMALS == 0 || (dut_x_f == a_bits && dut_y_f == b_bits));
  wire compared_right = {dut_above_128, dut_is_128, dut_below_m127, dut_is_m127, dut_is_m126} ==
      {difference > 128, difference == 128, difference < -127, difference == -127, difference == -126};
  wire kept_right = dut_kept == (exact_held[26] ? exact_held[26:2] : exact_held[25:1]) && exact_held[26:25] != 2'd0 &&
      dut_kept_sticky == (exact_held[0] || (exact_held[26] && exact_held[1])) &&
      dut_exponent == {difference[9], difference} + (exact_held[26] ? 11'sd127 : 11'sd126);
  wire digits_right = ((dut_whole ^ q[25:0]) & below) == 26'd0 && ((dut_less ^ less[25:0]) & below) == 26'd0;

  wire consistent = dut_step == age && age <= LAST && (age == 4'd0 || (kinds_right &&
      (!ordinary || (proper && (DENORMALS == 0 || raw_right) && (DENORMALS != 0 && age < 4'd2 || normal_right) &&
      (DENORMALS != 0 || age < 4'd2 || compared_right) && (DENORMALS == 0 || age != LAST || kept_right) &&
      (!dividing || (dut_fits && dut_divisor == b_bits && remainder_right && digits_right && in_range))))));
  always @* if (!started) assume (ANYWHERE != 0 ? consistent && due == done : rst);

  wire all = PART == 0;
  always @* if (started || ANYWHERE != 0) begin
    if (all || PART == 3) begin
    same_step : assert (dut_step == age && age <= LAST);
    if (age != 4'd0) same_kinds : assert (kinds_right);
    end
    if ((all || PART == 1) && age != 4'd0 && ordinary) begin
      if (DENORMALS != 0) same_operands : assert (raw_right && proper);
      if (DENORMALS == 0 || age >= 4'd2) normalised : assert (normal_right && proper);
      if (DENORMALS == 0 && age >= 4'd2) same_range : assert (compared_right);
      if (DENORMALS != 0 && age == LAST) same_kept : assert (kept_right);
      if (dividing) begin
        operands_fit : assert (dut_fits);
        same_divisor : assert (dut_divisor == b_bits);
        remainder_exact : assert (remainder_right);
      end
    end
    if ((all || PART == 4) && age == DIGITS && ordinary)
      exact : assert ({2'd0, a_bits, 27'd0} == product_floor + rest && rest < d);
    if ((all || PART == 2) && age != 4'd0 && ordinary) begin
      if (dividing) begin
        same_digits : assert (digits_right);
        quotient_in_range : assert (in_range);
      end
      if (age == DIGITS) floor_in_range : assert (floor >= 29'h1000000 && floor < 29'h4000000);
    end
    if (started && (all || PART == 3)) begin
      done_on_time : assert (done == due);
      if (due) rounded_once : assert (quotient == expected_held);
      if (!was_rounding) stays : assert (quotient == was);
    end
  end
endmodule

`resetall
