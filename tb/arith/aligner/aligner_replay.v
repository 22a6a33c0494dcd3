// SPDX-License-Identifier: Apache-2.0
// aligner under replay.
`resetall
`default_nettype none

module aligner_replay (
    input  wire clk,
    input  wire rst,
    output wire done
);
  wire valid;
  wire [44:0] value;
  wire invert;
  wire [5:0] shift;
  wire [44:0] aligned;

  aligner dut (
      .value(value),
      .invert(invert),
      .shift(shift),
      .aligned(aligned)
  );

  replay #(
      .IN_BITS (1 + 45 + 1 + 6),
      .OUT_BITS(1 + 45)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({valid, value, invert, shift}),
      .result({valid, aligned}),
      .done(done)
  );
endmodule

`resetall
