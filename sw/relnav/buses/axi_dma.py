# SPDX-License-Identifier: Apache-2.0
"""Frames to the core's AXI-Stream by the memory-to-stream half of AMD's AXI DMA, in direct register mode.

Its registers are those of the product guide PG021. It reads physical memory that is contiguous: a reserved
stretch behind /dev/mem, or a buffer of a driver such as u-dma-buf, whose physical address sysfs tells.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from relnav.errors import BackendError

from .memory_map import MemoryMap

DMACR, DMASR, SA, SA_MSB, LENGTH = 0x00, 0x04, 0x18, 0x1C, 0x28
RUN, RESET = 1 << 0, 1 << 2  # of DMACR
HALTED, IDLE, ERRORS = 1 << 0, 1 << 1, 0x70  # of DMASR
LOOKS = 1_000_000  # at DMASR, before a transfer counts as stuck


class AxiDma:
    """`relnav.buses.memory_map.Dma`: a frame is one transfer, so the buffer has to hold the longest.

    registers: the DMA's; buffer: the memory it reads, uncached or coherent; physical: address of its first
    byte on the DMA's bus; length_bits: of the transfer's length, as the block design has it.
    """

    def __init__(
        self, registers: MemoryMap, buffer: MemoryMap, physical: int, *, length_bits: int = 23
    ) -> None:
        if physical % 8:
            raise BackendError(
                f"the DMA's buffer at 0x{physical:x} does not begin with a whole beat of 8 bytes"
            )
        self.registers, self.buffer, self.physical = registers, buffer, physical
        self.capacity = min(8 * (len(buffer.words) // 2), (1 << length_bits) - 1)
        self._sending = False

    def send(self, beats: Sequence[int]) -> None:
        """Start a frame's transfer, after the one before has ended. Raises BackendError where it does not."""
        size = 8 * len(beats)
        if size > self.capacity:
            raise BackendError(f"the DMA can send {self.capacity} bytes at a time, a frame has {size}")
        self.wait()
        if self.registers.read(DMASR) & HALTED:
            self.registers.write(DMACR, RUN)
            self._until(HALTED, 0, "does not start")
        self.buffer.words[: size // 4] = np.array(beats, "<u8").view("<u4")
        self.registers.write(SA, self.physical & 0xFFFFFFFF)
        self.registers.write(SA_MSB, self.physical >> 32)
        self.registers.write(LENGTH, size)
        self._sending = True

    def wait(self) -> None:
        """Until the core has taken the last beat of what was sent."""
        if self._sending:
            self._until(IDLE, IDLE, "does not end: the core takes no beats")
            self._sending = False

    def reset(self) -> None:
        """Drop what is still to be sent: before CoreDriver.soft_reset, and after an error."""
        self._sending = False
        self.registers.write(DMACR, RESET)
        for _ in range(LOOKS):
            if not self.registers.read(DMACR) & RESET:
                return
        raise BackendError("the DMA does not come out of its reset")

    def _until(self, bits: int, wanted: int, problem: str) -> None:
        for _ in range(LOOKS):
            status = self.registers.read(DMASR)
            if status & ERRORS:
                self.reset()
                raise BackendError(
                    f"the DMA failed, DMASR = 0x{status:08x}: is its buffer at the right address?"
                )
            if status & bits == wanted:
                return
        raise BackendError(f"the DMA's transfer {problem} (DMASR = 0x{status:08x})")
