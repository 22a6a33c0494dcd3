# SPDX-License-Identifier: Apache-2.0
"""Single-event upsets: every flip-flop of both cores hit once, and what comes of it. See README.md."""
