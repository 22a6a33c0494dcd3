// SPDX-License-Identifier: Apache-2.0
// What axil_slave promises, for SymbiYosys (axil_slave.sby). Nothing is assumed of the master: it may drop valid, change an address
// before the handshake, withhold ready for ever. The register side is free too. Reset comes first and may come again at any time.
//
// The shadow below counts handshakes at the pins: address_open and data_open are writes begun and not answered, of which the answer
// in flight is one. `full_*` and the like are the slave's own registers (connected by the script), only to make the induction short.
`resetall
`default_nettype none

module axil_slave_properties #(
    parameter ADDRESS = 12
) (
    input wire               clk,
    input wire               rst,
    input wire [ADDRESS-1:0] s_axil_awaddr,
    input wire [        2:0] s_axil_awprot,
    input wire [        2:0] s_axil_arprot,
    input wire               s_axil_awvalid,
    input wire [       31:0] s_axil_wdata,
    input wire [        3:0] s_axil_wstrb,
    input wire               s_axil_wvalid,
    input wire               s_axil_bready,
    input wire [ADDRESS-1:0] s_axil_araddr,
    input wire               s_axil_arvalid,
    input wire               s_axil_rready,
    input wire               write_error,
    input wire               read_wait,
    input wire               read_error,
    input wire [       31:0] read_data
);
  wire s_axil_awready, s_axil_wready, s_axil_bvalid, s_axil_arready, s_axil_rvalid, write_valid, read_valid;
  wire [1:0] s_axil_bresp, s_axil_rresp;
  wire [31:0] s_axil_rdata, write_data;
  wire [3:0] write_strobe, write_parity;
  wire upset;
  wire [ADDRESS-1:2] write_word, read_word;

  axil_slave #(
      .ADDRESS(ADDRESS)
  ) dut (
      .clk(clk),
      .rst(rst),
      .s_axil_awaddr(s_axil_awaddr),
      .s_axil_awprot(s_axil_awprot),
      .s_axil_arprot(s_axil_arprot),
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
      .write_error(write_error),
      .read_valid(read_valid),
      .read_word(read_word),
      .read_wait(read_wait),
      .read_error(read_error),
      .read_data(read_data),
      .upset(upset)
  );

  // connected to the slave's registers by the script
  wire full_address, full_data, stage_issue, stage_capture, failed_write, failed_read;
  wire parity_write_address;
  wire [ADDRESS-1:0] held_write, held_read;

  reg started = 1'b0;  // there has been a clock edge: $past is valid
  always @(posedge clk) started <= 1'b1;
  always @* if (!started) assume (rst);
  reg was_reset = 1'b1;  // in the clock before
  always @(posedge clk) was_reset <= rst;
  wire running = started && !was_reset;

  // ---- write

  wire take_address = s_axil_awvalid && s_axil_awready && !rst;
  wire take_data = s_axil_wvalid && s_axil_wready && !rst;
  wire answered = s_axil_bvalid && s_axil_bready;
  reg [2:0] address_open = 0, data_open = 0;
  reg [ADDRESS-1:0] shadow_address;
  reg [31:0] shadow_data;
  reg [3:0] shadow_strobe;
  wire address_waits = address_open != {2'd0, s_axil_bvalid};  // not yet answered for
  wire data_waits = data_open != {2'd0, s_axil_bvalid};

  always @(posedge clk) begin
    address_open <= rst ? 3'd0 : address_open + {2'd0, take_address} - {2'd0, answered};
    data_open <= rst ? 3'd0 : data_open + {2'd0, take_data} - {2'd0, answered};
    if (take_address) shadow_address <= s_axil_awaddr;
    if (take_data) begin
      shadow_data   <= s_axil_wdata;
      shadow_strobe <= s_axil_wstrb;
    end
  end

  reg was_answering, was_misaligned;
  always @(posedge clk) {was_answering, was_misaligned} <= {s_axil_bvalid && !s_axil_bready, shadow_address[1:0] != 2'd0};
  wire rises_b = started && s_axil_bvalid && !was_answering;

  always @(posedge clk) if (started) begin
    // never an answer without a request, never two for one, none lost
    b_needs_address : assert (!s_axil_bvalid || address_open != 0);
    b_needs_data : assert (!s_axil_bvalid || data_open != 0);
    one_address_waits : assert (address_open <= {2'd0, s_axil_bvalid} + 3'd1);
    one_data_waits : assert (data_open <= {2'd0, s_axil_bvalid} + 3'd1);
    awready_when_free : assert (was_reset ? !s_axil_awready : s_axil_awready == !address_waits);
    wready_when_free : assert (was_reset ? !s_axil_wready : s_axil_wready == !data_waits);
    // valid, and what it says, stay until ready
    if (running && $past(s_axil_bvalid && !s_axil_bready)) b_stays : assert (s_axil_bvalid && $stable(s_axil_bresp));
    if (was_reset) b_reset : assert (!s_axil_bvalid);
    // the answer does not wait for bready, and comes in the clock after both halves are there
    if (running && $past(address_waits && data_waits && !s_axil_bvalid)) b_comes : assert (s_axil_bvalid);
    if (rises_b) b_not_early : assert ($past(address_waits && data_waits));
    // the access: one clock, when both halves are there, aligned, with what the master gave
    write_once : assert (write_valid == (address_waits && data_waits && !s_axil_bvalid && shadow_address[1:0] == 0));
    if (write_valid) write_handed_on : assert (write_word == shadow_address[ADDRESS-1:2] && write_data == shadow_data);
    if (write_valid) strobe_handed_on : assert (write_strobe == shadow_strobe);
    if (write_valid) parity_handed_on : assert (write_parity == {^{write_strobe[3], write_data[31:24]}, ^{write_strobe[2], write_data[23:16]},
                                                                 ^{write_strobe[1], write_data[15:8]}, ^{write_strobe[0], write_data[7:0]}});
    no_false_alarm : assert (!upset);
    if (rises_b) b_error : assert (s_axil_bresp == {was_misaligned || $past(write_error), 1'b0});
    // the shadow is the slave's state
    same_write_state : assert (full_address == address_waits && full_data == data_waits);
    if (address_waits) same_write_address : assert (held_write == shadow_address && parity_write_address == ^shadow_address);
    if (data_waits) same_write_data : assert (write_data == shadow_data && write_strobe == shadow_strobe && write_parity ==
        {^{shadow_strobe[3], shadow_data[31:24]}, ^{shadow_strobe[2], shadow_data[23:16]}, ^{shadow_strobe[1], shadow_data[15:8]},
         ^{shadow_strobe[0], shadow_data[7:0]}});
  end

  // ---- read

  wire take_read = s_axil_arvalid && s_axil_arready && !rst;
  reg read_open = 0, accessed = 0, expect_failed;
  reg [ADDRESS-1:0] shadow_read;
  wire aligned_read = shadow_read[1:0] == 2'd0;
  wire access = read_open && !accessed && !read_wait;
  reg [31:0] expect_data;
  reg fetch = 0;  // read_data is due now

  always @(posedge clk) begin
    read_open <= !rst && (take_read || (read_open && !(s_axil_rvalid && s_axil_rready)));
    accessed <= !rst && !take_read && (accessed || access);
    fetch <= !rst && access;
    if (take_read) shadow_read <= s_axil_araddr;
    if (access) expect_failed <= read_error || !aligned_read;
    if (fetch) expect_data <= read_data;
  end

  always @(posedge clk) if (started) begin
    r_needs_request : assert (!s_axil_rvalid || (read_open && accessed && !fetch));
    arready_when_free : assert (!s_axil_arready || !read_open);
    if (running && !read_open && !$past(read_open)) arready_comes : assert (s_axil_arready);
    if (running && $past(s_axil_rvalid && !s_axil_rready))
      r_stays : assert (s_axil_rvalid && $stable(s_axil_rresp) && $stable(s_axil_rdata));
    if (was_reset) r_reset : assert (!s_axil_rvalid && !s_axil_arready);
    if (running && $past(fetch)) r_comes : assert (s_axil_rvalid);
    if (s_axil_rvalid) r_answer : assert (s_axil_rdata == expect_data && s_axil_rresp == {expect_failed, 1'b0});
    read_once : assert (read_valid == (read_open && !accessed && aligned_read));
    if (read_valid) read_handed_on : assert (read_word == shadow_read[ADDRESS-1:2]);
    // the shadow is the slave's state
    same_read_state : assert (stage_issue == (read_open && !accessed) && stage_capture == fetch &&
                              s_axil_rvalid == (read_open && accessed && !fetch));
    if (read_open) same_read_address : assert (held_read == shadow_read);
    if (fetch) same_read_failed : assert (failed_read == expect_failed);
  end
endmodule

// No ready or valid depends on an input of the same clock. Two slaves get the same inputs until one clock, in which every input but clk
// may differ: all five handshake outputs must still agree in that clock.
module axil_slave_dependence (
    input wire         clk,
    input wire         differ,
    input wire [106:0] inputs_a,
    input wire [106:0] inputs_b
);
  reg started = 1'b0, parted = 1'b0;
  always @(posedge clk) begin
    started <= 1'b1;
    parted  <= parted || differ;
  end
  wire [106:0] second = differ ? inputs_b : inputs_a;
  wire [9:0] out_a, out_b;
  axil_slave_handshakes a (clk, inputs_a, out_a);
  axil_slave_handshakes b (clk, second, out_b);
  always @* if (!started) assume (inputs_a[0] && !differ);  // reset
  always @(posedge clk) if (started && !parted) ready_valid_registered : assert (out_a[4:0] == out_b[4:0]);
  always @(posedge clk) if (started && !parted) same_state : assert (out_a[9:5] == out_b[9:5]);
endmodule

module axil_slave_handshakes (
    input  wire         clk,
    input  wire [106:0] inputs,
    output wire [  9:0] out
);
  wire rst, awvalid, wvalid, bready, arvalid, rready, write_error, read_wait, read_error;
  wire [11:0] awaddr, araddr;
  wire [31:0] wdata, read_data;
  wire [3:0] wstrb;
  wire [2:0] awprot, arprot;
  assign {awaddr, araddr, wdata, read_data, wstrb, awprot, arprot, awvalid, wvalid, bready, arvalid, rready, write_error, read_wait,
          read_error, rst} = inputs;
  wire awready, wready, bvalid, arready, rvalid;
  wire full_address, full_data, stage_issue, stage_capture;
  assign out = {full_address, full_data, stage_issue, stage_capture, 1'b0, awready, wready, bvalid, arready, rvalid};
  axil_slave #(
      .ADDRESS(12)
  ) dut (
      .clk(clk),
      .rst(rst),
      .s_axil_awaddr(awaddr),
      .s_axil_awprot(awprot),
      .s_axil_arprot(arprot),
      .s_axil_awvalid(awvalid),
      .s_axil_awready(awready),
      .s_axil_wdata(wdata),
      .s_axil_wstrb(wstrb),
      .s_axil_wvalid(wvalid),
      .s_axil_wready(wready),
      .s_axil_bresp(),
      .s_axil_bvalid(bvalid),
      .s_axil_bready(bready),
      .s_axil_araddr(araddr),
      .s_axil_arvalid(arvalid),
      .s_axil_arready(arready),
      .s_axil_rdata(),
      .s_axil_rresp(),
      .s_axil_rvalid(rvalid),
      .s_axil_rready(rready),
      .write_valid(),
      .write_word(),
      .write_data(),
      .write_strobe(),
      .write_parity(),
      .write_error(write_error),
      .read_valid(),
      .read_word(),
      .read_wait(read_wait),
      .read_error(read_error),
      .read_data(read_data),
      .upset()
  );
endmodule

`resetall
