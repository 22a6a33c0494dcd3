// SPDX-License-Identifier: Apache-2.0
// to_binary32 under replay.
`resetall
`default_nettype none

module to_binary32_replay (
    input  wire clk,
    input  wire rst,
    output wire done
);
  wire valid;
  wire [47:0] value;
  wire [31:0] binary32;

  to_binary32 dut (
      .clk(clk),
      .value(value),
      .binary32(binary32)
  );

  reg [1:0] live;
  always @(posedge clk) live <= rst ? 2'd0 : {live[0:0], valid};

  replay #(
      .IN_BITS (1 + 48),
      .OUT_BITS(1 + 32)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({valid, value}),
      .result({live[1], binary32}),
      .done(done)
  );
endmodule

`resetall
