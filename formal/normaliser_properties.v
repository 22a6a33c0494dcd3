// SPDX-License-Identifier: Apache-2.0
// normaliser against its specification, for every value of the full width (normaliser.sby): not how it shifts, but what mant and exp say.
`resetall
`default_nettype none

module normaliser_properties #(
    parameter BITS = 98,
    parameter LOW  = 0
) (
    input wire               clk,
    input wire               rst,
    input wire               in_valid,
    input wire [   BITS-1:0] value,
    input wire signed [11:0] scale,
    input wire [        5:0] in_tag
);
  wire out_valid, zero;
  wire [34:0] mant;
  wire [11:0] exp;
  wire [ 5:0] out_tag;

  normaliser #(
      .BITS(BITS),
      .TAG_BITS(6)
  ) dut (
      .clk(clk),
      .rst(rst),
      .in_valid(in_valid),
      .value(value),
      .low(LOW != 0),
      .scale(scale),
      .in_tag(in_tag),
      .out_valid(out_valid),
      .mant(mant),
      .exp(exp),
      .zero(zero),
      .out_tag(out_tag)
  );

  // the item whose result is out
  reg [BITS-1:0] value_1, value_2, value_3;
  reg [11:0] scale_1, scale_2, scale_3;
  reg [5:0] tag_1, tag_2, tag_3;
  reg valid_1, valid_2, valid_3;
  reg [1:0] clocks = 2'd0;
  always @(posedge clk) begin
    {value_1, value_2, value_3} <= {value, value_1, value_2};
    {scale_1, scale_2, scale_3} <= {scale, scale_1, scale_2};
    {tag_1, tag_2, tag_3} <= {in_tag, tag_1, tag_2};
    {valid_1, valid_2, valid_3} <= rst ? 3'd0 : {in_valid, valid_1, valid_2};
    if (clocks != 2'd3) clocks <= clocks + 2'd1;
  end

  // sign bits beyond the first, a 0 standing below bit 0
  reg [7:0] run;
  integer i;
  always @* begin
    run = 8'd0;
    for (i = 0; i < BITS; i = i + 1) if ((i == 0 ? 1'b0 : value_3[i == 0 ? 0 : i - 1]) != value_3[BITS-1]) run = BITS - 1 - i;
  end
  // value 2^(35 + 34) padded, from which both windows are cut
  wire [BITS+68:0] shifted = {value_3, 69'd0} << run;
  wire [34:0] upper = shifted[BITS+68-:35];
  wire [33:0] lower = shifted[BITS+33-:34];
  wire [11:0] e = BITS - 35 - run;
  wire expect_zero = LOW != 0 ? lower == 34'd0 : value_3 == 0;

  always @(posedge clk) if (clocks == 2'd3) begin
    valid_right : assert (out_valid == valid_3 && out_tag == tag_3);
    mant_right : assert (mant == (LOW != 0 ? {1'b0, lower} : upper));
    zero_right : assert (zero == expect_zero);
    exp_right : assert (exp == (expect_zero ? 12'd0 : e - (LOW != 0 ? 12'd34 : 12'd0) + scale_3));
    if (LOW == 0 && value_3 != 0) normalised : assert (mant[34] != mant[33]);
  end
endmodule

`resetall
