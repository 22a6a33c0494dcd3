// SPDX-License-Identifier: Apache-2.0
// centred = weight_sum * moment - first_i * first_j, exactly; weight sums up to 17 bits (see centring.v for the ports).
// 10 DSPs. Carries are pipelined: the low 48 bits leave a cycle before the high ones.
//
//   W G     : limbs of G, 24 bits      g0 g1 | g2 g3           two rows, at 2^0 (unsigned) and 2^48
//   m_i m_j : limbs of m_i, 24 bits a0 a1; of m_j, 17 bits b0 b1 b2
//             rows a0 (b1,b0) at 2^0, a1 (b1,b0) at 2^24, (a1,a0) b2 at 2^34
//
//   cycle  low 48 bits                           high bits
//   1      limb products (M)
//   2      rows (P)
//   3      A = row0 - rowa, B = rowb + rowc      B = rowb + rowc + 1
//   4      A - B                                 A = row0 - rowa - borrow, D = row1 - B - carry   (D is one too small)
//   5      (out)                                 D + A + 1 - borrow
`resetall
`default_nettype none

module centring_narrow #(
    parameter WEIGHT_SUM_BITS = 16,  // <= 17
    parameter M1_BITS         = 48,  // 35..48
    parameter M2_BITS         = 80,  // 73..96
    parameter CENTRED_BITS    = 98   // M2_BITS + WEIGHT_SUM_BITS + 2; 86..102
) (
    input wire clk,
    input wire [WEIGHT_SUM_BITS-1:0] weight_sum,
    input wire signed [M2_BITS-1:0] moment,
    input wire signed [M1_BITS-1:0] first_i,
    input wire signed [M1_BITS-1:0] first_j,
    output reg [47:0] centred_low,
    output reg [CENTRED_BITS-49:0] centred_high
);
  localparam HIGH = CENTRED_BITS - 48;

  // ---- limbs, in the DSP's signed ports
  wire [95:0] g = {{(96 - M2_BITS) {moment[M2_BITS-1]}}, moment};
  wire [47:0] a = {{(48 - M1_BITS) {first_i[M1_BITS-1]}}, first_i};
  wire [51:0] b = {{(52 - M1_BITS) {first_j[M1_BITS-1]}}, first_j};
  wire signed [17:0] w = {{(18 - WEIGHT_SUM_BITS) {1'b0}}, weight_sum};
  wire signed [24:0] a0 = {1'b0, a[23:0]};
  wire signed [24:0] a1 = {a[47], a[47:24]};
  wire signed [17:0] b0 = {1'b0, b[16:0]};
  wire signed [17:0] b1 = {1'b0, b[33:17]};
  wire signed [17:0] b2 = b[51:34];

  // ---- cycle 2: rows
  wire signed [67:0] row_g01;  // unsigned 65 bits: weight_sum < 2^17, limbs < 2^48
  wire signed [67:0] row_g23;
  wire signed [60:0] row_a0;  // unsigned 58 bits
  wire signed [60:0] row_a1;
  wire signed [67:0] row_b2;

  limb_pair_product #(
      .SHIFT(24)
  ) u_g01 (
      .clk(clk),
      .low_a({1'b0, g[23:0]}),
      .low_b(w),
      .high_a({1'b0, g[47:24]}),
      .high_b(w),
      .result(row_g01)
  );
  limb_pair_product #(
      .SHIFT(24)
  ) u_g23 (
      .clk(clk),
      .low_a({1'b0, g[71:48]}),
      .low_b(w),
      .high_a({g[95], g[95:72]}),
      .high_b(w),
      .result(row_g23)
  );
  limb_pair_product #(
      .SHIFT(17)
  ) u_a0 (
      .clk(clk),
      .low_a(a0),
      .low_b(b0),
      .high_a(a0),
      .high_b(b1),
      .result(row_a0)
  );
  limb_pair_product #(
      .SHIFT(17)
  ) u_a1 (
      .clk(clk),
      .low_a(a1),
      .low_b(b0),
      .high_a(a1),
      .high_b(b1),
      .result(row_a1)
  );
  limb_pair_product #(
      .SHIFT(24)
  ) u_b2 (
      .clk(clk),
      .low_a(a0),
      .low_b(b2),
      .high_a(a1),
      .high_b(b2),
      .result(row_b2)
  );

  // ---- cycle 3
  reg [47:0] a_low;
  reg a_borrow;
  reg [17:0] a_row_g;
  reg [17:0] a_row_a;
  reg [23:0] b_low;  // at 2^24
  reg b_carry;
  reg [HIGH-1:0] b_high;  // + 1
  reg [HIGH-1:0] g_high;
  wire [HIGH-1:0] row_a1_high = {{(HIGH - 37) {row_a1[60]}}, row_a1[60:24]};
  wire [HIGH-1:0] row_b2_high = row_b2[14+:HIGH];

  // ---- cycle 4
  reg c_borrow;
  reg signed [17:0] a_high;  // row0 - rowa is within +-2^65, so 18 bits above 2^48
  reg [HIGH-1:0] d_high;

  // ---- carries enter as a bit below the lowest one, which keeps each sum one carry chain
  wire [HIGH:0] b_high_sum = {row_a1_high, 1'b1} + {row_b2_high, 1'b1};
  wire [18:0] a_high_sum = {a_row_g, 1'b0} - {a_row_a, a_borrow};
  wire [HIGH:0] d_high_sum = {g_high, 1'b0} - {b_high, b_carry};
  wire [HIGH:0] high_sum = {d_high, !c_borrow} + {{(HIGH - 18) {a_high[17]}}, a_high, 1'b1};

  always @(posedge clk) begin
    {a_borrow, a_low} <= {1'b0, row_g01[47:0]} - {1'b0, row_a0[47:0]};
    a_row_g <= row_g01[65:48];
    a_row_a <= {{5{row_a0[60]}}, row_a0[60:48]};
    b_low[9:0] <= row_a1[9:0];
    {b_carry, b_low[23:10]} <= {1'b0, row_a1[23:10]} + {1'b0, row_b2[13:0]};
    b_high <= b_high_sum[HIGH:1];
    g_high <= row_g23[HIGH-1:0];

    centred_low[23:0] <= a_low[23:0];
    {c_borrow, centred_low[47:24]} <= {1'b0, a_low[47:24]} - {1'b0, b_low};
    a_high <= a_high_sum[18:1];
    d_high <= d_high_sum[HIGH:1];

    centred_high <= high_sum[HIGH:1];
  end

  // the rows' top bits repeat their signs or are 0
  wire unused = &{1'b0, row_g01[67:66], row_g23[67:HIGH], row_b2[67:HIGH+14], b_high_sum[0], a_high_sum[0],
                  d_high_sum[0], high_sum[0]};
endmodule

`resetall
