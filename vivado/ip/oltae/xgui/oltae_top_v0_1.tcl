# SPDX-License-Identifier: Apache-2.0
# Written by `make package` from the sources; do not edit.

proc init_gui { IPINST } {
  ipgui::add_param $IPINST -name "Component_Name"
  set page [ipgui::add_page $IPINST -name "Parameters"]
  ipgui::add_param $IPINST -name "WEIGHTED" -parent $page -widget comboBox
  ipgui::add_param $IPINST -name "COVARIANCE" -parent $page -widget comboBox
  ipgui::add_param $IPINST -name "REAPPLY" -parent $page -widget comboBox
  ipgui::add_param $IPINST -name "VERIFY" -parent $page -widget comboBox
}

proc update_PARAM_VALUE.WEIGHTED { PARAM_VALUE.WEIGHTED } {}

proc validate_PARAM_VALUE.WEIGHTED { PARAM_VALUE.WEIGHTED } {
  return true
}

proc update_MODELPARAM_VALUE.WEIGHTED { MODELPARAM_VALUE.WEIGHTED PARAM_VALUE.WEIGHTED } {
  set_property value [get_property value ${PARAM_VALUE.WEIGHTED}] ${MODELPARAM_VALUE.WEIGHTED}
}

proc update_PARAM_VALUE.COVARIANCE { PARAM_VALUE.COVARIANCE } {}

proc validate_PARAM_VALUE.COVARIANCE { PARAM_VALUE.COVARIANCE } {
  return true
}

proc update_MODELPARAM_VALUE.COVARIANCE { MODELPARAM_VALUE.COVARIANCE PARAM_VALUE.COVARIANCE } {
  set_property value [get_property value ${PARAM_VALUE.COVARIANCE}] ${MODELPARAM_VALUE.COVARIANCE}
}

proc update_PARAM_VALUE.REAPPLY { PARAM_VALUE.REAPPLY } {}

proc validate_PARAM_VALUE.REAPPLY { PARAM_VALUE.REAPPLY } {
  return true
}

proc update_MODELPARAM_VALUE.REAPPLY { MODELPARAM_VALUE.REAPPLY PARAM_VALUE.REAPPLY } {
  set_property value [get_property value ${PARAM_VALUE.REAPPLY}] ${MODELPARAM_VALUE.REAPPLY}
}

proc update_PARAM_VALUE.VERIFY { PARAM_VALUE.VERIFY } {}

proc validate_PARAM_VALUE.VERIFY { PARAM_VALUE.VERIFY } {
  return true
}

proc update_MODELPARAM_VALUE.VERIFY { MODELPARAM_VALUE.VERIFY PARAM_VALUE.VERIFY } {
  set_property value [get_property value ${PARAM_VALUE.VERIFY}] ${MODELPARAM_VALUE.VERIFY}
}
