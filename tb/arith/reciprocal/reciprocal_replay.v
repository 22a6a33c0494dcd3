// SPDX-License-Identifier: Apache-2.0
// reciprocal under replay: a result counts where `done` is.
`resetall
`default_nettype none

module reciprocal_replay (
    input  wire clk,
    input  wire rst,
    output wire done
);
  wire start;
  wire [47:0] value;
  wire divided;
  wire [47:0] result;

  reciprocal dut (
      .clk(clk),
      .rst(rst),
      .start(start),
      .value(value),
      .done(divided),
      .result(result)
  );

  replay #(
      .IN_BITS (1 + 48),
      .OUT_BITS(1 + 48)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({start, value}),
      .result({divided, result}),
      .done(done)
  );
endmodule

`resetall
