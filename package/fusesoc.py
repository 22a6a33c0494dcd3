# SPDX-License-Identifier: Apache-2.0
"""FuseSoC core files (CAPI2): <core>.core at the top of the repository, targets sim, lint and synth."""

from __future__ import annotations

from relnav import __version__
from relnav.vlnv import LIBRARY, VENDOR

from .cores import Core
from .filelist import NOTICE
from .smoke import BENCH, script_file

PART = "xc7z020clg400-1"


def core_file(core: Core) -> str:
    """The core file. The parameters of `synth` and `lint` are those of the Verilog top."""
    headers = [file.relative_to(core.root).as_posix() for file in core.headers]
    modules = [file.relative_to(core.root).as_posix() for file in core.modules]
    parameters = core.module.parameters
    overrides = [f"    parameters: [{', '.join(parameters)}]"] if parameters else []
    lines = [
        "CAPI=2:",
        "# SPDX-License-Identifier: Apache-2.0",
        f"# {NOTICE}",
        "",
        f"name: {VENDOR}:{LIBRARY}:{core.name}:{__version__}",
        f'description: "{core.title}"',
        "",
        "filesets:",
        "  rtl:",
        "    file_type: verilogSource-2005",
        "    files:",
        *(f"      - {name}: {{is_include_file: true}}" for name in headers),
        *(f"      - {name}" for name in modules),
        "  bench:",
        "    files:",
        f"      - {BENCH}: {{file_type: verilogSource-2005}}",
        f"      - {script_file(core)}: {{file_type: user, copyto: smoke.hex}}",
        "  waivers:",
        "    files:",
        "      - sim/verilator_waivers.vlt: {file_type: vlt}",
        "  constraints:",
        "    files:",
        "      - vivado/clock.xdc: {file_type: xdc}",
        "",
        "targets:",
        "  default:",
        "    filesets: [rtl]",
        f"    toplevel: {core.top}",
        "",
        "  sim:",
        '    description: "Two frames against the bit-exact model\'s results, on Icarus"',
        "    flow: sim",
        "    flow_options:",
        "      tool: icarus",
        "      iverilog_options: [-g2005]",
        "    filesets: [rtl, bench]",
        "    toplevel: smoke",
        f"    parameters: [RELNAV_TOP={core.top}]",
        "",
        "  lint:",
        '    description: "Verilator, all warnings"',
        "    flow: lint",
        "    flow_options:",
        "      tool: verilator",
        "      verilator_options: [-Wall, --default-language, 1364-2005]",
        "    filesets: [waivers, rtl]",
        f"    toplevel: {core.top}",
        *overrides,
        "",
        "  synth:",
        '    description: "The core alone on a Zynq-7020, by Vivado, which was not at hand to try it"',
        "    flow: vivado",
        "    flow_options:",
        f"      part: {PART}",
        "      pnr: none",
        "    filesets: [rtl, constraints]",
        f"    toplevel: {core.top}",
        *overrides,
        "",
        "parameters:",
        "  RELNAV_TOP:",
        "    datatype: str",
        "    paramtype: vlogdefine",
        '    description: "the module that the bench tries"',
    ]
    for name, value in parameters.items():
        lines += [
            f"  {name}:",
            "    datatype: int",
            "    paramtype: vlogparam",
            f"    default: {value}",
            f'    description: "0 leaves its hardware out (docs/{core.name}.md)"',
        ]
    return "\n".join(lines) + "\n"
