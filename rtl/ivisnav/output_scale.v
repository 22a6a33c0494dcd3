// SPDX-License-Identifier: Apache-2.0
// binary32 times a power of two, by its exponent alone: result = value 2^scale, above the largest number infinity, below 2^-126 zero,
// of the value's sign. Infinity and NaN stay, denormals count as zero. Latency 1.
`resetall
`default_nettype none
module output_scale (
    input  wire               clk,
    input  wire        [31:0] value,
    input  wire signed [11:0] scale,
    output reg         [31:0] result
);
  wire zero = value[30:23] == 8'd0;
  wire special = &value[30:23];
  wire signed [12:0] exponent = $signed({5'd0, value[30:23]}) + $signed({scale[11], scale});
  wire under = zero | (~special & exponent < 13'sd1);
  wire over = ~special & exponent > 13'sd254;

  always @(posedge clk) begin
    result[31] <= value[31];
    if (under) result[30:0] <= 31'd0;
    else if (over) result[30:0] <= {8'hFF, 23'd0};
    else if (special) result[30:0] <= value[30:0];
    else result[30:0] <= {exponent[7:0], value[22:0]};
  end
endmodule
`resetall
