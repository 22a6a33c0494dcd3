# SPDX-License-Identifier: Apache-2.0
"""Soak: a core among hostile masters, against a model of everything its ports do. See soak.py."""
