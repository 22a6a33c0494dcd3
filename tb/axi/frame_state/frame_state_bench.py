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
VERIFIES = os.environ["VERIFY"] == "1"
IDLE, LOADING, COMPUTE, DONE, VERIFY = range(5)
STATES = range(5 if VERIFIES else 4)
PULSES = ("soft_reset", "acknowledge", "frame_start", "frame_end", "frame_dropped", "refused", "upset")
# One kind of clock: share of each pulse, share of each bit of done.
QUIET = dict.fromkeys((*PULSES, "done"), 0.0)
BUSY = dict.fromkeys((*PULSES, "done"), 0.3)
FRAMES = QUIET | {"frame_start": 0.5, "frame_end": 0.3, "done": 0.04, "acknowledge": 0.1}
ERRORS = FRAMES | {"frame_dropped": 0.2, "refused": 0.02, "soft_reset": 0.01, "upset": 0.01}
SLOW = FRAMES | {"frame_end": 0.02, "done": 0.002}


@dataclass
class Model:
    """What stands after each clock."""

    state: int = IDLE
    clock: int = 0
    """Clocks since the last frame_end, or since the second pass began."""
    pulses: int = 0
    """Clocks since the first pass ended, up to 3."""
    repeated: bool = False
    ready: int = 0
    cycles: list[int] = field(default_factory=lambda: [0, 0, 0])

    def outputs(self, inputs: dict[str, int]) -> dict[str, int]:
        """Outputs of this clock."""
        computing = self.state == COMPUTE
        watchdog = self.state in (COMPUTE, VERIFY) and bool(self.clock & LIMIT)
        given_up = inputs["soft_reset"] or inputs["upset"] or watchdog
        ended = self.state == VERIFY and self.repeated if VERIFIES else self.solved(inputs)
        return {
            "state": self.state,
            "busy": int(self.state in (LOADING, COMPUTE, VERIFY)),
            "accept": int(self.state in (IDLE, DONE)),
            "loading": int(self.state == LOADING),
            "computing": int(computing),
            "verifying": int(self.state == VERIFY),
            "again": int(VERIFIES and self.pulses == 1),
            "redrain": int(VERIFIES and self.pulses == 2),
            "commit": inputs["done"] * computing,
            "complete": int(ended and not given_up),
            "watchdog": int(watchdog),
            "ready": self.ready,
            "cycles_first": self.cycles[0],
            "cycles_middle": self.cycles[1],
            "cycles_last": self.cycles[2],
        }

    def solved(self, inputs: dict[str, int]) -> bool:
        """The first pass ends in this clock."""
        return self.state == COMPUTE and bool(inputs["done"] & 4) and not inputs["refused"]

    def step(self, inputs: dict[str, int]) -> None:
        """To the next clock."""
        now = self.outputs(inputs)
        given_up = inputs["soft_reset"] or inputs["upset"] or now["watchdog"]
        solved = self.solved(inputs) and not given_up
        repeated = self.state == VERIFY and bool(inputs["done"] & 4)
        for group in range(3):
            if now["commit"] >> group & 1:
                self.cycles[group] = self.clock
        lost = now["busy"] and (inputs["upset"] or now["watchdog"])
        self.ready = 0 if inputs["frame_start"] or lost else self.ready | now["commit"]
        if given_up:
            self.state = IDLE
        elif self.state in (IDLE, DONE) and inputs["frame_start"]:
            self.state = LOADING
        elif self.state == DONE and inputs["acknowledge"]:
            self.state = IDLE
        elif self.state == LOADING and inputs["frame_end"]:
            self.state = COMPUTE
        elif solved:
            self.state = VERIFY if VERIFIES else DONE
        elif self.state == VERIFY and self.repeated:
            self.state = DONE
        elif inputs[{LOADING: "frame_dropped", COMPUTE: "refused"}.get(self.state, "soft_reset")]:
            self.state = IDLE
        self.clock = 1 if inputs["frame_end"] else 0 if solved else self.clock + 1
        self.pulses = 1 if solved else min(self.pulses + bool(self.pulses), 3)
        self.repeated = repeated


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
        for _ in range(2500):
            inputs = {name: int(rng.random() < shares[name]) for name in PULSES}
            inputs["done"] = sum(int(rng.random() < shares["done"]) << group for group in range(3))
            for name, value in inputs.items():
                getattr(dut, name).value = value
            await ReadOnly()
            expected = model.outputs(inputs)
            found = {name: int(getattr(dut, name).value) for name in expected}
            differ = {
                name: (found[name], expected[name]) for name in expected if found[name] != expected[name]
            }
            assert not differ, f"(found, expected) {differ} after {inputs}"
            seen |= {(model.state, name) for name, value in inputs.items() if value}
            barked += expected["watchdog"]
            model.step(inputs)
            await FallingEdge(dut.clk)
        for name in (*PULSES, "done"):
            getattr(dut, name).value = 0
    missing = {(state, name) for state in STATES for name in (*PULSES, "done")} - seen
    assert not missing
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
        after = VERIFY if VERIFIES else DONE
        assert int(dut.state.value) == (after if count < LIMIT else IDLE)
        if VERIFIES and count < LIMIT:
            await clocks.tick(dut, count // 2)
            assert int(dut.state.value) == VERIFY
            await pulse("done", 7)
            await clocks.tick(dut)
            assert int(dut.state.value) == DONE
            assert counts() == [count] * 3, "the second pass is not counted"


@cocotb.test()
async def second_pass_has_its_own_watchdog(dut: Any) -> None:
    """VERIFY without an end leads to IDLE, and no result stands."""
    if not VERIFIES:
        return
    await clocks.start(dut, **dict.fromkeys((*PULSES, "done"), 0))
    for name in ("frame_start", "frame_end"):
        getattr(dut, name).value = 1
        await clocks.tick(dut)
        getattr(dut, name).value = 0
    dut.done.value = 7
    await clocks.tick(dut)
    dut.done.value = 0
    await clocks.tick(dut, LIMIT)
    assert int(dut.state.value) == VERIFY and int(dut.watchdog.value) == 1 and int(dut.ready.value) == 7
    await clocks.tick(dut)
    assert int(dut.state.value) == IDLE and int(dut.ready.value) == 0
