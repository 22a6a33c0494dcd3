// SPDX-License-Identifier: Apache-2.0
// One float dot-product lane: register file, exact product, alignment, accumulation, normalisation.
//
//   result = sum over a run of slots of +-x*y, each product floored to the unit 2^(reference + DROP), DROP = 25, WIDE 0
//
// A value is {zero, exponent[11:0], mantissa[34:0]} = mantissa * 2^exponent. The reference exponent is given by the
// sequencer, or taken from the first enabled, non-zero term (own_reference), or the largest one met while the run was probed
// (probing, then probed_reference); the microprogram keeps every term's
// exponent at or below it, and a term above it is reported (overflow) so that Q15.16 output can saturate.
//
// slot cycle | 0 read        | 1 multiply, add exponents | 2 sum of partial products, shift count | 3 align
//            | 4 accumulate  | 5 count sign bits (or write raw) | 6 shift to 35 bits              | 7 result: write
// Latency: a result is in `result` 7 clocks after its last slot's cycle, readable by the slot 8 clocks after.
// Kept apart: flattened into the engine the mapper doubles logic on paths that it believes critical.
`include "relnav_words.vh"
`resetall
`default_nettype none
(* keep_hierarchy *)
module dot_lane #(
    parameter LANE = 0,
    parameter WIDE = 0   // 1: drops no product bits and accumulates in 76
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
    /* verilator lint_off SYMRSVDWORD */
    input  wire signed [13:0] reference,
    /* verilator lint_on SYMRSVDWORD */
    input  wire               own_reference,
    input  wire               probing,
    input  wire               probed_reference,
    // slot's result format, cycle 4 and 6
    input  wire               round_raw,       // of a raw result: the sum begins with half its unit
    input  wire               half,
    input  wire               clamp,           // a negative result becomes zero
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
    output wire signed [47:0] sum,             // cycle 5, in units of a narrow lane
    output wire               overflow         // cycle 5: a term lay above the reference
);
  localparam [1:0] NUMBER = LANE;
  localparam NARROW_DROP = `RELNAV_LANE_DROP;
  localparam DROP = WIDE != 0 ? 0 : NARROW_DROP;  // product bits below the accumulator's unit
  localparam ACC = WIDE != 0 ? `RELNAV_LANE_WIDE_ACC : `RELNAV_LANE_ACC;
  localparam SHIFT = WIDE != 0 ? 7 : 6;
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
  reg [SHIFT-1:0] closeness;  // complement of the alignment shift
  reg signed [12:0] probe;    // largest exponent of the run
  reg above_3;

  wire take_own = own_reference & live_2 & (first_2 | ~started);
  wire signed [13:0] reference_now =
      take_own ? {exponent[12], exponent} : ~first_2 | own_reference ? reference_3 :
      probed_reference ? {probe[12], probe} : reference;
  // Complement of the distance, 15 bits: the difference of a 14-bit and a 13-bit number. As a sum with the registered
  // exponent first, multiplexer, complement and adder are one LUT a bit.
  wire signed [14:0] nearness = {{2{exponent[12]}}, exponent} + {~reference_now[13], ~reference_now};
  // 48 (80) or more, or negative: only sign bits are left, as after 47 (79)
  wire far = ~&nearness[14:SHIFT] | (WIDE != 0 ? ~nearness[6] & ~&nearness[5:4] : ~|nearness[5:4]);
  localparam [6:0] FARTHEST = WIDE != 0 ? 7'd79 : 7'd47;

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
    if (far) closeness <= ~FARTHEST[SHIFT-1:0];
    else closeness <= nearness[SHIFT-1:0];
    if (probing & (first_2 | (live_2 & exponent > probe))) probe <= live_2 ? exponent : -13'sd4096;
    above_3    <= live_2 & ~nearness[14];
    live_3     <= live_2;
    first_3    <= first_2;
    negate_3   <= negate_2;
  end

  // ---- cycle 3: align; 4: accumulate (48 bits: 8 full-scale terms of 45 bits; 76: 64 of 70)
  // A negated term is its complement with a carry: -a = ~a + 1.
  reg signed [ALIGNED-1:0] aligned;
  reg signed [ACC-1:0] acc;
  reg [11:0] reference_4, reference_5;
  reg above_4, above_5;
  wire [ALIGNED-1:0] moved;
  generate
    if (WIDE != 0) begin : g_wide
      wide_aligner align (
          .value(product),
          .invert(negate_3),
          .shift(~closeness),
          .aligned(moved)
      );
    end else begin : g_narrow
      aligner align (
          .value(product[69:DROP]),
          .invert(negate_3),
          .shift(~closeness),
          .aligned(moved)
      );
    end
  endgenerate
  wire [ACC-1:0] addend = {{(ACC - ALIGNED) {aligned[ALIGNED-1]}}, aligned};
  localparam [ACC-1:0] HALF = 1 << (`RELNAV_LANE_RAW - 1 + NARROW_DROP - DROP);
  wire [ACC-1:0] base = (acc & {ACC{~first_4}}) | (HALF & {ACC{first_4 & round_raw}});
  // The carry enters through a bit below the sum. The addend stands first: its register is the carry chain's data.
  wire [ACC:0] next = {addend, negate_4} + {base, negate_4};

  always @(posedge clk) begin
    if (live_3) aligned <= moved;
    else aligned <= {ALIGNED{1'b0}};
    negate_4    <= negate_3 & live_3;
    first_4     <= first_3;
    above_4     <= above_3;
    reference_4 <= reference_3[11:0];

    acc         <= next[ACC:1];
    above_5     <= above_4 | (above_5 & ~first_4);
    reference_5 <= reference_4;
  end
  wire signed [47:0] narrow = acc[NARROW_DROP-DROP+:48];
  assign sum = narrow;

  // Raw results keep the exponent common to a block (docs/decisions/raw-results.md); the microprogram keeps them in 35 bits.
  localparam RAW = `RELNAV_LANE_RAW;
  localparam [11:0] RAW_UNIT = NARROW_DROP + RAW;
  wire [11:0] raw_exponent = reference_5 + RAW_UNIT;
  assign raw = {narrow[RAW+:35] == 35'd0, raw_exponent, narrow[RAW+:35]};
  assign overflow = above_5;

  // ---- cycles 5 and 6: top 35 bits and their exponent: reference + DROP + 13 - half - left = raw + 4 - half - left.
  // Exponents of stored values fit 12 bits: docs/decisions/exponent-range.md.
  wire [34:0] top;
  wire [5:0] left;
  wire [47:0] window;
  wire [11:0] window_exponent;
  generate
    if (WIDE != 0) begin : g_window
      // Of 76 bits the 48 that hold the 35 wanted: 28, 14 to 27, or fewer sign bits go first.
      wire low = &acc[75:47] | ~|acc[75:47];
      wire middle = &acc[75:61] | ~|acc[75:61];
      localparam [11:0] TOP_UNIT = RAW_UNIT - NARROW_DROP + 28, MIDDLE_UNIT = TOP_UNIT - 14, LOW_UNIT = TOP_UNIT - 28;
      assign window = low ? acc[47:0] : middle ? acc[61:14] : acc[75:28];
      assign window_exponent = reference_5 + (low ? LOW_UNIT : middle ? MIDDLE_UNIT : TOP_UNIT);
    end else begin : g_all
      assign window = acc;
      assign window_exponent = raw_exponent;
    end
  endgenerate
  sum_normaliser normalise (
      .clk(clk),
      .sum(window),
      .mantissa(top),
      .left(left)
  );
  reg [11:0] raw_exponent_6;
  wire [3:0] fours = left[5:2] - 4'd1;
  wire [11:0] less = {{6{~|left[5:2]}}, fours, left[1:0]};
  wire [12:0] result_exponent = {raw_exponent_6, ~half} + {~less, ~half};
  reg [34:0] mantissa;
  reg [11:0] mantissa_exponent;
  always @(posedge clk) begin
    raw_exponent_6    <= window_exponent;
    if (clamp & top[34]) mantissa <= 35'd0;
    else mantissa <= top;
    mantissa_exponent <= result_exponent[12:1];
  end
  wire zero = ~|mantissa[34:33];  // the two differ in a normalised mantissa, and -1 becomes -2^34
  assign result = {zero, mantissa_exponent, mantissa};

  wire unused = &{1'b0, result_exponent[0], next[0], product[NARROW_DROP-1:0]};
endmodule
`resetall
