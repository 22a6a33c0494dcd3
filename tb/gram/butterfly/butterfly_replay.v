// SPDX-License-Identifier: Apache-2.0
// butterfly under replay; the item's parts are delayed as centring delays them.
`resetall
`default_nettype none

module butterfly_replay #(
    parameter LOW  = 48,
    parameter HIGH = 50,
    parameter TAG  = 8
) (
    input  wire clk,
    input  wire rst,
    output wire done
);
  wire first;
  wire second;
  wire plain;
  wire from_value;
  wire [TAG-1:0] tag;
  wire [LOW+HIGH-1:0] item;
  wire [LOW+HIGH-1:0] value;
  wire out_valid;
  wire [TAG-1:0] out_tag;
  wire [LOW+HIGH-1:0] out_value;
  reg [LOW-1:0] item_low;
  reg [LOW-1:0] value_low;
  reg [2*HIGH-1:0] item_high;
  reg [2*HIGH-1:0] value_high;

  always @(posedge clk) begin
    item_low   <= item[LOW-1:0];
    value_low  <= value[LOW-1:0];
    item_high  <= {item_high[HIGH-1:0], item[LOW+HIGH-1:LOW]};
    value_high <= {value_high[HIGH-1:0], value[LOW+HIGH-1:LOW]};
  end

  butterfly #(
      .LOW_BITS (LOW),
      .HIGH_BITS(HIGH),
      .TAG_BITS (TAG)
  ) dut (
      .clk(clk),
      .rst(rst),
      .in_first(first),
      .in_second(second),
      .in_plain(plain),
      .in_value(from_value),
      .in_tag(tag),
      .in_low(item_low),
      .in_high(item_high[2*HIGH-1:HIGH]),
      .value_low(value_low),
      .value_high(value_high[2*HIGH-1:HIGH]),
      .out_valid(out_valid),
      .out_tag(out_tag),
      .out_value(out_value)
  );

  replay #(
      .IN_BITS (4 + TAG + 2 * (LOW + HIGH)),
      .OUT_BITS(1 + TAG + LOW + HIGH)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({first, second, plain, from_value, tag, item, value}),
      .result({out_valid, out_tag, out_value}),
      .done(done)
  );
endmodule

`resetall
