// SPDX-License-Identifier: Apache-2.0
// integer_to_float of several widths under replay, both builds of each; each takes the low bits of the value.
`resetall
`default_nettype none

module integer_to_float_replay (
    input  wire clk,
    input  wire rst,
    output wire done
);
  localparam LATENCY = 4;
  wire valid;
  wire [11:0] scale;
  wire [143:0] value;
  wire [255:0] results;

  genvar n;
  generate
    for (n = 0; n < 8; n = n + 1) begin : g_width
      // 64, 83, 98, 144
      localparam BITS = n / 2 == 0 ? 64 : n / 2 == 1 ? 83 : n / 2 == 2 ? 98 : 144;
      integer_to_float #(
          .BITS(BITS),
          .DENORMALS(n % 2)
      ) dut (
          .clk(clk),
          .value(value[BITS-1:0]),
          .scale(scale),
          .result(results[32*(7-n)+:32])
      );
    end
  endgenerate

  reg [LATENCY-1:0] live;
  always @(posedge clk) live <= rst ? {LATENCY{1'b0}} : {live[LATENCY-2:0], valid};

  replay #(
      .IN_BITS (1 + 12 + 144),
      .OUT_BITS(1 + 256)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({valid, scale, value}),
      .result({live[LATENCY-1], results}),
      .done(done)
  );
endmodule

`resetall
