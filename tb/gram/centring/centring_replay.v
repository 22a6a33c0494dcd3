// SPDX-License-Identifier: Apache-2.0
// centring under replay; the low part is delayed so that a result is one word.
`resetall
`default_nettype none

module centring_replay #(
    parameter W = 16,
    parameter M1 = 48,
    parameter M2 = 80,
    parameter CENTRED = 98,
    parameter LOW = 48,
    parameter LATENCY = 4,
    parameter TAG = 8
) (
    input  wire clk,
    input  wire rst,
    output wire done
);
  wire valid;
  wire [TAG-1:0] tag;
  wire [W-1:0] weight_sum;
  wire [M2-1:0] moment;
  wire [M1-1:0] first_i;
  wire [M1-1:0] first_j;
  wire early_valid;
  wire [TAG-1:0] early_tag;
  wire [LOW-1:0] low;
  wire [CENTRED-LOW-1:0] high;
  reg [1:0] valid_line;
  reg [2*TAG-1:0] tag_line;
  reg [LOW-1:0] low_late;

  centring #(
      .WEIGHT_SUM_BITS(W),
      .M1_BITS(M1),
      .M2_BITS(M2),
      .CENTRED_BITS(CENTRED),
      .LOW_BITS(LOW),
      .LATENCY(LATENCY),
      .TAG_BITS(TAG)
  ) dut (
      .clk(clk),
      .rst(rst),
      .in_valid(valid),
      .in_tag(tag),
      .weight_sum(weight_sum),
      .moment(moment),
      .first_i(first_i),
      .first_j(first_j),
      .out_valid(early_valid),
      .out_tag(early_tag),
      .centred_low(low),
      .centred_high(high)
  );

  always @(posedge clk) begin
    valid_line <= {valid_line[0], early_valid};
    tag_line   <= {tag_line[TAG-1:0], early_tag};
    low_late   <= low;
    if (rst) valid_line <= 2'b00;
  end

  replay #(
      .IN_BITS (1 + TAG + W + M2 + 2 * M1),
      .OUT_BITS(1 + TAG + CENTRED)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({valid, tag, weight_sum, moment, first_i, first_j}),
      .result({valid_line[1], tag_line[2*TAG-1:TAG], high, low_late}),
      .done(done)
  );
endmodule

`resetall
