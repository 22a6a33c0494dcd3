// SPDX-License-Identifier: Apache-2.0
// mux3_invert under replay.
`resetall
`default_nettype none

module mux3_invert_replay #(
    parameter WIDTH = 1
) (
    input  wire clk,
    input  wire rst,
    output wire done
);
  wire valid, invert;
  wire [1:0] select;
  wire [WIDTH-1:0] in_0, in_1, in_2, out;

  mux3_invert #(
      .WIDTH(WIDTH)
  ) dut (
      .select(select),
      .invert(invert),
      .in_0(in_0),
      .in_1(in_1),
      .in_2(in_2),
      .out(out)
  );

  replay #(
      .IN_BITS (1 + 2 + 1 + 3 * WIDTH),
      .OUT_BITS(1 + WIDTH)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({valid, select, invert, in_2, in_1, in_0}),
      .result({valid, out}),
      .done(done)
  );
endmodule

`resetall
