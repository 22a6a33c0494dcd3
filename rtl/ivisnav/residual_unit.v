// SPDX-License-Identifier: Apache-2.0
// The exact residual of a rate estimate: sums of integer moments times binary32 rates, without any rounding before the last term.
//
//   sum_i = sum_j +- G_ij f_j 2^left_j,   x_j = +- f_j 2^(left_j + UNIT),   left_j = exponent_j - 94
//   column 6 stands for the right-hand side: G_i6 2^(right - UNIT), added; the columns 0..5 are subtracted
//
// Rates below 2^-33 count as zero here, those from 2^26 on raise `overflow` (until `clear`): the moments are scaled so that rates are
// about 1. Width: |G| < 2^95, |x| < 2^26, UNIT = 2^-56, seven terms: 95 + 26 + 56 + 3 = 180 bits and the sign; SUM = 184.
//
// cycle | 0 term: moment and rate read | 1 .. 3 product (residual_product) | 4 moved left by 16s, 4s | 5 by 1s | 6, 7, 8 the three
//       | thirds of the sum, low one first | 9 residual, residual_valid
// A row's terms may follow one another, rows may be interleaved. A moment or rate can be used in the clock after its write.
`include "relnav_words.vh"
`resetall
`default_nettype none
module residual_unit (
    input  wire                clk,
    input  wire                clear,
    // moments, row <= column
    input  wire                moment_write,
    input  wire        [  2:0] moment_row,
    input  wire        [  2:0] moment_column,
    input  wire        [ 95:0] moment,
    input  wire signed [  6:0] right,
    // rates
    input  wire                load,
    input  wire        [  2:0] load_place,
    input  wire        [ 31:0] rate,
    output reg                 overflow,
    // terms
    input  wire                term,
    input  wire        [  2:0] row,
    input  wire        [  2:0] column,
    input  wire                first,
    input  wire                last,
    // residual, cycle 9
    output wire                residual_valid,
    output wire        [  2:0] residual_row,
    output wire signed [183:0] residual
);
  localparam SUM = 184;
  localparam PART = 62;  // two lower thirds; the highest has 60
  localparam [7:0] OFFSET = 127 + 23 - `RELNAV_RESIDUAL_UNIT;  // exponent of a rate whose last bit is the unit
  localparam [7:0] LARGEST = 126 + `RELNAV_RATE_BITS;
  localparam signed [6:0] ONE_LEFT = `RELNAV_RESIDUAL_UNIT - 23;  // of 2^0

  // ---- places of the 28 moments: column (column + 1) / 2 + row
  function [4:0] place;
    input [2:0] low;
    input [2:0] high;
    begin
      case (high)
        3'd0: place = {2'd0, low};
        3'd1: place = 5'd1 + {2'd0, low};
        3'd2: place = 5'd3 + {2'd0, low};
        3'd3: place = 5'd6 + {2'd0, low};
        3'd4: place = 5'd10 + {2'd0, low};
        3'd5: place = 5'd15 + {2'd0, low};
        default: place = 5'd21 + {2'd0, low};
      endcase
    end
  endfunction

  (* ram_style = "distributed" *)reg [95:0] moments[0:31];
  (* ram_style = "distributed" *)reg [31:0] rates[0:7];
  wire [4:0] write_place = place(moment_row, moment_column);
  wire [4:0] read_place = row < column ? place(row, column) : place(column, row);
  always @(posedge clk) begin
    if (moment_write) moments[write_place] <= moment;
    if (load) rates[load_place] <= rate;
    if (clear) overflow <= 1'b0;
    else if (load && rate[30:23] > LARGEST) overflow <= 1'b1;
  end

  // ---- cycle 0
  wire right_side = column == 3'd6;
  wire [31:0] x = rates[column];
  wire fits = x[30:23] >= OFFSET && x[30:23] <= LARGEST;
  wire [23:0] significand = right_side ? 24'h800000 : fits ? {1'b1, x[22:0]} : 24'd0;
  wire [7:0] rate_left = x[30:23] - OFFSET;
  wire signed [6:0] right_left = ONE_LEFT + right;
  wire signed [119:0] product;
  residual_product multiplier (
      .clk(clk),
      .moment(moments[read_place]),
      .significand(significand),
      .product(product)
  );
  wire unused = &{1'b0, rate_left[7:6], right_left[6]};  // a significand of 0 does not care; right <= 30

  // ---- what goes with the term: bit or word n - 1 is cycle n
  reg [8:0] live, lasts;
  reg [7:0] firsts, negatives;
  reg [5:0] left[1:5];
  reg [2:0] rows[1:9];
  integer n;
  always @(posedge clk) begin
    live      <= {live[7:0], term && !clear};
    lasts     <= {lasts[7:0], last};
    firsts    <= {firsts[6:0], first};
    negatives <= {negatives[6:0], !right_side && !x[31]};
    left[1]   <= right_side ? right_left[5:0] : rate_left[5:0];
    rows[1]   <= row;
    for (n = 2; n <= 5; n = n + 1) left[n] <= left[n-1];
    for (n = 2; n <= 9; n = n + 1) rows[n] <= rows[n-1];
    if (clear) live <= 9'd0;
  end

  // ---- cycles 4 and 5: move
  wire signed [SUM-1:0] wide = {{(SUM - 120) {product[119]}}, product};
  wire [1:0] by_16 = left[4][5:4];
  wire [1:0] by_4 = left[4][3:2];
  wire [1:0] by_1 = left[5][1:0];
  wire [SUM-1:0] coarse = ({SUM{by_16 == 2'd0}} & wide) | ({SUM{by_16 == 2'd1}} & (wide << 16)) |
      ({SUM{by_16 == 2'd2}} & (wide << 32)) | ({SUM{by_16 == 2'd3}} & (wide << 48));
  wire [SUM-1:0] middle = ({SUM{by_4 == 2'd0}} & coarse) | ({SUM{by_4 == 2'd1}} & (coarse << 4)) |
      ({SUM{by_4 == 2'd2}} & (coarse << 8)) | ({SUM{by_4 == 2'd3}} & (coarse << 12));
  reg [SUM-1:0] moved_5, moved_6;
  wire [SUM-1:0] fine = ({SUM{by_1 == 2'd0}} & moved_5) | ({SUM{by_1 == 2'd1}} & (moved_5 << 1)) |
      ({SUM{by_1 == 2'd2}} & (moved_5 << 2)) | ({SUM{by_1 == 2'd3}} & (moved_5 << 3));
  always @(posedge clk) begin
    moved_5 <= middle;
    moved_6 <= fine;
  end

  // ---- cycles 6 to 8: accumulate in thirds, a clock apart; a subtracted term is its complement and a carry
  reg [SUM-1:PART] moved_7;
  reg [SUM-1:2*PART] moved_8;
  reg carry_7, carry_8;
  (* ram_style = "distributed" *)reg [PART-1:0] low_sums[0:7];
  (* ram_style = "distributed" *)reg [PART-1:0] middle_sums[0:7];
  (* ram_style = "distributed" *)reg [SUM-2*PART-1:0] high_sums[0:7];
  wire [PART-1:0] low_base = low_sums[rows[6]] & {PART{~firsts[5]}};
  wire [PART-1:0] middle_base = middle_sums[rows[7]] & {PART{~firsts[6]}};
  wire [SUM-2*PART-1:0] high_base = high_sums[rows[8]] & {(SUM - 2 * PART) {~firsts[7]}};
  wire [PART+1:0] low_total = {1'b0, low_base, negatives[5]} + {1'b0, moved_6[PART-1:0] ^ {PART{negatives[5]}}, negatives[5]};
  wire [PART+1:0] middle_total = {1'b0, middle_base, carry_7} + {1'b0, moved_7[2*PART-1:PART] ^ {PART{negatives[6]}}, carry_7};
  wire [SUM-2*PART:0] high_total = {high_base, carry_8} + {moved_8 ^ {(SUM - 2 * PART) {negatives[7]}}, carry_8};
  wire unused_carry = &{1'b0, low_total[0], middle_total[0], high_total[0]};

  reg [PART-1:0] low_7, low_8, low_9, middle_8, middle_9;
  reg [SUM-2*PART-1:0] high_9;
  always @(posedge clk) begin
    moved_7 <= moved_6[SUM-1:PART];
    moved_8 <= moved_7[SUM-1:2*PART];
    carry_7 <= low_total[PART+1];
    carry_8 <= middle_total[PART+1];
    if (live[5]) low_sums[rows[6]] <= low_total[PART:1];
    if (live[6]) middle_sums[rows[7]] <= middle_total[PART:1];
    if (live[7]) high_sums[rows[8]] <= high_total[SUM-2*PART:1];
    low_7    <= low_total[PART:1];
    low_8    <= low_7;
    low_9    <= low_8;
    middle_8 <= middle_total[PART:1];
    middle_9 <= middle_8;
    high_9   <= high_total[SUM-2*PART:1];
  end

  assign residual = {high_9, middle_9, low_9};
  assign residual_valid = live[8] && lasts[8];
  assign residual_row = rows[9];
endmodule
`resetall
