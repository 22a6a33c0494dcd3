// SPDX-License-Identifier: Apache-2.0
// Rates engine: six binary32 lanes, a divider, an exact residual unit and a microprogram turn the 28 exact sums into
//
//   x = [v; omega] = A^-1 b,   A = H^T W H,  b = H^T W y          (iVisNav paper, Eqs. 9-11)
//
// by L D L^T, triangular solves, two refinements with exact residuals; then rss and the covariance A^-1 sigma^2.
// Lane i holds row i. The program (rates_program.v, equations in sw/relnav/model/rates_program.py) has no interlock: its schedule
// (rates_schedule.py) proves every operand ready.
//
//   item_*   the sums in the order of gram_ring, one a clock without a gap; the first one is cycle 0 of the program
//   write_*  results: 0..2 v, 3..5 omega, 6 rss, 7..27 covariance's upper triangle; rates_done and all_done in the clock after their last words
//   instead of rates_done, and then nothing more comes, rank_deficient or ill_conditioned
//
// rst before each frame that may follow an unfinished one. Latency: `rates_done` 4 clocks after the cycle of its operation
// (sw/relnav/model/rates_schedule.py).
`include "relnav_words.vh"
`resetall
`default_nettype none
module rates_engine (
    input  wire               clk,
    input  wire               rst,
    // exact sums
    input  wire               item_valid,
    input  wire        [ 2:0] item_row,
    input  wire        [ 2:0] item_column,
    input  wire               item_last,
    input  wire signed [95:0] item_moment,
    // of the frame, stable from the first item on
    input  wire        [ 5:0] h_bits,
    input  wire        [ 5:0] y_bits,
    input  wire        [ 5:0] weight_bits,
    input  wire        [15:0] used_count,
    input  wire signed [ 7:0] frac_h,
    input  wire signed [ 7:0] frac_y,
    input  wire        [31:0] variance,
    // results
    output reg                write_valid,
    output reg         [ 5:0] write_index,
    output wire        [31:0] write_data,
    output wire               rates_done,
    output wire               all_done,
    output wire               rank_deficient,
    output wire               ill_conditioned,
    output wire        [31:0] condition
);
  // codes of sw/relnav/model/rates_program.py
  localparam [2:0] Y_BUS = 3'd0, Y_OWN = 3'd1, Y_ONE = 3'd2, Y_RECIPROCAL = 3'd3, Y_RESIDUAL = 3'd4, Y_VARIANCE = 3'd5;
  localparam [1:0] BACK_RATE = 2'd0, BACK_RSS = 2'd1;
  localparam [1:0] MARK_RATES = 2'd1, MARK_ALL = 2'd2;
  localparam [31:0] ONE = 32'h3F800000;
  localparam [8:0] FIRST = 9'd3;  // first cycle with a word
  localparam [2:0] FREEDOM = 3'd7;  // place of used rows - 6 in lane 0
  localparam signed [11:0] UNIT = -`RELNAV_RESIDUAL_UNIT;
  localparam SUM = 184;

  // ------------------------------------------------------------------ program
  reg run;
  reg [8:0] address;
  wire start = item_valid && !run;
  wire stop;
  always @(posedge clk) begin
    run     <= (run || start) && !stop && !rst;
    address <= run ? address + 9'd1 : FIRST;
  end

  wire [1:0] x_bank, c_bank, back, mark;
  wire [4:0] x_address, bus_address, c_address, sum_address, output_index;
  wire [2:0] y_select, bus_lane, product_address, track, row, column;
  wire [5:0] sum_lanes;
  wire next_bus_bank, next_indexed;
  wire [4:0] next_bus_address;
  wire bus_bank, indexed, clamp, product_write, subtract, divide, load, output_valid, term, first, last;
  rates_program microprogram (
      .clk(clk),
      .rst(rst || stop),
      .run(run),
      .address(address),
      .next_bus_bank(next_bus_bank),
      .next_bus_address(next_bus_address),
      .next_indexed(next_indexed),
      .x_bank(x_bank),
      .x_address(x_address),
      .y_select(y_select),
      .bus_bank(bus_bank),
      .bus_address(bus_address),
      .bus_lane(bus_lane),
      .indexed(indexed),
      .clamp(clamp),
      .product_write(product_write),
      .product_address(product_address),
      .c_bank(c_bank),
      .c_address(c_address),
      .subtract(subtract),
      .sum_lanes(sum_lanes),
      .sum_address(sum_address),
      .divide(divide),
      .load(load),
      .track(track),
      .output_valid(output_valid),
      .output_index(output_index),
      .back(back),
      .mark(mark),
      .term(term),
      .row(row),
      .column(column),
      .first(first),
      .last(last)
  );

  // ------------------------------------------------------------------ scales
  wire estimated = variance[30:23] == 8'd0;
  wire signed [11:0] hh, hy, yy, rate_back, rss_back, covariance_back;
  wire signed [6:0] right;
  frame_scale scales (
      .clk(clk),
      .h_bits(h_bits),
      .y_bits(y_bits),
      .weight_bits(weight_bits),
      .frac_h(frac_h),
      .frac_y(frac_y),
      .estimated(estimated),
      .hh(hh),
      .hy(hy),
      .yy(yy),
      .right(right),
      .rate_back(rate_back),
      .rss_back(rss_back),
      .covariance_back(covariance_back)
  );

  // ------------------------------------------------------------------ integers to binary32: moments, used rows - 6, residuals
  wire residual_valid;
  wire [2:0] residual_row;
  wire signed [SUM-1:0] residual;
  reg count_valid;  // in the clock after the last item
  always @(posedge clk) count_valid <= item_valid && item_last && !rst;

  reg signed [16:0] freedom;
  always @(posedge clk) freedom <= {1'b0, used_count} - 17'd6;
  wire of_y_row = item_row == 3'd6;
  wire of_y_column = item_column == 3'd6;
  wire signed [SUM-1:0] integer_value = residual_valid ? residual : count_valid ? {{(SUM - 17) {freedom[16]}}, freedom} :
      {{(SUM - 96) {item_moment[95]}}, item_moment};
  wire signed [11:0] integer_scale = residual_valid ? (residual_row == 3'd6 ? hy : hh) + UNIT : count_valid ? 12'sd0 :
      of_y_row ? yy : of_y_column ? hy : hh;
  wire [31:0] converted;
  integer_to_float #(
      .BITS(SUM)
  ) convert (
      .clk(clk),
      .value(integer_value),
      .scale(integer_scale),
      .result(converted)
  );

  // what it is, four clocks: {residual, count, moment, row, column}
  reg [8:0] kind[1:4];
  integer n;
  always @(posedge clk) begin
    kind[1] <= {residual_valid, count_valid, item_valid, residual_valid ? residual_row : item_row, item_column};
    for (n = 2; n <= 4; n = n + 1) kind[n] <= kind[n-1];
    if (rst) for (n = 1; n <= 4; n = n + 1) kind[n] <= 9'd0;
  end
  wire [2:0] converted_row = kind[4][5:3];
  wire [2:0] converted_column = kind[4][2:0];
  wire moment_converted = kind[4][6];
  wire count_converted = kind[4][7];

  (* ram_style = "distributed" *)reg [31:0] residuals[0:7];
  always @(posedge clk) if (kind[4][8]) residuals[converted_row] <= converted;

  // ------------------------------------------------------------------ operands: cycle 0 own, 1 bus
  wire [2:0] moment_place, inverse_place;
  wire [2:0] next_place = next_bus_bank ? moment_place : inverse_place;
  reg own_bank;
  reg [4:0] own_address;
  always @(posedge clk) begin
    own_bank    <= next_bus_bank;
    own_address <= next_indexed ? next_bus_address + {2'd0, next_place} : next_bus_address;
  end
  wire unused_late = &{1'b0, bus_bank, indexed, bus_address[4:3]};

  reg [1:0] x_bank_1;
  reg [4:0] x_address_1;
  reg [2:0] y_select_1, lane_1, track_1, residual_place_1;
  reg clamp_1, divide_1, load_1;
  always @(posedge clk) begin
    x_bank_1         <= x_bank;
    x_address_1      <= x_address;
    y_select_1       <= y_select;
    residual_place_1 <= bus_address[2:0];
    lane_1           <= bus_lane;
    clamp_1          <= clamp;
    track_1          <= rst ? 3'd0 : track;
    divide_1         <= divide;
    load_1           <= load && !rst;
  end

  wire [6*32-1:0] own;
  wire [31:0] lane_bus = own[32*lane_1+:32];
  wire [31:0] bus = lane_bus & {32{~(clamp_1 & lane_bus[31])}};

  // one clock later for all but the lanes
  reg divide_2, load_2;
  reg [2:0] lane_2;
  reg [31:0] bus_2;
  always @(posedge clk) begin
    divide_2 <= divide_1;
    load_2   <= load_1 && !rst;
    lane_2   <= lane_1;
    bus_2    <= bus;
  end

  wire [31:0] quotient;
  wire divided;
  float_divide divider (
      .clk(clk),
      .rst(rst),
      .start(divide_2),
      .x(ONE),
      .y(bus_2),
      .done(divided),
      .quotient(quotient)
  );
  wire unused_done = divided;  // the schedule knows

  wire [31:0] chosen_residual = residuals[residual_place_1];
  reg [31:0] y_common;
  always @*
    case (y_select_1)
      Y_BUS, Y_OWN: y_common = bus;
      Y_ONE: y_common = ONE;
      Y_RECIPROCAL: y_common = quotient;
      Y_RESIDUAL: y_common = chosen_residual;
      Y_VARIANCE: y_common = estimated ? bus : variance;
      default: y_common = 32'd0;
    endcase

  // ------------------------------------------------------------------ what acts later: entry n - 1 of a pipe is cycle n
  reg [4:0] product_writes, subtracts;
  reg [2:0] product_addresses[1:5];
  reg [6:0] c_places[1:4];
  reg [10:0] sum_places[1:9];  // {lanes, address}
  always @(posedge clk) begin
    product_writes       <= {product_writes[3:0], product_write};
    subtracts            <= {subtracts[3:0], subtract};
    product_addresses[1] <= product_address;
    c_places[1]          <= {c_bank, c_address};
    sum_places[1]        <= {sum_lanes, sum_address};
    for (n = 2; n <= 4; n = n + 1) c_places[n] <= c_places[n-1];
    for (n = 2; n <= 5; n = n + 1) product_addresses[n] <= product_addresses[n-1];
    for (n = 2; n <= 9; n = n + 1) sum_places[n] <= sum_places[n-1];
  end

  // ------------------------------------------------------------------ lanes
  genvar lane;
  generate
    for (lane = 0; lane < 6; lane = lane + 1) begin : g_lane
      wire of_row = converted_row == lane;
      wire of_column = converted_column == lane;
      wire freedom_here = lane == 0 && count_converted;
      rates_lane u_lane (
          .clk(clk),
          .moment_write((moment_converted && (of_row || of_column)) || freedom_here),
          .moment_address(freedom_here ? FREEDOM : of_row ? converted_column : converted_row),
          .moment(converted),
          .own_bank(own_bank),
          .own_address(own_address),
          .own(own[32*lane+:32]),
          .x_bank(x_bank_1),
          .x_address(x_address_1),
          .y_own(y_select_1 == Y_OWN),
          .y_common(y_common),
          .product_write(product_writes[4]),
          .product_address(product_addresses[5]),
          .c_bank(c_places[4][6:5]),
          .c_address(c_places[4][4:0]),
          .subtract(subtracts[4]),
          .sum_write(sum_places[9][5+lane]),
          .sum_address(sum_places[9][4:0])
      );
    end
  endgenerate

  // ------------------------------------------------------------------ exact residual
  wire overflow;
  residual_unit residuals_of (
      .clk(clk),
      .clear(rst || start),
      .moment_write(item_valid),
      .moment_row(item_row),
      .moment_column(item_column),
      .moment(item_moment),
      .right(right),
      .load(load_2),
      .load_place(lane_2),
      .rate(bus_2),
      .overflow(overflow),
      .term(term),
      .row(row),
      .column(column),
      .first(first),
      .last(last),
      .residual_valid(residual_valid),
      .residual_row(residual_row),
      .residual(residual)
  );

  // ------------------------------------------------------------------ may it be believed
  wire stalled, excessive, no_rank;
  rates_monitor monitor (
      .clk(clk),
      .clear(rst || start),
      .diagonal_valid(moment_converted && converted_row == converted_column && converted_row != 3'd6),
      .diagonal_place(converted_row),
      .diagonal(converted),
      .moment_place(moment_place),
      .track(track_1),
      .lane(lane_1),
      .bus(bus),
      .inverse_place(inverse_place),
      .rank_deficient(no_rank),
      .stalled(stalled),
      .excessive(excessive),
      .condition(condition)
  );

  // ------------------------------------------------------------------ results: cycle 2 of an output is scaled, 3 written, 4 counts
  reg output_1, output_2;
  reg [4:0] index_1, index_2;
  reg [1:0] back_1, mark_1, mark_2, mark_3, mark_4;
  reg signed [11:0] scale_2;
  reg doubtful;
  always @(posedge clk) begin
    {output_1, output_2} <= {output_valid, output_1};
    {index_1, index_2} <= {output_index, index_1};
    back_1 <= back;
    scale_2 <= back_1 == BACK_RATE ? rate_back : back_1 == BACK_RSS ? rss_back : covariance_back;
    {mark_1, mark_2, mark_3, mark_4} <= {mark, mark_1, mark_2, mark_3};
    doubtful <= stalled || excessive || overflow;
    write_valid <= output_2 && !rst && !stop;
    write_index <= {1'b0, index_2};
    if (rst || stop) {output_1, output_2, mark_1, mark_2, mark_3, mark_4} <= 10'd0;
  end
  output_scale scale_back (
      .clk(clk),
      .value(bus_2),
      .scale(scale_2),
      .result(write_data)
  );

  assign rank_deficient = run && no_rank && |address[8:6];  // not before the last item, which would start anew
  assign ill_conditioned = mark_4 == MARK_RATES && doubtful && !rank_deficient;
  assign rates_done = mark_4 == MARK_RATES && !doubtful && !rank_deficient;
  assign all_done = mark_4 == MARK_ALL && !rank_deficient;
  assign stop = rank_deficient || ill_conditioned || all_done;
endmodule
`resetall
