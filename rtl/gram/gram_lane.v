// SPDX-License-Identifier: Apache-2.0
// One lane of the Gram array: the limb products of one pair of taps, summed for SLOTS pairs in turn.
//   hh += x_high y_high,  ll += x_low y_low,  kk += x_both y_both      (Karatsuba: both = high + low)
// Operands are packed {both[16:0], high, low}, limbs of 16 bits (Y_BITS = 17: y's of 17, in -2^15 .. 2^15). Sums are modulo 2^48: |hh| and
// |ll| stay below 2^47 (weighted, where hh takes two products a point: 65535 * 2 * 2^30 < 2^47), kk may wrap: kk - hh - ll is right
// modulo 2^48 and its true value is below 2^47.
// WEIGHTED = 1: the low cell has a second set of sums, `top` (see weight_digits), so its sums live in a LUTRAM, not in a ring.
// TOP_KEPT = 1: `top` is what that memory showed at top_load; 0: what it shows now.
// X_HOLD = 1: x is taken with hold_x and used from load_x on (mac_cell).
// The lane is moved by a lane_control. `sums` = the slot the ring shows at its head.
`resetall
`default_nettype none

module gram_lane #(
    parameter WEIGHTED = 1,
    parameter SLOTS    = 3,
    parameter Y_BITS   = 16,  // limb of y
    parameter X_HOLD   = 0,
    parameter TOP_KEPT = 1
) (
    input  wire                 clk,
    input  wire                 clear,
    input  wire                 hold_x,
    input  wire                 load_x,
    input  wire                 load_y,
    input  wire [         48:0] x,
    input  wire [2*Y_BITS+16:0] y,
    // from lane_control
    input  wire                 skip,
    input  wire                 fresh,
    input  wire                 accumulate,
    input  wire                 write,
    input  wire [          2:0] write_address,
    input  wire [          2:0] read_address,
    // from the drain
    input  wire                 top_load,      // keep what the memory shows as `top`
    // sums
    output wire [         47:0] high,
    output wire [         47:0] low,
    output wire [         47:0] both,
    output wire [         47:0] top
);
  wire [47:0] high_addend, low_addend, both_addend;

  mac_cell #(
      .X_BITS(16),
      .Y_BITS(Y_BITS),
      .X_HOLD(X_HOLD)
  ) u_high (
      .clk(clk),
      .clear(clear),
      .hold_x(hold_x),
      .load_x(load_x),
      .load_y(load_y),
      .x(x[31:16]),
      .y(y[Y_BITS+:Y_BITS]),
      .skip(skip),
      .addend_clear(clear),
      .addend_load(accumulate),
      .addend_in(high_addend),
      .accumulate(accumulate),
      .sum(high)
  );

  ring_store #(
      .DEPTH(SLOTS - 2)
  ) u_high_ring (
      .clk(clk),
      .clear(clear),
      .advance(accumulate),
      .from_sum(high),
      .to_addend(high_addend)
  );

  mac_cell #(
      .X_BITS(17),
      .Y_BITS(17),
      .X_HOLD(X_HOLD)
  ) u_both (
      .clk(clk),
      .clear(clear),
      .hold_x(hold_x),
      .load_x(load_x),
      .load_y(load_y),
      .x(x[48:32]),
      .y(y[2*Y_BITS+:17]),
      .skip(skip),
      .addend_clear(clear),
      .addend_load(accumulate),
      .addend_in(both_addend),
      .accumulate(accumulate),
      .sum(both)
  );

  ring_store #(
      .DEPTH(SLOTS - 2)
  ) u_both_ring (
      .clk(clk),
      .clear(clear),
      .advance(accumulate),
      .from_sum(both),
      .to_addend(both_addend)
  );

  mac_cell #(
      .X_BITS(16),
      .Y_BITS(Y_BITS),
      .X_HOLD(X_HOLD)
  ) u_low (
      .clk(clk),
      .clear(clear),
      .hold_x(hold_x),
      .load_x(load_x),
      .load_y(load_y),
      .x(x[15:0]),
      .y(y[0+:Y_BITS]),
      .skip(skip),
      .addend_clear(WEIGHTED != 0 ? fresh : clear),
      .addend_load(WEIGHTED != 0 ? 1'b1 : accumulate),
      .addend_in(low_addend),
      .accumulate(accumulate),
      .sum(low)
  );

  generate
    if (WEIGHTED != 0) begin : g_sets
      set_store u_sets (
          .clk(clk),
          .write(write),
          .write_address(write_address),
          .from_sum(low),
          .read_address(read_address),
          .to_addend(low_addend)
      );
      if (TOP_KEPT != 0) begin : g_kept
        reg [47:0] top_kept;
        always @(posedge clk) if (top_load) top_kept <= low_addend;
        assign top = top_kept;
      end else begin : g_now
        assign top = low_addend;
        /* verilator lint_off UNUSEDSIGNAL */
        wire unused = top_load;
        /* verilator lint_on UNUSEDSIGNAL */
      end
    end else begin : g_ring
      ring_store #(
          .DEPTH(SLOTS - 2)
      ) u_low_ring (
          .clk(clk),
          .clear(clear),
          .advance(accumulate),
          .from_sum(low),
          .to_addend(low_addend)
      );
      assign top = 48'd0;
      /* verilator lint_off UNUSEDSIGNAL */
      wire unused = &{fresh, write, write_address, read_address, top_load};
      /* verilator lint_on UNUSEDSIGNAL */
    end
  endgenerate
endmodule

`resetall
