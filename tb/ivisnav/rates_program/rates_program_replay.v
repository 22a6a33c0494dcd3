// SPDX-License-Identifier: Apache-2.0
// rates_program under replay: the next word's fields, and the word's in their order in it.
`resetall
`default_nettype none

module rates_program_replay (
    input  wire clk,
    input  wire rst,
    output wire done
);
  localparam WORD = 68;
  wire valid, clear, run;
  wire [8:0] address;
  wire next_bus_bank, next_indexed;
  wire [4:0] next_bus_address;
  wire bus_bank, indexed, clamp, product_write, subtract, divide, load, output_valid, term, first, last;
  wire [1:0] x_bank, c_bank, back, mark;
  wire [4:0] x_address, bus_address, c_address, sum_address, output_index;
  wire [2:0] y_select, bus_lane, product_address, track, row, column;
  wire [5:0] sum_lanes;

  rates_program dut (
      .clk(clk),
      .rst(rst | clear),
      .run(run),
      .address(address),
      .next_bus_bank(next_bus_bank),
      .next_bus_address(next_bus_address),
      .next_indexed(next_indexed),
      .x_bank(x_bank),
      .x_address(x_address),
      .y_select(y_select),
      .bus_bank(bus_bank),
      .bus_address(bus_address),
      .bus_lane(bus_lane),
      .indexed(indexed),
      .clamp(clamp),
      .product_write(product_write),
      .product_address(product_address),
      .c_bank(c_bank),
      .c_address(c_address),
      .subtract(subtract),
      .sum_lanes(sum_lanes),
      .sum_address(sum_address),
      .divide(divide),
      .load(load),
      .track(track),
      .output_valid(output_valid),
      .output_index(output_index),
      .back(back),
      .mark(mark),
      .term(term),
      .row(row),
      .column(column),
      .first(first),
      .last(last)
  );

  wire [WORD-1:0] word = {
    x_bank, x_address, y_select, bus_bank, bus_address, bus_lane, indexed, clamp, product_write, product_address,
    c_bank, c_address, subtract, sum_lanes, sum_address, divide, load, track, output_valid, output_index, back, mark,
    term, row, column, first, last
  };

  replay #(
      .IN_BITS (1 + 1 + 1 + 9),
      .OUT_BITS(1 + 7 + WORD)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({valid, clear, run, address}),
      .result({valid, next_bus_bank, next_bus_address, next_indexed, word}),
      .done(done)
  );
endmodule

`resetall
