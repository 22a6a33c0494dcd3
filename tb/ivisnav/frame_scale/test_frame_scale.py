# SPDX-License-Identifier: Apache-2.0
"""frame_scale against FrameScale: all sizes of h and y, all binary points, a new frame every three clocks."""

from __future__ import annotations

import random
from itertools import product
from pathlib import Path

from relnav.model.rates_program import SIZE, Scale
from relnav.model.rates_scale import FrameScale

from tb.common.replay import run
from tb.common.vectors import pack, to_signed

MOMENTS, OTHERS = 1, 3  # latencies
LARGEST = 32  # size of h and y, and of the weights' sum
FRACS = range(-64, 96)
WIDTHS = [12, 12, 12, 7, 12, 12, 12]

Frame = tuple[int, int, int, int, int, bool]
"""Sizes of h, y and the weights' sum; binary points of h and y; estimated."""


def frames(rng: random.Random, some: int) -> list[Frame]:
    """Ends of everything with one another; all sizes, all points; `some` random ones."""
    ends = (0, 1, 2, 3, 31, 32)
    points = (-64, -1, 0, 95)
    found = list(product(ends, ends, (0, 1, 32), points, points, (False, True)))
    sizes = range(LARGEST + 1)

    def anything() -> Frame:
        h, y, weight = (rng.choice(sizes) for _ in range(3))
        return h, y, weight, rng.choice(FRACS), rng.choice(FRACS), rng.random() < 0.5

    for h, y in product(sizes, sizes):
        found.append((h, y, *anything()[2:]))
    for frac in FRACS:
        found.append((*anything()[:3], frac, rng.choice(FRACS), rng.random() < 0.5))
        found.append((*anything()[:4], frac, rng.random() < 0.5))
    found += [anything() for _ in range(some)]
    rng.shuffle(found)
    return found


def outputs(frame: Frame) -> list[int]:
    """What the model says, in the order of the ports."""
    scale = FrameScale(*frame)
    moments = [scale.moment(row, column) for row, column in ((0, 0), (0, SIZE), (SIZE, SIZE))]
    back = [scale.output(kind) for kind in (Scale.RATE, Scale.RSS, Scale.COVARIANCE)]
    return [*moments, scale.right, *back]


def test_frame_scale_matches_the_model(simulator: str, tmp_path: Path) -> None:
    """A frame's inputs stay for three clocks: the last result comes with the next one's."""
    rng = random.Random(202)
    chosen = frames(rng, 1_000)
    stimulus = [
        pack([(int(number > 0), 1), (h, 6), (y, 6), (weight, 6), (frac_h, 8), (frac_y, 8), (estimated, 1)])
        for number, (h, y, weight, frac_h, frac_y, estimated) in enumerate(chosen)
        for _ in range(OTHERS)
    ]
    top = Path(__file__).parent / "frame_scale_replay.v"
    got = run(top, ["ivisnav"], simulator, tmp_path, stimulus, 36, WIDTHS, {})
    assert [cycle for cycle, _ in got] == list(range(OTHERS, len(stimulus)))
    found = {cycle: [to_signed(x, n) for x, n in zip(row, WIDTHS, strict=True)] for cycle, row in got}
    for number, frame in enumerate(chosen[:-1]):
        start, wanted = OTHERS * number, outputs(frame)
        if number:
            assert found[start + MOMENTS][:3] == wanted[:3], frame
        assert found[start + OTHERS][3:] == wanted[3:], frame


def test_right_fits_the_residuals_shifter() -> None:
    """The residual moves y's terms by 33 + right places, 0 to 63."""
    for h, y in product(range(LARGEST + 1), repeat=2):
        assert -32 <= FrameScale(h, y, 0).right <= 30
