# SPDX-License-Identifier: Apache-2.0
"""Synthesis and timing of the cores with open tools."""
