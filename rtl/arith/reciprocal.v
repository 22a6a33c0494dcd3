// SPDX-License-Identifier: Apache-2.0
// Reciprocal of a lane value by radix-8 restoring division.
//
//   1 / (m 2^e) = +-floor(2^64 / |m|) 4 * 2^(-e - 66), |m| in [2^33, 2^34], relative error below 2^-30
//   1 / 0 gives mantissa 2^33, exponent 2000: overflows binary32 and saturates Q15.16
//
// cycle | 0 start: |m| | 1 multiples of |m|, first digit | 2..11 three bits each | 12 result
// `done` marks cycle 12. A start while busy begins anew.
`resetall
`default_nettype none
module reciprocal (
    input  wire        clk,
    input  wire        rst,
    input  wire        start,
    input  wire [47:0] value,
    output wire        done,
    output wire [47:0] result
);
  reg [3:0] step;  // 0 idle, else the cycle after start
  reg negative, zero;
  reg [11:0] exponent;
  reg [34:0] divisor;
  // remainder < divisor <= 2^34; the multiples reach 7 * 2^34 < 2^37
  reg [34:0] remainder;
  reg [36:0] times_3, times_5, times_7;
  reg [31:0] quotient;

  wire [37:0] scaled = {remainder, 3'd0};
  wire [37:0] less_1 = scaled - {3'd0, divisor};
  wire [37:0] less_2 = scaled - {2'd0, divisor, 1'b0};
  wire [37:0] less_3 = scaled - {1'b0, times_3};
  wire [37:0] less_4 = scaled - {1'b0, divisor, 2'd0};
  wire [37:0] less_5 = scaled - {1'b0, times_5};
  wire [37:0] less_6 = scaled - {times_3, 1'b0};
  wire [37:0] less_7 = scaled - {1'b0, times_7};

  // Bit 37 of a difference says that the multiple was too large.
  reg [2:0] digit;
  reg [34:0] next_remainder;
  always @* begin
    if (!less_4[37]) begin
      if (!less_6[37]) begin
        digit = less_7[37] ? 3'd6 : 3'd7;
        next_remainder = less_7[37] ? less_6[34:0] : less_7[34:0];
      end else begin
        digit = less_5[37] ? 3'd4 : 3'd5;
        next_remainder = less_5[37] ? less_4[34:0] : less_5[34:0];
      end
    end else begin
      if (!less_2[37]) begin
        digit = less_3[37] ? 3'd2 : 3'd3;
        next_remainder = less_3[37] ? less_2[34:0] : less_3[34:0];
      end else begin
        digit = less_1[37] ? 3'd0 : 3'd1;
        next_remainder = less_1[37] ? scaled[34:0] : less_1[34:0];
      end
    end
  end

  wire smallest = divisor == 35'h200000000;  // 2^33: the first digit of 2^34 / |m| is 2, else 1

  always @(posedge clk) begin
    if (start) begin
      divisor  <= value[34] ? -value[34:0] : value[34:0];
      exponent <= value[46:35];
      zero     <= value[47];
      negative <= value[34];
    end
    if (step == 4'd1) begin
      times_3   <= {1'b0, divisor, 1'b0} + {2'd0, divisor};
      times_5   <= {divisor, 2'd0} + {2'd0, divisor};
      times_7   <= {divisor[33:0], 3'd0} - {2'd0, divisor};
      remainder <= smallest ? 35'd0 : 35'h400000000 - divisor;
      quotient  <= smallest ? 32'd2 : 32'd1;
    end else begin
      remainder <= next_remainder;
      quotient  <= {quotient[28:0], digit};
    end
    step <= start ? 4'd1 : (step == 4'd0 || step == 4'd12) ? 4'd0 : step + 4'd1;
    if (rst) step <= 4'd0;
  end

  wire [34:0] magnitude = {1'b0, quotient, 2'd0};
  wire [11:0] result_exponent = -exponent - 12'd66;
  assign done = step == 4'd12;
  assign result = zero ? {1'b0, 12'd2000, 35'h200000000}
                       : {1'b0, result_exponent, negative ? -magnitude : magnitude};

  wire unused = &{1'b0, less_1[36:35], less_2[36:35], less_3[36:35], less_4[36:35], less_5[36:35], less_6[36:35], less_7[36:35]};
endmodule
`resetall
