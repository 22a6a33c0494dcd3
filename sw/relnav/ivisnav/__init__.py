# SPDX-License-Identifier: Apache-2.0
"""Relative velocity and angular velocity from phase changes: rows, quantisation, golden model, driver."""
