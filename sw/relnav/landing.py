# SPDX-License-Identifier: Apache-2.0
"""The paper's landing, end to end: terrain, sensors, matched points, poses, report."""

from __future__ import annotations

import sys
from collections.abc import Callable, Sequence
from pathlib import Path

from tqdm import tqdm

from .backends import SIMULATORS, check_backend, installed_simulator, solve
from .checkout import ROOT, build_folder
from .comparison import Solutions, exact_poses, paper_runs
from .errors import BackendError
from .frames import Frame
from .model.raw import CoreConfig
from .report import FIGURES, write_report
from .report.files import make_folder, progress, refuse_file
from .report.key_table import key_table
from .report.page import solver_name, verdict
from .report.summary import passed
from .report.timing import time_solvers
from .result import PoseResult
from .sensor.flight import Flight, Simulator
from .sensor.terrain import load_terrain

Solver = Callable[[Sequence[Frame], str, CoreConfig, Path | None], list[PoseResult]]

WAVES = build_folder() / "waves"
TRACED = 2  # frames in the waveform, back to back
AREA = ROOT / "syn" / "results.json"
EXIT_DIFFERENT = 1


def run_landing(
    terrain: Path | None = None,
    frames: int = 25,
    backend: str | None = None,
    out: Path | None = None,
    images: str = "camera",
    rtl: Path | None = None,
    *,
    seed: int = 1,
    solver: Solver | None = None,
    quiet: bool = False,
) -> int:
    """Fly, solve, compare, report.

    Args:
        terrain: elevation grid (.npz); None for the one matplotlib carries. frames: exposures, one a second.
        backend: None for a simulator that is installed. out: folder of the report, default ``out``.
        images: "camera" or "bearing-angle". rtl: another copy of the RTL.
        seed: of every noise. solver: in place of ``backends.solve``, for tests. quiet: no progress bar.

    Returns:
        0; 1 when RTL and model differ or the numerical bound is broken (never for a 3-sigma exceedance).

    Raises:
        InputError, BackendError: one line; nothing has been written.
    """
    out = Path("out") if out is None else out
    backend = backend or installed_simulator()
    solver = solver or _solve
    check_backend(backend, rtl)
    refuse_file(out)
    simulator = Simulator(load_terrain(terrain), frames, images, seed)
    make_folder(out)  # before the flight, not after it
    kinds = list(dict.fromkeys([backend, "fixed", "double"]))
    with progress(frames + len(kinds) + 3 + FIGURES, quiet) as bar:
        flight = _fly(simulator, bar)
        solved = _solved(flight, backend, kinds, solver, rtl, bar)
        bar.set_description_str("timing software", refresh=False)
        timings = time_solvers([pair.frame for pair in flight.pairs])
        bar.update()
        bar.set_description_str("drawing", refresh=False)
        # without RTL there is no waveform of this run, and another run's would mislead
        waves = _waveform() if backend in SIMULATORS else out / "oltae_top.fst"
        rows = write_report(solved, timings, out, waves=waves, area=AREA, step=bar.update)
        bar.set_description_str("done")
    counts = f"{len(flight.exposures)} frames, {len(flight.pairs)} poses"
    print(key_table(f"Landing over {flight.terrain.name}: {counts} by {solver_name(backend)}", rows))
    for problem in solved.differences[:5]:
        print(f"  differs from the model: {problem}")
    print(f"\n{'PASS' if passed(solved) else 'FAIL'}: {verdict(solved)}\nReport: {out / 'report.html'}")
    return 0 if passed(solved) else EXIT_DIFFERENT


def _fly(simulator: Simulator, bar: tqdm[None]) -> Flight:
    flown = []
    for k, step in enumerate(simulator.fly()):
        bar.set_description_str(f"frame {k + 1}: scan, image, match", refresh=False)
        flown.append(step)
        bar.update()
    return simulator.collect(flown)


def _solved(
    flight: Flight, backend: str, kinds: Sequence[str], solver: Solver, rtl: Path | None, bar: tqdm[None]
) -> Solutions:
    frames = [pair.frame for pair in flight.pairs]
    # a and b are equally good, so the sum of their variances is twice one of them
    config = CoreConfig(variance=2.0 * flight.sigma**2)
    results: dict[str, list[PoseResult]] = {}
    for kind in kinds:
        bar.set_description_str(f"poses: {kind}", refresh=False)
        results[kind] = solver(frames, kind, config, rtl if kind == backend else None)
        bar.update()
    bar.set_description_str("poses: exact, Q15.16", refresh=False)
    core, model, double = results[backend], results["fixed"], results["double"]
    solved = Solutions(flight, backend, core, model, double, exact_poses(frames), paper_runs(frames))
    bar.update(2)
    return solved


def _solve(frames: Sequence[Frame], backend: str, config: CoreConfig, rtl: Path | None) -> list[PoseResult]:
    results = solve(frames, backend, config=config, rtl_dir=rtl)
    if backend in SIMULATORS:
        _trace(frames[-TRACED:], backend, config, rtl)
    return results


def _trace(frames: Sequence[Frame], backend: str, config: CoreConfig, rtl: Path | None) -> None:
    """Some frames again, for `make waves` and the report's Fig. 7: a waveform of all would take 100 MB."""
    try:
        solve(frames, backend, config=config, rtl_dir=rtl, waves=WAVES / "oltae_top.fst")
    except BackendError as error:  # a waveform is a picture, not a result
        tqdm.write(f"no waveform: {error}", file=sys.stderr)


def _waveform() -> Path:
    """The last waveform of the top: FST, or VCD where a simulator could not write FST."""
    paths = [WAVES / f"oltae_top.{kind}" for kind in ("fst", "vcd")]
    return max(filter(Path.is_file, paths), key=lambda path: path.stat().st_mtime, default=paths[0])
