// SPDX-License-Identifier: Apache-2.0
// Chooses the half turn with the largest determinant, the lower number where two are equal, and judges the one chosen.
//
//   rank_deficient   det <= rounding noise (2^RANK_BITS)     ill_conditioned   2^RANK_BITS <= det < 2^ILL_BITS
// Determinants are sums in one common unit, full scale 2^43; bits below RANK_BITS are noise and not compared.
// Latency 2 clocks: the determinants in the clock of `valid`, the choice with `chosen`.
`include "relnav_words.vh"
`resetall
`default_nettype none
module turn_choice (
    input  wire               clk,
    input  wire               rst,
    input  wire               valid,
    input  wire               forbid_turns,
    input  wire signed [47:0] det_0,
    input  wire signed [47:0] det_1,
    input  wire signed [47:0] det_2,
    input  wire signed [47:0] det_3,
    output reg                chosen,
    output reg         [ 1:0] turn,
    output reg                rank_deficient,
    output reg                ill_conditioned
);
  localparam RANK = `RELNAV_RANK_BITS, ILL = `RELNAV_ILL_BITS;
  wire signed [47:RANK] top_0 = det_0[47:RANK], top_1 = det_1[47:RANK];
  wire signed [47:RANK] top_2 = det_2[47:RANK], top_3 = det_3[47:RANK];
  reg valid_1, upper_01, upper_23;
  reg signed [47:RANK] best_01, best_23;
  wire better_1 = ~forbid_turns & top_1 > top_0;
  wire better_3 = top_3 > top_2;
  wire take_23 = ~forbid_turns & best_23 > best_01;
  wire signed [47:RANK] best = take_23 ? best_23 : best_01;

  always @(posedge clk) begin
    valid_1  <= valid;
    upper_01 <= better_1;
    upper_23 <= better_3;
    best_01  <= better_1 ? top_1 : top_0;
    best_23  <= better_3 ? top_3 : top_2;
    chosen   <= valid_1;
    if (valid_1) begin
      turn            <= {take_23, take_23 ? upper_23 : upper_01};
      rank_deficient  <= best[47] | ~|best[46:RANK];
      ill_conditioned <= ~best[47] & ~|best[46:ILL] & |best[46:RANK];
    end
    if (rst) {valid_1, chosen} <= 2'b00;
  end

  wire unused = &{1'b0, det_0[RANK-1:0], det_1[RANK-1:0], det_2[RANK-1:0], det_3[RANK-1:0]};
endmodule
`resetall
