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
from relnav.errors import BackendError, InputError
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
    core.words[kind.map.BUILD.ADDRESS] = kind.map.BUILD.encode(MANTISSA=35)
    assert driver.identify().mantissa == 35
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
    assert looks == 5


def test_a_core_that_hangs_is_given_up(kind: Kind) -> None:
    core, idled = FakeCore(kind.map, 10**9), 0

    def idle() -> None:
        nonlocal idled
        idled += 1

    driver: Any = kind.driver(core, idle)
    with pytest.raises(BackendError, match="no result after 25 looks at the core: its state is DONE"):
        driver.solve(kind.frame, polls=25)
    assert idled == 25


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
