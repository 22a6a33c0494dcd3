// SPDX-License-Identifier: Apache-2.0
// One step of the SRT division, for every divisor and every remainder at the full width (srt_digit.sby): 27 in float_divide, 35 in
// reciprocal. With |remainder| <= 4/7 |divisor| before the step,
//   next = 8 remainder - v divisor exactly, v in -4..4 as `reached`, `positive` and `subtract` say, and |next| <= 4/7 |divisor| after it:
// the bound holds for ever, and so the digits are those of the quotient.
// SIGN = 1: the sign of the divisor is free; 0: it is positive (float_divide). DIGIT selects one |v|, so that the solver has five small tasks
// (split: some digit is chosen in every case, thermometer code).
`resetall
`default_nettype none

module srt_digit_properties #(
    parameter WIDTH = 35
) (
    input wire [WIDTH-1:0] divisor,
    input wire [WIDTH-1:0] remainder
);
  // as reciprocal and float_divide feed them
  wire signed [WIDTH+5:0] d = {{6{divisor[WIDTH-1]}}, divisor};
  wire signed [WIDTH+5:0] r = {{6{remainder[WIDTH-1]}}, remainder};
  wire [WIDTH+1:0] triple = d + {d[WIDTH+4:0], 1'b0};
  wire signed [13:0] leading = {{3{divisor[WIDTH-1]}}, divisor[WIDTH-1-:11]};
  wire signed [13:0] five = (leading <<< 2) + leading;
  wire signed [13:0] seven = (leading <<< 3) - leading;
  wire positive, subtract;
  wire [4:1] reached;
  wire [WIDTH-1:0] next;

  srt_digit #(
      .WIDTH(WIDTH)
  ) dut (
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

  wire signed [WIDTH+5:0] magnitude = d < 0 ? -d : d;
  wire signed [WIDTH+5:0] limit = magnitude <<< 2;
  wire signed [WIDTH+5:0] n = {{6{next[WIDTH-1]}}, next};
  wire signed [WIDTH+5:0] r_7 = (r <<< 3) - r;
  wire signed [WIDTH+5:0] n_7 = (n <<< 3) - n;
  wire signed [WIDTH+5:0] lowest = {{6{1'b0}}, 2'b01, {WIDTH - 2{1'b0}}};

  always @* begin
    assume (magnitude >= lowest && magnitude <= (lowest <<< 1));
    assume (r_7 <= limit && r_7 >= -limit);
  end

  // v as the digit's outputs give it
  wire [2:0] size = {2'd0, reached[1]} + {2'd0, reached[2]} + {2'd0, reached[3]} + {2'd0, reached[4]};
  wire signed [WIDTH+5:0] multiple = size == 3'd0 ? 0 : size == 3'd1 ? d : size == 3'd2 ? d <<< 1 : size == 3'd3 ? (d <<< 1) + d : d <<< 2;
  wire signed [WIDTH+5:0] exact = (r <<< 3) + (positive ? -multiple : multiple);

  always @* begin
    thermometer : assert ((reached == 4'b0000) || (reached == 4'b0001) || (reached == 4'b0011) || (reached == 4'b0111) || (reached == 4'b1111));
    sign_right : assert (positive == (remainder[WIDTH-1] == divisor[WIDTH-1]));
    subtract_right : assert (subtract == (positive && size != 3'd0));
    next_exact : assert (n == exact);
    next_bounded : assert (n_7 <= limit && n_7 >= -limit);
  end
endmodule

`resetall
