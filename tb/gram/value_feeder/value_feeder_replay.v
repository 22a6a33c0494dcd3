// SPDX-License-Identifier: Apache-2.0
// value_feeder under replay.
`include "relnav_words.vh"
`resetall
`default_nettype none

module value_feeder_replay #(
    parameter WEIGHTED = 1
) (
    input  wire clk,
    input  wire rst,
    output wire done
);
  localparam W = `RELNAV_W(WEIGHTED), M1 = `RELNAV_M1(WEIGHTED), COUNT = `RELNAV_COUNT;
  wire clear, pair_last, value_valid;
  wire [W-1:0] weight_sum;
  wire [COUNT-1:0] used_count;
  wire [6*M1-1:0] first_moments;
  wire [11:0] moment_scale, value_scale;
  wire [31:0] variance;
  wire [4:0] value_address;
  wire [M1-1:0] value;

  value_feeder #(
      .WEIGHTED(WEIGHTED)
  ) dut (
      .clk(clk),
      .rst(rst),
      .clear(clear),
      .pair_last(pair_last),
      .weight_sum(weight_sum),
      .used_count(used_count),
      .first_moments(first_moments),
      .moment_scale(moment_scale),
      .variance(variance),
      .value_valid(value_valid),
      .value_address(value_address),
      .value(value),
      .value_scale(value_scale)
  );

  replay #(
      .IN_BITS (2 + W + COUNT + 6 * M1 + 12 + 32),
      .OUT_BITS(1 + 5 + M1 + 12)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({clear, pair_last, weight_sum, used_count, first_moments, moment_scale, variance}),
      .result({value_valid, value_address, value, value_scale}),
      .done(done)
  );
endmodule

`resetall
