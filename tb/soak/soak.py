# SPDX-License-Identifier: Apache-2.0
"""`make soak`: random frames, accesses and resets without end, every port compared with the model.

python -m tb.soak.soak [--minutes M] [--seed S] [--core oltae_top|ivisnav_top|both]
                       [--simulator verilator|icarus] [--episode N]

A run is a row of episodes, each after a hard reset and each made from (core, seed, number) alone, so that
`--episode` repeats one of them in seconds. The last line says what was done. Exit code 1: a difference.
"""

from __future__ import annotations

import argparse
import random
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from dataclasses import dataclass, field
from itertools import count
from pathlib import Path

import numpy as np
import numpy.typing as npt
from relnav.rtlsim import quiet

from coverage import points
from sim.runner import (
    ROOT,
    RTL,
    SIMULATORS,
    SimulationFailed,
    SimulatorMissing,
    build_and_test,
    sources,
)
from tb.common.vectors import read_hex_rows
from tb.soak.cores import CORES, Core
from tb.soak.observed import Observed
from tb.soak.reference import COMPUTE, EPISODE, QUIET, STATE, VERIFY, Mismatch, Reference, Totals
from tb.soak.stimulus import FIRST, episode_of

HERE = Path(__file__).parent
BATCH = {"verilator": 40, "icarus": 6}
"""Episodes of one simulation."""
LONG = 1 / 400
"""Share of episodes with a frame beyond the longest."""
Trace = npt.NDArray[np.void]
LINE = np.dtype(
    [
        ("cycle", ">u4"),
        ("bits", ">u4"),
        ("wdata", ">u4"),
        ("rdata", ">u4"),
        ("tdata", ">u8"),
        ("address", ">u4"),
    ]
)


@dataclass
class Report:
    """A run: totals, and the number and reason of each episode that failed."""

    totals: Totals = field(default_factory=Totals)
    failures: dict[int, str] = field(default_factory=dict)
    simulated: float = 0.0
    compared: float = 0.0


def is_long(core: Core, seed: int, number: int) -> bool:
    """Whether this episode has a frame beyond the longest."""
    return number != FIRST and random.Random(f"long {core.top} {seed} {number}").random() < LONG


def play(
    core: Core, seed: int, numbers: Sequence[int], simulator: str, folder: Path, rtl: Path = RTL
) -> Trace:
    """Simulate episodes; returns the trace, lines of LINE. Raises SimulationFailed when they do not end."""
    folder.mkdir(parents=True, exist_ok=True)
    episodes = [episode_of(core, seed, number, is_long(core, seed, number)) for number in numbers]
    for name in ("writes", "reads", "beats", "resets"):
        with (folder / f"{name}.hex").open("w") as file:
            for episode in episodes:
                file.write("\n".join(getattr(episode, name)) + "\n")
    with quiet():
        build_and_test(
            "soak_harness",
            [*sources(rtl_dir=rtl), HERE / "soak_harness.v"],
            "soak_bench",
            simulator=simulator,
            defines={"RELNAV_TOP": core.top},
            includes=[rtl / "include"],
            plusargs=[f"+folder={folder}", f"+episodes={len(numbers)}"],
            folder=folder / "run",
            public=False,
            timeout=1800,
        )
    return np.ascontiguousarray(read_hex_rows(folder / "trace.hex")).view(LINE)[:, 0]


def compare(core: Core, trace: Trace, totals: Totals, behind: int) -> str | None:
    """One episode's lines against the model; returns what is wrong."""
    reference = (Observed if points.active() else Reference)(core, totals, behind)
    lines = trace.tolist()
    try:
        for number, (now, *ports) in enumerate(lines):
            reference.clock(now, *ports)
            until = lines[number + 1][0] if number + 1 < len(lines) else now + 1
            moved = now
            now += 1
            while now < until:
                if now - moved > QUIET:  # nothing moves but the program
                    commit = reference.next_commit
                    ahead = commit if commit is not None and now <= commit < until else until
                    reference.skip(ahead - now)
                    now = moved = ahead
                    if ahead == until:
                        break
                reference.clock(now, *ports)
                now += 1
    except Mismatch as error:
        return f"{error} (after {totals.frames} complete frames)"
    finally:
        totals.episodes += 1
        totals.cycles += int(trace["cycle"][-1]) - int(trace["cycle"][0])
    return None


def behind_of(core: Core, trace: Trace) -> int | None:
    """What `core.latency` leaves open, from the frame of the first episode; None where it has no result."""
    states = (trace["bits"] >> STATE & 7).astype(int)
    cycles = trace["cycle"].astype(int)
    if not (np.any(states == COMPUTE) and np.any(states == VERIFY)):
        return None
    behind = int(cycles[states == VERIFY][0] - cycles[states == COMPUTE][0]) - core.latency(False, 8)[-1]
    return behind if behind in core.behind else None


def episodes_of(trace: Trace, count: int) -> list[Trace]:
    """The trace cut at the episodes' starts."""
    marks = trace["bits"] >> EPISODE & 15
    cuts = np.flatnonzero(np.diff(marks.astype(np.int64))) + 1
    parts = np.split(trace, cuts)
    return parts[:count]


def soak(
    core: Core,
    seed: int,
    numbers: Sequence[int],
    simulator: str,
    *,
    rtl: Path = RTL,
    keep: Path | None = None,
) -> Report:
    """Play episodes in one simulation and compare them, up to the first that fails.

    rtl: another copy of rtl/. keep: a folder for the files, which else go.
    """
    report = Report()
    with tempfile.TemporaryDirectory(prefix="soak-") as scratch:
        folder = keep or Path(scratch)
        begun = time.monotonic()
        trace = play(core, seed, [FIRST, *numbers], simulator, folder, rtl)
        report.simulated = time.monotonic() - begun
    first, *parts = episodes_of(trace, len(numbers) + 1)
    behind = behind_of(core, first)
    if behind is None:
        report.failures[numbers[0]] = "a plain frame after the reset has no result in time"
        return report
    for number, part in zip(numbers, parts, strict=True):
        totals = Totals()
        wrong = compare(core, part, totals, behind)
        report.totals.add(totals)
        if wrong:
            report.failures[number] = wrong
            break
    report.compared = time.monotonic() - begun - report.simulated
    return report


# ----------------------------------------------------------------------------------------------- command line


def command(core: Core, seed: int, number: int, simulator: str) -> str:
    """What repeats an episode."""
    return f"make soak CORE={core.top} SIMULATOR={simulator} SEED={seed} EPISODE={number}"


def closing(totals: Totals, seconds: float) -> str:
    """Everything that was done, in one line."""
    flags = ", ".join(f"{name} {count}" for name, count in sorted(totals.flags.items())) or "none"
    hit = ", ".join(f"{place} {count}" for place, count in sorted(totals.resets_in.items())) or "none"
    return (
        f"{totals.episodes} episodes, {totals.frames} frames ({totals.solved} solved to the end, "
        f"{totals.dropped} more dropped before), {totals.beats} beats by stream, {totals.pushes} by push; "
        f"flags: {flags}; resets: {totals.soft_resets} soft, {totals.hard_resets} hard ({hit}); "
        f"bus: {totals.reads} reads, {totals.writes} writes, {totals.refused_accesses} of them refused, "
        f"{totals.words} result words compared; {totals.cycles} clocks in {seconds:.0f} s"
    )


def batches(cores: Sequence[Core], simulator: str) -> Iterator[tuple[Core, range]]:
    """Episodes of each core in turn, for ever."""
    size = BATCH[simulator]
    for first in count(0, size):
        for core in cores:
            yield core, range(first, first + size)


def run(cores: Sequence[Core], seed: int, simulator: str, seconds: float, jobs: int) -> bool:
    """Soak until the time is over or an episode fails; prints what was found. Returns whether all is well."""
    begun = time.monotonic()
    totals = {core.top: Totals() for core in cores}
    well = True
    todo = batches(cores, simulator)
    with ProcessPoolExecutor(jobs) as pool:
        running: dict[Future[Report], Core] = {}
        submitted = 0
        while True:
            while (
                well
                and len(running) < jobs
                and (time.monotonic() - begun < seconds or submitted < len(cores))
            ):
                core, numbers = next(todo)
                running[pool.submit(soak, core, seed, numbers, simulator)] = core
                submitted += 1
            if not running:
                break
            done, _ = wait(running, return_when=FIRST_COMPLETED)
            for future in done:
                core = running.pop(future)
                report = future.result()
                totals[core.top].add(report.totals)
                well &= tell(core, seed, simulator, report)
    for core in cores:
        print(f"{core.top}: seed {seed}: {closing(totals[core.top], time.monotonic() - begun)}")
    return well


def tell(core: Core, seed: int, simulator: str, report: Report) -> bool:
    """Print what failed; returns whether nothing did."""
    for number, reason in report.failures.items():
        print(f"FAILED: {core.top} on {simulator}, seed {seed}, episode {number}: {reason}")
        print(f"  again: {command(core, seed, number, simulator)}", flush=True)
    return not report.failures


def main(arguments: Sequence[str] | None = None) -> int:
    """The command line; the exit code."""
    parser = argparse.ArgumentParser(prog="make soak", description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--minutes", type=float, default=10.0, help="about how long (10)")
    parser.add_argument("--seed", type=int, help="of everything; by default a new one, which is printed")
    parser.add_argument("--core", choices=[*CORES, "both"], default="both")
    parser.add_argument("--simulator", choices=SIMULATORS, default="verilator")
    parser.add_argument("--episode", type=int, help="only this one, again")
    parser.add_argument("--jobs", type=int, default=2, help="simulations at a time (2)")
    options = parser.parse_args(arguments)
    cores = [core for core in CORES.values() if options.core in (core.top, "both")]
    seed = random.SystemRandom().getrandbits(32) if options.seed is None else options.seed
    print(f"soak: seed {seed}, {' and '.join(core.top for core in cores)} on {options.simulator}", flush=True)
    try:
        if options.episode is None:
            well = run(cores, seed, options.simulator, 60 * options.minutes, max(options.jobs, 1))
        else:
            well = True
            for core in cores:
                keep = ROOT / "out" / "soak" / f"{core.top}-{seed}-{options.episode}"
                report = soak(core, seed, [options.episode], options.simulator, keep=keep)
                well &= tell(core, seed, options.simulator, report)
                print(
                    f"{core.top}: {closing(report.totals, report.simulated)}; files: {keep.relative_to(ROOT)}"
                )
    except (SimulatorMissing, SimulationFailed) as error:
        print(f"soak: {error}", file=sys.stderr)
        return 1
    return 0 if well else 1


if __name__ == "__main__":
    sys.exit(main())
