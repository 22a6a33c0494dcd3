// SPDX-License-Identifier: Apache-2.0
// sequencer under replay, with a stub of solve_program: a program anywhere in 1024 words, written by the stimulus.
`resetall
`default_nettype none

module sequencer_replay (
    input  wire clk,
    input  wire rst,
    output wire done
);
  wire clear, start, stop, reapply;
  wire write;
  wire [9:0] write_address;
  wire [3:0] write_word;
  wire [9:0] call, target, leave, finish;

  // {there, first, last, probed}
  reg [3:0] rom[0:1023];
  reg [3:0] word;
  reg [9:0] at;
  reg cleared;
  wire run, probing, reapplied;
  wire [9:0] counter, address;
  wire leaving = counter == leave;
  wire calling = reapply & ~reapplied & counter == call;
  wire [9:0] following = calling ? target : leaving ? call : counter;
  wire finished = address == finish;
  integer k;
  initial for (k = 0; k < 1024; k = k + 1) rom[k] = 4'd0;
  always @(posedge clk) begin
    if (write) rom[write_address] <= write_word;
    word <= run ? rom[address] : 4'd0;
    at   <= address;
    cleared <= clear;
  end

  sequencer dut (
      .clk(clk),
      .rst(rst | clear),
      .start(start),
      .stop(stop | finished),
      .first(word[2]),
      .last(word[1]),
      .probed(word[0]),
      .probing(probing),
      .run(run),
      .counter(counter),
      .following(following),
      .leaving(leaving),
      .address(address),
      .reapplied(reapplied)
  );

  replay #(
      .IN_BITS (4 + 1 + 10 + 4 + 4 * 10),
      .OUT_BITS(1 + 10 + 1 + 1)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({clear, start, stop, reapply, write, write_address, write_word, call, target, leave, finish}),
      .result({word[3] & ~cleared, at, probing, reapplied}),
      .done(done)
  );
endmodule

`resetall
