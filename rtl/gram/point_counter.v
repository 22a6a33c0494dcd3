// SPDX-License-Identifier: Apache-2.0
// Number of points, of points that count (weight not 0), and sum of the weights; right one clock after a point's last beat.
// Without weights the three are one counter. `used` has no other witness, so it is kept twice: differ.
`resetall
`default_nettype none

module point_counter #(
    parameter WEIGHTED        = 1,
    parameter WEIGHT_SUM_BITS = 32
) (
    input  wire                       clk,
    input  wire                       rst,
    input  wire                       clear,
    input  wire                       point,
    input  wire [               15:0] weight,
    output wire [WEIGHT_SUM_BITS-1:0] weight_sum,
    output reg  [               15:0] count,
    output wire [               15:0] used,
    output wire                       differ   // an upset of `used`
);
  always @(posedge clk)
    if (rst || clear) count <= 0;
    else if (point) count <= count + 16'd1;

  generate
    if (WEIGHTED != 0) begin : g_weights
      reg [WEIGHT_SUM_BITS-1:0] sum;
      twin_register #(
          .WIDTH(16),
          .RESET(16'd0)
      ) counted (
          .clk(clk),
          .rst(rst || clear),
          .load(point && weight != 16'd0),
          .d(used + 16'd1),
          .q(used),
          .differ(differ)
      );
      always @(posedge clk)
        if (rst || clear) sum <= 0;
        else if (point) sum <= sum + {{WEIGHT_SUM_BITS - 16{1'b0}}, weight};
      assign weight_sum = sum;
    end else begin : g_count
      assign weight_sum = count;
      assign used = count;
      assign differ = 1'b0;
      /* verilator lint_off UNUSEDSIGNAL */
      wire unused = &weight;
      /* verilator lint_on UNUSEDSIGNAL */
    end
  endgenerate
endmodule

`resetall
