# SPDX-License-Identifier: Apache-2.0
"""Whether a netlist of `make mutate` stands in for a module: its registers cannot be flipped by name."""

from __future__ import annotations

import os

REPLACED = "RELNAV_REPLACE" in os.environ and "RELNAV_NAMED" not in os.environ
