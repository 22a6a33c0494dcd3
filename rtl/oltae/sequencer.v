// SPDX-License-Identifier: Apache-2.0
// Program counter of the solve engine: fetches a slot a clock from `start` on, runs a probed dot product twice, calls the re-application.
//
// cycle 0: start. From cycle 2 on the program's word of cycle c is at solve_program's outputs in cycle c.
// A probed dot product's first pass (probing) finds its largest exponent; `rewind` then leads back to its first slot without a gap.
`resetall
`default_nettype none
module sequencer (
    input  wire       clk,
    input  wire       rst,
    input  wire       start,
    input  wire       stop,
    // the word at solve_program's outputs
    input  wire       first,
    input  wire       last,
    input  wire       probed,
    output wire       probing,    // first pass
    // solve_program
    output reg        run,
    output reg  [9:0] counter,
    input  wire [9:0] following,  // `counter`, or where a call or return leads
    input  wire       leaving,    // the re-application is done
    output wire [9:0] address,
    output reg        reapplied
);
  reg [9:0] word_address, dot_address;
  reg second_pass;
  wire rewind = last & probing;

  assign probing = probed & ~second_pass;
  assign address = !rewind ? following : first ? word_address : dot_address;

  always @(posedge clk) begin
    run          <= start | (run & ~stop);
    counter      <= start ? 10'd2 : address + 10'd1;
    word_address <= address;
    if (first) dot_address <= word_address;
    second_pass <= rewind | (second_pass & ~last);
    reapplied   <= (leaving & ~rewind & run) | (reapplied & ~start);
    if (rst) run <= 1'b0;
    if (rst | start) {second_pass, reapplied} <= 2'b00;
  end
endmodule
`resetall
