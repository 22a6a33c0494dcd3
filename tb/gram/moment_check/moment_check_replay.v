// SPDX-License-Identifier: Apache-2.0
// moment_check under replay. A result: {valid, checked, mismatch, sum, residue}, valid where the drained side's sum is about to be fed back
// or looked at, and in the clock of checked.
`resetall
`default_nettype none

module moment_check_replay #(
    parameter RING       = 0,
    parameter ITEM_BITS  = 96,
    parameter VALUE_BITS = 64
) (
    input  wire clk,
    input  wire rst,
    output wire done
);
  wire clear, beat, item_valid, value_valid, value_last, checked, mismatch;
  wire [63:0] beat_data;
  wire [1:0] beat_index;
  wire [15:0] beat_weight;
  wire [5:0] item_key, value_key;
  wire [ITEM_BITS-1:0] item;
  wire [VALUE_BITS-1:0] value;

  moment_check #(
      .RING(RING),
      .ITEM_BITS(ITEM_BITS),
      .VALUE_BITS(VALUE_BITS)
  ) dut (
      .clk(clk),
      .rst(rst),
      .clear(clear),
      .beat(beat),
      .beat_data(beat_data),
      .beat_index(beat_index),
      .beat_weight(beat_weight),
      .item_valid(item_valid),
      .item_key(item_key),
      .item(item),
      .value_valid(value_valid),
      .value_key(value_key),
      .value_last(value_last),
      .value(value),
      .checked(checked),
      .mismatch(mismatch)
  );

  replay #(
      .IN_BITS (1 + 1 + 64 + 2 + 16 + 1 + 6 + ITEM_BITS + 1 + 6 + 1 + VALUE_BITS),
      .OUT_BITS(3 + 40 + 50),
      .DEPTH   (270000)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({clear, beat, beat_data, beat_index, beat_weight, item_valid, item_key, item,
             value_valid, value_key, value_last, value}),
      .result({dut.u_items.ends[6] || checked, checked, mismatch, dut.u_items.sum, dut.residue}),
      .done(done)
  );
endmodule

`resetall
