// SPDX-License-Identifier: Apache-2.0
// Simulation only: a bench without Python. Plays the steps of a script on the core `RELNAV_TOP and prints PASS or what differs.
//
// The script, +script=FILE or smoke.hex, is written by `make package` (sim/smoke_oltae.hex, sim/smoke_ivisnav.hex) with the results of the
// bit-exact model. A step has 80 bits, {operation, byte address, data}:
//
//   0  write the data          1  read: must be the data      2  read until the upper half is the data's
//   3  send a stream's beat    4  the same, tlast             5  end
`resetall
`timescale 1ns / 1ps
`default_nettype none

module smoke;
  localparam LOOKS = 2000;

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

  initial begin
    clk = 1'b0;
    forever #5 clk = !clk;
  end

  // A master's signals change at the falling edge; ready is looked at at the rising one, valid at the next falling one.
  task write;
    input [11:0] at;
    input [31:0] word;
    begin
      address = at;
      wdata   = word;
      awvalid = 1'b1;
      wvalid  = 1'b1;
      while (awvalid || wvalid) begin : handshake
        reg took_address, took_data;
        @(posedge clk) {took_address, took_data} = {awready, wready};
        @(negedge clk);
        if (took_address) awvalid = 1'b0;
        if (took_data) wvalid = 1'b0;
      end
      while (!bvalid) @(negedge clk);
      if (bresp != 2'b00) fail("the write was refused", at, word, {30'd0, bresp});
      @(negedge clk);
    end
  endtask

  task read;
    input [11:0] at;
    output [31:0] word;
    begin : reading
      reg took;
      address = at;
      arvalid = 1'b1;
      while (arvalid) begin
        @(posedge clk) took = arready;
        @(negedge clk);
        if (took) arvalid = 1'b0;
      end
      while (!rvalid) @(negedge clk);
      word = rdata;
      if (rresp != 2'b00) fail("the read was refused", at, word, {30'd0, rresp});
      @(negedge clk);
    end
  endtask

  task send;
    input [63:0] beat;
    input last;
    begin : sending
      reg took;
      tdata  = beat;
      tlast  = last;
      tvalid = 1'b1;
      while (tvalid) begin
        @(posedge clk) took = tready;
        @(negedge clk);
        if (took) tvalid = 1'b0;
      end
    end
  endtask

  integer errors;

  task fail;
    input [8*24-1:0] what;
    input [11:0] at;
    input [31:0] wanted, found;
    begin
      errors = errors + 1;
      $display("FAIL: step %0d, address %h: %0s, wanted %h, found %h", step, at, what, wanted, found);
    end
  endtask

  reg [8*512-1:0] name;
  reg [ 3:0] operation;
  reg [11:0] at;
  reg [63:0] data;
  reg [31:0] word;
  reg [79:0] line;
  integer file, fields, step, look, compared;

  initial begin
    if (!$value$plusargs("script=%s", name)) name = "smoke.hex";
    file = $fopen(name, "r");
    {awvalid, wvalid, arvalid, tvalid, tlast} = 5'd0;
    address = 12'd0;
    wdata = 32'd0;
    tdata = 64'd0;
    errors = 0;
    compared = 0;
    step = 0;
    rst = 1'b1;
    repeat (4) @(negedge clk);
    rst = 1'b0;
    @(negedge clk);
    operation = 4'd0;
    while (operation != 4'd5 && errors < 10) begin
      step = step + 1;
      fields = file == 0 ? 0 : $fscanf(file, "%h", line);
      {operation, at, data} = line;
      if (fields != 1) begin
        fail("no step in the script", 12'd0, 32'd0, 32'd0);
        operation = 4'd5;
      end
      case (operation)
        4'd0: write(at, data[31:0]);
        4'd1: begin
          read(at, word);
          compared = compared + 1;
          if (word !== data[31:0]) fail("wrong word", at, data[31:0], word);
        end
        4'd2: begin
          word = ~data[31:0];
          for (look = 0; look < LOOKS && word[31:16] !== data[31:16]; look = look + 1) read(at, word);
          if (word[31:16] !== data[31:16]) fail("no result", at, data[31:0], word);
        end
        4'd3: send(data, 1'b0);
        4'd4: send(data, 1'b1);
        default: ;
      endcase
    end
    if (errors == 0 && compared > 0) $display("PASS: %0d words of 2 frames are those of the model", compared);
    else $display("FAIL: %0d errors", errors);
    $finish;
  end
endmodule

`resetall
