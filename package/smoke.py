# SPDX-License-Identifier: Apache-2.0
"""sim/smoke_<core>.hex: two frames and the bit-exact model's results, for sim/smoke.v.

One step a line, 80 bits in hexadecimal: operation (4), byte address (12), data (64).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from relnav import driver as oltae
from relnav.ivisnav import driver as ivisnav
from relnav.ivisnav.quantise import QuantisedRows
from relnav.model.core import OltaeCore
from relnav.model.rates_core import RatesCore
from relnav.model.raw import CoreConfig
from relnav.quantise import QuantisedFrame
from relnav.registers import Ivisnav, Oltae

from .cores import Core

BENCH = "sim/smoke.v"
# as in sim/smoke.v
WRITE, EXPECT, AWAIT, BEAT, LAST_BEAT, END = range(6)

Step = tuple[int, int, int]


def script_file(core: Core) -> str:
    """Where the script of a core lies."""
    return f"sim/smoke_{core.name}.hex"


def script(core: Core) -> str:
    """The script: one frame by the registers, one by the stream."""
    steps = list((_oltae if core.name == "oltae" else _ivisnav)(core))
    return "".join(
        f"{operation:x}{address:03x}{data:016x}\n" for operation, address, data in [*steps, (END, 0, 0)]
    )


def _identity(core: Core) -> Iterator[Step]:
    for register in (core.driver.MAP.ID, core.driver.MAP.VERSION):
        yield EXPECT, register.ADDRESS, register.RESET


def _frame(registers: Any, number: int, beats: list[int], expected: dict[int, int]) -> Iterator[Step]:
    """Beats, the count of completed frames, results; frame 1 is pushed."""
    for index, beat in enumerate(beats, 1):
        last = index == len(beats)
        if number > 1:
            yield (LAST_BEAT if last else BEAT), 0, beat
            continue
        yield WRITE, registers.DATA_A.ADDRESS, beat & 0xFFFFFFFF
        yield WRITE, registers.DATA_B.ADDRESS, beat >> 32
        yield WRITE, registers.PUSH.ADDRESS, registers.PUSH.encode(LAST=last)
    yield AWAIT, registers.STATUS.ADDRESS, registers.STATUS.encode(FRAME=number)
    expected |= {registers.FLAGS.ADDRESS: 0, registers.FRAME_FLAGS.ADDRESS: 0}
    for address, word in sorted(expected.items()):
        yield EXPECT, address, word


def _oltae(core: Core) -> Iterator[Step]:
    yield from _identity(core)
    a = np.array([[900, -20, 350], [-410, 777, 80], [33, 250, -640], [-500, -600, 120], [64, 128, 256]])
    b = a[:, [1, 0, 2]] * [-1, 1, 1] + [[1000, -7, 44]]  # a quarter turn about z, moved
    b[0] += [3, -2, 1]
    for number, points in enumerate((slice(0, 5), slice(1, 5)), 1):
        frame, config = QuantisedFrame(a[points], b[points], None, 8), CoreConfig()
        raw = OltaeCore().run(frame, config)
        yield WRITE, Oltae.FRAC.ADDRESS, Oltae.FRAC.encode(FRAC=frame.frac)
        expected = {Oltae.POINTS.ADDRESS: raw.points, Oltae.WEIGHT.ADDRESS: raw.weight}
        expected |= {Oltae.TURN.ADDRESS: raw.turn}
        expected |= {Oltae.Q.ADDRESS + 4 * place: word for place, word in enumerate(raw.result_words())}
        yield from _frame(Oltae, number, oltae.beats_of(frame), expected)


def _ivisnav(core: Core) -> Iterator[Step]:
    yield from _identity(core)
    h = np.arange(48, dtype=np.int64).reshape(8, 6) % 7 - 3
    h[:6] += np.diag(np.full(6, 4000))
    h[6:] += np.array([[900], [-350]])
    y = h @ np.array([1, -2, 3, -4, 5, -6]) + np.array([0, 1, 0, -1, 2, 0, 0, 1])
    for number, rows in enumerate((slice(0, 8), slice(0, 7)), 1):
        frame = QuantisedRows(h[rows], y[rows], np.arange(8)[rows] % 3 + 1, 12, 12)
        raw = RatesCore().run(frame, 0.0)
        assert raw.words is not None
        yield WRITE, Ivisnav.FRAC.ADDRESS, Ivisnav.FRAC.encode(FRAC_H=frame.frac_h, FRAC_Y=frame.frac_y)
        expected = {Ivisnav.ROWS.ADDRESS: raw.n, Ivisnav.WEIGHT.ADDRESS: raw.weight}
        expected |= {Ivisnav.CONDITION.ADDRESS: raw.condition_word}
        expected |= {Ivisnav.V.ADDRESS + 4 * place: word for place, word in enumerate(raw.words)}
        yield from _frame(Ivisnav, number, ivisnav.beats_of(frame), expected)
