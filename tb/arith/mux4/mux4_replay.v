// SPDX-License-Identifier: Apache-2.0
// mux4 under replay.
`resetall
`default_nettype none

module mux4_replay #(
    parameter WIDTH = 1
) (
    input  wire clk,
    input  wire rst,
    output wire done
);
  wire valid;
  wire [1:0] select;
  wire [WIDTH-1:0] in_0, in_1, in_2, in_3, out;

  mux4 #(
      .WIDTH(WIDTH)
  ) dut (
      .select(select),
      .in_0(in_0),
      .in_1(in_1),
      .in_2(in_2),
      .in_3(in_3),
      .out(out)
  );

  replay #(
      .IN_BITS (1 + 2 + 4 * WIDTH),
      .OUT_BITS(1 + WIDTH)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({valid, select, in_3, in_2, in_1, in_0}),
      .result({valid, out}),
      .done(done)
  );
endmodule

`resetall
