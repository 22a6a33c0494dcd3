// SPDX-License-Identifier: Apache-2.0
// normaliser under replay.
`resetall
`default_nettype none

module normaliser_replay #(
    parameter BITS = 98,
    parameter TAG  = 8
) (
    input  wire clk,
    input  wire rst,
    output wire done
);
  wire valid;
  wire [TAG-1:0] tag;
  wire low;
  wire [11:0] scale;
  wire [BITS-1:0] value;
  wire out_valid;
  wire [TAG-1:0] out_tag;
  wire [34:0] mant;
  wire [11:0] exp;
  wire zero;

  normaliser #(
      .BITS(BITS),
      .TAG_BITS(TAG)
  ) dut (
      .clk(clk),
      .rst(rst),
      .in_valid(valid),
      .value(value),
      .low(low),
      .scale(scale),
      .in_tag(tag),
      .out_valid(out_valid),
      .mant(mant),
      .exp(exp),
      .zero(zero),
      .out_tag(out_tag)
  );

  replay #(
      .IN_BITS (2 + TAG + 12 + BITS),
      .OUT_BITS(2 + TAG + 35 + 12)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({valid, low, tag, scale, value}),
      .result({out_valid, out_tag, zero, mant, exp}),
      .done(done)
  );
endmodule

`resetall
