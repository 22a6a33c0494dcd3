// SPDX-License-Identifier: Apache-2.0
// Exact integer times a power of two to IEEE-754 binary32, rounded once, to nearest, ties to even.
//
//   result = value 2^scale; value signed, BITS wide; scale signed. Overflow gives infinity of the sign, 0 gives +0.
//   DENORMALS = 0: where IEEE's result is denormal, zero of the sign (from 2^-126 - 2^-150 on it is 2^-126).
//   DENORMALS = 1: gradual underflow.
//
//   With s sign bits beyond the first, the leading bit weighs 2^(BITS - 2 - s + scale).
//
// cycle | 0 value, scale | 1 sign run of each group of 16, and the first group that has a change
//       | 2 moved left by a multiple of 16 into a window of 48 | 3 moved by 0..15 | 4 rounded and packed
// Latency 4, one a clock; no reset: a pipeline of data.
// -v = ~v + 1: a negative value is complemented on the way, and the one is added where rounding adds: it gets there if
// all bits below are zero. So -2^k comes as all ones and one more.
`resetall
`default_nettype none
module integer_to_float #(
    parameter BITS      = 98,  // 64..192
    parameter DENORMALS = 0
) (
    input  wire                   clk,
    input  wire signed [BITS-1:0] value,
    input  wire signed [    11:0] scale,
    output reg         [    31:0] result
);
  localparam GROUPS = (BITS + 15) / 16;  // 4..12
  localparam TOP = BITS + 124;  // biased exponent, less one, of a leading bit at BITS - 2

  // ---- cycle 1: where the sign ends. Below bit 0 stands a 0, so -1 has its change there and only 0 has none.
  wire [192:0] padded = {value, {(193 - BITS) {1'b0}}};
  wire [11:0] any;  // group 0 is the most significant
  wire [11:0] some;
  wire [47:0] count;
  genvar k;
  generate
    for (k = 0; k < GROUPS; k = k + 1) begin : g_group
      sign_run u_run (
          .bits (padded[16*(11-k)+:17]),
          .count(count[4*k+:4]),
          .any  (any[k])
      );
      assign some[k] = |padded[16*(11-k)+1+:16];
    end
    for (k = GROUPS; k < 12; k = k + 1) begin : g_absent
      assign any[k] = 1'b0;
      assign some[k] = 1'b0;
      assign count[4*k+:4] = 4'd0;
    end
    if (BITS < 64 || BITS > 192) begin : g_check
      integer_to_float_BITS_must_be_64_to_192 u_error ();
    end
  endgenerate
  wire none_64 = ~|any[3:0];
  wire none_128 = GROUPS > 8 && none_64 && ~|any[7:4];
  wire [2:0] quad = none_128 ? any[10:8] : none_64 ? any[6:4] : any[2:0];

  reg [BITS-1:0] value_1;
  reg signed [11:0] scale_1;
  reg [4*GROUPS-1:0] count_1;
  reg [11:3] some_1;
  reg [3:0] group;  // sign bits beyond the first / 16
  always @(posedge clk) begin
    value_1  <= value;
    scale_1  <= scale;
    count_1  <= count[4*GROUPS-1:0];
    some_1   <= some[11:3];
    group[3] <= none_128;
    group[2] <= GROUPS > 4 && none_64 && !none_128;
    group[1] <= !(quad[0] || quad[1]);
    group[0] <= !quad[0] && (quad[1] || !quad[2]);
  end

  // ---- cycle 2: the group and the two below it, complemented if negative; multiplexers as AND-OR for the mapper
  wire negative = value_1[BITS-1];
  wire [191:0] full = {value_1, {(192 - BITS) {1'b0}}};
  wire [95:0] by_64 = (({96{~group[3] & ~group[2]}} & full[191:96]) | ({96{group[2]}} & full[127:32]) |
      ({96{group[3]}} & {full[63:0], 32'd0})) ^ {96{negative}};
  wire [47:0] by_16 = ({48{group[1:0] == 2'd0}} & by_64[95:48]) | ({48{group[1:0] == 2'd1}} & by_64[79:32]) |
      ({48{group[1:0] == 2'd2}} & by_64[63:16]) | ({48{group[1:0] == 2'd3}} & by_64[47:0]);
  wire [63:0] count_all = {{(64 - 4 * GROUPS) {1'b0}}, count_1};
  wire [11:3] beyond = some_1 & (9'h1FF << group);  // groups below the window

  reg [46:0] window;
  reg [3:0] fine;
  reg far_2, negative_2;
  reg signed [12:0] base_2;
  always @(posedge clk) begin
    window     <= by_16[46:0];
    fine       <= count_all[4*group+:4];
    far_2      <= |beyond;
    negative_2 <= negative;
    base_2     <= $signed({scale_1[11], scale_1}) + TOP[12:0] - {5'd0, group, 4'd0};
  end

  // ---- cycle 3: 24 bits and the guard bit; whether any bit below is set
  wire [27:0] by_4 = ({28{fine[3:2] == 2'd0}} & window[46:19]) | ({28{fine[3:2] == 2'd1}} & window[42:15]) |
      ({28{fine[3:2] == 2'd2}} & window[38:11]) | ({28{fine[3:2] == 2'd3}} & window[34:7]);
  wire [24:0] by_1 = ({25{fine[1:0] == 2'd0}} & by_4[27:3]) | ({25{fine[1:0] == 2'd1}} & by_4[26:2]) |
      ({25{fine[1:0] == 2'd2}} & by_4[25:1]) | ({25{fine[1:0] == 2'd3}} & by_4[24:0]);
  wire [21:0] rest = (window[21:0] ^ {22{negative_2}}) & (22'h3FFFFF >> fine);

  reg [24:0] kept_3;
  reg rest_3, negative_3, zero_3, edge_3;
  reg signed [12:0] base_3;  // biased exponent less one
  always @(posedge clk) begin
    kept_3     <= by_1;
    rest_3     <= far_2 | (|rest);
    negative_3 <= negative_2;
    zero_3     <= ~by_1[24];
    base_3     <= base_2 - $signed({9'd0, fine});
    edge_3     <= DENORMALS == 0 & base_2 + 13'sd1 == $signed({9'd0, fine});  // base_3 = -1
  end

  // ---- cycle 4
  wire over = base_3 > 253;
  wire below, edge_case, low, hidden, guard;
  wire [22:0] fraction;
  wire [ 7:0] base;
  generate
    if (DENORMALS == 0) begin : g_flush
      assign below = base_3 < -1;
      assign edge_case = edge_3;  // exponent 0: the bits kept count half
      assign {fraction, guard} = kept_3[23:0];
      assign hidden = 1'b1;
      assign low = rest_3;
      assign base = base_3[7:0];
    end else begin : g_gradual
      wire signed [12:0] short = -base_3;
      wire tiny = base_3[12];
      wire [4:0] right = ~tiny ? 5'd0 : short > 31 ? 5'd31 : short[4:0];
      assign below = 1'b0;
      assign edge_case = 1'b0;
      assign {hidden, fraction, guard} = kept_3 >> right;
      assign low = rest_3 | (|((kept_3 ^ {25{negative_3}}) & ~(25'h1FFFFFF << right)));
      assign base = tiny ? 8'd0 : base_3[7:0];
      wire unused = &{1'b0, short[12:5], edge_3};
    end
  endgenerate
  // complemented, nothing below: one is added at the guard bit
  wire up = edge_case | (low ? guard : negative_3 ? guard | fraction[0] : guard & fraction[0]);
  // At exponent 0 nothing but 24 ones rounds to 2^-126, and they always do; with the one still to add, 23 are enough.
  wire last = fraction[0] | (edge_case & negative_3 & ~low & guard);
  wire [30:0] rounded = {base, fraction[22:1], last} + {7'd0, hidden, 23'd0} + {30'd0, up};
  wire special = zero_3 | over | below;
  always @(posedge clk) begin
    result[31]    <= negative_3;
    result[30:23] <= (rounded[30:23] & {8{~special}}) | {8{over & ~zero_3}};
    if (special | edge_case) result[22:0] <= 23'd0;
    else result[22:0] <= rounded[22:0];
  end

  wire unused = &{1'b0, any[11], any[7], some[2:0], count, by_16[47], padded, kept_3[24]};
endmodule
`resetall
