// SPDX-License-Identifier: Apache-2.0
// AXI4-Lite slave, protocol half: turns the five channels into one-clock register accesses.
//
// One write and one read at a time; the two are independent. Address and data of a write may come in either order or together.
// No output depends on an input of the same clock: every s_axil_* output comes from flip-flops alone, so valid cannot wait for ready and
// cannot fall, nor can its payload change, before the handshake. ready is low in reset, so nothing is lost there.
//
// Write     clock  0 both handshakes  1 write_valid, address/data/strobe, write_error read  2 bvalid
// Read      clock  0 handshake  1.. read_valid and address until read_wait is 0, read_error read  then read_data read  then rvalid
// Throughput: one write in 2 clocks, one read in 4, with a master that never waits.
//
// A misaligned address raises no *_valid. It and *_error answer SLVERR; read_data must be 0 then (nothing selected).
//
// Upsets: what the handshakes hang on is voted, so that every access ends with one answer. What is held of a write between handshake and
// access has parity; where it does not fit, the write is as one misaligned, and `upset` tells of it. Reads have none: a driver reads twice.
`resetall
`default_nettype none

module axil_slave #(
    parameter ADDRESS = 12  // address bits
) (
    input wire clk,
    input wire rst,

    // bus
    input  wire [ADDRESS-1:0] s_axil_awaddr,
    /* verilator lint_off UNUSEDSIGNAL */
    input  wire [        2:0] s_axil_awprot,   // any access is allowed
    input  wire [        2:0] s_axil_arprot,
    /* verilator lint_on UNUSEDSIGNAL */
    input  wire               s_axil_awvalid,
    output wire               s_axil_awready,
    input  wire [       31:0] s_axil_wdata,
    input  wire [        3:0] s_axil_wstrb,
    input  wire               s_axil_wvalid,
    output wire               s_axil_wready,
    output wire [        1:0] s_axil_bresp,
    output wire               s_axil_bvalid,
    input  wire               s_axil_bready,
    input  wire [ADDRESS-1:0] s_axil_araddr,
    input  wire               s_axil_arvalid,
    output wire               s_axil_arready,
    output reg  [       31:0] s_axil_rdata,
    output wire [        1:0] s_axil_rresp,
    output wire               s_axil_rvalid,
    input  wire               s_axil_rready,

    // registers: write
    output wire               write_valid,    // one clock
    output wire [ADDRESS-1:2] write_word,     // word address
    output reg  [       31:0] write_data,
    output reg  [        3:0] write_strobe,
    output reg  [        3:0] write_parity,   // makes each byte of the data, its strobe and this an even number of ones
    input  wire               write_error,    // of write_word, same clock

    // registers: read
    output wire               read_valid,     // held while read_wait
    output wire [ADDRESS-1:2] read_word,
    input  wire               read_wait,
    input  wire               read_error,     // of read_word, same clock
    input  wire [       31:0] read_data,      // one clock after read_valid && !read_wait; 0 in any other

    output wire upset  // a write was lost: what was held of it had changed
);

  wire running;  // not in reset
  voted_register #(
      .WIDTH(1),
      .RESET(1'b0)
  ) running_register (
      .clk(clk),
      .rst(rst),
      .d  (1'b1),
      .q  (running)
  );

  // ---- write: each channel fills its own register, both full make the access, the answer frees them

  reg [ADDRESS-1:0] write_address;
  reg write_address_parity, write_failed;
  wire write_changed, write_address_odd;
  wire [3:0] write_odd;
  wire address_full, data_full;

  wire write_go = address_full && data_full && !s_axil_bvalid;
  wire write_fits = write_address[1:0] == 2'b00 && !write_changed;
  wire next_address_full = (address_full || (s_axil_awvalid && s_axil_awready)) && !write_go;
  wire next_data_full = (data_full || (s_axil_wvalid && s_axil_wready)) && !write_go;

  assign s_axil_awready = running && !address_full;
  assign s_axil_wready  = running && !data_full;
  assign write_valid    = write_go && write_fits;
  assign write_word     = write_address[ADDRESS-1:2];
  assign s_axil_bresp   = {write_failed, 1'b0};
  assign upset          = write_go && write_changed;

  voted_register #(
      .WIDTH(3),
      .RESET(3'd0)
  ) write_register (
      .clk(clk),
      .rst(rst),
      .d  ({next_address_full, next_data_full, write_go || (s_axil_bvalid && !s_axil_bready)}),
      .q  ({address_full, data_full, s_axil_bvalid})
  );

  always @(posedge clk) begin
    if (s_axil_awready) begin
      write_address <= s_axil_awaddr;
      write_address_parity <= write_address_odd;
    end
    if (s_axil_wready) begin
      write_data   <= s_axil_wdata;
      write_strobe <= s_axil_wstrb;
      write_parity <= write_odd;
    end
    if (write_go) write_failed <= write_error || !write_fits;
  end

  odd_ones #(
      .WIDTH(ADDRESS)
  ) write_address_ones (
      .bits(s_axil_awaddr),
      .odd (write_address_odd)
  );
  genvar i;
  generate
    for (i = 0; i < 4; i = i + 1) begin : g_bytes
      odd_ones #(
          .WIDTH(9)
      ) write_ones (
          .bits({s_axil_wstrb[i], s_axil_wdata[8*i+:8]}),
          .odd (write_odd[i])
      );
    end
  endgenerate
  odd_ones #(
      .WIDTH(ADDRESS + 41)
  ) write_check (
      .bits({write_address, write_address_parity, write_data, write_strobe, write_parity}),
      .odd (write_changed)
  );

  // ---- read: idle -> issue -> capture -> answer, one voted bit a state, arready that of idle

  reg [ADDRESS-1:0] read_address;
  reg read_failed;
  wire issue, capture;

  wire read_aligned = read_address[1:0] == 2'b00;
  wire accept = s_axil_arvalid && s_axil_arready;
  wire go = issue && !read_wait;

  assign s_axil_arready = running && !(issue || capture || s_axil_rvalid);
  assign read_valid     = issue && read_aligned;
  assign read_word      = read_address[ADDRESS-1:2];
  assign s_axil_rresp   = {read_failed, 1'b0};

  voted_register #(
      .WIDTH(3),
      .RESET(3'd0)
  ) read_register (
      .clk(clk),
      .rst(rst),
      .d  ({accept || (issue && read_wait), go, capture || (s_axil_rvalid && !s_axil_rready)}),
      .q  ({issue, capture, s_axil_rvalid})
  );

  always @(posedge clk) begin
    if (s_axil_arready) read_address <= s_axil_araddr;
    if (go) read_failed <= read_error || !read_aligned;
    if (capture) s_axil_rdata <= read_data;
  end

endmodule

`resetall
