# SPDX-License-Identifier: Apache-2.0
"""frame_state against a plain description, clock by clock, with every event in every state."""

from __future__ import annotations

import os
import random
from dataclasses import dataclass, field
from typing import Any

import cocotb
from cocotb.triggers import FallingEdge, ReadOnly

from tb.common import clocks

LIMIT = 1 << int(os.environ["WATCHDOG_BITS"])
IDLE, LOADING, COMPUTE, DONE = range(4)
PULSES = ("soft_reset", "acknowledge", "frame_start", "frame_end", "frame_dropped", "refused")
# One kind of clock: share of each pulse, share of each bit of done.
QUIET = dict.fromkeys((*PULSES, "done"), 0.0)
BUSY = dict.fromkeys((*PULSES, "done"), 0.3)
FRAMES = QUIET | {"frame_start": 0.5, "frame_end": 0.3, "done": 0.04, "acknowledge": 0.1}
ERRORS = FRAMES | {"frame_dropped": 0.2, "refused": 0.02, "soft_reset": 0.01}
SLOW = FRAMES | {"frame_end": 0.02, "done": 0.002}


@dataclass
class Model:
    """What stands after each clock."""

    state: int = IDLE
    clock: int = 0
    """Clocks since the last frame_end."""
    ready: int = 0
    cycles: list[int] = field(default_factory=lambda: [0, 0, 0])

    def outputs(self, inputs: dict[str, int]) -> dict[str, int]:
        """Outputs of this clock."""
        computing = self.state == COMPUTE
        return {
            "state": self.state,
            "busy": int(self.state in (LOADING, COMPUTE)),
            "accept": int(self.state in (IDLE, DONE)),
            "computing": int(computing),
            "commit": inputs["done"] * computing,
            "watchdog": int(computing and bool(self.clock & LIMIT)),
            "ready": self.ready,
            "cycles_first": self.cycles[0],
            "cycles_middle": self.cycles[1],
            "cycles_last": self.cycles[2],
        }

    def step(self, inputs: dict[str, int]) -> None:
        """To the next clock."""
        now = self.outputs(inputs)
        for group in range(3):
            if now["commit"] >> group & 1:
                self.cycles[group] = self.clock
        self.ready = 0 if inputs["frame_start"] else self.ready | now["commit"]
        if inputs["soft_reset"] or now["watchdog"]:
            self.state = IDLE
        elif self.state in (IDLE, DONE) and inputs["frame_start"]:
            self.state = LOADING
        elif self.state == DONE and inputs["acknowledge"]:
            self.state = IDLE
        elif self.state == LOADING and inputs["frame_end"]:
            self.state = COMPUTE
        elif self.state == COMPUTE and inputs["done"] & 4 and not inputs["refused"]:
            self.state = DONE
        elif inputs[{LOADING: "frame_dropped", COMPUTE: "refused"}.get(self.state, "soft_reset")]:
            self.state = IDLE
        self.clock = 1 if inputs["frame_end"] else self.clock + 1


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def every_event_in_every_state(dut: Any) -> None:
    """Legal traffic, errors, slow frames, and pulses at any time; from a reset each time."""
    rng = random.Random(1)
    await clocks.start(dut, **dict.fromkeys((*PULSES, "done"), 0))
    seen: set[tuple[int, str]] = set()
    barked = 0
    for shares in (FRAMES, ERRORS, SLOW, BUSY, FRAMES):
        await clocks.reset(dut)
        dut.frame_end.value = 1  # the counter has no reset: known from here on
        await clocks.tick(dut)
        model = Model(clock=1)
        for _ in range(1500):
            inputs = {name: int(rng.random() < shares[name]) for name in PULSES}
            inputs["done"] = sum(int(rng.random() < shares["done"]) << group for group in range(3))
            for name, value in inputs.items():
                getattr(dut, name).value = value
            await ReadOnly()
            expected = model.outputs(inputs)
            assert {name: int(getattr(dut, name).value) for name in expected} == expected, inputs
            seen |= {(model.state, name) for name, value in inputs.items() if value}
            barked += expected["watchdog"]
            model.step(inputs)
            await FallingEdge(dut.clk)
        for name in (*PULSES, "done"):
            getattr(dut, name).value = 0
    assert seen == {(state, name) for state in range(4) for name in (*PULSES, "done")}
    assert barked > 5 or LIMIT > 32
    await clocks.reset(dut)
    await ReadOnly()
    outputs = ("state", "busy", "ready", "cycles_first", "cycles_middle", "cycles_last")
    assert [int(getattr(dut, name).value) for name in outputs] == [0] * 6


@cocotb.test()
async def cycles_count_up_to_the_watchdog(dut: Any) -> None:
    """Results after so many clocks, every bit of the counter set and clear; with the watchdog; too late."""
    await clocks.start(dut, **dict.fromkeys((*PULSES, "done"), 0))

    async def pulse(name: str, value: int = 1) -> None:
        getattr(dut, name).value = value
        await clocks.tick(dut)
        getattr(dut, name).value = 0

    def counts() -> list[int]:
        return [int(getattr(dut, f"cycles_{group}").value) for group in ("first", "middle", "last")]

    for count in (1, 2, LIMIT // 3, 2 * LIMIT // 3, LIMIT - 1, LIMIT, LIMIT + 1):
        before = counts()
        await pulse("frame_start")
        await pulse("frame_end")
        await clocks.tick(dut, count - 1)
        assert int(dut.watchdog.value) == (count == LIMIT)
        assert int(dut.computing.value) == (count <= LIMIT)
        await pulse("done", 7)
        await clocks.tick(dut, 2)
        assert counts() == ([count] * 3 if count <= LIMIT else before)
        assert int(dut.state.value) == (DONE if count < LIMIT else IDLE)
