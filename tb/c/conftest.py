# SPDX-License-Identifier: Apache-2.0
"""Fixtures of the C driver's tests."""

from __future__ import annotations

import pytest

from scripts.c_build import HOST, library, missing
from tb.c.library import SIZES, CDriver


@pytest.fixture(scope="session")
def driver(tmp_path_factory: pytest.TempPathFactory) -> CDriver:
    """The driver as a library of this machine."""
    if reason := missing(HOST):
        pytest.skip(reason)
    return CDriver(library(tmp_path_factory.mktemp("c") / "librelnav.so", [SIZES]))
