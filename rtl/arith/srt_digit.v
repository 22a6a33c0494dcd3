// SPDX-License-Identifier: Apache-2.0
// One step of signed radix-8 division (SRT, digits -4..4). Combinational.
//
//   v = 8 remainder / divisor rounded, perhaps one off; next = 8 remainder - v divisor
//   |divisor| in [2^(WIDTH-2), 2^(WIDTH-1)]; |remainder| <= 4/7 |divisor| gives |next| <= 4/7 |divisor|
//   triple = 3 divisor; five, seven: that multiple of the divisor's top 11 bits
//   |v| = the number of bits set in `reached`; positive: v's sign (of 0 either); subtract: v > 0
//
// The thresholds of |v| = 1, 2, 3, 4 are 1, 3, 5 and 7 halves of |divisor|. A digit may be one off its rounding as long as
// the remainder stays below 4/7 |divisor|: thresholds may be off by |divisor|/14 >= 2^(WIDTH-1) / 28. With 8r and the
// multiples cut to units of 2^(WIDTH-6) and five, seven off by less than 7/2 2^(WIDTH-11), they are off by less than
// 2^(WIDTH-1) (1/32 + 7/2048) < 2^(WIDTH-1) / 28.
`resetall
`default_nettype none
module srt_digit #(
    parameter WIDTH = 35
) (
    input  wire [WIDTH-1:0] divisor,
    input  wire [WIDTH+1:0] triple,
    input  wire [     13:0] five,
    input  wire [     13:0] seven,
    input  wire [WIDTH-1:0] remainder,
    output wire             positive,
    output wire             subtract,
    output wire [      4:1] reached,
    output wire [WIDTH-1:0] next
);
  wire below_zero = remainder[WIDTH-1];
  assign positive = ~(below_zero ^ divisor[WIDTH-1]);
  wire [8:0] r = remainder[WIDTH-1-:9];
  wire [8:0] t_1 = {{4{divisor[WIDTH-1]}}, divisor[WIDTH-1-:5]};
  wire [8:0] t_2 = {{2{triple[WIDTH+1]}}, triple[WIDTH+1-:7]};
  wire [8:0] t_3 = {five[13], five[13:6]};
  wire [8:0] t_4 = {seven[13], seven[13:6]};
  // 8r - t less one unit where the signs agree, 8r + t where they differ: either way less than a unit off
  wire [8:0] beyond_1 = r + (t_1 ^ {9{positive}});
  wire [8:0] beyond_2 = r + (t_2 ^ {9{positive}});
  wire [8:0] beyond_3 = r + (t_3 ^ {9{positive}});
  wire [8:0] beyond_4 = r + (t_4 ^ {9{positive}});
  assign reached = ~({beyond_4[8], beyond_3[8], beyond_2[8], beyond_1[8]} ^ {4{below_zero}});

  // WIDTH bits hold |next|; the bits above cancel
  wire [WIDTH-1:0] multiple;
  mux4 #(
      .WIDTH(WIDTH)
  ) choose (
      .select({reached[3], reached[4] | (reached[2] & ~reached[3])}),
      .in_0(divisor),
      .in_1({divisor[WIDTH-2:0], 1'b0}),
      .in_2(triple[WIDTH-1:0]),
      .in_3({divisor[WIDTH-3:0], 2'd0}),
      .out(multiple)
  );
  assign subtract = positive & reached[1];
  wire [WIDTH:0] sum =
      {remainder[WIDTH-4:0], 3'd0, subtract} + {(multiple ^ {WIDTH{positive}}) & {WIDTH{reached[1]}}, subtract};
  assign next = sum[WIDTH:1];

  wire unused = &{
    1'b0, sum[0], five[5:0], seven[5:0], beyond_1[7:0], beyond_2[7:0], beyond_3[7:0], beyond_4[7:0]
  };
endmodule
`resetall
