// SPDX-License-Identifier: Apache-2.0
// srt_digit by its contract: any digit and any next remainder that srt_digit_properties allows. Stands in for the module in the proofs of
// the dividers; what the contract presumes of the operands is asserted here, what it promises is assumed.
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
  (* anyseq *) wire [WIDTH-1:0] any_next;
  (* anyseq *) wire [2:0] any_digit;
  wire [2:0] any_size = any_digit[2] ? 3'd4 : any_digit;

  wire signed [WIDTH+5:0] d = {{6{divisor[WIDTH-1]}}, divisor};
  wire signed [WIDTH+5:0] r = {{6{remainder[WIDTH-1]}}, remainder};
  wire signed [WIDTH+5:0] n = {{6{next[WIDTH-1]}}, next};
  wire signed [WIDTH+5:0] magnitude = d < 0 ? -d : d;
  wire signed [WIDTH+5:0] limit = magnitude <<< 2;
  wire signed [WIDTH+5:0] r_7 = (r <<< 3) - r;
  wire signed [WIDTH+5:0] n_7 = (n <<< 3) - n;
  wire signed [WIDTH+5:0] lowest = {{6{1'b0}}, 2'b01, {WIDTH - 2{1'b0}}};
  wire signed [13:0] leading = {{3{divisor[WIDTH-1]}}, divisor[WIDTH-1-:11]};
  wire signed [13:0] leading_5 = (leading <<< 2) + leading;
  wire signed [13:0] leading_7 = (leading <<< 3) - leading;

  // whether the operands are those that the contract presumes: asserted where a digit is used
  wire divisor_fits = magnitude >= lowest && magnitude <= (lowest <<< 1);
  wire multiples_fit = triple == d[WIDTH+1:0] + {d[WIDTH:0], 1'b0} && five == leading_5 && seven == leading_7;
  wire remainder_fits = r_7 <= limit && r_7 >= -limit;
  wire fits = divisor_fits && multiples_fit && remainder_fits;

  assign next = any_next;
  assign positive = remainder[WIDTH-1] == divisor[WIDTH-1];
  assign reached = any_size == 3'd0 ? 4'b0000 : any_size == 3'd1 ? 4'b0001 : any_size == 3'd2 ? 4'b0011 : any_size == 3'd3 ? 4'b0111 : 4'b1111;
  assign subtract = positive && any_size != 3'd0;
  wire signed [WIDTH+5:0] multiple =
      any_size == 3'd0 ? 0 : any_size == 3'd1 ? d : any_size == 3'd2 ? d <<< 1 : any_size == 3'd3 ? (d <<< 1) + d : d <<< 2;
  always @* if (fits) assume (n == (r <<< 3) + (positive ? -multiple : multiple));
  always @* if (fits) assume (n_7 <= limit && n_7 >= -limit);
endmodule

`resetall
