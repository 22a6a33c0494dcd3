# SPDX-License-Identifier: Apache-2.0
"""The typed result of one frame, the same from every backend."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .attitude import FloatArray

# In the order of the FLAGS register's bits.
FLAG_NAMES: tuple[str, ...] = (
    "FEW_POINTS",
    "RANK_DEFICIENT",
    "ZERO_WEIGHT",
    "TOO_LONG",
    "BAD_TLAST",
    "BUSY_WRITE",
    "Q_SATURATED",
    "ILL_CONDITIONED",
    "WATCHDOG",
    "NOT_BUILT",
    "UPSET",
)

# A frame with one of these has no numbers.
FAILURES: frozenset[str] = frozenset(
    ("FEW_POINTS", "RANK_DEFICIENT", "ZERO_WEIGHT", "TOO_LONG", "BAD_TLAST", "WATCHDOG", "UPSET")
)


@dataclass(frozen=True, eq=False)
class PoseResult:
    """b = R a + t for one frame. Lengths are in the user's unit, weights in the user's weight unit.

    A failed frame (see FAILURES) has None for every number but n.

    frame:       the frame's label
    n:           points, zero-weight ones included
    q:           Gibbs vector (3,), R = (I+Q)^-1 (I-Q): positive q3 turns by a NEGATIVE angle about z;
                 None where not finite
    quaternion:  unit (4,), scalar first and >= 0, of the R given (v' = R v)
    R, t:        (3, 3), (3,)
    q_cov:       covariance of q (3, 3), None where q is; t_cov: of t (3, 3), unit^2
    rss:         sum of w |b - R a - t|^2, weight unit * unit^2
    turn:        "none", "x", "y", "z": the 180 degree turn given to a before solving
    flags:       names, empty when all is well
    cycles:      {"q", "pose", "all"} from the hardware counter; None without hardware
    weight:      sum of the weights; condition, determinant: of the solved M, see golden.py
    q_fixed:     q in the paper's Q15.16 (3,), saturated
    """

    frame: str | int
    n: int
    q: FloatArray | None = None
    quaternion: FloatArray | None = None
    R: FloatArray | None = None
    t: FloatArray | None = None
    q_cov: FloatArray | None = None
    t_cov: FloatArray | None = None
    rss: float | None = None
    turn: str | None = None
    flags: tuple[str, ...] = ()
    cycles: dict[str, int] | None = None
    weight: float | None = None
    condition: float | None = None
    determinant: float | None = None
    q_fixed: FloatArray | None = None

    @property
    def failed(self) -> bool:
        """True when the frame has no pose."""
        return any(flag in FAILURES for flag in self.flags)

    def to_json(self) -> dict[str, object]:
        """The frame's object of `relnav pose --json`; numbers unrounded, None for what is not finite."""
        return {
            "frame": self.frame,
            "n": self.n,
            "q": plain(self.q),
            "quaternion": plain(self.quaternion),
            "R": plain(self.R),
            "t": plain(self.t),
            "q_cov": plain(self.q_cov),
            "t_cov": plain(self.t_cov),
            "rss": plain(self.rss),
            "turn": self.turn,
            "flags": list(self.flags),
            "cycles": self.cycles,
        }


def plain(value: FloatArray | float | None) -> object:
    """Lists and floats for JSON, which has no infinity; None for what is not finite."""
    if value is None or not np.all(np.isfinite(value)):
        return None
    return np.asarray(value).tolist()
