// SPDX-License-Identifier: Apache-2.0
// Second central moment of one pair of components: centred = weight_sum * moment - first_i * first_j, exactly.
// (W^2 times the weighted covariance; integers, so points far from the origin cost no digits.)
//   in : one pair a cycle, no back-pressure. weight_sum unsigned, moment, first_i, first_j signed, tag
//   out: out_valid and out_tag, one cycle later centred_low, one cycle later centred_high
// Latency 4 to the low part (48 bits) for weight sums up to 17 bits, 5 (64 bits) for weight sums up to 32 bits.
// Width: |weight_sum moment| < 2^(W+M2-1) and |first first| <= 2^(2 M1-2) <= 2^(W+M2-2), so |centred| < 2^(W+M2):
// it and the sum of two of them fit CENTRED_BITS = M2_BITS + WEIGHT_SUM_BITS + 2.
`resetall
`default_nettype none

module centring #(
    parameter WEIGHT_SUM_BITS = 16,
    parameter M1_BITS         = 48,
    parameter M2_BITS         = 80,
    parameter CENTRED_BITS    = 98,
    parameter LOW_BITS        = 48,  // 48 where WEIGHT_SUM_BITS <= 17, else 64
    parameter LATENCY         = 4,   // of the low part: 4 where WEIGHT_SUM_BITS <= 17, else 5
    parameter TAG_BITS        = 6
) (
    input wire clk,
    input wire rst,
    // a pair
    input wire in_valid,
    input wire [TAG_BITS-1:0] in_tag,
    input wire [WEIGHT_SUM_BITS-1:0] weight_sum,
    input wire signed [M2_BITS-1:0] moment,
    input wire signed [M1_BITS-1:0] first_i,
    input wire signed [M1_BITS-1:0] first_j,
    // its central moment, a cycle after out_valid and another one
    output wire out_valid,
    output wire [TAG_BITS-1:0] out_tag,
    output wire [LOW_BITS-1:0] centred_low,
    output wire [CENTRED_BITS-LOW_BITS-1:0] centred_high
);
  generate
    if (WEIGHT_SUM_BITS <= 17) begin : g_narrow
      centring_narrow #(
          .WEIGHT_SUM_BITS(WEIGHT_SUM_BITS),
          .M1_BITS(M1_BITS),
          .M2_BITS(M2_BITS),
          .CENTRED_BITS(CENTRED_BITS)
      ) u_centring (
          .clk(clk),
          .weight_sum(weight_sum),
          .moment(moment),
          .first_i(first_i),
          .first_j(first_j),
          .centred_low(centred_low),
          .centred_high(centred_high)
      );
    end else begin : g_wide
      centring_wide #(
          .WEIGHT_SUM_BITS(WEIGHT_SUM_BITS),
          .M1_BITS(M1_BITS),
          .M2_BITS(M2_BITS),
          .CENTRED_BITS(CENTRED_BITS)
      ) u_centring (
          .clk(clk),
          .weight_sum(weight_sum),
          .moment(moment),
          .first_i(first_i),
          .first_j(first_j),
          .centred_low(centred_low),
          .centred_high(centred_high)
      );
    end
    if (LOW_BITS != (WEIGHT_SUM_BITS <= 17 ? 48 : 64) || LATENCY != (WEIGHT_SUM_BITS <= 17 ? 4 : 5)) begin : g_check
      centring_LOW_BITS_or_LATENCY_does_not_match_WEIGHT_SUM_BITS u_error ();
    end
  endgenerate

  localparam AHEAD = LATENCY - 1;
  reg [AHEAD-1:0] valid;
  reg [AHEAD*TAG_BITS-1:0] tag;
  always @(posedge clk) begin
    valid <= {valid[AHEAD-2:0], in_valid};
    tag   <= {tag[(AHEAD-1)*TAG_BITS-1:0], in_tag};
    if (rst) valid <= {AHEAD{1'b0}};
  end
  assign out_valid = valid[AHEAD-1];
  assign out_tag   = tag[AHEAD*TAG_BITS-1-:TAG_BITS];
endmodule

`resetall
