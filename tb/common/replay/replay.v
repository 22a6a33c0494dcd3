// SPDX-License-Identifier: Apache-2.0
// Plays a file of stimulus words, one a cycle, and writes every result whose top bit is set, with its cycle.
// Plusargs: +stimulus=FILE (hexadecimal), +cycles=N, +results=FILE. A result of cycle n answers stimulus word n
// when the device under test has latency 0.
`resetall
`default_nettype none

module replay #(
    parameter IN_BITS  = 8,
    parameter OUT_BITS = 8,
    parameter DEPTH    = 262144
) (
    input wire clk,
    input wire rst,
    output reg [IN_BITS-1:0] word,
    input wire [OUT_BITS-1:0] result,
    output reg done
);
  localparam TAIL = 40;  // cycles for the pipeline to empty
  reg [IN_BITS-1:0] stimulus[0:DEPTH-1];
  reg [8*256-1:0] name;
  reg [31:0] cycle;
  reg [31:0] cycles;
  integer file;

  initial begin
    done = 1'b0;
    word = {IN_BITS{1'b0}};
    cycle = 0;
    cycles = 0;
    if (!$value$plusargs("cycles=%d", cycles)) $display("replay: no +cycles");
    if (!$value$plusargs("stimulus=%s", name)) $display("replay: no +stimulus");
    $readmemh(name, stimulus, 0, cycles - 1);
    if (!$value$plusargs("results=%s", name)) $display("replay: no +results");
    file = $fopen(name, "w");
  end

  always @(posedge clk)
    if (!rst && !done) begin
      word  <= cycle < cycles ? stimulus[cycle] : {IN_BITS{1'b0}};
      cycle <= cycle + 1;
      if (cycle != 0 && result[OUT_BITS-1] !== 1'b0) $fwrite(file, "%h%h\n", cycle - 32'd1, result);
      if (cycle == cycles + TAIL) begin
        done <= 1'b1;
        $fclose(file);
      end
    end
endmodule

`resetall
