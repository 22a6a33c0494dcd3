# SPDX-License-Identifier: Apache-2.0
"""One flight solved every way: core, bit-exact model, double, exact, the paper's arithmetic, truth."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from . import exact, golden, paper_fixed
from .attitude import cayley
from .exact import ExactPose
from .frames import Frame
from .ivisnav.result import RatesResult
from .quantise import quantise
from .result import PoseResult
from .sensor.flight import Flight

Array = NDArray[np.float64]
AnyResult = TypeVar("AnyResult", PoseResult, RatesResult)

# q of the core is binary32 (half an ulp is 6e-8); its 35-bit mantissas add 5 to 8 kappa 2^-35, as measured.
BOUND = 1e-7
BOUND_KAPPA = 30.0
GROWTH = 8.0 * 2.0**-35


@dataclass(frozen=True, eq=False)
class PaperRun:
    """The paper's arithmetic at one scaling of the whole flight.

    Args:
        label: how alpha was chosen. alpha: of Eq. 26, 1/m; beta of Eq. 27 is the same.
        q, t: (n, 3), NaN where det M = 0.
    """

    label: str
    alpha: float
    q: Array
    t: Array


@dataclass(frozen=True, eq=False)
class Solutions:
    """Results in the order of the flight's pairs.

    Args:
        backend: what computed ``core``. model: the bit-exact model's. double: golden model's.
        exact: of the quantised input. paper: the paper's Q15.16 pipeline at several scalings, best first.
    """

    flight: Flight
    backend: str
    core: list[PoseResult]
    model: list[PoseResult]
    double: list[PoseResult]
    exact: list[ExactPose]
    paper: list[PaperRun]

    @property
    def true_q(self) -> Array:
        """(n, 3)."""
        return np.array([pair.q for pair in self.flight.pairs])

    @property
    def true_t(self) -> Array:
        """(n, 3) m."""
        return np.array([pair.t for pair in self.flight.pairs])

    @property
    def kappa(self) -> Array:
        """(n,) condition of M."""
        return np.array([pose.kappa for pose in self.exact])

    @property
    def numerical_error(self) -> Array:
        """(n,) |q - exact| / |exact| of the core; infinite where the core gave no q."""
        exact = np.array([[float(x) for x in pose.q or (np.nan,) * 3] for pose in self.exact])
        error = np.linalg.norm(stacked(self.core, "q") - exact, axis=1) / np.linalg.norm(exact, axis=1)
        return np.where(np.isfinite(error), error, np.inf)

    @property
    def numerical_bound(self) -> Array:
        """(n,) what ``numerical_error`` must stay within: 1e-7 for kappa < 30, growing with kappa beyond."""
        return np.where(self.kappa < BOUND_KAPPA, BOUND, BOUND + GROWTH * self.kappa)

    @property
    def bound_broken(self) -> list[str | int]:
        """Names of the frames beyond the bound."""
        bad = ~(self.numerical_error <= self.numerical_bound)
        return [result.frame for result, broken in zip(self.core, bad, strict=True) if broken]

    @property
    def bit_exact(self) -> bool:
        """Whether the backend is one that has to agree with the model to the bit."""
        return self.backend != "double"

    @property
    def differences(self) -> list[str]:
        """``frame N: field`` for everything in which core and model differ; empty for a double backend."""
        if not self.bit_exact:
            return []
        return [
            f"frame {core.frame}: {name}"
            for core, model in zip(self.core, self.model, strict=True)
            for name in differing_fields(core, model)
        ]

    def errors(self, field: str) -> tuple[Array, Array]:
        """Errors (n, 3) of the core's ``q`` or ``t`` against truth, and their standard deviations (n, 3)."""
        truth = self.true_q if field == "q" else self.true_t
        return stacked(self.core, field) - truth, sigmas(self.core, field)

    def share_inside(self, field: str) -> Array:
        """(3,) share of frames whose error lies within 3 sigma."""
        error, sigma = self.errors(field)
        share: Array = (np.abs(error) <= 3.0 * sigma).mean(axis=0)
        return share


def exact_poses(frames: Sequence[Frame], forbid_turns: bool = False) -> list[ExactPose]:
    """The exact solutions of the quantised frames."""
    return [exact.solve(quantise(frame), forbid_turns=forbid_turns) for frame in frames]


def paper_runs(frames: Sequence[Frame]) -> list[PaperRun]:
    """The paper's Q15.16 pipeline with one alpha = beta for the whole flight.

    The largest power of two at which no frame overflows, and a quarter of it: the paper calls its own choice
    arbitrary and reports up to 7 %.
    """
    limit = min(paper_fixed.overflow_limit(frame.a, frame.b, frame.w) for frame in frames)
    best = float(2.0 ** np.floor(np.log2(limit)))
    return [
        _paper_run("largest scale without overflow", frames, best),
        _paper_run("a quarter of that scale", frames, best / 4.0),
    ]


def _paper_run(label: str, frames: Sequence[Frame], alpha: float) -> PaperRun:
    q, t = np.full((len(frames), 3), np.nan), np.full((len(frames), 3), np.nan)
    for k, frame in enumerate(frames):
        solved = paper_fixed.solve(frame.a, frame.b, frame.w, alpha, alpha).q
        if solved is not None:
            weights = np.ones(len(frame.a)) if frame.w is None else frame.w
            a_bar, b_bar = golden.centroids(frame.a, frame.b, weights)
            q[k] = solved
            t[k] = golden.translation(a_bar, b_bar, cayley(solved))  # Eq. 12, in software as there
    return PaperRun(label, alpha, q, t)


def differing_fields(core: AnyResult, model: AnyResult) -> list[str]:
    """Names of the fields that are not the same to the last bit (cycles apart: a model has no clock)."""
    names = [field.name for field in fields(core) if field.name not in ("frame", "cycles")]
    return [name for name in names if not _same(getattr(core, name), getattr(model, name))]


def _same(one: object, other: object) -> bool:
    if one is None or other is None:
        return one is other
    if isinstance(one, str | tuple):
        return one == other
    return np.array_equal(np.asarray(one), np.asarray(other), equal_nan=True)


def stacked(results: Sequence[PoseResult], field: str) -> Array:
    """A vector field of all results (n, 3), NaN where a frame has none."""
    missing = np.full(3, np.nan)
    return np.array([missing if getattr(r, field) is None else getattr(r, field) for r in results])


def sigmas(results: Sequence[PoseResult], field: str) -> Array:
    """Standard deviations (n, 3) of ``q`` or ``t``, NaN where a frame has none."""
    missing = np.full(3, np.nan)
    covariances = [getattr(result, f"{field}_cov") for result in results]
    return np.array([missing if c is None else np.sqrt(np.maximum(np.diag(c), 0.0)) for c in covariances])


def relative_percent(values: Array, reference: Array) -> Array:
    """|values - reference| / |reference| in percent, component by component."""
    with np.errstate(divide="ignore", invalid="ignore"):
        percent: Array = 100.0 * np.abs(values - reference) / np.abs(reference)
    return percent
