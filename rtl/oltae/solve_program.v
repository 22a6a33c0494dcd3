// SPDX-License-Identifier: Apache-2.0
// Microprogram of the solve engine. Written by `python -m relnav.model.rom` from sw/relnav/model/pose_program.py and
// statistics_program.py: do not edit.
//
// The word at `address` is at the outputs a clock later; none while `run` is low. Fields after `reference_code` belong to the dot
// product that ends with the slot. `redrain` asks for the low limbs of the moments.
`resetall
`default_nettype none
module solve_program #(
    parameter COVARIANCE = 1,
    parameter REAPPLY    = 1
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
    output wire only_first,
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
    // the re-application is called at CALL, starts at TARGET and leaves at LEAVE for CALL
    input  wire [9:0] counter,
    input  wire       reapply,         // wanted, and not yet done
    output wire       leaving,
    output wire [9:0] following,  // address after `counter`'s predecessor
    output wire       redrain,
    output wire       finished
);
  reg [70:0] word;
  always @(posedge clk)
    case (run ? address : {10{1'b1}})
      10'd6: word <= 71'h400003e09000000000;  // M33 1/4
      10'd7: word <= 71'h500003c09000000000;  // M33 2/4
      10'd8: word <= 71'h4c0033c09000000000;  // M33 3/4
      10'd9: word <= 71'h5c002bc0d113000000;  // M33 4/4
      10'd10: word <= 71'h500003e09000000000;  // M11 1/4
      10'd11: word <= 71'h600003c09000000000;  // M11 2/4
      10'd12: word <= 71'h5c002bc09000000000;  // M11 3/4
      10'd13: word <= 71'h6c001bc0d111000000;  // M11 4/4
      10'd14: word <= 71'h400003e09000000000;  // M22 1/4
      10'd15: word <= 71'h600003c09000000000;  // M22 2/4
      10'd16: word <= 71'h4c0033c09000000000;  // M22 3/4
      10'd17: word <= 71'h6c001bc0d112000000;  // M22 4/4
      10'd18: word <= 71'h4401a7e09000000000;  // M12 1/2
      10'd19: word <= 71'h480197c0d117000000;  // M12 2/2
      10'd20: word <= 71'h640297e09000000000;  // M31 1/2
      10'd21: word <= 71'h68028fc0d116000000;  // M31 2/2
      10'd22: word <= 71'h54030fe09000000000;  // M23 1/2
      10'd23: word <= 71'h580327c0d115000000;  // M23 2/2
      10'd24: word <= 71'h6a028fe15102000000;  // z2 1/1
      10'd25: word <= 71'h700003e04000028000;  // 1/W 1/1
      10'd26: word <= 71'h5a0327e15101000000;  // z1 1/1
      10'd27: word <= 71'h4a0197e15103000000;  // z3 1/1
      10'd28: word <= 71'h249803e01000000000;  // C11 1/2
      10'd29: word <= 71'h2aa83fc05105000000;  // C11 2/2
      10'd30: word <= 71'h2ea803e01000000000;  // C13 1/2
      10'd31: word <= 71'h2c903fc0510a000000;  // C13 2/2
      10'd32: word <= 71'h2ca803e01000000000;  // C12 1/2
      10'd33: word <= 71'h2e983fc0510b000000;  // C12 2/2
      10'd34: word <= 71'h2eb003e01000000000;  // C23 1/2
      10'd35: word <= 71'h22a83fc05109000000;  // C23 2/2
      10'd36: word <= 71'h229003e01000000000;  // C33 1/2
      10'd37: word <= 71'h2eb83fc05107000000;  // C33 2/2
      10'd38: word <= 71'h229803e01000000000;  // C22 1/2
      10'd39: word <= 71'h2cb03fc05106000000;  // C22 2/2
      10'd40: word <= 71'h222803e00000000000;  // D 1/3
      10'd41: word <= 71'h2c5003c00000000000;  // D 2/3
      10'd42: word <= 71'h2e5803c04a84ad0000;  // D 3/3
      10'd43: word <= 71'h120c3f200000000000;  // P0 1/4
      10'd44: word <= 71'h14143e800000000000;  // P0 2/4
      10'd45: word <= 71'h161c3d800000000000;  // P0 3/4
      10'd46: word <= 71'h9043b80428c4f0000;  // P0 4/4
      10'd47: word <= 71'h120427200000000000;  // P1 1/4
      10'd48: word <= 71'h141c25400000000000;  // P1 2/4
      10'd49: word <= 71'h161426400000000000;  // P1 3/4
      10'd50: word <= 71'hb0c2fc0428d080000;  // P1 4/4
      10'd51: word <= 71'h121c0ce00000000000;  // P2 1/4
      10'd52: word <= 71'h14040e800000000000;  // P2 2/4
      10'd53: word <= 71'h160c0e400000000000;  // P2 3/4
      10'd54: word <= 71'hd141fc0428e080000;  // P2 4/4
      10'd55: word <= 71'h121414e00000000000;  // P3 1/4
      10'd56: word <= 71'h140c15400000000000;  // P3 2/4
      10'd57: word <= 71'h160415800000000000;  // P3 3/4
      10'd58: word <= 71'hf1c37c0428f080000;  // P3 4/4
      10'd59: word <= 71'h4e4003e04219100000;  // ca1 1/1
      10'd60: word <= 71'h5e4003e0421a100000;  // ca2 1/1
      10'd61: word <= 71'h6e4003e0421b100000;  // ca3 1/1
      10'd62: word <= 71'h724003e0421d100000;  // cb1 1/1
      10'd63: word <= 71'h744003e0421e100000;  // cb2 1/1
      10'd64: word <= 71'h764003e0421f100000;  // cb3 1/1
      10'd65: word <= 71'h1a8003e04000000200;  // q1 1/1
      10'd66: word <= 71'h1c8003e04000000208;  // q2 1/1
      10'd67: word <= 71'h1e8003e04000000211;  // q3 1/1
      10'd68: word <= 71'h186003e18000000000;  // den 1/4
      10'd69: word <= 71'h1a6803c18000000000;  // den 2/4
      10'd70: word <= 71'h1c7003c18000000000;  // den 3/4
      10'd71: word <= 71'h1e7803c1ca18034000;  // den 4/4
      10'd72: word <= 71'h197003a18000000000;  // A2 1/2
      10'd73: word <= 71'h18742381c102000000;  // A2 2/2
      10'd74: word <= 71'h197803a18000000000;  // A3 1/2
      10'd75: word <= 71'h187c0b81c103000000;  // A3 2/2
      10'd77: word <= 71'h196803a18000000000;  // A1 1/3
      10'd78: word <= 71'h186c13818000000000;  // A1 2/3
      10'd79: word <= 71'h30003c81c101000000;  // A1 3/3
      10'd80: word <= 71'h1a8003e3e000000018;  // qfixed1 1/1
      10'd81: word <= 71'h1c8003e3e000000020;  // qfixed2 1/1
      10'd82: word <= 71'h1e8003e3e000000028;  // qfixed3 1/1
      10'd85: word <= 71'h341003a30000000000;  // u 1/3
      10'd86: word <= 71'h361803830000000000;  // u 2/3
      10'd87: word <= 71'h320803834118000000;  // u 3/3
      10'd90: word <= 71'h2a003a24000000630;  // R1 1/1
      10'd92: word <= 71'h4a003a20000000000;  // R2 1/2
      10'd93: word <= 71'h3d024000000638;  // R2 2/2
      10'd95: word <= 71'h6a003a20000000000;  // R3 1/2
      10'd96: word <= 71'h3e024000000640;  // R3 2/2
      10'd97: word <= 71'h310003228000000000;  // t 1/3
      10'd98: word <= 71'h390003828000000000;  // t 2/3
      10'd99: word <= 71'h30a03f82c00000047a;  // t 3/3
      10'd100: word <= 71'h30a003e40000000000;  // c1 1/2
      10'd101: word <= 71'h32003f044239000000;  // c1 2/2
      10'd102: word <= 71'h30a003e40000000000;  // c2 1/2
      10'd103: word <= 71'h34003f04425a000000;  // c2 2/2
      10'd104: word <= 71'h30a003e40000000000;  // c3 1/2
      10'd105: word <= 71'h36003f04427b000000;  // c3 2/2
      10'd106: word <= 71'h180003e00000000000;  // 2p0 1/2
      10'd107: word <= 71'h180003c0421c000000;  // 2p0 2/2
      10'd108: word <= 71'h1a0003e00000000000;  // 2p1 1/2
      10'd109: word <= 71'h1a0003c0421d000000;  // 2p1 2/2
      10'd110: word <= 71'h1c0003e00000000000;  // 2p2 1/2
      10'd111: word <= 71'h1c0003c0421e000000;  // 2p2 2/2
      10'd112: word <= 71'h1e0003e00000000000;  // 2p3 1/2
      10'd113: word <= 71'h1e0003c0421f000000;  // 2p3 2/2
      10'd114: word <= 71'h406003e40000000000;  // v0 1/18
      10'd115: word <= 71'h426003c40000000000;  // v0 2/18
      10'd116: word <= 71'h4c603fc40000000000;  // v0 3/18
      10'd117: word <= 71'h4e603fc40000000000;  // v0 4/18
      10'd118: word <= 71'h506003c40000000000;  // v0 5/18
      10'd119: word <= 71'h526003c40000000000;  // v0 6/18
      10'd120: word <= 71'h5c603fc40000000000;  // v0 7/18
      10'd121: word <= 71'h5e603fc40000000000;  // v0 8/18
      10'd122: word <= 71'h606003c40000000000;  // v0 9/18
      10'd123: word <= 71'h626003c40000000000;  // v0 10/18
      10'd124: word <= 71'h6c603fc40000000000;  // v0 11/18
      10'd125: word <= 71'h6e603fc40000000000;  // v0 12/18
      10'd126: word <= 71'h5ae83fc40000000000;  // v0 13/18
      10'd127: word <= 71'h56e83fc40000000000;  // v0 14/18
      10'd128: word <= 71'h6af03fc40000000000;  // v0 15/18
      10'd129: word <= 71'h66f03fc40000000000;  // v0 16/18
      10'd130: word <= 71'h4af83fc40000000000;  // v0 17/18
      10'd131: word <= 71'h46f83fc44201000000;  // v0 18/18
      10'd132: word <= 71'h406803e40000000000;  // v1 1/18
      10'd133: word <= 71'h426803c40000000000;  // v1 2/18
      10'd134: word <= 71'h4c683fc40000000000;  // v1 3/18
      10'd135: word <= 71'h4e683fc40000000000;  // v1 4/18
      10'd136: word <= 71'h506803c40000000000;  // v1 5/18
      10'd137: word <= 71'h526803c40000000000;  // v1 6/18
      10'd138: word <= 71'h5c6803c40000000000;  // v1 7/18
      10'd139: word <= 71'h5e6803c40000000000;  // v1 8/18
      10'd140: word <= 71'h606803c40000000000;  // v1 9/18
      10'd141: word <= 71'h626803c40000000000;  // v1 10/18
      10'd142: word <= 71'h6c6803c40000000000;  // v1 11/18
      10'd143: word <= 71'h6e6803c40000000000;  // v1 12/18
      10'd144: word <= 71'h5ae03fc40000000000;  // v1 13/18
      10'd145: word <= 71'h56e03fc40000000000;  // v1 14/18
      10'd146: word <= 71'h68f83fc40000000000;  // v1 15/18
      10'd147: word <= 71'h64f83fc40000000000;  // v1 16/18
      10'd148: word <= 71'h48f03fc40000000000;  // v1 17/18
      10'd149: word <= 71'h44f03fc44202000000;  // v1 18/18
      10'd150: word <= 71'h407003e40000000000;  // v2 1/18
      10'd151: word <= 71'h427003c40000000000;  // v2 2/18
      10'd152: word <= 71'h4c7003c40000000000;  // v2 3/18
      10'd153: word <= 71'h4e7003c40000000000;  // v2 4/18
      10'd154: word <= 71'h507003c40000000000;  // v2 5/18
      10'd155: word <= 71'h527003c40000000000;  // v2 6/18
      10'd156: word <= 71'h5c703fc40000000000;  // v2 7/18
      10'd157: word <= 71'h5e703fc40000000000;  // v2 8/18
      10'd158: word <= 71'h607003c40000000000;  // v2 9/18
      10'd159: word <= 71'h627003c40000000000;  // v2 10/18
      10'd160: word <= 71'h6c7003c40000000000;  // v2 11/18
      10'd161: word <= 71'h6e7003c40000000000;  // v2 12/18
      10'd162: word <= 71'h58f83fc40000000000;  // v2 13/18
      10'd163: word <= 71'h54f83fc40000000000;  // v2 14/18
      10'd164: word <= 71'h6ae03fc40000000000;  // v2 15/18
      10'd165: word <= 71'h66e03fc40000000000;  // v2 16/18
      10'd166: word <= 71'h48e83fc40000000000;  // v2 17/18
      10'd167: word <= 71'h44e83fc44203000000;  // v2 18/18
      10'd168: word <= 71'h407803e40000000000;  // v3 1/18
      10'd169: word <= 71'h427803c40000000000;  // v3 2/18
      10'd170: word <= 71'h4c7803c40000000000;  // v3 3/18
      10'd171: word <= 71'h4e7803c40000000000;  // v3 4/18
      10'd172: word <= 71'h507803c40000000000;  // v3 5/18
      10'd173: word <= 71'h527803c40000000000;  // v3 6/18
      10'd174: word <= 71'h5c7803c40000000000;  // v3 7/18
      10'd175: word <= 71'h5e7803c40000000000;  // v3 8/18
      10'd176: word <= 71'h607803c40000000000;  // v3 9/18
      10'd177: word <= 71'h627803c40000000000;  // v3 10/18
      10'd178: word <= 71'h6c783fc40000000000;  // v3 11/18
      10'd179: word <= 71'h6e783fc40000000000;  // v3 12/18
      10'd180: word <= 71'h58f03fc40000000000;  // v3 13/18
      10'd181: word <= 71'h54f03fc40000000000;  // v3 14/18
      10'd182: word <= 71'h68e83fc40000000000;  // v3 15/18
      10'd183: word <= 71'h64e83fc40000000000;  // v3 16/18
      10'd184: word <= 71'h4ae03fc40000000000;  // v3 17/18
      10'd185: word <= 71'h46e03fc44204000000;  // v3 18/18
      10'd190: word <= 71'h26003e40000000000;  // pLp 1/4
      10'd191: word <= 71'h46803c40000000000;  // pLp 2/4
      10'd192: word <= 71'h67003c40000000000;  // pLp 3/4
      10'd193: word <= 71'h87803c44218000000;  // pLp 4/4
      10'd201: word <= 71'h30a003e04a18000000;  // rss W 1/1
      10'd209: word <= 71'h304003e04618000290;  // rss 1/1
      10'd210: word <= 71'h222803e40000000000;  // D 1/3
      10'd211: word <= 71'h2c5003c40000000000;  // D 2/3
      10'd212: word <= 71'h2e5803c4429403c000;  // D 3/3
      10'd220: word <= 71'h284003e042140000a0;  // D/W^1 1/1
      10'd228: word <= 71'h284003e042140000a0;  // D/W^2 1/1
      10'd236: word <= 71'h284003e040140002a0;  // D/W^3 1/1
      10'd237: word <= 71'h240003e40000000000;  // S11 1/3
      10'd238: word <= 71'h260003c40000000000;  // S11 2/3
      10'd239: word <= 71'h22003fc44a81000000;  // S11 3/3
      10'd240: word <= 71'h220003e40000000000;  // S22 1/3
      10'd241: word <= 71'h260003c40000000000;  // S22 2/3
      10'd242: word <= 71'h24003fc44a82000000;  // S22 3/3
      10'd243: word <= 71'h220003e40000000000;  // S33 1/3
      10'd244: word <= 71'h240003c40000000000;  // S33 2/3
      10'd245: word <= 71'h26003fc44a83000000;  // S33 3/3
      10'd246: word <= 71'h2a003fe44295000000;  // S off 1 1/1
      10'd247: word <= 71'h2c003fe44296000000;  // S off 2 1/1
      10'd248: word <= 71'h2e003fe44297000000;  // S off 3 1/1
      10'd249: word <= 71'h1be023ec0000000000;  // q turn 1 1/2
      10'd250: word <= 71'h1be023cc429d000000;  // q turn 1 2/2
      10'd251: word <= 71'h1de00bec0000000000;  // q turn 2 1/2
      10'd252: word <= 71'h1de00bcc429e000000;  // q turn 2 2/2
      10'd253: word <= 71'h1fe013ec0000000000;  // q turn 3 1/2
      10'd254: word <= 71'h1fe013cc429f000000;  // q turn 3 2/2
      10'd255: word <= 71'hae003e44285000000;  // M^-1 11 1/1
      10'd256: word <= 71'hce003e44286000000;  // M^-1 22 1/1
      10'd257: word <= 71'hee003e44287000000;  // M^-1 33 1/1
      10'd258: word <= 71'h12e003e44289000000;  // M^-1 off 1 1/1
      10'd259: word <= 71'h14e003e4428a000000;  // M^-1 off 2 1/1
      10'd260: word <= 71'h16e003e4428b000000;  // M^-1 off 3 1/1
      10'd261: word <= 71'h20003e40000000000;  // tr S 1/3
      10'd262: word <= 71'h40003c40000000000;  // tr S 2/3
      10'd263: word <= 71'h60003c44211000000;  // tr S 3/3
      10'd264: word <= 71'ha0003e40000000000;  // tr M^-1 1/3
      10'd265: word <= 71'hc0003c40000000000;  // tr M^-1 2/3
      10'd266: word <= 71'he0003c44212000000;  // tr M^-1 3/3
      10'd274: word <= 71'h229003e00000000000;  // condition 1/2
      10'd275: word <= 71'h229003c0400000029b;  // condition 2/2
      10'd276: word <= COVARIANCE != 0 ? 71'h3e40000000000 : 71'd0;  // 1 + q^2 1/4
      10'd277: word <= COVARIANCE != 0 ? 71'h3ae803c40000000000 : 71'd0;  // 1 + q^2 2/4
      10'd278: word <= COVARIANCE != 0 ? 71'h3cf003c40000000000 : 71'd0;  // 1 + q^2 3/4
      10'd279: word <= COVARIANCE != 0 ? 71'h3ef803c44214000000 : 71'd0;  // 1 + q^2 4/4
      10'd280: word <= COVARIANCE != 0 ? 71'ha0000a40000000000 : 71'd0;  // U.1 1/7
      10'd281: word <= COVARIANCE != 0 ? 71'h130003040000000000 : 71'd0;  // U.1 2/7
      10'd282: word <= COVARIANCE != 0 ? 71'h11e823040000000000 : 71'd0;  // U.1 3/7
      10'd283: word <= COVARIANCE != 0 ? 71'haf00a040000000000 : 71'd0;  // U.1 4/7
      10'd284: word <= COVARIANCE != 0 ? 71'h17f008840000000000 : 71'd0;  // U.1 5/7
      10'd285: word <= COVARIANCE != 0 ? 71'haf811040000000000 : 71'd0;  // U.1 6/7
      10'd286: word <= COVARIANCE != 0 ? 71'h15f810844111000000 : 71'd0;  // U.1 7/7
      10'd287: word <= COVARIANCE != 0 ? 71'hc0001240000000000 : 71'd0;  // U.2 1/7
      10'd288: word <= COVARIANCE != 0 ? 71'h150002840000000000 : 71'd0;  // U.2 2/7
      10'd289: word <= COVARIANCE != 0 ? 71'hce822040000000000 : 71'd0;  // U.2 3/7
      10'd290: word <= COVARIANCE != 0 ? 71'h17e821040000000000 : 71'd0;  // U.2 4/7
      10'd291: word <= COVARIANCE != 0 ? 71'h11f00a840000000000 : 71'd0;  // U.2 5/7
      10'd292: word <= COVARIANCE != 0 ? 71'hcf810840000000000 : 71'd0;  // U.2 6/7
      10'd293: word <= COVARIANCE != 0 ? 71'h13f811044112000000 : 71'd0;  // U.2 7/7
      10'd294: word <= COVARIANCE != 0 ? 71'he0002240000000000 : 71'd0;  // U.3 1/7
      10'd295: word <= COVARIANCE != 0 ? 71'h170001840000000000 : 71'd0;  // U.3 2/7
      10'd296: word <= COVARIANCE != 0 ? 71'hee821040000000000 : 71'd0;  // U.3 3/7
      10'd297: word <= COVARIANCE != 0 ? 71'h15e822040000000000 : 71'd0;  // U.3 4/7
      10'd298: word <= COVARIANCE != 0 ? 71'hef008840000000000 : 71'd0;  // U.3 5/7
      10'd299: word <= COVARIANCE != 0 ? 71'h13f00a040000000000 : 71'd0;  // U.3 6/7
      10'd300: word <= COVARIANCE != 0 ? 71'h11f811844113000000 : 71'd0;  // U.3 7/7
      10'd307: word <= COVARIANCE != 0 ? 71'h24f803a40000000000 : 71'd0;  // V.1 1/2
      10'd308: word <= COVARIANCE != 0 ? 71'h26f03f844105000000 : 71'd0;  // V.1 2/2
      10'd309: word <= COVARIANCE != 0 ? 71'h22f83fa40000000000 : 71'd0;  // V.2 1/2
      10'd310: word <= COVARIANCE != 0 ? 71'h26e803844106000000 : 71'd0;  // V.2 2/2
      10'd311: word <= COVARIANCE != 0 ? 71'h22f003a40000000000 : 71'd0;  // V.3 1/2
      10'd312: word <= COVARIANCE != 0 ? 71'h24e83f844107000000 : 71'd0;  // V.3 2/2
      10'd318: word <= COVARIANCE != 0 ? 71'ha0803a40000000000 : 71'd0;  // Y.1 1/3
      10'd319: word <= COVARIANCE != 0 ? 71'hcb803840000000000 : 71'd0;  // Y.1 2/3
      10'd320: word <= COVARIANCE != 0 ? 71'heb003844104000000 : 71'd0;  // Y.1 3/3
      10'd321: word <= COVARIANCE != 0 ? 71'hab803a40000000000 : 71'd0;  // Y.2 1/3
      10'd322: word <= COVARIANCE != 0 ? 71'hc1003840000000000 : 71'd0;  // Y.2 2/3
      10'd323: word <= COVARIANCE != 0 ? 71'hea803844109000000 : 71'd0;  // Y.2 3/3
      10'd324: word <= COVARIANCE != 0 ? 71'hab003a40000000000 : 71'd0;  // Y.3 1/3
      10'd325: word <= COVARIANCE != 0 ? 71'hca803840000000000 : 71'd0;  // Y.3 2/3
      10'd326: word <= COVARIANCE != 0 ? 71'he180384410a000000 : 71'd0;  // Y.3 3/3
      10'd327: word <= COVARIANCE != 0 ? 71'ha0003e04221000000 : 71'd0;  // V11 1/1
      10'd328: word <= COVARIANCE != 0 ? 71'hc0003e04222000000 : 71'd0;  // V12 1/1
      10'd329: word <= COVARIANCE != 0 ? 71'he0003e04223000000 : 71'd0;  // V13 1/1
      10'd333: word <= COVARIANCE != 0 ? 71'h22a003a40000000000 : 71'd0;  // theta.1 1/5
      10'd334: word <= COVARIANCE != 0 ? 71'haa003840000000000 : 71'd0;  // theta.1 2/5
      10'd335: word <= COVARIANCE != 0 ? 71'h8083f840000000000 : 71'd0;  // theta.1 3/5
      10'd336: word <= COVARIANCE != 0 ? 71'h12103f840000000000 : 71'd0;  // theta.1 4/5
      10'd337: word <= COVARIANCE != 0 ? 71'h14183f84411d000000 : 71'd0;  // theta.1 5/5
      10'd338: word <= COVARIANCE != 0 ? 71'ha0003e04241000000 : 71'd0;  // V21 1/1
      10'd339: word <= COVARIANCE != 0 ? 71'hc0003e04242000000 : 71'd0;  // V22 1/1
      10'd340: word <= COVARIANCE != 0 ? 71'he0003e04243000000 : 71'd0;  // V23 1/1
      10'd344: word <= COVARIANCE != 0 ? 71'h24a003a40000000000 : 71'd0;  // theta.2 1/5
      10'd345: word <= COVARIANCE != 0 ? 71'hca003840000000000 : 71'd0;  // theta.2 2/5
      10'd346: word <= COVARIANCE != 0 ? 71'h8083f840000000000 : 71'd0;  // theta.2 3/5
      10'd347: word <= COVARIANCE != 0 ? 71'h12103f840000000000 : 71'd0;  // theta.2 4/5
      10'd348: word <= COVARIANCE != 0 ? 71'h14183f84411e000000 : 71'd0;  // theta.2 5/5
      10'd349: word <= COVARIANCE != 0 ? 71'ha0003e04261000000 : 71'd0;  // V31 1/1
      10'd350: word <= COVARIANCE != 0 ? 71'hc0003e04262000000 : 71'd0;  // V32 1/1
      10'd351: word <= COVARIANCE != 0 ? 71'he0003e04263000000 : 71'd0;  // V33 1/1
      10'd355: word <= COVARIANCE != 0 ? 71'h26a003a40000000000 : 71'd0;  // theta.3 1/5
      10'd356: word <= COVARIANCE != 0 ? 71'hea003840000000000 : 71'd0;  // theta.3 2/5
      10'd357: word <= COVARIANCE != 0 ? 71'h8083f840000000000 : 71'd0;  // theta.3 3/5
      10'd358: word <= COVARIANCE != 0 ? 71'h12103f840000000000 : 71'd0;  // theta.3 4/5
      10'd359: word <= COVARIANCE != 0 ? 71'h14183f84411f000000 : 71'd0;  // theta.3 5/5
      10'd360: word <= COVARIANCE != 0 ? 71'h280003e0400003c000 : 71'd0;  // 1/(1 + q^2) 1/1
      10'd361: word <= COVARIANCE != 0 ? 71'h3e00000000000 : 71'd0;  // 2 1/2
      10'd362: word <= COVARIANCE != 0 ? 71'h3c04215000000 : 71'd0;  // 2 2/2
      10'd367: word <= COVARIANCE != 0 ? 71'h780003e40000000000 : 71'd0;  // 3n - 6 1/6
      10'd368: word <= COVARIANCE != 0 ? 71'h780003c40000000000 : 71'd0;  // 3n - 6 2/6
      10'd369: word <= COVARIANCE != 0 ? 71'h780003c40000000000 : 71'd0;  // 3n - 6 3/6
      10'd370: word <= COVARIANCE != 0 ? 71'h2a003fc40000000000 : 71'd0;  // 3n - 6 4/6
      10'd371: word <= COVARIANCE != 0 ? 71'h2a003fc40000000000 : 71'd0;  // 3n - 6 5/6
      10'd372: word <= COVARIANCE != 0 ? 71'h2a003fc44216000000 : 71'd0;  // 3n - 6 6/6
      10'd380: word <= COVARIANCE != 0 ? 71'h2c0003e04000037000 : 71'd0;  // 1/(3n - 6) 1/1
      10'd398: word <= COVARIANCE != 0 ? 71'h7a0003e40000000000 : 71'd0;  // s^2 1/2
      10'd399: word <= COVARIANCE != 0 ? 71'h30b803d44218000000 : 71'd0;  // s^2 2/2
      10'd407: word <= COVARIANCE != 0 ? 71'h304003e44215000000 : 71'd0;  // s^2/W 1/1
      10'd408: word <= COVARIANCE != 0 ? 71'h380003e40000000000 : 71'd0;  // 2/(1 + q^2) 1/2
      10'd409: word <= COVARIANCE != 0 ? 71'h380003c4421c000000 : 71'd0;  // 2/(1 + q^2) 2/2
      10'd417: word <= COVARIANCE != 0 ? 71'h30e003e44214000000 : 71'd0;  // s^2 2/(1 + q^2) 1/1
      10'd425: word <= COVARIANCE != 0 ? 71'h28e003e44214000000 : 71'd0;  // scale / W 1/1
      10'd433: word <= COVARIANCE != 0 ? 71'h70a003e44214000000 : 71'd0;  // scale 1/1
      10'd441: word <= COVARIANCE != 0 ? 71'h3aa003e04225000000 : 71'd0;  // theta11 1/1
      10'd442: word <= COVARIANCE != 0 ? 71'h3ca003e0422b000000 : 71'd0;  // theta12 1/1
      10'd443: word <= COVARIANCE != 0 ? 71'h3ea003e0422a000000 : 71'd0;  // theta13 1/1
      10'd444: word <= COVARIANCE != 0 ? 71'h3ca003e04246000000 : 71'd0;  // theta22 1/1
      10'd445: word <= COVARIANCE != 0 ? 71'h3ea003e04249000000 : 71'd0;  // theta23 1/1
      10'd446: word <= COVARIANCE != 0 ? 71'h3ea003e04267000000 : 71'd0;  // theta33 1/1
      10'd451: word <= COVARIANCE != 0 ? 71'h11c813240000000000 : 71'd0;  // [c x] theta.1 1/5
      10'd452: word <= COVARIANCE != 0 ? 71'had022040000000000 : 71'd0;  // [c x] theta.1 2/5
      10'd453: word <= COVARIANCE != 0 ? 71'h17d020840000000000 : 71'd0;  // [c x] theta.1 3/5
      10'd454: word <= COVARIANCE != 0 ? 71'had809040000000000 : 71'd0;  // [c x] theta.1 4/5
      10'd455: word <= COVARIANCE != 0 ? 71'h15d808844111000000 : 71'd0;  // [c x] theta.1 5/5
      10'd456: word <= COVARIANCE != 0 ? 71'hcc812240000000000 : 71'd0;  // [c x] theta.2 1/5
      10'd457: word <= COVARIANCE != 0 ? 71'h17c811040000000000 : 71'd0;  // [c x] theta.2 2/5
      10'd458: word <= COVARIANCE != 0 ? 71'h11d022840000000000 : 71'd0;  // [c x] theta.2 3/5
      10'd459: word <= COVARIANCE != 0 ? 71'hcd808840000000000 : 71'd0;  // [c x] theta.2 4/5
      10'd460: word <= COVARIANCE != 0 ? 71'h13d809044112000000 : 71'd0;  // [c x] theta.2 5/5
      10'd461: word <= COVARIANCE != 0 ? 71'hec811240000000000 : 71'd0;  // [c x] theta.3 1/5
      10'd462: word <= COVARIANCE != 0 ? 71'h15c812040000000000 : 71'd0;  // [c x] theta.3 2/5
      10'd463: word <= COVARIANCE != 0 ? 71'hed020840000000000 : 71'd0;  // [c x] theta.3 3/5
      10'd464: word <= COVARIANCE != 0 ? 71'h13d022040000000000 : 71'd0;  // [c x] theta.3 4/5
      10'd465: word <= COVARIANCE != 0 ? 71'h11d809844113000000 : 71'd0;  // [c x] theta.3 5/5
      10'd471: word <= COVARIANCE != 0 ? 71'h2a0000a40000000000 : 71'd0;  // t_cov.1 1/3
      10'd472: word <= COVARIANCE != 0 ? 71'h24d83f840000000000 : 71'd0;  // t_cov.1 2/3
      10'd473: word <= COVARIANCE != 0 ? 71'h26d0038440000004e0 : 71'd0;  // t_cov.1 3/3
      10'd474: word <= COVARIANCE != 0 ? 71'h2a0001240000000000 : 71'd0;  // t_cov.2 1/3
      10'd475: word <= COVARIANCE != 0 ? 71'h22d803840000000000 : 71'd0;  // t_cov.2 2/3
      10'd476: word <= COVARIANCE != 0 ? 71'h26c83f8440000008f0 : 71'd0;  // t_cov.2 3/3
      10'd477: word <= COVARIANCE != 0 ? 71'h2a0002240000000000 : 71'd0;  // t_cov.3 1/3
      10'd478: word <= COVARIANCE != 0 ? 71'h22d03f840000000000 : 71'd0;  // t_cov.3 2/3
      10'd479: word <= COVARIANCE != 0 ? 71'h24c803844000000af8 : 71'd0;  // t_cov.3 3/3
      10'd480: word <= COVARIANCE != 0 ? 71'h1a8003e0421d000000 : 71'd0;  // q composed 1 1/1
      10'd481: word <= COVARIANCE != 0 ? 71'h1c8003e0421e000000 : 71'd0;  // q composed 2 1/1
      10'd482: word <= COVARIANCE != 0 ? 71'h1e8003e0421f000000 : 71'd0;  // q composed 3 1/1
      10'd488: word <= COVARIANCE != 0 ? 71'hae803e40000000000 : 71'd0;  // q theta.1 1/3
      10'd489: word <= COVARIANCE != 0 ? 71'h16f003c40000000000 : 71'd0;  // q theta.1 2/3
      10'd490: word <= COVARIANCE != 0 ? 71'h14f803c44101000000 : 71'd0;  // q theta.1 3/3
      10'd491: word <= COVARIANCE != 0 ? 71'h16e803e40000000000 : 71'd0;  // q theta.2 1/3
      10'd492: word <= COVARIANCE != 0 ? 71'hcf003c40000000000 : 71'd0;  // q theta.2 2/3
      10'd493: word <= COVARIANCE != 0 ? 71'h12f803c44102000000 : 71'd0;  // q theta.2 3/3
      10'd494: word <= COVARIANCE != 0 ? 71'h14e803e40000000000 : 71'd0;  // q theta.3 1/3
      10'd495: word <= COVARIANCE != 0 ? 71'h12f003c40000000000 : 71'd0;  // q theta.3 2/3
      10'd496: word <= COVARIANCE != 0 ? 71'hef803c44103000000 : 71'd0;  // q theta.3 3/3
      10'd497: word <= COVARIANCE != 0 ? 71'ha0000a40000000000 : 71'd0;  // L theta.1 1/8
      10'd498: word <= COVARIANCE != 0 ? 71'h130003040000000000 : 71'd0;  // L theta.1 2/8
      10'd499: word <= COVARIANCE != 0 ? 71'h11e813040000000000 : 71'd0;  // L theta.1 3/8
      10'd500: word <= COVARIANCE != 0 ? 71'haf022040000000000 : 71'd0;  // L theta.1 4/8
      10'd501: word <= COVARIANCE != 0 ? 71'h17f020840000000000 : 71'd0;  // L theta.1 5/8
      10'd502: word <= COVARIANCE != 0 ? 71'haf809040000000000 : 71'd0;  // L theta.1 6/8
      10'd503: word <= COVARIANCE != 0 ? 71'h15f808840000000000 : 71'd0;  // L theta.1 7/8
      10'd504: word <= COVARIANCE != 0 ? 71'h390803844915000000 : 71'd0;  // L theta.1 8/8
      10'd505: word <= COVARIANCE != 0 ? 71'hc0001240000000000 : 71'd0;  // L theta.2 1/8
      10'd506: word <= COVARIANCE != 0 ? 71'h150002840000000000 : 71'd0;  // L theta.2 2/8
      10'd507: word <= COVARIANCE != 0 ? 71'hce812040000000000 : 71'd0;  // L theta.2 3/8
      10'd508: word <= COVARIANCE != 0 ? 71'h17e811040000000000 : 71'd0;  // L theta.2 4/8
      10'd509: word <= COVARIANCE != 0 ? 71'h11f022840000000000 : 71'd0;  // L theta.2 5/8
      10'd510: word <= COVARIANCE != 0 ? 71'hcf808840000000000 : 71'd0;  // L theta.2 6/8
      10'd511: word <= COVARIANCE != 0 ? 71'h13f809040000000000 : 71'd0;  // L theta.2 7/8
      10'd512: word <= COVARIANCE != 0 ? 71'h391003844916000000 : 71'd0;  // L theta.2 8/8
      10'd513: word <= COVARIANCE != 0 ? 71'he0002240000000000 : 71'd0;  // L theta.3 1/8
      10'd514: word <= COVARIANCE != 0 ? 71'h170001840000000000 : 71'd0;  // L theta.3 2/8
      10'd515: word <= COVARIANCE != 0 ? 71'hee811040000000000 : 71'd0;  // L theta.3 3/8
      10'd516: word <= COVARIANCE != 0 ? 71'h15e812040000000000 : 71'd0;  // L theta.3 4/8
      10'd517: word <= COVARIANCE != 0 ? 71'hef020840000000000 : 71'd0;  // L theta.3 5/8
      10'd518: word <= COVARIANCE != 0 ? 71'h13f022040000000000 : 71'd0;  // L theta.3 6/8
      10'd519: word <= COVARIANCE != 0 ? 71'h11f809840000000000 : 71'd0;  // L theta.3 7/8
      10'd520: word <= COVARIANCE != 0 ? 71'h391803844917000000 : 71'd0;  // L theta.3 8/8
      10'd526: word <= COVARIANCE != 0 ? 71'h2ae803a40000000000 : 71'd0;  // L theta q 1/3
      10'd527: word <= COVARIANCE != 0 ? 71'h2cf003840000000000 : 71'd0;  // L theta q 2/3
      10'd528: word <= COVARIANCE != 0 ? 71'h2ef803844114000000 : 71'd0;  // L theta q 3/3
      10'd535: word <= COVARIANCE != 0 ? 71'h2a0003a40000000000 : 71'd0;  // q_cov.1 1/4
      10'd536: word <= COVARIANCE != 0 ? 71'h28e803840000000000 : 71'd0;  // q_cov.1 2/4
      10'd537: word <= COVARIANCE != 0 ? 71'h2cf83f840000000000 : 71'd0;  // q_cov.1 3/4
      10'd538: word <= COVARIANCE != 0 ? 71'h2ef0038448000004b0 : 71'd0;  // q_cov.1 4/4
      10'd539: word <= COVARIANCE != 0 ? 71'h2c0003a40000000000 : 71'd0;  // q_cov.2 1/4
      10'd540: word <= COVARIANCE != 0 ? 71'h28f003840000000000 : 71'd0;  // q_cov.2 2/4
      10'd541: word <= COVARIANCE != 0 ? 71'h2af803840000000000 : 71'd0;  // q_cov.2 3/4
      10'd542: word <= COVARIANCE != 0 ? 71'h2ee83f8448000008c0 : 71'd0;  // q_cov.2 4/4
      10'd543: word <= COVARIANCE != 0 ? 71'h2e0003a40000000000 : 71'd0;  // q_cov.3 1/4
      10'd544: word <= COVARIANCE != 0 ? 71'h28f803840000000000 : 71'd0;  // q_cov.3 2/4
      10'd545: word <= COVARIANCE != 0 ? 71'h2af03f840000000000 : 71'd0;  // q_cov.3 3/4
      10'd546: word <= COVARIANCE != 0 ? 71'h2ce803844800000acc : 71'd0;  // q_cov.3 4/4
      10'd549: word <= REAPPLY != 0 ? 71'h4c0003e48000000000 : 71'd0;  // tr 2B 1/3
      10'd550: word <= REAPPLY != 0 ? 71'h5c0003c48000000000 : 71'd0;  // tr 2B 2/3
      10'd551: word <= REAPPLY != 0 ? 71'h6c0003c4c21c000000 : 71'd0;  // tr 2B 3/3
      10'd556: word <= REAPPLY != 0 ? 71'h4c6c2be50000000000 : 71'd0;  // Y1 1/4
      10'd557: word <= REAPPLY != 0 ? 71'h5a6403c50000000000 : 71'd0;  // Y1 2/4
      10'd558: word <= REAPPLY != 0 ? 71'h687c33c50000000000 : 71'd0;  // Y1 3/4
      10'd559: word <= REAPPLY != 0 ? 71'h48741bc54101000000 : 71'd0;  // Y1 4/4
      10'd560: word <= REAPPLY != 0 ? 71'h5c741be50000000000 : 71'd0;  // Y2 1/4
      10'd561: word <= REAPPLY != 0 ? 71'h587c33c50000000000 : 71'd0;  // Y2 2/4
      10'd562: word <= REAPPLY != 0 ? 71'h6a6403c50000000000 : 71'd0;  // Y2 3/4
      10'd563: word <= REAPPLY != 0 ? 71'h486c2bc54102000000 : 71'd0;  // Y2 4/4
      10'd564: word <= REAPPLY != 0 ? 71'h6c7c33e50000000000 : 71'd0;  // Y3 1/4
      10'd565: word <= REAPPLY != 0 ? 71'h58741bc50000000000 : 71'd0;  // Y3 2/4
      10'd566: word <= REAPPLY != 0 ? 71'h686c2bc50000000000 : 71'd0;  // Y3 3/4
      10'd567: word <= REAPPLY != 0 ? 71'h4a6403c54103000000 : 71'd0;  // Y3 4/4
      10'd568: word <= REAPPLY != 0 ? 71'h386403e50000000000 : 71'd0;  // Y0 1/4
      10'd569: word <= REAPPLY != 0 ? 71'h5a6c2bc50000000000 : 71'd0;  // Y0 2/4
      10'd570: word <= REAPPLY != 0 ? 71'h6a741bc50000000000 : 71'd0;  // Y0 3/4
      10'd571: word <= REAPPLY != 0 ? 71'h4a7c33c54118000000 : 71'd0;  // Y0 4/4
      10'd572: word <= REAPPLY != 0 ? 71'h186003e18000000000 : 71'd0;  // |p|^2 / 2 1/4
      10'd573: word <= REAPPLY != 0 ? 71'h1a6803c18000000000 : 71'd0;  // |p|^2 / 2 2/4
      10'd574: word <= REAPPLY != 0 ? 71'h1c7003c18000000000 : 71'd0;  // |p|^2 / 2 3/4
      10'd575: word <= REAPPLY != 0 ? 71'h1e7803c1c800034000 : 71'd0;  // |p|^2 / 2 4/4
      10'd576: word <= REAPPLY != 0 ? 71'h26803e58000000000 : 71'd0;  // lambda 1/4
      10'd577: word <= REAPPLY != 0 ? 71'h47003c58000000000 : 71'd0;  // lambda 2/4
      10'd578: word <= REAPPLY != 0 ? 71'h67803c58000000000 : 71'd0;  // lambda 3/4
      10'd579: word <= REAPPLY != 0 ? 71'h306003c5c21c000000 : 71'd0;  // lambda 4/4
      10'd580: word <= REAPPLY != 0 ? 71'h2603fe58000000000 : 71'd0;  // H1 1/4
      10'd581: word <= REAPPLY != 0 ? 71'h4783fc58000000000 : 71'd0;  // H1 2/4
      10'd582: word <= REAPPLY != 0 ? 71'h67003c58000000000 : 71'd0;  // H1 3/4
      10'd583: word <= REAPPLY != 0 ? 71'h306803c5c119000000 : 71'd0;  // H1 4/4
      10'd584: word <= REAPPLY != 0 ? 71'h27803e58000000000 : 71'd0;  // H2 1/4
      10'd585: word <= REAPPLY != 0 ? 71'h4603fc58000000000 : 71'd0;  // H2 2/4
      10'd586: word <= REAPPLY != 0 ? 71'h6683fc58000000000 : 71'd0;  // H2 3/4
      10'd587: word <= REAPPLY != 0 ? 71'h307003c5c11a000000 : 71'd0;  // H2 4/4
      10'd588: word <= REAPPLY != 0 ? 71'h2703fe58000000000 : 71'd0;  // H3 1/4
      10'd589: word <= REAPPLY != 0 ? 71'h46803c58000000000 : 71'd0;  // H3 2/4
      10'd590: word <= REAPPLY != 0 ? 71'h6603fc58000000000 : 71'd0;  // H3 3/4
      10'd591: word <= REAPPLY != 0 ? 71'h307803c5c11b000000 : 71'd0;  // H3 4/4
      10'd592: word <= REAPPLY != 0 ? 71'h26803e58000000000 : 71'd0;  // H0 1/4
      10'd593: word <= REAPPLY != 0 ? 71'h47003c58000000000 : 71'd0;  // H0 2/4
      10'd594: word <= REAPPLY != 0 ? 71'h67803c58000000000 : 71'd0;  // H0 3/4
      10'd595: word <= REAPPLY != 0 ? 71'h306003c5c110000000 : 71'd0;  // H0 4/4
      10'd596: word <= REAPPLY != 0 ? 71'h34a03fe4c237000000 : 71'd0;  // M''12 1/1
      10'd599: word <= REAPPLY != 0 ? 71'h36a03fe4c255000000 : 71'd0;  // M''23 1/1
      10'd600: word <= REAPPLY != 0 ? 71'h32a03fe4c276000000 : 71'd0;  // M''31 1/1
      10'd601: word <= REAPPLY != 0 ? 71'h38a003e48000000000 : 71'd0;  // M''11 1/2
      10'd602: word <= REAPPLY != 0 ? 71'h32a03fc4c231000000 : 71'd0;  // M''11 2/2
      10'd603: word <= REAPPLY != 0 ? 71'h38a003e48000000000 : 71'd0;  // M''22 1/2
      10'd604: word <= REAPPLY != 0 ? 71'h34a03fc4c252000000 : 71'd0;  // M''22 2/2
      10'd605: word <= REAPPLY != 0 ? 71'h38a003e48000000000 : 71'd0;  // M''33 1/2
      10'd606: word <= REAPPLY != 0 ? 71'h36a03fc4c273000000 : 71'd0;  // M''33 2/2
      10'd607: word <= REAPPLY != 0 ? 71'h20a003e04221000000 : 71'd0;  // g1 1/1
      10'd608: word <= REAPPLY != 0 ? 71'h20a003e04242000000 : 71'd0;  // g2 1/1
      10'd609: word <= REAPPLY != 0 ? 71'h20a003e04263000000 : 71'd0;  // g3 1/1
      10'd614: word <= REAPPLY != 0 ? 71'h249803e61000000000 : 71'd0;  // C11 1/2
      10'd615: word <= REAPPLY != 0 ? 71'h2aa83fc65105000000 : 71'd0;  // C11 2/2
      10'd616: word <= REAPPLY != 0 ? 71'h2ea803e61000000000 : 71'd0;  // C13 1/2
      10'd617: word <= REAPPLY != 0 ? 71'h2c903fc6510a000000 : 71'd0;  // C13 2/2
      10'd618: word <= REAPPLY != 0 ? 71'h2ca803e61000000000 : 71'd0;  // C12 1/2
      10'd619: word <= REAPPLY != 0 ? 71'h2e983fc6510b000000 : 71'd0;  // C12 2/2
      10'd620: word <= REAPPLY != 0 ? 71'h2eb003e61000000000 : 71'd0;  // C23 1/2
      10'd621: word <= REAPPLY != 0 ? 71'h22a83fc65109000000 : 71'd0;  // C23 2/2
      10'd622: word <= REAPPLY != 0 ? 71'h229003e61000000000 : 71'd0;  // C33 1/2
      10'd623: word <= REAPPLY != 0 ? 71'h2eb83fc65107000000 : 71'd0;  // C33 2/2
      10'd624: word <= REAPPLY != 0 ? 71'h229803e61000000000 : 71'd0;  // C22 1/2
      10'd625: word <= REAPPLY != 0 ? 71'h2cb03fc65106000000 : 71'd0;  // C22 2/2
      10'd626: word <= REAPPLY != 0 ? 71'h222803e40000000000 : 71'd0;  // D'' 1/3
      10'd627: word <= REAPPLY != 0 ? 71'h2c5003c40000000000 : 71'd0;  // D'' 2/3
      10'd628: word <= REAPPLY != 0 ? 71'h2e5803c44204034000 : 71'd0;  // D'' 3/3
      10'd629: word <= REAPPLY != 0 ? 71'ha0803e40000000000 : 71'd0;  // N''1 1/3
      10'd630: word <= REAPPLY != 0 ? 71'h161003c40000000000 : 71'd0;  // N''1 2/3
      10'd631: word <= REAPPLY != 0 ? 71'h141803c4421d000000 : 71'd0;  // N''1 3/3
      10'd632: word <= REAPPLY != 0 ? 71'h160803e40000000000 : 71'd0;  // N''2 1/3
      10'd633: word <= REAPPLY != 0 ? 71'hc1003c40000000000 : 71'd0;  // N''2 2/3
      10'd634: word <= REAPPLY != 0 ? 71'h121803c4421e000000 : 71'd0;  // N''2 3/3
      10'd635: word <= REAPPLY != 0 ? 71'h140803e40000000000 : 71'd0;  // N''3 1/3
      10'd636: word <= REAPPLY != 0 ? 71'h121003c40000000000 : 71'd0;  // N''3 2/3
      10'd637: word <= REAPPLY != 0 ? 71'he1803c4421f000000 : 71'd0;  // N''3 3/3
      10'd642: word <= REAPPLY != 0 ? 71'h192003e40000000000 : 71'd0;  // p'' 1/4
      10'd643: word <= REAPPLY != 0 ? 71'h1be81bc40000000000 : 71'd0;  // p'' 2/4
      10'd644: word <= REAPPLY != 0 ? 71'h1df033c40000000000 : 71'd0;  // p'' 3/4
      10'd645: word <= REAPPLY != 0 ? 71'h1ff82bc44118000000 : 71'd0;  // p'' 4/4
      10'd653: word <= REAPPLY != 0 ? 71'h30a003e0420c1b0000 : 71'd0;  // P''0 1/1
      10'd654: word <= REAPPLY != 0 ? 71'h30a003e0422d080000 : 71'd0;  // P''1 1/1
      10'd655: word <= REAPPLY != 0 ? 71'h30a003e0424e080000 : 71'd0;  // P''2 1/1
      10'd656: word <= REAPPLY != 0 ? 71'h30a003e0426f080000 : 71'd0;  // P''3 1/1
      default: word <= 71'd0;
    endcase
  localparam [9:0] CALL = 59, TARGET = 549, LEAVE = 666;
  wire calling = REAPPLY != 0 && reapply && counter == CALL;
  assign leaving = REAPPLY != 0 && counter == LEAVE;
  assign following = calling ? TARGET : leaving ? CALL : counter;
  assign redrain = run & address == 10'd60;
  assign finished = address == 10'd547;
  assign x_address = word[70:65];
  assign x_by_lane = word[64];
  assign y_address = word[63:59];
  assign y_by_lane = word[58];
  assign alternate = word[57:54];
  assign negate = word[53:50];
  assign enable = word[49:46];
  assign first = word[45];
  assign only_estimated = word[44];
  assign only_first = word[43];
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
