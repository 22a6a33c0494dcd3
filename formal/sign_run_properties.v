// SPDX-License-Identifier: Apache-2.0
// sign_run for each of its 2^17 inputs (sign_run.sby).
`resetall
`default_nettype none

module sign_run_properties (
    input wire [16:0] bits
);
  wire [3:0] count;
  wire any;

  sign_run dut (
      .bits(bits),
      .count(count),
      .any(any)
  );

  reg [3:0] expected;
  integer i;
  always @* begin
    expected = 4'd15;
    for (i = 0; i < 16; i = i + 1) if (bits[i] != bits[16]) expected = 15 - i;
  end

  always @* any_right : assert (any == (bits != 17'h00000 && bits != 17'h1FFFF));
  always @* count_right : assert (count == expected);
endmodule

`resetall
