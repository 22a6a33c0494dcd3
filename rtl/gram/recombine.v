// SPDX-License-Identifier: Apache-2.0
// A moment from its limb sums, one a clock, latency 3:
//   moment = top 2^48 + high 2^32 + (both - high - low) 2^16 + low          (top only where WEIGHTED = 1)
// clock 1: difference = both - high,  fraction = floor(low / 2^16) - low                       48 bits, modulo 2^48
// clock 2: middle = difference + fraction;   upper = top + floor(high / 2^16)
// clock 3: moment = {upper, high[15:0], 32'b0} + middle 2^16 + low[15:0]  (lean: a 48-bit sum; WEIGHTED: 64 bits)
// middle's true value: |sum of the two cross products| <= 65535 * 2 * 2^30, |floor(low / 2^16)| <= 2^30 + 1: together below 2^47 (2^47 =
// 65536 * 2^31), so the 48-bit result is exact although `both` may have wrapped.
`resetall
`default_nettype none

module recombine #(
    parameter WEIGHTED = 1,
    parameter M2_BITS  = 96  // 80 where WEIGHTED = 0
) (
    input  wire                      clk,
    input  wire                      with_top,  // 0: top is not valid and counts as 0
    input  wire signed [       47:0] high,
    input  wire signed [       47:0] low,
    input  wire signed [       47:0] both,
    input  wire signed [       47:0] top,
    output reg signed  [M2_BITS-1:0] moment
);
  reg signed [47:0] difference, fraction, middle;
  reg signed [47:0] high_1;
  reg [15:0] low_1, low_2;

  always @(posedge clk) begin
    difference <= both - high;
    fraction   <= (low >>> 16) - low;
    high_1     <= high;
    low_1      <= low[15:0];

    middle     <= difference + fraction;
    low_2      <= low_1;
  end

  generate
    if (WEIGHTED != 0) begin : g_top
      reg signed [47:0] top_1, upper;
      reg [15:0] high_2;
      wire signed [63:0] total = $signed({upper, high_2}) + $signed({{32{middle[47]}}, middle[47:16]});
      always @(posedge clk) begin
        if (!with_top) top_1 <= 0;
        else top_1 <= top;
        upper  <= top_1 + (high_1 >>> 16);
        high_2 <= high_1[15:0];
        moment <= {total, middle[15:0], low_2};
      end
    end else begin : g_plain
      reg signed [47:0] high_2;
      wire signed [47:0] total = high_2 + (middle >>> 16);
      always @(posedge clk) begin
        high_2 <= high_1;
        moment <= {total, middle[15:0], low_2};
      end
      /* verilator lint_off UNUSEDSIGNAL */
      wire unused = &{with_top, top};
      /* verilator lint_on UNUSEDSIGNAL */
    end
  endgenerate
endmodule

`resetall
