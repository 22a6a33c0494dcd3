// SPDX-License-Identifier: Apache-2.0
// Register file of oltae_top. The map is registers/oltae.rdl (page: docs/registers-oltae.md). Here: CONFIG (with parity), TURN and the flag
// NOT_BUILT; all else is core_registers, whose timing this follows.
`resetall
`default_nettype none

module oltae_registers #(
    parameter WEIGHTED = 1,    // what this core was built with: BUILD, and which bits CONFIG has
    parameter COVARIANCE = 1,
    parameter REAPPLY = 1,
    parameter VERIFY = 1,
    parameter MANTISSA = 35    // bits, for BUILD
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
    output wire        config_weighted,
    output wire        config_forbid_turns,
    output wire        config_reapply,
    output wire        config_covariance,
    output wire [ 7:0] config_frac,
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
    input wire [2:0] ready,  // all, pose, q

    // events, pulses
    input wire [10:0] flag_set,       // in the order of FLAGS; BUSY_WRITE, NOT_BUILT and UPSET of this file are added here
    input wire        frame_start,
    input wire        frame_complete,

    // of the frame whose results stand
    input wire [15:0] points,
    input wire [31:0] weight,
    input wire [ 1:0] turn,
    input wire [15:0] cycles_q,
    input wire [15:0] cycles_pose,
    input wire [15:0] cycles_all,

    // result_store
    output wire        result_valid,
    output wire [ 5:0] result_index,
    input  wire        result_wait,
    input  wire [31:0] result_data,

    output wire upset,  // something here cannot be trusted: core_registers
    output wire irq
);

  `include "oltae_registers.vh"

  localparam FLAGS = 11;
  localparam [3:0] BUILT = {COVARIANCE != 0, REAPPLY != 0, 1'b1, WEIGHTED != 0};  // bits of CONFIG

  localparam [31:0] BUILD = {31'd0, WEIGHTED != 0} << BUILD_WEIGHTED_LSB | {31'd0, COVARIANCE != 0} << BUILD_COVARIANCE_LSB |
                            {31'd0, REAPPLY != 0} << BUILD_REAPPLY_LSB | {31'd0, VERIFY != 0} << BUILD_VERIFY_LSB |
                            MANTISSA << BUILD_MANTISSA_LSB;

  // ---- write

  wire write_valid, read_valid;
  wire [11:2] write_word, read_word;
  /* verilator lint_off UNUSEDSIGNAL */
  wire [31:0] write_data;
  wire [3:0] write_strobe;
  /* verilator lint_on UNUSEDSIGNAL */

  reg [3:0] configuration;
  reg asked;  // CONFIG was last asked for something that is not built
  reg parity;  // makes these five and itself an even number of ones

  wire to_config = write_valid && write_word == CONFIG_ADDRESS[11:2];
  wire set_config = to_config && write_strobe[0] && !busy;
  wire [3:0] given = write_data[3:0] & BUILT;
  wire asks = |(write_data[3:0] & ~BUILT);

  reg [FLAGS-1:0] raised;
  always @* begin
    raised = flag_set;
    raised[FLAGS_NOT_BUILT_LSB] = flag_set[FLAGS_NOT_BUILT_LSB] || (set_config && asks) || (frame_start && asked);
  end

  always @(posedge clk) begin
    if (set_config) begin
      configuration <= given;
      asked <= asks;
      parity <= ^{given, asks};
    end
    if (rst) begin
      configuration <= CONFIG_RESET[3:0] & BUILT;
      asked <= 1'b0;
      parity <= ^(CONFIG_RESET[3:0] & BUILT);
    end
  end

  assign config_weighted = configuration[CONFIG_WEIGHTED_LSB];
  assign config_forbid_turns = configuration[CONFIG_FORBID_TURNS_LSB];
  assign config_reapply = configuration[CONFIG_REAPPLY_LSB];
  assign config_covariance = configuration[CONFIG_COVARIANCE_LSB];

  // ---- read

  wire at_config = read_word == CONFIG_ADDRESS[11:2];
  wire at_turn = read_word == TURN_ADDRESS[11:2];
  reg [3:0] own;
  always @(posedge clk) begin
    own <= at_turn ? {2'd0, turn} : configuration;
    if (!(read_valid && (at_config || at_turn))) own <= 4'd0;
  end

  core_registers #(
      .ID(ID_RESET),
      .BUILD(BUILD),
      .FLAGS(FLAGS),
      .FRACS(1),
      .COUNT_ADDRESS(POINTS_ADDRESS),
      .FIRST_ADDRESS(CYCLES_Q_ADDRESS),
      .MIDDLE_ADDRESS(CYCLES_POSE_ADDRESS),
      .RESULTS_ADDRESS(Q_ADDRESS)
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
      .config_frac(config_frac),
      .config_variance(config_variance),
      .push_valid(push_valid),
      .push_data(push_data),
      .push_last(push_last),
      .push_ready(push_ready),
      .push_open(push_open),
      .busy(busy),
      .state(state),
      .ready(ready),
      .flag_set(raised),
      .frame_start(frame_start),
      .frame_complete(frame_complete),
      .count(points),
      .weight(weight),
      .cycles_first(cycles_q),
      .cycles_middle(cycles_pose),
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
      .own_locked(busy && to_config),
      .read_valid(read_valid),
      .read_word(read_word),
      .read_mapped(is_mapped(read_word)),
      .own_data({28'd0, own}),
      .own_upset(^{configuration, asked, parity}),
      .upset(upset),
      .irq(irq)
  );

endmodule

`resetall
