# SPDX-License-Identifier: Apache-2.0
"""Cores of plain Python that solve frames, and one of them as a device: registers in a file, AXI DMA beside.

A file cannot tell that it was written, so the maps that the buses open are replaced by ones that tell the
device; registers and beats still go through the file.
"""

from __future__ import annotations

import mmap
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, ClassVar

import numpy as np
from relnav.buses import axi_dma
from relnav.buses.memory_map import MemoryMap
from relnav.driver import CoreDriver, OltaeDriver
from relnav.ivisnav.driver import IvisnavDriver
from relnav.ivisnav.quantise import QuantisedRows
from relnav.ivisnav.raw import RawRates
from relnav.model.core import OltaeCore
from relnav.model.rates_core import RatesCore
from relnav.model.raw import CoreConfig, RawResult, word_to_float
from relnav.quantise import QuantisedFrame
from relnav.registers import Ivisnav, Oltae

from tb.sw.fake_core import FakeCore

Answer = Callable[["SolvingCore"], Any]


class SolvingCore(FakeCore):
    """Registers whose results are what `answer` makes of the frame: a RawResult or RawRates."""

    def __init__(self, driver: type[CoreDriver[Any]], answer: Answer) -> None:
        super().__init__(driver.MAP)
        self.answer = answer
        self.words[self.map.CONFIG.ADDRESS if driver is OltaeDriver else self.map.FRAC.ADDRESS] = 0
        self.solve = lambda _: self.compute()
        self.lag = 2
        self.frame = 0

    @property
    def beats(self) -> tuple[int, ...]:
        return tuple(self.frames[-1])

    def field(self, register: Any, name: str) -> int:
        return int(register.FIELDS[name].get(self.words.get(register.ADDRESS, 0)))

    def compute(self) -> None:
        raw = self.answer(self)
        if raw.failed:
            self.failed(raw.flags)
            return
        values = (
            {Oltae.POINTS: raw.points, Oltae.WEIGHT: raw.weight, Oltae.TURN: raw.turn}
            | {
                Oltae.CYCLES_Q: raw.cycles_q,
                Oltae.CYCLES_POSE: raw.cycles_pose,
                Oltae.CYCLES_ALL: raw.cycles_all,
            }
            if isinstance(raw, RawResult)
            else {Ivisnav.ROWS: raw.n, Ivisnav.WEIGHT: raw.weight, Ivisnav.CONDITION: raw.condition_word}
            | {Ivisnav.CYCLES_RATES: raw.cycles_rates, Ivisnav.CYCLES_ALL: raw.cycles_all}
        )
        self.words |= {register.ADDRESS: value or 0 for register, value in values.items()}
        words = raw.result_words() if isinstance(raw, RawResult) else raw.words
        self.words |= {0x100 + 4 * index: word for index, word in enumerate(words)}
        self.solved(raw.flags)


def signed(words: Any) -> Any:
    return np.asarray(words, np.uint64).astype(np.uint32).view(np.int32).astype(np.int64)


def oltae_model(core: SolvingCore) -> RawResult:
    """The bit-exact model on the frame that the registers and beats describe."""
    weighted = core.field(Oltae.CONFIG, "WEIGHTED")
    beats = np.array(core.beats, np.uint64).reshape(-1, 3 + weighted)
    points = beats[:, weighted:]
    frame = QuantisedFrame(
        signed(points & np.uint64(0xFFFFFFFF)),
        signed(points >> np.uint64(32)),
        (beats[:, 0] & np.uint64(0xFFFF)).astype(np.int64) if weighted else None,
        core.field(Oltae.FRAC, "FRAC"),
    )
    config = CoreConfig(
        bool(core.field(Oltae.CONFIG, "FORBID_TURNS")),
        bool(core.field(Oltae.CONFIG, "REAPPLY")),
        bool(core.field(Oltae.CONFIG, "COVARIANCE")),
        word_to_float(core.words[Oltae.VARIANCE.ADDRESS]),
    )
    return OltaeCore().run(frame, config)


def ivisnav_model(core: SolvingCore) -> RawRates:
    """The same for the rates."""
    beats = np.array(core.beats, np.uint64).reshape(-1, 4)
    low, high = signed(beats & np.uint64(0xFFFFFFFF)), signed(beats >> np.uint64(32))
    rows = QuantisedRows(
        np.stack((low[:, :3], high[:, :3]), axis=2).reshape(-1, 6),
        low[:, 3],
        high[:, 3] & 0xFFFF,
        core.field(Ivisnav.FRAC, "FRAC_H"),
        core.field(Ivisnav.FRAC, "FRAC_Y"),
    )
    return RatesCore().run(rows, word_to_float(core.words[Ivisnav.VARIANCE.ADDRESS]))


MODELS: dict[type[CoreDriver[Any]], Answer] = {OltaeDriver: oltae_model, IvisnavDriver: ivisnav_model}


# ------------------------------------------------------------------------------------------------- devices


@dataclass
class CoreDevice:
    """A core's registers."""

    core: FakeCore

    def written(self, address: int, word: int) -> None:
        self.core.write(address, word)

    def read(self, address: int) -> int:
        return self.core.read(address)


@dataclass
class DmaDevice:
    """The memory-to-stream half of an AXI DMA whose bus finds `memory`, a file, at address `physical`."""

    core: FakeCore
    memory: Path
    physical: int
    words: dict[int, int] = field(default_factory=lambda: {axi_dma.DMASR: axi_dma.HALTED})
    error: int = 0
    stuck: bool = False
    sent: list[int] = field(default_factory=list)

    def written(self, address: int, word: int) -> None:
        self.words[address] = word
        if address == axi_dma.DMACR:
            run = bool(word & axi_dma.RUN) and not word & axi_dma.RESET
            self.words |= {axi_dma.DMACR: int(run), axi_dma.DMASR: 0 if run else axi_dma.HALTED}
        if address == axi_dma.LENGTH:
            assert not self.words[axi_dma.DMASR] & axi_dma.HALTED
            start = (self.words[axi_dma.SA_MSB] << 32 | self.words[axi_dma.SA]) - self.physical
            self.core.stream(np.frombuffer(self.memory.read_bytes()[start : start + word], "<u8").tolist())
            self.sent.append(word)
            self.words[axi_dma.DMASR] = self.error or (0 if self.stuck else axi_dma.IDLE)

    def read(self, address: int) -> int:
        return self.words.get(address, 0)


class WatchedMap(MemoryMap):
    """A MemoryMap of a file behind which one of `devices` sits."""

    devices: ClassVar[dict[Path, Any]] = {}

    def __init__(self, file: str | Path, offset: int, size: int) -> None:
        super().__init__(file, offset, size)
        self.device = self.devices.get(Path(file))
        with Path(file).open("r+b") as handle:
            self.far = mmap.mmap(handle.fileno(), 0)  # the device's own view of the file
        self.offset = offset

    def _place(self, address: int) -> slice:
        return slice(self.offset + address, self.offset + address + 4)

    def read(self, address: int) -> int:
        if self.device is not None:
            self.far[self._place(address)] = self.device.read(address).to_bytes(4, "little")
        return super().read(address)

    def write(self, address: int, value: int) -> None:
        super().write(address, value)
        if self.device is not None:
            self.device.written(address, int.from_bytes(self.far[self._place(address)], "little"))


def replay(answers: Sequence[tuple[Sequence[int], Any]]) -> Answer:
    """Answers recorded elsewhere, by the beats they are of."""
    recorded = {tuple(beats): raw for beats, raw in answers}
    return lambda core: recorded[core.beats]
