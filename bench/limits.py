# SPDX-License-Identifier: Apache-2.0
"""Where RANK_DEFICIENT and ILL_CONDITIONED rise, in the bit-exact model, the golden model and exactly.

    python -m bench.limits [--quick]

The core compares det M, in its own rounding, with 2^(RANK_BITS - 34) P^3 and 2^(ILL_BITS - 34) P^3, P being
the power of two at or below the largest T_i = W (sum w (a_i - mean)^2 + sum w (b_i - mean)^2), i = x, y, z.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.random import Generator
from relnav import exact, golden
from relnav.attitude import FloatArray
from relnav.model.core import OltaeCore
from relnav.model.raw import CoreConfig
from relnav.quantise import QuantisedFrame

from bench.clouds import Clouds, cloud, fit, placed, turned
from bench.common import JOBS, number, spread_out, table, write_results

FLAGS = ("ILL_CONDITIONED", "RANK_DEFICIENT")
CASES, QUICK = 4000, 100
BATCH = 50


@dataclass(frozen=True)
class Limit:
    """One frame: exact kappa, log2(det M / P^3), flags of both models (see `level`)."""

    shape: str
    kappa: float
    ratio: float
    core: int
    golden: int


def rods(rng: Generator) -> Clouds:
    """One axis up to 2^16 times longer than the others, any angle."""
    thin = 2.0 ** -rng.uniform(3, 16)
    a = cloud(rng, int(rng.integers(3, 30)), np.array([1.0, thin, thin * 2.0 ** -rng.uniform(0, 8)]))
    return placed(rng, a, turned(rng, rng.uniform(0, np.pi)), 2.0**29, 0.0, False)


def half_turns(rng: Generator) -> Clouds:
    """Round, turned by nearly 180 degrees; turns are forbidden."""
    a = cloud(rng, int(rng.integers(3, 30)), np.ones(3))
    return placed(rng, a, turned(rng, np.pi - 10.0 ** rng.uniform(-5, -0.5)), 2.0**29, 0.0, False)


SHAPES: dict[str, Callable[[Generator], Clouds]] = {"rod": rods, "180 degrees, turns forbidden": half_turns}

Batch = tuple[str, int, int]


def level(flags: Sequence[str]) -> int:
    """0 none, 1 ILL_CONDITIONED, 2 RANK_DEFICIENT."""
    return 2 if FLAGS[1] in flags else 1 if FLAGS[0] in flags else 0


def measure(core: OltaeCore, shape: str, case: int) -> Limit | None:
    """One frame; None where det M is exactly zero."""
    a, b = SHAPES[shape](np.random.default_rng([len(shape), case]))
    frame = QuantisedFrame(fit(a), fit(b), None, 30)
    forbid = shape != "rod"
    raw = core.run(frame, CoreConfig(forbid_turns=forbid))
    m = exact.exact_moments(frame)
    try:
        truth = exact.solve(frame, forbid_turns=forbid)
    except exact.Singular:
        return None
    determinant = exact.determinant(exact.matrix_hat(m.turned(exact.turn_matrix(truth.turn))))
    power = 1 << (int(max(m.saa[i][i] + m.sbb[i][i] for i in range(3))).bit_length() - 1)
    ratio = float(Fraction(determinant, power**3))
    values: tuple[FloatArray, FloatArray] = frame.values()
    double = golden.estimate(*values, forbid_turns=forbid)
    return Limit(
        shape,
        truth.kappa,
        float(np.log2(ratio)) if ratio > 0 else -np.inf,
        level(raw.flag_names),
        level(double.flags),
    )


def run_batch(batch: Batch) -> list[Limit]:
    """Cases first..last - 1 of a shape."""
    shape, first, last = batch
    core = OltaeCore()
    return [found for k in range(first, last) if (found := measure(core, shape, k)) is not None]


def report(limits: Sequence[Limit]) -> dict[str, Any]:
    """By shape and flag: where it begins and where it is certain, in kappa and in log2(det M / P^3)."""
    found: dict[str, Any] = {}
    for shape in SHAPES:
        cases = [limit for limit in limits if limit.shape == shape]
        rows = {}
        for grade, flag in enumerate(FLAGS, start=1):
            on = [c for c in cases if c.core >= grade]
            off = [c for c in cases if c.core < grade]
            rows[flag] = {
                "least_kappa_with": min((c.kappa for c in on), default=None),
                "largest_kappa_without": max((c.kappa for c in off), default=None),
                "largest_log2_ratio_with": max((c.ratio for c in on), default=None),
                "least_log2_ratio_without": min((c.ratio for c in off), default=None),
            }
        differing = sum(c.core != c.golden for c in cases)
        found[shape] = {"cases": len(cases), "golden_differs": differing, "flags": rows}
    return found


def run(cases: int = CASES, processes: int = JOBS) -> dict[str, Any]:
    """Measure."""
    each = max(1, cases // len(SHAPES))
    jobs = [(shape, k, min(k + BATCH, each)) for shape in SHAPES for k in range(0, each, BATCH)]
    work: Callable[[Batch], list[Limit]] = run_batch
    return report([limit for batch in spread_out(work, jobs, "flags", processes) for limit in batch])


def text(found: dict[str, Any]) -> str:
    """The table."""
    rows = []
    for shape, part in found.items():
        for flag, row in part["flags"].items():
            rows.append(
                [
                    shape,
                    flag,
                    number(row["least_kappa_with"]),
                    number(row["largest_kappa_without"]),
                    number(row["largest_log2_ratio_with"], ".3f"),
                    number(row["least_log2_ratio_without"], ".3f"),
                    f"{part['golden_differs']} of {part['cases']}",
                ]
            )
    header = ["cloud", "flag", "kappa from", "kappa to", "log2 det/P^3 up to", "down to", "golden differs"]
    return "flags by condition (from: least kappa with the flag; to: largest without):\n" + table(
        header, rows
    )


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure, print, keep."""
    parser = argparse.ArgumentParser(description="condition numbers at which the core's flags rise")
    parser.add_argument("--quick", action="store_true", help=f"{QUICK} cases, nothing kept")
    parser.add_argument("--jobs", type=int, default=JOBS, help="processes")
    options = parser.parse_args(arguments)
    found = run(QUICK if options.quick else CASES, options.jobs)
    print(text(found))
    if not options.quick:
        write_results("limits", found)
    return 0


if __name__ == "__main__":
    sys.exit(main())
