# SPDX-License-Identifier: Apache-2.0
"""What the benchmarks share: two processes with a progress bar, the results file, tables."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any, TypeVar

from tqdm import tqdm

RESULTS = Path(__file__).resolve().parent / "results.json"
JOBS = 2

Job = TypeVar("Job")
Result = TypeVar("Result")


def spread_out(
    work: Callable[[Job], Result], jobs: Sequence[Job], title: str, processes: int = JOBS
) -> list[Result]:
    """work(job) of every job, in order, a bar meanwhile; in this process where one is asked for."""
    bar = tqdm(total=len(jobs), desc=title, unit="batch", disable=None)
    found: list[Result] = []

    def take(results: Iterable[Result]) -> list[Result]:
        for result in results:
            found.append(result)
            bar.update()
        return found

    with bar:
        if processes <= 1:
            return take(map(work, jobs))
        os.environ.setdefault("OMP_NUM_THREADS", "1")  # numpy's 3 x 3 matrices gain nothing from threads
        with ProcessPoolExecutor(processes) as pool:
            return take(pool.map(work, jobs))


def write_results(part: str, content: dict[str, Any], path: Path = RESULTS) -> None:
    """Replace one part of the results file."""
    results: dict[str, Any] = json.loads(path.read_text()) if path.is_file() else {}
    results[part] = content
    path.write_text(json.dumps(results, indent=1) + "\n")


def table(header: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """Columns, the first one to the left."""
    lines = [list(header), *(list(row) for row in rows)]
    widths = [max(len(line[i]) for line in lines) for i in range(len(header))]
    return "\n".join(
        "  ".join(
            cell.rjust(w) if i else cell.ljust(w)
            for i, (cell, w) in enumerate(zip(line, widths, strict=True))
        )
        for line in lines
    )


def number(value: float | None, form: str = ".1e") -> str:
    """A number for a table; a dash where there is none."""
    return "-" if value is None else format(value, form)
