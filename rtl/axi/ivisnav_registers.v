// SPDX-License-Identifier: Apache-2.0
// Register file of ivisnav_top. The map is registers/ivisnav.rdl (page: docs/registers-ivisnav.md). Here: CONDITION; all else is
// core_registers, whose timing this follows.
`resetall
`default_nettype none

module ivisnav_registers #(
    parameter VERIFY = 1,    // what this core was built with, for BUILD
    parameter MANTISSA = 24  // bits, for BUILD
) (
    input wire clk,
    input wire rst,

    // bus
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

    // control
    output wire soft_reset,   // pulses
    output wire acknowledge,

    // configuration; changes only while !busy
    output wire [ 7:0] config_frac_h,
    output wire [ 7:0] config_frac_y,
    output wire [31:0] config_variance,

    // push register, to frame_loader
    output wire        push_valid,
    output wire [63:0] push_data,
    output wire        push_last,
    input  wire        push_ready,
    input  wire        push_open,   // a push would be taken now or soon

    // status
    input wire       busy,
    input wire [2:0] state,
    input wire [2:0] ready,  // all, none, rates

    // events, pulses
    input wire [10:0] flag_set,       // in the order of FLAGS (6, 9: none); BUSY_WRITE and UPSET of this file are added here
    input wire        frame_start,
    input wire        frame_complete,

    // of the frame whose results stand
    input wire [15:0] rows,
    input wire [31:0] weight,
    input wire [31:0] condition,      // of the last frame that got so far
    input wire [15:0] cycles_rates,
    input wire [15:0] cycles_all,

    // result_store
    output wire        result_valid,
    output wire [ 5:0] result_index,
    input  wire        result_wait,
    input  wire [31:0] result_data,

    output wire upset,  // something here cannot be trusted: core_registers
    output wire irq
);

  `include "ivisnav_registers.vh"

  localparam [10:0] GAPS = 11'b010_0100_0000;  // flags that this core has not

  wire read_valid;
  wire [11:2] write_word, read_word;
  /* verilator lint_off UNUSEDSIGNAL */
  wire write_valid;  // no own register is written
  wire [31:0] write_data;
  wire [3:0] write_strobe;
  /* verilator lint_on UNUSEDSIGNAL */

  reg [31:0] own;
  always @(posedge clk) own <= read_valid && read_word == CONDITION_ADDRESS[11:2] ? condition : 32'd0;

  core_registers #(
      .ID(ID_RESET),
      .BUILD({31'd0, VERIFY != 0} << BUILD_VERIFY_LSB | MANTISSA << BUILD_MANTISSA_LSB),
      .FLAGS(11),
      .FRACS(2),
      .COUNT_ADDRESS(ROWS_ADDRESS),
      .FIRST_ADDRESS(CYCLES_RATES_ADDRESS),
      .RESULTS_ADDRESS(V_ADDRESS)
  ) common (
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
      .config_frac({config_frac_y, config_frac_h}),
      .config_variance(config_variance),
      .push_valid(push_valid),
      .push_data(push_data),
      .push_last(push_last),
      .push_ready(push_ready),
      .push_open(push_open),
      .busy(busy),
      .state(state),
      .ready(ready),
      .flag_set(flag_set & ~GAPS),
      .frame_start(frame_start),
      .frame_complete(frame_complete),
      .count(rows),
      .weight(weight),
      .cycles_first(cycles_rates),
      .cycles_middle(16'd0),
      .cycles_last(cycles_all),
      .result_valid(result_valid),
      .result_index(result_index),
      .result_wait(result_wait),
      .result_data(result_data),
      .write_valid(write_valid),
      .write_word(write_word),
      .write_data(write_data),
      .write_strobe(write_strobe),
      .write_mapped(is_mapped(write_word)),
      .own_locked(1'b0),
      .read_valid(read_valid),
      .read_word(read_word),
      .read_mapped(is_mapped(read_word)),
      .own_data(own),
      .own_upset(1'b0),
      .upset(upset),
      .irq(irq)
  );

endmodule

`resetall
