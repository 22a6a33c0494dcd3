// SPDX-License-Identifier: Apache-2.0
// What the register file promises on the bus and to the core, for both cores (oltae_registers.sby, ivisnav_registers.sby).
//
// A model of the register map, written from its description: accesses are found at the pins of the bus (a write acts in the clock after
// both its halves have come and the answer before it has gone, a read in the clock after its address, later while result_wait is high);
// `same_*` tie the model to the registers themselves (`dut_*`, connected by the script), only to make the induction short.
// A core's own registers are modelled by what instantiates this: of `write_at` and `read_at` it says whether the word is mapped, whether
// a write there is locked, which flags it raises and what a read there gives.
`resetall
`default_nettype none

module core_registers_checker #(
    parameter [31:0] ID              = 32'd0,
    parameter [31:0] BUILD           = 32'd0,
    parameter        FLAGS           = 11,
    parameter        FRACS           = 1,
    parameter [11:0] COUNT_ADDRESS   = 12'h060,
    parameter [11:0] FIRST_ADDRESS   = 12'h06C,
    parameter [11:0] MIDDLE_ADDRESS  = 12'h070,  // = FIRST_ADDRESS: none
    parameter [11:0] RESULTS_ADDRESS = 12'h100
) (
    input wire clk,
    input wire rst,

    // pins
    input wire [11:0] s_axil_awaddr,
    input wire        s_axil_awvalid,
    input wire        s_axil_awready,
    input wire [31:0] s_axil_wdata,
    input wire [ 3:0] s_axil_wstrb,
    input wire        s_axil_wvalid,
    input wire        s_axil_wready,
    input wire [ 1:0] s_axil_bresp,
    input wire        s_axil_bvalid,
    input wire        s_axil_bready,
    input wire [11:0] s_axil_araddr,
    input wire        s_axil_arvalid,
    input wire        s_axil_arready,
    input wire [31:0] s_axil_rdata,
    input wire [ 1:0] s_axil_rresp,
    input wire        s_axil_rvalid,
    input wire        s_axil_rready,
    input wire        soft_reset,
    input wire        acknowledge,
    input wire [8*FRACS-1:0] config_frac,
    input wire [31:0] config_variance,
    input wire        push_valid,
    input wire [63:0] push_data,
    input wire        push_last,
    input wire        push_ready,
    input wire        push_open,
    input wire        busy,
    input wire [ 2:0] state,
    input wire [ 2:0] ready,
    input wire [FLAGS-1:0] flag_set,
    input wire        frame_start,
    input wire        frame_complete,
    input wire [15:0] count,
    input wire [31:0] weight,
    input wire [15:0] cycles_first,
    input wire [15:0] cycles_middle,
    input wire [15:0] cycles_last,
    input wire        result_valid,
    input wire [ 5:0] result_index,
    input wire        result_wait,
    input wire [31:0] result_data,
    input wire        irq,

    // the core's own registers
    output wire        write_now,     // an aligned write acts in this clock
    output wire [11:2] write_at,
    output wire [31:0] write_data,
    output wire [ 3:0] write_strobe,
    input  wire        write_mapped,
    input  wire        write_locked,
    input  wire [FLAGS-1:0] own_raised,
    output wire [11:2] read_at,
    input  wire        read_mapped,
    input  wire [31:0] own_expected,  // what an own register at read_at holds, 0 elsewhere
    output wire        checking,      // there has been a clock edge

    // registers of the slave and of the file
    input wire dut_address_full, dut_data_full, dut_issue, dut_capture, dut_read_failed,
    input wire [11:0] dut_write_address, dut_read_address,
    input wire [31:0] dut_write_data, dut_read_data, dut_data_a, dut_data_b,
    input wire [ 3:0] dut_write_strobe,
    input wire [FLAGS-1:0] dut_flags, dut_frame_flags,
    input wire [ 1:0] dut_irq_enable, dut_irq_status,
    input wire [15:0] dut_frame,
    input wire dut_write_address_parity, dut_flags_differ, upset,
    input wire [ 3:0] dut_write_parity, dut_variance_parity,
    input wire [FRACS-1:0] dut_frac_parity
);
  `include "common_registers.vh"

  reg started = 1'b0, was_reset = 1'b1;
  always @(posedge clk) {started, was_reset} <= {1'b1, rst};
  always @* if (!started) assume (rst);
  assign checking = started;

  // parity of each byte
  function [3:0] odd(input [31:0] word);
    odd = {^word[31:24], ^word[23:16], ^word[15:8], ^word[7:0]};
  endfunction

  // ---- accesses, from the pins

  reg address_waits, data_waits;
  reg [11:0] address;
  reg [31:0] data;
  reg [ 3:0] strobe;
  wire acts = address_waits && data_waits && !s_axil_bvalid;
  assign write_now = acts && address[1:0] == 2'd0;
  assign write_at = address[11:2];
  assign write_data = data;
  assign write_strobe = strobe;

  always @(posedge clk) begin
    if (s_axil_awvalid && s_axil_awready) address <= s_axil_awaddr;
    if (s_axil_wvalid && s_axil_wready) {data, strobe} <= {s_axil_wdata, s_axil_wstrb};
    address_waits <= !rst && !acts && (address_waits || (s_axil_awvalid && s_axil_awready));
    data_waits <= !rst && !acts && (data_waits || (s_axil_wvalid && s_axil_wready));
  end

  reg asked, fetch, answer;  // read accepted; accessed in the clock before; answered
  reg [11:0] from;
  assign read_at = from[11:2];
  wire reads = from[1:0] == 2'd0 && read_mapped;  // something
  wire at_result = reads && from[11:8] == RESULTS_ADDRESS[11:8];
  wire access = asked && !(at_result && result_wait);
  reg [31:0] expected;
  reg expect_failed, fetch_result;
  wire [31:0] expected_now = fetch_result ? result_data : expected;
  reg [31:0] expected_answer;
  reg expected_failed;

  always @(posedge clk) begin
    if (s_axil_arvalid && s_axil_arready) from <= s_axil_araddr;
    asked <= !rst && (asked ? !access : s_axil_arvalid && s_axil_arready);
    fetch <= !rst && access;
    fetch_result <= access && at_result;
    answer <= !rst && (fetch || (answer && !s_axil_rready));
    if (access) expect_failed <= !reads;
    if (fetch) expected_answer <= expected_now;
  end

  // result_store: 0 in every clock but that after a read
  always @* if (started && !fetch_result) assume (result_data == 32'd0);

  // ---- the registers

  reg [8*FRACS-1:0] frac;
  reg [31:0] variance, data_a, data_b;
  reg [FLAGS-1:0] flags, frame_flags;
  reg [1:0] enable, status;
  reg [15:0] frame;
  reg waits_push, last_push, level, resets, acknowledges;

  wire push_held = waits_push && !push_ready;
  wire to_push = write_now && {write_at, 2'd0} == PUSH_ADDRESS;
  wire to_a = write_now && {write_at, 2'd0} == DATA_A_ADDRESS;
  wire to_b = write_now && {write_at, 2'd0} == DATA_B_ADDRESS;
  wire to_frac = write_now && {write_at, 2'd0} == FRAC_ADDRESS;
  wire to_variance = write_now && {write_at, 2'd0} == VARIANCE_ADDRESS;
  wire push_refused = (push_held && (to_push || to_a || to_b)) || (to_push && !push_open);
  wire refused = push_refused || (busy && (to_frac || to_variance)) || write_locked;
  wire [31:0] mask = {{8{strobe[3]}}, {8{strobe[2]}}, {8{strobe[1]}}, {8{strobe[0]}}};
  wire [31:0] written = data & mask;
  wire [FLAGS-1:0] raised = flag_set | own_raised | ({{FLAGS - 1{1'b0}}, refused} << FLAGS_BUSY_WRITE_LSB);

  // every point that the write changes lies in -64 .. 95
  reg fits;
  integer f;
  always @* begin
    fits = 1'b1;
    for (f = 0; f < FRACS; f = f + 1)
      if (strobe[f] && ($signed(data[8*f+:8]) < -64 || $signed(data[8*f+:8]) > 95)) fits = 1'b0;
  end

  integer i;
  always @(posedge clk) begin
    if (to_frac && !busy && fits) frac <= (frac & ~mask[8*FRACS-1:0]) | written[8*FRACS-1:0];
    if (to_variance && !busy) variance <= (variance & ~mask) | written;
    if (to_a && !push_held) data_a <= (data_a & ~mask) | written;
    if (to_b && !push_held) data_b <= (data_b & ~mask) | written;
    if (to_push && !push_refused) {waits_push, last_push} <= {1'b1, written[PUSH_LAST_LSB]};
    else if (push_ready || resets) waits_push <= 1'b0;
    for (i = 0; i < FLAGS; i = i + 1) begin
      if (raised[i]) flags[i] <= 1'b1;
      else if (write_now && {write_at, 2'd0} == FLAGS_ADDRESS && written[i]) flags[i] <= 1'b0;
      if (raised[i]) frame_flags[i] <= 1'b1;
      else if (frame_start) frame_flags[i] <= 1'b0;
    end
    if (write_now && {write_at, 2'd0} == IRQ_ENABLE_ADDRESS && strobe[0]) enable <= data[1:0];
    if (frame_complete) status[IRQ_STATUS_DONE_LSB] <= 1'b1;
    else if (write_now && {write_at, 2'd0} == IRQ_STATUS_ADDRESS && written[IRQ_STATUS_DONE_LSB]) status[IRQ_STATUS_DONE_LSB] <= 1'b0;
    if (raised != 0) status[IRQ_STATUS_ERROR_LSB] <= 1'b1;
    else if (write_now && {write_at, 2'd0} == IRQ_STATUS_ADDRESS && written[IRQ_STATUS_ERROR_LSB]) status[IRQ_STATUS_ERROR_LSB] <= 1'b0;
    level <= (enable[0] && status[0]) || (enable[1] && status[1]);
    resets <= write_now && {write_at, 2'd0} == CONTROL_ADDRESS && written[CONTROL_SOFT_RESET_LSB];
    acknowledges <= write_now && {write_at, 2'd0} == CONTROL_ADDRESS && written[CONTROL_ACKNOWLEDGE_LSB];
    if (frame_complete) frame <= frame + 16'd1;
    if (rst) begin
      {frac, variance, data_a, data_b, flags, frame_flags, enable, status, frame} <= 0;
      {waits_push, level, resets, acknowledges} <= 4'd0;
    end
  end

  // ---- what a read gives

  always @(posedge clk) if (access) begin
    expected <= 32'd0;
    if (reads)
      case ({read_at, 2'd0})
        ID_ADDRESS: expected <= ID;
        VERSION_ADDRESS: expected <= VERSION_RESET;
        BUILD_ADDRESS: expected <= BUILD;
        CONTROL_ADDRESS: expected <= 32'd0;
        STATUS_ADDRESS: expected <= {frame, 7'd0, push_open && !push_held, ready, busy, 1'b0, state};
        FLAGS_ADDRESS: expected <= {{32 - FLAGS{1'b0}}, flags};
        FRAME_FLAGS_ADDRESS: expected <= {{32 - FLAGS{1'b0}}, frame_flags};
        IRQ_ENABLE_ADDRESS: expected <= {30'd0, enable};
        IRQ_STATUS_ADDRESS: expected <= {30'd0, status};
        FRAC_ADDRESS: expected <= {{32 - 8 * FRACS{1'b0}}, frac};
        VARIANCE_ADDRESS: expected <= variance;
        DATA_A_ADDRESS: expected <= data_a;
        DATA_B_ADDRESS: expected <= data_b;
        PUSH_ADDRESS: expected <= 32'd0;
        COUNT_ADDRESS: expected <= {16'd0, count};
        WEIGHT_ADDRESS: expected <= weight;
        FIRST_ADDRESS: expected <= {16'd0, cycles_first};
        MIDDLE_ADDRESS: expected <= {16'd0, cycles_middle};
        CYCLES_ALL_ADDRESS: expected <= {16'd0, cycles_last};
        default: expected <= own_expected;
      endcase
  end

  // ---- promises

  reg was_write, was_bad, was_held, was_b, was_r, was_busy;
  always @(posedge clk) begin
    was_write <= acts;
    was_bad <= !(address[1:0] == 2'd0 && write_mapped);
    was_held <= waits_push && !push_ready && !resets && !rst;
    was_b <= s_axil_bvalid && !s_axil_bready && !rst;
    was_r <= s_axil_rvalid && !s_axil_rready && !rst;
    was_busy <= busy && !rst;
  end

  always @(posedge clk) if (started) begin
    // answers
    if (was_write && !was_reset) write_answer : assert (s_axil_bvalid && s_axil_bresp == {was_bad, 1'b0});
    if (was_b) b_stays : assert (s_axil_bvalid && $stable(s_axil_bresp));
    read_answer_due : assert (s_axil_rvalid == answer);
    if (s_axil_rvalid) read_returns : assert (s_axil_rdata == expected_answer);
    if (s_axil_rvalid) read_error : assert (s_axil_rresp == {expect_failed, 1'b0});
    if (was_r) r_stays : assert (s_axil_rvalid && $stable(s_axil_rdata) && $stable(s_axil_rresp));
    results_asked : assert (result_valid == (asked && at_result));
    if (result_valid) result_place : assert (result_index == read_at[7:2]);
    // what was written is what the core sees
    frac_written : assert (config_frac == frac);
    variance_written : assert (config_variance == variance);
    if (was_busy) locked_while_busy : assert ($stable(config_frac) && $stable(config_variance));
    control_pulses : assert (soft_reset == resets && acknowledge == acknowledges);
    push_written : assert (push_valid == waits_push && push_data == {data_b, data_a});
    if (push_valid) push_last_written : assert (push_last == last_push);
    if (was_held) push_stays : assert (push_valid && $stable(push_data) && $stable(push_last));
    // write 1 to clear; what rises in the same clock stays
    flags_right : assert (dut_flags == flags);
    frame_flags_right : assert (dut_frame_flags == frame_flags);
    irq_right : assert (dut_irq_enable == enable && dut_irq_status == status);
    irq_level : assert (irq == level);
    frame_counted : assert (dut_frame == frame);
    // the model is the registers
    same_bus : assert (dut_address_full == address_waits && dut_data_full == data_waits && dut_issue == asked && dut_capture == fetch);
    if (address_waits) same_address : assert (dut_write_address == address && dut_write_address_parity == ^address);
    if (data_waits) same_data : assert (dut_write_data == data && dut_write_strobe == strobe && dut_write_parity == (odd(data) ^ strobe));
    if (asked || fetch || answer) same_read : assert (dut_read_address == from);
    one_stage : assert (asked + fetch + answer <= 1);
    if (fetch || answer) same_failed : assert (dut_read_failed == expect_failed);
    if (fetch) same_fetched : assert (dut_read_data == expected_now);
    same_words : assert (dut_data_a == data_a && dut_data_b == data_b);
    same_parity : assert (dut_variance_parity == ~odd(variance) &&
                          {dut_frac_parity, {4 - FRACS{1'b1}}} == ~odd({frac, {32 - 8 * FRACS{1'b0}}}) && !dut_flags_differ);
    // nothing was upset
    no_false_alarm : assert (!upset);
  end
endmodule

`resetall
