// SPDX-License-Identifier: Apache-2.0
// wide_aligner under replay.
`resetall
`default_nettype none

module wide_aligner_replay (
    input  wire clk,
    input  wire rst,
    output wire done
);
  wire valid;
  wire [69:0] value;
  wire invert;
  wire [6:0] shift;
  wire [69:0] aligned;

  wide_aligner dut (
      .value(value),
      .invert(invert),
      .shift(shift),
      .aligned(aligned)
  );

  replay #(
      .IN_BITS (1 + 70 + 1 + 7),
      .OUT_BITS(1 + 70)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({valid, value, invert, shift}),
      .result({valid, aligned}),
      .done(done)
  );
endmodule

`resetall
