# SPDX-License-Identifier: Apache-2.0
"""What the register file benches share: the core under test, and everything around its register file."""

from __future__ import annotations

import os
import random
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import cocotb
from cocotb.triggers import FallingEdge, ReadOnly, RisingEdge
from relnav.registermap import Field, Register
from relnav.registers import Ivisnav, Oltae

from tb.common import axil, clocks

FULL = os.environ.get("FULL", "1") == "1"
"""OLTAE's build: with everything or with nothing."""


@dataclass(frozen=True)
class Core:
    """A core's register file: its map and how its ports are called."""

    registers: Any
    build: int
    """Word of BUILD."""
    latched: Mapping[str, tuple[int, str]]
    """Input port -> bits, register that shows it."""
    points: Mapping[str, Field]
    """Output port -> its field of FRAC."""
    holes: tuple[int, ...]
    """Some addresses that are not mapped."""
    resets: Mapping[str, int]
    """Register -> word after reset, where that depends on the build."""

    def mapped(self) -> dict[int, type[Register]]:
        """Address of every word -> its register."""
        found: dict[int, type[Register]] = {}
        for register in vars(self.registers).values():
            if isinstance(register, type) and issubclass(register, Register):
                found.update((register.element(i), register) for i in range(register.COUNT))
        return found


CORES = {
    "oltae": Core(
        Oltae,
        Oltae.BUILD.encode(WEIGHTED=FULL, COVARIANCE=FULL, REAPPLY=FULL, VERIFY=1, MANTISSA=35),
        {
            "points": (16, "POINTS"),
            "weight": (32, "WEIGHT"),
            "turn": (2, "TURN"),
            "cycles_q": (16, "CYCLES_Q"),
            "cycles_pose": (16, "CYCLES_POSE"),
            "cycles_all": (16, "CYCLES_ALL"),
        },
        {"config_frac": Oltae.FRAC.FRAC},
        (0x030, 0x04C, 0x07C, 0x188, 0x200, 0xFFC),
        {"CONFIG": Oltae.CONFIG.RESET if FULL else 0},
    ),
    "ivisnav": Core(
        Ivisnav,
        Ivisnav.BUILD.encode(VERIFY=1, MANTISSA=24),
        {
            "rows": (16, "ROWS"),
            "weight": (32, "WEIGHT"),
            "condition": (32, "CONDITION"),
            "cycles_rates": (16, "CYCLES_RATES"),
            "cycles_all": (16, "CYCLES_ALL"),
        },
        {"config_frac_h": Ivisnav.FRAC.FRAC_H, "config_frac_y": Ivisnav.FRAC.FRAC_Y},
        (0x024, 0x030, 0x04C, 0x070, 0x07C, 0x170, 0x200, 0xFFC),
        {},
    ),
}
CORE = CORES[os.environ.get("CORE", "oltae")]
MAP = CORE.registers
QUIET = dict.fromkeys(
    (
        *("push_ready", "push_open", "busy", "state", "ready", "flag_set", "frame_start", "frame_complete"),
        *CORE.latched,
        *("result_wait", "result_data"),
    ),
    0,
)
STORED = [0x9E3779B9 * (index + 1) & 0xFFFFFFFF for index in range(64)]


class Bench:
    """The bus, the result memory's answers, and every pulse that came out."""

    def __init__(self, dut: Any) -> None:
        self.dut = dut
        self.bus = axil.master(dut)
        self.monitor = axil.Monitor(dut)
        self.pulses = {"soft_reset": 0, "acknowledge": 0}
        self.pushed: list[tuple[int, int]] = []
        self.rng = random.Random(1)
        self.result_waits = 0.0

    async def begin(self) -> Bench:
        cocotb.start_soon(self._watch())
        await clocks.start(self.dut, **QUIET)
        await clocks.tick(self.dut, 3)
        return self

    async def _watch(self) -> None:
        dut = self.dut
        while True:
            await FallingEdge(dut.clk)
            dut.result_wait.value = int(self.rng.random() < self.result_waits)
            await ReadOnly()
            answer = 0
            if not int(dut.rst.value):
                for name in self.pulses:
                    self.pulses[name] += int(getattr(dut, name).value)
                if int(dut.push_valid.value) and int(dut.push_ready.value):
                    self.pushed.append((int(dut.push_data.value), int(dut.push_last.value)))
                if int(dut.result_valid.value) and not int(dut.result_wait.value):
                    answer = STORED[int(dut.result_index.value)]
            await RisingEdge(dut.clk)
            dut.result_data.value = answer

    async def read(self, address: int) -> int:
        word, response = await axil.read(self.bus, address)
        assert response == axil.OKAY, f"read of 0x{address:03x}: {response!r}"
        return word

    async def write(self, address: int, value: int, strobe: int = 15) -> None:
        assert await axil.write(self.bus, address, value, strobe) == axil.OKAY, f"write of 0x{address:03x}"

    async def pulse(self, name: str, value: int = 1) -> None:
        await FallingEdge(self.dut.clk)
        getattr(self.dut, name).value = value
        await FallingEdge(self.dut.clk)
        getattr(self.dut, name).value = 0

    async def clear(self) -> None:
        """Forget every flag."""
        await self.write(MAP.FLAGS.ADDRESS, 0xFFFFFFFF)
        await self.write(MAP.IRQ_STATUS.ADDRESS, 0xFFFFFFFF)
        await self.pulse("frame_start")
        await self.write(MAP.FLAGS.ADDRESS, 0xFFFFFFFF)
        await self.write(MAP.IRQ_STATUS.ADDRESS, 0xFFFFFFFF)


def merged(old: int, new: int, strobe: int) -> int:
    mask = sum(0xFF << (8 * i) for i in range(4) if strobe >> i & 1)
    return old & ~mask | new & mask
