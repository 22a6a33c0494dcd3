# SPDX-License-Identifier: Apache-2.0
"""The cores' names in IP catalogues: vendor, library, name, version."""

from __future__ import annotations

from . import __version__

VENDOR = "relnav"
LIBRARY = "cores"


def vlnv(top: str, version: str = __version__) -> str:
    """The name of a core in the Vivado IP catalogue; its versions have two numbers, as in 1.0."""
    return f"{VENDOR}:{LIBRARY}:{top}:{'.'.join(version.split('.')[:2])}"
