// SPDX-License-Identifier: Apache-2.0
// rates_lane under replay: what it gives the bus, in every clock that counts.
`resetall
`default_nettype none

module rates_lane_replay (
    input  wire clk,
    input  wire rst,
    output wire done
);
  wire look, moment_write, own_bank, y_own, product_write, subtract, sum_write;
  wire [1:0] x_bank, c_bank;
  wire [2:0] moment_address, product_address;
  wire [4:0] x_address, own_address, c_address, sum_address;
  wire [31:0] moment, y_common, own;

  rates_lane dut (
      .clk(clk),
      .moment_write(moment_write),
      .moment_address(moment_address),
      .moment(moment),
      .own_bank(own_bank),
      .own_address(own_address),
      .own(own),
      .x_bank(x_bank),
      .x_address(x_address),
      .y_own(y_own),
      .y_common(y_common),
      .product_write(product_write),
      .product_address(product_address),
      .c_bank(c_bank),
      .c_address(c_address),
      .subtract(subtract),
      .sum_write(sum_write),
      .sum_address(sum_address)
  );

  replay #(
      .IN_BITS (1 + 1 + 3 + 32 + 1 + 5 + 2 + 5 + 1 + 32 + 1 + 3 + 2 + 5 + 1 + 1 + 5),
      .OUT_BITS(1 + 32)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({
        look,
        moment_write,
        moment_address,
        moment,
        own_bank,
        own_address,
        x_bank,
        x_address,
        y_own,
        y_common,
        product_write,
        product_address,
        c_bank,
        c_address,
        subtract,
        sum_write,
        sum_address
      }),
      .result({look && !rst, own}),
      .done(done)
  );
endmodule

`resetall
