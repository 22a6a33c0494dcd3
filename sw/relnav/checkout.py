# SPDX-License-Identifier: Apache-2.0
"""Where the RTL and what simulates it lie: the checkout around this package, else the copy in the wheel.

The wheel's copy, relnav/packaged, is made by setup.py: rtl/, sim/ and the last areas of syn/.
"""

from __future__ import annotations

import os
import shutil
from pathlib import Path

from .errors import BackendError, InputError, one_line

_AROUND = Path(__file__).resolve().parents[2]
_PACKAGED = Path(__file__).resolve().parent / "packaged"

IS_CHECKOUT = (_AROUND / "sim" / "runner.py").is_file() and (_AROUND / "rtl").is_dir()
ROOT = _AROUND if IS_CHECKOUT else _PACKAGED
RTL = ROOT / "rtl"
CORES = ("oltae", "ivisnav")


def build_folder() -> Path:
    """Where simulations are built: build/ of the checkout, else the user's cache."""
    if IS_CHECKOUT:
        return ROOT / "build"
    cache = os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache"
    return Path(cache) / "relnav"


def rtl_files(core: str | None = None) -> list[Path]:
    """The Verilog files, headers included, in the order in which tools take them; of one core, or all.

    Raises BackendError where this installation has none.
    """
    if not RTL.is_dir():
        raise BackendError(f"this installation of relnav has no RTL: {RTL} is missing")
    if core is None:
        return sorted([*RTL.rglob("*.vh"), *RTL.rglob("*.v")])
    lines = (RTL / f"{core}.f").read_text().splitlines()
    return [RTL / line for line in lines if line.endswith(".v")]


def copy_rtl(folder: Path) -> int:
    """Copy rtl/ to a folder that is not there or empty; returns the number of files.

    Raises InputError where it is neither, or cannot be written.
    """
    rtl_files()
    try:
        if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
            raise InputError(f"{folder}: is not an empty folder; the RTL is not copied over anything")
        shutil.copytree(RTL, folder, dirs_exist_ok=True)
    except shutil.Error as error:  # of each file that could not be copied: one is enough
        raise InputError(f"{folder}: the RTL cannot be copied: {one_line(error.args[0][0][2])}") from None
    except OSError as error:
        raise InputError(f"{folder}: the RTL cannot be copied: {error.strerror or error}") from None
    return sum(path.is_file() for path in folder.rglob("*"))
