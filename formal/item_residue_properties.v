// SPDX-License-Identifier: Apache-2.0
// item_residue at its full width (item_residue.sby), in two steps; residue_mac by its contract (any product but that by 1).
//
// KIND 0 to 3, folding: what one clock brings (an item, a value, the residue of the beats, the sum fed back) is congruent, modulo
// p = 2^16 + 1, to the term made of it, the last three negated. Not by a division: a multiple of p is found that makes the two equal.
//   x = low + 2^48 high = (low - high) + high (2^48 + 1), and 2^48 + 1 = p (2^32 - 2^16 + 1); of a value high (2^48 + 2^32) = p 2^32 high
//   f = f_0 + 2^16 f_1 + 2^32 f_2 = (f_0 - f_1 + f_2) + p (f_1 + (2^16 - 1) f_2)
// KIND 4, judging: whatever the sum is when all of a drain and the residue are in it, twelve clocks later `mismatch` tells whether it is a
// multiple of p: no false alarm for any multiple, and where it does not tell, the sum is p times what the two foldings took away.
`resetall
`default_nettype none

module item_residue_properties #(
    parameter KIND       = 0,   // 0: item, 1: value, 2: residue, 3: sum fed back, 4: judging
    parameter RING       = 0,
    parameter ITEM_BITS  = 96,
    parameter VALUE_BITS = 64
) (
    input wire                         clk,
    input wire                         rst,
    input wire                         clear,
    input wire        [          49:0] residue,
    input wire                         item_valid,
    input wire        [           5:0] item_key,
    input wire signed [ ITEM_BITS-1:0] item,
    input wire                         value_valid,
    input wire        [           5:0] value_key,
    input wire                         value_last,
    input wire signed [VALUE_BITS-1:0] value
);
  wire checked, mismatch;
  item_residue #(
      .RING(RING),
      .ITEM_BITS(ITEM_BITS),
      .VALUE_BITS(VALUE_BITS)
  ) dut (
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

  // connected by the script
  wire [ITEM_BITS-1:0] dut_x;
  wire [VALUE_BITS-1:0] dut_v;
  wire signed [39:0] dut_back, dut_sum;
  wire dut_with_residue, dut_values_end;
  wire signed [49:0] dut_folded;
  wire signed [18:0] dut_term;
  wire [5:1] dut_valid;
  wire [6:1] dut_ends;
  wire [1:0] dut_rounds;

  function signed [127:0] by_p(input signed [127:0] number);
    by_p = (number <<< 16) + number;
  endfunction

  // f_1 + (2^16 - 1) f_2
  wire signed [127:0] f_1 = {112'd0, dut_folded[31:16]};
  wire signed [127:0] f_2 = {{110{dut_folded[49]}}, dut_folded[49:32]};
  wire signed [127:0] left = f_1 + (f_2 <<< 16) - f_2;

  reg [4:0] age = 5'd0;
  always @(posedge clk) age <= age == 5'd31 ? age : age + 5'd1;

  generate
    if (KIND < 4) begin : g_fold
      wire signed [127:0] x = {{128 - ITEM_BITS{dut_x[ITEM_BITS-1]}}, dut_x};
      wire signed [127:0] v = {{128 - VALUE_BITS{dut_v[VALUE_BITS-1]}}, dut_v};
      wire signed [127:0] back = dut_back;
      wire signed [127:0] beats = {78'd0, residue};
      wire signed [127:0] number = KIND == 0 ? x : KIND == 1 ? -v : KIND == 2 ? -beats : -back;
      wire signed [127:0] high = KIND == 0 ? x >>> 48 : KIND == 1 ? (VALUE_BITS > 48 ? -(v >>> 48) : 0) : KIND == 2 ? -(beats >>> 48) : 0;
      wire signed [127:0] multiple = (high <<< 48) + (KIND == 1 ? high <<< 32 : high);
      // in the clock at which the follow-up begins only this is there
      always @* if (age == 5'd0) assume ((KIND == 0 || dut_x == 0) && (KIND == 1 || dut_v == 0) && (KIND == 3 || dut_back == 0) &&
                                         dut_with_residue == (KIND == 2));
      wire signed [127:0] folded = dut_folded;
      reg signed [127:0] number_1, multiple_1, folded_2, folded_3, left_2, left_3;
      always @(posedge clk) begin
        {number_1, multiple_1} <= {number, multiple};
        {folded_2, left_2} <= {folded, left};
        {folded_3, left_3} <= {folded_2, left_2};
      end
      wire signed [127:0] term = dut_term;
      always @* begin
        if (age == 5'd1) folded_right : assert (number_1 == folded + multiple_1);
        if (age == 5'd3) term_right : assert (folded_3 == term + by_p(left_3));
      end
    end else begin : g_judge
      always @* begin
        if (age == 5'd0) assume (dut_ends == 6'b100000 && dut_valid == 5'd0 && dut_rounds == 2'd0 && !dut_values_end && !dut_with_residue &&
                                 dut_x == 0 && dut_v == 0 && dut_back == 0);
        assume (!rst && !clear && !item_valid && !value_valid);
      end
      (* anyconst *) wire signed [24:0] quotient;
      reg signed [39:0] asked;  // the sum that is judged
      reg signed [127:0] first, second;
      wire signed [127:0] wide_quotient = quotient;
      wire signed [127:0] judged = asked;
      always @(posedge clk) begin
        if (age == 5'd0) asked <= dut_sum;
        if (age == 5'd2) first <= left;
        if (age == 5'd8) second <= left;
      end
      always @* begin
        if (age != 5'd0) on_time : assert (checked == (age == 5'd13));
        if (age == 5'd13 && judged == by_p(wide_quotient)) no_false_alarm : assert (!mismatch);
        if (age == 5'd13 && !mismatch) none_missed : assert (judged == by_p(second - first));
      end
    end
  endgenerate
endmodule

`resetall
