// SPDX-License-Identifier: Apache-2.0
// dot_lane under replay. A slot asks for its sum (cycle 5) and its result (cycle 7) to be written down.
`resetall
`default_nettype none

module dot_lane_replay #(
    parameter LANE = 0,
    parameter WIDE = 0
) (
    input  wire clk,
    input  wire rst,
    output wire done
);
  wire check, x_by_lane, y_by_lane, alternate, negate, enable, first;
  wire own_reference, probing, probed_reference, round_raw, half, clamp;
  wire write, write_broadcast, write_raw, stream_write;
  wire [5:0] x_address;
  wire [4:0] y_address, write_address, stream_address;
  wire signed [13:0] base;
  wire [47:0] broadcast, stream_value, result, sum;
  wire above;

  dot_lane #(
      .LANE(LANE),
      .WIDE(WIDE)
  ) dut (
      .clk(clk),
      .x_address(x_address),
      .x_by_lane(x_by_lane),
      .y_address(y_address),
      .y_by_lane(y_by_lane),
      .alternate(alternate),
      .negate(negate),
      .enable(enable),
      .first(first),
      .reference(base),
      .own_reference(own_reference),
      .probing(probing),
      .probed_reference(probed_reference),
      .round_raw(round_raw),
      .half(half),
      .clamp(clamp),
      .write(write),
      .write_address(write_address),
      .write_broadcast(write_broadcast),
      .write_raw(write_raw),
      .broadcast(broadcast),
      .stream_write(stream_write),
      .stream_address(stream_address),
      .stream_value(stream_value),
      .result(result),
      .sum(sum),
      .overflow(above)
  );

  reg [7:1] checked;
  always @(posedge clk) checked <= rst ? 7'd0 : {checked[6:1], check};

  replay #(
      .IN_BITS (1 + 6 + 1 + 5 + 5 + 14 + 3 + 3 + 1 + 5 + 2 + 48 + 1 + 5 + 48),
      .OUT_BITS(1 + 1 + 1 + 48 + 1 + 48)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({
        {check, x_address, x_by_lane, y_address, y_by_lane, alternate, negate, enable, first},
        {base, own_reference, probing, probed_reference, round_raw, half, clamp},
        {write, write_address, write_broadcast, write_raw, broadcast},
        {stream_write, stream_address, stream_value}
      }),
      // what was not asked for may be unknown
      .result({
        checked[5] | checked[7],
        {checked[5], above & checked[5], sum & {48{checked[5]}}},
        {checked[7], result & {48{checked[7]}}}
      }),
      .done(done)
  );
endmodule

`resetall
