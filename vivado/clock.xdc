# SPDX-License-Identifier: Apache-2.0
# The clock of a core that is synthesised alone (out of context); in a block design the processing system makes it.
# 100 MHz is the papers' clock. rst is synchronous to clk, so nothing is excepted from timing.
create_clock -name clk -period 10.000 [get_ports clk]
