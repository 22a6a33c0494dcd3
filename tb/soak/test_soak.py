# SPDX-License-Identifier: Apache-2.0
"""The soak with fixed seeds on both simulators; both give the same trace; broken cores are found out."""

from __future__ import annotations

import shutil
from pathlib import Path

import numpy as np
import pytest

from sim.runner import RTL, SIMULATORS, missing
from tb.soak import reference
from tb.soak.cores import CORES
from tb.soak.reference import Totals
from tb.soak.soak import LINE, Trace, behind_of, closing, compare, episodes_of, main, play, soak, tell
from tb.soak.stimulus import FIRST, episode_of

EPISODES = {"verilator": 50, "icarus": 2}
SEED = 2026


@pytest.mark.parametrize("top", CORES)
def test_soak(top: str, simulator: str) -> None:
    """Every port in every clock, for some hundred thousand clocks (Icarus: ten thousand)."""
    report = soak(CORES[top], SEED, range(EPISODES[simulator]), simulator)
    assert not report.failures, report.failures
    seen = report.totals
    assert seen.episodes == EPISODES[simulator] and seen.solved and seen.words
    if simulator == "verilator":
        assert {"BAD_TLAST", "BUSY_WRITE", "RANK_DEFICIENT", "ILL_CONDITIONED"} <= seen.flags.keys()
        places = {f"{how} in {where}" for how in ("soft", "hard") for where in ("loading", "COMPUTE", "IDLE")}
        assert places <= seen.resets_in.keys(), closing(seen, 0)


@pytest.mark.parametrize("top", CORES)
def test_simulators_agree(top: str, tmp_path: Path) -> None:
    """The same seed: the same bits at every port in the same clocks."""
    if reason := next(filter(None, map(missing, SIMULATORS)), None):
        pytest.skip(reason)
    numbers = [FIRST, *range(100, 102)]
    icarus, verilator = (play(CORES[top], SEED, numbers, name, tmp_path / name) for name in SIMULATORS)
    assert len(icarus) == len(verilator) > 1000
    for field in LINE.names or ():
        wrong = np.flatnonzero(icarus[field] != verilator[field])
        assert not wrong.size, f"{field} differs in clock {icarus['cycle'][wrong[0]]}"


@pytest.fixture(scope="module")
def trace(tmp_path_factory: pytest.TempPathFactory) -> Trace:
    """A few episodes that are right."""
    name = next((name for name in reversed(SIMULATORS) if not missing(name)), None)
    if name is None:
        pytest.skip("no simulator")
    return play(CORES["oltae_top"], SEED, [FIRST, 0, 1, 2], name, tmp_path_factory.mktemp("trace"))


@pytest.mark.parametrize(
    "name", ["AWREADY", "BVALID", "BRESP", "ARREADY", "RVALID", "TREADY", "IRQ", "STATE", "data"]
)
def test_every_port_is_compared(trace: Trace, name: str) -> None:
    """A port that is wrong in one clock is found in that clock: a soak that cannot fail proves nothing."""
    core = CORES["oltae_top"]
    first, *episodes = episodes_of(trace, 4)
    behind = behind_of(core, first)
    assert behind is not None
    assert all(compare(core, episode, Totals(), behind) is None for episode in episodes)
    episode = episodes[1].copy()
    asserted = {"BRESP": reference.BVALID, "data": reference.RVALID}.get(name, 0)
    lines = np.flatnonzero(episode["bits"] & asserted == asserted)
    found = 0
    for line in lines[:: len(lines) // 10]:
        spoilt = episode.copy()
        if name == "data":
            spoilt["rdata"][line] ^= 1 << 7
        elif name == "STATE":
            spoilt["bits"][line] ^= 1 << reference.STATE
        else:
            spoilt["bits"][line] ^= getattr(reference, name)
        reason = compare(core, spoilt, Totals(), behind)
        if reason is None:  # a result that nothing is said of: before the first frame
            assert name == "data" or line == 0
            continue
        assert reason.startswith(f"clock {episode['cycle'][line]}: "), reason
        found += 1
    assert found >= 3


def test_a_broken_core_is_found(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """The message holds what repeats it, and that episode alone fails again."""
    if reason := missing("icarus"):
        pytest.skip(reason)
    rtl, right = tmp_path / "rtl", "wire given_up = soft_reset | watchdog | upset;"
    shutil.copytree(RTL, rtl)
    file = rtl / "axi" / "frame_state.v"
    text = file.read_text()
    assert text.count(right) == 1
    file.write_text(text.replace(right, "wire given_up = watchdog | upset;"))
    core = CORES["oltae_top"]
    numbers = [number for number in range(60) if len(episode_of(core, SEED, number, False).reads) < 150][:2]
    report = soak(core, SEED, numbers, "icarus", rtl=rtl)
    assert not tell(core, SEED, "icarus", report)
    ((number, reason),) = report.failures.items()
    out = capsys.readouterr().out
    assert (
        f"make soak CORE=oltae_top SIMULATOR=icarus SEED={SEED} EPISODE={number}\n" in out and reason in out
    )
    assert soak(core, SEED, [number], "icarus", rtl=rtl).failures.keys() == {number}


def test_command_line(capsys: pytest.CaptureFixture[str]) -> None:
    if reason := missing("verilator"):
        pytest.skip(reason)
    options = ["--core", "oltae_top", "--seed", "5", "--simulator", "verilator"]
    assert main([*options, "--episode", "0"]) == 0
    first, last = capsys.readouterr().out.splitlines()
    assert first == "soak: seed 5, oltae_top on verilator"
    assert last.startswith("oltae_top: 1 episodes, ") and "result words compared" in last
