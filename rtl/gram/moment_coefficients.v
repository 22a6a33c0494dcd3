// SPDX-License-Identifier: Apache-2.0
// What a drained sum is multiplied by in moment_check, modulo p = 2^16 + 1: a memory of 64 words, no clock.
//
// Component 2 k (low half of beat k) has the coefficient c = g_k, component 2 k + 1 has g_k 2^(2 + k); S is the sum of all c. item_residue
// negates all but the items, so theirs stand here negated:
//   sum of w u_i u_j     c_i c_j, twice that where i differs from j
//   sum of w u_i         -S c_i                 negated  (gram_array)
//   sum of w             2^14 S^2 - 2           negated  (gram_array; gram_ring: -2)
//   predicted value      -1                     negated  key 56
//   sum fed back         -1                     negated  key 57
// Keys of gram_array: {slot, lane} of a pair, the address in the stream bank of another value (value_feeder). Of gram_ring: {row, column},
// row <= column; 58 is the sum of the weights.
`resetall
`default_nettype none

module moment_coefficients #(
    parameter        RING    = 0,                       // 0: gram_array, 1: gram_ring
    parameter [23:0] FACTORS = {6'd0, 6'd14, 6'd39, 6'd17}  // {g_3, g_2, g_1, g_0}
) (
    input  wire [ 5:0] key,
    output wire [15:0] coefficient
);
  localparam [31:0] P = 32'd65537;
  localparam [31:0] G_0 = {26'd0, FACTORS[5:0]}, G_1 = {26'd0, FACTORS[11:6]};
  localparam [31:0] G_2 = {26'd0, FACTORS[17:12]}, G_3 = {26'd0, FACTORS[23:18]};
  // c_7 .. c_0
  localparam [255:0] C = {32'd0, G_3, G_2 << 4, G_2, G_1 << 3, G_1, G_0 << 2, G_0};
  localparam [31:0] S = G_0 * 5 + G_1 * 9 + G_2 * 17;
  localparam [31:0] SQUARE = (S * S) % P;

  wire [1023:0] words;
  genvar k;
  generate
    for (k = 0; k < 64; k = k + 1) begin : g_word
      // components of the pair: gram_array's lanes take a_i = 2 i and b_i = 2 i + 1 of slot i, and of slot i + 1 modulo 3
      localparam LANE = k % 8;
      localparam SLOT = k / 8 % 3;
      localparam B_I = LANE == 1 || LANE == 4 || LANE == 5 ? 1 : 0;
      localparam B_J = LANE == 1 || LANE == 2 || LANE == 4 || LANE == 6 ? 1 : 0;
      localparam I = RING != 0 ? k / 8 : 2 * SLOT + B_I;
      localparam J = RING != 0 ? k % 8 : 2 * (LANE < 3 ? SLOT : (SLOT + 1) % 3) + B_J;
      localparam [31:0] PAIR = C[32*I+:32] * C[32*J+:32] * (I == J ? 1 : 2);
      localparam M = k < 24 ? 2 * (k / 8) : (2 * (k % 4) + 7) % 8;  // component of the first moment at address k
      localparam [31:0] MEAN = S * C[32*M+:32];
      localparam [31:0] WEIGHT = RING != 0 ? 2 : P + 2 - (SQUARE * 16384) % P;
      localparam IS_PAIR = RING != 0 ? I < 7 && J < 7 && I <= J : k < 24 && LANE < 7;
      localparam IS_MEAN = RING == 0 && k < 28 && k != 24;  // or a pair
      localparam IS_WEIGHT = k == (RING != 0 ? 58 : 24);
      localparam [31:0] WORD = IS_PAIR ? PAIR : IS_MEAN ? MEAN : IS_WEIGHT ? WEIGHT : k == 56 || k == 57 ? 1 : 0;
      localparam [31:0] REDUCED = WORD % P;
      assign words[16*k+:16] = REDUCED[15:0];
    end
  endgenerate

  assign coefficient = words[16*key+:16];
endmodule

`resetall
