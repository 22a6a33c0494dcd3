# SPDX-License-Identifier: Apache-2.0
"""core_upsets against its description, clock by clock: every reason alone and together, in every state."""

from __future__ import annotations

import os
import random
from dataclasses import dataclass
from typing import Any

import cocotb
from cocotb.triggers import FallingEdge, ReadOnly

from tb.common import clocks

VERIFIES = os.environ["VERIFY"] == "1"
RECORD = int(os.environ["RECORD"])
PULSES = (
    "again",
    "forget",
    "ended",
    "open",
    "checked",
    "mismatch",
    "differ",
    "differs",
    "repeated",
    "refused",
    "elsewhere",
)
STATES = ("idle", "loading", "computing", "verifying")


@dataclass
class Model:
    """What stands after each clock."""

    lost: bool = False
    rows: bool = False
    other: bool = False
    seen: bool = False
    settled: bool = False
    give_up: bool = False

    def upset(self, inputs: dict[str, int]) -> bool:
        """In this clock."""
        differs = VERIFIES and bool(inputs["differs"])
        return self.lost or self.rows or self.other or differs or bool(inputs["elsewhere"])

    def reasons(self, state: str, inputs: dict[str, int]) -> set[str]:
        """What this clock's inputs say."""
        found = {"lost"} if state == "loading" and not inputs["open"] else set()
        if state == "computing" and inputs["frame_rows"] != inputs["array_rows"]:
            found.add("rows")
        if inputs["differ"]:
            found.add("differ")
        if not VERIFIES:
            return found
        if state in ("computing", "verifying"):
            if inputs["mismatch"]:
                found.add("mismatch")
            if inputs["ended"] and not self.seen:
                found.add("unchecked")
        if state == "verifying" and inputs["refused"]:
            found.add("refused")
        if self.settled and inputs["record"] != inputs["record_again"]:
            found.add("record")
        return found

    def step(self, state: str, inputs: dict[str, int]) -> set[str]:
        """To the next clock; returns the reasons for an upset."""
        found = self.reasons(state, inputs)
        self.give_up = self.upset(inputs) or (bool(inputs["open"]) and state != "loading")
        self.lost, self.rows, self.other = "lost" in found, "rows" in found, bool(found - {"lost", "rows"})
        self.seen = (self.seen or bool(inputs["checked"])) and state != "loading" and not inputs["again"]
        repeated = state == "verifying" and bool(inputs["repeated"])
        self.settled = (self.settled or repeated) and state != "loading" and not inputs["forget"]
        return found


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def every_reason(dut: Any) -> None:
    """Quiet inputs with one thing wrong now and then, so that each reason also comes alone."""
    rng = random.Random(3)
    names = (
        *PULSES,
        "loading",
        "computing",
        "verifying",
        "frame_rows",
        "array_rows",
        "record",
        "record_again",
    )
    await clocks.start(dut, **dict.fromkeys(names, 0))
    model, state = Model(), "idle"
    alone: set[str] = set()
    for number in range(6000):
        if number % 1500 == 0:
            await clocks.reset(dut)
            model = Model()
        if rng.random() < 0.2:
            state = rng.choice(STATES)
        share = 0.03 if number % 3000 < 2000 else 0.4
        inputs = {name: int(rng.random() < share) for name in PULSES}
        inputs["open"] = int((state == "loading") != (rng.random() < share))
        inputs["checked"] = int(rng.random() < 0.3)
        for first, second, bits in (("frame_rows", "array_rows", 16), ("record", "record_again", RECORD)):
            inputs[first] = inputs[second] = rng.getrandbits(bits)
            if rng.random() < share:
                inputs[second] ^= 1 << rng.randrange(bits)
        for name, value in inputs.items():
            getattr(dut, name).value = value
        for name in STATES[1:]:
            getattr(dut, name).value = int(state == name)
        await ReadOnly()
        assert int(dut.upset.value) == model.upset(inputs), (state, inputs)
        assert int(dut.give_up.value) == model.give_up
        found = model.step(state, inputs)
        if len(found) == 1:
            alone |= found
        await FallingEdge(dut.clk)
    both = {"lost", "rows", "differ"}
    assert alone == (both | {"mismatch", "unchecked", "refused", "record"} if VERIFIES else both)
