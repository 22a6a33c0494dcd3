// SPDX-License-Identifier: Apache-2.0
// Adds up the sums of a drain, each times its coefficient, modulo p = 2^16 + 1, takes what was predicted away, and looks whether that is 0:
// the other half of moment_check. An item is up to 96 bits, a value up to 64, both signed; never both in a clock.
//
// clock     1        2        3           4     5        6       Words are taken together, not divided (2^16 = -1, 2^48 = -1 modulo p):
//           x or v   folded   w_01, w_2   term  product  sum     96 bits to 50, to a 19-bit term; |sum| < 30 * 2^18 * 2^16 < 2^39.
// Signs: folded is item, -value, -residue, -sum modulo p.
// After value_last comes the predicted residue, then the sum itself twice (it need only stay 0 or not), each in place of an item, and the sum
// starts from zero: of 40 bits 18 are left, of magnitude 65535 + 128, then 2^16 at most, where only 0 is 0 modulo p.
//
// clock (value_last = 0)  2          7     8           13    14          19     20
//                         residue in sum   sum in      sum   sum in      sum    checked, mismatch
`resetall
`default_nettype none

// Kept as it is: flattened into its parent, ABC makes 28 LUTs more of it.
(* keep_hierarchy *)
module item_residue #(
    parameter        RING       = 0,                      // keys, see moment_coefficients
    parameter        ITEM_BITS  = 96,                     // more than 50
    parameter        VALUE_BITS = 64,
    parameter [23:0] FACTORS    = {6'd0, 6'd14, 6'd39, 6'd17}
) (
    input  wire                         clk,
    input  wire                         rst,
    input  wire                         clear,
    input  wire        [          49:0] residue,
    input  wire                         item_valid,
    input  wire        [           5:0] item_key,
    input  wire signed [ ITEM_BITS-1:0] item,
    input  wire                         value_valid,
    input  wire        [           5:0] value_key,
    input  wire                         value_last,
    input  wire signed [VALUE_BITS-1:0] value,
    output reg                          checked,
    output reg                          mismatch
);
  localparam [5:0] KEY_RESIDUE = 6'd56, KEY_SUM = 6'd57;
  wire restart = rst || clear;

  // ---- what comes in; all but one of x, v and back is zero, or all
  reg [ITEM_BITS-1:0] x;
  reg [VALUE_BITS-1:0] v;
  reg [39:0] back;
  reg [5:0] key_1, key_2, key_3;
  reg [5:1] valid;
  reg [6:1] ends;  // of the residue, or of the sum fed back
  reg values_end, with_residue;
  reg [1:0] rounds;
  wire signed [39:0] sum;
  wire again = ends[6] && !rounds[1];

  always @(posedge clk) begin
    x <= item_valid ? item : {ITEM_BITS{1'b0}};
    v <= value_valid ? value : {VALUE_BITS{1'b0}};
    back <= again ? sum : 40'd0;
    key_1 <= again ? KEY_SUM : values_end ? KEY_RESIDUE : value_valid ? value_key : item_key;
    {key_2, key_3} <= {key_1, key_2};

    values_end <= value_valid && value_last;
    with_residue <= values_end;
    valid <= {valid[4:1], item_valid || value_valid || values_end || again};
    ends <= {ends[5:1], values_end || again};
    if (ends[6]) rounds <= rounds[1] ? 2'd0 : rounds + 2'd1;
    if (restart) begin
      values_end <= 1'b0;
      with_residue <= 1'b0;
      valid <= 5'd0;
      ends <= 6'd0;
      rounds <= 2'd0;
    end
  end

  // ---- folded = first - second, 50 bits; bits 63:48 of a value go to 47:32 of the other: 2^48 = -1, 2^32 = 1
  wire [49:0] value_low, value_high;
  generate
    if (VALUE_BITS > 48) begin : g_wide
      assign value_low  = {2'd0, v[47:0]};
      assign value_high = {{66 - VALUE_BITS{v[VALUE_BITS-1]}}, v[VALUE_BITS-1:48], 32'd0};
    end else begin : g_narrow
      assign value_low  = {{50 - VALUE_BITS{v[VALUE_BITS-1]}}, v};
      assign value_high = 50'd0;
    end
  endgenerate
  wire [49:0] item_high = {{98 - ITEM_BITS{x[ITEM_BITS-1]}}, x[ITEM_BITS-1:48]};
  wire [49:0] first = {2'd0, x[47:0]} | value_high | {48'd0, residue[49:48] & {2{with_residue}}};
  wire [49:0] second = item_high | value_low | {{10{back[39]}}, back} | {2'd0, residue[47:0] & {48{with_residue}}};

  reg [49:0] folded;
  reg signed [17:0] w_01, w_2;
  wire [15:0] coefficient;

  always @(posedge clk) begin
    folded <= first - second;
    w_01   <= {2'd0, folded[15:0]} - {2'd0, folded[31:16]};
    w_2    <= folded[49:32];
  end

  moment_coefficients #(
      .RING(RING),
      .FACTORS(FACTORS)
  ) u_coefficients (
      .key(key_3),
      .coefficient(coefficient)
  );

  residue_mac #(
      .X_BITS(18),
      .Y_BITS(18),
      .FACTOR_BITS(17),
      .SUM_BITS(40)
  ) u_sum (
      .clk(clk),
      .clear(restart || ends[6]),
      .add(valid[5]),
      .fresh(1'b0),
      .x(w_01),
      .y(w_2),
      .factor({1'b0, coefficient}),
      .sum(sum)
  );

  always @(posedge clk) begin
    checked  <= ends[6] && rounds[1] && !restart;
    mismatch <= ends[6] && rounds[1] && !restart && sum[17:0] != 18'd0;
  end
endmodule

`resetall
