// SPDX-License-Identifier: Apache-2.0
// moment_stream under replay.
`resetall
`default_nettype none

module moment_stream_replay #(
    parameter W = 16,
    parameter M1 = 48,
    parameter M2 = 80,
    parameter CENTRED = 98,
    parameter VALUE = 98,
    parameter TAG = 6
) (
    input  wire clk,
    input  wire rst,
    output wire done
);
  wire pair_valid;
  wire value_valid;
  wire low;
  wire [TAG-1:0] pair_tag;
  wire [TAG-1:0] value_tag;
  wire [11:0] pair_scale;
  wire [11:0] value_scale;
  wire [W-1:0] weight_sum;
  wire [M2-1:0] moment;
  wire [M1-1:0] first_i;
  wire [M1-1:0] first_j;
  wire [VALUE-1:0] value;
  wire item_valid;
  wire [TAG-1:0] item_tag;
  wire [34:0] item_mant;
  wire [11:0] item_exp;
  wire item_zero;

  moment_stream #(
      .WEIGHT_SUM_BITS(W),
      .M1_BITS(M1),
      .M2_BITS(M2),
      .CENTRED_BITS(CENTRED),
      .VALUE_BITS(VALUE),
      .TAG_BITS(TAG)
  ) dut (
      .clk(clk),
      .rst(rst),
      .low(low),
      .pair_valid(pair_valid),
      .pair_tag(pair_tag),
      .weight_sum(weight_sum),
      .pair_moment(moment),
      .pair_first_i(first_i),
      .pair_first_j(first_j),
      .pair_scale(pair_scale),
      .value_valid(value_valid),
      .value_tag(value_tag),
      .value(value),
      .value_scale(value_scale),
      .item_valid(item_valid),
      .item_tag(item_tag),
      .item_mant(item_mant),
      .item_exp(item_exp),
      .item_zero(item_zero)
  );

  replay #(
      .IN_BITS (3 + 2 * TAG + 24 + W + M2 + 2 * M1 + VALUE),
      .OUT_BITS(2 + TAG + 35 + 12)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({
        pair_valid, value_valid, low, pair_tag, value_tag, pair_scale, value_scale,
        weight_sum, moment, first_i, first_j, value
      }),
      .result({item_valid, item_tag, item_zero, item_mant, item_exp}),
      .done(done)
  );
endmodule

`resetall
