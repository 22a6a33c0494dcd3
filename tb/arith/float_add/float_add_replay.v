// SPDX-License-Identifier: Apache-2.0
// float_add under replay, both builds side by side.
`resetall
`default_nettype none

module float_add_replay #(
    parameter DEPTH = 262144
) (
    input  wire clk,
    input  wire rst,
    output wire done
);
  localparam LATENCY = 4;
  wire [7:0] control;  // bit 0: a pair; bit 1: subtract
  wire [31:0] x, y, flushed, gradual;

  float_add #(
      .DENORMALS(0)
  ) dut_flush (
      .clk(clk),
      .x(x),
      .y(y),
      .subtract(control[1]),
      .sum(flushed)
  );
  float_add #(
      .DENORMALS(1)
  ) dut_gradual (
      .clk(clk),
      .x(x),
      .y(y),
      .subtract(control[1]),
      .sum(gradual)
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
