# SPDX-License-Identifier: Apache-2.0
"""Frames through the real RTL: builds a core's top under a simulator and runs the driver on it.

It needs cocotb, a simulator, and the RTL: of the checkout that this package lies in, or of its wheel.
"""

from __future__ import annotations

import contextlib
import importlib
import io
import logging
import os
import re
import shutil
import sys
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from relnav.checkout import IS_CHECKOUT, ROOT, RTL, build_folder
from relnav.errors import BackendError
from relnav.ivisnav.quantise import QuantisedRows
from relnav.ivisnav.raw import RawRates
from relnav.model.raw import CoreConfig, RawResult
from relnav.quantise import QuantisedFrame

from . import job
from .cores import CORES

BENCH = "relnav.rtlsim.bench"
HARNESS = "core_harness"
# how Icarus and Verilator begin an error: FILE:LINE: ..., %Error[-CODE]: FILE:LINE:COLUMN: ...
_MESSAGE = re.compile(
    r"^(?:%Error(?:-\w+)?: )?(?P<file>/?[^\s:]+\.vh?):(?P<line>\d+):(?:\d+:)? ?(?:error: )?(?P<text>.*)$"
)


def run_frames(
    frames: Sequence[QuantisedFrame],
    simulator: str,
    rtl_dir: str | Path | None = None,
    config: CoreConfig | None = None,
    *,
    waves: Path | None = None,
    feed: str = "stream",
    parameters: Mapping[str, int] | None = None,
    timeout: float = 3600.0,
) -> list[RawResult]:
    """The register words that oltae_top leaves for each frame; they run back to back, without a reset.

    simulator: "icarus" or "verilator". rtl_dir: another copy of rtl/. waves: where to leave the waveform
    (default: the environment's RELNAV_WAVES; the suffix becomes .vcd where FST cannot be written).
    feed: "stream" or "registers". parameters: of oltae_top, such as {"WEIGHTED": 0}. timeout: seconds.
    Raises BackendError: simulator missing, RTL that does not compile, a core that gives no result.
    """
    options = asdict(config or CoreConfig())
    return _run("oltae", frames, options, simulator, rtl_dir, waves, feed, parameters or {}, timeout)


def run_rate_frames(
    rows: Sequence[QuantisedRows],
    simulator: str,
    *,
    variance: float = 0.0,
    rtl_dir: str | Path | None = None,
    waves: Path | None = None,
    feed: str = "stream",
    timeout: float = 3600.0,
) -> list[RawRates]:
    """The register words that ivisnav_top leaves for each frame; as `run_frames`.

    variance: of y at the user's unit weight, 0: the core takes it from the residuals.
    """
    return _run("ivisnav", rows, {"variance": variance}, simulator, rtl_dir, waves, feed, {}, timeout)


def _run(
    core: str,
    frames: Sequence[Any],
    options: Mapping[str, Any],
    simulator: str,
    rtl_dir: str | Path | None,
    waves: Path | None,
    feed: str,
    parameters: Mapping[str, int],
    timeout: float,
) -> list[Any]:
    if not frames:
        return []
    runner = _runner()
    rtl = RTL if rtl_dir is None else Path(rtl_dir)
    top = CORES[core].top
    sources = [*_sources(runner, rtl, top), ROOT / "sim" / f"{HARNESS}.v"]
    values = ", ".join(f".{name}({value})" for name, value in parameters.items())
    if waves is None and os.environ.get("RELNAV_WAVES"):
        waves = Path(os.environ["RELNAV_WAVES"])
    folder = Path(tempfile.mkdtemp(prefix="relnav-"))
    keep = False
    try:
        job.write(folder / job.JOB, core, frames, options, feed)
        with quiet():
            runner.build_and_test(
                HARNESS,
                sources,
                BENCH,
                simulator=simulator,
                defines={"RELNAV_TOP": top, "RELNAV_PARAMETERS": f"#({values})" if values else ""},
                waves=waves or False,
                includes=[rtl / "include"],
                env={"RELNAV_JOB": str(folder)},
                folder=folder / "run",
                timeout=timeout,
                public=False,
            )
        return job.read_results(folder / job.RESULTS, core)
    except runner.SimulatorMissing as error:
        raise BackendError(error) from None
    except runner.SimulationFailed as error:
        if reason := job.read_failure(folder / job.RESULTS):
            raise BackendError(f"{simulator}: {reason}") from None
        if error.build_log is not None:
            found = _compiler_message(error.build_log.read_text(errors="replace"), rtl)
            raise BackendError(f"{simulator} cannot compile the RTL: {found}") from None
        keep = True  # the log is all there is to go by
        first = str(error).partition("\n")[0]
        raise BackendError(f"{first} (log: {folder / 'run' / 'sim.log'})") from None
    except ValueError as error:
        raise BackendError(f"{simulator}: {error}") from None
    finally:
        if not keep:
            shutil.rmtree(folder, ignore_errors=True)


def _runner() -> Any:
    """sim.runner of the checkout or of the wheel."""
    if not (ROOT / "sim" / f"{HARNESS}.v").is_file():
        raise BackendError(f"this installation of relnav has no RTL to simulate: {ROOT} holds none")
    if str(ROOT) not in sys.path:
        sys.path.append(str(ROOT))
    if not IS_CHECKOUT:  # and sim.runner would build beside the package
        os.environ.setdefault("RELNAV_BUILD", str(build_folder()))
    try:
        return importlib.import_module("sim.runner")
    except ImportError as error:
        raise BackendError(
            "the simulation needs more packages (make setup, or pip install '.[sim]' in the checkout): "
            f"{error}"
        ) from None


def _sources(runner: Any, rtl: Path, top: str) -> list[Path]:
    """Every Verilog file of a copy of rtl/."""
    if not rtl.is_dir():
        raise BackendError(f"{rtl}: no such RTL directory")
    sources: list[Path] = runner.sources(rtl_dir=rtl)
    if not any(file.stem == top for file in sources):
        raise BackendError(f"{rtl}: holds no {top}.v; a copy of rtl/ with its folders is needed")
    return sources


@contextlib.contextmanager
def quiet() -> Iterator[None]:
    """Nothing of the simulation on the terminal: its output is in the log."""
    before = logging.root.manager.disable
    logging.disable(logging.WARNING)
    try:
        with contextlib.redirect_stdout(io.StringIO()):
            yield
    finally:
        logging.disable(before)


def _compiler_message(log: str, rtl: Path) -> str:
    """The first error of a compiler's log, the file named as seen from the RTL directory."""
    lines = [line.strip() for line in log.splitlines() if "warning" not in line.lower()]
    first = next(filter(None, map(_MESSAGE.match, lines)), None)
    if first is None:
        return next((line for line in lines if "error" in line.lower()), "it says nothing")
    file = Path(first["file"]).resolve()
    shown = rtl / file.relative_to(rtl.resolve()) if file.is_relative_to(rtl.resolve()) else file
    return f"{shown}:{first['line']}: {first['text']}"
