// SPDX-License-Identifier: Apache-2.0
// residual_unit under replay: overflow and whatever residual there is, in every clock that counts.
`resetall
`default_nettype none

module residual_unit_replay (
    input  wire clk,
    input  wire rst,
    output wire done
);
  wire look, clear, moment_write, load, term, first, last;
  wire [2:0] moment_row, moment_column, load_place, row, column;
  wire [95:0] moment;
  wire [ 6:0] right;
  wire [31:0] rate;
  wire overflow, residual_valid;
  wire [  2:0] residual_row;
  wire [183:0] residual;

  residual_unit dut (
      .clk(clk),
      .clear(clear),
      .moment_write(moment_write),
      .moment_row(moment_row),
      .moment_column(moment_column),
      .moment(moment),
      .right(right),
      .load(load),
      .load_place(load_place),
      .rate(rate),
      .overflow(overflow),
      .term(term),
      .row(row),
      .column(column),
      .first(first),
      .last(last),
      .residual_valid(residual_valid),
      .residual_row(residual_row),
      .residual(residual)
  );

  replay #(
      .IN_BITS (1 + 1 + 1 + 6 + 96 + 7 + 1 + 3 + 32 + 1 + 6 + 2),
      .OUT_BITS(1 + 1 + 1 + 3 + 184)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({
        look,
        clear,
        moment_write,
        moment_row,
        moment_column,
        moment,
        right,
        load,
        load_place,
        rate,
        term,
        row,
        column,
        first,
        last
      }),
      .result({
        look && !rst,
        overflow,
        residual_valid,
        residual_valid ? residual_row : 3'd0,
        residual_valid ? residual : 184'd0
      }),
      .done(done)
  );
endmodule

`resetall
