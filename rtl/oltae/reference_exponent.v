// SPDX-License-Identifier: Apache-2.0
// Common scales of the frame and the reference exponents made of them (names in sw/relnav/model/assembler.py).
//
//   moment_scale      largest exponent of the traces T        cross_scale     of the exact cross terms N (lane 0's z)
//   quaternion_scale  of the quaternion                       centroid_scale  of the centroids
// Each dot product's reference keeps its terms at or below it and its sum inside the accumulator: the constants are the widths' bounds.
// Latency: `code` in cycle 0 of a slot gives the references in cycle 2; of what was on the bus two cycles before cycle 0 or earlier.
`resetall
`default_nettype none
module reference_exponent (
    input  wire               clk,
    input  wire               start,
    // moment stream, high limbs
    input  wire               item_valid,
    input  wire        [ 4:0] item_address,
    input  wire        [47:0] item_value,
    // results on the bus
    input  wire               track_afresh,      // the bus begins a new quaternion
    input  wire               track_quaternion,
    input  wire               track_centroid,
    input  wire        [47:0] bus,
    // slot
    input  wire        [ 3:0] code,
    input  wire               probing,
    output reg  signed [13:0] common,            // of every lane
    output wire signed [13:0] lane_0,
    output reg                own,
    output reg                probing_2,
    output reg                probed_2
);
  localparam [3:0] OWN = 4'd0, MOMENT = 4'd1, CROSS = 4'd2, QUATERNION = 4'd3, UNIT = 4'd4, CENTROID = 4'd5, ROTATED = 4'd6,
      PROBED = 4'd8, NEWTON = 4'd9, IMAGE = 4'd10, FORM = 4'd11, COFACTOR = 4'd12;
  localparam signed [13:0] LOWEST = -14'sd2048;

  reg signed [13:0] moment_scale, cross_scale, quaternion_scale, centroid_scale;
  wire signed [13:0] item_exponent = {{2{item_value[46]}}, item_value[46:35]};
  reg signed [13:0] bus_exponent;  // a clock later: the bus comes late
  reg bus_zero, afresh, of_quaternion, of_centroid;
  wire of_slot = item_valid & ~item_value[47] & item_address[4:3] != 2'd3;
  wire is_trace = of_slot & item_address[2:0] == 3'd0;
  wire is_cross = of_slot & item_address[2:0] == 3'd5;

  always @(posedge clk) begin
    bus_exponent  <= {{2{bus[46]}}, bus[46:35]};
    bus_zero      <= bus[47];
    afresh        <= track_afresh;
    of_quaternion <= track_quaternion;
    of_centroid   <= track_centroid;
    // the first item is a trace
    if (start) moment_scale <= is_trace ? item_exponent : LOWEST;
    else if (is_trace && item_exponent > moment_scale) moment_scale <= item_exponent;
    if (start) cross_scale <= LOWEST;
    else if (is_cross && item_exponent > cross_scale) cross_scale <= item_exponent;
    if (start) quaternion_scale <= LOWEST;
    else if (afresh) quaternion_scale <= bus_zero ? LOWEST : bus_exponent;
    else if (of_quaternion && !bus_zero && bus_exponent > quaternion_scale) quaternion_scale <= bus_exponent;
    if (start) centroid_scale <= LOWEST;
    else if (of_centroid && !bus_zero && bus_exponent > centroid_scale) centroid_scale <= bus_exponent;
  end

  reg [3:0] code_1;
  reg probing_1, cross_2;
  reg signed [13:0] cross_of_lane_0;
  wire signed [13:0] quaternion_square = quaternion_scale <<< 1;
  always @(posedge clk) begin
    code_1    <= code;
    probing_1 <= probing;
    probing_2 <= probing_1;
    own       <= code_1 == OWN;
    probed_2  <= code_1 == PROBED & ~probing_1;
    cross_2   <= code_1 == CROSS;
    cross_of_lane_0 <= cross_scale - 14'sd33;
    case (code_1)
      MOMENT: common <= moment_scale - 14'sd32;
      CROSS: common <= moment_scale - 14'sd33;
      QUATERNION: common <= quaternion_square + 14'sd4;
      UNIT: common <= -14'sd63;
      CENTROID: common <= centroid_scale - 14'sd29;
      ROTATED: common <= quaternion_square + centroid_scale + 14'sd35;
      NEWTON: common <= moment_scale - 14'sd28;
      IMAGE: common <= moment_scale + quaternion_scale + 14'sd6;
      FORM: common <= moment_scale + quaternion_square + 14'sd42;
      COFACTOR: common <= (moment_scale <<< 1) + 14'sd8;
      default: common <= -14'sd42;  // Q15.16 with one bit for rounding
    endcase
  end
  wire unused = &{1'b0, item_value[34:0], bus[34:0]};  // only exponents matter
  assign lane_0 = cross_2 ? cross_of_lane_0 : common;
endmodule
`resetall
