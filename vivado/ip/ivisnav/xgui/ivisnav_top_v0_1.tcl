# SPDX-License-Identifier: Apache-2.0
# Written by `make package` from the sources; do not edit.

proc init_gui { IPINST } {
  ipgui::add_param $IPINST -name "Component_Name"
  set page [ipgui::add_page $IPINST -name "Parameters"]
  ipgui::add_param $IPINST -name "VERIFY" -parent $page -widget comboBox
}

proc update_PARAM_VALUE.VERIFY { PARAM_VALUE.VERIFY } {}

proc validate_PARAM_VALUE.VERIFY { PARAM_VALUE.VERIFY } {
  return true
}

proc update_MODELPARAM_VALUE.VERIFY { MODELPARAM_VALUE.VERIFY PARAM_VALUE.VERIFY } {
  set_property value [get_property value ${PARAM_VALUE.VERIFY}] ${MODELPARAM_VALUE.VERIFY}
}
