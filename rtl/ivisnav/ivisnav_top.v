// SPDX-License-Identifier: Apache-2.0
// iVisNav: the relative velocity and angular velocity x = (v, omega) of y = H x by weighted least squares, as an AXI core (docs/ivisnav.md).
//
//   s_axil_*  AXI4-Lite registers (registers/ivisnav.rdl): configuration, status, flags, results, and the push register
//   s_axis_*  AXI4-Stream, four beats a row, {high 32 bits, low 32 bits}: {h1, h0} {h3, h2} {h5, h4} {w, y}; h and y signed integers,
//             w an unsigned weight of 16 bits (bits 63:48 are ignored); tlast with the last beat of a frame
//   irq       level, on a completed frame or a raised flag, each maskable
`resetall
`default_nettype none
module ivisnav_top #(
    parameter VERIFY = 1
) (
    input  wire        clk,
    input  wire        rst,
    // AXI4-Lite
    input  wire [11:0] s_axil_awaddr,
    input  wire [ 2:0] s_axil_awprot,
    input  wire        s_axil_awvalid,
    output wire        s_axil_awready,
    input  wire [31:0] s_axil_wdata,
    input  wire [ 3:0] s_axil_wstrb,
    input  wire        s_axil_wvalid,
    output wire        s_axil_wready,
    output wire [ 1:0] s_axil_bresp,
    output wire        s_axil_bvalid,
    input  wire        s_axil_bready,
    input  wire [11:0] s_axil_araddr,
    input  wire [ 2:0] s_axil_arprot,
    input  wire        s_axil_arvalid,
    output wire        s_axil_arready,
    output wire [31:0] s_axil_rdata,
    output wire [ 1:0] s_axil_rresp,
    output wire        s_axil_rvalid,
    input  wire        s_axil_rready,
    // AXI4-Stream
    input  wire [63:0] s_axis_tdata,
    input  wire        s_axis_tvalid,
    output wire        s_axis_tready,
    input  wire        s_axis_tlast,
    // interrupt
    output wire        irq
);
  wire give_up, frame_open, verifying, differs, complete, upset, configuration_upset, loader_upset;
  wire [15:0] frame_rows;
  wire soft_reset, acknowledge;
  wire [7:0] config_frac_h, config_frac_y;
  wire [31:0] config_variance;
  wire push_valid, push_last, push_ready, push_open;
  wire [63:0] push_data;
  wire busy, rates_ready, all_ready, rates_commit, all_commit;
  wire [2:0] state;
  wire frame_start, frame_end, frame_dropped, few_rows, zero_weight, bad_tlast, too_long;
  wire rank_deficient, ill_conditioned, watchdog;
  wire [15:0] rows, cycles_rates, cycles_all;
  wire [31:0] weight, condition;
  wire result_valid, result_wait;
  wire [5:0] result_index;
  wire [31:0] result_data;

  ivisnav_registers #(
      .VERIFY(VERIFY),
      .MANTISSA(24)
  ) registers (
      .clk(clk),
      .rst(rst),
      .s_axil_awaddr(s_axil_awaddr),
      .s_axil_awprot(s_axil_awprot),
      .s_axil_awvalid(s_axil_awvalid),
      .s_axil_awready(s_axil_awready),
      .s_axil_wdata(s_axil_wdata),
      .s_axil_wstrb(s_axil_wstrb),
      .s_axil_wvalid(s_axil_wvalid),
      .s_axil_wready(s_axil_wready),
      .s_axil_bresp(s_axil_bresp),
      .s_axil_bvalid(s_axil_bvalid),
      .s_axil_bready(s_axil_bready),
      .s_axil_araddr(s_axil_araddr),
      .s_axil_arprot(s_axil_arprot),
      .s_axil_arvalid(s_axil_arvalid),
      .s_axil_arready(s_axil_arready),
      .s_axil_rdata(s_axil_rdata),
      .s_axil_rresp(s_axil_rresp),
      .s_axil_rvalid(s_axil_rvalid),
      .s_axil_rready(s_axil_rready),
      .soft_reset(soft_reset),
      .acknowledge(acknowledge),
      .config_frac_h(config_frac_h),
      .config_frac_y(config_frac_y),
      .config_variance(config_variance),
      .push_valid(push_valid),
      .push_data(push_data),
      .push_last(push_last),
      .push_ready(push_ready),
      .push_open(push_open),
      .busy(busy),
      .state(state),
      .ready({all_ready, 1'b0, rates_ready}),
      // the register file adds BUSY_WRITE itself
      .flag_set({upset, 1'b0, watchdog, ill_conditioned, 1'b0, 1'b0, bad_tlast, too_long, zero_weight, rank_deficient, few_rows}),
      .frame_start(frame_start),
      .frame_complete(complete),
      .rows(rows),
      .weight(weight),
      .condition(condition),
      .cycles_rates(cycles_rates),
      .cycles_all(cycles_all),
      .result_valid(result_valid),
      .result_index(result_index),
      .result_wait(result_wait),
      .result_data(result_data),
      .upset(configuration_upset),
      .irq(irq)
  );

  wire accept, clear, beat_valid, beat_ready, beat_last;
  wire [63:0] beat_data;
  wire [1:0] beat_index;
  /* verilator lint_off UNUSEDSIGNAL */
  wire beat_weighted;
  wire [15:0] beat_weight;  // the array takes it out of the beat itself
  /* verilator lint_on UNUSEDSIGNAL */

  frame_loader #(
      .BEATS(4),
      .LEAST(6),
      .WEIGHTED(2)
  ) loader (
      .clk(clk),
      .rst(rst),
      .accept(accept),
      .weighted(1'b1),
      .soft_reset(soft_reset),
      .s_axis_tdata(s_axis_tdata),
      .s_axis_tvalid(s_axis_tvalid),
      .s_axis_tready(s_axis_tready),
      .s_axis_tlast(s_axis_tlast),
      .push_valid(push_valid),
      .push_data(push_data),
      .push_last(push_last),
      .push_ready(push_ready),
      .push_open(push_open),
      .clear(clear),
      .beat_weighted(beat_weighted),
      .beat_valid(beat_valid),
      .beat_ready(beat_ready),
      .beat_data(beat_data),
      .beat_index(beat_index),
      .beat_weight(beat_weight),
      .beat_last(beat_last),
      .frame_start(frame_start),
      .frame_end(frame_end),
      .frame_dropped(frame_dropped),
      .few_rows(few_rows),
      .zero_weight(zero_weight),
      .bad_tlast(bad_tlast),
      .too_long(too_long),
      .give_up(give_up),
      .open(frame_open),
      .rows(frame_rows),
      .upset(loader_upset)
  );

  wire write_valid;
  wire [5:0] write_index;
  wire [31:0] write_data;

  ivisnav_core #(
      .VERIFY(VERIFY)
  ) core (
      .clk(clk),
      .rst(rst),
      .soft_reset(soft_reset),
      .acknowledge(acknowledge),
      .config_frac_h(config_frac_h),
      .config_frac_y(config_frac_y),
      .config_variance(config_variance),
      .accept(accept),
      .clear(clear),
      .beat_valid(beat_valid),
      .beat_ready(beat_ready),
      .beat_data(beat_data),
      .beat_index(beat_index),
      .beat_last(beat_last),
      .frame_start(frame_start),
      .frame_end(frame_end),
      .frame_dropped(frame_dropped),
      .frame_open(frame_open),
      .frame_rows(frame_rows),
      .give_up(give_up),
      .write_valid(write_valid),
      .write_index(write_index),
      .write_data(write_data),
      .rates_commit(rates_commit),
      .all_commit(all_commit),
      .state_code(state),
      .busy(busy),
      .rates_ready(rates_ready),
      .all_ready(all_ready),
      .rows(rows),
      .weight(weight),
      .condition(condition),
      .cycles_rates(cycles_rates),
      .cycles_all(cycles_all),
      .rank_deficient(rank_deficient),
      .ill_conditioned(ill_conditioned),
      .watchdog(watchdog),
      .verifying(verifying),
      .differs(differs),
      .complete(complete),
      .upset_elsewhere(configuration_upset | loader_upset),
      .upset(upset)
  );

  // v and omega; then rss and the covariance
  result_store #(
      .MIDDLE_FIRST(6),
      .LAST_FIRST  (6),
      .VERIFY(VERIFY)
  ) store (
      .clk(clk),
      .rst(rst),
      .write_valid(write_valid),
      .write_index(write_index),
      .write_data(write_data),
      .commit({all_commit, 1'b0, rates_commit}),
      .verify(verifying),
      .differs(differs),
      .read_valid(result_valid),
      .read_index(result_index),
      .read_wait(result_wait),
      .read_data(result_data)
  );
endmodule
`resetall
