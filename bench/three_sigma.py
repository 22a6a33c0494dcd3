# SPDX-License-Identifier: Apache-2.0
"""Do the core's own 3-sigma bounds hold? Random trials of the bit-exact model with VARIANCE given.

    python -m bench.three_sigma [--quick] [--trials N]

A trial: a new cloud of 6 to 40 points, its axis, offset and weights new too; Gaussian noise of variance
s^2 / w on both clouds, s 1e-4 to 3e-3 of the extent; quantised to 32 bits; errors against the true pose.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from time import perf_counter
from typing import Any

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray
from relnav.attitude import FloatArray, rotation_of
from relnav.frames import make_frame
from relnav.model.core import OltaeCore
from relnav.model.raw import CoreConfig, raw_to_pose
from relnav.quantise import quantise

from bench.common import JOBS, spread_out, table, write_results

ANGLES = ((1.0, False), (60.0, False), (120.0, False), (120.0, True))  # degrees, re-application
TRIALS, QUICK = 20000, 100
BATCH = 250
SHARE, TOLERANCE = 0.997, 0.003
AXES = ("q1", "q2", "q3", "t1", "t2", "t3")

Batch = tuple[float, bool, int, int]


def trial(core: OltaeCore, rng: Generator, degrees: float, reapply: bool) -> FloatArray | None:
    """Errors over predicted standard deviations, q then t (6,); None where the frame was flagged."""
    n = int(rng.integers(6, 41))
    a = rng.normal(size=(n, 3)) * 2.0 ** -rng.uniform(0, 2, 3) + rng.normal(size=3)
    axis, half = rng.normal(size=3), np.radians(degrees) / 2
    q = axis / np.linalg.norm(axis) * np.tan(half)
    rotation, t = rotation_of(1.0, q), rng.normal(size=3)
    w = 2.0 ** rng.uniform(0, 8, n).round() if rng.random() < 0.5 else np.ones(n)
    s = 10.0 ** rng.uniform(-4, -2.5)
    sigma_a, sigma_b = s * np.cos(k := rng.uniform(0, np.pi / 2)), s * np.sin(k)
    spread = 1.0 / np.sqrt(w)[:, None]
    first = a + sigma_a * spread * rng.normal(size=a.shape)
    second = a @ rotation.T + t + sigma_b * spread * rng.normal(size=a.shape)
    frame = quantise(make_frame(first, second, None if np.all(w == 1) else w))
    config = CoreConfig(variance=float(s**2), reapply=reapply)
    pose = raw_to_pose(core.run(frame, config), 0, frame)
    if pose.q is None or pose.t is None or pose.q_cov is None or pose.t_cov is None:
        return None
    sigmas = np.sqrt(np.concatenate([np.diag(pose.q_cov), np.diag(pose.t_cov)]))
    return np.asarray(np.concatenate([pose.q - q, pose.t - t]) / sigmas, dtype=np.float64)


def run_batch(batch: Batch) -> tuple[NDArray[np.int64], FloatArray, int, int]:
    """(components inside 3 sigma (6,), sum of squares (6,), trials, trials without a result)."""
    degrees, reapply, number, trials = batch
    core = OltaeCore()
    rng = np.random.default_rng([int(degrees), int(reapply), number])
    found = [trial(core, rng, degrees, reapply) for _ in range(trials)]
    errors = np.array([errors for errors in found if errors is not None])
    inside = np.asarray((np.abs(errors) <= 3.0).sum(axis=0), dtype=np.int64)
    return inside, np.asarray((errors**2).sum(axis=0), dtype=np.float64), len(errors), trials - len(errors)


def run(trials: int = TRIALS, processes: int = JOBS) -> dict[str, Any]:
    """Shares inside 3 sigma by component and ratio of the errors' rms to the predicted one."""
    started = perf_counter()
    size = min(BATCH, trials)
    jobs = [
        (degrees, reapply, number, size)
        for degrees, reapply in ANGLES
        for number in range((trials + size - 1) // size)
    ]
    work: Callable[[Batch], tuple[NDArray[np.int64], FloatArray, int, int]] = run_batch
    done = spread_out(work, jobs, "3 sigma", processes)
    rows = []
    for degrees, reapply in ANGLES:
        parts = [part for job, part in zip(jobs, done, strict=True) if job[:2] == (degrees, reapply)]
        total = sum(part[2] for part in parts)
        inside = np.sum([part[0] for part in parts], axis=0) / total
        rms = np.sqrt(np.sum([part[1] for part in parts], axis=0) / total)
        rows.append(
            {
                "degrees": degrees,
                "reapplied": reapply,
                "trials": total,
                "without_result": sum(part[3] for part in parts),
                "inside": dict(zip(AXES, inside.round(6).tolist(), strict=True)),
                "rms_over_sigma": dict(zip(AXES, rms.round(4).tolist(), strict=True)),
                "holds": bool(np.all(np.abs(inside - SHARE) <= TOLERANCE)),
            }
        )
    return {
        "share": SHARE,
        "tolerance": TOLERANCE,
        "angles": rows,
        "seconds": round(perf_counter() - started, 1),
    }


def text(found: dict[str, Any]) -> str:
    """The table."""
    rows = []
    for row in found["angles"]:
        name = f"{row['degrees']:g}" + (", re-applied" if row["reapplied"] else "")
        shares = [f"{100 * row['inside'][axis]:.2f}" for axis in AXES]
        ratios = list(row["rms_over_sigma"].values())
        rows.append(
            [
                name,
                str(row["trials"]),
                *shares,
                f"{min(ratios):.3f}-{max(ratios):.3f}",
                "yes" if row["holds"] else "NO",
            ]
        )
    header = ["degrees", "trials", *AXES, "rms / sigma", "99.7 +- 0.3"]
    return "errors inside the core's own 3 sigma, per cent:\n" + table(header, rows)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run, print, keep; 1 where a component is outside."""
    parser = argparse.ArgumentParser(description="3-sigma bounds of the bit-exact model")
    parser.add_argument("--quick", action="store_true", help=f"{QUICK} trials an angle, nothing kept")
    parser.add_argument("--trials", type=int, help=f"trials an angle (default {TRIALS})")
    parser.add_argument("--jobs", type=int, default=JOBS, help="processes")
    options = parser.parse_args(arguments)
    found = run(options.trials or (QUICK if options.quick else TRIALS), options.jobs)
    print(text(found))
    if not options.quick:
        write_results("three_sigma", found)
    return 0 if options.quick or all(row["holds"] for row in found["angles"]) else 1


if __name__ == "__main__":
    sys.exit(main())
