// SPDX-License-Identifier: Apache-2.0
// Lane value to IEEE-754 binary32, round to nearest, ties to even.
//
// The mantissa is normalised (|m| in [2^33, 2^34]) or zero. Above the largest finite number: infinity;
// below 2^-126: signed zero (no denormals). Latency 2 clocks.
//
// cycle | 0 value | 1 |m| | 2 rounded and packed
`resetall
`default_nettype none
module to_binary32 (
    input  wire        clk,
    input  wire [47:0] value,
    output reg  [31:0] binary32
);
  reg zero, negative;
  reg [34:0] magnitude;
  reg signed [12:0] biased;

  // magnitude[33:10] are the 24 bits kept; 2^34 itself keeps 2^24 and needs no rounding.
  wire round_up = magnitude[9] & (|magnitude[8:0] | magnitude[10]);
  wire [24:0] rounded = magnitude[34:10] + {24'd0, round_up};
  // A carry out of the 24 bits leaves zeros below: only the exponent moves.
  wire signed [12:0] exponent = biased + {12'd0, rounded[24]};
  wire underflow = exponent[12] | ~|exponent[11:0];
  wire overflow = ~exponent[12] & (|exponent[11:8] | &exponent[7:0]);

  always @(posedge clk) begin
    zero      <= value[47];
    negative  <= value[34];
    biased    <= $signed({value[46], value[46:35]}) + 13'sd160;  // 33 + 127
    magnitude <= (value[34:0] ^ {35{value[34]}}) + {34'd0, value[34]};  // one LUT a bit

    binary32[31] <= negative & ~zero;
    binary32[30:23] <= (exponent[7:0] | {8{overflow}}) & {8{~zero & ~underflow}};
    // constants for a whole field come from the flip-flops' synchronous reset
    if (zero | underflow | overflow) binary32[22:0] <= 23'd0;
    else binary32[22:0] <= rounded[22:0];
  end

  wire unused = &{1'b0, rounded[23]};  // the leading one is not stored
endmodule
`resetall
