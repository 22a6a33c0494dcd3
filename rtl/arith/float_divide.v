// SPDX-License-Identifier: Apache-2.0
// IEEE-754 binary32 quotient, round to nearest, ties to even; one division at a time.
//
//   quotient = x / y rounded once; x / 0 = infinity of the sign; 0/0, inf/inf = NaN; every NaN is 7FC00000
//   DENORMALS = 0: a denormal operand counts as zero of its sign; where IEEE's result is denormal, zero of its sign
//   (the quotient 2^-126 - 2^-150 becomes 2^-126, as in IEEE). DENORMALS = 1: gradual underflow.
//
//   signed radix 8 (srt_digit): r_0 = x_f / 4, r_(n+1) = 8 r_n - v_n y_f; x_f / y_f = 4 sum v_n 8^-n, n = 1..9: 26 bits
//   and the remainder, which gives the sticky bit and takes the last unit back where it is negative
//
// DENORMALS = 0: cycle | 0 start | 1..9 a digit each | 10 rounding | 11 done, quotient
// DENORMALS = 1: cycle | 0 start | 1 leading zeros known | 2 normalised | 3..11 a digit each | 12 quotient of 26 bits
//                      | 13 moved right, rounding | 14 done, quotient
// Latency 11 (DENORMALS = 0) or 14; `done` is high in that one cycle, `quotient` stays until the next one. A start before the
// cycle of `done` begins anew, a start in it is the next division: one every 11 or 14 clocks.
`resetall
`default_nettype none
module float_divide #(
    parameter DENORMALS = 0
) (
    input  wire        clk,
    input  wire        rst,
    input  wire        start,
    input  wire [31:0] x,
    input  wire [31:0] y,
    output reg         done,
    output reg  [31:0] quotient
);
  localparam LAST = DENORMALS == 0 ? 10 : 13;  // cycle of rounding
  reg  [3:0] step;  // 0 idle, else the cycle after start
  wire       finish = step == LAST[3:0] & ~start;
  always @(posedge clk) begin
    step <= start ? 4'd1 : (step == 4'd0 || step == LAST[3:0]) ? 4'd0 : step + 4'd1;
    done <= finish & ~rst;
    if (rst) step <= 4'd0;
  end

  // ---- what kind of operands
  wire x_normal = |x[30:23];
  wire y_normal = |y[30:23];
  wire x_some = |x[22:0];
  wire y_some = |y[22:0];
  wire x_zero = ~x_normal & (DENORMALS == 0 | ~x_some);
  wire y_zero = ~y_normal & (DENORMALS == 0 | ~y_some);
  wire x_ones = &x[30:23];
  wire y_ones = &y[30:23];
  wire invalid = (x_ones & (x_some | y_ones)) | (y_ones & y_some) | (x_zero & y_zero);
  reg negative, nan, infinite, zero;
  always @(posedge clk)
    if (start) begin
      negative <= (x[31] ^ y[31]) & ~invalid;
      nan      <= invalid;
      infinite <= x_ones | y_zero;  // or NaN
      zero     <= x_zero | y_ones;
    end

  // ---- normalised significands, and the difference of their exponents
  wire load;
  wire [23:0] x_f, y_f;
  wire signed [9:0] difference;
  generate
    if (DENORMALS == 0) begin : g_flush
      reg signed [9:0] held;
      assign load = start;
      assign x_f = {1'b1, x[22:0]};
      assign y_f = {1'b1, y[22:0]};
      assign difference = held;
      always @(posedge clk) if (start) held <= $signed({2'b00, x[30:23]}) - $signed({2'b00, y[30:23]});
    end else begin : g_gradual
      wire [4:0] x_count, y_count;
      leading_zeros_24 u_x (
          .bits ({x_normal, x[22:0]}),
          .count(x_count)
      );
      leading_zeros_24 u_y (
          .bits ({y_normal, y[22:0]}),
          .count(y_count)
      );
      reg [23:0] x_raw, y_raw, x_left, y_left;
      reg [4:0] x_zeros, y_zeros;
      reg [7:0] x_exponent, y_exponent;
      reg signed [9:0] held;
      assign load = step == 4'd2;
      assign x_f = x_left;
      assign y_f = y_left;
      assign difference = held;
      always @(posedge clk) begin
        if (start) begin
          x_raw      <= {x_normal, x[22:0]};
          y_raw      <= {y_normal, y[22:0]};
          x_zeros    <= x_count;
          y_zeros    <= y_count;
          x_exponent <= {x[30:24], x[23] | ~x_normal};
          y_exponent <= {y[30:24], y[23] | ~y_normal};
        end
        x_left <= x_raw << x_zeros;
        y_left <= y_raw << y_zeros;
        held <= $signed({2'b00, x_exponent}) - $signed({2'b00, y_exponent}) - $signed({5'd0, x_zeros}) +
            $signed({5'd0, y_zeros});
      end
    end
  endgenerate

  // ---- digits. The divisor is 4 y_f, so that x_f / 4 is an integer.
  reg [23:0] divisor;
  reg [25:0] triple;
  reg [13:0] five, seven;
  reg [26:0] remainder;
  wire [10:0] leading = {1'b0, y_f[23:14]};
  wire positive, subtract;
  wire [ 4:1] reached;
  wire [26:0] next;
  srt_digit #(
      .WIDTH(27)
  ) u_digit (
      .divisor({1'b0, divisor, 2'b00}),
      .triple({1'b0, triple, 2'b00}),
      .five(five),
      .seven(seven),
      .remainder(remainder),
      .positive(positive),
      .subtract(subtract),
      .reached(reached),
      .next(next)
  );

  // The digits so far as a binary number, and that less one: no carry has to run.
  reg [25:0] whole, less;
  wire opposite = ~positive & reached[1];
  wire [2:0] size = {reached[4], reached[2] & ~reached[4], (reached[1] & ~reached[2]) | (reached[3] & ~reached[4])};
  wire [2:0] digit = positive ? size : 3'd0 - size;
  always @(posedge clk) begin
    if (load) begin
      divisor   <= y_f;
      triple    <= {2'b00, y_f} + {1'b0, y_f, 1'b0};
      five      <= {1'b0, leading, 2'd0} + {3'd0, leading};
      seven     <= {leading, 3'd0} - {3'd0, leading};
      remainder <= {3'd0, x_f};
    end else remainder <= next;
    whole <= {opposite ? less[22:0] : whole[22:0], digit};
    less  <= {subtract ? whole[22:0] : less[22:0], digit - 3'd1};
  end

  // ---- x_f / y_f 2^25, rounded down, is in (2^24, 2^26)
  wire below_zero = remainder[26];
  wire high = below_zero ? less[25] : whole[25];
  wire [1:0] which = {high, below_zero};
  // bits: the 24 kept, without the leading one, and the bit below
  wire [23:0] bits;
  mux4 #(
      .WIDTH(24)
  ) u_bits (
      .select(which),
      .in_0(whole[23:0]),
      .in_1(less[23:0]),
      .in_2(whole[24:1]),
      .in_3(less[24:1]),
      .out(bits)
  );
  wire sticky = |remainder | (high & (below_zero ? less[0] : whole[0]));

  // exponent of the result, biased: difference + 126 + high
  wire over, under, edge_case;  // above 254; below 0, or 0 and no 2^-126; 0
  wire [7:0] base;  // exponent - 1
  wire hidden;
  wire [22:0] fraction;
  wire guard, lost;
  generate
    if (DENORMALS == 0) begin : g_round
      // the difference stands still for long enough
      reg above_128, is_128, below_m127, is_m127, is_m126;
      always @(posedge clk) begin
        above_128  <= difference > 128;
        is_128     <= difference == 128;
        below_m127 <= difference < -127;
        is_m127    <= difference == -127;
        is_m126    <= difference == -126;
      end
      assign over = above_128 | (is_128 & high);
      assign under = below_m127 | (is_m127 & ~high);
      assign edge_case = (is_m127 & high) | (is_m126 & ~high);
      assign base = difference[7:0] + (high ? 8'd126 : 8'd125);
      assign hidden = 1'b1;
      assign fraction = bits[23:1];
      assign guard = bits[0];
      assign lost = sticky;
    end else begin : g_move
      reg [24:0] kept;
      reg kept_sticky;
      reg signed [10:0] exponent;
      always @(posedge clk) begin
        kept        <= {1'b1, bits};
        kept_sticky <= sticky;
        exponent    <= $signed({difference[9], difference}) + (high ? 11'sd127 : 11'sd126);
      end
      wire signed [10:0] short = 11'sd1 - exponent;
      wire tiny = short > 0;
      wire [4:0] right = ~tiny ? 5'd0 : |short[9:5] ? 5'd31 : short[4:0];
      wire [24:0] moved = kept >> right;
      assign over = exponent > 254;
      assign under = 1'b0;
      assign edge_case = 1'b0;
      assign base = tiny ? 8'd0 : exponent[7:0] - 8'd1;
      assign {hidden, fraction, guard} = moved;
      assign lost = kept_sticky | (|(kept & ~(25'h1FFFFFF << right)));
      wire unused = &{1'b0, short[10]};
    end
  endgenerate

  // At exponent 0 the bits kept count half: nothing but 24 ones rounds to 2^-126, and they always do.
  wire up = (guard & (lost | fraction[0])) | edge_case;
  wire [30:0] rounded = {base, fraction} + {7'd0, hidden, 23'd0} + {30'd0, up};
  wire special = infinite | zero | over | under;
  wire ones = infinite | (over & ~zero);
  always @(posedge clk)
    if (finish) begin
      quotient[31]    <= negative;
      quotient[30:23] <= ((rounded[30:23] & {8{~special}}) | {8{ones}}) | {8{nan}};
      if (special | edge_case) quotient[22:0] <= 23'd0;
      else quotient[22:0] <= rounded[22:0];
      if (nan) quotient[22] <= 1'b1;
    end
endmodule
`resetall
