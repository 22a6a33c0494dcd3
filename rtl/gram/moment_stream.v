// SPDX-License-Identifier: Apache-2.0
// The front end behind the Gram array: pairs of raw moments in, lane floats out, one a cycle.
//   pair  -> centring -> butterfly -> normaliser -> item       value -> (delay) -> butterfly, as it is
// Items of one slot, by lane: 0 T_i = Sa_ii + Sb_ii, 1 E_i = Sa_ii - Sb_ii, 2 B_ii, 3 F_ij = Sa_ij + Sb_ij, 4 H_ij = Sa_ij - Sb_ij,
// 5 P_ij = B_ij + B_ji, 6 N_ij = B_ij - B_ji, all of the centred moments W G - m_i m_j.
//   in : pair_* as gram_array gives them; low, pair_scale, value_* with the item (see normaliser.v)
//        the lane is the lowest three bits of pair_tag; the other bits, and all of value_tag, are the user's
//   out: item_*, with the tag that went in
// Latency: pair or value to item 10 (weight sums up to 17 bits) or 11 cycles.
//   Items leave in the order in which they came. Where a gap parts lanes 0 and 1 (3 and 4, 5 and 6) of a slot, the first of the
//   two waits for the other one and leaves a cycle before it.
// pair_valid and value_valid never coincide, and no value comes between those lanes.
`resetall
`default_nettype none

module moment_stream #(
    parameter WEIGHT_SUM_BITS = 16,
    parameter M1_BITS         = 48,
    parameter M2_BITS         = 80,
    parameter CENTRED_BITS    = 98,
    parameter VALUE_BITS      = 98,  // at most CENTRED_BITS; no more than the values need spares delay registers
    parameter TAG_BITS        = 6
) (
    input wire clk,
    input wire rst,
    // emit the low limbs (mantissa bits 35..68); stable while a pass drains
    input wire low,
    // pairs
    input wire pair_valid,
    input wire [TAG_BITS-1:0] pair_tag,
    input wire [WEIGHT_SUM_BITS-1:0] weight_sum,
    input wire signed [M2_BITS-1:0] pair_moment,
    input wire signed [M1_BITS-1:0] pair_first_i,
    input wire signed [M1_BITS-1:0] pair_first_j,
    input wire signed [11:0] pair_scale,
    // other integers
    input wire value_valid,
    input wire [TAG_BITS-1:0] value_tag,
    input wire signed [VALUE_BITS-1:0] value,
    input wire signed [11:0] value_scale,
    // lane floats
    output wire item_valid,
    output wire [TAG_BITS-1:0] item_tag,
    output wire signed [34:0] item_mant,
    output wire signed [11:0] item_exp,
    output wire item_zero
);
  localparam LOW = WEIGHT_SUM_BITS <= 17 ? 48 : 64;
  localparam HIGH = CENTRED_BITS - LOW;
  localparam CENTRING_LATENCY = WEIGHT_SUM_BITS <= 17 ? 4 : 5;
  localparam SIDE = TAG_BITS + 13;  // low, scale, tag travel together

  // ---- pairs and values never coincide: one delay line serves both
  wire is_second = pair_tag[2:0] == 3'd1 || pair_tag[2:0] == 3'd4 || pair_tag[2:0] == 3'd6;
  wire is_first = pair_tag[2:0] == 3'd0 || pair_tag[2:0] == 3'd3 || pair_tag[2:0] == 3'd5;
  wire [SIDE-1:0] side = {low, value_valid ? {value_scale, value_tag} : {pair_scale, pair_tag}};
  wire [3:0] kind = {
    value_valid, pair_valid && is_second, pair_valid && is_first, pair_valid && !is_first && !is_second
  };
  wire centred_valid;
  wire [SIDE-1:0] centred_side;
  wire [3:0] centred_kind;
  wire [LOW-1:0] centred_low;
  wire [HIGH-1:0] centred_high;

  centring #(
      .WEIGHT_SUM_BITS(WEIGHT_SUM_BITS),
      .M1_BITS(M1_BITS),
      .M2_BITS(M2_BITS),
      .CENTRED_BITS(CENTRED_BITS),
      .LOW_BITS(LOW),
      .LATENCY(CENTRING_LATENCY),
      .TAG_BITS(SIDE + 4)
  ) u_centring (
      .clk(clk),
      .rst(rst),
      .in_valid(pair_valid || value_valid),
      .in_tag({kind, side}),
      .weight_sum(weight_sum),
      .moment(pair_moment),
      .first_i(pair_first_i),
      .first_j(pair_first_j),
      .out_valid(centred_valid),
      .out_tag({centred_kind, centred_side}),
      .centred_low(centred_low),
      .centred_high(centred_high)
  );

  // ---- the value waits as long as a pair's low part; its high part is a cycle later too
  reg [CENTRING_LATENCY*VALUE_BITS-1:0] value_line;
  wire [VALUE_BITS-1:0] value_late = value_line[CENTRING_LATENCY*VALUE_BITS-1-:VALUE_BITS];
  wire [CENTRED_BITS-1:0] value_wide;
  reg [HIGH-1:0] value_high;
  always @(posedge clk) begin
    value_line <= {value_line[(CENTRING_LATENCY-1)*VALUE_BITS-1:0], value};
    value_high <= value_wide[CENTRED_BITS-1:LOW];
  end
  generate
    if (VALUE_BITS < CENTRED_BITS) begin : g_extend
      assign value_wide = {{(CENTRED_BITS - VALUE_BITS) {value_late[VALUE_BITS-1]}}, value_late};
    end else begin : g_whole
      assign value_wide = value_late;
    end
  endgenerate

  wire mixed_valid;
  wire [SIDE-1:0] mixed_side;
  wire signed [CENTRED_BITS-1:0] mixed;

  butterfly #(
      .LOW_BITS (LOW),
      .HIGH_BITS(HIGH),
      .TAG_BITS (SIDE)
  ) u_butterfly (
      .clk(clk),
      .rst(rst),
      .in_first(centred_valid && centred_kind[1]),
      .in_second(centred_valid && centred_kind[2]),
      .in_plain(centred_valid && centred_kind[0]),
      .in_value(centred_valid && centred_kind[3]),
      .in_tag(centred_side),
      .in_low(centred_low),
      .in_high(centred_high),
      .value_low(value_wide[LOW-1:0]),
      .value_high(value_high),
      .out_valid(mixed_valid),
      .out_tag(mixed_side),
      .out_value(mixed)
  );

  normaliser #(
      .BITS(CENTRED_BITS),
      .TAG_BITS(TAG_BITS)
  ) u_normaliser (
      .clk(clk),
      .rst(rst),
      .in_valid(mixed_valid),
      .value(mixed),
      .low(mixed_side[SIDE-1]),
      .scale(mixed_side[SIDE-2-:12]),
      .in_tag(mixed_side[TAG_BITS-1:0]),
      .out_valid(item_valid),
      .mant(item_mant),
      .exp(item_exp),
      .zero(item_zero),
      .out_tag(item_tag)
  );
endmodule

`resetall
