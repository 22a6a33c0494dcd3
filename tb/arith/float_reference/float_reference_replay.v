// SPDX-License-Identifier: Apache-2.0
// float_multiply, float_add and float_divide (DENORMALS = 1) beside symfpu's netlists of the same pairs.
// The netlists see the operands as late as the modules answer, so that every row of results agrees in itself.
`resetall
`default_nettype none

module float_reference_replay #(
    parameter DEPTH = 262144
) (
    input  wire clk,
    input  wire rst,
    output wire done
);
  localparam DIVIDERS = 14;  // and latency of one
  wire [7:0] control;  // bit 0: a pair
  wire [31:0] x, y, product, sum;
  wire [31:0] product_reference, sum_reference, quotient_reference;

  reg [64*DIVIDERS-1:0] past;
  reg [DIVIDERS-1:0] live;
  reg [3:0] turn;
  always @(posedge clk) begin
    past <= {past[64*(DIVIDERS-1)-1:0], x, y};
    live <= rst ? {DIVIDERS{1'b0}} : {live[DIVIDERS-2:0], control[0]};
    turn <= rst || turn == DIVIDERS - 1 ? 4'd0 : turn + 4'd1;
  end

  float_multiply #(
      .DENORMALS(1)
  ) u_multiply (
      .clk(clk),
      .x(x),
      .y(y),
      .product(product)
  );
  float_add #(
      .DENORMALS(1)
  ) u_add (
      .clk(clk),
      .x(x),
      .y(y),
      .subtract(1'b0),
      .sum(sum)
  );
  wire [32*DIVIDERS-1:0] quotients;
  genvar n;
  generate
    for (n = 0; n < DIVIDERS; n = n + 1) begin : g_divide
      wire divided;
      float_divide #(
          .DENORMALS(1)
      ) u_divide (
          .clk(clk),
          .rst(rst),
          .start(control[0] && turn == n),
          .x(x),
          .y(y),
          .done(divided),
          .quotient(quotients[32*n+:32])
      );
    end
  endgenerate

  symfpu_mul u_mul (
      .a(past[64*2+32+:32]),
      .b(past[64*2+:32]),
      .c(32'd0),
      .rm(5'd1),
      .o(product_reference)
  );
  symfpu_add u_sum (
      .a(past[64*3+32+:32]),
      .b(past[64*3+:32]),
      .c(32'd0),
      .rm(5'd1),
      .o(sum_reference)
  );
  symfpu_div u_div (
      .a(past[64*(DIVIDERS-1)+32+:32]),
      .b(past[64*(DIVIDERS-1)+:32]),
      .c(32'd0),
      .rm(5'd1),
      .o(quotient_reference)
  );

  replay #(
      .IN_BITS (8 + 32 + 32),
      .OUT_BITS(1 + 6 * 32),
      .DEPTH   (DEPTH)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({control, x, y}),
      .result({
        live[DIVIDERS-1],
        product,
        product_reference,
        sum,
        sum_reference,
        quotients[32*turn+:32],
        quotient_reference
      }),
      .done(done)
  );
endmodule

`resetall
