// SPDX-License-Identifier: Apache-2.0
// residual_product under replay: a product a clock, some clocks left out.
`resetall
`default_nettype none

module residual_product_replay (
    input  wire clk,
    input  wire rst,
    output wire done
);
  localparam LATENCY = 4;
  wire valid;
  wire [95:0] moment;
  wire [23:0] significand;
  wire [119:0] product;

  residual_product dut (
      .clk(clk),
      .moment(moment),
      .significand(significand),
      .product(product)
  );

  reg [LATENCY-1:0] live;
  always @(posedge clk) live <= rst ? {LATENCY{1'b0}} : {live[LATENCY-2:0], valid};

  replay #(
      .IN_BITS (1 + 96 + 24),
      .OUT_BITS(1 + 120)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({valid, moment, significand}),
      .result({live[LATENCY-1], product}),
      .done(done)
  );
endmodule

`resetall
