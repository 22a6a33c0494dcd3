// SPDX-License-Identifier: Apache-2.0
// How many bits the numbers of a frame need: the smallest s with |c| < 2^s for every component h (c0..c5) and for every y (c6), |c| being
// c or its one's complement, and the smallest s with weight_sum < 2^s.
// What has been seen of h and y is kept twice: differ tells of an upset.
// Latency: three clocks after a row's pair 3 in h_bits and y_bits, one clock after weight_sum in weight_bits. clear makes them 0.
`resetall
`default_nettype none

module range_bits (
    input  wire        clk,
    input  wire        rst,
    input  wire        clear,
    input  wire        pair_valid,
    input  wire        pair_y,      // a is y, b nothing
    input  wire [63:0] pair,        // {b, a}
    input  wire [31:0] weight_sum,
    output reg  [ 5:0] h_bits,
    output reg  [ 5:0] y_bits,
    output reg  [ 5:0] weight_bits,
    output wire        differ
);
  wire [30:0] a = pair[30:0] ^ {31{pair[31]}};
  wire [30:0] b = pair[62:32] ^ {31{pair[63]}};
  wire [30:0] h_set, y_set;
  wire [4:0] h_place, y_place, weight_place;

  // a one below the number: the place of the top bit is then the length
  top_bit u_h (
      .bits ({h_set, 1'b1}),
      .place(h_place)
  );
  top_bit u_y (
      .bits ({y_set, 1'b1}),
      .place(y_place)
  );
  top_bit u_weight (
      .bits ({weight_sum[30:0], 1'b1}),
      .place(weight_place)
  );

  wire [30:0] h_new = pair_valid && !pair_y ? a | b : 31'd0;
  wire [30:0] y_new = pair_valid && pair_y ? a : 31'd0;
  twin_register #(
      .WIDTH(62),
      .RESET(62'd0)
  ) sets (
      .clk(clk),
      .rst(rst || clear),
      .load(pair_valid),
      .d({h_set | h_new, y_set | y_new}),
      .q({h_set, y_set}),
      .differ(differ)
  );

  always @(posedge clk) begin
    h_bits      <= {1'b0, h_place};
    y_bits      <= {1'b0, y_place};
    weight_bits <= weight_sum[31] ? 6'd32 : {1'b0, weight_place};
  end
endmodule

`resetall
