// SPDX-License-Identifier: Apache-2.0
// fixed_output under replay; `saturates` belongs to the clock before.
`resetall
`default_nettype none

module fixed_output_replay (
    input  wire clk,
    input  wire rst,
    output wire done
);
  wire valid, above, saturates;
  wire [47:0] sum;
  wire [31:0] fixed;

  fixed_output dut (
      .clk(clk),
      .sum(sum),
      .above(above),
      .fixed(fixed),
      .saturates(saturates)
  );

  reg live, saturated;
  always @(posedge clk) begin
    live      <= valid & ~rst;
    saturated <= saturates;
  end

  replay #(
      .IN_BITS (2 + 48),
      .OUT_BITS(2 + 32)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({valid, above, sum}),
      .result({live, saturated, fixed}),
      .done(done)
  );
endmodule

`resetall
