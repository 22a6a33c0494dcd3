// SPDX-License-Identifier: Apache-2.0
// Simulation only: plays what docs/wavedrom/ draws on the core `RELNAV_TOP and prints, for each clock of a scene, the scene and its signals.
`resetall
`timescale 1ns / 1ps
`default_nettype none

module waves;
  localparam [11:0] ID = 12'h000, IRQ_STATUS = 12'h020, CONFIG = 12'h024, IRQ_ENABLE = 12'h01C, DATA_A = 12'h040, PUSH = 12'h048;
  localparam [2:0] IDLE = 3'd0, DONE = 3'd3;
  localparam CLOCKS = 4000;

  reg clk, rst;
  reg [11:0] address;
  reg awvalid, wvalid, arvalid;
  reg [31:0] wdata;
  reg [63:0] tdata;
  reg tvalid, tlast;
  wire awready, wready, bvalid, arready, rvalid, tready, irq;
  wire [1:0] bresp, rresp;
  wire [31:0] rdata;

  `RELNAV_TOP top (
      .clk(clk),
      .rst(rst),
      .s_axil_awaddr(address),
      .s_axil_awprot(3'd0),
      .s_axil_awvalid(awvalid),
      .s_axil_awready(awready),
      .s_axil_wdata(wdata),
      .s_axil_wstrb(4'hF),
      .s_axil_wvalid(wvalid),
      .s_axil_wready(wready),
      .s_axil_bresp(bresp),
      .s_axil_bvalid(bvalid),
      .s_axil_bready(1'b1),
      .s_axil_araddr(address),
      .s_axil_arprot(3'd0),
      .s_axil_arvalid(arvalid),
      .s_axil_arready(arready),
      .s_axil_rdata(rdata),
      .s_axil_rresp(rresp),
      .s_axil_rvalid(rvalid),
      .s_axil_rready(1'b1),
      .s_axis_tdata(tdata),
      .s_axis_tvalid(tvalid),
      .s_axis_tready(tready),
      .s_axis_tlast(tlast),
      .irq(irq)
  );

  reg [8*12-1:0] scene;
  always #5 clk = !clk;
  // just before the edge, when all has settled
  always @(posedge clk)
    if (scene != 0)
      begin
        $write("%0s awvalid=%b awready=%b wvalid=%b wready=%b bvalid=%b ", scene, awvalid, awready, wvalid, wready, bvalid);
        $write("arvalid=%b arready=%b rvalid=%b tvalid=%b ", arvalid, arready, rvalid, tvalid);
        $write("tready=%b tlast=%b irq=%b state=%0d ", tready, tlast, irq, top.state);
        $write("q=%b pose=%b all=%b ", top.`RELNAV_FIRST, top.`RELNAV_SECOND, top.all_ready);
        $display("push_valid=%b taken=%b", top.push_valid, top.push_valid && top.push_ready);
      end

  task tick;
    begin
      @(posedge clk);
      #1;
    end
  endtask

  task write(input [11:0] to, input [31:0] value);
    begin
      address = to;
      wdata = value;
      awvalid = 1'b1;
      wvalid = 1'b1;
      tick;
      awvalid = 1'b0;
      wvalid = 1'b0;
      tick;
    end
  endtask

  task beat(input last);
    begin
      tvalid = 1'b1;
      tlast = last;
      // any points and rows will do, as long as they are not on a line
      tdata = {$random, $random};
      #1;
      while (!tready) tick;
      tick;
      tvalid = 1'b0;
      tlast = 1'b0;
    end
  endtask

  integer i;
  initial begin
    {clk, rst, awvalid, wvalid, arvalid, tvalid, tlast, scene} = 0;
    {address, wdata, tdata} = 0;
    rst = 1'b1;
    repeat (5) tick;
    rst = 1'b0;
    repeat (3) tick;

    scene = "write";
    repeat (2) write(IRQ_ENABLE, 32'd1);
    repeat (3) tick;
    scene = 0;

    address = ID;
    arvalid = 1'b1;
    scene = "read";
    tick;
    arvalid = 1'b0;
    repeat (5) tick;
    scene = 0;
    repeat (3) tick;

`ifdef RELNAV_WEIGHTED
    write(CONFIG, 32'd9);
    repeat (3) tick;
`endif
    scene = "stream";
    for (i = 1; i <= `RELNAV_BEATS; i = i + 1) begin
      beat(i == `RELNAV_BEATS);
      if (i == `RELNAV_PAUSE) repeat (2) tick;
    end
    repeat (4) tick;
    scene = "results";
    i = 0;
    while (top.state != DONE && top.state != IDLE && i < CLOCKS) begin
      tick;
      i = i + 1;
    end
    repeat (3) tick;
    write(IRQ_STATUS, 32'd1);
    repeat (4) tick;
    scene = 0;

    write(DATA_A, 32'd5);
    write(DATA_A + 12'd4, 32'd7);
    scene = "push";
    write(PUSH, 32'd0);
    repeat (4) tick;
    $finish;
  end
endmodule
`resetall
