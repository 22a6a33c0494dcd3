// SPDX-License-Identifier: Apache-2.0
// solve_program under replay: every field of the word, and what goes with the address, a clock after it.
`resetall
`default_nettype none

module solve_program_replay #(
    parameter COVARIANCE = 1,
    parameter REAPPLY    = 1
) (
    input  wire clk,
    input  wire rst,
    output wire done
);
  wire valid, run, reapply;
  wire [9:0] address, counter;
  wire leaving, redrain, finished;
  wire [9:0] following;
  wire [5:0] x_address, output_index;
  wire [4:0] y_address, dest, divide_dest;
  wire [3:0] alternate, negate, enable, reference_code;
  wire [2:0] source, result_output, mark;
  wire [1:0] kind, write, track, divide;
  wire x_by_lane, y_by_lane, first, only_estimated, only_first, last, half, clamp;
  wire turn_dest, only_turned, choose_turn;

  solve_program #(
      .COVARIANCE(COVARIANCE),
      .REAPPLY(REAPPLY)
  ) dut (
      .clk(clk),
      .run(run),
      .address(address),
      .x_address(x_address),
      .x_by_lane(x_by_lane),
      .y_address(y_address),
      .y_by_lane(y_by_lane),
      .alternate(alternate),
      .negate(negate),
      .enable(enable),
      .first(first),
      .only_estimated(only_estimated),
      .only_first(only_first),
      .reference_code(reference_code),
      .last(last),
      .kind(kind),
      .half(half),
      .clamp(clamp),
      .write(write),
      .source(source),
      .dest(dest),
      .turn_dest(turn_dest),
      .only_turned(only_turned),
      .choose_turn(choose_turn),
      .track(track),
      .divide(divide),
      .divide_dest(divide_dest),
      .result_output(result_output),
      .output_index(output_index),
      .mark(mark),
      .counter(counter),
      .reapply(reapply),
      .leaving(leaving),
      .following(following),
      .redrain(redrain),
      .finished(finished)
  );

  reg live;
  reg [12:0] beside;  // the outputs without a register
  always @(posedge clk) begin
    live   <= ~rst & valid;
    beside <= {leaving, following, redrain, finished};
  end

  replay #(
      .IN_BITS (1 + 1 + 10 + 10 + 1),
      .OUT_BITS(1 + 13 + 71)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({valid, run, address, counter, reapply}),
      .result({
        live,
        beside,
        x_address,
        x_by_lane,
        y_address,
        y_by_lane,
        alternate,
        negate,
        enable,
        first,
        only_estimated,
        only_first,
        reference_code,
        last,
        kind,
        half,
        clamp,
        write,
        source,
        dest,
        turn_dest,
        only_turned,
        choose_turn,
        track,
        divide,
        divide_dest,
        result_output,
        output_index,
        mark
      }),
      .done(done)
  );
endmodule

`resetall
