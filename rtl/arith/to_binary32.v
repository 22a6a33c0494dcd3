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
  // exponent without and with a carry out of rounding, and whether binary32 has it: {under, over, biased}
  reg [9:0] plain, carried;

  // magnitude[33:10] are the 24 bits kept; 2^34 itself keeps 2^24 and needs no rounding.
  wire round_up = magnitude[9] & (|magnitude[8:0] | magnitude[10]);
  wire [24:0] rounded = magnitude[34:10] + {24'd0, round_up};
  // A carry out of the 24 bits leaves zeros below: only the exponent moves.
  wire underflow, overflow;
  wire [7:0] exponent;
  assign {underflow, overflow, exponent} = rounded[24] ? carried : plain;
  wire signed [11:0] value_exponent = value[46:35];

  always @(posedge clk) begin
    zero      <= value[47];
    negative  <= value[34];
    plain     <= {value_exponent < -12'sd159, value_exponent > 12'sd94, value[42:35] + 8'd160};  // 160 = 33 + 127
    carried   <= {value_exponent < -12'sd160, value_exponent > 12'sd93, value[42:35] + 8'd161};
    magnitude <= (value[34:0] ^ {35{value[34]}}) + {34'd0, value[34]};  // one LUT a bit

    binary32[31] <= negative & ~zero;
    binary32[30:23] <= (exponent | {8{overflow}}) & {8{~zero & ~underflow}};
    // constants for a whole field come from the flip-flops' synchronous reset
    if (zero | underflow | overflow) binary32[22:0] <= 23'd0;
    else binary32[22:0] <= rounded[22:0];
  end

  wire unused = &{1'b0, rounded[23]};  // the leading one is not stored
endmodule
`resetall
