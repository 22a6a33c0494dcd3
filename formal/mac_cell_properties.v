// SPDX-License-Identifier: Apache-2.0
// One accumulator cell over a whole frame (mac_cell.sby): its 48 bits never overflow, and the sum is the exact one.
//
// With every accumulator travels the number of products in it (`*_count`), as the ring moves it. A cell gets back what it gave, so what is
// asserted of sum is assumed of addend_in: |value| <= count 2^30, which 65536 products, one more than a frame has, fill to 2^46.
// `wide_*` is the sum in 64 bits. Every input is free in every clock.
`resetall
`default_nettype none

module mac_cell_properties #(
    parameter X_HOLD = 0
) (
    input wire               clk,
    input wire               clear,
    input wire               hold_x,
    input wire               load_x,
    input wire               load_y,
    input wire signed [15:0] x,
    input wire signed [15:0] y,
    input wire               skip,
    input wire               addend_clear,
    input wire               addend_load,
    input wire signed [47:0] addend_in,
    input wire        [16:0] in_count,
    input wire               accumulate
);
  wire signed [47:0] sum;

  mac_cell #(
      .X_BITS(16),
      .Y_BITS(16),
      .SUM_BITS(48),
      .X_HOLD(X_HOLD)
  ) dut (
      .clk(clk),
      .clear(clear),
      .hold_x(hold_x),
      .load_x(load_x),
      .load_y(load_y),
      .x(x),
      .y(y),
      .skip(skip),
      .addend_clear(addend_clear),
      .addend_load(addend_load),
      .addend_in(addend_in),
      .accumulate(accumulate),
      .sum(sum)
  );

  // connected by the script
  wire signed [47:0] dut_addend;
  wire signed [31:0] dut_product;

  localparam signed [63:0] UNIT = 64'sd1 <<< 30;
  reg started = 1'b0;
  always @(posedge clk) started <= 1'b1;
  always @* if (!started) assume (clear && addend_clear && skip);

  wire signed [63:0] wide_in = addend_in;
  wire signed [63:0] in_limit = {17'd0, in_count, 30'd0};
  always @* assume (in_count <= 17'd65535 && wide_in <= in_limit && wide_in >= -in_limit);

  reg signed [63:0] wide_addend, wide_sum;
  reg [16:0] addend_count, sum_count;
  wire signed [63:0] wide_product = dut_product;
  always @(posedge clk) begin
    if (addend_clear) {wide_addend, addend_count} <= {64'd0, 17'd0};
    else if (addend_load) {wide_addend, addend_count} <= {wide_in, in_count};
    if (clear) {wide_sum, sum_count} <= {64'd0, 17'd0};
    else if (accumulate) {wide_sum, sum_count} <= {wide_product + wide_addend, addend_count + 17'd1};
  end
  wire signed [63:0] sum_limit = {17'd0, sum_count, 30'd0};
  wire signed [63:0] addend_limit = {17'd0, addend_count, 30'd0};

  wire signed [63:0] narrow_sum = sum, narrow_addend = dut_addend;
  always @* if (started) begin
    product_bounded : assert (wide_product <= UNIT && wide_product >= -UNIT);
    sum_exact : assert (narrow_sum == wide_sum);
    sum_bounded : assert (narrow_sum <= sum_limit && narrow_sum >= -sum_limit && sum_count <= 17'd65536);
    same_addend : assert (narrow_addend == wide_addend && addend_count <= 17'd65535);
    addend_bounded : assert (narrow_addend <= addend_limit && narrow_addend >= -addend_limit);
  end
endmodule

`resetall
