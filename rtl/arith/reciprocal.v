// SPDX-License-Identifier: Apache-2.0
// Reciprocal of a lane value by signed radix-8 division (SRT, digits -4..4).
//
//   1 / (m 2^e) = +-floor(2^N / |m|) 2^PAD * 2^(-e - 66), |m| in [2^33, 2^34], N = 66 - PAD = 31 + 3 DIGITS
//   1 / 0 gives mantissa 2^33, exponent 1200: overflows binary32 and saturates Q15.16
//
//   r_0 = 2^31, r_(n+1) = 8 r_n - v_n m, v_n = 8 r_n / m rounded: |r| <= 4/7 |m|
//
// cycle | 0 start | 1..DIGITS a digit each | DIGITS + 1 result: the digits, less one if the last remainder is negative
// `done` marks cycle DIGITS + 1. A start while busy begins anew.
// Kept apart for the reason given in dot_lane.
`include "relnav_words.vh"
`resetall
`default_nettype none
(* keep_hierarchy *)
module reciprocal (
    input  wire        clk,
    input  wire        rst,
    input  wire        start,
    input  wire [47:0] value,
    output wire        done,
    output wire [47:0] result
);
  localparam DIGITS = (`RELNAV_RECIPROCAL_NUMERATOR - 31) / 3;
  localparam PAD = 66 - `RELNAV_RECIPROCAL_NUMERATOR;
  localparam LAST = DIGITS + 1;
  reg [3:0] step;  // 0 idle, else the cycle after start
  reg [11:0] exponent;
  reg [34:0] divisor;
  reg [36:0] triple;
  // Multiples of the divisor's top 11 bits, for the choice of a digit only.
  wire [10:0] leading = value[34:24];
  reg [13:0] five, seven;
  reg [34:0] remainder;

  wire below_zero = remainder[34];
  wire positive;  // the digit's sign
  wire subtract;  // positive and not 0
  wire [4:1] reached;
  wire [34:0] next;
  srt_digit #(
      .WIDTH(35)
  ) u_digit (
      .divisor(divisor),
      .triple(triple),
      .five(five),
      .seven(seven),
      .remainder(remainder),
      .positive(positive),
      .subtract(subtract),
      .reached(reached),
      .next(next)
  );

  // ---- quotient: digit v = 8 carry + low - 7. The sevens of all digits are 8^DIGITS - 1: modulo 8^DIGITS they add one.
  reg [3*DIGITS-1:0] low;
  reg [DIGITS-2:0] carry;
  wire [2:0] size = {reached[4], reached[2] & ~reached[4], (reached[1] & ~reached[2]) | (reached[3] & ~reached[4])};
  wire [2:0] next_low = positive ? size - 3'd1 : ~size;

  always @(posedge clk) begin
    if (start) begin
      if (value[47]) begin
        // 2^33 takes its place: 2^64 / 2^33 = 2^31
        divisor  <= 35'h200000000;
        triple   <= 37'h600000000;
        five     <= 14'd5 << 9;
        seven    <= 14'd7 << 9;
        exponent <= 12'd1200;
      end else begin
        divisor  <= value[34:0];
        triple   <= {{2{value[34]}}, value[34:0]} + {value[34], value[34:0], 1'b0};
        five     <= {leading[10], leading, 2'd0} + {{3{leading[10]}}, leading};
        seven    <= {leading, 3'd0} - {{3{leading[10]}}, leading};
        exponent <= -12'd65 + ~value[46:35];  // -e - 66
      end
    end
    if (start) remainder <= 35'h080000000;
    else remainder <= next;
    low   <= {low[3*DIGITS-4:0], next_low};
    carry <= {carry[DIGITS-3:0], subtract};
    step  <= start ? 4'd1 : (step == 4'd0 || step == LAST[3:0]) ? 4'd0 : step + 4'd1;
    if (rst) step <= 4'd0;
  end

  // The last digit takes the correction towards zero, and the one that the sevens leave: 8 + v = 8 last_carry + last.
  wire signed [4:0] corrected =
      {{2{~carry[0]}}, low[2:0]} + 5'sd1 + (~below_zero ? 5'sd0 : divisor[34] ? 5'sd1 : -5'sd1);
  wire [2:0] last = corrected[2:0];
  wire last_carry = ~corrected[4];
  wire [DIGITS-2:0] into = {carry[DIGITS-2:1], last_carry};
  wire [3*DIGITS-4:0] carries;
  genvar n;
  generate
    for (n = 0; n < DIGITS - 1; n = n + 1) begin : g_carry
      assign carries[3*n+:3] = {2'd0, into[n]};
    end
  endgenerate
  wire [3*DIGITS-4:0] high = low[3*DIGITS-1:3] + carries;
  assign done = step == LAST[3:0];
  assign result = {1'b0, exponent, high, last, {PAD{1'b0}}};

  wire unused = &{1'b0, corrected[3]};
endmodule
`resetall
