# SPDX-License-Identifier: Apache-2.0
"""oltae_top through its ports alone, against the bit-exact model: frames, flags, resets, interrupts.

The driver of the product drives it, in a thread. Frames follow one another without a reset.
"""

from __future__ import annotations

import logging
import os
import random
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, replace
from typing import Any, TypeVar

import cocotb
import numpy as np
from cocotb.task import bridge, resume
from cocotb.triggers import ClockCycles, FallingEdge, RisingEdge
from cocotbext.axi import AxiStreamBus, AxiStreamFrame, AxiStreamSource
from relnav.driver import Feed, OltaeDriver, beats_of
from relnav.model.core import OltaeCore
from relnav.model.raw import RESULT_WORDS, CoreConfig, RawResult
from relnav.quantise import QuantisedFrame
from relnav.registers import Oltae
from relnav.result import FLAG_NAMES
from relnav.rtlsim.bus import RegisterBus

from tb.common import axil, clocks
from tb.oltae.frames import random_config, random_frame

FULL = os.environ.get("FULL", "1") == "1"
FRAMES = int(os.environ.get("FRAMES", "40"))
State = Oltae.State
T = TypeVar("T")


class Bus(RegisterBus):
    """The registers, and the stream through cocotbext-axi's source."""

    def __init__(self, dut: Any) -> None:
        super().__init__(dut)
        logging.getLogger(f"cocotb.{dut._name}.s_axis").setLevel(logging.WARNING)
        self.source = AxiStreamSource(AxiStreamBus.from_prefix(dut, "s_axis"), dut.clk, dut.rst, byte_size=64)

    @resume
    async def stream(self, beats: Sequence[int]) -> None:
        """Queue a frame: as a DMA does, this returns before the core has taken it."""
        await self.source.send(AxiStreamFrame(list(beats)))


class Bench:
    """The core after a reset, with the driver, the model and a monitor of its events."""

    def __init__(self, dut: Any, seed: int) -> None:
        self.dut = dut
        self.rng = random.Random(seed)
        self.bus = Bus(dut)
        self.driver = OltaeDriver(self.bus)
        self.model = OltaeCore(weighted=FULL)
        self.last = RawResult()  # what the registers show
        self.clock = 0
        self.beats = 0
        self.events: dict[str, int] = {}

    async def begin(self) -> Bench:
        cocotb.start_soon(self._watch())
        await clocks.start(self.dut)
        await clocks.tick(self.dut, 2)
        self.last = await self.standing()  # memory is not reset: what the test before left
        assert (self.last.points, self.last.weight, self.last.cycles_all) == (0, 0, 0)
        return self

    async def _watch(self) -> None:
        """Clock of the last beat taken from the stream and of each ready bit's rise."""
        dut = self.dut
        before = dict.fromkeys(("q_ready", "pose_ready", "all_ready"), 0)
        while True:
            await FallingEdge(dut.clk)
            self.clock += 1
            if dut.s_axis_tvalid.value == 1 and dut.s_axis_tready.value == 1:
                self.beats += 1
                if dut.s_axis_tlast.value == 1:
                    self.events = {"last": self.clock}
            for name in before:
                now = int(getattr(dut, name).value == 1)
                if now and not before[name]:
                    self.events[name] = self.clock
                before[name] = now

    def pauses(self) -> None:
        """Random idle clocks and back-pressure on every AXI channel."""
        axil.random_pauses(self.bus.axil, self.rng)
        share, seed = self.rng.choice([0.0, 0.3, 0.8]), self.rng.getrandbits(32)

        def idle() -> Iterator[bool]:
            mine = random.Random(seed)
            while True:
                yield mine.random() < share

        self.bus.source.set_pause_generator(idle())

    def no_pauses(self) -> None:
        axil.no_pauses(self.bus.axil)
        self.bus.source.clear_pause_generator()
        self.bus.source.pause = False

    def state(self) -> State:
        return State(int(self.dut.state.value))

    async def drive(self, work: Callable[[OltaeDriver], T]) -> T:
        """Do something with the driver."""
        return await bridge(work)(self.driver)

    async def solve(
        self, frame: QuantisedFrame, config: CoreConfig | None = None, feed: Feed = "stream"
    ) -> RawResult:
        """Run a frame, compare everything with the model, remember what stands in the registers."""
        config = config or CoreConfig(covariance=FULL)
        polls = 500 + frame.n
        got = await self.drive(lambda driver: driver.solve(frame, config, feed=feed, polls=polls))
        expected = self.model.run(frame, config)
        assert got.flag_names == expected.flag_names, tell(frame, config)
        if expected.failed:
            await self.unchanged()
            return got
        assert got.cycles_q is not None and got.cycles_pose is not None and got.cycles_all is not None
        assert 0 < got.cycles_q < got.cycles_pose <= got.cycles_all
        if feed == "stream":
            for name, counted in zip(
                ("q", "pose", "all"), (got.cycles_q, got.cycles_pose, got.cycles_all), strict=True
            ):
                assert self.events[f"{name}_ready"] - self.events["last"] - 1 == counted, name
        wrong = differences(got, expected)
        assert not wrong, f"{wrong} of {tell(frame, config)}"
        self.last = got
        return got

    async def standing(self) -> RawResult:
        """The result registers, whatever they hold."""
        return await self.drive(OltaeDriver.result)

    async def unchanged(self) -> None:
        """The results of the last frame that was solved still stand, all of them."""
        now = await self.standing()
        assert replace(now, flags=0) == replace(self.last, flags=0)

    async def flags(self) -> tuple[set[str], set[str]]:
        """Names in FLAGS and in FRAME_FLAGS."""

        def names(word: int) -> set[str]:
            return {name for bit, name in enumerate(FLAG_NAMES) if word >> bit & 1}

        sticky, frame = await self.drive(lambda d: (d.flags(), d.read(Oltae.FRAME_FLAGS)))
        return names(sticky), names(frame)


def differences(got: RawResult, expected: RawResult) -> dict[str, tuple[object, object]]:
    """What the core and the model say differently; the model counts no cycles, None is not computed."""
    mine, model = asdict(got), asdict(expected)
    skipped = {name for name in mine if "cycles" in name or mine[name] is None}
    return {name: (mine[name], model[name]) for name in mine.keys() - skipped if mine[name] != model[name]}


def tell(frame: QuantisedFrame, config: CoreConfig) -> str:
    """Everything to run it again."""
    points = "" if frame.n > 20 else f" a={frame.a.tolist()} b={frame.b.tolist()}"
    weights = None if frame.w is None else frame.w.tolist()[:20]
    return f"{config} n={frame.n} frac={frame.frac}{points} w={weights}"


def good(rng: random.Random, n: int = 4, weights: bool = False) -> QuantisedFrame:
    """A frame that is solved for certain."""
    while True:
        frame = random_frame(rng, n, weights, "pose")
        if not OltaeCore(weighted=FULL).run(frame).flags:
            return frame


@cocotb.test()
async def frames_on_every_channel(dut: Any) -> None:
    """Random frames, by stream and by registers, with pauses everywhere; the bus keeps its rules."""
    bench = await Bench(dut, 1).begin()
    axil.Monitor(dut)
    cycles: dict[bool, set[tuple[int | None, ...]]] = {False: set(), True: set()}
    seen: set[str] = set()
    turns: set[int] = set()
    for number in range(FRAMES):
        if number % 8 == 0:
            bench.pauses()
        frame = random_frame(bench.rng, weights=None if FULL else False)
        config = replace(random_config(bench.rng), covariance=FULL)
        feed: Feed = "registers" if number % 4 == 1 else "stream"
        got = await bench.solve(frame, config, feed)
        seen |= set(got.flag_names)
        if not got.failed:
            cycles[frame.w is not None].add((got.cycles_q, got.cycles_pose, got.cycles_all))
            turns.add(got.turn)
    assert all(len(found) <= 1 for found in cycles.values()), "the latency depends on the frame"
    dut._log.info("cycles %s, flags seen %s", cycles, seen)
    assert turns == {0, 1, 2, 3}


@cocotb.test()
async def one_frame_of_a_thousand(dut: Any) -> None:
    """n = 1000 at the full rate, then 3 again."""
    bench = await Bench(dut, 2).begin()
    for n, weights in ((1000, False), (3, FULL), (1000 if FULL else 3, FULL), (4, False)):
        start = bench.beats
        await bench.solve(random_frame(bench.rng, n, weights, "pose"))
        assert bench.beats - start == n * (4 if weights else 3)


@cocotb.test()
async def every_flag(dut: Any) -> None:
    """Each error is raised alone, leaves the results, is cleared, and the next frame is as good as any."""
    bench = await Bench(dut, 3).begin()
    rng = bench.rng
    await bench.drive(OltaeDriver.identify)
    await bench.drive(lambda d: d.enable_interrupts(error=True))
    await bench.solve(good(rng))
    line = np.outer(np.arange(5), [3, -1, 2]).astype(np.int64)
    spot = np.full((4, 3), 7, dtype=np.int64)
    cloud = np.array([[9, 2, -3], [-4, 8, 1], [5, -6, 7], [1, 1, -9]], dtype=np.int64) << 24
    turned = cloud @ np.diag([-1, -1, 1])  # by 180 degrees about z
    nearly = turned + np.eye(4, 3, dtype=np.int64)
    cases: list[tuple[str, QuantisedFrame, CoreConfig]] = []
    plain = CoreConfig(covariance=FULL)
    for name, a, b in (("few", cloud[:2], cloud[:2]), ("one", cloud[:1], cloud[:1])):
        cases.append(("FEW_POINTS", QuantisedFrame(a, b, None, 0), plain))
    cases.append(("RANK_DEFICIENT", QuantisedFrame(line, line + 5, None, 3), plain))
    cases.append(("RANK_DEFICIENT", QuantisedFrame(spot, spot, None, 3), plain))
    cases.append(
        ("RANK_DEFICIENT", QuantisedFrame(cloud, turned, None, 20), replace(plain, forbid_turns=True))
    )
    cases.append(("Q_SATURATED", QuantisedFrame(cloud, turned, None, 20), plain))
    cases.append(("Q_SATURATED", QuantisedFrame(cloud, nearly, None, 20), plain))
    thin = cloud >> [0, 11, 11]
    cases.append(("ILL_CONDITIONED", QuantisedFrame(thin, thin, None, 20), plain))
    if FULL:
        zero = np.zeros(4, dtype=np.int64)
        cases.append(("ZERO_WEIGHT", QuantisedFrame(cloud, cloud, zero, 20), plain))
        one = np.array([0, 5, 0, 0], dtype=np.int64)
        cases.append(("RANK_DEFICIENT", QuantisedFrame(cloud, cloud, one, 20), plain))
    for name, frame, config in cases:
        got = await bench.solve(frame, config)
        assert name in got.flag_names, (name, got.flag_names)
        await raised_and_cleared(bench, set(got.flag_names))

    for beats, name in (
        (cut(good(rng), -1), "BAD_TLAST"),
        (cut(good(rng), -2), "BAD_TLAST"),
        (cut(good(rng), 1), "BAD_TLAST"),
    ):
        ticket = await bench.drive(lambda d, b=beats: configured(d).feed(b))
        assert not await bench.drive(lambda d, t=ticket: d.wait(t, 200))
        await raised_and_cleared(bench, {name})

    # TOO_LONG: the counter is set as if 65533 points had come; swallowed to the end
    bench.bus.source.pause = True
    beats = beats_of(good(rng, 6))
    ticket = await bench.drive(lambda d: configured(d).feed(beats))
    await reached(bench, 3)
    dut.loader.count.value = 65533
    bench.bus.source.pause = False
    assert not await bench.drive(lambda d: d.wait(ticket, 200))
    await raised_and_cleared(bench, {"TOO_LONG"})

    # WATCHDOG: as if 2040 clocks had gone by
    ticket = await bench.drive(lambda d: configured(d).feed(beats_of(good(rng))))
    while bench.state() != State.COMPUTE:
        await FallingEdge(dut.clk)
    dut.core.cycles.value = 2040
    assert not await bench.drive(lambda d: d.wait(ticket, 200))
    await raised_and_cleared(bench, {"WATCHDOG"})

    await busy_writes(bench)
    await not_built(bench)


async def raised_and_cleared(bench: Bench, names: set[str]) -> None:
    """Exactly these flags are up, the interrupt too; after clearing, none; the results stand; a frame works."""
    sticky, frame = await bench.flags()
    assert sticky == frame == names
    if names.isdisjoint({"Q_SATURATED", "ILL_CONDITIONED", "BUSY_WRITE"}):
        assert bench.state() == State.IDLE
        await bench.unchanged()
    assert bench.dut.irq.value == 1
    assert (await bench.drive(OltaeDriver.clear_interrupts))[1]
    await clocks.tick(bench.dut, 2)
    assert bench.dut.irq.value == 0
    await bench.drive(OltaeDriver.clear_flags)
    assert await bench.flags() == (set(), names)  # FRAME_FLAGS stay until the next frame
    await bench.solve(good(bench.rng))
    assert await bench.flags() == (set(), set())


async def busy_writes(bench: Bench) -> None:
    """CONFIG, FRAC, VARIANCE of a busy core and a push beside an open stream frame are ignored."""
    frame = good(bench.rng)
    expected = bench.model.run(frame, CoreConfig(covariance=FULL))
    for register in (Oltae.CONFIG, Oltae.FRAC, Oltae.VARIANCE, Oltae.PUSH):
        beats = beats_of(frame)
        await bench.drive(lambda d, f=frame.frac: configured(d, f))
        before = await bench.drive(lambda d, r=register: d.read(r))
        bench.bus.source.pause = True
        ticket = await bench.drive(lambda d, b=beats: d.feed(b))
        await reached(bench, 2)
        await bench.drive(lambda d, r=register: d.write(r, 0x5))
        bench.bus.source.pause = False
        assert await bench.drive(lambda d, t=ticket: d.wait(t, 200))
        assert await bench.drive(lambda d, r=register: d.read(r)) == before
        got = await bench.standing()
        assert got.result_words() == expected.result_words() and got.flag_names == ("BUSY_WRITE",)
        bench.last = got
        await raised_and_cleared(bench, {"BUSY_WRITE"})


async def not_built(bench: Bench) -> None:
    """What this build has not is named by the write and by the frame; the full build has all but nothing."""
    wish = Oltae.CONFIG.encode(WEIGHTED=1, REAPPLY=1, COVARIANCE=1)
    await bench.drive(lambda d: d.write(Oltae.CONFIG, wish))
    kept = await bench.drive(lambda d: d.read(Oltae.CONFIG))
    assert kept == (wish if FULL else 0)
    assert (await bench.flags())[0] == (set() if FULL else {"NOT_BUILT"})
    await bench.drive(OltaeDriver.clear_flags)
    await bench.drive(OltaeDriver.clear_interrupts)
    if not FULL:
        frame = good(bench.rng)
        got = await bench.drive(lambda d: d.solve(frame, CoreConfig(covariance=True), polls=200))
        expected = bench.model.run(frame, CoreConfig(covariance=False))
        assert got.flag_names == ("NOT_BUILT",) and got.result_words() == expected.result_words()
        bench.last = got
    await bench.drive(configured)
    await bench.drive(OltaeDriver.clear_flags)
    await bench.solve(good(bench.rng))
    assert await bench.flags() == (set(), set())


def configured(driver: OltaeDriver, frac: int = 0) -> OltaeDriver:
    driver.configure(CoreConfig(covariance=FULL), frac=frac)
    return driver


def cut(frame: QuantisedFrame, end: int) -> list[int]:
    return beats_of(frame)[:end]


async def reached(bench: Bench, beats: int) -> None:
    """Let the paused source send this many beats."""
    start = bench.beats
    bench.bus.source.pause = False
    while bench.beats - start < beats:
        await FallingEdge(bench.dut.clk)
    bench.bus.source.pause = True
    await ClockCycles(bench.dut.clk, 3)


@cocotb.test()
async def states_acknowledge_and_interrupt(dut: Any) -> None:
    """IDLE, LOAD, COMPUTE, DONE in order; DONE holds until acknowledged or the next frame; irq as enabled."""
    bench = await Bench(dut, 4).begin()
    order: list[State] = []

    async def watch() -> None:
        while True:
            await RisingEdge(dut.clk)
            if dut.state.value.is_resolvable and (not order or order[-1] != bench.state()):
                order.append(bench.state())

    watcher = cocotb.start_soon(watch())
    await bench.drive(lambda d: d.enable_interrupts(done=True))
    assert bench.state() == State.IDLE and dut.irq.value == 0
    frame = good(bench.rng)
    await bench.solve(frame)
    assert bench.state() == State.DONE and dut.irq.value == 1
    status = await bench.drive(OltaeDriver.status)
    assert status.state == State.DONE and status.all_ready and not status.busy and status.frame == 1
    assert await bench.drive(OltaeDriver.clear_interrupts) == (True, False)
    await clocks.tick(dut, 200)
    assert bench.state() == State.DONE and dut.irq.value == 0
    await bench.drive(OltaeDriver.acknowledge)
    await clocks.tick(dut, 4)
    assert bench.state() == State.IDLE
    status = await bench.drive(OltaeDriver.status)
    assert status.q_ready and status.pose_ready and status.all_ready  # of the last frame started
    await bench.unchanged()
    await bench.solve(good(bench.rng))
    await bench.drive(lambda d: d.enable_interrupts())
    await clocks.tick(dut, 2)
    assert dut.irq.value == 0
    await bench.solve(good(bench.rng))  # straight from DONE
    watcher.cancel()
    round_trip = [State.LOAD, State.COMPUTE, State.DONE]
    assert order == [State.IDLE, *round_trip, State.IDLE, *round_trip, *round_trip]


@cocotb.test()
async def soft_reset_in_every_state(dut: Any) -> None:
    """IDLE, LOAD after every beat, COMPUTE at every few clocks, DONE: always IDLE after, the next frame is right."""
    bench = await Bench(dut, 5).begin()
    caught: set[State] = set()

    async def reset() -> None:
        caught.add(bench.state())
        await bench.drive(OltaeDriver.soft_reset)
        await clocks.tick(dut, 4)
        assert bench.state() == State.IDLE

    await reset()
    await bench.solve(good(bench.rng))
    await reset()
    await bench.unchanged()

    # LOAD: what was pushed is forgotten
    for weights in (False, True) if FULL else (False,):
        frame = good(bench.rng, 3, weights)
        await bench.drive(lambda d, w=weights: d.configure(CoreConfig(covariance=FULL), frac=0, weighted=w))
        beats = beats_of(frame)
        for count in range(1, len(beats)):
            await bench.drive(lambda d, part=beats[:count]: push(d, part))
            await reset()
            if count % 3 == 0:
                await bench.unchanged()
                await bench.solve(good(bench.rng, 3, weights), feed="registers" if count % 2 else "stream")
    # LOAD by stream: the rest of the frame counts as a new one
    for count in range(1, 9, 2):
        frame = good(bench.rng, 5)
        bench.bus.source.pause = True
        await bench.drive(lambda d, f=frame: configured(d, f.frac).feed(beats_of(f)))
        start = bench.beats
        await reached(bench, count)
        await reset()
        await bench.drive(OltaeDriver.clear_flags)
        rest = len(beats_of(frame)) - (bench.beats - start)
        bench.bus.source.pause = False
        await clocks.tick(dut, 3 * rest + 20)
        if rest % 3:
            assert (await bench.flags())[0] == {"BAD_TLAST"}
        elif rest < 9:
            assert (await bench.flags())[0] == {"FEW_POINTS"}
        else:
            while bench.state() == State.COMPUTE:
                await clocks.tick(dut)
            left = QuantisedFrame(frame.a[-rest // 3 :], frame.b[-rest // 3 :], None, frame.frac)
            got = await bench.standing()
            expected = bench.model.run(left, CoreConfig(covariance=FULL))
            if not expected.failed:
                assert got.result_words() == expected.result_words()
                bench.last = got
        await bench.solve(good(bench.rng))

    # COMPUTE
    for delay in range(0, 180, 7):
        weights = FULL and delay % 2 == 1
        frame = good(bench.rng, 3, weights)
        await bench.drive(
            lambda d, f=frame: d.configure(CoreConfig(covariance=FULL), frac=f.frac, weighted=f.w is not None)
        )
        await bench.drive(lambda d, f=frame: d.feed(beats_of(f)))
        while bench.state() != State.COMPUTE:
            await FallingEdge(dut.clk)
        await clocks.tick(dut, delay)
        await reset()
        if delay % 5 == 0:
            await whole_groups(bench, bench.model.run(frame, CoreConfig(covariance=FULL)))
        await bench.solve(good(bench.rng, 3, FULL and delay % 3 == 0))
    assert caught == set(State)


def push(driver: OltaeDriver, beats: Sequence[int]) -> None:
    """Beats without a last one."""
    for beat in beats:
        driver.write(Oltae.DATA_A, beat & 0xFFFFFFFF)
        driver.write(Oltae.DATA_B, beat >> 32)
        driver.write(Oltae.PUSH, 0)


async def whole_groups(bench: Bench, new: RawResult) -> None:
    """After a reset amid the results: each group is the old frame's, or the new one's where its bit is up."""
    status = await bench.drive(OltaeDriver.status)
    now, old = (await bench.standing()).result_words(), bench.last.result_words()
    fresh = new.result_words()
    assert now[:3] == (fresh if status.q_ready else old)[:3]
    assert now[6:18] == (fresh if status.pose_ready else old)[6:18]
    assert now[18:] == (fresh if status.all_ready else old)[18:]


@cocotb.test()
async def reading_does_not_disturb(dut: Any) -> None:
    """A storm of reads at any address while frames come and go; a result word is the old one or the new one."""
    bench = await Bench(dut, 6).begin()
    rng = bench.rng
    results = range(Oltae.Q.ADDRESS, Oltae.Q.ADDRESS + 4 * RESULT_WORDS, 4)
    others = [
        r.ADDRESS for r in (Oltae.STATUS, Oltae.POINTS, Oltae.WEIGHT, Oltae.TURN, Oltae.CYCLES_Q, Oltae.FLAGS)
    ]
    allowed = [{word} for word in bench.last.result_words()]
    reads = 0

    async def storm() -> None:
        nonlocal reads
        while True:
            if rng.random() < 0.8:
                word, _ = await axil.read(bench.bus.axil, rng.choice(results))
                del word
            else:
                await axil.read(bench.bus.axil, rng.choice([*others, rng.randrange(0, 0x1000, 4)]))
            reads += 1

    async def checked() -> None:
        nonlocal reads
        while True:
            index = rng.randrange(RESULT_WORDS)
            word, response = await axil.read(bench.bus.axil, results[index])
            assert response == axil.OKAY and word in allowed[index], f"word {index} is {word:#x}"
            reads += 1

    stormy = [cocotb.start_soon(storm()), cocotb.start_soon(checked())]
    for number in range(6):
        frame = good(rng, 4, FULL and number % 2 == 1)
        for index, word in enumerate(bench.model.run(frame, CoreConfig(covariance=FULL)).result_words()):
            allowed[index].add(word)
        before = reads
        await bench.solve(frame)
        assert reads - before > 20
        for index, word in enumerate(bench.last.result_words()):
            allowed[index] = {word}
    for task in stormy:
        task.cancel()
