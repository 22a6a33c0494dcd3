// SPDX-License-Identifier: Apache-2.0
// The smallest thing that counts, for the runner's own tests.
`resetall
`default_nettype none

module counter #(
    parameter WIDTH = 4
) (
    input wire clk,
    input wire rst,
    output reg [WIDTH-1:0] count
);
  always @(posedge clk) begin
    count <= count + 1'b1;
    if (rst) count <= {WIDTH{1'b0}};
  end
endmodule

`resetall
