// SPDX-License-Identifier: Apache-2.0
// Feeds the integers that are not pairs into the moment stream, in the nine clocks after the last pair:
//   W, m_a x y z, m_b x y z, n (points whose weight is not 0), variance       m = m' + W 2^15 undoes the shift of the inputs (see gram_array)
// Each goes with its stream address and the exponent of its unit: the inputs' binary point for m, 0 for counts, the binary32's own
// for the variance (denormals count as zero). Values are prepared a clock ahead: one multiplexer, one adder.
//
// clock      0 pair_last | 1 W | 2 m_ax | 3 m_ay | 4 m_az | 5 m_bx | 6 m_by | 7 m_bz | 8 n | 9 variance
`include "relnav_words.vh"
`resetall
`default_nettype none
module value_feeder #(
    parameter WEIGHTED = 1
) (
    input  wire                                     clk,
    input  wire                                     rst,
    input  wire                                     clear,
    input  wire                                     pair_last,
    input  wire        [   `RELNAV_W(WEIGHTED)-1:0] weight_sum,
    input  wire        [         `RELNAV_COUNT-1:0] used_count,
    input  wire        [6*`RELNAV_M1(WEIGHTED)-1:0] first_moments,   // {b_z, a_z, b_y, a_y, b_x, a_x}
    input  wire signed [                      11:0] moment_scale,    // -FRAC
    input  wire        [                      31:0] variance,
    output wire                                     value_valid,
    output reg         [                       4:0] value_address,
    output reg signed  [  `RELNAV_M1(WEIGHTED)-1:0] value,
    output reg signed  [                      11:0] value_scale
);
  localparam BITS = `RELNAV_M1(WEIGHTED);
  localparam [4:0] ADDRESS_W = 5'd24, ADDRESS_COUNT = 5'd28, ADDRESS_VARIANCE = 5'd29;

  reg [3:0] step;  // 0 idle, 1 to 9 the clock's value
  wire [3:0] next = pair_last ? 4'd1 : step == 4'd0 || step == 4'd9 ? 4'd0 : step + 4'd1;
  assign value_valid = step != 4'd0;

  // component of step 2 to 7: a x y z = 0 2 4, b x y z = 1 3 5; looked up a clock before it is summed
  reg [2:0] component;
  wire [BITS-1:0] chosen;
  reg [BITS-1:0] moment;
  component_select #(
      .BITS(BITS)
  ) select (
      .components(first_moments),
      .index(component),
      .chosen(chosen)
  );

  wire denormal = variance[30:23] == 8'd0;
  wire is_moment = next >= 4'd2 && next <= 4'd7;

  always @(posedge clk) begin
    step <= next;
    if (next == 4'd0) component <= 3'd0;
    else component <= next == 4'd1 ? 3'd2 : next == 4'd2 ? 3'd4 : next == 4'd3 ? 3'd1 : component + 3'd2;
    moment <= chosen;

    if (is_moment) value <= moment + {{(BITS - 15 - `RELNAV_W(WEIGHTED)) {1'b0}}, weight_sum, 15'd0};
    else if (next == 4'd1) value <= {{(BITS - `RELNAV_W(WEIGHTED)) {1'b0}}, weight_sum};
    else if (next == 4'd8) value <= {{(BITS - `RELNAV_COUNT) {1'b0}}, used_count};
    else value <= denormal ? {BITS{1'b0}} : {{(BITS - 24) {1'b0}}, 1'b1, variance[22:0]};
    value_scale <= is_moment ? moment_scale : next == 4'd9 ? {4'd0, variance[30:23]} - 12'd150 : 12'd0;
    case (next)
      4'd1: value_address <= ADDRESS_W;
      4'd2: value_address <= 5'd7;
      4'd3: value_address <= 5'd15;
      4'd4: value_address <= 5'd23;
      4'd8: value_address <= ADDRESS_COUNT;
      4'd9: value_address <= ADDRESS_VARIANCE;
      default: value_address <= ADDRESS_W + {2'd0, next[2:0]} - 5'd4;
    endcase
    if (rst || clear) step <= 4'd0;
  end

  wire unused = variance[31];  // a variance is positive
endmodule
`resetall
