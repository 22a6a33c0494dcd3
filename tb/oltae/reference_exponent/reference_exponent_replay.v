// SPDX-License-Identifier: Apache-2.0
// reference_exponent under replay: the stimulus says which codes' references count.
`resetall
`default_nettype none

module reference_exponent_replay (
    input  wire clk,
    input  wire rst,
    output wire done
);
  wire look, start, item_valid, afresh, quaternion, centroid, probing;
  wire [4:0] item_address;
  wire [47:0] item_value, bus;
  wire [3:0] code;
  wire [13:0] common, lane_0;
  wire own, probing_2, probed_2;

  reference_exponent dut (
      .clk(clk),
      .start(start),
      .item_valid(item_valid),
      .item_address(item_address),
      .item_value(item_value),
      .track_afresh(afresh),
      .track_quaternion(quaternion),
      .track_centroid(centroid),
      .bus(bus),
      .code(code),
      .probing(probing),
      .common(common),
      .lane_0(lane_0),
      .own(own),
      .probing_2(probing_2),
      .probed_2(probed_2)
  );

  reg live_1, live_2;
  always @(posedge clk) {live_2, live_1} <= {live_1, look} & ~{2{rst}};

  replay #(
      .IN_BITS (1 + 1 + 1 + 5 + 48 + 3 + 48 + 4 + 1),
      .OUT_BITS(1 + 14 + 14 + 3)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({
        look, start, item_valid, item_address, item_value, afresh, quaternion, centroid, bus, code, probing
      }),
      .result({live_2, common, lane_0, own, probing_2, probed_2}),
      .done(done)
  );
endmodule

`resetall
