# SPDX-License-Identifier: Apache-2.0
"""A core of plain Python behind relnav.driver.Bus: a dictionary of registers and an answer to each frame."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any


class FakeCore:
    """`solve` answers a frame, `lag` looks at STATUS after its last beat. Result word k reads 1000 + k."""

    def __init__(self, registers: Any, lag: int = 0) -> None:
        self.map = registers
        self.words = {register.ADDRESS: register.RESET for register in (registers.ID, registers.VERSION)}
        self.words |= {0x100 + 4 * index: 1000 + index for index in range((registers.SIZE - 0x100) // 4)}
        self.kept: dict[int, int] = {}
        """Address -> bits that a write leaves."""
        self.written: list[tuple[int, int]] = []
        self.frames: list[list[int]] = []
        self.open: list[int] = []
        self.state, self.frame, self.lag, self.left = registers.State.DONE, 65535, lag, -1
        self.push_ready = True
        self.solve: Callable[[FakeCore], None] = FakeCore.solved

    def solved(self, flags: int = 0) -> None:
        self.frame, self.state = (self.frame + 1) & 0xFFFF, self.map.State.DONE
        self.raise_flags(flags)

    def failed(self, flags: int) -> None:
        self.state = self.map.State.IDLE
        self.raise_flags(flags)

    def raise_flags(self, flags: int) -> None:
        self.words[self.map.FRAME_FLAGS.ADDRESS] = flags
        self.words[self.map.FLAGS.ADDRESS] = self.words.get(self.map.FLAGS.ADDRESS, 0) | flags

    def read(self, address: int) -> int:
        if address == self.map.STATUS.ADDRESS:
            if self.left == 0:
                self.solve(self)
            self.left -= 1
            done = self.state.name == "DONE"
            word = self.map.STATUS.encode(
                STATE=self.state,
                BUSY=not done and self.state.name != "IDLE",
                ALL_READY=done,
                FRAME=self.frame,
                PUSH_READY=self.push_ready,
            )
            return int(word)
        return int(self.words.get(address, 0) or 0)

    def write(self, address: int, value: int) -> None:
        self.written.append((address, value))
        if address == self.map.FLAGS.ADDRESS:
            self.words[address] = self.words.get(address, 0) & ~value
        else:
            self.words[address] = value & self.kept.get(address, 0xFFFFFFFF)
        if address == self.map.PUSH.ADDRESS:
            self.open.append(self.words[self.map.DATA_B.ADDRESS] << 32 | self.words[self.map.DATA_A.ADDRESS])
            if value:
                self.take(self.open)
                self.open = []

    def stream(self, beats: Sequence[int]) -> None:
        self.take(list(beats))

    def take(self, beats: list[int]) -> None:
        self.frames.append(beats)
        self.left = self.lag
