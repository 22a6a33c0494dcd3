// SPDX-License-Identifier: Apache-2.0
// output_scale under replay: a value a clock, some clocks left out.
`resetall
`default_nettype none

module output_scale_replay #(
    parameter DEPTH = 262144
) (
    input  wire clk,
    input  wire rst,
    output wire done
);
  wire [7:0] control;  // bit 0: a value
  wire [31:0] value, result;
  wire [15:0] scale;
  wire unused = &{1'b0, control[7:1], scale[15:12]};

  output_scale dut (
      .clk(clk),
      .value(value),
      .scale(scale[11:0]),
      .result(result)
  );

  reg live;
  always @(posedge clk) live <= control[0] && !rst;

  replay #(
      .IN_BITS (8 + 32 + 16),
      .OUT_BITS(1 + 32),
      .DEPTH   (DEPTH)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({control, value, scale}),
      .result({live, result}),
      .done(done)
  );
endmodule

`resetall
