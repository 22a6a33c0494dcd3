# SPDX-License-Identifier: Apache-2.0
# The Vivado commands of vivado/zynq7020.tcl for plain tclsh: each prints its name and arguments, separated by \x1f, and returns what the
# script goes on with. A command that is not here is an error.
#
#   tclsh vivado_stubs.tcl SCRIPT ARGUMENTS...

proc record {name arguments} { puts [join [list CALL $name {*}$arguments] \x1f] }

foreach name {
  set_property update_ip_catalog create_bd_design apply_bd_automation make_bd_intf_pins_external connect_bd_intf_net
  connect_bd_net assign_bd_address validate_bd_design save_bd_design add_files update_compile_order launch_runs
  write_hw_platform
} {
  proc $name {args} "record $name \$args"
}
foreach name {get_bd_intf_pins get_bd_pins get_bd_addr_spaces get_bd_addr_segs get_files get_runs} {
  proc $name {args} "record $name \$args; return \[lindex \$args end\]"
}
proc create_bd_cell {args} { record create_bd_cell $args; return [lindex $args end] }
proc current_project {} { return project }
proc current_fileset {} { return sources_1 }
proc make_wrapper {args} { record make_wrapper $args; return wrapper.v }
proc get_property {name object} { return $::env($name) }
proc create_project {name folder args} { record create_project [list $name $folder {*}$args]; set ::project $folder/$name }
# the run leaves what the script looks for, but a file that MISSING names
proc wait_on_run {args} {
  record wait_on_run $args
  foreach file {runs/impl_1/system_wrapper.bit gen/sources_1/bd/system/hw_handoff/system.hwh} {
    if {[file tail $file] eq $::env(MISSING)} { continue }
    file mkdir [file dirname $::project.$file]
    close [open $::project.$file w]
  }
}

set argv0 [lindex $argv 0]
set argv [lrange $argv 1 end]
set argc [llength $argv]
source $argv0
