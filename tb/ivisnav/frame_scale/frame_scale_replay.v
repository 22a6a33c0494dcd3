// SPDX-License-Identifier: Apache-2.0
// frame_scale under replay: the stimulus says in which clocks the outputs are looked at.
`resetall
`default_nettype none

module frame_scale_replay (
    input  wire clk,
    input  wire rst,
    output wire done
);
  wire look, estimated;
  wire [5:0] h_bits, y_bits, weight_bits;
  wire [7:0] frac_h, frac_y;
  wire [11:0] hh, hy, yy, rate_back, rss_back, covariance_back;
  wire [6:0] right;

  frame_scale dut (
      .clk(clk),
      .h_bits(h_bits),
      .y_bits(y_bits),
      .weight_bits(weight_bits),
      .frac_h(frac_h),
      .frac_y(frac_y),
      .estimated(estimated),
      .hh(hh),
      .hy(hy),
      .yy(yy),
      .right(right),
      .rate_back(rate_back),
      .rss_back(rss_back),
      .covariance_back(covariance_back)
  );

  replay #(
      .IN_BITS (1 + 18 + 16 + 1),
      .OUT_BITS(1 + 36 + 7 + 36)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({look, h_bits, y_bits, weight_bits, frac_h, frac_y, estimated}),
      .result({look && !rst, hh, hy, yy, right, rate_back, rss_back, covariance_back}),
      .done(done)
  );
endmodule

`resetall
