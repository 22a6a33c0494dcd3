# SPDX-License-Identifier: Apache-2.0
"""What the drivers of all cores have in common, on a bus of plain Python: what they write and believe."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from relnav import driver as oltae
from relnav.driver import CoreDriver, OltaeDriver
from relnav.errors import BackendError, InputError, UpsetError
from relnav.ivisnav import driver as ivisnav
from relnav.ivisnav.driver import IvisnavDriver
from relnav.ivisnav.quantise import QuantisedRows
from relnav.ivisnav.raw import RawRates
from relnav.model.raw import RawResult
from relnav.quantise import QuantisedFrame

from tb.sw.fake_core import FakeCore

POINTS = QuantisedFrame(np.array([[1, -2, 3]] * 3), np.array([[-(1 << 31), 5, 6]] * 3), None, -7)
ROWS = QuantisedRows(np.arange(36).reshape(6, 6) - 9, np.arange(6) - 3, np.arange(6), -7, 95)


@dataclass(frozen=True)
class Kind:
    """A driver, a frame for it and what a failed one leaves."""

    driver: type[CoreDriver[Any]]
    frame: Any
    beats: list[int]
    empty: Callable[[int], Any]
    failures: tuple[str, ...]

    @property
    def map(self) -> Any:
        return self.driver.MAP

    def flag(self, name: str) -> int:
        return int(self.map.FLAGS.encode(**{name: 1}))


COMMON = ("RANK_DEFICIENT", "ZERO_WEIGHT", "TOO_LONG", "BAD_TLAST", "WATCHDOG")
KINDS = {
    "oltae": Kind(
        OltaeDriver, POINTS, oltae.beats_of(POINTS), lambda f: RawResult(flags=f), ("FEW_POINTS", *COMMON)
    ),
    "ivisnav": Kind(
        IvisnavDriver, ROWS, ivisnav.beats_of(ROWS), lambda f: RawRates(flags=f), ("FEW_ROWS", *COMMON)
    ),
}


@pytest.fixture(params=KINDS)
def kind(request: pytest.FixtureRequest) -> Kind:
    return KINDS[str(request.param)]


def test_identify(kind: Kind) -> None:
    core = FakeCore(kind.map)
    driver: Any = kind.driver(core)
    for verify in (False, True):
        core.words[kind.map.BUILD.ADDRESS] = kind.map.BUILD.encode(MANTISSA=35, VERIFY=verify)
        assert (driver.identify().mantissa, driver.identify().verify) == (35, verify)
    core.words[kind.map.VERSION.ADDRESS] = kind.map.VERSION.RESET ^ 1  # another patch
    driver.identify()
    core.words[kind.map.VERSION.ADDRESS] = kind.map.VERSION.encode(MAJOR=9, MINOR=8, PATCH=7)
    with pytest.raises(BackendError, match=r"version 9\.8\.7, this driver is for"):
        driver.identify()
    core.words[kind.map.ID.ADDRESS] = 0  # what unmapped logic reads as
    wanted = f"no {kind.driver.NAME} core here: ID reads 0x00000000, not 0x{kind.map.ID.RESET:08x}"
    with pytest.raises(BackendError, match=wanted):
        driver.identify()


def test_one_core_is_not_the_other() -> None:
    core = FakeCore(IvisnavDriver.MAP)
    with pytest.raises(BackendError, match="no OLTAE core here: ID reads 0x49564953, not 0x4f4c5445"):
        OltaeDriver(core).identify()


@pytest.mark.parametrize("feed", ["stream", "registers"])
@pytest.mark.parametrize("lag", [0, 1, 7])
def test_a_frame(kind: Kind, feed: str, lag: int) -> None:
    """DONE of the frame before, and its count at the wrap, are not taken for this frame's."""
    core = FakeCore(kind.map, lag)
    core.words[kind.map.FLAGS.ADDRESS] = 0x3FF  # of long ago
    driver: Any = kind.driver(core)
    assert not driver.solve(kind.frame, feed=feed).failed
    assert core.frames == [kind.beats] and core.frame == 0
    every = sum(field.mask for field in kind.map.FLAGS.FIELDS.values())
    cleared = core.written.index((kind.map.FLAGS.ADDRESS, every))
    configured = next(i for i, (a, _) in enumerate(core.written) if a == kind.map.VARIANCE.ADDRESS)
    assert configured < cleared and all(a != kind.map.PUSH.ADDRESS for a, _ in core.written[:cleared])


def test_failed_frames(kind: Kind) -> None:
    """Their flags and no number of the frame before."""
    for name in kind.failures:
        core, flag = FakeCore(kind.map, 3), kind.flag(name)
        core.solve = lambda c, f=flag: c.failed(f)  # type: ignore[misc]
        driver: Any = kind.driver(core)
        assert driver.solve(kind.frame) == kind.empty(flag)


def test_too_long_is_waited_out(kind: Kind) -> None:
    """The flag rises while the rest is still swallowed: not before the core is idle is the frame over."""
    core = FakeCore(kind.map)
    looks = 0

    def swallow(c: FakeCore) -> None:
        nonlocal looks
        looks += 1
        c.left = 1  # and again at the next look
        c.raise_flags(kind.flag("TOO_LONG"))
        c.state = kind.map.State(1 if looks < 5 else 0)

    core.solve = swallow
    driver: Any = kind.driver(core)
    assert driver.solve(kind.frame).flag_names == ("TOO_LONG",)
    assert looks == 6  # the last one confirms


def test_a_core_that_hangs_is_given_up(kind: Kind) -> None:
    core, idled = FakeCore(kind.map, 10**9), 0

    def idle() -> None:
        nonlocal idled
        idled += 1

    driver: Any = kind.driver(core, idle)
    with pytest.raises(BackendError, match="no result after 25 looks at the core: its state is DONE"):
        driver.solve(kind.frame, polls=25)
    assert idled == 25
    core.state = kind.map.State(1)  # where the rest of the frame is missing
    with pytest.raises(BackendError, match=r"busy: its configuration is locked \(recover\(\) drops"):
        driver.solve(kind.frame)
    driver.recover()
    assert (kind.map.CONTROL.ADDRESS, kind.map.CONTROL.encode(SOFT_RESET=1)) in core.written
    core.state, core.lag = kind.map.State.IDLE, 0  # what the reset does
    assert not driver.solve(kind.frame).failed


def test_what_cannot_be_done_is_refused(kind: Kind) -> None:
    core = FakeCore(kind.map)
    driver: Any = kind.driver(core)
    with pytest.raises(InputError, match=f"without {kind.driver.ROWS}"):
        driver.feed([])
    core.push_ready = False
    with pytest.raises(BackendError, match="takes no push"):
        driver.feed([1, 2, 3], "registers")
    core.state = kind.map.State.COMPUTE
    with pytest.raises(BackendError, match="busy"):
        driver.solve(kind.frame)
    assert not core.frames


def test_controls(kind: Kind) -> None:
    core = FakeCore(kind.map)
    driver = kind.driver(core)
    driver.acknowledge()
    driver.soft_reset()
    driver.enable_interrupts(done=True)
    core.words[kind.map.IRQ_STATUS.ADDRESS] = 2
    assert driver.clear_interrupts() == (False, True)
    driver.clear_flags(kind.flag("BAD_TLAST"))
    control, irq, status = (r.ADDRESS for r in (kind.map.CONTROL, kind.map.IRQ_ENABLE, kind.map.IRQ_STATUS))
    assert core.written == [(control, 2), (control, 1), (irq, 1), (status, 2), (kind.map.FLAGS.ADDRESS, 16)]
    assert driver.status().state == kind.map.State.DONE and driver.status().frame == 65535


# ------------------------------------------------------------------------------------------------- upsets


class Flipping(FakeCore):
    """A core of which the readings with these numbers come back with a bit flipped."""

    def __init__(self, registers: Any, flips: frozenset[int] = frozenset()) -> None:
        super().__init__(registers)
        self.flips, self.readings = flips, 0
        self.bit = 3

    def read(self, address: int) -> int:
        self.readings += 1
        return super().read(address) ^ (1 << self.bit if self.readings in self.flips else 0)


def solves(core: FakeCore) -> None:
    core.words |= {0x100 + 4 * index: 1000 + index for index in range((core.map.SIZE - 0x100) // 4)}
    core.solved()


def refuses(core: FakeCore) -> None:
    core.words[core.map.CONDITION.ADDRESS] = 4711
    core.failed(core.map.FLAGS.encode(RANK_DEFICIENT=1, ILL_CONDITIONED=1))


@pytest.mark.parametrize("bit", [3, 5, 20])
@pytest.mark.parametrize("solve", [solves, refuses])
def test_one_upset_reading_is_not_believed(kind: Kind, solve: Callable[[FakeCore], None], bit: int) -> None:
    """Whichever reading of a frame comes back wrong, the frame's result is the right one or an error."""

    def run(flips: frozenset[int]) -> tuple[Any, int]:
        core = Flipping(kind.map, flips)
        core.bit, core.lag, core.solve = bit, 3, solve
        core.words |= {0x100 + 4 * index: 7 for index in range((core.map.SIZE - 0x100) // 4)}  # of before
        driver: Any = kind.driver(core)
        return driver.solve(kind.frame), core.readings

    expected, readings = run(frozenset())
    assert expected.failed == (solve is refuses) and readings > (80 if solve is solves else 20)
    refused = 0
    for number in range(1, readings + 1):
        try:
            assert run(frozenset((number,)))[0] == expected, number
        except BackendError:
            refused += 1
    assert refused <= 6


def test_readings_that_never_agree(kind: Kind) -> None:
    core = Flipping(kind.map)
    driver = kind.driver(core)
    address = kind.map.FRAC.ADDRESS

    def reading() -> int:
        core.words[address] = core.words.get(address, 0) + 1
        return driver.read(kind.map.FRAC)

    with pytest.raises(UpsetError, match="4 readings of the same registers differ"):
        driver.read_twice(reading)
    assert core.readings == 4


def test_a_configuration_that_does_not_stay(kind: Kind) -> None:
    core = FakeCore(kind.map)
    core.kept[kind.map.VARIANCE.ADDRESS] = 0xFFFFFFFE
    driver: Any = kind.driver(core)
    driver.write_checked(kind.map.VARIANCE, 0x10)
    with pytest.raises(UpsetError, match="VARIANCE reads 0x00000010 after 0x00000011 was written"):
        driver.write_checked(kind.map.VARIANCE, 0x11)


@pytest.mark.parametrize("solved", [True, False], ids=["solved", "given up"])
def test_an_upset_is_an_error_and_can_be_recovered_from(kind: Kind, solved: bool) -> None:
    """UPSET, in a frame that was given up or beside a result: no numbers; then a reset, and all is new."""
    core = FakeCore(kind.map)
    driver: Any = kind.driver(core)
    flag = kind.flag("UPSET")
    core.solve = lambda c: c.solved(flag) if solved else c.failed(flag)
    with pytest.raises(UpsetError, match=rf"{kind.driver.NAME} core was upset \(FLAGS: UPSET\): give the"):
        driver.solve(kind.frame)
    core.written.clear()
    core.words[kind.map.IRQ_STATUS.ADDRESS] = 3
    core.solve = FakeCore.solved
    driver.recover()
    assert core.written[0] == (kind.map.CONTROL.ADDRESS, 1) and driver.flags() == 0
    assert (kind.map.IRQ_STATUS.ADDRESS, 3) in core.written
    written = len(core.written)
    assert not driver.solve(kind.frame).failed
    assert {kind.map.FRAC.ADDRESS, kind.map.VARIANCE.ADDRESS} <= {a for a, _ in core.written[written:]}


@pytest.mark.parametrize("register", ["FLAGS", "FRAME_FLAGS"])
def test_an_upset_in_either_register(kind: Kind, register: str) -> None:
    """FLAGS may rise after the frame; FRAME_FLAGS stand where somebody else has cleared FLAGS."""
    core = FakeCore(kind.map)

    def solve(c: FakeCore) -> None:
        c.solved()
        c.words[getattr(c.map, register).ADDRESS] = kind.flag("UPSET")

    core.solve = solve
    driver: Any = kind.driver(core)
    with pytest.raises(UpsetError, match="FLAGS: UPSET"):
        driver.solve(kind.frame)


def test_a_flag_that_belies_the_result(kind: Kind) -> None:
    """FLAGS rise between the results and the look at them."""
    core = FakeCore(kind.map)
    core.solve = lambda c: c.solved(kind.flag("WATCHDOG"))
    driver: Any = kind.driver(core)
    with pytest.raises(UpsetError, match="FLAGS: WATCHDOG"):
        driver.solve(kind.frame)


@pytest.mark.parametrize("missing", ["STATE", "ALL_READY", "FRAME"])
def test_done_is_told_by_all_of_status(kind: Kind, missing: str) -> None:
    """A count that moved, a state or a ready bit alone do not make a frame."""
    core = FakeCore(kind.map)
    read, field = core.read, kind.map.STATUS.FIELDS[missing]
    value = {"STATE": int(kind.map.State.VERIFY), "ALL_READY": 0, "FRAME": 65535}[missing]

    def one_field_behind(address: int) -> int:
        word = read(address)
        return word & ~field.mask | field.put(value) if address == kind.map.STATUS.ADDRESS else word

    core.read = one_field_behind  # type: ignore[method-assign]
    driver: Any = kind.driver(core)
    with pytest.raises(BackendError, match="no result after 20 looks"):
        driver.solve(kind.frame, polls=20)
    assert core.frames == [kind.beats]


def test_an_upset_of_results_that_stood(kind: Kind) -> None:
    """The count has moved and the core has fallen back to IDLE: an error, not a frame that never ends."""
    core = FakeCore(kind.map)

    def fall_back(c: FakeCore) -> None:
        c.solved()
        c.failed(kind.flag("UPSET"))

    core.solve = fall_back
    driver: Any = kind.driver(core)
    with pytest.raises(UpsetError, match="FLAGS: UPSET"):
        driver.solve(kind.frame, polls=20)


def test_the_interrupt_is_the_frames_own(kind: Kind) -> None:
    core = FakeCore(kind.map)
    core.words[kind.map.IRQ_STATUS.ADDRESS] = 3
    driver: Any = kind.driver(core)
    driver.solve(kind.frame)
    status = kind.map.IRQ_STATUS.ADDRESS
    assert core.written.index((status, 3)) < len(core.written) and core.frames == [kind.beats]
