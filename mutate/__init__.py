# SPDX-License-Identifier: Apache-2.0
"""Mutation of the RTL: wrong netlists that the tests must notice. README.md here says what counts."""
