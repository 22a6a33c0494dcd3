// SPDX-License-Identifier: Apache-2.0
// AXI4-Lite slave, protocol half: turns the five channels into one-clock register accesses.
//
// One write and one read at a time; the two are independent. Address and data of a write may come in either order or together.
// No output depends on an input of the same clock: every s_axil_* output is a flip-flop, so valid cannot wait for ready and
// cannot fall, nor can its payload change, before the handshake. ready is low in reset, so nothing is lost there.
//
// Write     clock  0 both handshakes  1 write_valid, address/data/strobe, write_error read  2 bvalid
// Read      clock  0 handshake  1.. read_valid and address until read_wait is 0, read_error read  then read_data read  then rvalid
// Throughput: one write in 2 clocks, one read in 4, with a master that never waits.
//
// A misaligned address raises no *_valid. It and *_error answer SLVERR; read_data must be 0 then (nothing selected).
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
    output reg                s_axil_awready,
    input  wire [       31:0] s_axil_wdata,
    input  wire [        3:0] s_axil_wstrb,
    input  wire               s_axil_wvalid,
    output reg                s_axil_wready,
    output wire [        1:0] s_axil_bresp,
    output reg                s_axil_bvalid,
    input  wire               s_axil_bready,
    input  wire [ADDRESS-1:0] s_axil_araddr,
    input  wire               s_axil_arvalid,
    output reg                s_axil_arready,
    output reg  [       31:0] s_axil_rdata,
    output wire [        1:0] s_axil_rresp,
    output reg                s_axil_rvalid,
    input  wire               s_axil_rready,

    // registers: write
    output wire               write_valid,    // one clock
    output wire [ADDRESS-1:2] write_word,     // word address
    output reg  [       31:0] write_data,
    output reg  [        3:0] write_strobe,
    input  wire               write_error,    // of write_word, same clock

    // registers: read
    output wire               read_valid,     // held while read_wait
    output wire [ADDRESS-1:2] read_word,
    input  wire               read_wait,
    input  wire               read_error,     // of read_word, same clock
    input  wire [       31:0] read_data       // one clock after read_valid && !read_wait; 0 in any other
);

  // ---- write: each channel fills its own register, both full make the access, the answer frees them

  reg [ADDRESS-1:0] write_address;
  reg address_full, data_full, write_failed;

  wire write_go = address_full && data_full && !s_axil_bvalid;
  wire write_aligned = write_address[1:0] == 2'b00;
  wire next_address_full = (address_full || (s_axil_awvalid && s_axil_awready)) && !write_go;
  wire next_data_full = (data_full || (s_axil_wvalid && s_axil_wready)) && !write_go;

  assign write_valid  = write_go && write_aligned;
  assign write_word   = write_address[ADDRESS-1:2];
  assign s_axil_bresp = {write_failed, 1'b0};

  always @(posedge clk) begin
    address_full   <= next_address_full;
    data_full      <= next_data_full;
    s_axil_awready <= !next_address_full;
    s_axil_wready  <= !next_data_full;
    if (s_axil_awready) write_address <= s_axil_awaddr;
    if (s_axil_wready) begin
      write_data   <= s_axil_wdata;
      write_strobe <= s_axil_wstrb;
    end
    if (write_go) begin
      s_axil_bvalid <= 1'b1;
      write_failed  <= write_error || !write_aligned;
    end else if (s_axil_bready) begin
      s_axil_bvalid <= 1'b0;
    end
    if (rst) begin
      address_full   <= 1'b0;
      data_full      <= 1'b0;
      s_axil_awready <= 1'b0;
      s_axil_wready  <= 1'b0;
      s_axil_bvalid  <= 1'b0;
    end
  end

  // ---- read: idle -> issue -> capture -> answer, one flip-flop a state, arready that of idle

  reg [ADDRESS-1:0] read_address;
  reg issue, capture, read_failed;

  wire read_aligned = read_address[1:0] == 2'b00;
  wire accept = s_axil_arvalid && s_axil_arready;
  wire go = issue && !read_wait;

  assign read_valid   = issue && read_aligned;
  assign read_word    = read_address[ADDRESS-1:2];
  assign s_axil_rresp = {read_failed, 1'b0};

  always @(posedge clk) begin
    if (s_axil_arready) read_address <= s_axil_araddr;
    if (go) read_failed <= read_error || !read_aligned;
    if (capture) s_axil_rdata <= read_data;

    issue   <= accept || (issue && read_wait);
    capture <= go;
    if (capture) s_axil_rvalid <= 1'b1;
    else if (s_axil_rready) s_axil_rvalid <= 1'b0;
    s_axil_arready <= !(accept || issue || capture || (s_axil_rvalid && !s_axil_rready));
    if (rst) begin
      s_axil_arready <= 1'b0;
      issue          <= 1'b0;
      capture        <= 1'b0;
      s_axil_rvalid  <= 1'b0;
    end
  end

endmodule

`resetall
