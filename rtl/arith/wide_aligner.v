// SPDX-License-Identifier: Apache-2.0
// Arithmetic right shift of a whole product, ones' complemented on demand. Combinational.
//
//   aligned = floor(value / 2^shift), or -1 - floor(value / 2^shift) with `invert`; shift 0..95
//
// Stages of one LUT a bit: 32s with the complement (see aligner), 8s, 2s, 1s.
`resetall
`default_nettype none
module wide_aligner (
    input  wire [69:0] value,
    input  wire        invert,
    input  wire [ 6:0] shift,
    output wire [69:0] aligned
);
  wire sign = value[69] ^ invert;
  wire [69:0] by_32, by_8, by_2;

  mux3_invert #(
      .WIDTH(70)
  ) thirty_twos (
      .select(shift[6:5]),
      .invert(invert),
      .in_0(value),
      .in_1({{32{value[69]}}, value[69:32]}),
      .in_2({{64{value[69]}}, value[69:64]}),
      .out(by_32)
  );
  mux4 #(
      .WIDTH(70)
  ) eights (
      .select(shift[4:3]),
      .in_0(by_32),
      .in_1({{8{sign}}, by_32[69:8]}),
      .in_2({{16{sign}}, by_32[69:16]}),
      .in_3({{24{sign}}, by_32[69:24]}),
      .out(by_8)
  );
  mux4 #(
      .WIDTH(70)
  ) twos (
      .select(shift[2:1]),
      .in_0(by_8),
      .in_1({{2{sign}}, by_8[69:2]}),
      .in_2({{4{sign}}, by_8[69:4]}),
      .in_3({{6{sign}}, by_8[69:6]}),
      .out(by_2)
  );
  assign aligned = shift[0] ? {sign, by_2[69:1]} : by_2;
endmodule
`resetall
