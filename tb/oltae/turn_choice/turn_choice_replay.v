// SPDX-License-Identifier: Apache-2.0
// turn_choice under replay: from the first choice on every cycle's outputs count, held ones too.
`resetall
`default_nettype none

module turn_choice_replay (
    input  wire clk,
    input  wire rst,
    output wire done
);
  wire valid, forbid;
  wire [47:0] det_0, det_1, det_2, det_3;
  wire chosen, rank_deficient, ill_conditioned;
  wire [1:0] turn;

  turn_choice dut (
      .clk(clk),
      .rst(rst),
      .valid(valid),
      .forbid_turns(forbid),
      .det_0(det_0),
      .det_1(det_1),
      .det_2(det_2),
      .det_3(det_3),
      .chosen(chosen),
      .turn(turn),
      .rank_deficient(rank_deficient),
      .ill_conditioned(ill_conditioned)
  );

  reg held;
  always @(posedge clk) held <= (chosen | held) & ~rst;

  replay #(
      .IN_BITS (2 + 4 * 48),
      .OUT_BITS(1 + 1 + 2 + 2)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({valid, forbid, det_0, det_1, det_2, det_3}),
      .result({chosen | held, chosen, turn, rank_deficient, ill_conditioned}),
      .done(done)
  );
endmodule

`resetall
