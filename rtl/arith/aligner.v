// SPDX-License-Identifier: Apache-2.0
// Arithmetic right shift of a product, ones' complemented on demand. Combinational.
//
//   aligned = floor(value / 2^shift), or -1 - floor(value / 2^shift) with `invert`; shift 0..47
//
// Three stages of one 6-input LUT a bit: 16s with the complement (a shift of 48 does not exist, which leaves an input
// for it), 4s, 1s. The complement of a floor is the floor of the complement: it may come first.
`resetall
`default_nettype none
module aligner (
    input  wire [44:0] value,
    input  wire        invert,
    input  wire [ 5:0] shift,
    output wire [44:0] aligned
);
  wire sign = value[44] ^ invert;
  wire [44:0] by_16, by_4;

  mux3_invert #(
      .WIDTH(45)
  ) sixteens (
      .select(shift[5:4]),
      .invert(invert),
      .in_0(value),
      .in_1({{16{value[44]}}, value[44:16]}),
      .in_2({{32{value[44]}}, value[44:32]}),
      .out(by_16)
  );
  mux4 #(
      .WIDTH(45)
  ) fours (
      .select(shift[3:2]),
      .in_0(by_16),
      .in_1({{4{sign}}, by_16[44:4]}),
      .in_2({{8{sign}}, by_16[44:8]}),
      .in_3({{12{sign}}, by_16[44:12]}),
      .out(by_4)
  );
  mux4 #(
      .WIDTH(45)
  ) ones (
      .select(shift[1:0]),
      .in_0(by_4),
      .in_1({{1{sign}}, by_4[44:1]}),
      .in_2({{2{sign}}, by_4[44:2]}),
      .in_3({{3{sign}}, by_4[44:3]}),
      .out(aligned)
  );
endmodule
`resetall
