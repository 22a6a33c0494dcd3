# SPDX-License-Identifier: Apache-2.0
"""The coverage tool: what it makes of Verilator's counters, of waivers, of cover points."""

from __future__ import annotations

import json
import os
import struct
import subprocess
import sys
from pathlib import Path

import pytest

from coverage import points, report
from coverage.counters import Module, Point, read, simulation_only, spans, word_free
from coverage.functional import CoverPoint
from coverage.functional import read as read_functional
from coverage.waivers import FILE, Waiver, WaiverError, judge, load
from sim.runner import build_and_test, missing, sources
from sim.sources import ROOT, RTL


def dat(file: Path, *rows: tuple[str, int, int, str, str, str, int]) -> Path:
    """A coverage.dat: (file, line, column, type, what, lines, count)."""
    lines = ["# SystemC::Coverage-3"]
    for place, line, column, kind, what, span, count in rows:
        keys = {
            "f": place,
            "l": line,
            "n": column,
            "t": kind,
            "page": f"v_{kind}/m__W3",
            "o": what,
            "S": span,
        }
        packed = "".join(f"\x01{key}\x02{value}" for key, value in keys.items() if value != "")
        lines.append(f"C '{packed}\x01h\x02TOP.m' {count}")
    file.write_text("\n".join(lines) + "\n")
    return file


def test_counts_of_runs_and_parameter_sets_add_up(tmp_path: Path) -> None:
    place = f"{RTL}/axi/frame_state.v"
    first = dat(
        tmp_path / "a.dat",
        (place, 10, 3, "line", "block", "10-12,20", 7),
        (place, 11, 5, "branch", "if", "11", 0),
        (place, 11, 6, "branch", "else", "", 7),
        (place, 12, 9, "branch", "cond_then", "12", 0),
        (place, 5, 2, "toggle", "a[0]:0->1", "", 3),
        (place, 5, 2, "toggle", "a[0]:1->0", "", 0),
        (place, 6, 2, "toggle", "m[1][4]:0->1", "", 1),
        (place, 6, 2, "toggle", "m[2][4]:1->0", "", 1),
        (f"{ROOT}/tb/x/x_replay.v", 1, 1, "line", "block", "1", 0),
    )
    (module,) = read([first]).values()
    assert module.name == "frame_state"
    lines = {point.line: hit for point, hit in module.points["line"].items()}
    assert lines == {10: True, 11: False, 12: True, 20: True}  # line 11 has a statement that did not run
    assert [hit for _, hit in sorted(module.points["branch"].items())] == [False, True, False]
    assert module.points["toggle"] == {Point(5, 0, "a[0]"): False, Point(6, 0, "m[][4]"): True}
    second = dat(
        tmp_path / "b.dat",
        (place, 11, 5, "branch", "if", "11", 2),
        (place, 5, 2, "toggle", "a[0]:1->0", "", 1),
    )
    (module,) = read([first, second]).values()
    assert all(module.points["line"].values()) and all(module.points["toggle"].values())
    os.utime(first, (0, 0))  # before the module got its present text
    (module,) = read([first, second]).values()
    assert not module.points["line"].keys() & {Point(10, 0), Point(12, 0)}


def test_spans_and_memories() -> None:
    assert spans("3-5,9") == {3, 4, 5, 9} and not spans("")
    assert word_free("g[1].a[3]") == "g[1].a[3]"
    assert word_free("m[12][3]") == "m[][3]"
    assert word_free("ready") == "ready"


def test_what_synthesis_leaves_out_does_not_count() -> None:
    text = "a\n// synthesis translate_off\nb\n// synthesis translate_on\nc\n"
    assert simulation_only(text) == {2, 3, 4}
    module = Module(Path("x.v"), unsynthesised=simulation_only(text))
    for line in (1, 3):
        module.count({"l": str(line), "n": "1", "t": "line", "o": "block", "S": str(line)}, 0)
    module.close()
    assert [point.line for point in module.points["line"]] == [1]


def module_with(points_of_line: dict[Point, bool], bits: dict[Point, bool]) -> Module:
    module = Module(RTL / "axi" / "frame_state.v")
    module.points = {"line": points_of_line, "branch": {}, "toggle": bits}
    return module


def test_a_waiver_holds_for_one_text_of_the_line() -> None:
    number, text = next(
        (number, line.strip())
        for number, line in enumerate((RTL / "axi/frame_state.v").read_text().splitlines(), 1)
        if line.strip().startswith("default:")
    )
    right = Waiver("axi/frame_state.v", "line", "why", text=text)
    edited = Waiver("axi/frame_state.v", "line", "why", text=f"{text} ")
    module = module_with(
        {Point(number, 0): False}, {Point(1, 0, "x.unused[3]"): False, Point(1, 0, "y"): False}
    )
    used: set[Waiver] = set()
    tally = judge(module, [edited], used)
    assert tally["line"].holes and not used
    pattern = Waiver("*/*.v", "toggle", "why", signals=r"(.*\.)?unused(\[\d+\])?")
    tally = judge(module, [right, pattern], used)
    assert not tally["line"].holes and [point.name for point in tally["toggle"].holes] == ["y"]
    assert used == {right, pattern}
    assert tally["toggle"].total == 2 and tally["toggle"].hit == 0


@pytest.mark.parametrize(
    ("text", "about"),
    [
        ("file = 'axi/frame_state.v'\nkind = 'line'\ntext = 'x'", "reason"),
        ("file = 'axi/frame_state.v'\nkind = 'line'\nreason = 'x'", "text"),
        ("file = 'axi/none.v'\nkind = 'branch'\ntext = 'x'\nreason = 'x'", "file of rtl/"),
        ("file = '*/*.v'\nkind = 'toggle'\nreason = 'x'", "signals"),
        ("file = 'axi/frame_state.v'\nkind = 'state'\nreason = 'x'", "kind"),
        ("file = 'axi/frame_state.v'\nkind = 'line'\ntext = 'x'\nreason = 'x'\nline = 3", "unknown key line"),
    ],
)
def test_waivers_that_say_too_little_are_refused(tmp_path: Path, text: str, about: str) -> None:
    file = tmp_path / "waivers.toml"
    file.write_text(f"[[waiver]]\n{text}\n")
    with pytest.raises(WaiverError, match=about):
        load(file)


def test_the_waivers_of_the_repository_are_well_formed() -> None:
    assert load(FILE)


def test_percentages_are_never_rounded_up_to_all() -> None:
    assert report.percent(99999, 100000) == "99.9"
    assert report.percent(3, 3) == "100.0" and report.percent(0, 0) == "-"


def test_bits_in_few_words() -> None:
    holes = [Point(1, 0, name) for name in ("a[0]", "a[2]", "a[1]", "a[7]", "b", "m[][3]")]
    assert report.bits(holes) == "`a[2:0]`, `a[7]`, `b`, `m[][3]`"


SAMPLING = """
import sys
from coverage import points
for state, what in [("IDLE", "push"), ("DONE", "push"), ("loading", "beat")][int(sys.argv[1]) :]:
    points.event("oltae_top", state, what)
points.flag("ivisnav_top", ["UPSET"])
points.flag("ivisnav_top", ["WATCHDOG"], "cleared")
points.frame(
    "oltae_top", n=7, weights=[1, 2, 0], feed="stream", fracs=[-64],
    variance=0x7F800000, flags=["Q_SATURATED"],
    words=[0] * 6 + [0x3F800000, 0, 0, 0, 0x3F800000, 0, 0, 0, 0x3F800000] + [0] * 19, turn=2,
    config=(True, False, True),
)
"""


def sampled(folder: Path, argument: str) -> None:
    """Sample in a process of its own: a point exists once in a process."""
    environment = {"RELNAV_COVERAGE": str(folder), "PYTHONPATH": f"{ROOT}:{ROOT / 'sw'}"}
    subprocess.run([sys.executable, "-c", SAMPLING, argument], env=environment, check=True)


def test_cover_points_of_several_processes_are_merged(tmp_path: Path) -> None:
    for argument in "12":
        sampled(tmp_path / "raw", argument)
    files = sorted((tmp_path / "raw").glob("*.xml"))
    assert len(files) == 2
    found = {point.name: point for point in read_functional(files, tmp_path / "merged.xml")}
    assert set(found["oltae_top.n"].holes) == set(found["oltae_top.n"].bins) - {"5 to 12"}
    events = found["oltae_top.state_x_event"]
    assert events.hit == 2 and "loading x beat" not in events.holes and "IDLE x push" in events.holes
    assert not {f"{state} x {what}" for state, what in points.NEVER} & set(events.bins)
    changes = found["ivisnav_top.flag_x_change"]
    assert set(changes.bins) - set(changes.holes) == {"UPSET x raised", "WATCHDOG x cleared"}
    assert set(found["oltae_top.weights"].bins) - set(found["oltae_top.weights"].holes) == {
        "mixed",
        "with zeros",
    }
    hit = {name for name, point in found.items() if point.hit and name.startswith("oltae_top")}
    assert {"oltae_top.angle", "oltae_top.turn", "oltae_top.configuration", "oltae_top.outcome"} <= hit
    assert found["oltae_top.variance"].hit == found["oltae_top.frac"].hit == 1
    assert found["oltae_top.variance"].holes == ["0", "finite", "denormal", "sign set"]


def test_without_the_variable_nothing_is_sampled(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delenv("RELNAV_COVERAGE", raising=False)
    monkeypatch.chdir(tmp_path)
    points.event("oltae_top", "IDLE", "push")
    assert not list(tmp_path.iterdir())


def test_what_cannot_be_is_an_error_when_it_is(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("RELNAV_COVERAGE", str(tmp_path))
    for state, what in points.NEVER:
        with pytest.raises(AssertionError, match=f"{what} in {state}"):
            points.event("oltae_top", state, what)
    assert not list(tmp_path.iterdir())


def word(value: float) -> int:
    return int(struct.unpack("<I", struct.pack("<f", value))[0])


@pytest.mark.parametrize(
    ("degrees", "name"),
    [
        (0, "below 0.01"),
        (30, "to 60"),
        (119, "60 to 120"),
        (178, "120 to 179"),
        (179.5, "179 to 179.99"),
        (180, "179.99 to 180"),
    ],
)
def test_angles(degrees: float, name: str) -> None:
    import math

    cosine, sine = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    rotation = [cosine, -sine, 0, sine, cosine, 0, 0, 0, 1]
    assert points.angle_class([word(value) for value in rotation]) == name


def test_weights() -> None:
    assert points.weight_classes(None) == ("none",)
    assert points.weight_classes([1, 1]) == ("all one",)
    assert points.weight_classes([0, 0]) == ()
    assert points.weight_classes([0, 7]) == ("with zeros", "one positive")
    assert points.weight_classes([65535, 1, 5]) == ("mixed", "span of 2^15 or more")


def test_the_report_names_every_hole() -> None:
    module = module_with({Point(1, 0): False, Point(2, 0): True}, {Point(3, 0, "a[4]"): False})
    tallies = {module.name: judge(module, [], set())}
    functional = [CoverPoint("oltae_top.n", ["3", "4"], ["4"])]
    about = {"tool": "Verilator", "goal": 98.0, "runs": 1}
    text = report.markdown({module.name: module}, tallies, functional, about, ["a problem"])
    for part in (
        "* line 1: `// SPDX",
        "* toggle: `a[4]`",
        "| oltae_top.n | 1 of 2 | 4 |",
        "* a problem",
        "| 1 of 2 | 50.0 |",
    ):
        assert part in text, part
    assert "a[4]" in report.page({module.name: module}, tallies)
    numbers = report.results(tallies, functional, about, {"axi/frame_state": 5})
    assert numbers["modules"]["frame_state"]["line"] == [1, 0, 2]
    assert json.loads(json.dumps(numbers))["functional"]["oltae_top.n"]["holes"] == ["4"]


def test_toggles_of_wide_signals_and_of_the_reset(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What toggle.h mends: the change of one bit of a wide signal counts for this bit alone."""
    if reason := missing("verilator"):
        pytest.skip(reason)
    monkeypatch.setenv("RELNAV_COVERAGE", str(tmp_path / "raw"))
    top = tmp_path / "wide.v"
    top.write_text(
        "module wide (input wire clk, input wire rst, output reg done);\n"
        "  reg [99:0] word;\n  reg kept;\n  reg [3:0] count;\n"
        "  always @(posedge clk) begin\n"
        "    count <= rst ? 4'd0 : count + 4'd1;\n"
        "    word <= {99'd0, count[1]} << 1;\n"
        "    if (rst) kept <= 1'b0;\n"
        "    done <= ~rst & &count;\n  end\nendmodule\n"
    )
    build_and_test(
        "wide", [*sources("axi"), top], "replay_bench", simulator="verilator", folder=tmp_path / "run"
    )
    (file,) = (tmp_path / "raw").glob("wide-*.dat")
    (module,) = read([file], rtl=tmp_path).values()
    hit = {point.name for point, hit in module.points["toggle"].items() if hit}
    assert {name for name in hit if name.startswith("word")} == {"word[1]"}
    assert "kept" not in hit and "count[2]" in hit
