// SPDX-License-Identifier: Apache-2.0
// Algorithm-based fault check of a Gram array: the exact sums that leave it must agree, modulo p = 2^16 + 1, with the beats that entered.
//
//   predicted   P = sum over rows of w (s^2 - 2),  s = sum of c_i u_i over the row's components               (frame_residue)
//   drained     C = sum over the drained sums of coefficient * sum,  mismatch where C - P is not 0 modulo p   (item_residue)
//
// u' = u - 2^15 in gram_array, so s = sum c_i u'_i + 2^15 S with S = sum c_i, and m_i = sum w u_i = sum w u'_i + 2^15 W:
//   sum w s^2 = sum c_i c_j G'_ij + 2 (2^15 S) sum c_i (m_i - 2^15 W) + (2^15 S)^2 W
//             = sum c_i c_j G'_ij - S sum c_i m_i + 2^14 S^2 W             modulo p, as 2^16 = -1
// gram_ring does not shift: sum w s^2 = sum c_i c_j G_ij.     In both -2 W is added.
//
// What one flipped bit changes is noticed always: a sum changes by +-2^n, in the array's Karatsuba sums by 2^n (1 - 2^16) = 2^(n+1) too (2^16 - 1
// as a modulus would be blind to those), p is a prime, and no coefficient is 0 (nor is 2^14 S^2 + 2, that of W where m = m' + W 2^15 changes
// with it). What is no single sum's bit (a wrong, lost, repeated or exchanged row, component or sum) is noticed but for one case in 65537:
// all coefficients differ.
// Not covered: counts of points (n, used_count), range bits, and what happens before beat or behind item and value.
//
// A sequence of items and values, the last one with value_last, is compared, 20 clocks after value_last: `checked`, and with it `mismatch`.
// P holds until clear, and the drained side starts from zero after `checked` and after clear or rst, so that any number of drains can be
// checked; the next may begin in the clock after `checked`. A stray item between two drains is an item of the next. value_last comes
// 11 clocks after the last beat at the earliest. A beat taken with clear belongs to the new frame.
`resetall
`default_nettype none

module moment_check #(
    parameter RING       = 0,   // 0: gram_array, 3 beats; 1: gram_ring, 4 beats, no high half in the last
    parameter ITEM_BITS  = 96,
    parameter VALUE_BITS = 64
) (
    input  wire                         clk,
    input  wire                         rst,
    input  wire                         clear,
    // beats, as they are taken
    input  wire                         beat,
    input  wire        [          63:0] beat_data,
    input  wire        [           1:0] beat_index,
    input  wire        [          15:0] beat_weight,  // right with a row's last beat
    // sums, as they leave; keys: see moment_coefficients
    input  wire                         item_valid,
    input  wire        [           5:0] item_key,
    input  wire signed [ ITEM_BITS-1:0] item,
    input  wire                         value_valid,  // never with item_valid
    input  wire        [           5:0] value_key,
    input  wire                         value_last,
    input  wire signed [VALUE_BITS-1:0] value,
    // pulses
    output wire                         checked,
    output wire                         mismatch
);
  // g_k of the beats: so chosen that coefficients differ and take 16 bits (sw/relnav/model/moment_check.py)
  localparam [23:0] FACTORS = RING != 0 ? {6'd37, 6'd22, 6'd8, 6'd58} : {6'd0, 6'd14, 6'd39, 6'd17};
  wire [49:0] residue;

  frame_residue #(
      .BEATS(RING != 0 ? 4 : 3),
      .FACTORS(FACTORS)
  ) u_frame (
      .clk(clk),
      .rst(rst),
      .clear(clear),
      .beat(beat),
      .beat_data(beat_data),
      .beat_index(beat_index),
      .beat_weight(beat_weight),
      .residue(residue)
  );

  item_residue #(
      .RING(RING),
      .ITEM_BITS(ITEM_BITS),
      .VALUE_BITS(VALUE_BITS),
      .FACTORS(FACTORS)
  ) u_items (
      .clk(clk),
      .rst(rst),
      .clear(clear),
      .residue(residue),
      .item_valid(item_valid),
      .item_key(item_key),
      .item(item),
      .value_valid(value_valid),
      .value_key(value_key),
      .value_last(value_last),
      .value(value),
      .checked(checked),
      .mismatch(mismatch)
  );
endmodule

`resetall
