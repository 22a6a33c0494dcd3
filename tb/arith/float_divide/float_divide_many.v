// SPDX-License-Identifier: Apache-2.0
// As many float_divide of either build as keep up with a pair a clock, started in turn.
`resetall
`default_nettype none

module float_divide_many #(
    parameter DEPTH = 262144
) (
    input  wire clk,
    input  wire rst,
    output wire done
);
  localparam FLUSH = 11;  // latencies, and as many dividers
  localparam GRADUAL = 14;
  wire [7:0] control;  // bit 0: a pair
  wire [31:0] x, y;

  // The quicker build's results wait for the other's.
  reg [32*(GRADUAL-FLUSH)-1:0] waiting;
  reg [GRADUAL-1:0] live;
  reg [3:0] turn_flush, turn_gradual;
  wire [FLUSH-1:0] flushed_done;
  wire [GRADUAL-1:0] gradual_done;
  wire [32*FLUSH-1:0] flushed_all;
  wire [32*GRADUAL-1:0] gradual_all;
  wire [31:0] flushed = flushed_all[32*turn_flush+:32];
  wire [31:0] gradual = gradual_all[32*turn_gradual+:32];
  reg [GRADUAL-FLUSH-1:0] sound;  // the quicker build's `done`, where a result was due
  always @(posedge clk) begin
    live <= rst ? {GRADUAL{1'b0}} : {live[GRADUAL-2:0], control[0]};
    waiting <= {waiting[32*(GRADUAL-FLUSH-1)-1:0], flushed};
    sound <= {sound[GRADUAL-FLUSH-2:0], flushed_done[turn_flush] == live[FLUSH-1]};
    turn_flush <= rst || turn_flush == FLUSH - 1 ? 4'd0 : turn_flush + 4'd1;
    turn_gradual <= rst || turn_gradual == GRADUAL - 1 ? 4'd0 : turn_gradual + 4'd1;
  end

  genvar n;
  generate
    for (n = 0; n < FLUSH; n = n + 1) begin : g_flush
      float_divide #(
          .DENORMALS(0)
      ) dut (
          .clk(clk),
          .rst(rst),
          .start(control[0] && turn_flush == n),
          .x(x),
          .y(y),
          .done(flushed_done[n]),
          .quotient(flushed_all[32*n+:32])
      );
    end
    for (n = 0; n < GRADUAL; n = n + 1) begin : g_gradual
      float_divide #(
          .DENORMALS(1)
      ) dut (
          .clk(clk),
          .rst(rst),
          .start(control[0] && turn_gradual == n),
          .x(x),
          .y(y),
          .done(gradual_done[n]),
          .quotient(gradual_all[32*n+:32])
      );
    end
  endgenerate

  wire valid = gradual_done[turn_gradual] & sound[GRADUAL-FLUSH-1];
  replay #(
      .IN_BITS (8 + 32 + 32),
      .OUT_BITS(1 + 32 + 32),
      .DEPTH   (DEPTH)
  ) u_replay (
      .clk(clk),
      .rst(rst),
      .word({control, x, y}),
      .result({valid, waiting[32*(GRADUAL-FLUSH-1)+:32], gradual}),
      .done(done)
  );
endmodule

`resetall
