# SPDX-License-Identifier: Apache-2.0
"""Bit-exact models of the RTL: plain Python integers, one class a module."""
