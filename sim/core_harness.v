// SPDX-License-Identifier: Apache-2.0
// Simulation only: a core with an AXI-Stream source that plays frames from a file, so that Python is awake only for the registers.
//
// The core is the module `RELNAV_TOP with the parameters `RELNAV_PARAMETERS, as in #(.WEIGHTED(0)) or empty; all cores have the same ports.
//
// A change of `go` opens the file of the plusarg +beats=FILE, one beat a line: hexadecimal {last, 64 bits of data}. All its beats are sent,
// then `sent` takes the value of `go`. Before each beat the source pauses with probability gap / 256 a clock (0: never).
`resetall
`default_nettype none

module core_harness (
    input  wire        clk,
    input  wire        rst,
    // AXI4-Lite of the core
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
    output wire        irq,
    // stream source
    input  wire        go,
    input  wire [ 7:0] gap,
    output reg         sent
);
  reg [63:0] s_axis_tdata;
  reg s_axis_tvalid, s_axis_tlast;
  wire s_axis_tready;

  `RELNAV_TOP `RELNAV_PARAMETERS top (
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
      .s_axis_tdata(s_axis_tdata),
      .s_axis_tvalid(s_axis_tvalid),
      .s_axis_tready(s_axis_tready),
      .s_axis_tlast(s_axis_tlast),
      .irq(irq)
  );

  reg [8*512-1:0] name;
  reg [64:0] beat;
  reg playing;
  integer file, fields, seed;

  initial begin
    seed = 1;
    if (!$value$plusargs("beats=%s", name)) name = "beats.hex";
  end

  always @(posedge clk) begin
    if (rst) begin
      s_axis_tvalid <= 1'b0;
      s_axis_tlast <= 1'b0;
      playing <= 1'b0;
      sent <= go;
    end else if (!playing) begin
      if (sent != go) begin
        file = $fopen(name, "r");
        fields = $fscanf(file, "%h", beat);
        playing <= 1'b1;
      end
    end else if (!s_axis_tvalid || s_axis_tready) begin
      if (fields != 1) begin
        $fclose(file);
        s_axis_tvalid <= 1'b0;
        playing <= 1'b0;
        sent <= go;
      end else if (gap != 8'd0 && ($random(seed) & 255) < {24'd0, gap}) begin
        s_axis_tvalid <= 1'b0;
      end else begin
        s_axis_tvalid <= 1'b1;
        {s_axis_tlast, s_axis_tdata} <= beat;
        fields = $fscanf(file, "%h", beat);
      end
    end
  end
endmodule

`resetall
