# SPDX-License-Identifier: Apache-2.0
"""The measurements behind docs/decisions: each fills the block of its note. A minute or two, models only.

python scripts/decisions.py [NOTE ...]
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any
from unittest.mock import patch

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT), str(ROOT / "sw")]

from relnav import exact, golden  # noqa: E402 (the path is set above)
from relnav.attitude import FloatArray  # noqa: E402
from relnav.frames import make_frame  # noqa: E402
from relnav.model import assembler as asm  # noqa: E402
from relnav.model import core as core_module  # noqa: E402
from relnav.model import pose_program as pose  # noqa: E402
from relnav.model import schedule, solver  # noqa: E402
from relnav.model.core import OltaeCore  # noqa: E402
from relnav.model.lane import ZERO, DotLane  # noqa: E402
from relnav.model.raw import CoreConfig, RawResult, word_to_float  # noqa: E402
from relnav.model.reciprocal import reciprocal  # noqa: E402
from relnav.model.rom import scheduled  # noqa: E402
from relnav.quantise import QuantisedFrame, quantise  # noqa: E402

from scripts import ivisnav_notes  # noqa: E402
from scripts.marked import fill, table  # noqa: E402

Table = list[tuple[str, ...]]
NOTES = ROOT / "docs" / "decisions"


# ---- clouds and errors


def rotation(rng: np.random.Generator, degrees: float) -> FloatArray:
    """About a random axis."""
    axis = rng.normal(size=3)
    x, y, z = axis / np.linalg.norm(axis)
    cross, angle = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]]), np.radians(degrees)
    return np.asarray(np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross)


def frame(
    rng: np.random.Generator, degrees: float, shape: tuple[float, ...], noise: float, n: int = 40
) -> QuantisedFrame:
    """Points of the given rms along three random axes, turned and moved; noise relative to the longest."""
    a = rng.normal(size=(n, 3)) * np.array(shape) @ rotation(rng, rng.uniform(0, 180)).T
    b = a @ rotation(rng, degrees).T + rng.normal(size=3)
    return quantise(make_frame(a + noise * rng.normal(size=a.shape), b + noise * rng.normal(size=a.shape)))


def floats(words: tuple[int, ...]) -> FloatArray:
    """Binary32 words as numbers."""
    return np.array([word_to_float(word) for word in words])


def q_error(raw: RawResult, truth: exact.ExactPose) -> float:
    """|dq| / |q|."""
    assert truth.q is not None
    expected = np.array([float(x) for x in truth.q])
    return float(np.linalg.norm(floats(raw.q) - expected) / np.linalg.norm(expected))


# ---- the notes


def conditioning() -> str:
    """Where the two flags rise, and the error below them."""
    rng = np.random.default_rng(1)
    rows: Table = []
    forbidden = CoreConfig(forbid_turns=True)

    def rod(e: float, ratio: float = 1.0) -> QuantisedFrame:
        return frame(rng, 40.0, (1.0, min(1.0, ratio * e), e), 0.0)

    def round_cloud(e: float) -> QuantisedFrame:
        return frame(rng, 180.0 - float(np.degrees(e)), (1.0, 1.0, 1.0), 0.0)

    cases: tuple[tuple[str, CoreConfig, Callable[[float], QuantisedFrame], tuple[float, float]], ...] = (
        ("rod, rms 1 : e : e", CoreConfig(), rod, (-17.0, 0.0)),
        ("rod, rms 1 : 10 e : e", CoreConfig(), lambda e: rod(e, 10.0), (-17.0, 0.0)),
        ("round, 180 degrees - e, turns forbidden", forbidden, round_cloud, (-17.0, 0.0)),
        ("flat, about its normal, 180 degrees - e, turns forbidden", forbidden, flat_turned, (-9.0, 0.0)),
    )
    for name, config, make, (low, high) in cases:
        found: list[tuple[float, float, tuple[str, ...], float]] = []
        for power in np.linspace(low, high, 80):
            item = make(2.0**power)
            raw = OltaeCore().run(item, config)
            try:
                truth = exact.solve(item, forbid_turns=config.forbid_turns)
            except exact.Singular:
                continue
            error = np.nan if raw.failed or truth.q is None else q_error(raw, truth)
            found.append((2.0**power, truth.kappa, raw.flag_names, error))
        # the largest e with each flag
        ill = max(f[:2] for f in found if "ILL_CONDITIONED" in f[2])
        rank = max(f[:2] for f in found if "RANK_DEFICIENT" in f[2])
        worst = max(f[3] for f in found if not {"ILL_CONDITIONED", "RANK_DEFICIENT"} & set(f[2]))
        flagged = max(f[3] for f in found if "ILL_CONDITIONED" in f[2])
        rows.append((name, at(ill), at(rank), f"{worst:.0e}", f"{flagged:.0e}"))
    head = (
        "cloud",
        "ILL_CONDITIONED from",
        "RANK_DEFICIENT from",
        "q, worst unflagged",
        "q, worst ILL_CONDITIONED",
    )
    return table(head, rows)


_PLANE = np.random.default_rng(5)


def flat_turned(e: float) -> QuantisedFrame:
    """A flat cloud turned about its normal, short of 180 degrees by e."""
    a = _PLANE.normal(size=(40, 3)) * np.array((1.0, 1.0, 1e-3))
    c, s = np.cos(np.pi - e), np.sin(np.pi - e)
    return quantise(make_frame(a, a @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]).T))


def at(where: tuple[float, float]) -> str:
    """e and the condition number there."""
    return f"e = {where[0]:.1e}, kappa = {where[1]:.1e}"


def wide_lane() -> str:
    """Relative error of rss with and without the low limbs and the wide lane."""
    rows: Table = []
    for noise in (1e-3, 1e-4, 1e-5, 1e-6, 1e-7):
        worst = []
        for limbs, wide in ((1, False), (2, False), (2, True)):
            errors, rng = [], np.random.default_rng(2)
            with residual_arithmetic(limbs, wide):
                for _ in range(25):
                    item = frame(rng, rng.uniform(1, 170), (1.0, 1.0, 1.0), noise, 100)
                    truth = exact.solve(item)
                    got = Fraction(word_to_float(OltaeCore().run(item, CoreConfig(covariance=False)).rss))
                    errors.append(float(abs(got - truth.rss) / truth.rss))
            worst.append(f"{max(errors):.0e}")
        rows.append((f"{noise:.0e}", *worst))
    return table(
        ("noise / rms of the cloud", "one limb, 48 bits", "two limbs, 48 bits", "two limbs, 76 bits (built)"),
        rows,
    )


@contextmanager
def residual_arithmetic(limbs: int, wide: bool) -> Iterator[None]:
    """The model with narrow lanes only, or with low limbs of zero."""
    items = OltaeCore.items

    def without_low(self: OltaeCore, *given: Any) -> Iterator[tuple[int, tuple[int, int], bool]]:
        for address, value, low in items(self, *given):
            yield address, (0, 0) if low else value, low

    with ExitStack() as changes:
        if not wide:
            changes.enter_context(patch.object(solver, "DotLane", lambda wide=False: DotLane()))
        if limbs == 1:
            changes.enter_context(patch.object(OltaeCore, "items", without_low))
        yield


def ends(dots: list[asm.Dot] | None = None) -> dict[str, int]:
    """Cycle of the last slot before q and before the pose, cycle 0 being the first item."""
    placed = schedule.Scheduler(pose.arrival(), pose.references()).run(dots or pose.program())
    return {dot.mark: dot.end for dot in placed if dot.mark}


def versus(now: dict[str, int], other: dict[str, int]) -> tuple[str, str]:
    """Cycles more or less."""
    return f"{other['q'] - now['q']:+d}", f"{other['pose'] - now['pose']:+d}"


def drain_order() -> str:
    """The pose program behind another order of the items."""
    now, usual = ends(), list(pose.arrival())
    by_slot = [pose.item(s, k) for s in range(3) for k in (0, 1, 6, 2, 3, 4, 5)]  # T E 2B F H P N
    by_lane = [pose.item(s, k) for k in range(7) for s in range(3)]
    rows: Table = [("traces and diagonals first, then slots 0 2 1 (built)", "0", "0")]
    for name, order in (("slot by slot", by_slot), ("lane by lane", by_lane)):
        items = [*order, *(address for address in usual if address not in order)]
        ready = {address: cycle + 1 for cycle, address in enumerate(items)}
        first, rest = pose.moment_matrix(), pose.program()[len(pose.moment_matrix()) :]
        first.sort(key=lambda dot: max(ready.get(term.x, 0) for term in dot.terms))
        with patch.object(pose, "arrival", lambda ready=ready: dict(ready)):
            rows.append((name, *versus(now, ends([*first, *rest]))))
    return table(("order", "cycles to q", "cycles to the pose"), rows)


def raw_results() -> str:
    """Normalised entries, whose references then need probing, against raw ones."""

    def normalised(dot: asm.Dot) -> asm.Dot:
        kind = asm.NORMAL if dot.kind == asm.RAW else dot.kind
        own = dot.reference == asm.OWN and (dot.kind == asm.RAW or dot.name in ("D", "P0", "P1", "P2", "P3"))
        return replace(dot, kind=kind, reference=asm.REF_PROBED if own else dot.reference)

    built = scheduled()
    other = replace(built, dots=[normalised(dot) for dot in built.dots])
    rng = np.random.default_rng(3)
    frames = [frame(rng, rng.uniform(1, 120), (1.0, 1.0, rng.uniform(0.2, 1)), 1e-4) for _ in range(60)]
    worst = []
    for program in (built, other):
        core = OltaeCore()
        core.program = program
        worst.append(max(relative_before_rounding(core, item) for item in frames))
    now = ends()
    rows: Table = [
        ("raw, one exponent a block (built)", "0", "0", f"{worst[0]:.0e}"),
        (
            "normalised, references probed",
            *versus(now, ends([normalised(d) for d in pose.program()])),
            f"{worst[1]:.0e}",
        ),
    ]
    return table(
        ("entries of M, z and adj M", "cycles to q", "cycles to the pose", "q before rounding, worst"), rows
    )


def relative_before_rounding(core: OltaeCore, item: QuantisedFrame) -> float:
    """Relative error of q as N / D of the lane values: without the reciprocal and binary32."""
    kept: list[solver.Solver] = []

    def keep(**options: Any) -> solver.Solver:
        kept.append(solver.Solver(**options))
        return kept[-1]

    with patch.object(core_module, "Solver", keep):
        core.run(item, CoreConfig(covariance=False))
    bank = kept[0].registers[0]
    p = [Fraction(bank[pose.P + c][0]) * Fraction(2) ** bank[pose.P + c][1] for c in range(4)]
    truth = exact.solve(item, turn=kept[0].turn)
    assert truth.q is not None
    size = sum(float(x) ** 2 for x in truth.q) ** 0.5
    difference = [float(p[c + 1] / p[0] - truth.q[c]) for c in range(3)]
    return float(np.linalg.norm(difference) / size)


def reciprocal_bits() -> str:
    """Error of the reciprocal and what another digit would cost."""
    rng, worst = np.random.default_rng(4), Fraction(0)
    for m in [1 << 33, (1 << 34) - 1, *(int(x) for x in rng.integers(1 << 33, 1 << 34, 100_000))]:
        mantissa, exponent = reciprocal((m, 0))
        worst = max(worst, abs(Fraction(mantissa) * Fraction(2) ** exponent * m - 1))
    now = ends()
    with (
        patch.object(schedule, "RECIPROCAL_LATENCY", asm.RECIPROCAL_LATENCY + 1),
        patch.object(schedule, "DIVIDER_BUSY", schedule.DIVIDER_BUSY + 1),
    ):
        cost = versus(now, ends())
    rows: Table = [
        ("9 digits, 27 bits (built)", f"{float(worst):.1e}", "0", "0"),
        ("10 digits, 30 bits", f"{2.0**-30:.1e} (bound)", *cost),
    ]
    return table(
        ("reciprocal", "relative error, worst of 100 000", "cycles to q", "cycles to the pose"), rows
    )


def static_schedule() -> str:
    """Size of the program and how full it is."""
    program = scheduled()
    rows: Table = []
    first = len(pose.program())
    parts = (
        ("pose", program.dots[:first]),
        ("residual, conditioning", program.dots[first : program.basic]),
        ("covariances", program.dots[program.basic :]),
        ("re-application", program.newton),
    )
    for name, dots in parts:
        words, slots = sum(len(d.terms) for d in dots), sum(d.slots for d in dots)
        cycles = dots[-1].end - dots[0].cycle + 1
        rows.append((name, str(len(dots)), str(words), str(slots), str(cycles), f"{slots / cycles:.0%}"))
    return table(("part", "dot products", "ROM words", "slots run", "cycles", "slots / cycles"), rows)


def turns() -> str:
    """Largest angle left, by cloud and by the rule that chooses the turn."""
    rng = np.random.default_rng(6)
    rows: Table = []
    for name, shape, n, noise in (
        ("round, 200 points", (1.0, 1.0, 1.0), 200, 0.0),
        ("round, 200 points, noise 0.1", (1.0, 1.0, 1.0), 200, 0.1),
        ("1 : 0.3 : 0.1, 200 points", (1.0, 0.3, 0.1), 200, 0.0),
        ("3 points", (1.0, 1.0, 1.0), 3, 0.0),
    ):
        left: dict[str, list[float]] = {"det": [], "trace": [], "p": []}
        early = 180.0
        for _ in range(1500):
            angle = rng.uniform(0, 180)
            a = rng.normal(size=(n, 3)) * np.array(shape)
            b = a @ rotation(rng, angle).T + noise * rng.normal(size=a.shape)
            m = golden.moments(a, b, np.ones(n))
            solved = []
            for k in range(4):
                turned = golden.turn(m, k)
                matrix = golden.moment_matrix(turned)
                det, numerator = golden.cramer(matrix, golden.moment_vector(turned))
                with np.errstate(divide="ignore", invalid="ignore"):
                    q = float(np.linalg.norm(numerator)) / det if det else np.inf
                peak = max(abs(det), float(np.abs(numerator).max()))
                solved.append((det, float(np.trace(matrix)), peak, float(np.degrees(2 * np.arctan(abs(q))))))
            for column, rule in enumerate(left):
                left[rule].append(max(solved, key=lambda s: s[column])[3])
            if max(range(4), key=lambda k: solved[k][0]) != 0:
                early = min(early, angle)
        rows.append((name, *(f"{max(values):.0f}" for values in left.values()), f"{early:.0f}"))
    head = (
        "cloud",
        "largest det M",
        "largest trace M",
        "largest of D, N",
        "smallest angle at which det M takes a turn",
    )
    return table(head, rows)


def exponent_range() -> str:
    """Smallest and largest exponent of a lane value over frames at the ends of the range."""
    rows: Table = []
    corner = np.random.default_rng(0).integers(-(2**31), 2**31, (1000, 3))
    unit = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    heavy = np.full(1000, 65535)
    half_turn = np.array([-1, -1, 1])
    for frac in (-64, 95):
        for name, a, b, w in (
            ("full scale, weights 65535, b = a", corner, corner, heavy),
            ("full scale, weights 65535, b = -a - 1", corner, -corner - 1, heavy),
            ("half scale, exactly 180 degrees", corner // 2, corner // 2 * half_turn, heavy),
            ("four points, 1 bit", unit, unit, None),
            ("four points, 1 bit, b = a turned and moved", unit, np.roll(unit, 1, axis=1) + 5, None),
            ("four points, 1 bit, exactly 180 degrees", unit, unit * half_turn, None),
        ):
            item = QuantisedFrame(a, b, w, frac, 1.0)
            seen = exponents(item)
            rows.append((str(frac), name, str(min(seen)), str(max(seen))))
    return table(("FRAC", "frame", "smallest exponent", "largest"), rows)


def exponents(item: QuantisedFrame) -> list[int]:
    """Exponents of all lane values that are written, before they wrap (only what follows from 1/0 may)."""
    seen: list[int] = []
    finish = solver.Solver.finish

    def watched(self: Any, dot: asm.Dot, used: list[int]) -> None:
        finish(self, dot, used)
        if dot.kind != asm.FIXED and not endless(self, dot):
            lanes = [self.lanes[number] for number in used]
            values = [s.raw() if dot.kind == asm.RAW else s.result(dot.half, dot.clamp) for s in lanes]
            seen.extend(exponent for mantissa, exponent in values if mantissa)
            inverse = self.registers[0][dot.divide_dest] if dot.divide_dest is not None else ZERO
            if inverse[0] and inverse[1] != 1200:  # 1/0
                seen.append(inverse[1])

    def endless(self: Any, dot: asm.Dot) -> bool:
        """Whether the dot product follows from 1/0: q and its covariance at 180 degrees."""
        return self.registers[0][pose.P][0] == 0 and dot.name.startswith(
            ("q ", "q_cov", "L ", "q1", "q2", "q3")
        )

    with patch.object(solver.Solver, "finish", watched):
        OltaeCore().run(item)
    return seen


MEASURES: dict[str, Callable[[], str]] = {
    "conditioning": conditioning,
    "wide-lane": wide_lane,
    "drain-order": drain_order,
    "raw-results": raw_results,
    "reciprocal-27-bits": reciprocal_bits,
    "static-schedule": static_schedule,
    "turns": turns,
    "exponent-range": exponent_range,
    **ivisnav_notes.MEASURES,
}


def main(names: list[str]) -> int:
    """Measure what the notes named (or all) show."""
    for name in names or MEASURES:
        text = MEASURES[name]()
        print(f"{name}\n{text}\n")
        fill(NOTES / f"{name}.md", "measured", text)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
