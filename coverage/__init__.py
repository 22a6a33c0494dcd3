# SPDX-License-Identifier: Apache-2.0
"""How much of the RTL, and of what may happen to it, the regression tries: `make coverage`. See README.md."""
