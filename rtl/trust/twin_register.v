// SPDX-License-Identifier: Apache-2.0
// A register in two copies: one flipped flip-flop is seen, not mended. For what need only be noticed, at a third of a LUT a bit instead of
// voted_register's one. differ is up in every clock in which the copies are not alike: until the next load, or for one clock where
// every clock loads and d is made from q.
//
// clock    0    1    2    3    4       load every now and then; a flip of the second copy at the end of clock 1
// load     x              x
// q             a    a    a    b
// second        a   ~a   ~a    b
// differ             x    x
//
// Latency: 1 cycle. keep: synthesis must not merge two flip-flops that are alike.
`resetall
`default_nettype none

module twin_register #(
    parameter WIDTH = 1,
    parameter [WIDTH-1:0] RESET = 0
) (
    input  wire             clk,
    input  wire             rst,
    input  wire             load,
    input  wire [WIDTH-1:0] d,
    output wire [WIDTH-1:0] q,
    output wire             differ
);
  (* keep = "true" *) reg [WIDTH-1:0] first;
  (* keep = "true" *) reg [WIDTH-1:0] second;

  (* keep = "true" *) always @(posedge clk) begin
    if (load) begin
      first  <= d;
      second <= d;
    end
    if (rst) begin
      first  <= RESET;
      second <= RESET;
    end
  end

  // three pairs to a LUT6 (of a plain comparison synthesis makes LUT4s)
  localparam GROUPS = (WIDTH + 2) / 3;
  wire [3*GROUPS-1:0] apart = {{3 * GROUPS - WIDTH{1'b0}}, first ^ second};
  wire [GROUPS-1:0] groups;
  genvar i;
  generate
    for (i = 0; i < GROUPS; i = i + 1) begin : g_groups
      assign groups[i] = |apart[3*i+:3];
    end
  endgenerate

  assign q = first;
  assign differ = |groups;

endmodule

`resetall
