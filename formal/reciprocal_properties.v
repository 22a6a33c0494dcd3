// SPDX-License-Identifier: Apache-2.0
// reciprocal at its full width, for every divisor (reciprocal.sby), with srt_digit by its contract (srt_digit_contract.v), which
// srt_digit.sby proves. No multiplier: the products of the proof grow by the recurrence of the digits.
//
//   quotient q <- 8 q + v   product p <- 8 p + v m   so p = q m, by construction
//   2^31 8^n = p + r after n digits: 2^61 = q m + r after ten, |r| <= 4/7 |m|; less one towards zero where r < 0
//
// So the mantissa is q with 2^61 = q m + r, 0 <= r < |m|: 2^61 / m rounded towards zero. Its 30 bits hold it, since |2^61 / m| <= 2^28.
// ANYWHERE = 1 starts in any state that the proof allows: a bounded check of few clocks then sees every cycle of a division.
// The DUT's digits stand as low and carry, whose value is q and, above it, what was there before the start: `stale_now`.
`resetall
`default_nettype none

module reciprocal_properties #(
    parameter ANYWHERE = 0
) (
    input wire        clk,
    input wire        rst,
    input wire        start,
    input wire [47:0] value
);
  wire done;
  wire [47:0] result;

  reciprocal dut (
      .clk(clk),
      .rst(rst),
      .start(start),
      .value(value),
      .done(done),
      .result(result)
  );

  // connected by the script
  wire [ 3:0] dut_step;
  wire [34:0] dut_divisor, dut_remainder;
  wire [29:0] dut_low;
  wire [ 8:0] dut_carry;
  wire [ 2:0] dut_size, dut_next_low;
  wire [11:0] dut_exponent;
  wire dut_positive, dut_subtract, dut_fits;

  reg started = 1'b0;
  always @(posedge clk) started <= 1'b1;

  // operands are normalised, or 0
  wire signed [34:0] m_in = value[34:0];
  wire signed [35:0] m_size = m_in < 0 ? -{m_in[34], m_in} : {m_in[34], m_in};
  always @* assume (value[47] || (m_size >= 36'h200000000 && m_size <= 36'h400000000));

  reg [3:0] age;  // 0: no division; else clocks since start
  reg signed [63:0] m, product;
  reg [29:0] quotient, stale;  // modulo 2^30
  reg signed [11:0] exponent;
  reg zero;
  wire signed [63:0] r = {{29{dut_remainder[34]}}, dut_remainder};
  wire signed [63:0] size = m < 0 ? -m : m;
  wire signed [63:0] multiple = dut_size == 3'd0 ? 0 : dut_size == 3'd1 ? m : dut_size == 3'd2 ? m <<< 1 : dut_size == 3'd3 ? (m <<< 1) + m : m <<< 2;
  wire [29:0] digit = {27'd0, dut_size};

  // value of the digits as they stand, and in the next clock: the sum of (8 carry + low - 7) 8^k modulo 8^10
  wire [26:0] spread = {2'd0, dut_carry[8], 2'd0, dut_carry[7], 2'd0, dut_carry[6], 2'd0, dut_carry[5], 2'd0, dut_carry[4], 2'd0, dut_carry[3],
                        2'd0, dut_carry[2], 2'd0, dut_carry[1], 2'd0, dut_carry[0]};
  wire [29:0] digits = dut_low + {spread, 3'd0} + 30'd1;

  always @(posedge clk) begin
    age <= start ? 4'd1 : age == 4'd0 || age == 4'd11 ? 4'd0 : age + 4'd1;
    if (start) begin
      m <= value[47] ? 64'h200000000 : {{29{value[34]}}, value[34:0]};
      zero <= value[47];
      exponent <= value[46:35];
      product <= 64'd0;
      quotient <= 30'd0;
    end else begin
      product <= (product <<< 3) + (dut_positive ? multiple : -multiple);
      quotient <= {quotient[26:0], 3'd0} + (dut_positive ? digit : -digit);
    end
    if (rst) age <= 4'd0;
  end
  wire [3:0] leap = age - 4'd1;  // digits that stand
  wire [63:0] power = 64'h80000000 << (3 * leap);
  // stale is what stands in the first cycle; it leaves with the tenth digit
  always @(posedge clk) if (age == 4'd1) stale <= digits;
  wire [29:0] stale_now = (age == 4'd1 ? digits : stale) << (3 * leap);
  wire signed [63:0] size_left = r < 0 ? r + size : r;  // the remainder after the correction
  wire [29:0] corrected = quotient - (r < 0 ? (m < 0 ? -30'd1 : 30'd1) : 30'd0);
  wire signed [63:0] product_left = product - (r < 0 ? (m < 0 ? -m : m) : 64'd0);

  wire legal = age < 4'd2 || (dut_carry[0] ? dut_low[2:0] <= 3'd3 : dut_low[2:0] >= 3'd3);  // the last digit: -4..4
  wire consistent = legal && dut_step == age && age <= 4'd11 && (age == 4'd0 || (dut_fits &&
      {{29{dut_divisor[34]}}, dut_divisor} == m && power == product + r && digits == quotient + stale_now && dut_exponent == (zero ? 12'd1200 : -exponent - 12'd66)));
  always @* if (!started) assume (ANYWHERE != 0 ? consistent : rst);

  always @* if (started || ANYWHERE != 0) begin
    done_on_time : assert (done == (age == 4'd11));
    same_step : assert (dut_step == age && age <= 4'd11);
    if (age != 4'd0) begin
      operands_fit : assert (dut_fits);
      same_divisor : assert ({{29{dut_divisor[34]}}, dut_divisor} == m);
      remainder_exact : assert (power == product + r);
      digit_legal : assert (legal);
      digits_right : assert (digits == quotient + stale_now);
      same_exponent : assert (dut_exponent == (zero ? 12'd1200 : -exponent - 12'd66));
    end
    if (done) begin
      quotient_right : assert (result[34:5] == corrected && result[4:0] == 5'd0);
      exact : assert (64'sd1 <<< 61 == product_left + size_left && size_left >= 0 && size_left < size);
      exponent_right : assert (result[46:35] == (zero ? 12'd1200 : -exponent - 12'd66) && !result[47]);
    end
  end
endmodule

`resetall
