// SPDX-License-Identifier: Apache-2.0
// centred = weight_sum * moment - first_i * first_j, exactly; weight sums up to 32 bits (see centring.v for the ports).
// 20 DSPs. Carries are pipelined: the low 64 bits leave a cycle before the high ones.
//
//   W G     : limbs of W, 16 bits w0 w1; of G, 24 bits g0 g1 | g2 g3
//             rows w0 (g1,g0) at 2^0, w0 (g3,g2) at 2^48, w1 (g1,g0) at 2^16, w1 (g3,g2) at 2^64
//   m_i m_j : limbs of m_i, 24 bits a0 a1 a2; of m_j, 17 bits b0 b1 | b2 b3
//             rows x_k = a_k (b1,b0) at 2^24k, y_k = a_k (b3,b2) at 2^(24k+34)
//   Rows that do not overlap share one: (w1 g23, w0 g01), (y1, x0), (y2, x1).
//
//   cycle  low 64 bits                                         high bits, each with the carry of the low part
//   1, 2   limb products (M), rows (P)
//   3      A = (w0 g01) - x0.y1   B = w0 g23 - x2   C = w1 g01 - y0
//   4      A + B                  C - x1                       A, B, C
//   5      (A + B) + (C - x1)                                  A + B, C - x1.y2
//   6      (out)                                               (A + B) + (C - x1.y2)
`resetall
`default_nettype none

module centring_wide #(
    parameter WEIGHT_SUM_BITS = 32,  // 17..32
    parameter M1_BITS         = 64,  // 52..66
    parameter M2_BITS         = 96,  // 73..96
    parameter CENTRED_BITS    = 130
) (
    input wire clk,
    input wire [WEIGHT_SUM_BITS-1:0] weight_sum,
    input wire signed [M2_BITS-1:0] moment,
    input wire signed [M1_BITS-1:0] first_i,
    input wire signed [M1_BITS-1:0] first_j,
    output reg [63:0] centred_low,
    output reg [CENTRED_BITS-65:0] centred_high
);
  localparam HIGH = CENTRED_BITS - 64;

  // ---- limbs, in the DSP's signed ports
  wire [95:0] g = {{(96 - M2_BITS) {moment[M2_BITS-1]}}, moment};
  wire [71:0] a = {{(72 - M1_BITS) {first_i[M1_BITS-1]}}, first_i};
  wire [68:0] b = {{(69 - M1_BITS) {first_j[M1_BITS-1]}}, first_j};
  wire [31:0] w = {{(32 - WEIGHT_SUM_BITS) {1'b0}}, weight_sum};
  wire signed [17:0] w0 = {2'b00, w[15:0]};
  wire signed [17:0] w1 = {2'b00, w[31:16]};
  wire signed [24:0] g0 = {1'b0, g[23:0]};
  wire signed [24:0] g1 = {1'b0, g[47:24]};
  wire signed [24:0] g2 = {1'b0, g[71:48]};
  wire signed [24:0] g3 = {g[95], g[95:72]};
  wire signed [24:0] a0 = {1'b0, a[23:0]};
  wire signed [24:0] a1 = {1'b0, a[47:24]};
  wire signed [24:0] a2 = {a[71], a[71:48]};
  wire signed [17:0] b0 = {1'b0, b[16:0]};
  wire signed [17:0] b1 = {1'b0, b[33:17]};
  wire signed [17:0] b2 = {1'b0, b[50:34]};
  wire signed [17:0] b3 = b[68:51];

  // ---- cycle 2: rows (those that lie in the high bits alone in cycle 3)
  wire signed [67:0] w0_g01;  // unsigned 64 bits
  wire signed [67:0] w0_g23;  // signed 64 bits
  wire signed [67:0] w1_g01;
  wire signed [67:0] w1_g23;
  wire signed [60:0] x0;  // unsigned 58 bits
  wire signed [60:0] x1;
  wire signed [60:0] x2;
  wire signed [60:0] y0;
  wire signed [60:0] y1;
  wire signed [60:0] y2;

  limb_pair_product #(
      .SHIFT(24)
  ) u_w0_g01 (
      .clk(clk),
      .low_a(g0),
      .low_b(w0),
      .high_a(g1),
      .high_b(w0),
      .result(w0_g01)
  );
  limb_pair_product #(
      .SHIFT(24)
  ) u_w0_g23 (
      .clk(clk),
      .low_a(g2),
      .low_b(w0),
      .high_a(g3),
      .high_b(w0),
      .result(w0_g23)
  );
  limb_pair_product #(
      .SHIFT(24)
  ) u_w1_g01 (
      .clk(clk),
      .low_a(g0),
      .low_b(w1),
      .high_a(g1),
      .high_b(w1),
      .result(w1_g01)
  );
  limb_pair_product #(
      .SHIFT(24),
      .DELAY(1)
  ) u_w1_g23 (
      .clk(clk),
      .low_a(g2),
      .low_b(w1),
      .high_a(g3),
      .high_b(w1),
      .result(w1_g23)
  );
  limb_pair_product #(
      .SHIFT(17)
  ) u_x0 (
      .clk(clk),
      .low_a(a0),
      .low_b(b0),
      .high_a(a0),
      .high_b(b1),
      .result(x0)
  );
  limb_pair_product #(
      .SHIFT(17)
  ) u_x1 (
      .clk(clk),
      .low_a(a1),
      .low_b(b0),
      .high_a(a1),
      .high_b(b1),
      .result(x1)
  );
  limb_pair_product #(
      .SHIFT(17)
  ) u_x2 (
      .clk(clk),
      .low_a(a2),
      .low_b(b0),
      .high_a(a2),
      .high_b(b1),
      .result(x2)
  );
  limb_pair_product #(
      .SHIFT(17)
  ) u_y0 (
      .clk(clk),
      .low_a(a0),
      .low_b(b2),
      .high_a(a0),
      .high_b(b3),
      .result(y0)
  );
  limb_pair_product #(
      .SHIFT(17)
  ) u_y1 (
      .clk(clk),
      .low_a(a1),
      .low_b(b2),
      .high_a(a1),
      .high_b(b3),
      .result(y1)
  );
  limb_pair_product #(
      .SHIFT(17),
      .DELAY(1)
  ) u_y2 (
      .clk(clk),
      .low_a(a2),
      .low_b(b2),
      .high_a(a2),
      .high_b(b3),
      .result(y2)
  );

  // ---- low part
  reg [63:0] sum_a;  // cycle 3
  reg [15:0] sum_b;  // at 2^48
  reg [47:0] sum_c;  // at 2^16
  reg [39:0] row_x1;  // at 2^24
  reg borrow_a;
  reg borrow_b;
  reg borrow_c;
  reg [63:0] sum_ab;  // cycle 4
  reg [47:0] sum_cx;  // at 2^16
  reg carry_ab;
  reg borrow_cx;
  reg carry_out;  // cycle 5

  always @(posedge clk) begin
    {borrow_a, sum_a} <= {1'b0, w0_g01[63:0]} - {1'b0, y1[5:0], x0[57:0]};
    {borrow_b, sum_b} <= {1'b0, w0_g23[15:0]} - {1'b0, x2[15:0]};
    sum_c[17:0] <= w1_g01[17:0];
    {borrow_c, sum_c[47:18]} <= {1'b0, w1_g01[47:18]} - {1'b0, y0[29:0]};
    row_x1 <= x1[39:0];

    sum_ab[47:0] <= sum_a[47:0];
    {carry_ab, sum_ab[63:48]} <= {1'b0, sum_a[63:48]} + {1'b0, sum_b};
    sum_cx[7:0] <= sum_c[7:0];
    {borrow_cx, sum_cx[47:8]} <= {1'b0, sum_c[47:8]} - {1'b0, row_x1};

    centred_low[15:0] <= sum_ab[15:0];
    {carry_out, centred_low[63:16]} <= {1'b0, sum_ab[63:16]} + {1'b0, sum_cx};
  end

  // ---- high part. Sums keep only the bits they need below the sign; the last ones are modulo 2^HIGH.
  // A carry enters as a bit below the lowest one, which keeps each sum one carry chain.
  reg [47:0] high_w0_g23;  // cycle 3
  reg [15:0] high_w1_g01;  // unsigned
  reg [47:0] high_y1;
  reg [33:0] high_x2;
  reg [23:0] high_y0;
  reg [17:0] high_x1;  // unsigned; y2 follows at its bit 18
  reg [HIGH-1:0] high_a;  // cycle 4
  reg [48:0] high_b;
  reg [24:0] high_c;
  reg [63:0] high_row;
  reg [HIGH-1:0] high_ab;  // cycle 5
  reg [64:0] high_cx;

  wire [HIGH:0] high_a_sum = {w1_g23[HIGH-1:0], 1'b0} - {{(HIGH - 48) {high_y1[47]}}, high_y1, borrow_a};
  wire [49:0] high_b_sum = {high_w0_g23[47], high_w0_g23, 1'b0} - {{15{high_x2[33]}}, high_x2, borrow_b};
  wire [25:0] high_c_sum = {9'd0, high_w1_g01, 1'b0} - {high_y0[23], high_y0, borrow_c};
  wire [HIGH:0] high_ab_sum = {high_a, 1'b1} + {{(HIGH - 49) {high_b[48]}}, high_b, carry_ab};
  wire [65:0] high_cx_sum = {{40{high_c[24]}}, high_c, 1'b0} - {high_row[63], high_row, borrow_cx};
  wire [HIGH:0] high_sum = {high_ab, 1'b1} + {{(HIGH - 65) {high_cx[64]}}, high_cx, carry_out};

  always @(posedge clk) begin
    high_w0_g23 <= w0_g23[63:16];
    high_w1_g01 <= w1_g01[63:48];
    high_y1 <= y1[53:6];
    high_x2 <= x2[49:16];
    high_y0 <= y0[53:30];
    high_x1 <= x1[57:40];

    high_a <= high_a_sum[HIGH:1];
    high_b <= high_b_sum[49:1];
    high_c <= high_c_sum[25:1];
    high_row <= {y2[45:0], high_x1};

    high_ab <= high_ab_sum[HIGH:1];
    high_cx <= high_cx_sum[65:1];

    centred_high <= high_sum[HIGH:1];
  end

  // the rows' top bits repeat their signs or are 0
  wire unused = &{1'b0, w0_g01[67:64], w0_g23[67:64], w1_g01[67:64], w1_g23[67:HIGH], x0[60:58], x1[60:58],
                  x2[60:50], y0[60:54], y1[60:54], y2[60:46], high_a_sum[0], high_b_sum[0], high_c_sum[0],
                  high_ab_sum[0], high_cx_sum[0], high_sum[0]};
endmodule

`resetall
