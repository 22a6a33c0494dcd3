# SPDX-License-Identifier: Apache-2.0
"""reference_exponent against the solver model: every code, every tracked scale, back-to-back frames."""

from __future__ import annotations

import random
from pathlib import Path

from relnav.model import assembler as asm
from relnav.model.lane import ZERO, LaneValue
from relnav.model.solver import EXPONENT_FLOOR, Solver

from tb.arith import random_mantissa, word
from tb.common.replay import run
from tb.common.vectors import pack

LATENCY = 2
WIDTHS = [1, 1, 1, 5, 48, 1, 1, 1, 48, 4, 1]
TRACKS = (asm.TRACK_QUATERNION, asm.TRACK_CENTROID, asm.TRACK_AFRESH)
WITHOUT = (asm.OWN, asm.REF_PROBED)  # codes whose reference comes from the terms


def value(rng: random.Random, spread: int) -> LaneValue:
    """A lane value; its exponent anywhere, at an end, or within `spread` of 0."""
    if rng.random() < 0.15:
        return ZERO
    exponents = [rng.randint(-spread, spread), rng.randint(-spread, spread), rng.randint(-2048, 2047)]
    return random_mantissa(rng), rng.choice([*exponents, -2048 if rng.random() < 0.1 else exponents[0]])


def test_reference_exponent_matches_the_model(simulator: str, tmp_path: Path) -> None:
    rng = random.Random(64)
    stimulus: list[int] = []
    expected: list[tuple[int, list[int | None]]] = []
    for _ in range(250):
        spread = rng.choice([3, 40, 600, 2047])
        moment = cross = quaternion = centroid = EXPONENT_FLOOR
        for number in range(rng.choice([1, 30, 80])):
            start = number == 0  # the first item is a trace
            item_valid = start or rng.random() < 0.4
            address = 8 * rng.randrange(3) if start else rng.randrange(32)
            item, bus = value(rng, spread), value(rng, spread)
            event = 0 if start or rng.random() < 0.6 else rng.choice(TRACKS)
            if item_valid and item[0] and address < 24:
                if address % 8 == 0:
                    moment = max(moment, item[1])
                if address % 8 == 5:
                    cross = max(cross, item[1])
            # what is on the bus now counts for the next clock's code
            tracked_quaternion, tracked_centroid = quaternion, centroid
            if event == asm.TRACK_AFRESH:
                quaternion = EXPONENT_FLOOR
            if event in (asm.TRACK_AFRESH, asm.TRACK_QUATERNION) and bus[0]:
                quaternion = max(quaternion, bus[1])
            if event == asm.TRACK_CENTROID and bus[0]:
                centroid = max(centroid, bus[1])
            code = rng.randrange(13)
            probing = int(code == asm.REF_PROBED and rng.random() < 0.5)
            fields = [code not in WITHOUT or number % 2, start, item_valid, address, word(item)]
            fields += [event == kind for kind in (asm.TRACK_AFRESH, asm.TRACK_QUATERNION, asm.TRACK_CENTROID)]
            fields += [word(bus), code, probing]
            if fields[0]:
                scales = Solver(
                    moment_scale=moment,
                    cross_scale=cross,
                    quaternion_scale=tracked_quaternion,
                    centroid_scale=tracked_centroid,
                    registers=[],
                    lanes=[],
                )
                both: list[int | None] = [None, None]
                if code not in WITHOUT:
                    both = [scales.reference(code, lane) % (1 << 14) for lane in (1, 0)]
                own = int(code == asm.OWN)
                probed = int(code == asm.REF_PROBED and not probing)
                expected.append((len(stimulus) + LATENCY, [*both, own, probing, probed]))
            stimulus.append(pack(zip(map(int, fields), WIDTHS, strict=True)))
    top = Path(__file__).parent / "reference_exponent_replay.v"
    got = run(top, ["oltae"], simulator, tmp_path, stimulus, sum(WIDTHS), [14, 14, 1, 1, 1], {})
    assert len(got) == len(expected)
    for (cycle, mine), (when, theirs) in zip(got, expected, strict=True):
        known = [m if t is None else t for m, t in zip(mine, theirs, strict=True)]
        assert (cycle, mine) == (when, known)
