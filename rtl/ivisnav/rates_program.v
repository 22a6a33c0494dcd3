// SPDX-License-Identifier: Apache-2.0
// Microprogram of the rates engine: one operation of the lanes and one residual term a cycle. Written by
// `python -m relnav.model.rates_rom` from sw/relnav/model/rates_program.py: do not edit.
//
// The address is the cycle, counted from the first moment's; its word is at the outputs two clocks later, none while `run` is low or
// after `rst`.
`resetall
`default_nettype none
module rates_program (
    input  wire       clk,
    input  wire       rst,
    input  wire       run,
    input  wire [8:0] address,
    // the next word's
    output wire next_bus_bank,
    output wire [4:0] next_bus_address,
    output wire next_indexed,
    output wire [1:0] x_bank,
    output wire [4:0] x_address,
    output wire [2:0] y_select,
    output wire bus_bank,
    output wire [4:0] bus_address,
    output wire [2:0] bus_lane,
    output wire indexed,
    output wire clamp,
    output wire product_write,
    output wire [2:0] product_address,
    output wire [1:0] c_bank,
    output wire [4:0] c_address,
    output wire subtract,
    output wire [5:0] sum_lanes,
    output wire [4:0] sum_address,
    output wire divide,
    output wire load,
    output wire [2:0] track,
    output wire output_valid,
    output wire [4:0] output_index,
    output wire [1:0] back,
    output wire [1:0] mark,
    output wire term,
    output wire [2:0] row,
    output wire [2:0] column,
    output wire first,
    output wire last
);
  reg [67:0] word, held;
  always @(posedge clk) begin
    case (run ? address : {9{1'b1}})
      9'd3: word <= 68'h180000002900011a;  // 01, r0 6
      9'd4: word <= 68'h180000006a000000;  // 02
      9'd5: word <= 68'ha00000000880000;  // d0
      9'd6: word <= 68'h18000000eb000000;  // 03
      9'd7: word <= 68'h18000001ec000000;  // 04
      9'd8: word <= 68'h18000003ed000000;  // 05
      9'd9: word <= 68'h13a;  // r1 6
      9'd10: word <= 68'h80210480000000000;  // p01
      9'd11: word <= 68'h80220500000000000;  // p02
      9'd12: word <= 68'h80230580000000000;  // p03
      9'd13: word <= 68'h80240600000000000;  // p04
      9'd14: word <= 68'h80250680000000000;  // p05
      9'd15: word <= 68'h8026070000000015a;  // p06, r2 6
      9'd17: word <= 68'hc2c00041fc1000000;  // a01
      9'd18: word <= 68'h80c00000fc0000000;  // l0
      9'd19: word <= 68'hc00000028000000;  // i0
      9'd20: word <= 68'hc4c00042fc2000000;  // a02
      9'd21: word <= 68'hc6c00043fc3000000;  // a03
      9'd22: word <= 68'hc00000027000000;  // r0
      9'd23: word <= 68'h17a;  // r3 6
      9'd24: word <= 68'hc8c00044fc4000000;  // a04
      9'd25: word <= 68'hcac00045fc5000000;  // a05
      9'd26: word <= 68'h19a;  // r4 6
      9'd27: word <= 68'hccc00046fc60001ba;  // a06, r5 6
      9'd28: word <= 68'h8120000008801da;  // d1, r6 6
      9'd29: word <= 68'h42002400000000000;  // p10
      9'd30: word <= 68'h42022500000000000;  // p12
      9'd31: word <= 68'h42032580000000000;  // p13
      9'd32: word <= 68'h822030007f2000000;  // ca1
      9'd33: word <= 68'h802010007f1000000;  // ca0
      9'd34: word <= 68'h42042600000000000;  // p14
      9'd35: word <= 68'h42052680000000000;  // p15
      9'd36: word <= 68'h842050007f3000000;  // ca2
      9'd37: word <= 68'h42062700000000000;  // p16
      9'd38: word <= 68'h882090327f2000000;  // ca4
      9'd39: word <= 68'h862070317f1000000;  // ca3
      9'd40: word <= 68'hc4c00022f82000000;  // a12
      9'd41: word <= 68'hc6c00023f83000000;  // a13
      9'd42: word <= 68'hc8c00024f84000000;  // a14
      9'd43: word <= 68'hcac00025f85000000;  // a15
      9'd44: word <= 68'hccc00026f86000000;  // a16
      9'd45: word <= 68'hc0c00020f80000000;  // a10
      9'd46: word <= 68'h42c00000f81000000;  // l1
      9'd47: word <= 68'hc00000049000000;  // i1
      9'd48: word <= 68'hc00000047000000;  // r1
      9'd49: word <= 68'h8a470000025000000;  // u05
      9'd50: word <= 68'h824000000880000;  // d2
      9'd51: word <= 68'h44034580000000000;  // p23
      9'd52: word <= 68'h44044600000000000;  // p24
      9'd53: word <= 68'h44054680000000000;  // p25
      9'd54: word <= 68'h44064700000000000;  // p26
      9'd55: word <= 68'h44004400000000000;  // p20
      9'd56: word <= 68'h44014480000000000;  // p21
      9'd57: word <= 68'h8a20b0337f3000000;  // ca5
      9'd58: word <= 68'h8c470000026000000;  // u06
      9'd59: word <= 68'h648000317f1000000;  // ca01
      9'd60: word <= 68'h88470000024000000;  // u04
      9'd61: word <= 68'h86470000023000000;  // u03
      9'd62: word <= 68'hc6c00023f03000000;  // a23
      9'd63: word <= 68'hc8c00024f04000000;  // a24
      9'd64: word <= 68'hcac00025f05000000;  // a25
      9'd65: word <= 68'hccc00026f06000000;  // a26
      9'd66: word <= 68'hc0c00020f00000000;  // a20
      9'd67: word <= 68'hc2c00021f01000000;  // a21
      9'd68: word <= 68'h44c00000f02000000;  // l2
      9'd69: word <= 68'hc0000008a000000;  // i2
      9'd70: word <= 68'hc00000087000000;  // r2
      9'd71: word <= 68'h668000317f4000000;  // ca012
      9'd72: word <= 68'h836000000880000;  // d3
      9'd73: word <= 68'h46046600000000000;  // p34
      9'd74: word <= 68'h46056680000000000;  // p35
      9'd75: word <= 68'h46066700000000000;  // p36
      9'd76: word <= 68'h46006400000000000;  // p30
      9'd77: word <= 68'h46016480000000000;  // p31
      9'd78: word <= 68'h46026500000000000;  // p32
      9'd79: word <= 68'h84470000022000000;  // u02
      9'd80: word <= 68'h686010007f5000000;  // cav
      9'd81: word <= 68'h464700000c3000000;  // u3
      9'd82: word <= 68'h44470000042000000;  // u2
      9'd83: word <= 68'h82470000021000000;  // u01
      9'd84: word <= 68'hc8c00024e04000000;  // a34
      9'd85: word <= 68'hcac00025e05000000;  // a35
      9'd86: word <= 68'hccc00026e06000000;  // a36
      9'd87: word <= 68'hc0c00020e00000000;  // a30
      9'd88: word <= 68'hc2c00021e01000000;  // a31
      9'd89: word <= 68'hc4c00022e02000000;  // a32
      9'd90: word <= 68'h46c00000e03000000;  // l3
      9'd91: word <= 68'hc0000010b000000;  // i3
      9'd92: word <= 68'hc00000107000000;  // r3
      9'd93: word <= 68'h152000032000000;  // cav1
      9'd94: word <= 68'h848000000880000;  // d4
      9'd95: word <= 68'h48058680000000000;  // p45
      9'd96: word <= 68'h48068700000000000;  // p46
      9'd97: word <= 68'h48008400000000000;  // p40
      9'd98: word <= 68'h48018480000000000;  // p41
      9'd99: word <= 68'h48028500000000000;  // p42
      9'd100: word <= 68'h48038580000000000;  // p43
      9'd101: word <= 68'h150000031000000;  // cav0
      9'd102: word <= 68'h484700001c4000000;  // u4
      9'd103: word <= 68'h154000033000000;  // cav2
      9'd104: word <= 68'h158032032000000;  // cav4
      9'd106: word <= 68'hcac00025c05000000;  // a45
      9'd107: word <= 68'hccc00026c06000000;  // a46
      9'd108: word <= 68'hc0c00020c00000000;  // a40
      9'd109: word <= 68'hc2c00021c01000000;  // a41
      9'd110: word <= 68'hc4c00022c02000000;  // a42
      9'd111: word <= 68'hc6c00023c03000000;  // a43
      9'd112: word <= 68'h48c00000c04000000;  // l4
      9'd113: word <= 68'hc0000020c000000;  // i4
      9'd114: word <= 68'hc00000207000000;  // r4
      9'd115: word <= 68'h156031031000000;  // cav3
      9'd116: word <= 68'h85a000000880000;  // d5
      9'd117: word <= 68'h15a033033000000;  // cav5
      9'd118: word <= 68'h685400007f5000000;  // cam
      9'd121: word <= 68'h64800031031000000;  // cav01
      9'd124: word <= 68'h4a4700003c5000000;  // u5
      9'd125: word <= 68'h4c4700003c6000000;  // u6
      9'd126: word <= 68'h404700003c8000000;  // i0
      9'd127: word <= 68'h42470000389000000;  // i1
      9'd128: word <= 68'h4cc00000406000000;  // x5
      9'd129: word <= 68'h40c00000408000000;  // i50
      9'd130: word <= 68'h42c00000409000000;  // i51
      9'd131: word <= 68'hc0000040d000000;  // i5
      9'd132: word <= 68'h44c0000040a000000;  // i52
      9'd133: word <= 68'h46c0000040b000000;  // i53
      9'd134: word <= 68'h48c0000040c000000;  // i54
      9'd135: word <= 68'h4447000030a000000;  // i2
      9'd136: word <= 68'h4647000020b000000;  // i3
      9'd137: word <= 68'h152000032000000;  // cam1
      9'd138: word <= 68'h4a06a026be6400000;  // x5
      9'd139: word <= 68'h4a08a028be8000000;  // i50
      9'd140: word <= 68'h4a09a029be9000000;  // i51
      9'd141: word <= 68'h4a0da02dbed100154;  // i55, r2 5
      9'd142: word <= 68'h4a0aa02abea000114;  // i52, r0 5
      9'd143: word <= 68'h4a0ba02bbeb000134;  // i53, r1 5
      9'd144: word <= 68'h4a0ca02cbec0001b4;  // i54, r5 5
      9'd145: word <= 68'h66800031036000174;  // cav012, r3 5
      9'd146: word <= 68'h150000031000194;  // cam0, r4 5
      9'd147: word <= 68'h154000033000000;  // cam2
      9'd148: word <= 68'h480680269e6400000;  // x4
      9'd149: word <= 68'h480880289e8000000;  // i40
      9'd150: word <= 68'h480980299e9000000;  // i41
      9'd151: word <= 68'h480d802d9ed000150;  // i45, r2 4
      9'd152: word <= 68'h480a802a9ea000110;  // i42, r0 4
      9'd153: word <= 68'h480b802b9eb000130;  // i43, r1 4
      9'd154: word <= 68'h480c802c9ec1001b0;  // i44, r5 4
      9'd155: word <= 68'h158032032000170;  // cam4, r3 4
      9'd156: word <= 68'h156031031000190;  // cam3, r4 4
      9'd157: word <= 68'h15a033033000000;  // cam5
      9'd158: word <= 68'h460660268e6400000;  // x3
      9'd159: word <= 68'h460860288e8000000;  // i30
      9'd160: word <= 68'h460960298e9000000;  // i31
      9'd161: word <= 68'h460d602d8ed00014c;  // i35, r2 3
      9'd162: word <= 68'h460a602a8ea00010c;  // i32, r0 3
      9'd163: word <= 68'h460b602b8eb10012c;  // i33, r1 3
      9'd164: word <= 68'h460c602c8ec0001ac;  // i34, r5 3
      9'd165: word <= 68'h6480003103100016c;  // cam01, r3 3
      9'd166: word <= 68'h18c;  // r4 3
      9'd168: word <= 68'h44064026866400000;  // x2
      9'd169: word <= 68'h44084028868000000;  // i20
      9'd170: word <= 68'h44094029869000000;  // i21
      9'd171: word <= 68'h440d402d86d000148;  // i25, r2 2
      9'd172: word <= 68'h440a402a86a100108;  // i22, r0 2
      9'd173: word <= 68'h440b402b86b000128;  // i23, r1 2
      9'd174: word <= 68'h440c402c86c0001a8;  // i24, r5 2
      9'd175: word <= 68'h66800031037000168;  // cam012, r3 2
      9'd176: word <= 68'h188;  // r4 2
      9'd178: word <= 68'h42062026826400000;  // x1
      9'd179: word <= 68'h42082028828000000;  // i10
      9'd180: word <= 68'h42092029829100000;  // i11
      9'd181: word <= 68'h420d202d82d000144;  // i15, r2 1
      9'd182: word <= 68'h420a202a82a000104;  // i12, r0 1
      9'd183: word <= 68'h420b202b82b000124;  // i13, r1 1
      9'd184: word <= 68'h420c202c82c0001a4;  // i14, r5 1
      9'd185: word <= 68'h164;  // r3 1
      9'd186: word <= 68'h184;  // r4 1
      9'd188: word <= 68'h860000000400000;  // x0
      9'd189: word <= 68'h880000000100000;  // g0
      9'd191: word <= 68'h141;  // r2 0
      9'd192: word <= 68'h101;  // r0 0
      9'd193: word <= 68'h520830007f2000121;  // r1 0, ci1
      9'd194: word <= 68'h500810007f10001a1;  // r5 0, ci0
      9'd195: word <= 68'h540850007f3000161;  // r3 0, ci2
      9'd196: word <= 68'h181;  // r4 0
      9'd197: word <= 68'h13a;  // r1 6
      9'd198: word <= 68'h11a;  // r0 6
      9'd199: word <= 68'h580890327f200017a;  // ci4, r3 6
      9'd200: word <= 68'h560870317f100015a;  // ci3, r2 6
      9'd201: word <= 68'h5a08b0337f30001ba;  // ci5, r5 6
      9'd202: word <= 68'h19a;  // r4 6
      9'd204: word <= 68'h550200007f0000000;  // e2
      9'd205: word <= 68'h510000007ee000000;  // e0
      9'd206: word <= 68'h530100007ef000000;  // e1
      9'd208: word <= 68'h648000317f1000000;  // ci01
      9'd210: word <= 68'h5b0500307f0000000;  // e5
      9'd211: word <= 68'h5703002e7ee000000;  // e3
      9'd212: word <= 68'h5904002f7ef000000;  // e4
      9'd214: word <= 68'h668000317f4000000;  // ci012
      9'd219: word <= 68'h6080002f7ef000000;  // e12
      9'd220: word <= 68'h5c8000267e6000000;  // xe0
      9'd223: word <= 68'h684810007f5000000;  // civ
      9'd228: word <= 68'h5e8000267e6000000;  // xe
      9'd229: word <= 68'h5e80002e7f0000000;  // e
      9'd233: word <= 68'h152000032000000;  // civ1
      9'd234: word <= 68'h150000031000000;  // civ0
      9'd235: word <= 68'h154000033000000;  // civ2
      9'd238: word <= 68'h860000000400000;  // x0
      9'd239: word <= 68'h862000000400000;  // x1
      9'd240: word <= 68'h864000000400000;  // x2
      9'd241: word <= 68'h158032032000120;  // civ4, r1 0
      9'd242: word <= 68'h866000000400124;  // x3, r1 1
      9'd243: word <= 68'h868000000400128;  // x4, r1 2
      9'd244: word <= 68'h156031031000100;  // civ3, r0 0
      9'd245: word <= 68'h15a03303300012c;  // civ5, r1 3
      9'd246: word <= 68'h685400007f5000104;  // cim, r0 1
      9'd247: word <= 68'h86a000000400130;  // x5, r1 4
      9'd248: word <= 68'h900000000180108;  // t0, r0 2
      9'd249: word <= 68'h90200000018010c;  // t1, r0 3
      9'd250: word <= 68'h64800031031000135;  // civ01, r1 5
      9'd251: word <= 68'h904000000180160;  // t2, r3 0
      9'd252: word <= 68'h906000000180110;  // t3, r0 4
      9'd253: word <= 68'h908000000180164;  // t4, r3 1
      9'd254: word <= 68'h90a000000180115;  // t5, r0 5
      9'd255: word <= 68'h168;  // r3 2
      9'd256: word <= 68'h152000032000140;  // cim1, r2 0
      9'd257: word <= 68'h6680003103800016c;  // civ012, r3 3
      9'd258: word <= 68'h150000031000144;  // cim0, r2 1
      9'd259: word <= 68'h154000033000170;  // cim2, r3 4
      9'd260: word <= 68'h148;  // r2 2
      9'd261: word <= 68'h175;  // r3 5
      9'd262: word <= 68'h15803203200014c;  // cim4, r2 3
      9'd263: word <= 68'h530100007ef0001a0;  // r5 0, f1
      9'd264: word <= 68'h156031031000150;  // cim3, r2 4
      9'd265: word <= 68'h15a0330330001a4;  // cim5, r5 1
      9'd266: word <= 68'h155;  // r2 5
      9'd267: word <= 68'h510000007ee0001a8;  // r5 2, f0
      9'd268: word <= 68'h6c18000003b000180;  // cd, r4 0
      9'd269: word <= 68'h1ac;  // r5 3
      9'd270: word <= 68'h184;  // r4 1
      9'd271: word <= 68'h648000310310001b0;  // cim01, r5 4
      9'd272: word <= 68'h188;  // r4 2
      9'd273: word <= 68'h1b5;  // r5 5
      9'd274: word <= 68'h5703002f7ef00018c;  // r4 3, f3
      9'd275: word <= 68'h190;  // r4 4
      9'd276: word <= 68'h195;  // r4 5
      9'd277: word <= 68'h6680003103900013a;  // cim012, r1 6
      9'd278: word <= 68'h9b000000080011a;  // c/, r0 6
      9'd279: word <= 68'h5502002e7ee00015a;  // f2, r2 6
      9'd280: word <= 68'h19a;  // r4 6
      9'd281: word <= 68'h17a;  // r3 6
      9'd282: word <= 68'h1ba;  // r5 6
      9'd286: word <= 68'h5b05002f7ef000000;  // f5
      9'd287: word <= 68'h6e19000003a000000;  // cn
      9'd289: word <= 68'h5904002e7ee000000;  // f4
      9'd295: word <= 68'h5e80002e7f0000000;  // f01
      9'd296: word <= 68'h74c0000003c000000;  // c
      9'd297: word <= 68'ha70000000800000;  // n-6
      9'd304: word <= 68'h608000267e6000000;  // xf
      9'd305: word <= 68'h900000000200000;  // s0
      9'd306: word <= 68'h902000000200000;  // s1
      9'd307: word <= 68'h904000000200000;  // s2
      9'd308: word <= 68'h906000000200000;  // s3
      9'd309: word <= 68'h908000000200000;  // s4
      9'd310: word <= 68'h9c0000000300000;  // c?
      9'd311: word <= 68'h90a000000200000;  // s5
      9'd312: word <= 68'hc0000003a000000;  // 1/n
      9'd314: word <= 68'h8600000002c0000;  // out0
      9'd315: word <= 68'h8620000002c2000;  // out1
      9'd316: word <= 68'h8640000002c4000;  // out2
      9'd317: word <= 68'h8660000002c6000;  // out3
      9'd318: word <= 68'h8680000002c8000;  // out4
      9'd319: word <= 68'h860000000400000;  // x0
      9'd320: word <= 68'h862000000400000;  // x1
      9'd321: word <= 68'h86a0000002ca200;  // out5
      9'd322: word <= 68'h864000000400120;  // x2, r1 0
      9'd323: word <= 68'h866000000400124;  // x3, r1 1
      9'd324: word <= 68'h868000000400100;  // x4, r0 0
      9'd325: word <= 68'h86a000000400128;  // x5, r1 2
      9'd326: word <= 68'h12c;  // r1 3
      9'd327: word <= 68'h104;  // r0 1
      9'd328: word <= 68'h130;  // r1 4
      9'd329: word <= 68'h108;  // r0 2
      9'd330: word <= 68'h135;  // r1 5
      9'd331: word <= 68'h10c;  // r0 3
      9'd332: word <= 68'h140;  // r2 0
      9'd333: word <= 68'h180;  // r4 0
      9'd334: word <= 68'h110;  // r0 4
      9'd335: word <= 68'h144;  // r2 1
      9'd336: word <= 68'h184;  // r4 1
      9'd337: word <= 68'h115;  // r0 5
      9'd338: word <= 68'h148;  // r2 2
      9'd339: word <= 68'h188;  // r4 2
      9'd340: word <= 68'h14c;  // r2 3
      9'd341: word <= 68'h160;  // r3 0
      9'd342: word <= 68'h18c;  // r4 3
      9'd343: word <= 68'h4d01000005d000150;  // r2 4, xr1
      9'd344: word <= 68'h164;  // r3 1
      9'd345: word <= 68'h190;  // r4 4
      9'd346: word <= 68'h155;  // r2 5
      9'd347: word <= 68'h168;  // r3 2
      9'd348: word <= 68'h195;  // r4 5
      9'd349: word <= 68'h16c;  // r3 3
      9'd350: word <= 68'h4d00000003d0001a0;  // r5 0, xr0
      9'd351: word <= 68'h170;  // r3 4
      9'd352: word <= 68'h1a4;  // r5 1
      9'd353: word <= 68'h1d2000032000175;  // r3 5, xr1
      9'd354: word <= 68'h1a8;  // r5 2
      9'd355: word <= 68'h1ac;  // r5 3
      9'd356: word <= 68'h1b0;  // r5 4
      9'd357: word <= 68'h1b5;  // r5 5
      9'd358: word <= 68'h1c0;  // r6 0
      9'd359: word <= 68'h4d02000009d0001c4;  // r6 1, xr2
      9'd360: word <= 68'h1d00000310001c8;  // r6 2, xr0
      9'd361: word <= 68'h4d04000021d0001cc;  // r6 3, xr4
      9'd362: word <= 68'h1d0;  // r6 4
      9'd363: word <= 68'h1d5;  // r6 5
      9'd366: word <= 68'h4d03000011d000000;  // xr3
      9'd369: word <= 68'h1d4000033000000;  // xr2
      9'd370: word <= 68'h4d05000041d000000;  // xr5
      9'd371: word <= 68'h1d8032032000000;  // xr4
      9'd376: word <= 68'h1d6031031000000;  // xr3
      9'd377: word <= 68'h106000003e000000;  // r6
      9'd380: word <= 68'h1da033033000000;  // xr5
      9'd382: word <= 68'h64800031031000000;  // xr01
      9'd389: word <= 68'h6680003103d000000;  // xr012
      9'd398: word <= 68'h7a80003e83e000000;  // rss
      9'd408: word <= 68'h741e080003f000000;  // s2
      9'd409: word <= 68'h9e080000004c800;  // rss
      9'd418: word <= 68'h515f00007e0000000;  // v0
      9'd419: word <= 68'h535f00007e1000000;  // v1
      9'd420: word <= 68'h555f00007e2000000;  // v2
      9'd421: word <= 68'h575f00007e3000000;  // v3
      9'd422: word <= 68'h595f00007e4000000;  // v4
      9'd423: word <= 68'h5b5f00007e5000000;  // v5
      9'd428: word <= 68'h80000000004f000;  // cov00
      9'd429: word <= 68'h810000000051000;  // cov01
      9'd430: word <= 68'h820000000053000;  // cov02
      9'd431: word <= 68'h830000000055000;  // cov03
      9'd432: word <= 68'h840000000057000;  // cov04
      9'd433: word <= 68'h850000000059000;  // cov05
      9'd434: word <= 68'h81200000005b000;  // cov11
      9'd435: word <= 68'h82200000005d000;  // cov12
      9'd436: word <= 68'h83200000005f000;  // cov13
      9'd437: word <= 68'h842000000061000;  // cov14
      9'd438: word <= 68'h852000000063000;  // cov15
      9'd439: word <= 68'h824000000065000;  // cov22
      9'd440: word <= 68'h834000000067000;  // cov23
      9'd441: word <= 68'h844000000069000;  // cov24
      9'd442: word <= 68'h85400000006b000;  // cov25
      9'd443: word <= 68'h83600000006d000;  // cov33
      9'd444: word <= 68'h84600000006f000;  // cov34
      9'd445: word <= 68'h856000000071000;  // cov35
      9'd446: word <= 68'h848000000073000;  // cov44
      9'd447: word <= 68'h858000000075000;  // cov45
      9'd448: word <= 68'h85a000000077400;  // cov55
      default: word <= 68'd0;
    endcase
    held <= word;
    if (rst) begin
      word <= 68'd0;
      held <= 68'd0;
    end
  end
  assign next_bus_bank = word[57];
  assign next_bus_address = word[56:52];
  assign next_indexed = word[48];
  assign x_bank = held[67:66];
  assign x_address = held[65:61];
  assign y_select = held[60:58];
  assign bus_bank = held[57];
  assign bus_address = held[56:52];
  assign bus_lane = held[51:49];
  assign indexed = held[48];
  assign clamp = held[47];
  assign product_write = held[46];
  assign product_address = held[45:43];
  assign c_bank = held[42:41];
  assign c_address = held[40:36];
  assign subtract = held[35];
  assign sum_lanes = held[34:29];
  assign sum_address = held[28:24];
  assign divide = held[23];
  assign load = held[22];
  assign track = held[21:19];
  assign output_valid = held[18];
  assign output_index = held[17:13];
  assign back = held[12:11];
  assign mark = held[10:9];
  assign term = held[8];
  assign row = held[7:5];
  assign column = held[4:2];
  assign first = held[1];
  assign last = held[0];
endmodule
`resetall
