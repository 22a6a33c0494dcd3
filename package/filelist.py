# SPDX-License-Identifier: Apache-2.0
"""Flat file lists, rtl/<core>.f: paths are relative to the folder that the list lies in."""

from __future__ import annotations

from .cores import Core

NOTICE = "Written by `make package` from the sources; do not edit."


def filelist(core: Core) -> str:
    """For `verilator -F rtl/oltae.f` from anywhere, or `iverilog -c oltae.f` inside rtl/."""
    rtl = core.root / "rtl"
    files = [file.relative_to(rtl).as_posix() for file in core.modules]
    return (
        "\n".join(["// SPDX-License-Identifier: Apache-2.0", f"// {NOTICE}", "+incdir+include", *files])
        + "\n"
    )
