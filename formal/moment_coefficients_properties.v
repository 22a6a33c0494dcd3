// SPDX-License-Identifier: Apache-2.0
// Why moment_check sees every flipped bit of a sum (moment_coefficients.sby): a sum that is wrong by 2^n is wrong, modulo the prime
// p = 2^16 + 1, by coefficient 2^n, which is never 0; and two sums in each other's place are told apart, as no two coefficients agree.
`resetall
`default_nettype none

module moment_coefficients_properties #(
    parameter        RING    = 0,
    parameter [23:0] FACTORS = {6'd0, 6'd14, 6'd39, 6'd17}
) (
    input wire [5:0] key,
    input wire [5:0] other,
    input wire [3:0] bit_place  // modulo 16: 2^16 = -1
);
  wire [15:0] coefficient, coefficient_other;
  moment_coefficients #(
      .RING(RING),
      .FACTORS(FACTORS)
  ) dut (
      .key(key),
      .coefficient(coefficient)
  );
  moment_coefficients #(
      .RING(RING),
      .FACTORS(FACTORS)
  ) second (
      .key(other),
      .coefficient(coefficient_other)
  );

  // gram_array: seven lanes in three slots, then W at 24 and the first moments; gram_ring: rows and columns 0..6, the weights' sum at 58
  function sum_at(input [5:0] k);
    sum_at = RING != 0 ? (k[5:3] != 3'd7 && k[2:0] != 3'd7 && k[5:3] <= k[2:0]) || k == 6'd58 : k < 6'd28;
  endfunction

  wire [31:0] moved = {16'd0, coefficient} << bit_place;
  always @* begin
    if (sum_at(key) || key == 6'd56 || key == 6'd57) bit_seen : assert (moved[31:16] != moved[15:0]);
    if (sum_at(key) && sum_at(other) && key != other) sums_differ : assert (coefficient != coefficient_other);
    if (key == 6'd56 || key == 6'd57) taken_once : assert (coefficient == 16'd1);
  end
endmodule

`resetall
