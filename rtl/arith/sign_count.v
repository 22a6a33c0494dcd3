// SPDX-License-Identifier: Apache-2.0
// Number of redundant sign bits of a 48-bit signed value: 0 for a full-scale value, 47 for 0 and -1.
//
// Combinational, a tree of halvings: a 48-bit value has 47 places where neighbours differ. `edges` ends in ones, which
// stop the count at 47; the last bit of each half cannot matter and is left out.
`resetall
`default_nettype none
module sign_count (
    input  wire [47:0] value,
    output wire [ 5:0] count
);
  wire [62:0] edges = {value[47:1] ^ value[46:0], 16'hffff};
  wire in_32 = ~|edges[62:31];
  wire [30:0] top_32 = in_32 ? edges[30:0] : edges[62:32];
  wire in_16 = ~|top_32[30:15];
  wire [14:0] top_16 = in_16 ? top_32[14:0] : top_32[30:16];
  wire in_8 = ~|top_16[14:7];
  wire [6:0] top_8 = in_8 ? top_16[6:0] : top_16[14:8];
  wire in_4 = ~|top_8[6:3];
  wire [2:0] top_4 = in_4 ? top_8[2:0] : top_8[6:4];
  wire in_2 = ~|top_4[2:1];
  wire in_1 = in_2 ? ~top_4[0] : ~top_4[2];
  assign count = {in_32, in_16, in_8, in_4, in_2, in_1};
endmodule
`resetall
