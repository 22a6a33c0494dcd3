// SPDX-License-Identifier: Apache-2.0
// A register in three copies, of which the majority counts, bit by bit: one flipped flip-flop is never seen. d is the next value in every
// clock, made from q where the register holds, so that a flipped copy is right again in the next clock.
//
//   q = first second + first third + second third
//
// clock    0    1    2       a flip of one copy at the end of clock 0
// d        x    x    x
// first    x   ~x    x
// others   x    x    x
// q        x    x    x
//
// Latency: 1 cycle, and one LUT behind the flip-flops. keep: synthesis must not merge three flip-flops that are alike.
`resetall
`default_nettype none

module voted_register #(
    parameter WIDTH = 1,
    parameter [WIDTH-1:0] RESET = 0
) (
    input  wire             clk,
    input  wire             rst,
    input  wire [WIDTH-1:0] d,
    output wire [WIDTH-1:0] q
);
  (* keep = "true" *) reg [WIDTH-1:0] first;
  (* keep = "true" *) reg [WIDTH-1:0] second;
  (* keep = "true" *) reg [WIDTH-1:0] third;

  (* keep = "true" *) always @(posedge clk) begin
    first  <= d;
    second <= d;
    third  <= d;
    if (rst) begin
      first  <= RESET;
      second <= RESET;
      third  <= RESET;
    end
  end

  assign q = (first & second) | (first & third) | (second & third);

endmodule

`resetall
