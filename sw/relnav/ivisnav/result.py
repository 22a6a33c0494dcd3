# SPDX-License-Identifier: Apache-2.0
"""The typed rates of one frame, the same from every backend."""

from __future__ import annotations

from dataclasses import dataclass

from ..attitude import FloatArray
from ..result import plain
from .raw import FAILURES


@dataclass(frozen=True, eq=False)
class RatesResult:
    """x = (v, omega) of y = h x for one frame. A failed frame (see raw.FAILURES) has None for its numbers.

    frame:      the frame's label
    n:          rows, zero-weight ones included
    v, omega:   (3,) m/s and (3,) rad/s: the plate's, relative to the sensor, in the axes of r and p
    cov:        (6, 6) of (v, omega); not finite where neither a sigma nor degrees of freedom scale it
    rss:        sum of w (y - h x)^2, the user's weights times (m/s)^2
    flags:      names, empty when all is well
    cycles:     {"rates", "all"} from the hardware counter; None without hardware
    condition:  estimate of cond(sqrt(W) H), also where that is the reason for a refusal
    """

    frame: str | int
    n: int
    v: FloatArray | None = None
    omega: FloatArray | None = None
    cov: FloatArray | None = None
    rss: float | None = None
    flags: tuple[str, ...] = ()
    cycles: dict[str, int] | None = None
    condition: float | None = None

    @property
    def failed(self) -> bool:
        """True when the frame has no rates."""
        return any(flag in FAILURES for flag in self.flags)

    def to_json(self) -> dict[str, object]:
        """The frame's object of `relnav rates --json`; numbers unrounded, None for what is not finite."""
        return {
            "frame": self.frame,
            "n": self.n,
            "v": plain(self.v),
            "omega": plain(self.omega),
            "cov": plain(self.cov),
            "rss": plain(self.rss),
            "flags": list(self.flags),
            "cycles": self.cycles,
            "condition": plain(self.condition),
        }
