// SPDX-License-Identifier: Apache-2.0
// Simulation only: a core among hostile masters that play files, and a trace of everything that its ports do.
//
// The core is the module `RELNAV_TOP. The files, in the folder of the plusarg +folder=: writes.hex, reads.hex, beats.hex, resets.hex with
// one item a line (tb/soak/stimulus.py writes them), trace.hex with one line a clock in which anything moved (tb/soak/trace.py reads it).
// Every file holds +episodes=N episodes, each ended by an item of kind 15; an episode begins with a hard reset.
//
// An item waits first, for at most PATIENCE clocks: kind 1, 2, 3 until `need` writes, beats, reads of this episode are over; kind 4 until the
// core is not busy, kind 5 until it computes, both for at most `need` clocks. Then `delay` clocks, then it acts; a nop does not.
// A write's address and data go out `delay` and `data_delay` clocks after that, each by itself; the next item does not wait for the answer.
// A ready is low for its item's number of clocks, counted from the channel's last handshake or (`late`) from valid.
// A hard reset takes valids away and forgets what is under way, as a reset of the whole system does.
`resetall
`default_nettype none

module soak_harness (
    input  wire clk,
    output reg  done
);
  localparam [12:0] PATIENCE = 13'd4000;
  localparam [3:0] END = 4'd15;

  // ---- core
  reg rst;
  reg awvalid, wvalid, arvalid, tvalid, tlast;
  reg [11:0] awaddr, araddr;
  reg [31:0] wdata;
  reg [3:0] wstrb;
  reg [63:0] tdata;
  wire awready, wready, bvalid, arready, rvalid, tready, irq;
  wire [1:0] bresp, rresp;
  wire [31:0] rdata;
  wire bready, rready;

  `RELNAV_TOP top (
      .clk(clk),
      .rst(rst),
      .s_axil_awaddr(awaddr),
      .s_axil_awprot(3'd0),
      .s_axil_awvalid(awvalid),
      .s_axil_awready(awready),
      .s_axil_wdata(wdata),
      .s_axil_wstrb(wstrb),
      .s_axil_wvalid(wvalid),
      .s_axil_wready(wready),
      .s_axil_bresp(bresp),
      .s_axil_bvalid(bvalid),
      .s_axil_bready(bready),
      .s_axil_araddr(araddr),
      .s_axil_arprot(3'd0),
      .s_axil_arvalid(arvalid),
      .s_axil_arready(arready),
      .s_axil_rdata(rdata),
      .s_axil_rresp(rresp),
      .s_axil_rvalid(rvalid),
      .s_axil_rready(rready),
      .s_axis_tdata(tdata),
      .s_axis_tvalid(tvalid),
      .s_axis_tready(tready),
      .s_axis_tlast(tlast),
      .irq(irq)
  );

  // ---- files
  reg [8*400-1:0] folder;
  integer writes, reads, beats, resets, trace, episodes, episode, fields;
  reg [31:0] cycle, quiet;

  initial begin
    if (!$value$plusargs("folder=%s", folder)) $display("soak_harness: no +folder");
    if (!$value$plusargs("episodes=%d", episodes)) $display("soak_harness: no +episodes");
    writes = $fopen({folder, "/writes.hex"}, "r");
    reads = $fopen({folder, "/reads.hex"}, "r");
    beats = $fopen({folder, "/beats.hex"}, "r");
    resets = $fopen({folder, "/resets.hex"}, "r");
    trace = $fopen({folder, "/trace.hex"}, "w");
    episode = 0;
    cycle = 0;
    done = 1'b0;
    rst = 1'b1;
    {awvalid, wvalid, arvalid, tvalid, tlast} = 5'd0;
    {awaddr, araddr, wdata, wstrb, tdata} = 124'd0;
  end

  // ---- items
  // write: kind 4, nop 4, need 20, delay 12, data_delay 12, late 4, ready 12, strobe 4, address 12, data 32
  // read:  kind 4, nop 4, need 20, delay 12, late 4, ready 12, address 12
  // beat:  kind 4, nop 4, need 20, delay 12, repeats 20, last 4, data 64
  reg [115:0] write_item;
  reg [ 67:0] read_item;
  reg [127:0] beat_item;
  reg [ 31:0] reset_item;  // clocks after the episode's start 24, length 8; all ones: no more

  // one state an initiating channel: fetch, wait, count down, act
  localparam [1:0] FETCH = 2'd0, WAIT = 2'd1, DELAY = 2'd2, ACT = 2'd3;
  reg [1:0] write_state, read_state, beat_state;
  reg [12:0] write_wait, read_wait, beat_wait;
  reg [11:0] aw_delay, w_delay, read_delay, beat_delay;
  reg write_end, read_end, beat_end;
  reg aw_sent, w_sent;
  reg [19:0] writes_begun, writes_open, reads_begun, reads_open, beats_over, repeats;
  reg reset_known;
  reg [7:0] reset_left;
  reg [31:0] start;
  wire [19:0] writes_over = writes_begun - writes_open;
  wire [19:0] reads_over = reads_begun - reads_open;
  wire computing = top.state == 3'd2;

  function go;  // whether an item has waited long enough
    input [3:0] kind;
    input [19:0] need;
    input [12:0] waited;
    case (kind)
      4'd1: go = writes_over >= need;
      4'd2: go = beats_over >= need;
      4'd3: go = reads_over >= need;
      4'd4: go = top.busy !== 1'b1 || {7'd0, waited} >= need;
      4'd5: go = computing || {7'd0, waited} >= need;
      default: go = 1'b1;
    endcase
  endfunction

  // ---- answers
  reg [11:0] b_wait, r_wait, b_ready, r_ready;
  reg b_late, r_late;
  assign bready = b_wait >= b_ready;
  assign rready = r_wait >= r_ready;

  wire aw_done = awvalid && awready, w_done = wvalid && wready, b_done = bvalid && bready;
  wire ar_done = arvalid && arready, r_done = rvalid && rready, t_done = tvalid && tready;
  wire all_over = write_end && read_end && beat_end;

  task begin_episode;
    begin
      {write_state, read_state, beat_state} <= {FETCH, FETCH, FETCH};
      {write_end, read_end, beat_end} <= 3'd0;
      {writes_begun, writes_open, reads_begun, reads_open, beats_over} <= 100'd0;
      reset_known <= 1'b0;
      reset_left <= 8'd2;
      rst <= 1'b1;
      start <= cycle;
      quiet <= 0;
      {b_ready, r_ready, b_late, r_late} <= 26'd0;
    end
  endtask

  always @(posedge clk) begin
    cycle <= cycle + 1;
    b_wait <= b_done || rst ? 12'd0 : b_wait + {11'd0, !bready && (!b_late || bvalid)};
    r_wait <= r_done || rst ? 12'd0 : r_wait + {11'd0, !rready && (!r_late || rvalid)};
    writes_open <= writes_open - {19'd0, b_done};
    reads_open <= reads_open - {19'd0, r_done};

    // ---- writes
    if (aw_done) awvalid <= 1'b0;
    if (w_done) wvalid <= 1'b0;
    case (write_state)
      FETCH:
      if (!write_end && !rst) begin
        fields = $fscanf(writes, "%h", write_item);
        write_wait <= 13'd0;
        if (fields != 1 || write_item[115:112] == END) write_end <= 1'b1;
        else write_state <= WAIT;
      end
      WAIT: begin
        write_wait <= write_wait + 13'd1;
        if (go(write_item[115:112], write_item[107:88], write_wait) || write_wait == PATIENCE) begin
          write_state <= write_item[108] ? FETCH : DELAY;
          aw_delay <= write_item[87:76];
          w_delay <= write_item[75:64];
          {aw_sent, w_sent} <= 2'b00;
        end
      end
      DELAY: begin
        if (!aw_sent) begin
          if (aw_delay != 12'd0) aw_delay <= aw_delay - 12'd1;
          else begin
            awvalid <= 1'b1;
            awaddr  <= write_item[43:32];
            aw_sent <= 1'b1;
          end
        end
        if (!w_sent) begin
          if (w_delay != 12'd0) w_delay <= w_delay - 12'd1;
          else begin
            wvalid <= 1'b1;
            wdata  <= write_item[31:0];
            wstrb  <= write_item[47:44];
            w_sent <= 1'b1;
          end
        end
        if (!aw_sent && !w_sent && (aw_delay == 12'd0 || w_delay == 12'd0)) begin
          writes_begun <= writes_begun + 20'd1;
          writes_open  <= writes_open + 20'd1 - {19'd0, b_done};
          {b_late, b_ready} <= {write_item[60], write_item[59:48]};
        end
        if (aw_sent && w_sent && (!awvalid || aw_done) && (!wvalid || w_done)) write_state <= FETCH;
      end
      default: write_state <= FETCH;
    endcase

    // ---- reads
    if (ar_done) arvalid <= 1'b0;
    case (read_state)
      FETCH:
      if (!read_end && !rst) begin
        fields = $fscanf(reads, "%h", read_item);
        read_wait <= 13'd0;
        if (fields != 1 || read_item[67:64] == END) read_end <= 1'b1;
        else read_state <= WAIT;
      end
      WAIT: begin
        read_wait <= read_wait + 13'd1;
        if (go(read_item[67:64], read_item[59:40], read_wait) || read_wait == PATIENCE) begin
          read_state <= read_item[60] ? FETCH : DELAY;
          read_delay <= read_item[39:28];
        end
      end
      DELAY:
      if (read_delay != 12'd0) read_delay <= read_delay - 12'd1;
      else begin
        arvalid <= 1'b1;
        araddr <= read_item[11:0];
        {r_late, r_ready} <= {read_item[24], read_item[23:12]};
        reads_begun <= reads_begun + 20'd1;
        reads_open <= reads_open + 20'd1 - {19'd0, r_done};
        read_state <= ACT;
      end
      default: if (ar_done) read_state <= FETCH;
    endcase

    // ---- stream: without a delay, back to back
    if (t_done) begin
      tvalid <= 1'b0;
      if (repeats == 20'd0) beats_over <= beats_over + 20'd1;
    end
    case (beat_state)
      WAIT: begin
        beat_wait <= beat_wait + 13'd1;
        if (go(beat_item[127:124], beat_item[119:100], beat_wait) || beat_wait == PATIENCE) begin
          beat_state <= beat_item[120] ? FETCH : DELAY;
          beat_delay <= beat_item[99:88];
          if (beat_item[120]) beats_over <= beats_over + 20'd1;
        end
      end
      DELAY:
      if (beat_delay != 12'd0) beat_delay <= beat_delay - 12'd1;
      else begin
        tvalid <= 1'b1;
        {tlast, tdata} <= beat_item[64:0];
        repeats <= beat_item[87:68];
        beat_state <= ACT;
      end
      ACT:
      if (t_done && repeats != 20'd0) begin
        repeats <= repeats - 20'd1;
        tvalid  <= 1'b1;
      end
      default: ;
    endcase
    if (!rst && !beat_end && (beat_state == FETCH || (beat_state == ACT && t_done && repeats == 20'd0))) begin
      fields = $fscanf(beats, "%h", beat_item);
      beat_wait <= 13'd0;
      if (fields != 1 || beat_item[127:124] == END) begin
        beat_end   <= 1'b1;
        beat_state <= FETCH;
      end else if (beat_item[127:124] == 4'd0 && beat_item[99:88] == 12'd0) begin
        tvalid <= 1'b1;
        {tlast, tdata} <= beat_item[64:0];
        repeats <= beat_item[87:68];
        beat_state <= ACT;
      end else beat_state <= WAIT;
    end

    // ---- hard resets
    if (rst) begin
      reset_left <= reset_left - 8'd1;
      if (reset_left == 8'd0) rst <= 1'b0;
    end else if (!reset_known) begin
      fields = $fscanf(resets, "%h", reset_item);
      reset_known <= 1'b1;
    end else if (reset_item != 32'hFFFFFFFF && cycle - start >= {8'd0, reset_item[31:8]} && !all_over) begin
      rst <= 1'b1;
      reset_left <= reset_item[7:0];
      reset_known <= 1'b0;
      {awvalid, wvalid, arvalid, tvalid} <= 4'd0;
      {writes_open, reads_open} <= 40'd0;
      writes_begun <= writes_begun;  // what is under way counts as over
      reads_begun <= reads_begun;
      if (write_state == DELAY && (aw_sent || w_sent || awvalid || wvalid || aw_delay == 0 || w_delay == 0)) write_state <= FETCH;
      if (read_state == ACT) read_state <= FETCH;
      else if (read_state == DELAY && read_delay == 12'd0) read_state <= FETCH;
      if (beat_state == ACT || beat_state == DELAY) begin
        beat_state <= FETCH;
        repeats <= 20'd0;
      end else if (beat_state == FETCH && !beat_end) beat_state <= FETCH;
    end

    // ---- end of an episode
    if (all_over && !rst) begin
      quiet <= quiet + 1;
      if (quiet >= 40 && ((top.busy === 1'b0 && !bvalid && !rvalid) || quiet >= 4000)) begin
        while (reset_known && reset_item != 32'hFFFFFFFF) fields = $fscanf(resets, "%h", reset_item);
        if (!reset_known) begin
          reset_item = 32'd0;
          while (reset_item != 32'hFFFFFFFF) fields = $fscanf(resets, "%h", reset_item);
        end
        episode = episode + 1;
        if (episode == episodes) begin
          done <= 1'b1;
          $fclose(trace);
        end
        begin_episode;
        {awvalid, wvalid, arvalid, tvalid} <= 4'd0;
      end
    end
    if (cycle == 0) begin_episode;
  end

  // ---- trace: what the rising edge sees
  wire unknown = ^{awready, wready, bvalid, arready, rvalid, tready, irq, top.state} === 1'bx || (rvalid && ^rdata === 1'bx);
  wire [31:0] bits = {
    1'b0,
    episode[3:0],
    unknown && !rst,
    top.state,
    top.ill_conditioned === 1'b1,
    top.rank_deficient === 1'b1,
    top.result_wait === 1'b1,
    top.state == 3'd1 && top.beat_ready === 1'b1,
    irq === 1'b1,
    tlast,
    tready === 1'b1,
    tvalid,
    rresp & {2{rvalid}},
    rready,
    rvalid,
    arready,
    arvalid,
    bresp & {2{bvalid}},
    bready,
    bvalid,
    wready,
    wvalid,
    awready,
    awvalid,
    rst
  };
  reg [31:0] last_bits;
  initial last_bits = 32'hFFFFFFFF;
  always @(posedge clk)
    if (!done && cycle > 32'd1) begin
      last_bits <= bits;
      if (bits !== last_bits || aw_done || w_done || b_done || ar_done || r_done || t_done)
        $fwrite(trace, "%h\n", {cycle, bits, wdata, rvalid ? rdata : 32'd0, tdata, awaddr, araddr, wstrb, 4'd0});
    end
endmodule

`resetall
