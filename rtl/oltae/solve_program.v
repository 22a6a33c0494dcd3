// SPDX-License-Identifier: Apache-2.0
// Microprogram of the solve engine. Written by `python -m relnav.model.rom` from sw/relnav/model/pose_program.py and
// statistics_program.py: do not edit.
//
// The word at `address` is at the outputs a clock later; none while `run` is low. Fields after `reference_code` belong to the dot
// product that ends with the slot. `redrain` asks for the low limbs of the moments.
`resetall
`default_nettype none
module solve_program #(
    parameter COVARIANCE = 1
) (
    input  wire       clk,
    input  wire       run,
    input  wire [9:0] address,
    output wire [5:0] x_address,
    output wire x_by_lane,
    output wire [4:0] y_address,
    output wire y_by_lane,
    output wire [3:0] alternate,
    output wire [3:0] negate,
    output wire [3:0] enable,
    output wire first,
    output wire only_estimated,
    output wire [3:0] reference_code,
    output wire last,
    output wire [1:0] kind,
    output wire half,
    output wire clamp,
    output wire [1:0] write,
    output wire [2:0] source,
    output wire [4:0] dest,
    output wire turn_dest,
    output wire only_turned,
    output wire choose_turn,
    output wire [1:0] track,
    output wire [1:0] divide,
    output wire [4:0] divide_dest,
    output wire [2:0] result_output,
    output wire [5:0] output_index,
    output wire [2:0] mark,
    output wire       redrain,
    output wire       finished
);
  reg [69:0] word;
  always @(posedge clk)
    case (run ? address : {10{1'b1}})
      10'd6: word <= 70'h200001f08000000000;  // M33 1/4
      10'd7: word <= 70'h280001e08000000000;  // M33 2/4
      10'd8: word <= 70'h260019e08000000000;  // M33 3/4
      10'd9: word <= 70'h2e0015e0d113000000;  // M33 4/4
      10'd10: word <= 70'h280001f08000000000;  // M11 1/4
      10'd11: word <= 70'h300001e08000000000;  // M11 2/4
      10'd12: word <= 70'h2e0015e08000000000;  // M11 3/4
      10'd13: word <= 70'h36000de0d111000000;  // M11 4/4
      10'd14: word <= 70'h200001f08000000000;  // M22 1/4
      10'd15: word <= 70'h300001e08000000000;  // M22 2/4
      10'd16: word <= 70'h260019e08000000000;  // M22 3/4
      10'd17: word <= 70'h36000de0d112000000;  // M22 4/4
      10'd18: word <= 70'h2200d3f08000000000;  // M12 1/2
      10'd19: word <= 70'h2400cbe0d117000000;  // M12 2/2
      10'd20: word <= 70'h32014bf08000000000;  // M31 1/2
      10'd21: word <= 70'h340147e0d116000000;  // M31 2/2
      10'd22: word <= 70'h2a0187f08000000000;  // M23 1/2
      10'd23: word <= 70'h2c0193e0d115000000;  // M23 2/2
      10'd24: word <= 70'h350147f15102000000;  // z2 1/1
      10'd25: word <= 70'h380001f04000028000;  // 1/W 1/1
      10'd26: word <= 70'h2d0193f15101000000;  // z1 1/1
      10'd27: word <= 70'h2500cbf15103000000;  // z3 1/1
      10'd28: word <= 70'h124c01f00000000000;  // C11 1/2
      10'd29: word <= 70'h15541fe05105000000;  // C11 2/2
      10'd30: word <= 70'h175401f00000000000;  // C13 1/2
      10'd31: word <= 70'h16481fe0510a000000;  // C13 2/2
      10'd32: word <= 70'h165401f00000000000;  // C12 1/2
      10'd33: word <= 70'h174c1fe0510b000000;  // C12 2/2
      10'd34: word <= 70'h175801f00000000000;  // C23 1/2
      10'd35: word <= 70'h11541fe05109000000;  // C23 2/2
      10'd36: word <= 70'h114801f00000000000;  // C33 1/2
      10'd37: word <= 70'h175c1fe05107000000;  // C33 2/2
      10'd38: word <= 70'h114c01f00000000000;  // C22 1/2
      10'd39: word <= 70'h16581fe05106000000;  // C22 2/2
      10'd40: word <= 70'h111401f00000000000;  // D 1/3
      10'd41: word <= 70'h162801e00000000000;  // D 2/3
      10'd42: word <= 70'h172c01e04a84ad0000;  // D 3/3
      10'd43: word <= 70'h9061f900000000000;  // P0 1/4
      10'd44: word <= 70'ha0a1f400000000000;  // P0 2/4
      10'd45: word <= 70'hb0e1ec00000000000;  // P0 3/4
      10'd46: word <= 70'h4821dc0428c4f0000;  // P0 4/4
      10'd47: word <= 70'h90213900000000000;  // P1 1/4
      10'd48: word <= 70'ha0e12a00000000000;  // P1 2/4
      10'd49: word <= 70'hb0a13200000000000;  // P1 3/4
      10'd50: word <= 70'h58617e0428d080000;  // P1 4/4
      10'd51: word <= 70'h90e06700000000000;  // P2 1/4
      10'd52: word <= 70'ha0207400000000000;  // P2 2/4
      10'd53: word <= 70'hb0607200000000000;  // P2 3/4
      10'd54: word <= 70'h68a0fe0428e080000;  // P2 4/4
      10'd55: word <= 70'h90a0a700000000000;  // P3 1/4
      10'd56: word <= 70'ha060aa00000000000;  // P3 2/4
      10'd57: word <= 70'hb020ac00000000000;  // P3 3/4
      10'd58: word <= 70'h78e1be0428f080000;  // P3 4/4
      10'd59: word <= 70'h272001f04219100000;  // ca1 1/1
      10'd60: word <= 70'h2f2001f0421a100000;  // ca2 1/1
      10'd61: word <= 70'h372001f0421b100000;  // ca3 1/1
      10'd62: word <= 70'h392001f0421d100000;  // cb1 1/1
      10'd63: word <= 70'h3a2001f0421e100000;  // cb2 1/1
      10'd64: word <= 70'h3b2001f0421f100000;  // cb3 1/1
      10'd65: word <= 70'hd4001f04000000200;  // q1 1/1
      10'd66: word <= 70'he4001f04000000208;  // q2 1/1
      10'd67: word <= 70'hf4001f04000000211;  // q3 1/1
      10'd68: word <= 70'hc3001f18000000000;  // den 1/4
      10'd69: word <= 70'hd3401e18000000000;  // den 2/4
      10'd70: word <= 70'he3801e18000000000;  // den 3/4
      10'd71: word <= 70'hf3c01e1ca18034000;  // den 4/4
      10'd72: word <= 70'hcb801d18000000000;  // A2 1/2
      10'd73: word <= 70'hc3a11c1c102000000;  // A2 2/2
      10'd74: word <= 70'hcbc01d18000000000;  // A3 1/2
      10'd75: word <= 70'hc3e05c1c103000000;  // A3 2/2
      10'd77: word <= 70'hcb401d18000000000;  // A1 1/3
      10'd78: word <= 70'hc3609c18000000000;  // A1 2/3
      10'd79: word <= 70'h18001e41c101000000;  // A1 3/3
      10'd80: word <= 70'hd4001f3e000000018;  // qfixed1 1/1
      10'd81: word <= 70'he4001f3e000000020;  // qfixed2 1/1
      10'd82: word <= 70'hf4001f3e000000028;  // qfixed3 1/1
      10'd85: word <= 70'h1a0801d30000000000;  // u 1/3
      10'd86: word <= 70'h1b0c01c30000000000;  // u 2/3
      10'd87: word <= 70'h190401c34118000000;  // u 3/3
      10'd90: word <= 70'h15001d24000000630;  // R1 1/1
      10'd92: word <= 70'h25001d20000000000;  // R2 1/2
      10'd93: word <= 70'h1e824000000638;  // R2 2/2
      10'd95: word <= 70'h35001d20000000000;  // R3 1/2
      10'd96: word <= 70'h1f024000000640;  // R3 2/2
      10'd97: word <= 70'h188001928000000000;  // t 1/3
      10'd98: word <= 70'h1c8001c28000000000;  // t 2/3
      10'd99: word <= 70'h18501fc2c00000047a;  // t 3/3
      10'd100: word <= 70'h185001f40000000000;  // c1 1/2
      10'd101: word <= 70'h19001f844239000000;  // c1 2/2
      10'd102: word <= 70'h185001f40000000000;  // c2 1/2
      10'd103: word <= 70'h1a001f84425a000000;  // c2 2/2
      10'd104: word <= 70'h185001f40000000000;  // c3 1/2
      10'd105: word <= 70'h1b001f84427b000000;  // c3 2/2
      10'd106: word <= 70'hc0001f00000000000;  // 2p0 1/2
      10'd107: word <= 70'hc0001e0421c000000;  // 2p0 2/2
      10'd108: word <= 70'hd0001f00000000000;  // 2p1 1/2
      10'd109: word <= 70'hd0001e0421d000000;  // 2p1 2/2
      10'd110: word <= 70'he0001f00000000000;  // 2p2 1/2
      10'd111: word <= 70'he0001e0421e000000;  // 2p2 2/2
      10'd112: word <= 70'hf0001f00000000000;  // 2p3 1/2
      10'd113: word <= 70'hf0001e0421f000000;  // 2p3 2/2
      10'd114: word <= 70'h203001f40000000000;  // v0 1/18
      10'd115: word <= 70'h213001e40000000000;  // v0 2/18
      10'd116: word <= 70'h26301fe40000000000;  // v0 3/18
      10'd117: word <= 70'h27301fe40000000000;  // v0 4/18
      10'd118: word <= 70'h283001e40000000000;  // v0 5/18
      10'd119: word <= 70'h293001e40000000000;  // v0 6/18
      10'd120: word <= 70'h2e301fe40000000000;  // v0 7/18
      10'd121: word <= 70'h2f301fe40000000000;  // v0 8/18
      10'd122: word <= 70'h303001e40000000000;  // v0 9/18
      10'd123: word <= 70'h313001e40000000000;  // v0 10/18
      10'd124: word <= 70'h36301fe40000000000;  // v0 11/18
      10'd125: word <= 70'h37301fe40000000000;  // v0 12/18
      10'd126: word <= 70'h2d741fe40000000000;  // v0 13/18
      10'd127: word <= 70'h2b741fe40000000000;  // v0 14/18
      10'd128: word <= 70'h35781fe40000000000;  // v0 15/18
      10'd129: word <= 70'h33781fe40000000000;  // v0 16/18
      10'd130: word <= 70'h257c1fe40000000000;  // v0 17/18
      10'd131: word <= 70'h237c1fe44201000000;  // v0 18/18
      10'd132: word <= 70'h203401f40000000000;  // v1 1/18
      10'd133: word <= 70'h213401e40000000000;  // v1 2/18
      10'd134: word <= 70'h26341fe40000000000;  // v1 3/18
      10'd135: word <= 70'h27341fe40000000000;  // v1 4/18
      10'd136: word <= 70'h283401e40000000000;  // v1 5/18
      10'd137: word <= 70'h293401e40000000000;  // v1 6/18
      10'd138: word <= 70'h2e3401e40000000000;  // v1 7/18
      10'd139: word <= 70'h2f3401e40000000000;  // v1 8/18
      10'd140: word <= 70'h303401e40000000000;  // v1 9/18
      10'd141: word <= 70'h313401e40000000000;  // v1 10/18
      10'd142: word <= 70'h363401e40000000000;  // v1 11/18
      10'd143: word <= 70'h373401e40000000000;  // v1 12/18
      10'd144: word <= 70'h2d701fe40000000000;  // v1 13/18
      10'd145: word <= 70'h2b701fe40000000000;  // v1 14/18
      10'd146: word <= 70'h347c1fe40000000000;  // v1 15/18
      10'd147: word <= 70'h327c1fe40000000000;  // v1 16/18
      10'd148: word <= 70'h24781fe40000000000;  // v1 17/18
      10'd149: word <= 70'h22781fe44202000000;  // v1 18/18
      10'd150: word <= 70'h203801f40000000000;  // v2 1/18
      10'd151: word <= 70'h213801e40000000000;  // v2 2/18
      10'd152: word <= 70'h263801e40000000000;  // v2 3/18
      10'd153: word <= 70'h273801e40000000000;  // v2 4/18
      10'd154: word <= 70'h283801e40000000000;  // v2 5/18
      10'd155: word <= 70'h293801e40000000000;  // v2 6/18
      10'd156: word <= 70'h2e381fe40000000000;  // v2 7/18
      10'd157: word <= 70'h2f381fe40000000000;  // v2 8/18
      10'd158: word <= 70'h303801e40000000000;  // v2 9/18
      10'd159: word <= 70'h313801e40000000000;  // v2 10/18
      10'd160: word <= 70'h363801e40000000000;  // v2 11/18
      10'd161: word <= 70'h373801e40000000000;  // v2 12/18
      10'd162: word <= 70'h2c7c1fe40000000000;  // v2 13/18
      10'd163: word <= 70'h2a7c1fe40000000000;  // v2 14/18
      10'd164: word <= 70'h35701fe40000000000;  // v2 15/18
      10'd165: word <= 70'h33701fe40000000000;  // v2 16/18
      10'd166: word <= 70'h24741fe40000000000;  // v2 17/18
      10'd167: word <= 70'h22741fe44203000000;  // v2 18/18
      10'd168: word <= 70'h203c01f40000000000;  // v3 1/18
      10'd169: word <= 70'h213c01e40000000000;  // v3 2/18
      10'd170: word <= 70'h263c01e40000000000;  // v3 3/18
      10'd171: word <= 70'h273c01e40000000000;  // v3 4/18
      10'd172: word <= 70'h283c01e40000000000;  // v3 5/18
      10'd173: word <= 70'h293c01e40000000000;  // v3 6/18
      10'd174: word <= 70'h2e3c01e40000000000;  // v3 7/18
      10'd175: word <= 70'h2f3c01e40000000000;  // v3 8/18
      10'd176: word <= 70'h303c01e40000000000;  // v3 9/18
      10'd177: word <= 70'h313c01e40000000000;  // v3 10/18
      10'd178: word <= 70'h363c1fe40000000000;  // v3 11/18
      10'd179: word <= 70'h373c1fe40000000000;  // v3 12/18
      10'd180: word <= 70'h2c781fe40000000000;  // v3 13/18
      10'd181: word <= 70'h2a781fe40000000000;  // v3 14/18
      10'd182: word <= 70'h34741fe40000000000;  // v3 15/18
      10'd183: word <= 70'h32741fe40000000000;  // v3 16/18
      10'd184: word <= 70'h25701fe40000000000;  // v3 17/18
      10'd185: word <= 70'h23701fe44204000000;  // v3 18/18
      10'd190: word <= 70'h13001f40000000000;  // pLp 1/4
      10'd191: word <= 70'h23401e40000000000;  // pLp 2/4
      10'd192: word <= 70'h33801e40000000000;  // pLp 3/4
      10'd193: word <= 70'h43c01e44218000000;  // pLp 4/4
      10'd201: word <= 70'h185001f04a18000000;  // rss W 1/1
      10'd209: word <= 70'h182001f04618000290;  // rss 1/1
      10'd210: word <= 70'h111401f00000000000;  // D 1/3
      10'd211: word <= 70'h162801e00000000000;  // D 2/3
      10'd212: word <= 70'h172c01e0429403c000;  // D 3/3
      10'd220: word <= 70'h142001f042140000a0;  // D/W^1 1/1
      10'd228: word <= 70'h142001f042140000a0;  // D/W^2 1/1
      10'd236: word <= 70'h142001f040140002a0;  // D/W^3 1/1
      10'd237: word <= 70'h120001f40000000000;  // S11 1/3
      10'd238: word <= 70'h130001e40000000000;  // S11 2/3
      10'd239: word <= 70'h11001fe44a81000000;  // S11 3/3
      10'd240: word <= 70'h110001f40000000000;  // S22 1/3
      10'd241: word <= 70'h130001e40000000000;  // S22 2/3
      10'd242: word <= 70'h12001fe44a82000000;  // S22 3/3
      10'd243: word <= 70'h110001f40000000000;  // S33 1/3
      10'd244: word <= 70'h120001e40000000000;  // S33 2/3
      10'd245: word <= 70'h13001fe44a83000000;  // S33 3/3
      10'd246: word <= 70'h15001ff44295000000;  // S off 1 1/1
      10'd247: word <= 70'h16001ff44296000000;  // S off 2 1/1
      10'd248: word <= 70'h17001ff44297000000;  // S off 3 1/1
      10'd249: word <= 70'hdf011f40000000000;  // q turn 1 1/2
      10'd250: word <= 70'hdf011e4429d000000;  // q turn 1 2/2
      10'd251: word <= 70'hef005f40000000000;  // q turn 2 1/2
      10'd252: word <= 70'hef005e4429e000000;  // q turn 2 2/2
      10'd253: word <= 70'hff009f40000000000;  // q turn 3 1/2
      10'd254: word <= 70'hff009e4429f000000;  // q turn 3 2/2
      10'd255: word <= 70'h57001f44285000000;  // M^-1 11 1/1
      10'd256: word <= 70'h67001f44286000000;  // M^-1 22 1/1
      10'd257: word <= 70'h77001f44287000000;  // M^-1 33 1/1
      10'd258: word <= 70'h97001f44289000000;  // M^-1 off 1 1/1
      10'd259: word <= 70'ha7001f4428a000000;  // M^-1 off 2 1/1
      10'd260: word <= 70'hb7001f4428b000000;  // M^-1 off 3 1/1
      10'd261: word <= 70'h10001f40000000000;  // tr S 1/3
      10'd262: word <= 70'h20001e40000000000;  // tr S 2/3
      10'd263: word <= 70'h30001e44211000000;  // tr S 3/3
      10'd264: word <= 70'h50001f40000000000;  // tr M^-1 1/3
      10'd265: word <= 70'h60001e40000000000;  // tr M^-1 2/3
      10'd266: word <= 70'h70001e44212000000;  // tr M^-1 3/3
      10'd274: word <= 70'h114801f00000000000;  // condition 1/2
      10'd275: word <= 70'h114801e0400000029b;  // condition 2/2
      10'd276: word <= COVARIANCE != 0 ? 70'h1f40000000000 : 70'd0;  // 1 + q^2 1/4
      10'd277: word <= COVARIANCE != 0 ? 70'h1d7401e40000000000 : 70'd0;  // 1 + q^2 2/4
      10'd278: word <= COVARIANCE != 0 ? 70'h1e7801e40000000000 : 70'd0;  // 1 + q^2 3/4
      10'd279: word <= COVARIANCE != 0 ? 70'h1f7c01e44214000000 : 70'd0;  // 1 + q^2 4/4
      10'd280: word <= COVARIANCE != 0 ? 70'h50000540000000000 : 70'd0;  // U.1 1/7
      10'd281: word <= COVARIANCE != 0 ? 70'h98001840000000000 : 70'd0;  // U.1 2/7
      10'd282: word <= COVARIANCE != 0 ? 70'h8f411840000000000 : 70'd0;  // U.1 3/7
      10'd283: word <= COVARIANCE != 0 ? 70'h57805040000000000 : 70'd0;  // U.1 4/7
      10'd284: word <= COVARIANCE != 0 ? 70'hbf804440000000000 : 70'd0;  // U.1 5/7
      10'd285: word <= COVARIANCE != 0 ? 70'h57c08840000000000 : 70'd0;  // U.1 6/7
      10'd286: word <= COVARIANCE != 0 ? 70'hafc08444111000000 : 70'd0;  // U.1 7/7
      10'd287: word <= COVARIANCE != 0 ? 70'h60000940000000000 : 70'd0;  // U.2 1/7
      10'd288: word <= COVARIANCE != 0 ? 70'ha8001440000000000 : 70'd0;  // U.2 2/7
      10'd289: word <= COVARIANCE != 0 ? 70'h67411040000000000 : 70'd0;  // U.2 3/7
      10'd290: word <= COVARIANCE != 0 ? 70'hbf410840000000000 : 70'd0;  // U.2 4/7
      10'd291: word <= COVARIANCE != 0 ? 70'h8f805440000000000 : 70'd0;  // U.2 5/7
      10'd292: word <= COVARIANCE != 0 ? 70'h67c08440000000000 : 70'd0;  // U.2 6/7
      10'd293: word <= COVARIANCE != 0 ? 70'h9fc08844112000000 : 70'd0;  // U.2 7/7
      10'd294: word <= COVARIANCE != 0 ? 70'h70001140000000000 : 70'd0;  // U.3 1/7
      10'd295: word <= COVARIANCE != 0 ? 70'hb8000c40000000000 : 70'd0;  // U.3 2/7
      10'd296: word <= COVARIANCE != 0 ? 70'h77410840000000000 : 70'd0;  // U.3 3/7
      10'd297: word <= COVARIANCE != 0 ? 70'haf411040000000000 : 70'd0;  // U.3 4/7
      10'd298: word <= COVARIANCE != 0 ? 70'h77804440000000000 : 70'd0;  // U.3 5/7
      10'd299: word <= COVARIANCE != 0 ? 70'h9f805040000000000 : 70'd0;  // U.3 6/7
      10'd300: word <= COVARIANCE != 0 ? 70'h8fc08c44113000000 : 70'd0;  // U.3 7/7
      10'd307: word <= COVARIANCE != 0 ? 70'h127c01d40000000000 : 70'd0;  // V.1 1/2
      10'd308: word <= COVARIANCE != 0 ? 70'h13781fc44105000000 : 70'd0;  // V.1 2/2
      10'd309: word <= COVARIANCE != 0 ? 70'h117c1fd40000000000 : 70'd0;  // V.2 1/2
      10'd310: word <= COVARIANCE != 0 ? 70'h137401c44106000000 : 70'd0;  // V.2 2/2
      10'd311: word <= COVARIANCE != 0 ? 70'h117801d40000000000 : 70'd0;  // V.3 1/2
      10'd312: word <= COVARIANCE != 0 ? 70'h12741fc44107000000 : 70'd0;  // V.3 2/2
      10'd318: word <= COVARIANCE != 0 ? 70'h50401d40000000000 : 70'd0;  // Y.1 1/3
      10'd319: word <= COVARIANCE != 0 ? 70'h65c01c40000000000 : 70'd0;  // Y.1 2/3
      10'd320: word <= COVARIANCE != 0 ? 70'h75801c44104000000 : 70'd0;  // Y.1 3/3
      10'd321: word <= COVARIANCE != 0 ? 70'h55c01d40000000000 : 70'd0;  // Y.2 1/3
      10'd322: word <= COVARIANCE != 0 ? 70'h60801c40000000000 : 70'd0;  // Y.2 2/3
      10'd323: word <= COVARIANCE != 0 ? 70'h75401c44109000000 : 70'd0;  // Y.2 3/3
      10'd324: word <= COVARIANCE != 0 ? 70'h55801d40000000000 : 70'd0;  // Y.3 1/3
      10'd325: word <= COVARIANCE != 0 ? 70'h65401c40000000000 : 70'd0;  // Y.3 2/3
      10'd326: word <= COVARIANCE != 0 ? 70'h70c01c4410a000000 : 70'd0;  // Y.3 3/3
      10'd327: word <= COVARIANCE != 0 ? 70'h50001f04221000000 : 70'd0;  // V11 1/1
      10'd328: word <= COVARIANCE != 0 ? 70'h60001f04222000000 : 70'd0;  // V12 1/1
      10'd329: word <= COVARIANCE != 0 ? 70'h70001f04223000000 : 70'd0;  // V13 1/1
      10'd333: word <= COVARIANCE != 0 ? 70'h115001d40000000000 : 70'd0;  // theta.1 1/5
      10'd334: word <= COVARIANCE != 0 ? 70'h55001c40000000000 : 70'd0;  // theta.1 2/5
      10'd335: word <= COVARIANCE != 0 ? 70'h4041fc40000000000 : 70'd0;  // theta.1 3/5
      10'd336: word <= COVARIANCE != 0 ? 70'h9081fc40000000000 : 70'd0;  // theta.1 4/5
      10'd337: word <= COVARIANCE != 0 ? 70'ha0c1fc4411d000000 : 70'd0;  // theta.1 5/5
      10'd338: word <= COVARIANCE != 0 ? 70'h50001f04241000000 : 70'd0;  // V21 1/1
      10'd339: word <= COVARIANCE != 0 ? 70'h60001f04242000000 : 70'd0;  // V22 1/1
      10'd340: word <= COVARIANCE != 0 ? 70'h70001f04243000000 : 70'd0;  // V23 1/1
      10'd344: word <= COVARIANCE != 0 ? 70'h125001d40000000000 : 70'd0;  // theta.2 1/5
      10'd345: word <= COVARIANCE != 0 ? 70'h65001c40000000000 : 70'd0;  // theta.2 2/5
      10'd346: word <= COVARIANCE != 0 ? 70'h4041fc40000000000 : 70'd0;  // theta.2 3/5
      10'd347: word <= COVARIANCE != 0 ? 70'h9081fc40000000000 : 70'd0;  // theta.2 4/5
      10'd348: word <= COVARIANCE != 0 ? 70'ha0c1fc4411e000000 : 70'd0;  // theta.2 5/5
      10'd349: word <= COVARIANCE != 0 ? 70'h50001f04261000000 : 70'd0;  // V31 1/1
      10'd350: word <= COVARIANCE != 0 ? 70'h60001f04262000000 : 70'd0;  // V32 1/1
      10'd351: word <= COVARIANCE != 0 ? 70'h70001f04263000000 : 70'd0;  // V33 1/1
      10'd355: word <= COVARIANCE != 0 ? 70'h135001d40000000000 : 70'd0;  // theta.3 1/5
      10'd356: word <= COVARIANCE != 0 ? 70'h75001c40000000000 : 70'd0;  // theta.3 2/5
      10'd357: word <= COVARIANCE != 0 ? 70'h4041fc40000000000 : 70'd0;  // theta.3 3/5
      10'd358: word <= COVARIANCE != 0 ? 70'h9081fc40000000000 : 70'd0;  // theta.3 4/5
      10'd359: word <= COVARIANCE != 0 ? 70'ha0c1fc4411f000000 : 70'd0;  // theta.3 5/5
      10'd360: word <= COVARIANCE != 0 ? 70'h140001f0400003c000 : 70'd0;  // 1/(1 + q^2) 1/1
      10'd361: word <= COVARIANCE != 0 ? 70'h1f00000000000 : 70'd0;  // 2 1/2
      10'd362: word <= COVARIANCE != 0 ? 70'h1e04215000000 : 70'd0;  // 2 2/2
      10'd367: word <= COVARIANCE != 0 ? 70'h3c0001f40000000000 : 70'd0;  // 3n - 6 1/6
      10'd368: word <= COVARIANCE != 0 ? 70'h3c0001e40000000000 : 70'd0;  // 3n - 6 2/6
      10'd369: word <= COVARIANCE != 0 ? 70'h3c0001e40000000000 : 70'd0;  // 3n - 6 3/6
      10'd370: word <= COVARIANCE != 0 ? 70'h15001fe40000000000 : 70'd0;  // 3n - 6 4/6
      10'd371: word <= COVARIANCE != 0 ? 70'h15001fe40000000000 : 70'd0;  // 3n - 6 5/6
      10'd372: word <= COVARIANCE != 0 ? 70'h15001fe44216000000 : 70'd0;  // 3n - 6 6/6
      10'd380: word <= COVARIANCE != 0 ? 70'h160001f04000037000 : 70'd0;  // 1/(3n - 6) 1/1
      10'd398: word <= COVARIANCE != 0 ? 70'h3d0001f40000000000 : 70'd0;  // s^2 1/2
      10'd399: word <= COVARIANCE != 0 ? 70'h185c01ec4218000000 : 70'd0;  // s^2 2/2
      10'd407: word <= COVARIANCE != 0 ? 70'h182001f44215000000 : 70'd0;  // s^2/W 1/1
      10'd408: word <= COVARIANCE != 0 ? 70'h1c0001f40000000000 : 70'd0;  // 2/(1 + q^2) 1/2
      10'd409: word <= COVARIANCE != 0 ? 70'h1c0001e4421c000000 : 70'd0;  // 2/(1 + q^2) 2/2
      10'd417: word <= COVARIANCE != 0 ? 70'h187001f44214000000 : 70'd0;  // s^2 2/(1 + q^2) 1/1
      10'd425: word <= COVARIANCE != 0 ? 70'h147001f44214000000 : 70'd0;  // scale / W 1/1
      10'd433: word <= COVARIANCE != 0 ? 70'h385001f44214000000 : 70'd0;  // scale 1/1
      10'd441: word <= COVARIANCE != 0 ? 70'h1d5001f04225000000 : 70'd0;  // theta11 1/1
      10'd442: word <= COVARIANCE != 0 ? 70'h1e5001f0422b000000 : 70'd0;  // theta12 1/1
      10'd443: word <= COVARIANCE != 0 ? 70'h1f5001f0422a000000 : 70'd0;  // theta13 1/1
      10'd444: word <= COVARIANCE != 0 ? 70'h1e5001f04246000000 : 70'd0;  // theta22 1/1
      10'd445: word <= COVARIANCE != 0 ? 70'h1f5001f04249000000 : 70'd0;  // theta23 1/1
      10'd446: word <= COVARIANCE != 0 ? 70'h1f5001f04267000000 : 70'd0;  // theta33 1/1
      10'd451: word <= COVARIANCE != 0 ? 70'h8e409940000000000 : 70'd0;  // [c x] theta.1 1/5
      10'd452: word <= COVARIANCE != 0 ? 70'h56811040000000000 : 70'd0;  // [c x] theta.1 2/5
      10'd453: word <= COVARIANCE != 0 ? 70'hbe810440000000000 : 70'd0;  // [c x] theta.1 3/5
      10'd454: word <= COVARIANCE != 0 ? 70'h56c04840000000000 : 70'd0;  // [c x] theta.1 4/5
      10'd455: word <= COVARIANCE != 0 ? 70'haec04444111000000 : 70'd0;  // [c x] theta.1 5/5
      10'd456: word <= COVARIANCE != 0 ? 70'h66409140000000000 : 70'd0;  // [c x] theta.2 1/5
      10'd457: word <= COVARIANCE != 0 ? 70'hbe408840000000000 : 70'd0;  // [c x] theta.2 2/5
      10'd458: word <= COVARIANCE != 0 ? 70'h8e811440000000000 : 70'd0;  // [c x] theta.2 3/5
      10'd459: word <= COVARIANCE != 0 ? 70'h66c04440000000000 : 70'd0;  // [c x] theta.2 4/5
      10'd460: word <= COVARIANCE != 0 ? 70'h9ec04844112000000 : 70'd0;  // [c x] theta.2 5/5
      10'd461: word <= COVARIANCE != 0 ? 70'h76408940000000000 : 70'd0;  // [c x] theta.3 1/5
      10'd462: word <= COVARIANCE != 0 ? 70'hae409040000000000 : 70'd0;  // [c x] theta.3 2/5
      10'd463: word <= COVARIANCE != 0 ? 70'h76810440000000000 : 70'd0;  // [c x] theta.3 3/5
      10'd464: word <= COVARIANCE != 0 ? 70'h9e811040000000000 : 70'd0;  // [c x] theta.3 4/5
      10'd465: word <= COVARIANCE != 0 ? 70'h8ec04c44113000000 : 70'd0;  // [c x] theta.3 5/5
      10'd471: word <= COVARIANCE != 0 ? 70'h150000540000000000 : 70'd0;  // t_cov.1 1/3
      10'd472: word <= COVARIANCE != 0 ? 70'h126c1fc40000000000 : 70'd0;  // t_cov.1 2/3
      10'd473: word <= COVARIANCE != 0 ? 70'h136801c440000004e0 : 70'd0;  // t_cov.1 3/3
      10'd474: word <= COVARIANCE != 0 ? 70'h150000940000000000 : 70'd0;  // t_cov.2 1/3
      10'd475: word <= COVARIANCE != 0 ? 70'h116c01c40000000000 : 70'd0;  // t_cov.2 2/3
      10'd476: word <= COVARIANCE != 0 ? 70'h13641fc440000008f0 : 70'd0;  // t_cov.2 3/3
      10'd477: word <= COVARIANCE != 0 ? 70'h150001140000000000 : 70'd0;  // t_cov.3 1/3
      10'd478: word <= COVARIANCE != 0 ? 70'h11681fc40000000000 : 70'd0;  // t_cov.3 2/3
      10'd479: word <= COVARIANCE != 0 ? 70'h126401c44000000af8 : 70'd0;  // t_cov.3 3/3
      10'd480: word <= COVARIANCE != 0 ? 70'hd4001f0421d000000 : 70'd0;  // q composed 1 1/1
      10'd481: word <= COVARIANCE != 0 ? 70'he4001f0421e000000 : 70'd0;  // q composed 2 1/1
      10'd482: word <= COVARIANCE != 0 ? 70'hf4001f0421f000000 : 70'd0;  // q composed 3 1/1
      10'd488: word <= COVARIANCE != 0 ? 70'h57401f40000000000 : 70'd0;  // q theta.1 1/3
      10'd489: word <= COVARIANCE != 0 ? 70'hb7801e40000000000 : 70'd0;  // q theta.1 2/3
      10'd490: word <= COVARIANCE != 0 ? 70'ha7c01e44101000000 : 70'd0;  // q theta.1 3/3
      10'd491: word <= COVARIANCE != 0 ? 70'hb7401f40000000000 : 70'd0;  // q theta.2 1/3
      10'd492: word <= COVARIANCE != 0 ? 70'h67801e40000000000 : 70'd0;  // q theta.2 2/3
      10'd493: word <= COVARIANCE != 0 ? 70'h97c01e44102000000 : 70'd0;  // q theta.2 3/3
      10'd494: word <= COVARIANCE != 0 ? 70'ha7401f40000000000 : 70'd0;  // q theta.3 1/3
      10'd495: word <= COVARIANCE != 0 ? 70'h97801e40000000000 : 70'd0;  // q theta.3 2/3
      10'd496: word <= COVARIANCE != 0 ? 70'h77c01e44103000000 : 70'd0;  // q theta.3 3/3
      10'd497: word <= COVARIANCE != 0 ? 70'h50000540000000000 : 70'd0;  // L theta.1 1/8
      10'd498: word <= COVARIANCE != 0 ? 70'h98001840000000000 : 70'd0;  // L theta.1 2/8
      10'd499: word <= COVARIANCE != 0 ? 70'h8f409840000000000 : 70'd0;  // L theta.1 3/8
      10'd500: word <= COVARIANCE != 0 ? 70'h57811040000000000 : 70'd0;  // L theta.1 4/8
      10'd501: word <= COVARIANCE != 0 ? 70'hbf810440000000000 : 70'd0;  // L theta.1 5/8
      10'd502: word <= COVARIANCE != 0 ? 70'h57c04840000000000 : 70'd0;  // L theta.1 6/8
      10'd503: word <= COVARIANCE != 0 ? 70'hafc04440000000000 : 70'd0;  // L theta.1 7/8
      10'd504: word <= COVARIANCE != 0 ? 70'h1c8401c44915000000 : 70'd0;  // L theta.1 8/8
      10'd505: word <= COVARIANCE != 0 ? 70'h60000940000000000 : 70'd0;  // L theta.2 1/8
      10'd506: word <= COVARIANCE != 0 ? 70'ha8001440000000000 : 70'd0;  // L theta.2 2/8
      10'd507: word <= COVARIANCE != 0 ? 70'h67409040000000000 : 70'd0;  // L theta.2 3/8
      10'd508: word <= COVARIANCE != 0 ? 70'hbf408840000000000 : 70'd0;  // L theta.2 4/8
      10'd509: word <= COVARIANCE != 0 ? 70'h8f811440000000000 : 70'd0;  // L theta.2 5/8
      10'd510: word <= COVARIANCE != 0 ? 70'h67c04440000000000 : 70'd0;  // L theta.2 6/8
      10'd511: word <= COVARIANCE != 0 ? 70'h9fc04840000000000 : 70'd0;  // L theta.2 7/8
      10'd512: word <= COVARIANCE != 0 ? 70'h1c8801c44916000000 : 70'd0;  // L theta.2 8/8
      10'd513: word <= COVARIANCE != 0 ? 70'h70001140000000000 : 70'd0;  // L theta.3 1/8
      10'd514: word <= COVARIANCE != 0 ? 70'hb8000c40000000000 : 70'd0;  // L theta.3 2/8
      10'd515: word <= COVARIANCE != 0 ? 70'h77408840000000000 : 70'd0;  // L theta.3 3/8
      10'd516: word <= COVARIANCE != 0 ? 70'haf409040000000000 : 70'd0;  // L theta.3 4/8
      10'd517: word <= COVARIANCE != 0 ? 70'h77810440000000000 : 70'd0;  // L theta.3 5/8
      10'd518: word <= COVARIANCE != 0 ? 70'h9f811040000000000 : 70'd0;  // L theta.3 6/8
      10'd519: word <= COVARIANCE != 0 ? 70'h8fc04c40000000000 : 70'd0;  // L theta.3 7/8
      10'd520: word <= COVARIANCE != 0 ? 70'h1c8c01c44917000000 : 70'd0;  // L theta.3 8/8
      10'd526: word <= COVARIANCE != 0 ? 70'h157401d40000000000 : 70'd0;  // L theta q 1/3
      10'd527: word <= COVARIANCE != 0 ? 70'h167801c40000000000 : 70'd0;  // L theta q 2/3
      10'd528: word <= COVARIANCE != 0 ? 70'h177c01c44114000000 : 70'd0;  // L theta q 3/3
      10'd535: word <= COVARIANCE != 0 ? 70'h150001d40000000000 : 70'd0;  // q_cov.1 1/4
      10'd536: word <= COVARIANCE != 0 ? 70'h147401c40000000000 : 70'd0;  // q_cov.1 2/4
      10'd537: word <= COVARIANCE != 0 ? 70'h167c1fc40000000000 : 70'd0;  // q_cov.1 3/4
      10'd538: word <= COVARIANCE != 0 ? 70'h177801c448000004b0 : 70'd0;  // q_cov.1 4/4
      10'd539: word <= COVARIANCE != 0 ? 70'h160001d40000000000 : 70'd0;  // q_cov.2 1/4
      10'd540: word <= COVARIANCE != 0 ? 70'h147801c40000000000 : 70'd0;  // q_cov.2 2/4
      10'd541: word <= COVARIANCE != 0 ? 70'h157c01c40000000000 : 70'd0;  // q_cov.2 3/4
      10'd542: word <= COVARIANCE != 0 ? 70'h17741fc448000008c0 : 70'd0;  // q_cov.2 4/4
      10'd543: word <= COVARIANCE != 0 ? 70'h170001d40000000000 : 70'd0;  // q_cov.3 1/4
      10'd544: word <= COVARIANCE != 0 ? 70'h147c01c40000000000 : 70'd0;  // q_cov.3 2/4
      10'd545: word <= COVARIANCE != 0 ? 70'h15781fc40000000000 : 70'd0;  // q_cov.3 3/4
      10'd546: word <= COVARIANCE != 0 ? 70'h167401c44800000acc : 70'd0;  // q_cov.3 4/4
      default: word <= 70'd0;
    endcase
  assign redrain = run & address == 10'd48;
  assign finished = address == 10'd547;
  assign x_address = word[69:64];
  assign x_by_lane = word[63];
  assign y_address = word[62:58];
  assign y_by_lane = word[57];
  assign alternate = word[56:53];
  assign negate = word[52:49];
  assign enable = word[48:45];
  assign first = word[44];
  assign only_estimated = word[43];
  assign reference_code = word[42:39];
  assign last = word[38];
  assign kind = word[37:36];
  assign half = word[35];
  assign clamp = word[34];
  assign write = word[33:32];
  assign source = word[31:29];
  assign dest = word[28:24];
  assign turn_dest = word[23];
  assign only_turned = word[22];
  assign choose_turn = word[21];
  assign track = word[20:19];
  assign divide = word[18:17];
  assign divide_dest = word[16:12];
  assign result_output = word[11:9];
  assign output_index = word[8:3];
  assign mark = word[2:0];
endmodule
`resetall
