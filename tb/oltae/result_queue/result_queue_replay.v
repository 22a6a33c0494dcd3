// SPDX-License-Identifier: Apache-2.0
// result_queue under replay; the stimulus can reset it.
`resetall
`default_nettype none

module result_queue_replay (
    input  wire clk,
    input  wire rst,
    output wire done
);
  wire clear, enter, single, column, valid;
  wire [2:0] places, mark, word_mark;
  wire [5:0] index, word_index;
  wire [47:0] result_0, result_1, result_2, result_3;
  wire [31:0] word;

  result_queue dut (
      .clk(clk),
      .rst(rst | clear),
      .enter(enter),
      .places(places),
      .single(single),
      .column(column),
      .index(index),
      .mark(mark),
      .result_0(result_0),
      .result_1(result_1),
      .result_2(result_2),
      .result_3(result_3),
      .valid(valid),
      .word_index(word_index),
      .word_mark(word_mark),
      .word(word)
  );

  replay #(
      .IN_BITS (4 + 3 + 6 + 3 + 4 * 48),
      .OUT_BITS(1 + 6 + 3 + 32)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({clear, enter, single, column, places, index, mark, result_0, result_1, result_2, result_3}),
      .result({valid, word_index, word_mark, word}),
      .done(done)
  );
endmodule

`resetall
