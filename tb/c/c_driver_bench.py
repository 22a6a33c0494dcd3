# SPDX-License-Identifier: Apache-2.0
"""Runs inside the simulator: the C driver, in a thread, on core_harness. test_rtl.py starts it."""

from __future__ import annotations

import functools
import operator
import os
import random
from collections.abc import Callable, Sequence
from ctypes import byref, c_double, c_size_t, c_uint32, c_uint64
from pathlib import Path
from typing import Any

import cocotb
import numpy as np
from cocotb.clock import Clock
from cocotb.task import bridge, resume
from cocotb.triggers import ClockCycles, FallingEdge
from relnav.driver import OltaeDriver
from relnav.errors import InputError
from relnav.frames import make_frame
from relnav.ivisnav.driver import IvisnavDriver
from relnav.ivisnav.quantise import QuantisedRows
from relnav.ivisnav.raw import raw_to_result
from relnav.model.core import OltaeCore
from relnav.model.rates_core import RatesCore
from relnav.model.raw import CoreConfig, floats_of, raw_to_pose
from relnav.quantise import finest_frac, quantise, quantise_weights
from relnav.registers import Ivisnav, Oltae
from relnav.rtlsim.bus import PERIOD_NS, HarnessBus

from tb.c import library
from tb.c.library import CDriver, Port, frame
from tb.ivisnav.frames import random_rows
from tb.oltae.frames import random_frame

CORE = os.environ["CORE"]
LEAN = os.environ.get("LEAN") == "1"
FRAMES = int(os.environ["FRAMES"])
POLLS = c_uint32(400)  # with a pause in each; a solved frame takes about 60

MAP: Any = Oltae if CORE == "oltae" else Ivisnav
COVARIANCE = 0 if LEAN else Oltae.CONFIG.encode(COVARIANCE=1)


def bits(values: Any) -> bytes:
    """Doubles bit by bit, NaN as one value."""
    array = np.asarray(values, np.float64) + 0.0
    return np.where(np.isnan(array), np.nan, array).tobytes()


class Connection:
    """A port whose callbacks reach the RTL; `lies` may replace what a register's address reads."""

    def __init__(self, bus: HarnessBus) -> None:
        self.bus = bus
        self.lies: dict[int, Callable[[int], int]] = {}
        self.failed: list[BaseException] = []
        self._read, self._write = library.READ(self.read), library.WRITE(self.write)
        self.port = Port(None, self._read, self._write, None)

    def read(self, _: Any, address: int) -> int:
        try:
            if address == MAP.STATUS.ADDRESS:
                self.bus.idle()  # polling without a pause would only make the simulation longer
            word = self.bus.read(address)
            return self.lies[address](word) & 0xFFFFFFFF if address in self.lies else word
        except BaseException as error:  # ctypes would only print it
            self.failed.append(error)
            return 0

    def write(self, _: Any, address: int, word: int) -> None:
        try:
            self.bus.write(address, word)
        except BaseException as error:
            self.failed.append(error)


class Bench:
    """One core through the C driver, its model, and frames of floats."""

    def __init__(self, dut: Any) -> None:
        self.dut, self.rng = dut, random.Random(f"{CORE} {LEAN}")
        self.bus = HarnessBus(dut)
        self.line = Connection(self.bus)
        self.c = CDriver(Path(os.environ["LIBRARY"]))
        self.device: Any = library.Oltae() if CORE == "oltae" else library.Ivisnav()
        self.python: Any = (OltaeDriver if CORE == "oltae" else IvisnavDriver)(self.bus, self.bus.idle)

    def call(self, name: str, *arguments: Any) -> Any:
        """A function of this core, on this device."""
        return getattr(self.c, f"{CORE}_{name}")(byref(self.device), *arguments)

    def shared(self, name: str, *arguments: Any) -> Any:
        """A function of both cores, on this device."""
        return getattr(self.c, f"relnav_{name}")(byref(self.device.core), *arguments)

    def init(self, name: str = CORE) -> Any:
        return getattr(self.c, f"{name}_init")(byref(self.device), self.line.port)

    # ---- frames: (the C driver's, the model's)

    def pair(self, first: Any, second: Any, w: Any = None) -> tuple[Any, Any]:
        """The same floats for both."""
        if CORE == "oltae":
            return frame(CORE, first, second, w), quantise(make_frame(first, second, w))
        given = make_frame(np.zeros((len(second), 3)), np.zeros((len(second), 3)), w)
        weights, scale = quantise_weights(given)

        def point(part: Any) -> int:
            return finest_frac(float(part.min()), float(part.max()), InputError)

        points = point(first), point(second)
        integers = [
            np.rint(np.ldexp(part, p)).astype(np.int64)
            for part, p in zip((first, second), points, strict=True)
        ]
        ones = np.ones(len(second), np.int64)
        w16 = ones if weights is None else weights
        rows = QuantisedRows(integers[0], integers[1], w16, points[0], points[1], scale)
        return frame(CORE, first, second, w), rows

    def random(self, kind: str | None = None, n: int | None = None) -> tuple[Any, Any]:
        """Floats of any kind that fit a core."""
        while True:
            weighted = not LEAN and self.rng.random() < 0.5
            scale = self.rng.choice([1.0, 1.0, 0.25, 1e-3, 3e7])
            if CORE == "oltae":
                drawn: Any = random_frame(self.rng, n, weighted, kind)
            else:
                drawn = random_rows(self.rng, n, kind)
            try:
                first, second = drawn.values()
                return self.pair(first, second, drawn.w * scale if weighted else None)
            except InputError:
                continue

    def good(self, n: int | None = None) -> tuple[Any, Any]:
        """Floats that are solved for certain."""
        while True:
            pair = self.random("pose" if CORE == "oltae" else "rates", n)
            if not self.expected(pair[1], 0.0).flags:
                return pair

    def expected(self, quantised: Any, variance: float, config: int = COVARIANCE) -> Any:
        """The model's result."""
        if CORE == "oltae":
            fields = Oltae.CONFIG.decode(config)
            wishes = [bool(fields[name]) for name in ("FORBID_TURNS", "REAPPLY", "COVARIANCE")]
            wish = CoreConfig(wishes[0], wishes[1], wishes[2], variance)
            return OltaeCore(weighted=not LEAN).run(quantised, wish)
        return RatesCore().run(quantised, variance)

    # ---- driving

    def prepare(self, given: Any, variance: float = 0.0, config: int = COVARIANCE) -> Any:
        """Choose and configure; returns the scale."""
        error, scale, _ = self.c.choose(CORE, given)
        assert error == "OK", error
        wish = (c_uint32(config),) if CORE == "oltae" else ()
        assert self.call("configure", *wish, c_double(variance), byref(scale)) == "OK"
        return scale

    def solve(
        self, given: Any, variance: float = 0.0, config: int = COVARIANCE, polls: c_uint32 = POLLS
    ) -> tuple[str, Any]:
        """(error, result) of the function that does all of it, by the registers."""
        result = library.OltaeResult() if CORE == "oltae" else library.IvisnavResult()
        result.flags = 0xBAD
        wish = (c_uint32(config),) if CORE == "oltae" else ()
        return self.call("solve", byref(given), *wish, c_double(variance), polls, byref(result)), result

    def stream(self, given: Any, variance: float = 0.0, config: int = COVARIANCE) -> str:
        """The same by a buffer of beats; returns the error of waiting."""
        scale = self.prepare(given, variance, config)
        beats = self.c.fill(CORE, given, scale)
        assert self.shared("begin") == "OK"
        self.bus.stream(beats)
        return str(self.shared("wait", POLLS))

    def raw(self) -> Any:
        words = library.OltaeRaw() if CORE == "oltae" else library.IvisnavRaw()
        assert self.call("read_raw", byref(words)) == "OK"
        return words

    def result(self) -> Any:
        found = library.OltaeResult() if CORE == "oltae" else library.IvisnavResult()
        assert self.call("read", byref(found)) == "OK"
        return found

    # ---- comparing

    def same_words(self, raw: Any, expected: Any, config: int) -> None:
        """Result words, bit for bit the model's."""
        if CORE == "oltae":
            count = 34 if config & COVARIANCE else 22
            assert list(raw.words)[:count] == expected.result_words()[:count]
            assert list(raw.head)[:3] == [expected.points, expected.weight, expected.turn]
        else:
            assert list(raw.words) == list(expected.words)
            assert list(raw.head)[:3] == [expected.n, expected.weight, expected.condition_word]
        assert raw.flags == expected.flags

    def same_numbers(self, found: Any, expected: Any, quantised: Any, config: int) -> None:
        """The caller's numbers, bit for bit those of the Python package."""
        if CORE == "ivisnav":
            rates = raw_to_result(expected, 0, quantised)
            assert bits(found.v) == bits(rates.v) and bits(found.omega) == bits(rates.omega)
            assert bits(found.rss) == bits(rates.rss) and found.condition == rates.condition
            assert bits(found.covariance) == bits(floats_of(expected.words[7:]))
            return
        pose = raw_to_pose(expected, 0, quantised)
        assert pose.R is not None
        if pose.q is not None:
            assert bits(found.q) == bits(pose.q)
        assert list(found.q_fixed) == list(expected.q_fixed)
        assert bits(found.rotation) == bits(pose.R.ravel()) and bits(found.translation) == bits(pose.t)
        for name in ("rss", "condition", "determinant", "weight"):
            assert bits(getattr(found, name)) == bits(getattr(pose, name)), name
        upper = np.triu_indices(3)
        for name in ("q_cov", "t_cov"):
            covariance = getattr(pose, name) if config & COVARIANCE else None
            wanted = np.zeros(6) if covariance is None else covariance[upper]
            assert bits(getattr(found, name)) == bits(wanted), name


def in_thread(test: Callable[[Bench], None]) -> Any:
    """A cocotb test of a function that blocks: reset, the function in a thread, no error swallowed."""

    async def run(dut: Any) -> None:
        dut.go.value = 0
        dut.gap.value = 0
        dut.rst.value = 1
        bench = Bench(dut)
        Clock(dut.clk, PERIOD_NS, "ns").start()
        await ClockCycles(dut.clk, 4)
        await FallingEdge(dut.clk)
        dut.rst.value = 0

        @bridge
        def drive() -> None:
            assert bench.init() == "OK"
            test(bench)
            assert not bench.line.failed, bench.line.failed

        await drive()

    run.__name__ = run.__qualname__ = test.__name__
    run.__doc__ = test.__doc__
    return cocotb.test()(run)


# ---------------------------------------------------------------------------------------------------- tests


@in_thread
def frames(bench: Bench) -> None:
    """Frames of every kind by both ways of feeding: words, numbers and errors are the model's."""
    errors: dict[str, int] = {}
    cloud = np.array([[9.0, 2, -3], [-4, 8, 1], [5, -6, 7], [1, 1, -9]])
    for number in range(FRAMES):
        given, quantised = bench.random() if number % 3 else bench.good()
        if number == 0 and CORE == "oltae":  # by 180 degrees about z: q is infinite
            given, quantised = bench.pair(cloud, cloud * [-1, -1, 1])
        variance = bench.rng.choice([0.0, 0.0, 1.0, 2.5e-7])
        config = COVARIANCE
        if CORE == "oltae" and not LEAN:
            config = bench.rng.choice([COVARIANCE, 0, Oltae.CONFIG.encode(COVARIANCE=1, REAPPLY=1)])
        if CORE == "oltae":
            config |= Oltae.CONFIG.encode(FORBID_TURNS=bench.rng.random() < 0.2)
        expected = bench.expected(quantised, variance, config)
        if number % 2:
            error, found = bench.solve(given, variance, config)
        else:
            error = bench.stream(given, variance, config)
            found = bench.result() if error == "OK" else None
        errors[error] = errors.get(error, 0) + 1
        assert (error != "OK") == expected.failed, (error, expected.flag_names)
        if error == "OK":
            bench.same_words(bench.raw(), expected, config)
            bench.same_numbers(found, expected, quantised, config)
            assert found.cycles_all > 0 and found.count == given.count
        else:
            names = {"FEW_ROWS": "TOO_FEW", "FEW_POINTS": "TOO_FEW"}
            assert error in {names.get(name, name) for name in expected.flag_names}
            assert bench.shared("frame_flags") == expected.flags
            assert found is None or found.flags == expected.flags
    assert errors["OK"] > FRAMES // 3, errors


@in_thread
def python_driver(bench: Bench) -> None:
    """One frame by the Python driver: the same registers, flags and cycles."""
    given, quantised = bench.good()
    for feed in ("stream", "registers"):
        if CORE == "oltae":
            other = bench.python.solve(quantised, CoreConfig(covariance=not LEAN), feed=feed)
        else:
            other = bench.python.solve(quantised, feed=feed)
        assert bench.stream(given) == "OK" if feed == "stream" else bench.solve(given)[0] == "OK"
        raw, found = bench.raw(), bench.result()
        bench.same_words(raw, other, COVARIANCE)
        assert found.cycles_all == other.cycles_all
        if CORE == "oltae":
            assert (found.cycles_q, found.cycles_pose) == (other.cycles_q, other.cycles_pose)
        else:
            assert found.cycles_rates == other.cycles_rates


@in_thread
def identity(bench: Bench) -> None:
    """A port without the core, the other core's driver, another version."""
    other = "ivisnav" if CORE == "oltae" else "oltae"
    nothing = Port(None, library.READ(lambda _, __: 0), library.WRITE(lambda _, __, ___: None), None)
    assert getattr(bench.c, f"{CORE}_init")(byref(bench.device), nothing) == "NO_CORE"
    assert bench.init(other) == "NO_CORE"
    for change, error in ((0x000100, "WRONG_VERSION"), (0x010000, "WRONG_VERSION"), (0x000001, "OK")):
        bench.line.lies = {MAP.VERSION.ADDRESS: functools.partial(operator.xor, change)}
        assert bench.init() == error
    bench.line.lies = {}
    assert bench.init() == "OK"
    assert bench.device.core.build == bench.python.read(MAP.BUILD)


@in_thread
def failures(bench: Bench) -> None:
    """Each flag that gives a frame up is its error; the next frame is as good as any."""
    least = 3 if CORE == "oltae" else 6

    def fails(pair: tuple[Any, Any], name: str) -> None:
        assert bench.solve(pair[0])[0] == name
        assert bench.stream(pair[0]) == name
        assert bench.solve(bench.good()[0])[0] == "OK"

    width = 3 if CORE == "oltae" else 6
    cloud = np.random.default_rng(1).normal(size=(least + 3, width))
    second = cloud[::-1].copy() if CORE == "oltae" else cloud @ np.arange(6.0)
    fails(bench.pair(cloud[: least - 1], second[: least - 1]), "TOO_FEW")
    fails(bench.pair(cloud[:1], second[:1]), "TOO_FEW")
    flat = cloud.copy()
    flat[:, 1:] = flat[:, :1]
    fails(bench.pair(flat, second if CORE == "ivisnav" else flat + 1), "RANK_DEFICIENT")
    if not LEAN:
        fails(bench.pair(cloud, second, np.zeros(len(cloud))), "ZERO_WEIGHT")
    if CORE == "ivisnav":
        for size in (1e-2, 3e-3, 1e-3, 3e-4, 1e-4):
            thin = cloud.copy()
            thin[:, 5] = thin[:, 4] + size * thin[:, 5]
            pair = bench.pair(thin, second)
            expected = bench.expected(pair[1], 0.0)
            if expected.flag_names == ("ILL_CONDITIONED",):
                break
        fails(pair, "ILL_CONDITIONED")
        _, found = bench.solve(pair[0])
        assert found.condition > 2000 and found.condition == raw_to_result(expected, 0, pair[1]).condition

    # the last beat inside a row
    given, _ = bench.good()
    bench.prepare(given)
    assert bench.shared("begin_push") == "OK"
    for number in range(5):
        bench.shared("push", c_uint64(number), int(number == 4))
    assert bench.shared("wait", POLLS) == "BAD_TLAST"
    assert bench.solve(given)[0] == "OK"


@in_thread
def refused(bench: Bench) -> None:
    """What is refused before the core sees it; nothing is given to it, and it works on."""
    given, _ = bench.good()
    empty = frame(CORE, *((np.zeros((0, 3)),) * 2 if CORE == "oltae" else (np.zeros((0, 6)), np.zeros(0))))
    assert bench.solve(empty)[0] == "EMPTY"
    scale = bench.prepare(given)
    assert bench.call("push_frame", byref(empty), byref(scale)) == "EMPTY"
    for variance in (-1.0, 1e300, 1e-300, float("nan")):
        error, result = bench.solve(given, variance)
        assert error == "BAD_VARIANCE" and result.flags == 0
    # a scale of another frame, which the last value does not fit: the push stops, the frame is dropped
    scale = bench.prepare(given)
    last = given.b if CORE == "oltae" else given.y
    place = 3 * given.count - 1 if CORE == "oltae" else given.count - 1
    kept, last.doubles[place] = last.doubles[place], 2.0**100
    before = bench.shared("status") >> 16
    assert bench.call("push_frame", byref(given), byref(scale)) == "TOO_LARGE"
    assert not MAP.STATUS.BUSY.get(bench.shared("status")) and bench.shared("status") >> 16 == before
    last.doubles[place] = kept
    assert bench.solve(given)[0] == "OK"


@in_thread
def busy(bench: Bench) -> None:
    """A core with an open frame refuses configuration, begin and push; timeouts; recovery."""
    given, quantised = bench.good()
    scale = bench.prepare(given)
    assert bench.shared("begin_push") == "OK" and bench.shared("poll") == "PENDING"
    assert bench.shared("wait", c_uint32(0)) == "TIMEOUT"
    bench.shared("push", c_uint64(0), 0)
    assert bench.shared("wait", c_uint32(5)) == "TIMEOUT"
    wish = (c_uint32(COVARIANCE),) if CORE == "oltae" else ()
    assert bench.call("configure", *wish, c_double(0.0), byref(scale)) == "BUSY"
    assert bench.shared("begin") == "BUSY" and bench.shared("begin_push") == "BUSY"
    assert bench.call("push_frame", byref(given), byref(scale)) == "BUSY"
    assert bench.solve(given)[0] == "BUSY"
    bench.shared("soft_reset")
    assert bench.solve(given, polls=c_uint32(1))[0] == "TIMEOUT"
    assert bench.solve(given)[0] == "OK"
    for name in ("TIMEOUT", "BUSY", "UPSET", "OK"):
        bench.prepare(given)
        assert bench.shared("begin_push") == "OK"
        bench.shared("push", c_uint64(0), 0)  # an open frame, which only a recovery drops
        assert bench.shared("settle", library.ERRORS.index(name)) == name
        busy = MAP.STATUS.BUSY.get(bench.shared("status"))
        assert busy == (name in ("BUSY", "OK"))
        bench.shared("soft_reset")
    bench.shared("soft_reset")
    # a push that the core, which is solving, refuses; its frame is dropped, and the next one is solved
    scale = bench.prepare(given)
    assert bench.call("push_frame", byref(given), byref(scale)) == "OK" and bench.shared("end_push") == "OK"
    bench.shared("push", c_uint64(1), 0)
    assert bench.shared("end_push") == "NOT_TAKEN" and bench.shared("wait", c_uint32(5)) == "TIMEOUT"
    assert bench.solve(given)[0] == "OK"
    bench.line.lies = {MAP.STATUS.ADDRESS: lambda word: word & ~MAP.STATUS.PUSH_READY.mask}
    assert bench.shared("begin_push") == "BUSY"
    bench.line.lies = {}
    # the configuration is lost, and comes back
    bench.prepare(given, 0.5)
    fracs, variance = bench.python.read(MAP.FRAC), bench.python.read(MAP.VARIANCE)
    for register in (MAP.FRAC, MAP.VARIANCE, *([Oltae.CONFIG] if CORE == "oltae" else [])):
        bench.python.write(register, 0)
    assert bench.shared("recover") == "OK"
    assert (bench.python.read(MAP.FRAC), bench.python.read(MAP.VARIANCE)) == (fracs, variance)
    assert bench.stream(given, 0.5) == "OK"
    bench.same_words(bench.raw(), bench.expected(quantised, 0.5), COVARIANCE)


@in_thread
def upsets(bench: Bench) -> None:
    """Readings that change, protections' flags, registers that lose words, another frame's count."""
    given, _ = bench.good()
    lies, rng = bench.line.lies, bench.rng
    assert bench.solve(given)[0] == "OK"
    result = bench.result()
    whole = bytes(result)
    first = MAP.Q.ADDRESS if CORE == "oltae" else MAP.V.ADDRESS

    def once(bit: int) -> Callable[[int], int]:
        """One reading with a wrong bit."""
        left = [1]
        return lambda word: word ^ (left.pop() << bit if left else 0)

    for address in (first, first + 8, MAP.FRAME_FLAGS.ADDRESS, MAP.WEIGHT.ADDRESS, MAP.CYCLES_ALL.ADDRESS):
        lies[address] = once(rng.randrange(16))
        assert bytes(bench.result()) == whole  # noticed and read again
        lies[address] = lambda word: word ^ rng.getrandbits(32)
        assert bench.call("read", byref(result)) == "UNSTEADY"
        del lies[address]

    # STATUS: one wrong reading is no new frame
    assert bench.shared("begin") == "OK"
    for bit in (16, 20, 31):  # the core is still in the last frame's DONE
        lies[MAP.STATUS.ADDRESS] = once(bit)
        assert bench.shared("poll") == "PENDING"
    lies[MAP.STATUS.ADDRESS] = once(16)
    assert bench.shared("wait", c_uint32(3)) == "TIMEOUT"
    del lies[MAP.STATUS.ADDRESS]
    lies[MAP.FLAGS.ADDRESS] = once(8)
    assert bench.shared("wait", c_uint32(3)) == "TIMEOUT"

    # STATUS: another frame's number alone is no result
    for change in (1 << 16 | MAP.STATUS.ALL_READY.mask, 1 << 16 | 1, 1 << 16 | 2, 1 << 16 | 7):
        lies[MAP.STATUS.ADDRESS] = functools.partial(operator.xor, change)
        assert bench.shared("poll") == "PENDING"
    lies[MAP.STATUS.ADDRESS] = functools.partial(operator.xor, 1 << 16)
    assert bench.shared("poll") == "OK"
    lies.clear()

    # the protections' flags, before, during and after a frame
    for name in ("UPSET", "WATCHDOG"):
        assert bench.shared("begin") == "OK"
        lies[MAP.FLAGS.ADDRESS] = functools.partial(operator.or_, MAP.FLAGS.encode(**{name: 1}))
        assert bench.shared("poll") == name
        assert bench.call("read", byref(result)) == name
        if name == "UPSET":
            assert bench.shared("begin") == "UPSET"
        lies.clear()
        assert bench.shared("recover") == "OK"
        assert bench.solve(given)[0] == "OK"

    for register in (MAP.FRAC, MAP.VARIANCE, *([Oltae.CONFIG] if CORE == "oltae" else [])):
        lies[register.ADDRESS] = lambda word: word ^ 2
        assert bench.solve(given)[0] == "NOT_TAKEN" and bench.shared("recover") == "NOT_TAKEN"
        lies.clear()
    lies[(MAP.POINTS if CORE == "oltae" else MAP.ROWS).ADDRESS] = lambda word: word + 1
    assert bench.solve(given)[0] == "WRONG_FRAME"
    lies.clear()
    assert bench.solve(given)[0] == "OK"


@in_thread
def verified(bench: Bench) -> None:
    """Results that stand but are not verified yet are not read, and waiting goes on."""
    given, quantised = bench.good()
    assert bench.solve(given)[0] == "OK"
    scale = bench.prepare(given)
    assert bench.call("push_frame", byref(given), byref(scale)) == "OK"
    seen = False
    while (status := MAP.STATUS.decode(bench.shared("status")))["BUSY"]:
        if status["ALL_READY"] and not seen:  # VERIFY takes some hundred clocks
            seen = MAP.State(status["STATE"]).name == "VERIFY"
            assert bench.shared("confirm") == "PENDING" == bench.shared("poll")
            assert MAP.STATUS.BUSY.get(bench.shared("status")), "too late to tell"
    assert seen == bool(bench.device.core.build & MAP.BUILD.VERIFY.mask) == (not LEAN)
    assert bench.shared("wait", POLLS) == "OK"
    bench.same_words(bench.raw(), bench.expected(quantised, 0.0), COVARIANCE)


def flipped(bench: Bench) -> None:
    """A configuration bit flips: no frame is solved until the configuration is written again."""
    given, quantised = bench.good()
    assert bench.solve(given, 0.5)[0] == "OK"
    held = bench.dut.top.registers.common.config_variance

    @resume
    async def flip() -> None:
        await FallingEdge(bench.dut.clk)
        held.value = int(held.value) ^ 1 << 30

    for meanwhile in (False, True):  # before a frame, and while one is loaded
        scale = bench.prepare(given, 0.5)
        if meanwhile:
            assert bench.shared("begin_push") == "OK"
            bench.shared("push", c_uint64(1), 0)
            flip()
            assert bench.shared("wait", POLLS) == "UPSET"
        else:
            flip()
        assert bench.shared("begin") == "UPSET"
        assert bench.call("push_frame", byref(given), byref(scale)) == "UPSET"
        assert bench.shared("recover") == "OK"
        assert bench.solve(given, 0.5)[0] == "OK"
        bench.same_words(bench.raw(), bench.expected(quantised, 0.5), COVARIANCE)


if os.environ["SIMULATOR"] == "icarus":  # the other shows no register of the core in this build
    flipped_configuration = in_thread(flipped)


@in_thread
def interrupts(bench: Bench) -> None:
    """The line rises for the events that were enabled and falls when they are taken."""
    given, _ = bench.good()
    few = frame(CORE, [[1.0] * (3 if CORE == "oltae" else 6)], [[2.0] * 3] if CORE == "oltae" else [2.0])
    irq = bench.dut.irq

    def runs(pair: Sequence[tuple[Any, str]], events: int, raised: list[int]) -> None:
        bench.shared("enable_interrupts", c_uint32(events))
        for (one, error), wanted in zip(pair, raised, strict=True):
            assert bench.solve(one)[0] == error
            assert int(irq.value) == int(bool(wanted & events)), (error, events)
            assert bench.shared("take_interrupt") == wanted
            bench.shared("clear_flags", c_uint32(0xFFFFFFFF))
            bench.bus.idle()
            assert int(irq.value) == 0 and bench.shared("take_interrupt") == 0

    bench.shared("take_interrupt")
    both = [(given, "OK"), (few, "TOO_FEW")]
    for events in (0, 1, 2, 3):
        runs(both, events, [1, 2])
    assert bench.solve(given)[0] == "OK"
    bench.shared("acknowledge")
    bench.bus.idle()
    assert MAP.STATUS.STATE.get(bench.shared("status")) == 0
    assert bench.shared("flags") == 0


def built(bench: Bench) -> None:
    """What this build has not is refused, and the core is left as it was."""
    given, _ = bench.good()
    _, scale, _ = bench.c.choose(CORE, given)
    before = bench.python.read(Oltae.CONFIG)
    for name in ("COVARIANCE", "REAPPLY"):
        wish = c_uint32(Oltae.CONFIG.encode(**{name: 1}))
        error = bench.call("configure", wish, c_double(0.0), byref(scale))
        assert error == ("NOT_BUILT" if LEAN else "OK")
    scale.weighted = 1
    error = bench.call("configure", c_uint32(0), c_double(0.0), byref(scale))
    assert error == ("NOT_BUILT" if LEAN else "OK")
    if LEAN:
        assert bench.python.read(Oltae.CONFIG) == before and bench.shared("flags") == 0
    weighted = frame(CORE, np.eye(3), np.eye(3), [1, 2, 3])
    assert bench.solve(weighted, 0.0, 0)[0] in (("NOT_BUILT",) if LEAN else ("OK", "RANK_DEFICIENT"))
    assert bench.call("read_raw", byref(library.OltaeRaw())) == ("PENDING" if LEAN else "OK")
    assert c_size_t(bench.c.oltae_beats(byref(weighted))).value == 12


if CORE == "oltae":  # the other core has nothing to leave out
    built_options = in_thread(built)
