// SPDX-License-Identifier: Apache-2.0
// Watches the engine's bus and says whether the rates can be believed.
//
//   PIVOT       negative, not finite, zero or 2^-22 of the diagonal element it came from: rank_deficient
//   DIAGONAL    elements of the inverse's diagonal, lane 5 first: inverse_place is the largest one's
//   FIRST_STEP, STEP, RATE    the largest; stalled unless  step^2 / first step <= 2^-18.5 rate  (what a refinement leaves)
//   CONDITION   cond(H)^2, kept; excessive above 2000^2
//
// Sizes are compared by their words without sign and the lowest 20 bits: a logarithm in eighths of an octave.
// Latency 2: what is on the bus in cycle 0 counts at the outputs in cycle 2. A NaN's word lies above all numbers.
`include "relnav_words.vh"
`resetall
`default_nettype none
module rates_monitor (
    input  wire        clk,
    input  wire        clear,            // before a frame
    // diagonal of the moments, as they come
    input  wire        diagonal_valid,
    input  wire [ 2:0] diagonal_place,
    input  wire [31:0] diagonal,
    output reg  [ 2:0] moment_place,     // of the largest, from the next clock on
    // bus
    input  wire [ 2:0] track,
    input  wire [ 2:0] lane,
    input  wire [31:0] bus,
    output reg  [ 2:0] inverse_place,
    output reg         rank_deficient,
    output wire        stalled,
    output wire        excessive,
    output reg  [31:0] condition
);
  // codes of sw/relnav/model/rates_program.py
  localparam [2:0] PIVOT = 3'd1, DIAGONAL = 3'd2, FIRST_STEP = 3'd3, STEP = 3'd4, RATE = 3'd5, CONDITION = 3'd6;
  localparam [8:0] PIVOT_BITS = `RELNAV_PIVOT_BITS;
  localparam [2:0] LAST_LANE = 3'd5;
  localparam [30:0] CONDITION_LIMIT = `RELNAV_CONDITION_LIMIT;
  localparam signed [13:0] CONVERGED = -`RELNAV_CONVERGED;
  localparam [10:0] NOT_FINITE = {8'hFF, 3'd0};

  // ---- moments
  reg [30:0] largest_moment;
  reg [ 7:0] exponents[0:7];
  always @(posedge clk) begin
    if (diagonal_valid) begin
      exponents[diagonal_place] <= diagonal[30:23];
      if (diagonal_place == 3'd0 || diagonal[30:0] > largest_moment) begin
        largest_moment <= diagonal[30:0];
        moment_place   <= diagonal_place;
      end
    end
  end

  // ---- bus
  reg [2:0] track_1, lane_1;
  reg [31:0] bus_1;
  always @(posedge clk) begin
    track_1 <= track;
    lane_1  <= lane;
    bus_1   <= bus;
  end

  wire [7:0] exponent = bus_1[30:23];
  wire [7:0] first_exponent = exponents[lane_1];
  wire noise = bus_1[31] || exponent == 8'd0 || &exponent || {1'b0, exponent} + PIVOT_BITS < {1'b0, first_exponent};
  wire [10:0] size = bus_1[30:20];
  reg [30:0] largest_inverse;
  reg [10:0] first_step, step, rate;
  always @(posedge clk) begin
    if (track_1 == PIVOT && noise) rank_deficient <= 1'b1;
    if (track_1 == DIAGONAL && (lane_1 == LAST_LANE || bus_1[30:0] > largest_inverse)) begin
      largest_inverse <= bus_1[30:0];
      inverse_place   <= lane_1;
    end
    if (track_1 == FIRST_STEP && size > first_step) first_step <= size;
    if (track_1 == STEP && size > step) step <= size;
    if (track_1 == RATE && size > rate) rate <= size;
    if (track_1 == CONDITION) condition <= bus_1;
    if (clear) begin
      rank_deficient <= 1'b0;
      first_step     <= 11'd0;
      step           <= 11'd0;
      rate           <= 11'd0;
    end
  end

  wire unused = diagonal[31];  // sums of squares

  wire finite = first_step < NOT_FINITE && step < NOT_FINITE && rate < NOT_FINITE;
  wire signed [13:0] left_over = $signed({2'd0, step, 1'b0}) - $signed({3'd0, first_step}) - $signed({3'd0, rate});
  assign stalled   = !finite || (step != 11'd0 && left_over > CONVERGED);
  assign excessive = condition[31] || condition[30:0] > CONDITION_LIMIT;
endmodule
`resetall
