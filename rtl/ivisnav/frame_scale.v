// SPDX-License-Identifier: Apache-2.0
// Powers of two that bring a frame's moments below 1 and its results back. With |h| < 2^h_bits, |y| < 2^y_bits and weights summing to
// less than 2^weight_bits, a moment of two components is below 2^(weight_bits + their sizes).
//
//   moment scales   hh = -(weight_bits + 2 h),   hy = -(weight_bits + h + y),   yy = -(weight_bits + 2 y)
//   right           h - y: b's unit over A's, -33 to 30
//   back            rate frac_h - frac_y - right,   rss -yy - 2 frac_y,   covariance 2 frac_h + hh (+ rss where estimated)
//
// y counts as two bits at least: `right` then fits the residual's shifter. Latency 1 for the moments'
// scales and `right`, 2 for rate_back and rss_back, 3 for covariance_back.
`resetall
`default_nettype none
module frame_scale (
    input  wire               clk,
    input  wire        [ 5:0] h_bits,
    input  wire        [ 5:0] y_bits,
    input  wire        [ 5:0] weight_bits,
    input  wire signed [ 7:0] frac_h,
    input  wire signed [ 7:0] frac_y,
    input  wire               estimated,      // the covariance is scaled by the residuals
    output reg signed  [11:0] hh,
    output reg signed  [11:0] hy,
    output reg signed  [11:0] yy,
    output reg signed  [ 6:0] right,
    output reg signed  [11:0] rate_back,
    output reg signed  [11:0] rss_back,
    output reg signed  [11:0] covariance_back
);
  wire [5:0] y_size = y_bits < 6'd2 ? 6'd2 : y_bits;
  wire [7:0] h_and_h = {1'b0, h_bits, 1'b0};
  wire [7:0] h_and_y = {2'd0, h_bits} + {2'd0, y_size};
  wire [7:0] y_and_y = {1'b0, y_size, 1'b0};
  wire signed [11:0] h_places = {{4{frac_h[7]}}, frac_h};
  wire signed [11:0] y_places = {{4{frac_y[7]}}, frac_y};

  always @(posedge clk) begin
    hh              <= -{6'd0, weight_bits} - {4'd0, h_and_h};
    hy              <= -{6'd0, weight_bits} - {4'd0, h_and_y};
    yy              <= -{6'd0, weight_bits} - {4'd0, y_and_y};
    right           <= {1'b0, h_bits} - {1'b0, y_size};
    rate_back       <= h_places - y_places - {{5{right[6]}}, right};
    rss_back        <= -yy - (y_places <<< 1);
    covariance_back <= (h_places <<< 1) + hh + (estimated ? rss_back : 12'sd0);
  end
endmodule
`resetall
