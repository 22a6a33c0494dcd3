// SPDX-License-Identifier: Apache-2.0
// product_tile under replay.
`resetall
`default_nettype none

module product_tile_replay (
    input  wire clk,
    input  wire rst,
    output wire done
);
  wire valid;
  wire [34:0] x;
  wire [34:0] y;
  wire [69:0] product;

  product_tile dut (
      .clk(clk),
      .x(x),
      .y(y),
      .product(product)
  );

  reg [2:0] live;
  always @(posedge clk) live <= rst ? 3'd0 : {live[1:0], valid};

  replay #(
      .IN_BITS (1 + 35 + 35),
      .OUT_BITS(1 + 70)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({valid, x, y}),
      .result({live[2], product}),
      .done(done)
  );
endmodule

`resetall
