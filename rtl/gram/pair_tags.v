// SPDX-License-Identifier: Apache-2.0
// What goes with a moment through recombine's three clocks: valid, slot, lane, last, and the first moments of its two components.
`resetall
`default_nettype none

module pair_tags #(
    parameter M1_BITS = 64
) (
    input  wire                       clk,
    input  wire                       rst,
    input  wire                       clear,
    input  wire                       reading,
    input  wire                       reading_last,
    input  wire        [         1:0] slot,
    input  wire        [         2:0] lane,
    input  wire        [6*M1_BITS-1:0] first_moments,
    output reg                        pair_valid,
    output reg         [         1:0] pair_slot,
    output reg         [         2:0] pair_lane,
    output reg                        pair_last,
    output reg signed  [ M1_BITS-1:0] pair_first_i,
    output reg signed  [ M1_BITS-1:0] pair_first_j
);
  reg valid_1, valid_2, last_1, last_2;
  reg [1:0] slot_1, slot_2;
  reg [2:0] lane_1, lane_2;
  wire [2:0] i, j;
  reg [2:0] i_2, j_2;
  wire [M1_BITS-1:0] first_i, first_j;

  pair_components u_components (
      .slot  (slot_1),
      .lane  (lane_1),
      .first (i),
      .second(j)
  );

  component_select #(
      .BITS(M1_BITS)
  ) u_first_i (
      .components(first_moments),
      .index(i_2),
      .chosen(first_i)
  );

  component_select #(
      .BITS(M1_BITS)
  ) u_first_j (
      .components(first_moments),
      .index(j_2),
      .chosen(first_j)
  );

  always @(posedge clk) begin
    {slot_1, lane_1} <= {slot, lane};
    {slot_2, lane_2} <= {slot_1, lane_1};
    {i_2, j_2} <= {i, j};
    {pair_slot, pair_lane} <= {slot_2, lane_2};
    {last_1, last_2, pair_last} <= {reading_last, last_1, last_2};
    pair_first_i <= first_i;
    pair_first_j <= first_j;
    {valid_1, valid_2, pair_valid} <= {reading, valid_1, valid_2};
    if (rst || clear) {valid_1, valid_2, pair_valid, last_1, last_2, pair_last} <= 6'b0;
  end
endmodule

`resetall
