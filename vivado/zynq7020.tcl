# SPDX-License-Identifier: Apache-2.0
# A Zynq-7020 system around one core: processing system, AXI DMA, core, interrupts, one clock of 100 MHz.
#
#   vivado -mode batch -source vivado/zynq7020.tcl -tclargs CORE [FOLDER] [BOARD] [bitstream]
#
#   CORE       oltae or ivisnav
#   FOLDER     of the project, which must not exist; default build/vivado/CORE
#   BOARD      a board part, such as tul.com.tw:pynq-z2:part0:1.0, whose board files Vivado must have (the board's maker gives them), or
#              none: the part alone. DDR and MIO then keep the PS's defaults, which are no board's: good for area and timing, and for a
#              board whose boot loader sets the PS up by itself (PYNQ's image does)
#   bitstream  also implement, down to the bitstream and the hardware description: system.xsa, and relnav.bit with relnav.hwh beside it, as
#              PYNQ's Overlay wants them. Fails where the timing is not met.
#
# Assumed, since there was no Vivado to try it with (a test runs it on stubs and checks names and connections):
#   * Vivado 2022.1 or newer: assign_bd_address with -offset; axi_dma 7.1, smartconnect 1.0, proc_sys_reset 5.0, xlconcat 2.1,
#     processing_system7 5.5. A 2-input xlconcat is still accepted where newer versions offer ilconcat.
#   * The core meets 100 MHz in the -1 part; the project's own figures are those of docs/ (ECP5, nextpnr). If not, lower `frequency`.
#   * The DMA's tkeep goes nowhere: frames are whole beats of 64 bits, so nothing is lost by it.
#   * FCLK_RESET0_N tells proc_sys_reset its polarity by propagation, as block designs do.
#
# What a driver finds: the core at 0x43C00000 (4 KiB), the DMA at 0x40400000 (64 KiB), irq of the core at IRQ_F2P[0] (GIC 61), of the DMA
# at [1]. The DMA has the memory-to-stream half alone, in direct register mode, with lengths of 23 bits (relnav.buses.axi_dma).

set part xc7z020clg400-1
set frequency 100

proc usage {} {
  error "usage: vivado -mode batch -source zynq7020.tcl -tclargs oltae|ivisnav ?folder? ?board|none? ?bitstream?"
}

if {[llength $argv] < 1 || [llength $argv] > 4} { usage }
lassign $argv core folder board goal
if {$core ni {oltae ivisnav} || $goal ni {{} bitstream}} { usage }

set root [file dirname [file dirname [file normalize [info script]]]]
if {$folder eq ""} { set folder [file join $root build vivado $core] }
set description [open [file join $root vivado ip $core component.xml]]
if {![regexp {<spirit:version>([^<]+)<} [read $description] -> version]} { error "vivado/ip/$core: no version; run make package" }
close $description
if {[file exists $folder]} { error "$folder exists: a project is not written over" }

create_project relnav_$core $folder -part $part
if {$board ni {{} none}} { set_property board_part $board [current_project] }
set_property ip_repo_paths [file join $root vivado ip] [current_project]
update_ip_catalog

create_bd_design system

# --------------------------------------------------------------------------------------------- cells

proc cell {name vlnv args} {
  set made [create_bd_cell -type ip -vlnv $vlnv $name]
  if {[llength $args]} { set_property -dict $args $made }
  return $made
}

set ps [cell ps xilinx.com:ip:processing_system7:5.5]
if {$board ni {{} none}} {
  apply_bd_automation -rule xilinx.com:bd_rule:processing_system7 \
    -config {make_external "FIXED_IO, DDR" apply_board_preset "1" Master "Disable" Slave "Disable"} $ps
} else {
  make_bd_intf_pins_external -name DDR [get_bd_intf_pins ps/DDR]
  make_bd_intf_pins_external -name FIXED_IO [get_bd_intf_pins ps/FIXED_IO]
}
set_property -dict [list \
  CONFIG.PCW_USE_M_AXI_GP0 1 \
  CONFIG.PCW_USE_S_AXI_HP0 1 \
  CONFIG.PCW_S_AXI_HP0_DATA_WIDTH 64 \
  CONFIG.PCW_USE_FABRIC_INTERRUPT 1 \
  CONFIG.PCW_IRQ_F2P_INTR 1 \
  CONFIG.PCW_FPGA0_PERIPHERAL_FREQMHZ $frequency] $ps

cell $core relnav:cores:${core}_top:$version
cell reset xilinx.com:ip:proc_sys_reset:5.0
cell control xilinx.com:ip:smartconnect:1.0 CONFIG.NUM_SI 1 CONFIG.NUM_MI 2
cell memory xilinx.com:ip:smartconnect:1.0 CONFIG.NUM_SI 1 CONFIG.NUM_MI 1
cell interrupts xilinx.com:ip:xlconcat:2.1 CONFIG.NUM_PORTS 2
cell dma xilinx.com:ip:axi_dma:7.1 \
  CONFIG.c_include_sg 0 \
  CONFIG.c_include_s2mm 0 \
  CONFIG.c_include_mm2s 1 \
  CONFIG.c_include_mm2s_dre 0 \
  CONFIG.c_m_axi_mm2s_data_width 64 \
  CONFIG.c_m_axis_mm2s_tdata_width 64 \
  CONFIG.c_mm2s_burst_size 16 \
  CONFIG.c_sg_length_width 23

# --------------------------------------------------------------------------------------------- connections

# interfaces, master first
foreach {from to} [list \
  ps/M_AXI_GP0     control/S00_AXI \
  control/M00_AXI  $core/s_axil \
  control/M01_AXI  dma/S_AXI_LITE \
  dma/M_AXI_MM2S   memory/S00_AXI \
  memory/M00_AXI   ps/S_AXI_HP0 \
  dma/M_AXIS_MM2S  $core/s_axis] {
  connect_bd_intf_net [get_bd_intf_pins $from] [get_bd_intf_pins $to]
}

# nets, driver first
foreach {from loads} [list \
  ps/FCLK_CLK0 [list ps/M_AXI_GP0_ACLK ps/S_AXI_HP0_ACLK reset/slowest_sync_clk control/aclk memory/aclk \
                     dma/s_axi_lite_aclk dma/m_axi_mm2s_aclk $core/clk] \
  ps/FCLK_RESET0_N            reset/ext_reset_in \
  reset/interconnect_aresetn  {control/aresetn memory/aresetn} \
  reset/peripheral_aresetn    dma/axi_resetn \
  reset/peripheral_reset      $core/rst \
  $core/irq                   interrupts/In0 \
  dma/mm2s_introut            interrupts/In1 \
  interrupts/dout             ps/IRQ_F2P] {
  foreach load $loads {
    connect_bd_net [get_bd_pins $from] [get_bd_pins $load]
  }
}

# --------------------------------------------------------------------------------------------- addresses

set data [get_bd_addr_spaces ps/Data]
assign_bd_address -offset 0x43C00000 -range 4K -target_address_space $data [get_bd_addr_segs $core/s_axil/registers]
assign_bd_address -offset 0x40400000 -range 64K -target_address_space $data [get_bd_addr_segs dma/S_AXI_LITE/Reg]
assign_bd_address -target_address_space [get_bd_addr_spaces dma/Data_MM2S] [get_bd_addr_segs ps/S_AXI_HP0/HP0_DDR_LOWOCM]

validate_bd_design
save_bd_design

set wrapper [make_wrapper -files [get_files system.bd] -top]
add_files -norecurse $wrapper
set_property top system_wrapper [current_fileset]
update_compile_order -fileset sources_1

if {$goal eq "bitstream"} {
  launch_runs impl_1 -to_step write_bitstream -jobs 2
  wait_on_run impl_1
  if {[get_property PROGRESS [get_runs impl_1]] ne "100%"} { error "the implementation failed: see $folder" }
  set slack [get_property STATS.WNS [get_runs impl_1]]
  if {$slack eq "" || $slack < 0} { error "timing is not met: worst negative slack $slack ns at $frequency MHz; lower `frequency`" }
  write_hw_platform -fixed -include_bit -force [file join $folder system.xsa]
  foreach {pattern name} {
    {*.runs impl_1 system_wrapper.bit}      relnav.bit
    {*.gen sources_1 bd system hw_handoff system.hwh}  relnav.hwh
  } {
    set found [glob -nocomplain [file join $folder {*}$pattern]]
    if {[llength $found] != 1} { error "$name: not one [file join {*}$pattern] in $folder" }
    file copy -force [lindex $found 0] [file join $folder $name]
  }
}
puts "relnav: $core in $folder"
