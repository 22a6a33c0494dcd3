// SPDX-License-Identifier: Apache-2.0
// Place of the highest bit set, 0 to 31; 0 where none is. Combinational.
`resetall
`default_nettype none

module top_bit (
    input  wire [31:0] bits,
    output wire [ 4:0] place
);
  wire [15:0] half = place[4] ? bits[31:16] : bits[15:0];
  wire [ 7:0] quarter = place[3] ? half[15:8] : half[7:0];
  wire [ 3:0] nibble = place[2] ? quarter[7:4] : quarter[3:0];

  assign place[4] = |bits[31:16];
  assign place[3] = |half[15:8];
  assign place[2] = |quarter[7:4];
  assign place[1] = |nibble[3:2];
  assign place[0] = nibble[3] || (nibble[1] && !nibble[2]);

  wire unused = &{1'b0, nibble[0]};
endmodule

`resetall
