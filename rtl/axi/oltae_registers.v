// SPDX-License-Identifier: Apache-2.0
// Register file of oltae_top behind AXI4-Lite. The map is registers/oltae.rdl (page: docs/registers-oltae.md); addresses and bit positions
// come from the generated include file.
//
// Reading takes two clocks inside: groups of up to four registers, each a 4:1 multiplexer (one LUT6 a bit) into flip-flops that
// are 0 unless their group is addressed; then one OR of the groups and of the result memory into rdata. A write acts in the clock after
// both its halves have come; pulses out of it come one clock later, in flip-flops.
`resetall
`default_nettype none

module oltae_registers #(
    parameter WEIGHTED = 1,    // what this core was built with: BUILD, and which bits CONFIG has
    parameter COVARIANCE = 1,
    parameter REAPPLY = 1,
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
    output reg soft_reset,   // pulses
    output reg acknowledge,

    // configuration; changes only while !busy
    output wire        config_weighted,
    output wire        config_forbid_turns,
    output wire        config_reapply,
    output wire        config_covariance,
    output reg  [ 7:0] config_frac,
    output reg  [31:0] config_variance,

    // push register, to frame_loader
    output reg         push_valid,
    output wire [63:0] push_data,
    output reg         push_last,
    input  wire        push_ready,
    input  wire        push_open,   // a push would be taken now or soon

    // status
    input wire       busy,
    input wire [2:0] state,
    input wire       q_ready,
    input wire       pose_ready,
    input wire       all_ready,

    // events, pulses
    input wire [9:0] flag_set,        // in the order of FLAGS; the register file adds BUSY_WRITE and NOT_BUILT itself
    input wire       frame_start,
    input wire       frame_complete,

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

    output reg irq
);

  `include "oltae_registers.vh"

  localparam FLAGS = 10;
  localparam [3:0] BUILT = {COVARIANCE != 0, REAPPLY != 0, 1'b1, WEIGHTED != 0};  // bits of CONFIG

  // ---- protocol

  wire write_valid, write_error, read_valid, read_wait, read_error;
  wire [11:2] write_word, read_word;
  wire [31:0] write_data, read_data;
  wire [3:0] write_strobe;

  axil_slave #(
      .ADDRESS(12)
  ) slave (
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
      .write_valid(write_valid),
      .write_word(write_word),
      .write_data(write_data),
      .write_strobe(write_strobe),
      .write_error(write_error),
      .read_valid(read_valid),
      .read_word(read_word),
      .read_wait(read_wait),
      .read_error(read_error),
      .read_data(read_data)
  );

  assign write_error = !is_mapped(write_word);
  assign read_error  = !is_mapped(read_word);

  // ---- write: all registers but the results lie in the first 32 words

  reg [FLAGS-1:0] flags, frame_flags;
  reg [1:0] irq_enable, irq_status;  // {error, done}
  reg [3:0] configuration;
  reg [31:0] data_a, data_b;
  reg [15:0] frame;

  wire write_low = write_valid && write_word[11:7] == 5'd0;
  wire [4:0] to = write_word[6:2];
  wire to_config = write_low && to == CONFIG_ADDRESS[6:2];
  wire to_frac = write_low && to == FRAC_ADDRESS[6:2];
  wire to_variance = write_low && to == VARIANCE_ADDRESS[6:2];
  wire to_data_a = write_low && to == DATA_A_ADDRESS[6:2];
  wire to_data_b = write_low && to == DATA_B_ADDRESS[6:2];
  wire to_push = write_low && to == PUSH_ADDRESS[6:2];
  wire to_control = write_low && to == CONTROL_ADDRESS[6:2] && write_strobe[0];
  wire to_flags = write_low && to == FLAGS_ADDRESS[6:2];
  wire to_irq_enable = write_low && to == IRQ_ENABLE_ADDRESS[6:2] && write_strobe[0];
  wire to_irq_status = write_low && to == IRQ_STATUS_ADDRESS[6:2] && write_strobe[0];

  wire push_waits = push_valid && !push_ready;  // push_data must stay
  wire locked = (busy && (to_config || to_frac || to_variance)) ||
                (push_waits && (to_data_a || to_data_b || to_push)) || (!push_open && to_push);

  // -64..95: the top three bits are 11x, 00x or 010
  wire frac_fits = write_data[7] ? write_data[6] : !(write_data[6] && write_data[5]);

  wire asks = |(write_data[3:0] & ~BUILT);
  wire set_config = to_config && write_strobe[0] && !busy;
  reg asked;  // CONFIG was last asked for something that is not built

  reg [FLAGS-1:0] raised;
  always @* begin
    raised = flag_set;
    raised[FLAGS_BUSY_WRITE_LSB] = flag_set[FLAGS_BUSY_WRITE_LSB] || locked;
    raised[FLAGS_NOT_BUILT_LSB] = flag_set[FLAGS_NOT_BUILT_LSB] || (set_config && asks) || (frame_start && asked);
  end

  // the strobed bits of a write of ones
  wire [FLAGS-1:0] ones = write_data[FLAGS-1:0] & {{FLAGS - 8{write_strobe[1]}}, {8{write_strobe[0]}}};

  integer i;
  always @(posedge clk) begin
    soft_reset  <= to_control && write_data[CONTROL_SOFT_RESET_LSB];
    acknowledge <= to_control && write_data[CONTROL_ACKNOWLEDGE_LSB];

    if (set_config) begin
      configuration <= write_data[3:0] & BUILT;
      asked <= asks;
    end
    if (to_frac && write_strobe[0] && !busy && frac_fits) config_frac <= write_data[7:0];
    for (i = 0; i < 4; i = i + 1) begin
      if (to_variance && write_strobe[i] && !busy) config_variance[8*i+:8] <= write_data[8*i+:8];
      if (to_data_a && write_strobe[i] && !push_waits) data_a[8*i+:8] <= write_data[8*i+:8];
      if (to_data_b && write_strobe[i] && !push_waits) data_b[8*i+:8] <= write_data[8*i+:8];
    end

    if (to_push && !locked) begin
      push_valid <= 1'b1;
      push_last  <= write_data[PUSH_LAST_LSB] && write_strobe[0];
    end else if (push_ready || soft_reset) begin
      push_valid <= 1'b0;
    end

    flags <= (flags & ~(ones & {FLAGS{to_flags}})) | raised;
    frame_flags <= (frame_flags & ~{FLAGS{frame_start}}) | raised;
    if (to_irq_enable) irq_enable <= write_data[1:0];
    irq_status <= (irq_status & ~(write_data[1:0] & {2{to_irq_status}})) | {|raised, frame_complete};
    irq <= |(irq_enable & irq_status);
    if (frame_complete) frame <= frame + 16'd1;

    if (rst) begin
      soft_reset <= 1'b0;
      acknowledge <= 1'b0;
      configuration <= CONFIG_RESET[3:0] & BUILT;
      asked <= 1'b0;
      config_frac <= FRAC_RESET[7:0];
      config_variance <= VARIANCE_RESET;
      data_a <= DATA_A_RESET;
      data_b <= DATA_B_RESET;
      push_valid <= 1'b0;
      flags <= FLAGS_RESET[FLAGS-1:0];
      frame_flags <= {FLAGS{1'b0}};
      irq_enable <= IRQ_ENABLE_RESET[1:0];
      irq_status <= IRQ_STATUS_RESET[1:0];
      irq <= 1'b0;
      frame <= 16'd0;
    end
  end

  assign push_data = {data_b, data_a};
  assign config_weighted = configuration[CONFIG_WEIGHTED_LSB];
  assign config_forbid_turns = configuration[CONFIG_FORBID_TURNS_LSB];
  assign config_reapply = configuration[CONFIG_REAPPLY_LSB];
  assign config_covariance = configuration[CONFIG_COVARIANCE_LSB];

  // ---- read

  reg [31:0] status, build;
  always @* begin
    build = 32'd0;
    build[BUILD_WEIGHTED_LSB] = WEIGHTED != 0;
    build[BUILD_COVARIANCE_LSB] = COVARIANCE != 0;
    build[BUILD_REAPPLY_LSB] = REAPPLY != 0;
    build[BUILD_MANTISSA_LSB+:BUILD_MANTISSA_WIDTH] = MANTISSA[BUILD_MANTISSA_WIDTH-1:0];

    status = 32'd0;
    status[STATUS_STATE_LSB+:STATUS_STATE_WIDTH] = state;
    status[STATUS_BUSY_LSB] = busy;
    status[STATUS_Q_READY_LSB] = q_ready;
    status[STATUS_POSE_READY_LSB] = pose_ready;
    status[STATUS_ALL_READY_LSB] = all_ready;
    status[STATUS_PUSH_READY_LSB] = push_open && !push_waits;
    status[STATUS_FRAME_LSB+:STATUS_FRAME_WIDTH] = frame;
  end

  wire read_low = read_valid && read_word[11:7] == 5'd0;
  wire [4:0] from = read_word[6:2];
  wire at_variance = from == VARIANCE_ADDRESS[6:2];
  wire at_data_a = from == DATA_A_ADDRESS[6:2];
  wire at_data_b = from == DATA_B_ADDRESS[6:2];
  wire at_weight = from == WEIGHT_ADDRESS[6:2];
  wire at_points = from == POINTS_ADDRESS[6:2];
  wire at_cycles_q = from == CYCLES_Q_ADDRESS[6:2];
  wire at_cycles_pose = from == CYCLES_POSE_ADDRESS[6:2];
  wire at_cycles_all = from == CYCLES_ALL_ADDRESS[6:2];
  wire at_flags = from == FLAGS_ADDRESS[6:2];
  wire at_frame_flags = from == FRAME_FLAGS_ADDRESS[6:2];
  wire at_config = from == CONFIG_ADDRESS[6:2];
  wire at_frac = from == FRAC_ADDRESS[6:2];
  wire at_irq_enable = from == IRQ_ENABLE_ADDRESS[6:2];
  wire at_irq_status = from == IRQ_STATUS_ADDRESS[6:2];
  wire at_turn = from == TURN_ADDRESS[6:2];

  wire [1:0] word_pick = {at_data_b || at_weight, at_data_a || at_weight};
  wire [1:0] count_pick = {at_cycles_pose || at_cycles_all, at_cycles_q || at_cycles_all};
  wire [1:0] bits_pick = {at_config || at_frac, at_frame_flags || at_frac};
  wire [1:0] few_pick = {at_turn, at_irq_status};

  reg [31:0] words, constants, state_word;
  reg [15:0] counts;
  reg [FLAGS-1:0] bits;
  reg [1:0] few;

  always @(posedge clk) begin
    if (word_pick[1]) words <= word_pick[0] ? weight : data_b;
    else words <= word_pick[0] ? data_a : config_variance;
    if (!(read_low && (at_variance || at_data_a || at_data_b || at_weight))) words <= 32'd0;

    if (count_pick[1]) counts <= count_pick[0] ? cycles_all : cycles_pose;
    else counts <= count_pick[0] ? cycles_q : points;
    if (!(read_low && (at_points || at_cycles_q || at_cycles_pose || at_cycles_all))) counts <= 16'd0;

    if (bits_pick[1]) bits <= bits_pick[0] ? {2'b0, config_frac} : {6'b0, configuration};
    else bits <= bits_pick[0] ? frame_flags : flags;
    if (!(read_low && (at_flags || at_frame_flags || at_config || at_frac))) bits <= {FLAGS{1'b0}};

    few <= few_pick[1] ? turn : few_pick[0] ? irq_status : irq_enable;
    if (!(read_low && (at_irq_enable || at_irq_status || at_turn))) few <= 2'd0;

    state_word <= status;
    if (!(read_low && from == STATUS_ADDRESS[6:2])) state_word <= 32'd0;

    constants <= 32'd0;
    if (read_low && from == ID_ADDRESS[6:2]) constants <= ID_RESET;
    if (read_low && from == VERSION_ADDRESS[6:2]) constants <= VERSION_RESET;
    if (read_low && from == BUILD_ADDRESS[6:2]) constants <= build;
  end

  assign result_valid = read_valid && !read_error && read_word[11:8] == Q_ADDRESS[11:8];
  assign result_index = read_word[7:2];
  assign read_wait = result_valid && result_wait;
  assign read_data = words | constants | state_word | result_data |
                     {16'b0, counts} | {{32 - FLAGS{1'b0}}, bits} | {30'b0, few};

endmodule

`resetall
