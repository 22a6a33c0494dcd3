// SPDX-License-Identifier: Apache-2.0
// solve_engine under replay: a stimulus word is one cycle of the moment stream.
`resetall
`default_nettype none

module solve_engine_replay (
    input  wire clk,
    input  wire rst,
    output wire done
);
  wire forbid_turns, reapply, item_valid, item_first, item_low, redrain;
  wire [4:0] item_address;
  wire [47:0] item_value;
  wire write_valid, q_done, pose_done, all_done, chosen, rank_deficient, ill_conditioned, saturated;
  wire [5:0] write_index;
  wire [31:0] write_data;
  wire [1:0] turn;

  solve_engine dut (
      .clk(clk),
      .rst(rst),
      .forbid_turns(forbid_turns),
      .item_valid(item_valid),
      .covariance(1'b1),
      .reapply(reapply),
      .item_first(item_first),
      .item_low(item_low),
      .redrain(redrain),
      .item_address(item_address),
      .item_value(item_value),
      .write_valid(write_valid),
      .write_index(write_index),
      .write_data(write_data),
      .q_done(q_done),
      .pose_done(pose_done),
      .all_done(all_done),
      .chosen(chosen),
      .turn(turn),
      .rank_deficient(rank_deficient),
      .ill_conditioned(ill_conditioned),
      .saturated(saturated)
  );

  replay #(
      .IN_BITS (1 + 1 + 1 + 1 + 1 + 5 + 48),
      .OUT_BITS(1 + 6 + 32 + 3 + 1 + 2 + 3)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({reapply, forbid_turns, item_valid, item_first, item_low, item_address, item_value}),
      // an index without a write is unknown and not compared
      .result({
        write_valid | chosen,
        write_index & {6{write_valid}}, write_data & {32{write_valid}}, q_done, pose_done, all_done,
        chosen, turn & {2{chosen}}, rank_deficient & chosen, ill_conditioned & chosen, saturated
      }),
      .done(done)
  );
endmodule

`resetall
