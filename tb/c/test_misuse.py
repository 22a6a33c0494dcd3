# SPDX-License-Identifier: Apache-2.0
"""The C driver misused, and before cores that are not as they should be: an error, never a number."""

from __future__ import annotations

import ctypes
import functools
import math
from collections.abc import Callable, Iterator
from ctypes import byref, c_double, c_int, c_int32, c_size_t, c_uint32, c_uint64, c_void_p
from typing import Any

import numpy as np
import pytest
from relnav.driver import CoreDriver, OltaeDriver
from relnav.ivisnav.driver import IvisnavDriver
from relnav.registers import Oltae

from tb.c import library
from tb.c.library import CDriver, Port, Reals, frame
from tb.sw.fake_core import FakeCore
from tb.sw.model_core import MODELS, SolvingCore

DRIVERS: dict[str, type[CoreDriver[Any]]] = {"oltae": OltaeDriver, "ivisnav": IvisnavDriver}
POLLS = c_uint32(20)
RANDOM = np.random.default_rng(3)
CLOUD = RANDOM.normal(size=(9, 6))


class Setup:
    """A core of the bit-exact model behind callbacks; `lie` replaces what any register reads."""

    def __init__(self, c: CDriver, name: str) -> None:
        self.c, self.name = c, name
        self.core = SolvingCore(DRIVERS[name], MODELS[DRIVERS[name]])
        self.map: Any = self.core.map
        self.core.words[self.map.BUILD.ADDRESS] = 0xFF
        self.lie: Callable[[int, int], int] = lambda address, word: word
        self.reads = 0
        self.failed: list[BaseException] = []  # of the callbacks: ctypes would only print them
        self._keep = library.READ(self._read), library.WRITE(self._write)
        self.port = Port(None, *self._keep, None)
        self.device: Any = library.Oltae() if name == "oltae" else library.Ivisnav()
        self.result: Any = library.OltaeResult() if name == "oltae" else library.IvisnavResult()
        self.scale: Any = library.SCALES[name]()
        self.good = self.frame()

    def _read(self, _: Any, address: int) -> int:
        self.reads += 1
        try:
            return self.lie(address, self.core.read(address)) & 0xFFFFFFFF
        except BaseException as error:
            self.failed.append(error)
            return 0

    def _write(self, _: Any, address: int, word: int) -> None:
        self.core.write(address, word)
        if address == self.map.CONTROL.ADDRESS and self.map.CONTROL.SOFT_RESET.get(word):
            self.core.open = []

    def status_is(self, status: int, address: int, word: int) -> int:
        """For `lie`: STATUS always reads this."""
        return status if address == self.map.STATUS.ADDRESS else word

    def frame(self, w: Any = None, factor: float = 1.0) -> Any:
        if self.name == "oltae":
            return frame("oltae", CLOUD[:, :3] * factor, CLOUD[:, 3:] * factor, w)
        return frame("ivisnav", CLOUD * factor, CLOUD @ np.arange(6.0) * factor, w)

    def arrays(self, given: Any) -> list[str]:
        return [name for name, _ in given._fields_ if name not in ("count", "w")]

    def call(self, name: str, *arguments: Any) -> Any:
        return getattr(self.c, f"{self.name}_{name}")(*arguments)

    def shared(self, name: str, *arguments: Any) -> Any:
        return getattr(self.c, f"relnav_{name}")(byref(self.device.core), *arguments)

    def wish(self) -> tuple[c_uint32, ...]:
        return (c_uint32(Oltae.CONFIG.encode(COVARIANCE=1)),) if self.name == "oltae" else ()

    def init(self) -> str:
        return str(self.call("init", byref(self.device), self.port))

    def configure(self, given: Any = None) -> str:
        error, self.scale, _ = self.c.choose(self.name, given or self.good)
        assert error == "OK"
        return str(self.call("configure", byref(self.device), *self.wish(), c_double(0.0), byref(self.scale)))

    def push(self, given: Any) -> str:
        return str(self.call("push_frame", byref(self.device), byref(given), byref(self.scale)))

    def fill(self, given: Any, spare: int = 0, offset: int = 0) -> str:
        """By a buffer that is exactly as long as the frame, spare beats more, behind it a guard."""
        count = getattr(self.c, f"{self.name}_beats")(byref(given)) + spare
        memory = ctypes.create_string_buffer(b"\xa5" * (8 * count + 64))
        place = ctypes.addressof(memory)
        place += -place % 8 + offset
        error = self.call("fill", byref(given), byref(self.scale), c_void_p(place), c_size_t(count))
        end = place - ctypes.addressof(memory) + 8 * count
        assert set(memory.raw[end:-1]) == {0xA5}, "written beyond the buffer"
        return str(error)

    def solve(self, given: Any = None) -> str:
        ctypes.memset(byref(self.result), 0x5A, ctypes.sizeof(self.result))
        return str(
            self.call(
                "solve",
                byref(self.device),
                byref(given or self.good),
                *self.wish(),
                c_double(0.0),
                POLLS,
                byref(self.result),
            )
        )

    def numbers(self) -> bytes:
        """All of the result but its flags."""
        return bytes(self.result)[4:]


@pytest.fixture(params=DRIVERS)
def setup(request: pytest.FixtureRequest, driver: CDriver) -> Iterator[Setup]:
    made = Setup(driver, str(request.param))
    assert made.init() == "OK"
    yield made
    assert not made.failed


def test_the_core_of_this_bench_solves(setup: Setup) -> None:
    assert setup.solve() == "OK" and setup.result.count == len(CLOUD)
    weighted = setup.frame(np.arange(9.0) + 1)
    assert setup.solve(weighted) == "OK" and setup.result.weight == 45


# --------------------------------------------------------------------------------------------------- pointers


def test_pointers_that_are_null(setup: Setup) -> None:
    """Each pointer of each function, one at a time; the core sees nothing of it."""
    assert setup.configure() == "OK"
    setup.core.written.clear()
    device, given, scale, nothing = byref(setup.device), byref(setup.good), byref(setup.scale), None
    beats, zero = (c_uint64 * 64)(), c_double(0.0)
    raw: Any = library.OltaeRaw() if setup.name == "oltae" else library.IvisnavRaw()
    points = (c_int(127),) * (1 if setup.name == "oltae" else 2)
    calls: dict[str, list[Any]] = {
        "init": [device, setup.port],
        "choose": [given, *points, scale, byref(c_size_t())],
        "configure": [device, *setup.wish(), zero, scale],
        "fill": [given, scale, beats, c_size_t(64)],
        "push_frame": [device, given, scale],
        "read_raw": [device, byref(raw)],
        "read": [device, byref(setup.result)],
        "solve": [device, given, *setup.wish(), zero, POLLS, byref(setup.result)],
    }
    reference = type(device)
    for name, arguments in calls.items():
        for place, argument in enumerate(arguments):
            if not isinstance(argument, (reference, type(beats))) or (
                name == "choose" and place == len(arguments) - 1
            ):
                continue  # a choose without a place for the row is allowed
            wrong = [*arguments[:place], nothing, *arguments[place + 1 :]]
            assert setup.call(name, *wrong) == "NULL", (name, place)
    assert not setup.core.written
    assert setup.call("choose", given, *points, scale, nothing) == "OK"
    if setup.name == "ivisnav":
        three = (c_double * 3)(1, 2, 3)
        for place in range(3):
            row: list[Any] = [three, three, (c_double * 6)()]
            row[place] = nothing
            assert setup.c.ivisnav_row(*row) == "NULL"


def test_arrays_that_are_missing(setup: Setup) -> None:
    assert setup.configure() == "OK"
    setup.core.written.clear()
    for name in setup.arrays(setup.good):
        given = setup.frame()
        setattr(given, name, Reals())
        assert setup.c.choose(setup.name, given)[0] == "NULL"
        assert setup.push(given) == setup.fill(given) == setup.solve(given) == "NULL"
        assert setup.result.flags == 0 and not any(setup.numbers())
    assert not setup.core.written


def test_ports_without_a_core(setup: Setup) -> None:
    """No address, half of the functions, an address inside a word."""
    init, read, write = f"{setup.name}_init", *setup._keep
    no_read, no_write = library.READ(), library.WRITE()
    for port, error in (
        (Port(None, no_read, no_write, None), "NULL"),
        (Port(None, read, no_write, None), "NULL"),
        (Port(None, no_read, write, None), "NULL"),
        (Port(0x43C00000, read, no_write, None), "NULL"),
        (Port(0x43C00000, no_read, write, None), "NULL"),
        (Port(0x43C00002, no_read, no_write, None), "MISALIGNED"),
    ):
        assert getattr(setup.c, init)(byref(setup.device), port) == error
    memory = (c_uint32 * 1024)()  # a memory that is no core
    assert (
        getattr(setup.c, init)(byref(setup.device), Port(ctypes.addressof(memory), no_read, no_write, None))
        == "NO_CORE"
    )
    memory[0], memory[1] = setup.map.ID.RESET, setup.map.VERSION.RESET
    assert (
        getattr(setup.c, init)(byref(setup.device), Port(ctypes.addressof(memory), no_read, no_write, None))
        == "OK"
    )


def test_buffers(setup: Setup) -> None:
    """Too short, inside a word; of frames that cannot be, also where the number of beats leaves size_t."""
    assert setup.configure() == "OK"
    assert setup.fill(setup.good) == "OK" and setup.fill(setup.good, spare=3) == "OK"
    assert setup.fill(setup.good, spare=-1) == "NO_SPACE"
    for offset in (1, 4, 7):
        assert setup.fill(setup.good, spare=1, offset=offset) == "MISALIGNED"
    for count, error in (
        (0, "EMPTY"),
        (65536, "TOO_LONG"),
        (1 << 62, "TOO_LONG"),
        (c_size_t(-1).value, "TOO_LONG"),
    ):
        given = setup.frame()
        given.count = count
        beats = (c_uint64 * 1)()
        assert setup.call("fill", byref(given), byref(setup.scale), beats, c_size_t(1)) == error
        assert setup.push(given) == setup.solve(given) == error
        assert beats[0] == 0


# ---------------------------------------------------------------------------------------------------- scales


def test_scales_of_another_frame(setup: Setup) -> None:
    """Weights that come or go, numbers that do not fit, a core that is configured for another scale."""
    weighted = setup.frame(np.arange(9.0) + 1)
    assert setup.configure() == "OK"
    pushed = len(setup.core.frames)
    if setup.name == "oltae":  # another number of beats
        assert setup.fill(weighted) == setup.push(weighted) == "WRONG_SCALE"
        assert setup.configure(weighted) == "OK"
        assert setup.fill(setup.good) == setup.push(setup.good) == "WRONG_SCALE"
    large = setup.frame(factor=1e6)
    assert setup.configure() == "OK"
    assert setup.fill(large) == setup.push(large) == "TOO_LARGE" and not setup.core.open
    for w, error in (
        (-1.0, "BAD_WEIGHT"),
        (math.nan, "BAD_WEIGHT"),
        (65536.0, "TOO_LARGE"),
        (math.inf, "TOO_LARGE"),
        (0.25, "LOST_WEIGHT"),
    ):
        weights = np.arange(9.0) + 1
        weights[5] = w
        given = setup.frame(weights)
        assert setup.configure(weighted) == "OK"
        assert setup.fill(given) == setup.push(given) == error, w
    error, other, _ = setup.c.choose(setup.name, large)
    assert error == "OK" and setup.configure() == "OK"
    setup.scale = other  # chosen, but not configured
    assert setup.push(large) == "WRONG_SCALE" and setup.fill(large) == "OK"
    halves = setup.frame((np.arange(9.0) + 1) / 2)
    error, other, _ = setup.c.choose(setup.name, halves)
    assert setup.configure(weighted) == "OK"
    setup.scale = other
    assert setup.push(halves) == "WRONG_SCALE"
    ones = setup.frame(np.ones(9))  # the same scale but for the beats
    error, other, _ = setup.c.choose(setup.name, ones)
    assert setup.configure() == "OK"
    setup.scale = other
    if setup.name == "oltae":
        assert setup.push(ones) == "WRONG_SCALE"
    assert len(setup.core.frames) == pushed
    assert setup.solve() == "OK"


def test_scales_that_are_none(setup: Setup) -> None:
    points = ["frac"] if setup.name == "oltae" else ["frac_h", "frac_y"]
    values: list[tuple[str, Any, str]] = [
        (name, bad, "BAD_FRAC") for name in points for bad in (96, -65, 2**31 - 1, -(2**31))
    ]
    values += [("weight_scale", bad, "WRONG_SCALE") for bad in (0.0, -1.0, math.nan, math.inf)]
    for name, bad, error in values:
        assert setup.configure() == "OK"
        setattr(setup.scale, name, bad)
        assert setup.push(setup.good) == setup.fill(setup.good) == error, (name, bad)
        setup.core.written.clear()
        wish = (byref(setup.device), *setup.wish(), c_double(0.0), byref(setup.scale))
        assert setup.call("configure", *wish) == error and not setup.core.written
    found = c_int32(7)
    for frac in (96, -65, 2**31 - 1, -(2**31)):
        assert (
            setup.c.relnav_to_fixed(c_double(1.0), c_int(frac), byref(found)) == "BAD_FRAC"
            and found.value == 7
        )


# ----------------------------------------------------------------------------------------------------- cores


def test_a_core_that_never_answers(setup: Setup) -> None:
    """A bounded number of readings, then TIMEOUT; it can be used again once it answers."""
    setup.core.solve = lambda core: None
    setup.reads = 0
    assert setup.solve() == "TIMEOUT" and not any(setup.numbers())
    assert setup.reads < 3 * POLLS.value + 30
    del setup.core.frames[:]
    setup.core.solve = lambda core: setup.core.compute()
    assert setup.solve() == "OK"


@pytest.mark.parametrize("word", [0, 0xFFFFFFFF], ids=["zeros", "ones"])
def test_a_bus_that_reads_one_word(setup: Setup, word: int) -> None:
    """A core that is gone, before and while it is used."""
    setup.lie = lambda address, _: word
    assert setup.init() == "NO_CORE"
    setup.lie = lambda address, found: found
    assert setup.init() == "OK" and setup.configure() == "OK" and setup.push(setup.good) == "OK"
    setup.lie = lambda address, _: word
    assert setup.shared("wait", POLLS) == "TIMEOUT"
    assert setup.call("read", byref(setup.device), byref(setup.result)) != "OK" and not any(setup.numbers())
    assert setup.solve() == setup.configure() == setup.shared("begin_push") == "NO_CORE"
    for begun in ("solve", "configure"):
        setup.lie = lambda address, found: found
        assert setup.shared("recover") == "OK" and getattr(setup, begun)() == "OK"


def _fail(flags: int, core: FakeCore) -> None:
    core.failed(flags)


def test_a_write_that_was_refused(setup: Setup) -> None:
    """BUSY_WRITE during a pushed frame: the core has other numbers than the caller's."""
    refused = setup.map.FLAGS.encode(BUSY_WRITE=1)
    write = setup.core.write

    def refuse(address: int, word: int) -> None:
        write(address, word)
        if address == setup.map.DATA_A.ADDRESS:
            setup.core.raise_flags(refused)

    core: Any = setup.core
    for also, error in ((0, "NOT_TAKEN"), (setup.map.FLAGS.encode(UPSET=1), "UPSET")):
        core.write = refuse
        setup.core.solve = functools.partial(_fail, also) if also else lambda core: setup.core.compute()
        refused |= also
        assert setup.configure() == "OK" and setup.push(setup.good) == ("OK" if also else error)
        if not also:
            reset = setup.map.CONTROL.ADDRESS, setup.map.CONTROL.encode(SOFT_RESET=1)
            assert setup.core.written[-1] == reset
        setup.core.state = setup.map.State.IDLE
        assert setup.shared("recover") == "OK"
        assert setup.solve() == error and not any(setup.numbers())
        core.write = write
        setup.core.solve = lambda core: setup.core.compute()
        setup.core.left = -1
        assert setup.shared("recover") == "OK" and setup.solve() == "OK"


def test_a_core_that_stays_in_a_frame(setup: Setup) -> None:
    """The boot recipe: a frame that was left open before keeps the core busy until relnav_recover()."""
    setup.core.state = setup.map.State(1)  # LOAD, GATHER
    assert setup.configure() == setup.shared("begin") == setup.solve() == "BUSY"
    assert setup.shared("recover") == "OK"
    reset = setup.map.CONTROL.ADDRESS, setup.map.CONTROL.encode(SOFT_RESET=1)
    assert reset in setup.core.written
    setup.core.state = setup.map.State.IDLE  # what the reset does
    assert setup.configure() == "OK" and setup.solve() == "OK"


@pytest.mark.parametrize("flag", ["RANK_DEFICIENT", "TOO_LONG", "WATCHDOG", "UPSET"])
def test_flags_that_stay(setup: Setup, flag: str) -> None:
    """A flag that cannot be cleared does not pass for the next frame's, nor for none."""
    mask = setup.map.FLAGS.encode(**{flag: 1})
    setup.lie = lambda address, word: word | mask if address == setup.map.FLAGS.ADDRESS else word
    error = "UPSET" if flag == "UPSET" else "NOT_TAKEN"
    assert setup.configure() == "OK"
    assert (
        setup.shared("begin")
        == setup.shared("begin_push")
        == setup.push(setup.good)
        == setup.solve()
        == error
    )
    assert setup.result.flags == 0 and not any(setup.numbers()) and not setup.core.frames
    setup.lie = lambda address, word: word
    assert setup.solve() == "OK"


def test_results_before_their_time(setup: Setup) -> None:
    """Nothing is read as a result before a frame is completed and verified, nor after the next was begun."""
    read = byref(setup.device), byref(setup.result)
    raw: Any = library.OltaeRaw() if setup.name == "oltae" else library.IvisnavRaw()
    assert setup.call("read", *read) == "PENDING" and not any(setup.numbers())
    assert setup.solve() == "OK" and setup.call("read", *read) == "OK"
    state = setup.map.State
    for busy in (1, 2, 4):
        setup.core.state = state(busy)
        assert setup.call("read", *read) == "PENDING" and not any(setup.numbers())
    setup.core.state = state.DONE
    assert setup.call("read", *read) == "OK"
    assert setup.configure() == "OK" and setup.shared("begin") == "OK"
    assert setup.call("read", *read) == setup.call("read_raw", byref(setup.device), byref(raw)) == "PENDING"
    # provisional results, as the core shows them in VERIFY; results taken back; a status that is none
    frame_number = setup.core.frame
    for status in (
        {"STATE": state.VERIFY, "BUSY": 1, "ALL_READY": 1, "FRAME": frame_number},
        {"STATE": state.IDLE, "BUSY": 0, "ALL_READY": 0, "FRAME": frame_number + 1},
        {"STATE": state.VERIFY, "BUSY": 1, "ALL_READY": 1, "FRAME": frame_number + 1},
    ):
        setup.lie = functools.partial(setup.status_is, setup.map.STATUS.encode(**status))
        assert setup.shared("wait", POLLS) == "TIMEOUT" and setup.call("read", *read) == "PENDING", status


def test_an_upset_and_the_same_frame_again(setup: Setup) -> None:
    """As docs/decisions/upsets.md has it: no number, configuration written again, the next frame is good."""
    assert setup.solve() == "OK"
    good = setup.numbers()
    setup.core.solve = lambda core: core.failed(setup.map.FLAGS.encode(UPSET=1))
    assert setup.solve() == "UPSET" and not any(setup.numbers())
    assert setup.result.flags == setup.map.FLAGS.encode(UPSET=1)
    last = dict(setup.core.written[-8:])
    assert (
        setup.map.FRAC.ADDRESS in last
        and setup.map.VARIANCE.ADDRESS in last
        and setup.map.CONTROL.ADDRESS in last
    )
    setup.core.solve = lambda core: setup.core.compute()
    assert setup.solve() == "OK" and setup.numbers() == good
    # solved, and taken back while it was read
    words = 0x100

    def taken_back(address: int, word: int) -> int:
        if address == words:
            setup.core.raise_flags(setup.map.FLAGS.encode(UPSET=1))
        return word

    setup.lie = taken_back
    assert setup.solve() == "UPSET" and not any(setup.numbers())
