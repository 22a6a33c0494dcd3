// SPDX-License-Identifier: Apache-2.0
// float_divide under replay, both builds side by side: every start, done, and quotient where done.
`resetall
`default_nettype none

module float_divide_replay (
    input  wire clk,
    input  wire rst,
    output wire done
);
  wire start;
  wire [31:0] x, y, flushed, gradual;
  wire flushed_done, gradual_done;

  float_divide #(
      .DENORMALS(0)
  ) dut_flush (
      .clk(clk),
      .rst(rst),
      .start(start),
      .x(x),
      .y(y),
      .done(flushed_done),
      .quotient(flushed)
  );
  float_divide #(
      .DENORMALS(1)
  ) dut_gradual (
      .clk(clk),
      .rst(rst),
      .start(start),
      .x(x),
      .y(y),
      .done(gradual_done),
      .quotient(gradual)
  );

  replay #(
      .IN_BITS (1 + 32 + 32),
      .OUT_BITS(1 + 1 + 32 + 1 + 32)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({start, x, y}),
      .result({
        flushed_done | gradual_done,
        flushed_done,
        flushed & {32{flushed_done}},
        gradual_done,
        gradual & {32{gradual_done}}
      }),
      .done(done)
  );
endmodule

`resetall
