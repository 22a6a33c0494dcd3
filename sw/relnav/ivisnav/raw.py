# SPDX-License-Identifier: Apache-2.0
"""What a frame leaves in the iVisNav core's registers, and what it means.

Weights are integers in the core, w = weight_scale * the user's; VARIANCE is at unit integer weight. As for
OLTAE (relnav.model.raw) the covariance comes out in the user's units and only rss is divided by the scale.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from relnav.model.raw import floats_of, symmetric, word_to_float
from relnav.registers import Ivisnav

if TYPE_CHECKING:
    from .quantise import QuantisedRows
    from .result import RatesResult

FLAG_BITS: dict[str, int] = {name: field.low for name, field in Ivisnav.FLAGS.FIELDS.items()}
"""Flag -> its bit of FLAGS and FRAME_FLAGS, in the order of the bits."""
FLAG_NAMES: tuple[str, ...] = tuple(FLAG_BITS)

# A frame with one of these has no numbers; ILL_CONDITIONED leaves the condition.
FAILURES: frozenset[str] = frozenset(FLAG_NAMES) - {"BUSY_WRITE"}

# Where each result starts in the result registers, and how many words it has.
RESULT_LAYOUT: dict[str, tuple[int, int]] = {"v": (0, 3), "omega": (3, 3), "rss": (6, 1), "cov": (7, 21)}
RESULT_WORDS = 28


@dataclass(frozen=True)
class RawRates:
    """Register words of one frame. Numbers are binary32 bit patterns (uint32).

    n:              rows, those of weight 0 included
    used:           rows of positive weight; None from hardware, which has no register for it
    weight:         sum of the integer weights
    flags:          bits of FRAME_FLAGS
    condition_word: estimate of cond(H)^2; 0 where the frame did not come so far
    words:          the 28 result registers (RESULT_LAYOUT); None for a frame that left no numbers
    cycles_*:       None without hardware
    """

    n: int = 0
    used: int | None = None
    weight: int = 0
    flags: int = 0
    condition_word: int = 0
    words: tuple[int, ...] | None = None
    cycles_rates: int | None = None
    cycles_all: int | None = None

    @property
    def flag_names(self) -> tuple[str, ...]:
        """Names of the flags that are set."""
        return tuple(name for name, bit in FLAG_BITS.items() if self.flags >> bit & 1)

    @property
    def failed(self) -> bool:
        """True when the frame left no numbers."""
        return not FAILURES.isdisjoint(self.flag_names)


def raw_to_result(raw: RawRates, name: str | int, rows: QuantisedRows) -> RatesResult:
    """The typed result: binary32 words as the floats they are, the weights' scale undone in rss.

    A failed frame has no numbers, but the condition where that is the reason.
    """
    from .result import RatesResult

    square = word_to_float(raw.condition_word)
    condition = square**0.5 if square > 0.0 else None
    if raw.failed or raw.words is None:
        return RatesResult(frame=name, n=len(rows.y), flags=raw.flag_names, condition=condition)
    found = {field: floats_of(raw.words[at : at + count]) for field, (at, count) in RESULT_LAYOUT.items()}
    first, count = RESULT_LAYOUT["cov"]
    cycles = None
    if raw.cycles_rates is not None and raw.cycles_all is not None:
        cycles = {"rates": raw.cycles_rates, "all": raw.cycles_all}
    cov = symmetric(raw.words[first : first + count], 6)
    return RatesResult(
        frame=name,
        n=raw.n,
        v=found["v"],
        omega=found["omega"],
        cov=cov if np.isfinite(cov).all() else None,
        rss=float(found["rss"][0]) / rows.weight_scale,
        flags=raw.flag_names,
        cycles=cycles,
        condition=condition,
    )
