# SPDX-License-Identifier: Apache-2.0
"""docs/verification.md against the results it is made of."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from scripts import verification
from sim.sources import fingerprint, sources


def rows(text: str) -> dict[str, list[str]]:
    """module -> cells of its row."""
    table = text.partition("## By module")[2].partition("## Proofs")[0]
    cells = [line.strip("| ").split(" | ") for line in table.splitlines() if line.startswith("| [`")]
    return {row[0].partition("`]")[0].removeprefix("[`"): row[1:] for row in cells}


def test_the_page_is_that_of_the_results() -> None:
    """After a change of rtl/ or of a results.json: make verification."""
    assert verification.PAGE.read_text(encoding="utf-8") == verification.text()


def test_every_module_has_a_row() -> None:
    assert rows(verification.PAGE.read_text(encoding="utf-8")).keys() == {file.stem for file in sources()}


FORMAL = {
    "proofs": 2,
    "passed": 1,
    "broken": 3,
    "caught": 2,
    "assertions": 9,
    "seen_failing": 8,
    "never_failed": ["mux4_properties.v: same"],
}


COUNTS = {"trials": 4, "bits": 1, "silent": 1, "hang": 2, "next hang": 3}
CORE = {
    "classes": dict.fromkeys(("control", "configuration", "data", "memory"), COUNTS),
    "modules": {"control": {"mux4": COUNTS}, "data": {"mux4": {"trials": 5, "bits": 9}}},
    "silent data": {"mux4.x": 3},
}


@pytest.fixture
def results(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Results of each tool for the module mux4, the mutants' of an earlier text."""
    here, source = "mux4", fingerprint("mux4")
    group = {
        "module": here,
        "sources": {here: source, "mux3_invert": "older"},
        "about": "all right",
        "engine": "complete",
        "status": "PASS",
        "broken": 3,
        "caught": 2,
    }
    mutants = {"module": here, "source": source, "killed": 2, "survivors": 1, "equivalent": 4}
    told = {
        "formal": {"date": "2001-02-03", **FORMAL, "groups": [group]},
        "mutate": {"goal": 95.0, "modules": [mutants]},
        "coverage": {
            "date": "2001-02-04",
            "totals": {kind: [99, 1, 100] for kind in ("line", "branch", "toggle")},
            "tests": {"arith/reciprocal": 6, "arith/float_add": 3, "sw": 50},
            "functional": {"oltae_top.n": {"hit": 1, "bins": 2, "holes": ["65535"]}},
            "modules": {
                here: {"source": "older", "line": [3, 0, 4], "branch": [0, 0, 0], "toggle": [6, 2, 8]}
            },
        },
        "faults": {"now": {"date": "2001-02-05", "cores": {"oltae_top": CORE, "ivisnav_top": CORE}}},
    }
    for tool, content in told.items():
        (tmp_path / tool).mkdir()
        (tmp_path / tool / "results.json").write_text(json.dumps(content))
    monkeypatch.setattr(verification, "ROOT", tmp_path)
    folders = [verification.TB / "arith" / name for name in ("float_add", "reciprocal")]
    monkeypatch.setattr(verification, "first_tests", lambda module: folders)
    return tmp_path


def test_what_the_page_makes_of_results(results: Path) -> None:
    text = verification.text()
    cells = rows(text)["mux4"]
    assert cells[0] == "9 in float_add, reciprocal"
    assert cells[1:] == ["1 of 1\\*", "2 of 3\\*", "2 of 3", "75.0 %\\*", "-", "100.0 %\\*", "6 of 18"]
    assert "8 flips in 2 bits: silent 2, hang 4; next frame wrong 0, hang 6" in text
    assert "1 of 2; 2 of 3 broken copies caught; 8 of 9 assertions seen to fail" in text
    assert "2 of 3 mutants killed, 66.7 %, in 1 modules" in text
    assert "59 cases" in text and "1 of 2 bins of 1 points, 50.0 %" in text
    assert "| `mux4` | all right | complete | PASS\\* | 2 of 3 |" in text
    for row in (
        "assertions seen to fail | 2001-02-03 | 1 of 1 |",
        "in 1 modules | not kept | none |",
        "without the 1 waived | 2001-02-04 | 1 of 1 |",
        "hang 6 | 2001-02-05 | not kept |",
    ):
        assert row in text, row
    missing = text.partition("## Known to be missing")[2]
    for part in (
        "below 95 %: `mux4`",
        "`make formal` tried an earlier text of `mux4`.",
        "`make coverage` tried an earlier text of `mux4`.",
        "Lines or branches missed in `mux4`",
        "oltae_top.n: 65535",
        "_properties.v: same",
    ):
        assert part in missing, part
    assert rows(text)["float_add"][1:] == ["-", "-", "not run", "not run", "not run", "not run", "-"]


def test_without_results_nothing_is_claimed(results: Path) -> None:
    for file in results.glob("*/results.json"):
        file.unlink()
    text = verification.text()
    figures = re.findall(r"^\| ([\w ]+) \| ([^|]*) \| - \| [^|]+ \| `make", text, re.MULTILINE)
    assert len(figures) >= 7 and {figure for _, figure in figures} == {"not run"}
