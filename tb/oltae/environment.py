# SPDX-License-Identifier: Apache-2.0
"""The core after a reset, with the product's driver in a thread, the model, and a monitor of its events."""

from __future__ import annotations

import logging
import os
import random
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict
from typing import Any, TypeVar

import cocotb
from cocotb.task import bridge, resume
from cocotb.triggers import FallingEdge, RisingEdge
from cocotb.utils import get_sim_time
from cocotbext.axi import AxiStreamBus, AxiStreamFrame, AxiStreamSource
from relnav.driver import Feed, OltaeDriver
from relnav.model.core import OltaeCore
from relnav.model.raw import CoreConfig, RawResult
from relnav.quantise import QuantisedFrame
from relnav.registers import Oltae
from relnav.result import FLAG_NAMES
from relnav.rtlsim.bus import RegisterBus

from tb.common import axil, clocks
from tb.oltae.frames import random_frame

EVENTS = ("frame_start", "frame_end", "q_ready", "pose_ready", "all_ready")
FULL = os.environ.get("FULL", "1") == "1"
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
        self.driver = OltaeDriver(self.bus, self.bus.idle)
        self.model = OltaeCore(weighted=FULL)
        self.last = RawResult()  # what the registers show
        self.rises: dict[str, int] = {}

    async def begin(self) -> Bench:
        for name in EVENTS:
            cocotb.start_soon(self._watch(name))
        await clocks.start(self.dut)
        await clocks.tick(self.dut, 2)
        self.last = await self.standing()  # memory is not reset: what the test before left
        assert (self.last.points, self.last.weight, self.last.cycles_all) == (0, 0, 0)
        return self

    async def _watch(self, name: str) -> None:
        """Remember the clock of a signal's last rise."""
        while True:
            await RisingEdge(getattr(self.dut, name))
            self.rises[name] = int(get_sim_time("ns")) // clocks.PERIOD_NS

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
        for name, counted in (("q", got.cycles_q), ("pose", got.cycles_pose), ("all", got.cycles_all)):
            # frame_end is up in the clock whose end takes the last beat
            assert self.rises[f"{name}_ready"] - self.rises["frame_end"] - 1 == counted, name
        wrong = differences(got, expected)
        assert not wrong, f"{wrong} of {tell(frame, config)}"
        self.last = got
        return got

    async def standing(self) -> RawResult:
        """The result registers, whatever they hold."""
        return await self.drive(OltaeDriver.result)

    async def unchanged(self) -> None:
        """The results of the last frame that was solved still stand, all of them."""
        now, last = asdict(await self.standing()), asdict(self.last)
        for name in now.keys() - {"flags"}:  # None: covariances that were not asked for
            assert now[name] == last[name] or None in (now[name], last[name]), name

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


def configured(driver: OltaeDriver, frac: int = 0) -> OltaeDriver:
    """The driver, set for unweighted frames."""
    driver.configure(CoreConfig(covariance=FULL), frac=frac)
    return driver


async def reached(bench: Bench, beats: int) -> int:
    """Let the paused source send this many beats, or one more; returns how many were taken."""
    dut, taken = bench.dut, 0

    async def clock() -> int:
        await FallingEdge(dut.clk)
        return int(dut.s_axis_tvalid.value == 1 and dut.s_axis_tready.value == 1)

    bench.bus.source.pause = False
    while taken < beats:
        taken += await clock()
    bench.bus.source.pause = True
    for _ in range(4):
        taken += await clock()
    return taken
