// SPDX-License-Identifier: Apache-2.0
// sum_normaliser under replay.
`resetall
`default_nettype none

module sum_normaliser_replay (
    input  wire clk,
    input  wire rst,
    output wire done
);
  wire valid;
  wire [47:0] sum;
  wire [34:0] mantissa;
  wire [5:0] left;

  sum_normaliser dut (
      .clk(clk),
      .sum(sum),
      .mantissa(mantissa),
      .left(left)
  );

  reg [0:0] live;
  always @(posedge clk) live <= rst ? 1'd0 : valid;

  replay #(
      .IN_BITS (1 + 48),
      .OUT_BITS(1 + 35 + 6)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({valid, sum}),
      .result({live[0], mantissa, left}),
      .done(done)
  );
endmodule

`resetall
