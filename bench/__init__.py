# SPDX-License-Identifier: Apache-2.0
"""Numerical benchmarks of the bit-exact model: `make bench`, or `python -m bench --help`."""
