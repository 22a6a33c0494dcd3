// SPDX-License-Identifier: Apache-2.0
// Gathers what tells of an upset of a core's logic; see docs/decisions/upsets.md for what each one watches.
//
//   upset  ends the frame in the same clock: flag UPSET, no results, IDLE
//   give_up  a clock later: the loader swallows what is left of an open frame
//
//   lost       the state machine awaits a frame's end that the loader will not bring
//   rows       the array took another number of rows than the loader gave
//   mismatch   the exact sums disagree with the beats                      (VERIFY)
//   unchecked  a pass ends and no sums were compared with the beats        (VERIFY)
//   differs    a result word of the second pass is another one             (VERIFY)
//   record     what was recorded with the results is not what the array and the second pass say, as long as they hold it   (VERIFY)
//   differ     registers that are kept twice do
//   refused    the second pass has no solution                             (VERIFY)
// Latency 1, of `elsewhere` 0. Counts of rows are right from the first clock of COMPUTE on.
`resetall
`default_nettype none

module core_upsets #(
    parameter RECORD = 48,  // bits
    parameter VERIFY = 1
) (
    input  wire              clk,
    input  wire              rst,
    // frame_state
    input  wire              loading,
    input  wire              computing,
    input  wire              verifying,
    input  wire              again,
    input  wire              forget,        // the array does
    input  wire              ended,         // the pass gives its last word
    // frame_loader, Gram array
    input  wire              open,
    input  wire [      15:0] frame_rows,
    input  wire [      15:0] array_rows,
    input  wire              checked,       // pulse, of each pass
    input  wire              mismatch,      // with it
    input  wire              differ,
    // second pass
    input  wire              differs,
    input  wire              repeated,      // record_again is right from now on
    input  wire              refused,
    input  wire [RECORD-1:0] record,
    input  wire [RECORD-1:0] record_again,
    // other protections
    input  wire              elsewhere,     // as long as it lasts
    output wire              upset,
    output reg               give_up
);
  reg lost, rows, other;
  reg seen;  // checked, in this pass
  reg settled;

  always @(posedge clk) begin
    lost  <= loading && !open;
    rows  <= computing && frame_rows != array_rows;
    seen  <= (seen || checked) && !loading && !again;
    settled <= (settled || (verifying && repeated)) && !loading && !forget;
    other <= differ || (VERIFY != 0 && (((computing || verifying) && (mismatch || (ended && !seen))) ||
             (verifying && refused) || (settled && record != record_again)));
    give_up <= upset || (open && !loading);
    if (rst) {lost, rows, other, seen, settled, give_up} <= 6'd0;
  end

  assign upset = lost || rows || other || (VERIFY != 0 && differs) || elsewhere;
endmodule

`resetall
