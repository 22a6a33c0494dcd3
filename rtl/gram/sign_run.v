// SPDX-License-Identifier: Apache-2.0
// How often the top bit of a 17-bit number repeats below itself: count = 0..15 up to the first change,
// any = there is a change (else count is 15). Combinational, three LUT levels.
// Changes are found by comparing neighbours, five bits a LUT, so that no bit waits for the sign.
`resetall
`default_nettype none

module sign_run (
    input  wire [16:0] bits,
    output wire [ 3:0] count,
    output wire        any
);
  wire [3:0] some;  // a change within the five bits
  wire [7:0] where;  // how far down
  genvar k;
  generate
    for (k = 0; k < 4; k = k + 1) begin : g_five
      wire [4:0] x = bits[4*k+:5];
      assign some[k] = !(&x || !(|x));
      assign where[2*k+1] = &x[4:2] || !(|x[4:2]);
      assign where[2*k] = (x[4:3] == 2'b00 && (x[2] || !x[1])) || (x[4:3] == 2'b11 && (!x[2] || x[1]));
    end
  endgenerate

  assign any = |some;
  assign count[3] = !(some[3] || some[2]);
  assign count[2] = !some[3] && (some[2] || !some[1]);
  assign count[1:0] = count[3] ? (count[2] ? where[1:0] : where[3:2]) : (count[2] ? where[5:4] : where[7:6]);
endmodule

`resetall
