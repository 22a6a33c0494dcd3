# SPDX-License-Identifier: Apache-2.0
"""Lint every module of rtl/ alone, as its own top: Verilator -Wall, Icarus -g2005 -Wall, Yosys read_verilog.

A module that is clean only inside its parent is not clean. Submodules are found by file name in the other
folders. Each message is printed once, however many tops it shows up under.
"""

from __future__ import annotations

import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT))

from sim.runner import RTL, missing, verilator_folder  # noqa: E402 (the path is set above)
from sim.sources import reachable  # noqa: E402

WAIVERS = ROOT / "sim" / "verilator_waivers.vlt"


def run(command: list[str]) -> str:
    """Messages of a command; a silent failure is a message too."""
    done = subprocess.run(command, capture_output=True, text=True, cwd=ROOT, check=False)
    text = (done.stdout + done.stderr).strip()
    return text or (f"{command[0]} ended with {done.returncode}" if done.returncode else "")


def verilator(module: Path, folders: list[str]) -> str:
    """Verilator's lint, everything on, with the waivers file."""
    tool = f"{verilator_folder()}/verilator"
    search = [word for folder in folders for word in ("-y", folder)]
    options = ["--lint-only", "-Wall", "--quiet", "--default-language", "1364-2005", "-Irtl/include", *search]
    return run([tool, *options, "--top-module", module.stem, str(WAIVERS.relative_to(ROOT)), str(module)])


def icarus(module: Path, folders: list[str]) -> str:
    """Icarus' elaboration as Verilog-2005; its remarks on time scales don't matter, no module has one."""
    options = ["-g2005", "-Wall", "-Wno-timescale", "-Irtl/include", "-tnull", "-s", module.stem]
    # by name, not with -y: Icarus 11's preprocessor crashes on a library file that includes a header twice
    files = [file for folder in folders for file in sorted((ROOT / folder).glob("*.v"))]
    return run(["iverilog", *options, *(str(f.relative_to(ROOT)) for f in reachable(module.stem, files))])


def yosys(modules: list[Path]) -> str:
    """Yosys' own Verilog reader on every file, then its checks on every module as top; warnings count."""
    files = " ".join(map(str, modules))
    steps = [f"read_verilog -defer -Irtl/include {files}", "design -save all"]
    for module in modules:
        steps += ["design -load all", f"hierarchy -check -top {module.stem}", "proc", "check -assert"]
    code = ["from pyosys import libyosys as ys", "d = ys.Design()"]
    code += [f"ys.run_pass({'tee -q ' + step!r}, d)" for step in steps]
    text = run([sys.executable, "-c", "\n".join(code)])
    lines = [line for line in text.splitlines() if line.startswith("Warning") or "error" in line.lower()]
    # that Yosys turns a small array into registers is a remark
    return "\n".join(line for line in dict.fromkeys(lines) if "Replacing memory" not in line)


def main(folders: list[str]) -> int:
    """Lint the modules in `folders` (relative to the checkout); 1 if anything was said."""
    modules = sorted(file.relative_to(ROOT) for folder in folders for file in (ROOT / folder).glob("*.v"))
    with ThreadPoolExecutor(2) as pool:
        texts = list(pool.map(lambda module: verilator(module, folders), modules))
        if missing("icarus") is None:
            texts += pool.map(lambda module: icarus(module, folders), modules)
        texts.append(yosys(modules))
    said: dict[str, str] = {}
    for text in texts:
        for message in re.split(r"\n(?=%)", text) if text else []:
            said.setdefault(message.splitlines()[0], message)
    for message in said.values():
        print(message)
    print(f"lint_verilog: {len(modules)} modules, {len(said)} messages")
    return 1 if said else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:] or [f"rtl/{folder.name}" for folder in sorted(RTL.iterdir())]))
