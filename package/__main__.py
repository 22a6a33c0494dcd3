# SPDX-License-Identifier: Apache-2.0
"""Writes the files that other tools take the cores in by; `make package` runs it.

python -m package            write them
python -m package --check    exit 1 when a committed one differs
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from sim.sources import ROOT

from . import fusesoc, ipxact, smoke
from .cores import cores
from .filelist import filelist


def outputs(root: Path = ROOT) -> dict[Path, str]:
    """Every generated file, relative to the repository, and what it must hold."""
    made: dict[Path, str] = {}
    for core in cores(root):
        made[Path(f"rtl/{core.name}.f")] = filelist(core)
        made[Path(f"{core.name}.core")] = fusesoc.core_file(core)
        made[Path(smoke.script_file(core))] = smoke.script(core)
        made[ipxact.folder(core) / "component.xml"] = ipxact.component(core)
        made[ipxact.folder(core) / ipxact.gui_file(core)] = ipxact.gui(core)
    return made


def stale(root: Path = ROOT) -> list[Path]:
    """Generated files that are missing or differ from their sources."""
    return [
        name
        for name, text in outputs(root).items()
        if not (root / name).is_file() or (root / name).read_text() != text
    ]


def main(arguments: Sequence[str] | None = None) -> int:
    """Write the files, or with --check only compare. 0 all well, 1 stale."""
    parser = argparse.ArgumentParser(prog="python -m package", description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--check", action="store_true", help="compare only; exit 1 when a file is stale")
    parser.add_argument("--root", type=Path, default=ROOT, help="the checkout")
    options = parser.parse_args(arguments)
    old, texts = stale(options.root), outputs(options.root)
    for name in old:
        if not options.check:
            (options.root / name).parent.mkdir(parents=True, exist_ok=True)
            (options.root / name).write_text(texts[name])
        print(
            f"{'stale' if options.check else 'written'}: {name}",
            file=sys.stderr if options.check else sys.stdout,
        )
    return int(options.check and bool(old))


if __name__ == "__main__":
    sys.exit(main())
