// SPDX-License-Identifier: Apache-2.0
// residue_mac at a reduced width, adding or subtracting (residue_mac.sby): three clocks after terms and factor the sum has grown by exactly
// (x +- y) factor, or is that with `fresh`; the model multiplies by adding up shifted terms, and wraps as the sum does. Every input is free.
`resetall
`default_nettype none

module residue_mac_properties #(
    parameter SUBTRACT = 0
) (
    input wire              clk,
    input wire              clear,
    input wire              add,
    input wire              fresh,
    input wire signed [4:0] x,
    input wire signed [3:0] y,
    input wire signed [3:0] factor
);
  wire signed [11:0] sum;

  residue_mac #(
      .SUBTRACT(SUBTRACT),
      .X_BITS(5),
      .Y_BITS(4),
      .FACTOR_BITS(4),
      .SUM_BITS(12)
  ) dut (
      .clk(clk),
      .clear(clear),
      .add(add),
      .fresh(fresh),
      .x(x),
      .y(y),
      .factor(factor),
      .sum(sum)
  );

  reg [11:0] term_1, term_2, expected;
  reg [3:0] factor_1, factor_2;
  reg [1:0] age = 2'd0;  // clocks, up to 3
  reg known = 1'b0;  // sum has been cleared
  wire [11:0] grows = (factor_2[0] ? term_2 : 12'd0) + (factor_2[1] ? term_2 << 1 : 12'd0) + (factor_2[2] ? term_2 << 2 : 12'd0) -
      (factor_2[3] ? term_2 << 3 : 12'd0);
  always @(posedge clk) begin
    term_1 <= {{7{x[4]}}, x} + (SUBTRACT != 0 ? -{{8{y[3]}}, y} : {{8{y[3]}}, y});
    factor_1 <= factor;
    {term_2, factor_2} <= {term_1, factor_1};
    age <= age == 2'd3 ? 2'd3 : age + 2'd1;
    if (clear) {known, expected} <= {1'b1, 12'd0};
    else if (add) {known, expected} <= {(known || fresh) && age >= 2'd2, (fresh ? 12'd0 : expected) + grows};
  end

  always @* if (known) sum_right : assert (sum == expected);
endmodule

`resetall
