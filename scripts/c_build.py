# SPDX-License-Identifier: Apache-2.0
"""How the C driver is compiled: for this machine, and bare for the Cortex-A9 of a Zynq-7020."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Iterable, Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
DRIVER = ROOT / "sw/c"
SOURCES = sorted(DRIVER.glob("*.c"))

HOST = "cc"
ARM = "arm-none-eabi-gcc"
PACKAGES = {
    HOST: "gcc",
    "cppcheck": "cppcheck",
    ARM: "gcc-arm-none-eabi libnewlib-arm-none-eabi",
    "qemu-system-arm": "qemu-system-arm",
}
"""Tool -> the Debian packages that it is of."""

STRICT = (
    "-std=c99 -Wall -Wextra -Wpedantic -Werror -Wconversion -Wshadow -Wstrict-prototypes -Wmissing-prototypes"
)
STRICT_FLAGS = [*STRICT.split(), "-Wcast-qual"]
CORTEX_A9 = ["-mcpu=cortex-a9", "-mfpu=vfpv3-d16", "-mfloat-abi=hard"]
CALLBACKS = "-DRELNAV_CALLBACKS"


class CompileError(RuntimeError):
    """The compiler's messages."""


def missing(*tools: str) -> str | None:
    """Why these tools cannot be used here, in one line; None when they can."""
    absent = [PACKAGES[tool] for tool in tools if not shutil.which(tool)]
    return f"not installed: {' '.join(absent)} (make setup-c)" if absent else None


def run(command: Sequence[object]) -> str:
    """What a tool prints. Raises CompileError where it complains."""
    done = subprocess.run([str(part) for part in command], capture_output=True, text=True, check=False)
    if done.returncode:
        raise CompileError(f"{command[0]} ended with {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout + done.stderr


def check(includes: Iterable[Path], *folders: Path) -> None:
    """Cppcheck over the driver and folders that use it, with and without callbacks. Raises CompileError."""
    options = ["-q", "--std=c99", "--enable=all", "--inline-suppr", "--error-exitcode=1"]
    options += ["--suppress=missingIncludeSystem"]  # it needs none of them
    places = [part for folder in (DRIVER, *includes) for part in ("-I", folder)]
    for variant in (CALLBACKS, f"-U{CALLBACKS[2:]}"):
        said = run(["cppcheck", *options, variant, *places, DRIVER, *folders])
        if said:
            raise CompileError(said)


def library(file: Path, more: Iterable[Path] = ()) -> Path:
    """The driver with callbacks as a shared library of this machine."""
    run(
        [HOST, *STRICT_FLAGS, "-O2", "-fPIC", "-shared", CALLBACKS, "-I", DRIVER, "-o", file, *SOURCES, *more]
    )
    return file


def program(
    file: Path,
    sources: Iterable[Path],
    script: Path,
    includes: Iterable[Path] = (),
    options: Iterable[str] = (),
) -> Path:
    """A program for the bare Cortex-A9: driver and sources, without newlib. script: the linker's."""
    folders = [part for folder in (DRIVER, *includes) for part in ("-I", folder)]
    flags = [*STRICT_FLAGS, "-Os", *CORTEX_A9, "-nostdlib", *options]
    run([ARM, *flags, "-T", script, *folders, "-o", file, *SOURCES, *sources, "-lgcc"])
    return file
