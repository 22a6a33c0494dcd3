# SPDX-License-Identifier: Apache-2.0
"""The runner itself: what passes passes, and every way to fail is a failure that says why."""

from pathlib import Path

import pytest

from sim import runner
from sim.runner import SimulationFailed, SimulatorMissing, build_and_test
from sim.sources import reachable

SOURCES = [Path(__file__).parent / "counter.v"]


@pytest.mark.parametrize("width", [4, 6])
def test_parameters_reach_the_verilog_and_the_bench(simulator: str, width: int) -> None:
    run = build_and_test(
        "counter",
        SOURCES,
        "counter_bench",
        simulator=simulator,
        parameters={"WIDTH": width},
        env={"WIDTH": str(width)},
    )
    assert run.tests == 1


def test_a_failing_bench_fails_with_its_summary(simulator: str) -> None:
    with pytest.raises(SimulationFailed, match=r"1 of 2 cocotb tests failed: .*fails") as failure:
        build_and_test("counter", SOURCES, "counter_bench", simulator=simulator, env={"FAIL": "1"})
    assert "TESTS=3 PASS=1 FAIL=1 SKIP=1" in str(failure.value)
    assert "AssertionError" in str(failure.value)


def test_a_bench_that_hangs_is_ended(simulator: str) -> None:
    with pytest.raises(SimulationFailed, match="did not end in time"):
        build_and_test("counter", SOURCES, "counter_bench", simulator=simulator, env={"HANG": "1"}, timeout=3)


def test_no_test_at_all_is_a_failure(simulator: str) -> None:
    with pytest.raises(SimulationFailed, match="no cocotb test ran"):
        build_and_test("counter", SOURCES, "counter_bench", simulator=simulator, testcase="no_such_test")


def test_a_syntax_error_is_shown(simulator: str, tmp_path: Path) -> None:
    bad = tmp_path / "counter.v"
    bad.write_text("module counter; wibble endmodule\n")
    with pytest.raises(SimulationFailed, match=r"counter\.v:1"):
        build_and_test("counter", [bad], "counter_bench", simulator=simulator)


def test_systemverilog_is_refused_by_icarus(tmp_path: Path) -> None:
    if runner.missing("icarus"):
        pytest.skip(str(runner.missing("icarus")))
    newer = tmp_path / "counter.v"
    newer.write_text(SOURCES[0].read_text().replace("always @(posedge clk)", "always_ff @(posedge clk)"))
    with pytest.raises(SimulationFailed, match="syntax error"):
        build_and_test("counter", [newer], "counter_bench", simulator="icarus")


def test_waves_are_written_where_asked(simulator: str, tmp_path: Path) -> None:
    target = tmp_path / "counter.fst"
    run = build_and_test("counter", SOURCES, "counter_bench", simulator=simulator, waves=target)
    assert run.waves is not None
    assert run.waves.parent == tmp_path
    assert run.waves.stat().st_size > 100


def test_hidden_signals_leave_the_ports(simulator: str) -> None:
    assert build_and_test("counter", SOURCES, "counter_bench", simulator=simulator, public=False).tests == 1


def test_a_build_is_made_again_only_when_a_source_changes(simulator: str, tmp_path: Path) -> None:
    source = tmp_path / "counter.v"
    source.write_text(SOURCES[0].read_text())

    def built() -> float:
        run = build_and_test("counter", [source], "counter_bench", simulator=simulator)
        return (run.folder.parent.parent / "build.log").stat().st_mtime_ns

    first = built()
    assert built() == first
    source.write_text(source.read_text() + "// changed\n")
    assert built() != first


def test_a_missing_simulator_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(runner, "missing", lambda _: "not installed")
    with pytest.raises(SimulatorMissing, match="not installed"):
        build_and_test("counter", SOURCES, "counter_bench", simulator="icarus")


def test_only_the_files_that_the_top_needs(tmp_path: Path) -> None:
    files = [tmp_path / f"{name}.v" for name in ("leaf", "middle", "other", "top")]
    texts = ["module leaf; endmodule", "module middle; leaf u(); endmodule", "broken", "middle u(); // other"]
    for file, text in zip(files, texts, strict=True):
        file.write_text(text)
    assert [file.stem for file in reachable("top", files)] == ["leaf", "middle", "top"]
    assert reachable("nowhere", files) == files
    files[3].write_text("`CORE u(); `CORES v();")
    assert [file.stem for file in reachable("top", files)] == ["top"]
    assert [file.stem for file in reachable("top", files, {"CORE": "middle"})] == ["leaf", "middle", "top"]
