// SPDX-License-Identifier: Apache-2.0
// rates_engine under replay: whatever it says in a clock is a result.
`resetall
`default_nettype none

module rates_engine_replay (
    input  wire clk,
    input  wire rst,
    output wire done
);
  wire engine_rst, item_valid, item_last;
  wire [2:0] item_row, item_column;
  wire [95:0] item_moment;
  wire [5:0] h_bits, y_bits, weight_bits;
  wire [15:0] used_count;
  wire [7:0] frac_h, frac_y;
  wire [31:0] variance;
  wire write_valid, rates_done, all_done, rank_deficient, ill_conditioned;
  wire [ 5:0] write_index;
  wire [31:0] write_data;
  wire [31:0] condition;

  rates_engine dut (
      .clk(clk),
      .rst(rst || engine_rst),
      .item_valid(item_valid),
      .item_row(item_row),
      .item_column(item_column),
      .item_last(item_last),
      .item_moment(item_moment),
      .h_bits(h_bits),
      .y_bits(y_bits),
      .weight_bits(weight_bits),
      .used_count(used_count),
      .frac_h(frac_h),
      .frac_y(frac_y),
      .variance(variance),
      .write_valid(write_valid),
      .write_index(write_index),
      .write_data(write_data),
      .rates_done(rates_done),
      .all_done(all_done),
      .rank_deficient(rank_deficient),
      .ill_conditioned(ill_conditioned),
      .condition(condition)
  );

  wire [3:0] marks = {rates_done, all_done, rank_deficient, ill_conditioned};
  wire says = write_valid === 1'b1 || marks !== 4'd0;

  replay #(
      .IN_BITS (1 + 1 + 3 + 3 + 1 + 96 + 18 + 16 + 16 + 32),
      .OUT_BITS(1 + 1 + 6 + 32 + 4 + 32)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({
        engine_rst,
        item_valid,
        item_row,
        item_column,
        item_last,
        item_moment,
        h_bits,
        y_bits,
        weight_bits,
        used_count,
        frac_h,
        frac_y,
        variance
      }),
      .result({
        says && !rst,
        write_valid,
        write_valid ? write_index : 6'd0,
        write_valid ? write_data : 32'd0,
        marks,
        rates_done || ill_conditioned ? condition : 32'd0
      }),
      .done(done)
  );
endmodule

`resetall
