# SPDX-License-Identifier: Apache-2.0
"""Powers of two that bring a frame's moments below 1, and its results back (rtl/ivisnav/frame_scale.v)."""

from __future__ import annotations

from dataclasses import dataclass

from relnav.model.gram_ring import RingSums
from relnav.model.rates_program import SIZE, Scale


@dataclass(frozen=True)
class FrameScale:
    """Sizes of a frame's integers: |h| < 2^h, |y| < 2^y, sum of the weights < 2^weight; and binary points.

    Every moment is at most sum w times the two largest, so 2^-(sizes) brings it below 1.
    """

    h: int
    y: int
    weight: int
    frac_h: int = 0
    frac_y: int = 0
    estimated: bool = False
    """The covariance is scaled by the residuals, not by VARIANCE."""

    @classmethod
    def of(cls, sums: RingSums, frac_h: int, frac_y: int, variance: int = 0) -> FrameScale:
        """That of a frame's sums. variance: the VARIANCE register; to the hardware a denormal is 0."""
        estimated = variance >> 23 & 0xFF == 0
        return cls(sums.h_bits, sums.y_bits, sums.weight_bits, frac_h, frac_y, estimated)

    def __post_init__(self) -> None:
        """y counts as two bits at least: the residual's shifter is sized for it."""
        object.__setattr__(self, "y", max(self.y, 2))

    def moment(self, row: int, column: int) -> int:
        """Exponent that the moment of two components (6: y) is multiplied with."""
        return -(self.weight + sum(self.y if k == SIZE else self.h for k in (row, column)))

    @property
    def right(self) -> int:
        """Exponent of b's unit over A's: what y is multiplied with in the residual."""
        return self.h - self.y

    def output(self, scale: Scale) -> int:
        """Exponent that a result is multiplied with to be in the user's units."""
        rss = -self.moment(SIZE, SIZE) - 2 * self.frac_y
        if scale == Scale.RATE:
            return self.frac_h - self.frac_y - self.right
        if scale == Scale.RSS:
            return rss
        return 2 * self.frac_h + self.moment(0, 0) + (rss if self.estimated else 0)
