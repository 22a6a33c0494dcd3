// SPDX-License-Identifier: Apache-2.0
// Written by `python -m relnav.regtool` from registers/ivisnav.rdl; do not edit.
// To be included inside a module. Byte addresses; is_mapped takes the word address.
/* verilator lint_off UNUSEDPARAM */
localparam [11:0] ID_ADDRESS = 12'h000;
localparam [31:0] ID_RESET = 32'h49564953;
localparam [11:0] VERSION_ADDRESS = 12'h004;
localparam [31:0] VERSION_RESET = 32'h00000100;
localparam integer VERSION_PATCH_LSB = 0;
localparam integer VERSION_PATCH_WIDTH = 8;
localparam integer VERSION_MINOR_LSB = 8;
localparam integer VERSION_MINOR_WIDTH = 8;
localparam integer VERSION_MAJOR_LSB = 16;
localparam integer VERSION_MAJOR_WIDTH = 8;
localparam [11:0] BUILD_ADDRESS = 12'h008;
localparam integer BUILD_VERIFY_LSB = 3;
localparam integer BUILD_MANTISSA_LSB = 8;
localparam integer BUILD_MANTISSA_WIDTH = 8;
localparam [11:0] CONTROL_ADDRESS = 12'h00C;
localparam [31:0] CONTROL_RESET = 32'h00000000;
localparam integer CONTROL_SOFT_RESET_LSB = 0;
localparam integer CONTROL_ACKNOWLEDGE_LSB = 1;
localparam [11:0] STATUS_ADDRESS = 12'h010;
localparam integer STATUS_STATE_LSB = 0;
localparam integer STATUS_STATE_WIDTH = 3;
localparam integer STATUS_BUSY_LSB = 4;
localparam integer STATUS_RATES_READY_LSB = 5;
localparam integer STATUS_ALL_READY_LSB = 7;
localparam integer STATUS_PUSH_READY_LSB = 8;
localparam integer STATUS_FRAME_LSB = 16;
localparam integer STATUS_FRAME_WIDTH = 16;
localparam [11:0] FLAGS_ADDRESS = 12'h014;
localparam [31:0] FLAGS_RESET = 32'h00000000;
localparam integer FLAGS_FEW_ROWS_LSB = 0;
localparam integer FLAGS_RANK_DEFICIENT_LSB = 1;
localparam integer FLAGS_ZERO_WEIGHT_LSB = 2;
localparam integer FLAGS_TOO_LONG_LSB = 3;
localparam integer FLAGS_BAD_TLAST_LSB = 4;
localparam integer FLAGS_BUSY_WRITE_LSB = 5;
localparam integer FLAGS_ILL_CONDITIONED_LSB = 7;
localparam integer FLAGS_WATCHDOG_LSB = 8;
localparam integer FLAGS_UPSET_LSB = 10;
localparam [11:0] FRAME_FLAGS_ADDRESS = 12'h018;
localparam integer FRAME_FLAGS_FEW_ROWS_LSB = 0;
localparam integer FRAME_FLAGS_RANK_DEFICIENT_LSB = 1;
localparam integer FRAME_FLAGS_ZERO_WEIGHT_LSB = 2;
localparam integer FRAME_FLAGS_TOO_LONG_LSB = 3;
localparam integer FRAME_FLAGS_BAD_TLAST_LSB = 4;
localparam integer FRAME_FLAGS_BUSY_WRITE_LSB = 5;
localparam integer FRAME_FLAGS_ILL_CONDITIONED_LSB = 7;
localparam integer FRAME_FLAGS_WATCHDOG_LSB = 8;
localparam integer FRAME_FLAGS_UPSET_LSB = 10;
localparam [11:0] IRQ_ENABLE_ADDRESS = 12'h01C;
localparam [31:0] IRQ_ENABLE_RESET = 32'h00000000;
localparam integer IRQ_ENABLE_DONE_LSB = 0;
localparam integer IRQ_ENABLE_ERROR_LSB = 1;
localparam [11:0] IRQ_STATUS_ADDRESS = 12'h020;
localparam [31:0] IRQ_STATUS_RESET = 32'h00000000;
localparam integer IRQ_STATUS_DONE_LSB = 0;
localparam integer IRQ_STATUS_ERROR_LSB = 1;
localparam [11:0] FRAC_ADDRESS = 12'h028;
localparam [31:0] FRAC_RESET = 32'h00000000;
localparam integer FRAC_FRAC_H_LSB = 0;
localparam integer FRAC_FRAC_H_WIDTH = 8;
localparam integer FRAC_FRAC_Y_LSB = 8;
localparam integer FRAC_FRAC_Y_WIDTH = 8;
localparam [11:0] VARIANCE_ADDRESS = 12'h02C;
localparam [31:0] VARIANCE_RESET = 32'h00000000;
localparam [11:0] DATA_A_ADDRESS = 12'h040;
localparam [31:0] DATA_A_RESET = 32'h00000000;
localparam [11:0] DATA_B_ADDRESS = 12'h044;
localparam [31:0] DATA_B_RESET = 32'h00000000;
localparam [11:0] PUSH_ADDRESS = 12'h048;
localparam [31:0] PUSH_RESET = 32'h00000000;
localparam integer PUSH_LAST_LSB = 0;
localparam [11:0] ROWS_ADDRESS = 12'h060;
localparam integer ROWS_VALUE_LSB = 0;
localparam integer ROWS_VALUE_WIDTH = 16;
localparam [11:0] WEIGHT_ADDRESS = 12'h064;
localparam [11:0] CONDITION_ADDRESS = 12'h068;
localparam [11:0] CYCLES_RATES_ADDRESS = 12'h06C;
localparam integer CYCLES_RATES_VALUE_LSB = 0;
localparam integer CYCLES_RATES_VALUE_WIDTH = 16;
localparam [11:0] CYCLES_ALL_ADDRESS = 12'h074;
localparam integer CYCLES_ALL_VALUE_LSB = 0;
localparam integer CYCLES_ALL_VALUE_WIDTH = 16;
localparam [11:0] V_ADDRESS = 12'h100;
localparam integer V_COUNT = 3;
localparam [11:0] OMEGA_ADDRESS = 12'h10C;
localparam integer OMEGA_COUNT = 3;
localparam [11:0] RSS_ADDRESS = 12'h118;
localparam [11:0] COV_ADDRESS = 12'h11C;
localparam integer COV_COUNT = 21;
localparam [2:0] STATE_IDLE = 3'd0;
localparam [2:0] STATE_SEND_DATA = 3'd1;
localparam [2:0] STATE_COMPUTE = 3'd2;
localparam [2:0] STATE_DONE = 3'd3;
localparam [2:0] STATE_VERIFY = 3'd4;
/* verilator lint_on UNUSEDPARAM */

function is_mapped;
  input [9:0] word;
  case (word)
    10'h000, 10'h001, 10'h002, 10'h003, 10'h004, 10'h005, 10'h006, 10'h007, 10'h008, 10'h00A,
    10'h00B, 10'h010, 10'h011, 10'h012, 10'h018, 10'h019, 10'h01A, 10'h01B, 10'h01D, 10'h040,
    10'h041, 10'h042, 10'h043, 10'h044, 10'h045, 10'h046, 10'h047, 10'h048, 10'h049, 10'h04A,
    10'h04B, 10'h04C, 10'h04D, 10'h04E, 10'h04F, 10'h050, 10'h051, 10'h052, 10'h053, 10'h054,
    10'h055, 10'h056, 10'h057, 10'h058, 10'h059, 10'h05A, 10'h05B: is_mapped = 1;
    default: is_mapped = 0;
  endcase
endfunction
