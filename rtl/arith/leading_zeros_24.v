// SPDX-License-Identifier: Apache-2.0
// Leading zeros of 24 bits, 0..23; of none set, 24 or more. Combinational.
`resetall
`default_nettype none
module leading_zeros_24 (
    input  wire [23:0] bits,
    output wire [ 4:0] count
);
  wire [7:0] high = bits[23:16];
  wire [7:0] middle = bits[15:8];
  wire [7:1] low = bits[7:1];
  wire in_high = |high;
  wire in_middle = |middle;
  wire [7:1] chosen = in_high ? high[7:1] : in_middle ? middle[7:1] : low;
  assign count[4] = ~in_high & ~in_middle;
  assign count[3] = ~in_high & in_middle;
  assign count[2] = ~|chosen[7:4];
  wire [3:1] nibble = count[2] ? chosen[3:1] : chosen[7:5];
  assign count[1] = ~|nibble[3:2];
  assign count[0] = ~nibble[3] & (nibble[2] | ~nibble[1]);

  wire unused = &{1'b0, bits[0]};
endmodule
`resetall
