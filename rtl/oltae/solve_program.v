// SPDX-License-Identifier: Apache-2.0
// Microprogram of the solve engine. Written by `python -m relnav.model.rom` from sw/relnav/model/pose_program.py: do not edit.
//
// The word of cycle c is at the outputs in cycle c when `counter` was c one clock earlier. Cycle 0 is the one in which the
// first moment item arrives. Fields after `reference` belong to the dot product that ends with the slot.
`resetall
`default_nettype none
module solve_program (
    input  wire       clk,
    input  wire       run,
    input  wire [8:0] counter,
    output wire [5:0] x_address,
    output wire x_by_lane,
    output wire [4:0] y_address,
    output wire y_by_lane,
    output wire [3:0] alternate,
    output wire [3:0] negate,
    output wire [3:0] enable,
    output wire first,
    output wire [2:0] reference,
    output wire last,
    output wire [1:0] kind,
    output wire half,
    output wire [1:0] write,
    output wire [2:0] source,
    output wire [4:0] dest,
    output wire turn_dest,
    output wire only_turned,
    output wire choose_turn,
    output wire [1:0] track,
    output wire [1:0] divide,
    output wire [4:0] divide_dest,
    output wire [1:0] result_output,
    output wire [5:0] output_index,
    output wire [1:0] mark,
    output wire       finished
);
  reg [64:0] word;
  always @(posedge clk)
    case (run ? counter : 9'd511)
      9'd6: word <= 65'h100000f9000000000;  // M33 1/4
      9'd7: word <= 65'h140000f1000000000;  // M33 2/4
      9'd8: word <= 65'h13000cf1000000000;  // M33 3/4
      9'd9: word <= 65'h17000af1a44c00000;  // M33 4/4
      9'd10: word <= 65'h140000f9000000000;  // M11 1/4
      9'd11: word <= 65'h180000f1000000000;  // M11 2/4
      9'd12: word <= 65'h17000af1000000000;  // M11 3/4
      9'd13: word <= 65'h1b0006f1a44400000;  // M11 4/4
      9'd14: word <= 65'h100000f9000000000;  // M22 1/4
      9'd15: word <= 65'h180000f1000000000;  // M22 2/4
      9'd16: word <= 65'h13000cf1000000000;  // M22 3/4
      9'd17: word <= 65'h1b0006f1a44800000;  // M22 4/4
      9'd18: word <= 65'h110069f9000000000;  // M12 1/2
      9'd19: word <= 65'h120065f1a45c00000;  // M12 2/2
      9'd20: word <= 65'h1900a5f9000000000;  // M31 1/2
      9'd21: word <= 65'h1a00a3f1a45800000;  // M31 2/2
      9'd22: word <= 65'h1500c3f9000000000;  // M23 1/2
      9'd23: word <= 65'h1600c9f1a45400000;  // M23 2/2
      9'd24: word <= 65'h1a80a3faa40800000;  // z2 1/1
      9'd25: word <= 65'h1680c9faa40400000;  // z1 1/1
      9'd26: word <= 65'h1c0000f880000a000;  // 1/W 1/1
      9'd27: word <= 65'h128065faa40c00000;  // z3 1/1
      9'd28: word <= 65'h92600f8000000000;  // C11 1/2
      9'd29: word <= 65'haaa0ff0a41400000;  // C11 2/2
      9'd30: word <= 65'hbaa00f8000000000;  // C13 1/2
      9'd31: word <= 65'hb240ff0a42800000;  // C13 2/2
      9'd32: word <= 65'hb2a00f8000000000;  // C12 1/2
      9'd33: word <= 65'hba60ff0a42c00000;  // C12 2/2
      9'd34: word <= 65'hbac00f8000000000;  // C23 1/2
      9'd35: word <= 65'h8aa0ff0a42400000;  // C23 2/2
      9'd36: word <= 65'h8a400f8000000000;  // C33 1/2
      9'd37: word <= 65'hbae0ff0a41c00000;  // C33 2/2
      9'd38: word <= 65'h8a600f8000000000;  // C22 1/2
      9'd39: word <= 65'hb2c0ff0a41800000;  // C22 2/2
      9'd40: word <= 65'h88a00f8000000000;  // D 1/3
      9'd41: word <= 65'hb1400f0000000000;  // D 2/3
      9'd42: word <= 65'hb9600f09a12b4000;  // D 3/3
      9'd43: word <= 65'h4830fc8000000000;  // P0 1/4
      9'd44: word <= 65'h5050fa0000000000;  // P0 2/4
      9'd45: word <= 65'h5870f60000000000;  // P0 3/4
      9'd46: word <= 65'h2410ee08a313c000;  // P0 4/4
      9'd47: word <= 65'h48109c8000000000;  // P1 1/4
      9'd48: word <= 65'h5070950000000000;  // P1 2/4
      9'd49: word <= 65'h5850990000000000;  // P1 3/4
      9'd50: word <= 65'h2c30bf08a3420000;  // P1 4/4
      9'd52: word <= 65'h4870338000000000;  // P2 1/4
      9'd53: word <= 65'h50103a0000000000;  // P2 2/4
      9'd54: word <= 65'h5830390000000000;  // P2 3/4
      9'd55: word <= 65'h34507f08a3820000;  // P2 4/4
      9'd56: word <= 65'h4850538000000000;  // P3 1/4
      9'd57: word <= 65'h5030550000000000;  // P3 2/4
      9'd58: word <= 65'h5810560000000000;  // P3 3/4
      9'd59: word <= 65'h3c70df08a3c20000;  // P3 4/4
      9'd60: word <= 65'h139000f8886440000;  // ca1 1/1
      9'd61: word <= 65'h179000f8886840000;  // ca2 1/1
      9'd62: word <= 65'h1b9000f8886c40000;  // ca3 1/1
      9'd63: word <= 65'h1c9000f8887440000;  // cb1 1/1
      9'd64: word <= 65'h1d1000f8887840000;  // cb2 1/1
      9'd65: word <= 65'h1d9000f8887c40000;  // cb3 1/1
      9'd66: word <= 65'h6a000f8800000100;  // q1 1/1
      9'd67: word <= 65'h72000f8800000104;  // q2 1/1
      9'd68: word <= 65'h7a000f8800000109;  // q3 1/1
      9'd69: word <= 65'h61800fb000000000;  // den 1/4
      9'd70: word <= 65'h69a00f3000000000;  // den 2/4
      9'd71: word <= 65'h71c00f3000000000;  // den 3/4
      9'd72: word <= 65'h79e00f390000d000;  // den 4/4
      9'd73: word <= 65'h65a00eb000000000;  // A1 1/2
      9'd74: word <= 65'h61b04e3844400000;  // A1 2/2
      9'd75: word <= 65'h65c00eb000000000;  // A2 1/2
      9'd76: word <= 65'h61d08e3844800000;  // A2 2/2
      9'd77: word <= 65'h65e00eb000000000;  // A3 1/2
      9'd78: word <= 65'h61f02e3844c00000;  // A3 2/2
      9'd79: word <= 65'h6a000ffc0000000c;  // qfixed1 1/1
      9'd80: word <= 65'h72000ffc00000010;  // qfixed2 1/1
      9'd81: word <= 65'h7a000ffc00000014;  // qfixed3 1/1
      9'd84: word <= 65'hca200ee000000000;  // u 1/3
      9'd85: word <= 65'hd2400e6000000000;  // u 2/3
      9'd86: word <= 65'hda600e6846000000;  // u 3/3
      9'd92: word <= 65'h8a800ec000000000;  // R1 1/2
      9'd93: word <= 65'hf24800000318;  // R1 2/2
      9'd95: word <= 65'h92800ec000000000;  // R2 1/2
      9'd96: word <= 65'hf4480000031c;  // R2 2/2
      9'd98: word <= 65'h9a800ec000000000;  // R3 1/2
      9'd99: word <= 65'hf84800000320;  // R3 2/2
      9'd100: word <= 65'hc4000ed000000000;  // t 1/3
      9'd101: word <= 65'he4000e5000000000;  // t 2/3
      9'd102: word <= 65'hc280fe580000023e;  // t 3/3
      default: word <= 65'd0;
    endcase
  assign finished = counter == 9'd103;
  assign x_address = word[64:59];
  assign x_by_lane = word[58];
  assign y_address = word[57:53];
  assign y_by_lane = word[52];
  assign alternate = word[51:48];
  assign negate = word[47:44];
  assign enable = word[43:40];
  assign first = word[39];
  assign reference = word[38:36];
  assign last = word[35];
  assign kind = word[34:33];
  assign half = word[32];
  assign write = word[31:30];
  assign source = word[29:27];
  assign dest = word[26:22];
  assign turn_dest = word[21];
  assign only_turned = word[20];
  assign choose_turn = word[19];
  assign track = word[18:17];
  assign divide = word[16:15];
  assign divide_dest = word[14:10];
  assign result_output = word[9:8];
  assign output_index = word[7:2];
  assign mark = word[1:0];
endmodule
`resetall
