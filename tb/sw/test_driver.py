# SPDX-License-Identifier: Apache-2.0
"""The driver on a bus of plain Python: what it writes, in which order, and what it believes."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import pytest
from relnav.driver import ALL_FLAGS, OltaeDriver, beats_of
from relnav.errors import BackendError, InputError
from relnav.model.raw import CoreConfig, RawResult, float_to_word
from relnav.quantise import QuantisedFrame
from relnav.registers import Oltae

FLAG = Oltae.FLAGS.encode
DONE, IDLE = Oltae.State.DONE, Oltae.State.IDLE


class Core:
    """A dictionary of registers. `solve` answers a frame, `lag` looks at STATUS after its last beat."""

    def __init__(self, lag: int = 0) -> None:
        self.words = {Oltae.ID.ADDRESS: Oltae.ID.RESET, Oltae.VERSION.ADDRESS: Oltae.VERSION.RESET}
        self.words[Oltae.BUILD.ADDRESS] = Oltae.BUILD.encode(WEIGHTED=1, COVARIANCE=1, REAPPLY=1, MANTISSA=35)
        self.words |= {Oltae.Q.ADDRESS + 4 * index: 1000 + index for index in range(34)}
        self.built = 0xF
        self.written: list[tuple[int, int]] = []
        self.frames: list[list[int]] = []
        self.open: list[int] = []
        self.state, self.frame, self.lag, self.left = DONE, 65535, lag, -1
        self.push_ready = True
        self.solve: Callable[[Core], None] = Core.solved

    def solved(self, flags: int = 0) -> None:
        self.frame, self.state = (self.frame + 1) & 0xFFFF, DONE
        self.raise_flags(flags)

    def failed(self, flags: int) -> None:
        self.state = IDLE
        self.raise_flags(flags)

    def raise_flags(self, flags: int) -> None:
        self.words[Oltae.FRAME_FLAGS.ADDRESS] = flags
        self.words[Oltae.FLAGS.ADDRESS] = self.words.get(Oltae.FLAGS.ADDRESS, 0) | flags

    def read(self, address: int) -> int:
        if address == Oltae.STATUS.ADDRESS:
            if self.left == 0:
                self.solve(self)
            self.left -= 1
            busy = self.state in (Oltae.State.LOAD, Oltae.State.COMPUTE)
            return Oltae.STATUS.encode(
                STATE=self.state, BUSY=busy, FRAME=self.frame, PUSH_READY=self.push_ready
            )
        return self.words.get(address, 0)

    def write(self, address: int, value: int) -> None:
        self.written.append((address, value))
        if address == Oltae.FLAGS.ADDRESS:
            self.words[address] = self.words.get(address, 0) & ~value
        elif address == Oltae.CONFIG.ADDRESS:
            self.words[address] = value & self.built
        else:
            self.words[address] = value
        if address == Oltae.PUSH.ADDRESS:
            self.open.append(self.words[Oltae.DATA_B.ADDRESS] << 32 | self.words[Oltae.DATA_A.ADDRESS])
            if value:
                self.take(self.open)
                self.open = []

    def stream(self, beats: Sequence[int]) -> None:
        self.take(list(beats))

    def take(self, beats: list[int]) -> None:
        self.frames.append(beats)
        self.left = self.lag


FRAME = QuantisedFrame(np.array([[1, -2, 3]] * 3), np.array([[-(1 << 31), 5, 6]] * 3), None, -7)
WEIGHTED = QuantisedFrame(FRAME.a, FRAME.b, np.array([0, 65535, 9]), 95, 4.0)


def test_beats() -> None:
    point = [0x80000000_00000001, 0x00000005_FFFFFFFE, 0x00000006_00000003]
    assert beats_of(FRAME) == point * 3
    assert beats_of(WEIGHTED) == [0, *point, 65535, *point, 9, *point]
    assert all(type(beat) is int for beat in beats_of(WEIGHTED))


def test_identify() -> None:
    core = Core()
    build = OltaeDriver(core).identify()
    assert (build.weighted, build.covariance, build.reapply, build.mantissa) == (True, True, True, 35)
    core.words[Oltae.VERSION.ADDRESS] = Oltae.VERSION.RESET ^ 1  # another patch
    OltaeDriver(core).identify()
    core.words[Oltae.VERSION.ADDRESS] = Oltae.VERSION.encode(MAJOR=9, MINOR=8, PATCH=7)
    with pytest.raises(BackendError, match=r"version 9\.8\.7, this driver is for"):
        OltaeDriver(core).identify()
    core.words[Oltae.ID.ADDRESS] = 0  # what unmapped logic reads as
    with pytest.raises(BackendError, match="ID reads 0x00000000, not 0x4f4c5445"):
        OltaeDriver(core).identify()


@pytest.mark.parametrize("feed", ["stream", "registers"])
@pytest.mark.parametrize("lag", [0, 1, 7])
def test_a_frame(feed: str, lag: int) -> None:
    """DONE of the frame before, and its count at the wrap, are not taken for this frame's."""
    core = Core(lag)
    core.words |= {Oltae.POINTS.ADDRESS: 3, Oltae.WEIGHT.ADDRESS: 65544, Oltae.TURN.ADDRESS: 2}
    core.words |= {Oltae.CYCLES_Q.ADDRESS: 90, Oltae.CYCLES_POSE.ADDRESS: 120, Oltae.CYCLES_ALL.ADDRESS: 130}
    core.words[Oltae.FLAGS.ADDRESS] = ALL_FLAGS  # of long ago
    core.solve = lambda c: c.solved(FLAG(Q_SATURATED=1))
    got = OltaeDriver(core).solve(WEIGHTED, CoreConfig(variance=0.5), feed=feed)  # type: ignore[arg-type]
    assert core.frames == [beats_of(WEIGHTED)]
    assert (got.points, got.weight, got.turn, got.flag_names) == (3, 65544, 2, ("Q_SATURATED",))
    assert (got.cycles_q, got.cycles_pose, got.cycles_all) == (90, 120, 130)
    assert got.result_words() == [*range(1000, 1021), 0, *range(1022, 1034)]
    assert core.words[Oltae.CONFIG.ADDRESS] == Oltae.CONFIG.encode(WEIGHTED=1, COVARIANCE=1)
    assert core.words[Oltae.FRAC.ADDRESS] == 95
    assert core.words[Oltae.VARIANCE.ADDRESS] == float_to_word(2.0)  # times the weights' scale
    cleared = core.written.index((Oltae.FLAGS.ADDRESS, ALL_FLAGS))
    configured = core.written.index((Oltae.VARIANCE.ADDRESS, float_to_word(2.0)))
    assert configured < cleared and all(a != Oltae.PUSH.ADDRESS for a, _ in core.written[:cleared])


def test_negative_frac_and_no_covariance() -> None:
    core = Core()
    got = OltaeDriver(core).solve(FRAME, CoreConfig(covariance=False, forbid_turns=True))
    assert core.words[Oltae.FRAC.ADDRESS] == 0xF9 and core.words[Oltae.CONFIG.ADDRESS] == 2
    assert got.q_cov is None and got.t_cov is None and got.rss == 1018


@pytest.mark.parametrize(
    "name", ["FEW_POINTS", "RANK_DEFICIENT", "ZERO_WEIGHT", "TOO_LONG", "BAD_TLAST", "WATCHDOG"]
)
def test_failed_frames(name: str) -> None:
    """Their flags and no number of the frame before."""
    core = Core(3)
    core.solve = lambda c: c.failed(FLAG(**{name: 1}))
    assert OltaeDriver(core).solve(FRAME) == RawResult(flags=FLAG(**{name: 1}))


def test_too_long_is_waited_out() -> None:
    """The flag rises while the rest is still swallowed: not before the core is idle is the frame over."""
    core = Core()
    looks = 0

    def swallow(c: Core) -> None:
        nonlocal looks
        looks += 1
        c.left = 1  # and again at the next look
        c.raise_flags(FLAG(TOO_LONG=1))
        c.state = Oltae.State.LOAD if looks < 5 else IDLE

    core.solve = swallow
    assert OltaeDriver(core).solve(FRAME).flag_names == ("TOO_LONG",)
    assert looks == 5


def test_a_core_that_hangs_is_given_up() -> None:
    core, idled = Core(10**9), 0

    def idle() -> None:
        nonlocal idled
        idled += 1

    driver = OltaeDriver(core, idle)
    with pytest.raises(BackendError, match="no result after 25 looks at the core: its state is DONE"):
        driver.solve(FRAME, polls=25)
    assert idled == 25


def test_what_cannot_be_done_is_refused() -> None:
    core = Core()
    driver = OltaeDriver(core)
    with pytest.raises(InputError, match="without points"):
        driver.feed([])
    core.push_ready = False
    with pytest.raises(BackendError, match="takes no push"):
        driver.feed([1, 2, 3], "registers")
    core.state = Oltae.State.COMPUTE
    with pytest.raises(BackendError, match="busy"):
        driver.configure(CoreConfig(), frac=0)
    core.state, core.built = IDLE, Oltae.CONFIG.encode(FORBID_TURNS=1)
    with pytest.raises(BackendError, match="without weights"):
        driver.solve(WEIGHTED)
    assert not core.frames
    assert driver.solve(FRAME).q_cov is None  # lean: no covariance to be read
    with pytest.raises(ValueError, match="does not fit"):
        driver.configure(CoreConfig(), frac=128)


def test_controls() -> None:
    core = Core()
    driver = OltaeDriver(core)
    driver.acknowledge()
    driver.soft_reset()
    driver.enable_interrupts(done=True)
    core.words[Oltae.IRQ_STATUS.ADDRESS] = 2
    assert driver.clear_interrupts() == (False, True)
    driver.clear_flags(FLAG(BAD_TLAST=1))
    control, irq, status = Oltae.CONTROL.ADDRESS, Oltae.IRQ_ENABLE.ADDRESS, Oltae.IRQ_STATUS.ADDRESS
    assert core.written == [(control, 2), (control, 1), (irq, 1), (status, 2), (Oltae.FLAGS.ADDRESS, 16)]
    assert driver.status().state == DONE and driver.status().frame == 65535
