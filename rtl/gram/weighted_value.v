// SPDX-License-Identifier: Apache-2.0
// biased = weight * (u - SHIFT 2^15) + 2^15, latency 2, in two DSPs.
// The bias balances the lowest of the value's three 16-bit digits: v = weight * (u - SHIFT 2^15) = v2 2^32 + v1 2^16 + v0 with
//   v0 = biased[15:0] - 2^15,   v1 = biased[31:16] signed,   v2 = biased[47:32] + biased[31],   all in -2^15 .. 2^15-1.
// Width: |v| <= (2^16-1)(2^31+2^15) = 2^47 - 2^15, and v <= 2^47 - 2^32 - 2^15 + 1 upwards, so biased fits 48 bits and v2 16;
// without the shift |v| <= (2^16-1) 2^31 = 2^47 - 2^31, the same. The low limb of u is u[15:0] - 2^15, without the shift u[15:0].
`resetall
`default_nettype none

module weighted_value #(
    parameter SHIFT = 1
) (
    input  wire        clk,
    input  wire [15:0] weight,
    input  wire [31:0] component,
    output wire [47:0] biased
);
  wire signed [31:0] high_product;

  weight_product u_high (
      .clk(clk),
      .weight(weight),
      .limb(component[31:16]),
      .product(high_product)
  );

  localparam LIMB_BITS = SHIFT != 0 ? 16 : 17;
  wire signed [LIMB_BITS-1:0] low;

  generate
    if (SHIFT != 0) begin : g_shifted
      assign low = {~component[15], component[14:0]};
    end else begin : g_plain
      assign low = {1'b0, component[15:0]};
    end
  endgenerate

  weight_product_add #(
      .LIMB_BITS(LIMB_BITS)
  ) u_low (
      .clk(clk),
      .weight(weight),
      .limb(low),
      .addend({high_product, 16'h8000}),
      .total(biased)
  );
endmodule

`resetall
