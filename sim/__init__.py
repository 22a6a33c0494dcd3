# SPDX-License-Identifier: Apache-2.0
"""Simulation of the Verilog: the one runner that every testbench and the package's back ends use."""
