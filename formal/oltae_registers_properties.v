// SPDX-License-Identifier: Apache-2.0
// What oltae_registers promises, for SymbiYosys (oltae_registers.sby): core_registers_checker, and the core's own registers CONFIG and TURN.
// Every input of the register file is free in every clock, but result_data (see the checker).
`resetall
`default_nettype none

module oltae_registers_properties #(
    parameter WEIGHTED = 1,
    parameter COVARIANCE = 1,
    parameter REAPPLY = 1,
    parameter MANTISSA = 35
) (
    input wire clk,
    input wire rst,
    input wire [11:0] s_axil_awaddr,
    input wire [2:0] s_axil_awprot,
    input wire s_axil_awvalid,
    input wire [31:0] s_axil_wdata,
    input wire [3:0] s_axil_wstrb,
    input wire s_axil_wvalid,
    input wire s_axil_bready,
    input wire [11:0] s_axil_araddr,
    input wire [2:0] s_axil_arprot,
    input wire s_axil_arvalid,
    input wire s_axil_rready,
    input wire push_ready,
    input wire push_open,
    input wire busy,
    input wire [2:0] state,
    input wire [2:0] ready,
    input wire [10:0] flag_set,
    input wire frame_start,
    input wire frame_complete,
    input wire [15:0] points,
    input wire [31:0] weight,
    input wire [1:0] turn,
    input wire [15:0] cycles_q,
    input wire [15:0] cycles_pose,
    input wire [15:0] cycles_all,
    input wire result_wait,
    input wire [31:0] result_data
);
  `include "oltae_registers.vh"

  wire s_axil_awready;
  wire s_axil_wready;
  wire [1:0] s_axil_bresp;
  wire s_axil_bvalid;
  wire s_axil_arready;
  wire [31:0] s_axil_rdata;
  wire [1:0] s_axil_rresp;
  wire s_axil_rvalid;
  wire soft_reset;
  wire acknowledge;
  wire [31:0] config_variance;
  wire push_valid;
  wire [63:0] push_data;
  wire push_last;
  wire result_valid;
  wire [5:0] result_index;
  wire irq;
  wire config_weighted;
  wire config_forbid_turns;
  wire config_reapply;
  wire config_covariance;
  wire [7:0] config_frac;

  // connected to registers by the script
  wire dut_address_full;
  wire dut_data_full;
  wire dut_issue;
  wire dut_capture;
  wire dut_read_failed;
  wire [11:0] dut_write_address;
  wire [11:0] dut_read_address;
  wire [31:0] dut_write_data;
  wire [31:0] dut_read_data;
  wire [31:0] dut_data_a;
  wire [31:0] dut_data_b;
  wire [3:0] dut_write_strobe;
  wire [10:0] dut_flags;
  wire [10:0] dut_frame_flags;
  wire [1:0] dut_irq_enable;
  wire [1:0] dut_irq_status;
  wire [15:0] dut_frame;
  wire dut_write_address_parity, dut_flags_differ, upset;
  wire [3:0] dut_write_parity, dut_variance_parity;
  wire [0:0] dut_frac_parity;

  oltae_registers #(
      .WEIGHTED(WEIGHTED),
      .COVARIANCE(COVARIANCE),
      .REAPPLY(REAPPLY),
      .MANTISSA(MANTISSA)
  ) dut (
      .clk(clk),
      .rst(rst),
      .s_axil_awaddr(s_axil_awaddr),
      .s_axil_awprot(s_axil_awprot),
      .s_axil_awvalid(s_axil_awvalid),
      .s_axil_wdata(s_axil_wdata),
      .s_axil_wstrb(s_axil_wstrb),
      .s_axil_wvalid(s_axil_wvalid),
      .s_axil_bready(s_axil_bready),
      .s_axil_araddr(s_axil_araddr),
      .s_axil_arprot(s_axil_arprot),
      .s_axil_arvalid(s_axil_arvalid),
      .s_axil_rready(s_axil_rready),
      .push_ready(push_ready),
      .push_open(push_open),
      .busy(busy),
      .state(state),
      .ready(ready),
      .flag_set(flag_set),
      .frame_start(frame_start),
      .frame_complete(frame_complete),
      .points(points),
      .weight(weight),
      .turn(turn),
      .cycles_q(cycles_q),
      .cycles_pose(cycles_pose),
      .cycles_all(cycles_all),
      .result_wait(result_wait),
      .result_data(result_data),
      .s_axil_awready(s_axil_awready),
      .s_axil_wready(s_axil_wready),
      .s_axil_bresp(s_axil_bresp),
      .s_axil_bvalid(s_axil_bvalid),
      .s_axil_arready(s_axil_arready),
      .s_axil_rdata(s_axil_rdata),
      .s_axil_rresp(s_axil_rresp),
      .s_axil_rvalid(s_axil_rvalid),
      .soft_reset(soft_reset),
      .acknowledge(acknowledge),
      .config_variance(config_variance),
      .push_valid(push_valid),
      .push_data(push_data),
      .push_last(push_last),
      .result_valid(result_valid),
      .result_index(result_index),
      .irq(irq),
      .upset(upset),
      .config_weighted(config_weighted),
      .config_forbid_turns(config_forbid_turns),
      .config_reapply(config_reapply),
      .config_covariance(config_covariance),
      .config_frac(config_frac)
  );

  wire write_now, checking;
  wire [11:2] write_at, read_at;
  wire [31:0] write_data, own_expected;
  wire [3:0] write_strobe;
  wire write_locked;
  wire [10:0] own_raised;

  core_registers_checker #(
      .ID(ID_RESET),
      .BUILD((WEIGHTED != 0) + 2 * (COVARIANCE != 0) + 4 * (REAPPLY != 0) + 8 + 256 * MANTISSA),
      .FLAGS(11),
      .FRACS(1),
      .COUNT_ADDRESS(POINTS_ADDRESS),
      .FIRST_ADDRESS(CYCLES_Q_ADDRESS),
      .MIDDLE_ADDRESS(CYCLES_POSE_ADDRESS),
      .RESULTS_ADDRESS(Q_ADDRESS)
  ) check (
      .clk(clk),
      .rst(rst),
      .s_axil_awaddr(s_axil_awaddr),
      .s_axil_awvalid(s_axil_awvalid),
      .s_axil_wdata(s_axil_wdata),
      .s_axil_wstrb(s_axil_wstrb),
      .s_axil_wvalid(s_axil_wvalid),
      .s_axil_bready(s_axil_bready),
      .s_axil_araddr(s_axil_araddr),
      .s_axil_arvalid(s_axil_arvalid),
      .s_axil_rready(s_axil_rready),
      .push_ready(push_ready),
      .push_open(push_open),
      .busy(busy),
      .state(state),
      .ready(ready),
      .s_axil_awready(s_axil_awready),
      .s_axil_wready(s_axil_wready),
      .s_axil_bresp(s_axil_bresp),
      .s_axil_bvalid(s_axil_bvalid),
      .s_axil_arready(s_axil_arready),
      .s_axil_rdata(s_axil_rdata),
      .s_axil_rresp(s_axil_rresp),
      .s_axil_rvalid(s_axil_rvalid),
      .soft_reset(soft_reset),
      .acknowledge(acknowledge),
      .config_variance(config_variance),
      .push_valid(push_valid),
      .push_data(push_data),
      .push_last(push_last),
      .result_valid(result_valid),
      .result_index(result_index),
      .irq(irq),
      .upset(upset),
      .config_frac(config_frac),
      .flag_set(flag_set),
      .frame_start(frame_start),
      .frame_complete(frame_complete),
      .weight(weight),
      .result_wait(result_wait),
      .result_data(result_data),
      .count(points),
      .cycles_first(cycles_q),
      .cycles_middle(cycles_pose),
      .cycles_last(cycles_all),
      .write_now(write_now),
      .write_at(write_at),
      .write_data(write_data),
      .write_strobe(write_strobe),
      .write_locked(write_locked),
      .own_raised(own_raised),
      .read_at(read_at),
      .own_expected(own_expected),
      .checking(checking),
      .write_mapped(is_mapped(write_at)),
      .read_mapped(is_mapped(read_at)),
      .dut_address_full(dut_address_full),
      .dut_data_full(dut_data_full),
      .dut_issue(dut_issue),
      .dut_capture(dut_capture),
      .dut_read_failed(dut_read_failed),
      .dut_write_address(dut_write_address),
      .dut_read_address(dut_read_address),
      .dut_write_data(dut_write_data),
      .dut_read_data(dut_read_data),
      .dut_data_a(dut_data_a),
      .dut_data_b(dut_data_b),
      .dut_write_strobe(dut_write_strobe),
      .dut_flags(dut_flags),
      .dut_frame_flags(dut_frame_flags),
      .dut_irq_enable(dut_irq_enable),
      .dut_irq_status(dut_irq_status),
      .dut_frame(dut_frame),
      .dut_write_address_parity(dut_write_address_parity),
      .dut_flags_differ(dut_flags_differ),
      .dut_write_parity(dut_write_parity),
      .dut_variance_parity(dut_variance_parity),
      .dut_frac_parity(dut_frac_parity)
  );

  // CONFIG: what is not built stays 0; asking for it raises NOT_BUILT, then and at every frame until CONFIG is written again
  localparam [3:0] BUILT = {COVARIANCE != 0, REAPPLY != 0, 1'b1, WEIGHTED != 0};
  wire [3:0] dut_configuration;
  wire dut_asked, dut_parity;
  wire to_config = write_now && {write_at, 2'd0} == CONFIG_ADDRESS;
  wire takes = to_config && write_strobe[0] && !busy;
  reg [3:0] configuration;
  reg asked, was_busy;
  wire asks = (write_data[3:0] & ~BUILT) != 4'd0;
  always @(posedge clk) begin
    if (takes) {configuration, asked} <= {write_data[3:0] & BUILT, asks};
    if (rst) {configuration, asked} <= {CONFIG_RESET[3:0] & BUILT, 1'b0};
    was_busy <= busy && !rst;
  end
  assign write_locked = busy && to_config;
  assign own_raised = {1'b0, (takes && asks) || (frame_start && asked), 9'd0};
  assign own_expected = {read_at, 2'd0} == CONFIG_ADDRESS ? {28'd0, configuration} : {read_at, 2'd0} == TURN_ADDRESS ? {30'd0, turn} : 32'd0;

  wire [3:0] config_pins = {config_covariance, config_reapply, config_forbid_turns, config_weighted};
  always @(posedge clk) if (checking) begin
    config_written : assert (config_pins == configuration && dut_asked == asked && dut_parity == ^{configuration, asked});
    config_built : assert ((config_pins & ~BUILT) == 4'd0);
    if (was_busy) config_locked : assert ($stable(config_pins));
  end
endmodule

`resetall
