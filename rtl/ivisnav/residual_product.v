// SPDX-License-Identifier: Apache-2.0
// Exact product of an integer moment and a rate's 24-bit significand, six DSP48E1.
//
//   product = moment * significand,   moment = sum of limbs l_k 2^(17 k), k = 0..5, the highest signed (11 bits), the others unsigned
//
// Products of limbs three apart do not overlap (41 bits, 51 apart): six products are three words, and two sums.
// Width: |moment| <= 2^95, significand < 2^24: 120 bits signed.
//
// cycle | 0 operands registered at its end | 1 limb products | 2 words 0 and 1 summed | 3 all summed; `product` in cycle 4
`resetall
`default_nettype none
module residual_product (
    input  wire                clk,
    input  wire signed [ 95:0] moment,
    input  wire        [ 23:0] significand,
    output reg signed  [119:0] product
);
  reg signed [95:0] limbs;
  reg [23:0] factor;
  always @(posedge clk) begin
    limbs  <= moment;
    factor <= significand;
  end

  wire [6*42-1:0] partial;
  genvar k;
  generate
    for (k = 0; k < 6; k = k + 1) begin : g_limb
      wire signed [17:0] limb;
      if (k < 5) begin : g_unsigned
        assign limb = {1'b0, limbs[17*k+:17]};
      end else begin : g_signed
        assign limb = {{7{limbs[95]}}, limbs[95:85]};
      end
      reg signed [41:0] limb_product;
      wire signed [42:0] full = limb * $signed({1'b0, factor});
      always @(posedge clk) limb_product <= full[41:0];  // |limb| < 2^17
      assign partial[42*k+:42] = limb_product;
      wire unused = full[42];
    end
  endgenerate

  wire [91:0] word_0 = {partial[42*3+:41], 10'd0, partial[42*0+:41]};
  wire [91:0] word_1 = {partial[42*4+:41], 10'd0, partial[42*1+:41]};
  wire [85:0] word_2 = {partial[42*5+:35], 10'd0, partial[42*2+:41]};
  wire unused_tops = &{1'b0, partial[42*0+41], partial[42*1+41], partial[42*2+41], partial[42*3+41], partial[42*4+41],
                       partial[42*5+35+:7]};

  reg [108:0] lower;  // the highest partial products and a carry stay below 2^41
  reg [ 85:0] upper;
  wire [85:0] top = {11'd0, lower[108:34]} + upper;  // signed: the sum fits
  always @(posedge clk) begin
    lower   <= {{17'd0, word_0[91:17]} + word_1, word_0[16:0]};
    upper   <= word_2;
    product <= {top, lower[33:0]};
  end
endmodule
`resetall
