// SPDX-License-Identifier: Apache-2.0
// Register file behind AXI4-Lite, the part that every core has: identity, control, status, flags, interrupt, binary points, variance, push
// register, what is latched of a frame, results. Addresses and bit positions come from the generated include file, those that go by
// another name in each core as parameters. A core's own registers stand beside it (oltae_registers, ivisnav_registers), on the ports
// `own_*`.
//
// Reading takes two clocks inside: groups of up to four registers, each a 4:1 multiplexer (one LUT6 a bit) into flip-flops that
// are 0 unless their group is addressed; then one OR of the groups and of the result memory into rdata. A write acts in the clock after
// both its halves have come; pulses out of it come one clock later, from flip-flops.
//
// Upsets: control and interrupt are voted; the flags have a twin; configuration has a parity bit a byte, made at the bus. What does not
// fit raises UPSET and `upset`: bad configuration in every clock until it is written again.
//
// clock    0     1     2     3      a flip at the end of clock 0
// value    v     v'    v'    v'
// upset                x     x      FLAGS.UPSET from clock 3
`resetall
`default_nettype none

module core_registers #(
    parameter [31:0] ID              = 32'd0,
    parameter [31:0] BUILD           = 32'd0,    // word of the BUILD register
    parameter        FLAGS           = 11,       // bits of FLAGS
    parameter        FRACS           = 1,        // binary points in FRAC, a byte each: 1 or 2
    parameter [11:0] COUNT_ADDRESS   = 12'h060,  // of `count`
    parameter [11:0] FIRST_ADDRESS   = 12'h06C,  // of `cycles_first`
    parameter [11:0] MIDDLE_ADDRESS  = 12'h070,  // of `cycles_middle`
    parameter [11:0] RESULTS_ADDRESS = 12'h100   // of the first result; a multiple of 256
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
    output reg  [8*FRACS-1:0] config_frac,
    output reg  [       31:0] config_variance,

    // push register, to frame_loader
    output wire        push_valid,
    output wire [63:0] push_data,
    output wire        push_last,
    input  wire        push_ready,
    input  wire        push_open,   // a push would be taken now or soon

    // status
    input wire       busy,
    input wire [2:0] state,
    input wire [2:0] ready,  // groups of results: last, middle, first

    // events, pulses
    input wire [FLAGS-1:0] flag_set,       // in the order of FLAGS; BUSY_WRITE is added here
    input wire             frame_start,
    input wire             frame_complete,

    // of the frame whose results stand
    input wire [15:0] count,
    input wire [31:0] weight,
    input wire [15:0] cycles_first,
    input wire [15:0] cycles_middle,
    input wire [15:0] cycles_last,

    // result_store
    output wire        result_valid,
    output wire [ 5:0] result_index,
    input  wire        result_wait,
    input  wire [31:0] result_data,

    // the core's own registers
    output wire        write_valid,   // one clock
    output wire [11:2] write_word,    // word address
    output wire [31:0] write_data,
    output wire [ 3:0] write_strobe,
    input  wire        write_mapped,  // write_word is one of the core's
    input  wire        own_locked,    // this write changes a locked register: BUSY_WRITE
    output wire        read_valid,
    output wire [11:2] read_word,
    input  wire        read_mapped,
    input  wire [31:0] own_data,      // one clock after read_valid of an own register; 0 in any other
    input  wire        own_upset,     // the core's own configuration has changed by itself

    output reg upset,  // something here cannot be trusted
    output reg irq
);

  `include "common_registers.vh"

  // ---- protocol

  wire read_wait, write_lost;
  wire [3:0] write_parity;
  wire [31:0] read_data;

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
      .write_parity(write_parity),
      .write_error(!write_mapped),
      .read_valid(read_valid),
      .read_word(read_word),
      .read_wait(read_wait),
      .read_error(!read_mapped),
      .read_data(read_data),
      .upset(write_lost)
  );

  // ---- write: all registers but the results lie in the first 32 words

  wire [FLAGS-1:0] flags, frame_flags;
  wire [1:0] irq_enable, irq_status;  // {error, done}
  wire [15:0] frame, next_frame;
  reg [15:1] frame_upper;
  reg [31:0] data_a, data_b;
  // odd parity of each byte
  reg [FRACS-1:0] frac_parity;
  reg [3:0] variance_parity;

  wire write_low = write_valid && write_word[11:7] == 5'd0;
  wire [4:0] to = write_word[6:2];
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
  wire push_locked = (push_waits && (to_data_a || to_data_b || to_push)) || (!push_open && to_push);
  wire locked = (busy && (to_frac || to_variance)) || push_locked || own_locked;

  // each binary point that the write would change, in -64..95: the top three bits are 11x, 00x or 010
  reg frac_fits;
  integer i;
  always @* begin
    frac_fits = 1'b1;
    for (i = 0; i < FRACS; i = i + 1)
      if (write_strobe[i] && (write_data[8*i+7] ? !write_data[8*i+6] : write_data[8*i+6] && write_data[8*i+5]))
        frac_fits = 1'b0;
  end

  reg [FLAGS-1:0] raised;
  always @* begin
    raised = flag_set;
    raised[FLAGS_BUSY_WRITE_LSB] = flag_set[FLAGS_BUSY_WRITE_LSB] || locked;
    raised[FLAGS_UPSET_LSB] = flag_set[FLAGS_UPSET_LSB] || upset;
  end

  // the strobed bits of a write of ones
  wire [FLAGS-1:0] ones = write_data[FLAGS-1:0] & {{FLAGS - 8{write_strobe[1]}}, {8{write_strobe[0]}}};

  wire flags_differ;
  twin_register #(
      .WIDTH(2 * FLAGS),
      .RESET({{FLAGS{1'b0}}, FLAGS_RESET[FLAGS-1:0]})
  ) flags_register (
      .clk(clk),
      .rst(rst),
      .load(1'b1),
      .d({(frame_flags & ~{FLAGS{frame_start}}) | raised, (flags & ~(ones & {FLAGS{to_flags}})) | raised}),
      .q({frame_flags, flags}),
      .differ(flags_differ)
  );

  wire push_taken = to_push && !push_locked;
  voted_register #(
      .WIDTH(4),
      .RESET(4'd0)
  ) control_register (
      .clk(clk),
      .rst(rst),
      .d({
        to_control && write_data[CONTROL_SOFT_RESET_LSB],
        to_control && write_data[CONTROL_ACKNOWLEDGE_LSB],
        push_taken || (push_valid && !push_ready && !soft_reset),
        push_taken ? write_data[PUSH_LAST_LSB] && write_strobe[0] : push_last
      }),
      .q({soft_reset, acknowledge, push_valid, push_last})
  );

  voted_register #(
      .WIDTH(5),
      .RESET({1'b0, IRQ_ENABLE_RESET[1:0], IRQ_STATUS_RESET[1:0]})
  ) event_register (
      .clk(clk),
      .rst(rst),
      .d({
        next_frame[0],
        to_irq_enable ? write_data[1:0] : irq_enable,
        (irq_status & ~(write_data[1:0] & {2{to_irq_status}})) | {|raised, frame_complete}
      }),
      .q({frame[0], irq_enable, irq_status})
  );

  // A driver waits for a frame's end and another number than before: with bit 0 voted no flip can bring the same number back.
  assign next_frame  = frame + {15'd0, frame_complete};
  assign frame[15:1] = frame_upper;
  always @(posedge clk) frame_upper <= rst ? 15'd0 : next_frame[15:1];

  wire config_odd;  // each byte and its parity are odd
  odd_ones #(
      .WIDTH(36 + 9 * FRACS)
  ) config_ones (
      .bits({config_variance, variance_parity, config_frac, frac_parity}),
      .odd (config_odd)
  );

  integer b;
  always @(posedge clk) begin
    for (b = 0; b < FRACS; b = b + 1)
      if (to_frac && write_strobe[b] && !busy && frac_fits) begin
        config_frac[8*b+:8] <= write_data[8*b+:8];
        frac_parity[b] <= write_parity[b];
      end
    for (b = 0; b < 4; b = b + 1) begin
      if (to_variance && write_strobe[b] && !busy) begin
        config_variance[8*b+:8] <= write_data[8*b+:8];
        variance_parity[b] <= write_parity[b];
      end
      if (to_data_a && write_strobe[b] && !push_waits) data_a[8*b+:8] <= write_data[8*b+:8];
      if (to_data_b && write_strobe[b] && !push_waits) data_b[8*b+:8] <= write_data[8*b+:8];
    end

    irq   <= |(irq_enable & irq_status);  // made anew in every clock: a flip is gone after one
    upset <= config_odd != FRACS[0] || flags_differ || own_upset || write_lost;

    if (rst) begin
      config_frac <= FRAC_RESET[8*FRACS-1:0];
      config_variance <= VARIANCE_RESET;
      data_a <= DATA_A_RESET;
      data_b <= DATA_B_RESET;
      for (b = 0; b < FRACS; b = b + 1) frac_parity[b] <= ~^FRAC_RESET[8*b+:8];
      for (b = 0; b < 4; b = b + 1) variance_parity[b] <= ~^VARIANCE_RESET[8*b+:8];
      irq   <= 1'b0;
      upset <= 1'b0;
    end
  end

  assign push_data = {data_b, data_a};

  // ---- read

  reg [31:0] status;
  always @* begin
    status = 32'd0;
    status[STATUS_STATE_LSB+:STATUS_STATE_WIDTH] = state;
    status[STATUS_BUSY_LSB] = busy;
    status[STATUS_ALL_READY_LSB-:3] = ready;
    status[STATUS_PUSH_READY_LSB] = push_open && !push_waits;
    status[STATUS_FRAME_LSB+:STATUS_FRAME_WIDTH] = frame;
  end

  wire read_low = read_valid && read_word[11:7] == 5'd0;
  wire [4:0] from = read_word[6:2];
  wire at_variance = from == VARIANCE_ADDRESS[6:2];
  wire at_data_a = from == DATA_A_ADDRESS[6:2];
  wire at_data_b = from == DATA_B_ADDRESS[6:2];
  wire at_weight = from == WEIGHT_ADDRESS[6:2];
  wire at_count = from == COUNT_ADDRESS[6:2];
  wire at_first = from == FIRST_ADDRESS[6:2];
  wire at_middle = from == MIDDLE_ADDRESS[6:2];
  wire at_last = from == CYCLES_ALL_ADDRESS[6:2];
  wire at_flags = from == FLAGS_ADDRESS[6:2];
  wire at_frame_flags = from == FRAME_FLAGS_ADDRESS[6:2];
  wire at_frac = from == FRAC_ADDRESS[6:2];
  wire at_irq_enable = from == IRQ_ENABLE_ADDRESS[6:2];
  wire at_irq_status = from == IRQ_STATUS_ADDRESS[6:2];

  wire [1:0] word_pick = {at_data_b || at_weight, at_data_a || at_weight};
  wire [1:0] count_pick = {at_middle || at_last, at_first || at_last};

  localparam BITS = FLAGS > 8 * FRACS ? FLAGS : 8 * FRACS;
  reg [31:0] words, constants, state_word;
  reg [15:0] counts;
  reg [BITS-1:0] bits;
  reg [1:0] few;

  always @(posedge clk) begin
    if (word_pick[1]) words <= word_pick[0] ? weight : data_b;
    else words <= word_pick[0] ? data_a : config_variance;
    if (!(read_low && (at_variance || at_data_a || at_data_b || at_weight))) words <= 32'd0;

    if (count_pick[1]) counts <= count_pick[0] ? cycles_last : cycles_middle;
    else counts <= count_pick[0] ? cycles_first : count;
    if (!(read_low && (at_count || at_first || at_middle || at_last))) counts <= 16'd0;

    bits <= {BITS{1'b0}};
    if (at_frac) bits[8*FRACS-1:0] <= config_frac;
    else bits[FLAGS-1:0] <= at_frame_flags ? frame_flags : flags;
    if (!(read_low && (at_flags || at_frame_flags || at_frac))) bits <= {BITS{1'b0}};

    few <= at_irq_status ? irq_status : irq_enable;
    if (!(read_low && (at_irq_enable || at_irq_status))) few <= 2'd0;

    state_word <= status;
    if (!(read_low && from == STATUS_ADDRESS[6:2])) state_word <= 32'd0;

    constants <= 32'd0;
    if (read_low && from == ID_ADDRESS[6:2]) constants <= ID;
    if (read_low && from == VERSION_ADDRESS[6:2]) constants <= VERSION_RESET;
    if (read_low && from == BUILD_ADDRESS[6:2]) constants <= BUILD;
  end

  assign result_valid = read_valid && read_mapped && read_word[11:8] == RESULTS_ADDRESS[11:8];
  assign result_index = read_word[7:2];
  assign read_wait = result_valid && result_wait;
  assign read_data = words | constants | state_word | result_data | own_data |
                     {16'b0, counts} | {{32 - BITS{1'b0}}, bits} | {30'b0, few};

endmodule

`resetall
