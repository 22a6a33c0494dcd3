// SPDX-License-Identifier: Apache-2.0
// One of the six lanes of the rates engine: a row's memories, a binary32 multiplier and an adder.
//
//   product = x * y,   sum = c +- product        each rounded by itself (float_multiply, float_add)
//
// Memories: A the row as the moments gave it, S what the program makes of it, P products kept for later.
//
// cycle 0 own read, for the bus | 1 x read, y chosen | 2 in the multiplier | 4 c read | 5 product; P written at its end
//       | 9 sum; S written at its end
// What comes with a later cycle is delayed by the engine.
`resetall
`default_nettype none
module rates_lane (
    input  wire        clk,
    // moments
    input  wire        moment_write,
    input  wire [ 2:0] moment_address,
    input  wire [31:0] moment,
    // cycle 0
    input  wire        own_bank,         // 0 S, 1 A
    input  wire [ 4:0] own_address,
    // cycle 1
    output reg  [31:0] own,
    input  wire [ 1:0] x_bank,
    input  wire [ 4:0] x_address,
    input  wire        y_own,
    input  wire [31:0] y_common,
    // cycle 4
    input  wire [ 1:0] c_bank,
    input  wire [ 4:0] c_address,
    // cycle 5
    input  wire        product_write,
    input  wire [ 2:0] product_address,
    input  wire        subtract,
    // cycle 9
    input  wire        sum_write,
    input  wire [ 4:0] sum_address
);
  // Bank codes of sw/relnav/model/rates_program.py. NONE is 1 for x and 0 for c.
  localparam [1:0] S = 2'd1, A = 2'd2, P = 2'd3;
  localparam [31:0] ONE = 32'h3F800000;

  // a memory a read port
  (* ram_style = "distributed" *)reg [31:0] x_sums[0:31];
  (* ram_style = "distributed" *)reg [31:0] own_sums[0:31];
  (* ram_style = "distributed" *)reg [31:0] c_sums[0:31];
  (* ram_style = "distributed" *)reg [31:0] x_moments[0:7];
  (* ram_style = "distributed" *)reg [31:0] own_moments[0:7];
  (* ram_style = "distributed" *)reg [31:0] c_moments[0:7];
  (* ram_style = "distributed" *)reg [31:0] products[0:7];

  wire [31:0] product, sum;
  always @(posedge clk) begin
    if (sum_write) begin
      x_sums[sum_address]   <= sum;
      own_sums[sum_address] <= sum;
      c_sums[sum_address]   <= sum;
    end
    if (moment_write) begin
      x_moments[moment_address]   <= moment;
      own_moments[moment_address] <= moment;
      c_moments[moment_address]   <= moment;
    end
    if (product_write) products[product_address] <= product;
  end

  wire [31:0] x_sum = x_sums[x_address];
  wire [31:0] x_moment = x_moments[x_address[2:0]];
  wire [31:0] x_product = products[x_address[2:0]];
  wire [31:0] x = x_bank == S ? x_sum : x_bank == A ? x_moment : x_bank == P ? x_product : ONE;
  wire [31:0] c_4 = c_bank == S ? c_sums[c_address] : c_bank == A ? c_moments[c_address[2:0]] : 32'd0;

  reg [31:0] x_2, y_2, c;
  always @(posedge clk) begin
    own <= own_bank ? own_moments[own_address[2:0]] : own_sums[own_address];
    x_2 <= x;
    y_2 <= y_own ? own : y_common;
    c   <= c_4;
  end

  float_multiply multiplier (
      .clk(clk),
      .x(x_2),
      .y(y_2),
      .product(product)
  );

  float_add adder (
      .clk(clk),
      .x(c),
      .y(product),
      .subtract(subtract),
      .sum(sum)
  );
endmodule
`resetall
