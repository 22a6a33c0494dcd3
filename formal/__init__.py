# SPDX-License-Identifier: Apache-2.0
"""Formal verification of single modules: properties, SymbiYosys tasks, broken copies, and what runs them."""
