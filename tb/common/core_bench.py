# SPDX-License-Identifier: Apache-2.0
"""A whole core after a reset: the product's driver in a thread, the model, a monitor of its events.

`CoreBench` is what the benches of every core's top need; a core's own one says how its frames are made and
compared. The tests that every core has to pass are in core_tests.py.
"""

from __future__ import annotations

import logging
import random
from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict
from typing import Any, ClassVar, Self, TypeVar

import cocotb
from cocotb.task import bridge, resume
from cocotb.triggers import FallingEdge, RisingEdge
from cocotb.utils import get_sim_time
from cocotbext.axi import AxiStreamBus, AxiStreamFrame, AxiStreamSource
from relnav.driver import CoreDriver, Feed
from relnav.rtlsim.bus import RegisterBus

from coverage import points
from tb.common import axil, clocks

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


class CoreBench:
    """The core after a reset, with the driver, the model and a monitor of its events."""

    DRIVER: ClassVar[type[CoreDriver[Any]]]
    GROUPS: ClassVar[dict[str, range]]
    """Group of results -> its words in the result memory."""
    EMPTY: ClassVar[Any]
    """A result with nothing in it."""
    BEATS: ClassVar[int]
    """Of a row, without a weight in front."""
    LEAST: ClassVar[int]
    """Rows of the shortest frame."""
    FEW: ClassVar[str]
    """Flag of a shorter one."""
    FAILURES: ClassVar[frozenset[str]]
    """Flags that leave no result."""
    LOCKED: ClassVar[tuple[str, ...]]
    """Registers that a busy core keeps."""
    KINDS: ClassVar[tuple[dict[str, Any], ...]] = ({},)
    """Arguments of `good` for every kind of frame there is, the plainest first."""

    def __init__(self, dut: Any, seed: int) -> None:
        self.dut = dut
        self.rng = random.Random(seed)
        self.bus = Bus(dut)
        self.driver: Any = self.DRIVER(self.bus, self.bus.idle)
        self.registers: Any = self.DRIVER.MAP
        self.last = self.EMPTY  # what the registers show
        self.rises: dict[str, int] = {}
        self.raised: set[str] = set()  # in FLAGS, when last looked at

    # ------------------------------------------------------------------ of each core

    def good(self, n: int | None = None, **kind: Any) -> Any:
        """A frame that is solved for certain."""
        raise NotImplementedError

    def expected(self, frame: Any) -> Any:
        """The model's result, as configured by `prepare`."""
        raise NotImplementedError

    def prepare(self, driver: Any, frame: Any) -> Any:
        """Configure for a frame; returns the driver."""
        raise NotImplementedError

    def beats(self, frame: Any) -> list[int]:
        """Its beats."""
        raise NotImplementedError

    def like(self, first: Any, frame: Any) -> Any:
        """The frame with the binary points of the first."""
        raise NotImplementedError

    def tail(self, frame: Any, rows: int) -> Any:
        """The frame of its last rows."""
        raise NotImplementedError

    def words(self, raw: Any) -> Sequence[int]:
        """The result words of a frame that was solved."""
        raise NotImplementedError

    async def solve(self, frame: Any, feed: Feed = "stream") -> Any:
        """Run a frame, compare everything with the model, remember what stands in the registers."""
        raise NotImplementedError

    # ------------------------------------------------------------------ of all

    async def begin(self) -> Self:
        for name in ("frame_start", "frame_end", *(f"{group}_ready" for group in self.GROUPS)):
            cocotb.start_soon(self._watch(name))
        await clocks.start(self.dut)
        await clocks.tick(self.dut, 2)
        self.last = await self.standing()  # memory is not reset: what the test before left
        counters = {name: v for name, v in asdict(self.last).items() if "cycles" in name or name == "weight"}
        assert not any(counters.values()), counters
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

    def state(self) -> Any:
        return self.registers.State(int(self.dut.state.value))

    async def drive(self, work: Callable[[Any], T]) -> T:
        """Do something with the driver."""
        return await bridge(work)(self.driver)

    async def check(self, solve: Callable[[Any], Any], expected: Any, about: str) -> Any:
        """Solve a frame and compare: results and flags with the model, cycles with what the ports show."""
        got = await self.drive(solve)
        assert got.flag_names == expected.flag_names, about
        if expected.failed:
            await self.unchanged()
            return got
        counted = [getattr(got, f"cycles_{group}") for group in self.GROUPS]
        assert counted[0] > 0 and counted == sorted(counted)
        for group, cycles in zip(self.GROUPS, counted, strict=True):
            # frame_end is up in the clock whose end takes the last beat
            assert self.rises[f"{group}_ready"] - self.rises["frame_end"] - 1 == cycles, group
        wrong = differences(got, expected)
        assert not wrong, f"{wrong} of {about}"
        self.last = got
        return got

    async def standing(self) -> Any:
        """The result registers, whatever they hold."""
        return await self.drive(lambda driver: driver.result())

    async def unchanged(self) -> None:
        """The results of the last frame that was solved still stand, all of them."""
        now, last = asdict(await self.standing()), asdict(self.last)
        for name in now.keys() - {"flags", "condition_word"}:  # None: what was not asked for
            assert now[name] == last[name] or None in (now[name], last[name]), name

    async def flags(self) -> tuple[set[str], set[str]]:
        """Names in FLAGS and in FRAME_FLAGS."""
        fields = self.registers.FLAGS.FIELDS

        def names(word: int) -> set[str]:
            return {name for name, field in fields.items() if word & field.mask}

        sticky, frame = await self.drive(lambda d: (d.flags(), d.read(self.registers.FRAME_FLAGS)))
        points.flag(self.dut._name, names(sticky))
        points.flag(self.dut._name, self.raised - names(sticky), "cleared")
        self.raised = names(sticky)
        return names(sticky), names(frame)

    async def reached(self, beats: int) -> int:
        """Let the paused source send this many beats, or one more; returns how many were taken."""
        dut, taken = self.dut, 0

        async def clock() -> int:
            await FallingEdge(dut.clk)
            return int(dut.s_axis_tvalid.value == 1 and dut.s_axis_tready.value == 1)

        self.bus.source.pause = False
        while taken < beats:
            taken += await clock()
        self.bus.source.pause = True
        for _ in range(12):
            taken += await clock()
        return taken


def differences(got: Any, expected: Any) -> dict[str, tuple[object, object]]:
    """What the core and the model say differently; the model counts no cycles, None is not computed."""
    mine, model = asdict(got), asdict(expected)
    skipped = {name for name in mine if "cycles" in name or mine[name] is None}
    return {name: (mine[name], model[name]) for name in mine.keys() - skipped if mine[name] != model[name]}
