// SPDX-License-Identifier: Apache-2.0
// float_multiply under replay, both builds side by side.
`resetall
`default_nettype none

module float_multiply_replay #(
    parameter DEPTH = 262144
) (
    input  wire clk,
    input  wire rst,
    output wire done
);
  localparam LATENCY = 3;
  wire [7:0] control;  // bit 0: a pair; bit 1: unused
  wire [31:0] x, y, flushed, gradual;

  float_multiply #(
      .DENORMALS(0)
  ) dut_flush (
      .clk(clk),
      .x(x),
      .y(y),
      .product(flushed)
  );
  float_multiply #(
      .DENORMALS(1)
  ) dut_gradual (
      .clk(clk),
      .x(x),
      .y(y),
      .product(gradual)
  );

  reg [LATENCY-1:0] live;
  always @(posedge clk) live <= rst ? {LATENCY{1'b0}} : {live[LATENCY-2:0], control[0]};

  replay #(
      .IN_BITS (8 + 32 + 32),
      .OUT_BITS(1 + 32 + 32),
      .DEPTH   (DEPTH)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({control, x, y}),
      .result({live[LATENCY-1], flushed, gradual}),
      .done(done)
  );
endmodule

`resetall
