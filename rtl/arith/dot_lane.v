// SPDX-License-Identifier: Apache-2.0
// One float dot-product lane: register file, exact product, alignment, accumulation, normalisation.
//
//   result = sum over a run of slots of +-x*y, each product floored to the unit 2^(reference + DROP)
//
// A value is {zero, exponent[11:0], mantissa[34:0]} = mantissa * 2^exponent. The reference exponent is given by the
// sequencer, or taken from the first enabled, non-zero term (own_reference); the microprogram keeps every term's
// exponent at or below it, and a term above it is reported (overflow) so that Q15.16 output can saturate.
//
// slot cycle | 0 read        | 1 multiply, add exponents | 2 sum of partial products, shift count | 3 align
//            | 4 accumulate  | 5 count sign bits (or write raw) | 6 shift to 35 bits              | 7 result: write
// Latency: a result is in `result` 7 clocks after its last slot's cycle, readable by the slot 8 clocks after.
`include "relnav_words.vh"
`resetall
`default_nettype none
module dot_lane #(
    parameter LANE = 0
) (
    input  wire               clk,
    // slot, cycle 0
    input  wire        [ 5:0] x_address,       // 0..31 results, 32..63 moment stream
    input  wire               x_by_lane,
    input  wire        [ 4:0] y_address,
    input  wire               y_by_lane,
    input  wire               alternate,
    input  wire               negate,
    input  wire               enable,
    input  wire               first,
    // slot's reference, cycle 2
    input  wire signed [13:0] reference,
    input  wire               own_reference,
    // slot's result format, cycle 6
    input  wire               half,
    // register writes
    input  wire               write,
    input  wire        [ 4:0] write_address,
    input  wire               write_broadcast,
    input  wire               write_raw,       // cycle 5: the sum itself in a fixed format
    input  wire        [47:0] broadcast,
    input  wire               stream_write,
    input  wire        [ 4:0] stream_address,
    input  wire        [47:0] stream_value,
    // outputs
    output wire        [47:0] result,          // cycle 7
    output wire signed [47:0] sum,             // cycle 5
    output wire               overflow         // cycle 5: a term lay above the reference
);
  localparam [1:0] NUMBER = LANE;
  localparam DROP = `RELNAV_LANE_DROP;  // product bits below the accumulator's unit
  localparam ALIGNED = 70 - DROP;

  // ---- cycle 0: register file. X holds results and stream, Y results.
  (* ram_style = "distributed" *) reg [47:0] x_results[0:31];
  (* ram_style = "distributed" *) reg [47:0] x_stream[0:31];
  (* ram_style = "distributed" *) reg [47:0] y_results[0:31];
  wire [47:0] raw;
  wire [47:0] write_value = write_broadcast ? broadcast : write_raw ? raw : result;

  always @(posedge clk) begin
    if (write) x_results[write_address] <= write_value;
    if (write) y_results[write_address] <= write_value;
    if (stream_write) x_stream[stream_address] <= stream_value;
  end

  wire [4:0] x_low = {x_address[4:2], x_address[1:0] ^ (x_by_lane ? NUMBER : 2'd0) ^ {1'b0, alternate}};
  wire [4:0] y_low = {y_address[4:2], y_address[1:0] ^ (y_by_lane ? NUMBER : 2'd0)};
  wire [47:0] x = x_address[5] ? x_stream[x_low] : x_results[x_low];
  wire [47:0] y = y_results[y_low];

  // ---- cycles 1 to 3: product beside exponent and reference
  wire signed [69:0] product;
  product_tile tile (
      .clk(clk),
      .x(x[34:0]),
      .y(y[34:0]),
      .product(product)
  );

  reg signed [11:0] x_exponent, y_exponent;
  reg signed [12:0] exponent;
  reg live_1, live_2, live_3;
  reg first_1, first_2, first_3, first_4;
  reg negate_1, negate_2, negate_3, negate_4;
  reg started;
  reg signed [13:0] reference_3;
  reg [5:0] shift;
  reg above_3;

  wire take_own = own_reference & live_2 & (first_2 | ~started);
  wire signed [13:0] reference_now =
      take_own ? {exponent[12], exponent} : first_2 & ~own_reference ? reference : reference_3;
  // 15 bits hold the difference of a 14-bit and a 13-bit number.
  wire signed [14:0] distance = {reference_now[13], reference_now} - {{2{exponent[12]}}, exponent};

  always @(posedge clk) begin
    x_exponent <= x[46:35];
    y_exponent <= y[46:35];
    live_1     <= enable & ~x[47] & ~y[47];
    first_1    <= first;
    negate_1   <= negate;

    exponent   <= {x_exponent[11], x_exponent} + {y_exponent[11], y_exponent};
    live_2     <= live_1;
    first_2    <= first_1;
    negate_2   <= negate_1;

    reference_3 <= reference_now;
    started    <= live_2 | (started & ~first_2);
    shift      <= |distance[14:6] ? 6'd63 : distance[5:0];
    above_3    <= live_2 & distance[14];
    live_3     <= live_2;
    first_3    <= first_2;
    negate_3   <= negate_2;
  end

  // ---- cycle 3: align; 4: accumulate (48 bits: 8 full-scale terms of 45 bits)
  reg signed [ALIGNED-1:0] aligned;
  reg signed [47:0] acc;
  reg signed [13:0] reference_4, reference_5, reference_6;
  reg above_4, above_5;
  wire signed [ALIGNED-1:0] kept = product[69:DROP];
  wire signed [ALIGNED-1:0] moved = kept >>> shift;  // a wire of its own: an unsigned neighbour would make the shift logical
  wire signed [47:0] addend = {{(48 - ALIGNED) {aligned[ALIGNED-1]}}, aligned};
  wire signed [47:0] base = first_4 ? 48'sd0 : acc;

  always @(posedge clk) begin
    aligned     <= live_3 ? moved : {ALIGNED{1'b0}};
    first_4     <= first_3;
    negate_4    <= negate_3;
    above_4     <= above_3;
    reference_4 <= reference_3;

    acc         <= negate_4 ? base - addend : base + addend;
    above_5     <= above_4 | (above_5 & ~first_4);
    reference_5 <= reference_4;
  end
  assign sum = acc;

  // Raw results keep the exponent common to a block (docs/decisions/raw-results.md); the microprogram keeps them in 35 bits.
  localparam RAW = `RELNAV_LANE_RAW;
  wire signed [13:0] raw_exponent = reference_5 + $signed(14'd`RELNAV_LANE_DROP + 14'd`RELNAV_LANE_RAW);
  assign raw = {acc[RAW+:35] == 35'd0, raw_exponent[11:0], acc[RAW+:35]};
  assign overflow = above_5;

  // ---- cycle 5: redundant sign bits of the sum
  wire [5:0] redundant;
  sign_count counter (
      .value(acc),
      .count(redundant)
  );
  reg signed [47:0] acc_6;
  reg [5:0] left;
  always @(posedge clk) begin
    acc_6       <= acc;
    left        <= redundant;
    reference_6 <= reference_5;
  end

  // ---- cycle 6: top 35 bits. Exponents of stored values fit 12 bits: docs/decisions/exponent-range.md.
  wire signed [47:0] shifted = acc_6 <<< left;
  wire signed [13:0] result_exponent = reference_6 + $signed(14'd`RELNAV_LANE_DROP + 14'd13 - {13'd0, half}) - $signed({8'd0, left});
  reg [34:0] mantissa;
  reg [11:0] mantissa_exponent;
  always @(posedge clk) begin
    mantissa          <= shifted[47:13];
    mantissa_exponent <= result_exponent[11:0];
  end
  wire zero = mantissa == 35'd0;
  assign result = {zero, mantissa_exponent, mantissa};

  wire unused = &{1'b0, result_exponent[13:12], raw_exponent[13:12], shifted[12:0], product[DROP-1:0]};
endmodule
`resetall
