# SPDX-License-Identifier: Apache-2.0
"""mutate: headers, stand-ins, proofs, and three mutants of a tiny module that its tests must kill."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from mutate import netlist
from mutate.__main__ import spread
from mutate.benches import TB, core_tests, first_tests, modules
from sim.runner import missing
from sim.sources import ROOT, RTL, reachable, sources

VALUES = (("WIDTH", "5"),)


def test_headers() -> None:
    """Every module's header is understood, and other defaults move no line."""
    for name in modules():
        text = netlist.module_file(name).read_text()
        header = netlist.read_header(text, name)
        assert header.ports
        other = netlist.with_values(text, header, dict.fromkeys(header.parameters, "7"))
        assert len(other.splitlines()) == len(text.splitlines())
        assert netlist.read_header(other, name).parameters == header.parameters


def test_every_module_has_tests() -> None:
    for name in modules():
        assert all(folder.is_dir() for folder in first_tests(name)), name
        assert core_tests(name), name
    assert first_tests("mux4")[0] == TB / "arith" / "aligner"


def test_probe_lines() -> None:
    assert netlist.read_probe("mux4 WIDTH=5") == ("mux4", VALUES)
    assert netlist.read_probe("frame_state WATCHDOG_BITS=5 LOADING_NAME=4c") == (
        "frame_state",
        (("WATCHDOG_BITS", "5"), ("LOADING_NAME", "8'h4c")),
    )


def test_stand_in_and_proof(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It compiles in the module's place; only a constant 0 tied to 0 is proved equivalent."""
    file, mutants = netlist.make("mux4", [VALUES], 20, 1, tmp_path)
    assert len({mutant.key for mutant in mutants}) == len(mutants) == 20
    assert not any(netlist.proved_equivalent("mux4", mutant, tmp_path) for mutant in mutants[:3])
    monkeypatch.setenv("RELNAV_REPLACE", f"mux4={file}")
    files = reachable("mux4", sources())
    assert files == [file]
    if missing("icarus") is None:
        done = subprocess.run(
            ["iverilog", "-g2005", "-tnull", "-s", "mux4", *map(str, files)], capture_output=True, check=False
        )
        assert done.returncode == 0, done.stderr
    file, mutants = netlist.make("output_scale", [()], 100, 1, tmp_path / "output_scale")
    tied = [one for one in mutants if one.mode == "const0" and " $procmux$19 B[" in one.key][:1]
    assert [netlist.proved_equivalent("output_scale", one, tmp_path / "output_scale") for one in tied] == [
        True
    ]
    assert (RTL / "ivisnav" / "output_scale.v").read_text().count("module") < file.read_text().count("module")


@pytest.mark.skipif(missing("icarus") is not None, reason=str(missing("icarus")))
def test_three_mutants_die(tmp_path: Path) -> None:
    """In a process of its own, for it runs pytest."""
    code = f"""
from pathlib import Path
from mutate import campaign
from mutate.__main__ import table
campaign.BUILD = Path({str(tmp_path)!r})
result = campaign.run_module("fixed_output", 3, deep=False)
print(result.error, result.fates)
print(table([result]))
"""
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, timeout=300, check=False
    )
    assert "| fixed_output | 3 | 0 | 0 | 3 | 0 | 0 | 100.0 |" in done.stdout, done.stdout + done.stderr


def test_spread() -> None:
    counts = spread(modules(), 240)
    assert min(counts.values()) == 2 and 200 < sum(counts.values()) < 320
