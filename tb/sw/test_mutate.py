# SPDX-License-Identifier: Apache-2.0
"""mutate: headers, stand-ins, proofs, and three mutants of a tiny module that its tests must kill."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

from mutate import netlist, report
from mutate.__main__ import LEAST, MOST, UNKNOWN, UNKNOWN_PROBE, Cost, costs, sample
from mutate.benches import TB, core_tests, first_tests, modules
from mutate.campaign import PROVED, Fate, Result, bench_files
from mutate.trial import _Reader
from sim.runner import missing
from sim.sources import ROOT, RTL, fingerprint, module_file, reachable, sources

VALUES = (("WIDTH", "5"),)


def test_headers() -> None:
    """Every module's header is understood, and other defaults move no line."""
    for name in modules():
        text = module_file(name).read_text()
        header = netlist.read_header(text, name)
        assert header.ports
        other = netlist.with_values(text, header, dict.fromkeys(header.parameters, "7"))
        assert len(other.splitlines()) == len(text.splitlines())
        assert netlist.read_header(other, name).parameters == header.parameters


def test_every_module_has_tests() -> None:
    for name in modules():
        assert all(folder.is_dir() for folder in first_tests(name)), name
        assert core_tests(name), name
    assert first_tests("mux4") == [TB / "arith" / "mux4"]
    assert first_tests("leading_zeros_24")[0] == TB / "arith" / "float_multiply"


def test_probe_lines() -> None:
    assert netlist.read_probe("mux4 WIDTH=5") == ("mux4", VALUES)
    assert netlist.read_probe("frame_state WATCHDOG_BITS=5 LOADING_NAME=4c") == (
        "frame_state",
        (("WATCHDOG_BITS", "5"), ("LOADING_NAME", "8'h4c")),
    )


def test_stand_in_and_proof(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It compiles in the module's place; only what changes nothing is proved equivalent."""
    file, _, mutants = netlist.make("mux4", [VALUES], 20, 1, tmp_path)
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
    monkeypatch.delenv("RELNAV_REPLACE")
    # mux3_invert takes select 2 and 3 for the same: proved with the instances taken in
    _, _, mutants = netlist.make("aligner", [()], 30, 1, tmp_path / "aligner")
    same = [one for one in mutants if one.key == "cnot1 sixteens select[0]/1"]
    assert [netlist.proved_equivalent("aligner", one, tmp_path / "aligner") for one in same] == [True]
    assert (RTL / "arith" / "mux4.v").read_text().count("module") < file.read_text().count("module")


def test_registers_keep_their_names(tmp_path: Path) -> None:
    """In the stand-in of one set of parameters, though flip-flops' outputs are mutated."""
    values = (("WIDTH", "7"), ("RESET", "8'h01"))
    _, (single,), mutants = netlist.make("voted_register", [values], 40, 1, tmp_path)
    assert any(mutant.wire.startswith("first[") and mutant.port == "Q" for mutant in mutants)
    text = single.read_text()
    assert all(f"  reg [6:0] {name};\n" in text for name in ("first", "second", "third"))
    assert "wire [6:0] first__read;" in text and "first <= " in text
    if missing("icarus") is None:
        command = ["iverilog", "-g2005", "-tnull", "-s", "voted_register", str(single)]
        done = subprocess.run(command, capture_output=True, check=False)
        assert done.returncode == 0, done.stderr


def test_readers_of_a_mutated_register() -> None:
    """They get the mutation; a port of the register's name, and the register, keep it."""
    cells = (
        "  cell $dff $f\n    connect \\Q {}\n  end\n  cell \\sub \\u\n    connect \\a \\a [0]\n  end\n{}end\n"
    )
    head = "module \\m\n  wire width 2 signed \\a\n"
    before = head + cells.format("\\a", "")
    after = head + cells.format("{ $n \\a [0] }", "  connect \\a [1] $mux\n")
    assert netlist.keep_registers(before, after) == (
        "module \\m\n  wire width 2 signed \\a\n  wire width 2 signed \\a__read\n"
        + cells.format("\\a", "  connect \\a__read [1] $mux\n  connect { $n \\a__read [0] } \\a\n").replace(
            "\\a [0]", "\\a__read [0]"
        )
    )
    assert netlist.keep_registers(before, before) == before


def test_instances_stand_in_their_blocks() -> None:
    cell = "  twin_register #(\n    .WIDTH(32'd3)\n  ) {}  (\n    .q({{ a, b }})\n  );\n"
    inside = [cell.format(name) for name in ("\\g_a.one", "\\g_a.two", "\\g_a.g_b.three", "four")]
    text = netlist._scopes("module m;\n" + "".join(inside) + "endmodule\n")
    assert "generate if (1) begin : g_a\n  twin_register #(" in text and "\\" not in text
    assert text.count("begin : g_a\n") == 2 and text.count("begin : g_b\n") == 1
    assert text.index("four") < text.index("generate") and text.endswith("endgenerate\nendmodule\n")


@pytest.mark.skipif(missing("icarus") is not None, reason=str(missing("icarus")))
def test_three_mutants_die(tmp_path: Path) -> None:
    """In a process of its own, for it runs pytest."""
    code = f"""
from pathlib import Path
from mutate import campaign
from mutate.report import row, table
campaign.BUILD = Path({str(tmp_path)!r})
result = campaign.run_module("fixed_output", 3, deep=False)
print(result.error, result.fates)
print(table([row(result)]))
"""
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, timeout=300, check=False
    )
    assert "| fixed_output | 3 | 3 | 0 | 0 | 0 | 0 | 0 | 100.0 |" in done.stdout, done.stdout + done.stderr


def test_costs() -> None:
    """A probe counts once, in parts for the modules that share it; what isn't known counts too."""
    rows: list[report.Row] = [{"module": "mac_cell", "seconds_before": 5.0, "seconds_each": 0.5}]
    probes = {"gram/gram_array": 8.0, "gram/gram_ring": 2.0}
    found = costs(["mac_cell", "gram_lane", "mux4"], rows, probes)
    assert found["mac_cell"] == Cost(5.0 + 4.0 + 1.0, 0.5)
    assert found["gram_lane"] == Cost(UNKNOWN[0] + 5.0, UNKNOWN[1])
    assert found["mux4"] == Cost(UNKNOWN[0] + UNKNOWN_PROBE, UNKNOWN[1])


def test_sample() -> None:
    """Each module's mutants get the same time, within bounds; what is left of a tight budget is the least."""
    known = {"mux4": Cost(5.0, 0.5), "gram_array": Cost(50.0, 10.0)}
    assert sample(known, 1.0) == {"mux4": LEAST, "gram_array": LEAST}
    assert sample(known, 10_000.0) == {"mux4": MOST, "gram_array": MOST}
    counts = sample(known, 120.0)
    assert LEAST < counts["gram_array"] < counts["mux4"]
    assert sum(cost.before + counts[name] * cost.each for name, cost in known.items()) <= 120
    assert list(counts) == ["gram_array", "mux4"]
    assert sample({"fixed_output": Cost(*UNKNOWN)}, UNKNOWN[0] + 10 * UNKNOWN[1])["fixed_output"] == 10


def test_a_small_sample_is_the_beginning_of_a_larger_one(tmp_path: Path) -> None:
    few, more = (
        [one.key for one in netlist.make("mux4", [VALUES, (("WIDTH", "7"),)], n, 1, tmp_path)[2]]
        for n in (5, 25)
    )
    assert few == more[:5]


def test_what_changes_nothing_is_left_out() -> None:
    """Constants tied to themselves, inversions on a condition that is constant, clocks."""
    text = (
        "  cell $mux $procmux$1\n    connect \\A 0\n    connect \\B 4'1010\n    connect \\S \\select\n  end\n"
    )
    constants = netlist._constants(text)
    assert constants == {("$procmux$1", "A"): "0" * 32, ("$procmux$1", "B"): "1010"}

    def possible(mode: str, port: str, bit: int, more: str = "") -> bool:
        line = f"mutate -mode {mode} -module m -cell $procmux$1 -port {port} -portbit {bit}{more}"
        return netlist._possible(line, constants)

    assert not possible("const1", "B", 1) and possible("const1", "B", 0)
    assert not possible("const0", "A", 3) and possible("const1", "A", 3) and possible("const0", "S", 0)
    assert not possible("cnot1", "B", 1, " -ctrlbit 2") and possible("cnot0", "B", 1, " -ctrlbit 2")
    assert possible("inv", "B", 1) and not possible("inv", "CLK", 0)


def test_bench_files() -> None:
    """A bench is made of its folder and of what it imports from tb/, through other files too."""
    found = {str(file.relative_to(TB)) for file in bench_files(TB / "arith" / "float_add")}
    assert {"arith/float_add/test_float_add.py", "arith/floats.py", "common/replay/replay.v"} <= found
    assert "common/vectors.py" in found and not any(name.startswith("gram/") for name in found)


def test_reader_takes_over_after_the_first_wrong_line(tmp_path: Path) -> None:
    right, written = tmp_path / "right", tmp_path / "written"
    right.write_text("1\n2\n3\n4\n")
    written.write_text("1\n9\n3")
    reader = _Reader(written, right)
    reader.start()
    reader.join(10)
    assert reader.ended
    reader.complete()
    assert written.read_text() == "1\n9\n3\n4\n"
    written.write_text("1\n2\n")
    reader = _Reader(written, right)
    reader.start()
    reader.stop.wait(0.3)
    reader.stop.set()
    reader.join(10)
    assert not reader.ended


def test_report(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A larger sample of the same text stays; a worse one or one of another text replaces it."""
    monkeypatch.setattr(report, "RESULTS", tmp_path / "results.json")
    monkeypatch.setattr(report, "TABLE", tmp_path / "results.md")
    by = "test_aligner.py::test_aligner_floors[icarus]"

    def result(killed: int, survived: int, source: str = fingerprint("mux4")) -> Result:
        one = Result("mux4", source)
        one.fates += [Fate(k, f"inv a{k}", "", "", "killed", by, seconds=1.0) for k in range(killed)]
        one.fates += [
            Fate(90, "inv b", "", "", "timeout", "test_oltae_top.py::test_ports[verilator]", seconds=1.0)
        ]
        one.fates += [
            Fate(91, "inv c", "", "", "equivalent", reason="never"),
            Fate(92, "inv d", "", "", "equivalent"),
        ]
        one.fates[-1].reason = PROVED
        one.fates += [Fate(99, "const0 e", "wire[1]", "", "survived", seconds=2.0)] * survived
        return one

    report.save([result(19, 1)])
    (row,) = report.load()
    assert (row["mutants"], row["killed"], row["by_time"], row["by_cores"]) == (23, 20, 1, 1)
    assert (row["equivalent"], row["proved"], row["survivors"], row["percent"]) == (2, 1, 1, 95.24)
    assert row["current"] and not report.below(result(19, 1)) and report.below(result(17, 1))
    assert "mux4: `const0 e` wire[1]" in report.TABLE.read_text()
    assert "mux4: `inv c`: never" in report.TABLE.read_text()
    report.save([result(5, 0)])
    assert report.load()[0]["mutants"] == 23
    report.save([result(5, 1)])
    assert report.load()[0]["percent"] == 85.71
    report.RESULTS.unlink()
    report.save([result(3, 0, "another")])
    assert not report.load()[0]["current"] and "earlier text" in report.TABLE.read_text()
