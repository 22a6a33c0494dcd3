# SPDX-License-Identifier: Apache-2.0
"""Search for the frame with the largest error of q: hill climbing on the integers of small frames.

    python -m bench.hill_climb [--seed S] [--evaluations N] [--near Q]

Restarts from the families of `clouds`; keeps kappa(M) < 30 and |q| < Q; prints every new worst frame. Not in
`make bench`: it only ever finds a lower bound of the worst, the longer the better.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.random import Generator
from relnav.model.core import OltaeCore
from relnav.model.raw import CoreConfig
from relnav.quantise import INPUT_MAX, INPUT_MIN, QuantisedFrame

from bench.accuracy import BOUND, BOUND_KAPPA, NEAR
from bench.clouds import Case, make_case
from bench.measure import Errors, measure

START = ("round", "shapes", "planar", "rods", "tiny angles", "residual 120", "turn boundary", "unrelated")
MOST_POINTS, PATIENCE = 6, 30


def value(errors: Errors, near: float) -> float:
    """What is climbed: the error of q, -1 out of bounds."""
    inside = errors.q is not None and errors.kappa < BOUND_KAPPA and (errors.size or 0.0) < near
    return errors.q if inside and errors.q is not None else -1.0


def neighbour(rng: Generator, frame: QuantisedFrame) -> QuantisedFrame:
    """One to three components moved by 1 to 2^30, small moves more often."""
    a, b = frame.a.copy(), frame.b.copy()
    for _ in range(rng.integers(1, 4)):
        points = a if rng.random() < 0.5 else b
        place = rng.integers(len(points)), rng.integers(3)
        moved = int(points[place]) + int(rng.choice([-1, 1])) * int(2 ** rng.uniform(0, rng.uniform(1, 30)))
        points[place] = min(max(moved, INPUT_MIN), INPUT_MAX)
    return replace(frame, a=a, b=b)


def climb(core: OltaeCore, rng: Generator, evaluations: int, near: float) -> tuple[Errors | None, int]:
    """The worst frame found; how many evaluations were over the bound."""
    worst: Errors | None = None
    over = 0
    while evaluations > 0:
        family = START[rng.integers(len(START))]
        case = make_case(family, int(rng.integers(1 << 30)))
        if case.frame.n > MOST_POINTS:
            continue
        case = Case(family, case.number, replace(case.frame, frac=0), CoreConfig(covariance=False))
        errors, stuck = measure(core, case), 0
        evaluations -= 1
        while value(errors, near) >= 0 and stuck < PATIENCE and evaluations > 0:
            tried = replace(case, frame=neighbour(rng, case.frame))
            found = measure(core, tried)
            evaluations -= 1
            over += value(found, near) > BOUND
            better = value(found, near) > value(errors, near)
            stuck = 0 if better else stuck + 1
            if better:
                case, errors = tried, found
        if worst is None or value(errors, near) > value(worst, near):
            worst = errors
            print(f"{errors.q}, kappa {errors.kappa:.3g}, |q| {errors.size}, from {family} #{case.number}:")
            weights = None if case.frame.w is None else case.frame.w.tolist()
            print(f"  a = {case.frame.a.tolist()}, b = {case.frame.b.tolist()}, w = {weights}", flush=True)
    return worst, over


def main(arguments: Sequence[str] | None = None) -> int:
    """Climb; 1 where the bound broke."""
    parser = argparse.ArgumentParser(description="hill climbing for the worst error of q")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--evaluations", type=int, default=100_000)
    parser.add_argument("--near", type=float, default=NEAR, help="largest |q|")
    options = parser.parse_args(arguments)
    _, over = climb(OltaeCore(), np.random.default_rng(options.seed), options.evaluations, options.near)
    print(f"{over} frames over {BOUND:g}")
    return 1 if over else 0


if __name__ == "__main__":
    sys.exit(main())
