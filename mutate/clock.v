// SPDX-License-Identifier: Apache-2.0
// A second root beside a top that plays a file: clock, and reset where it has one (RELNAV_RST), until it is done.
`timescale 1ns / 1ps
module relnav_clock;
  reg clk, rst;
  initial begin
    clk = 1'b1;
    rst = 1'b1;
    force `RELNAV_TOP.clk = clk;
`ifdef RELNAV_RST
    force `RELNAV_TOP.rst = rst;
`endif
    #35 rst = 1'b0;
    wait (`RELNAV_TOP.done);
    $finish;
  end
  always #5 clk = !clk;
endmodule
