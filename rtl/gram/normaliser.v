// SPDX-License-Identifier: Apache-2.0
// Integer to lane float, rounding down. Let s be the count of sign bits of `value` beyond the first, and 2^e the weight
// that bit BITS-35 gets by shifting the value left by s: e = BITS - 35 - s.
//   in : value signed, BITS wide; low; scale signed; tag; one item a cycle
//   out: low = 0: mant = floor(value / 2^e), its two top bits differ           value = mant * 2^e (rounded down)
//        low = 1: mant = floor(value / 2^(e-34)) mod 2^34, not normalised      the next 34 bits below
//        exp = e (- 34) + scale modulo 2^12; mant = 0: zero = 1 and exp = 0
// Latency 3.
//   cycle 1  sign run of each group of 16, and the first group that has a change
//   2        shift by a multiple of 16 (and by 34 for low) into a window of 35 + 15 bits
//   3        shift by 0..15
// Below bit 0 stands a 0, so -1 has its change there and only 0 has none.
`resetall
`default_nettype none

module normaliser #(
    parameter BITS     = 98,  // 98..144
    parameter TAG_BITS = 6
) (
    input wire clk,
    input wire rst,
    // integer
    input wire in_valid,
    input wire signed [BITS-1:0] value,
    input wire low,
    input wire signed [11:0] scale,
    input wire [TAG_BITS-1:0] in_tag,
    // float
    output reg out_valid,
    output reg signed [34:0] mant,
    output reg signed [11:0] exp,
    output reg zero,
    output reg [TAG_BITS-1:0] out_tag
);
  localparam GROUPS = (BITS + 15) / 16;  // 7..9
  localparam EXP_HIGH = BITS - 35;
  localparam EXP_LOW = BITS - 35 - 34;

  reg valid_1;
  reg valid_2;
  reg [TAG_BITS-1:0] tag_1;
  reg [TAG_BITS-1:0] tag_2;

  // ---- cycle 1: where the sign ends
  wire [16*GROUPS:0] padded = {value, {(16 * GROUPS - BITS + 1) {1'b0}}};
  wire [8:0] any;  // group 0 is the most significant
  wire [4*GROUPS-1:0] count;
  genvar k;
  generate
    for (k = 0; k < GROUPS; k = k + 1) begin : g_group
      sign_run u_run (
          .bits(padded[16*(GROUPS-1-k)+:17]),
          .count(count[4*k+:4]),
          .any(any[k])
      );
    end
    for (k = GROUPS; k < 9; k = k + 1) begin : g_absent
      assign any[k] = 1'b0;
    end
  endgenerate

  wire none_64 = !(any[0] || any[1] || any[2] || any[3]);
  wire none_128 = GROUPS > 8 && none_64 && !(any[4] || any[5] || any[6] || any[7]);
  wire [2:0] quad = none_64 ? any[6:4] : any[2:0];
  wire unused_any = any[8];  // after 128 sign bits there is this group or, for zero, any will do

  reg signed [BITS-1:0] value_1;
  reg low_1;
  reg signed [11:0] scale_1;
  reg [4*GROUPS-1:0] count_1;
  reg [3:0] group;  // sign bits beyond the first / 16
  always @(posedge clk) begin
    value_1 <= value;
    low_1 <= low;
    scale_1 <= scale;
    count_1 <= count;
    group[3] <= none_128;
    group[2] <= none_64 && !none_128;
    group[1] <= !(quad[0] || quad[1] || none_128);
    group[0] <= !(quad[0] || none_128) && (quad[1] || !quad[2]);
  end

  // ---- cycle 2: coarse shift. The upper 98 bits reach the window by one of the shifts 0..48.
  // The multiplexers are written as AND-OR, which synthesis packs into one 6-input LUT a bit.
  wire [BITS-1:0] by_64 = ({BITS{!low_1 && !group[2]}} & value_1) | ({BITS{!low_1 && group[2]}} & (value_1 << 64)) |
      ({BITS{low_1 && !group[2]}} & (value_1 << 34)) | ({BITS{low_1 && group[2]}} & (value_1 << 98));
  wire [97:0] top;
  generate
    if (GROUPS > 8) begin : g_beyond
      // after 128 sign bits only the lowest BITS - 128 are left, and nothing for low
      wire unused_low = &{1'b0, by_64[BITS-99:0]};
      wire [97:0] by_128 = {value_1[BITS-129:0] & {(BITS - 128) {!low_1}}, {(226 - BITS) {1'b0}}};
      assign top = group[3] ? by_128 : by_64[BITS-1-:98];
    end else begin : g_enough
      assign top = by_64[BITS-1-:98];
    end
  endgenerate
  wire [49:0] by_16 = ({50{group[1:0] == 2'd0}} & top[97:48]) | ({50{group[1:0] == 2'd1}} & top[81:32]) |
      ({50{group[1:0] == 2'd2}} & top[65:16]) | ({50{group[1:0] == 2'd3}} & top[49:0]);
  wire [63:0] count_all = {{(64 - 4 * GROUPS) {1'b0}}, count_1};

  reg [49:0] window;
  reg [3:0] fine;
  reg low_2;
  reg signed [11:0] exp_2;
  always @(posedge clk) begin
    window <= by_16;
    fine <= count_all[4*group+:4];
    low_2 <= low_1;
    exp_2 <= scale_1 + (low_1 ? EXP_LOW[11:0] : EXP_HIGH[11:0]) - {4'd0, group, 4'd0};
  end

  // ---- cycle 3: fine shift
  wire [37:0] by_4 = ({38{fine[3:2] == 2'd0}} & window[49:12]) | ({38{fine[3:2] == 2'd1}} & window[45:8]) |
      ({38{fine[3:2] == 2'd2}} & window[41:4]) | ({38{fine[3:2] == 2'd3}} & window[37:0]);
  wire [34:0] by_1 = ({35{fine[1:0] == 2'd0}} & by_4[37:3]) | ({35{fine[1:0] == 2'd1}} & by_4[36:2]) |
      ({35{fine[1:0] == 2'd2}} & by_4[35:1]) | ({35{fine[1:0] == 2'd3}} & by_4[34:0]);
  wire top_bit = by_1[34] && !low_2;
  wire is_zero = !(top_bit || |by_1[33:0]);
  always @(posedge clk) begin
    mant <= {top_bit, by_1[33:0]};
    zero <= is_zero;
    exp  <= is_zero ? 12'sd0 : exp_2 - {8'd0, fine};
  end

  always @(posedge clk) begin
    tag_1 <= in_tag;
    tag_2 <= tag_1;
    out_tag <= tag_2;
    valid_1 <= in_valid;
    valid_2 <= valid_1;
    out_valid <= valid_2;
    if (rst) begin
      valid_1   <= 1'b0;
      valid_2   <= 1'b0;
      out_valid <= 1'b0;
    end
  end

  generate
    if (BITS < 98 || BITS > 144) begin : g_check
      normaliser_BITS_must_be_98_to_144 u_error ();
    end
  endgenerate
endmodule

`resetall
