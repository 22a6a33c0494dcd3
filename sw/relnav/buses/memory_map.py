# SPDX-License-Identifier: Apache-2.0
"""Registers that lie in memory: `/dev/mem` at a physical address, or a UIO device with its interrupt.

bus = UioBus("/dev/uio0")                            # or DevMemBus(0x43C0_0000)
driver = OltaeDriver(bus, bus.idle)
driver.enable_interrupts(done=True, error=True)      # what ends bus.idle early
"""

from __future__ import annotations

import mmap
import os
import select
import struct
from collections.abc import Sequence
from pathlib import Path
from typing import Protocol

import numpy as np
import numpy.typing as npt

from relnav.driver import Registers, push_beat
from relnav.errors import BackendError, one_line
from relnav.registers import Oltae as Common

CORE_BYTES = 4096  # of address space, of every core
PUSH_LOOKS = 100_000  # at STATUS, before a core counts as one that takes no push
SYSFS = Path("/sys/class/uio")


class Dma(Protocol):
    """What sends a frame to the core's AXI-Stream, as `relnav.driver.Bus.stream` does."""

    def send(self, beats: Sequence[int]) -> None:
        """Start to send 64-bit beats, tlast with the last; may return before they are taken."""


class MemoryMap:
    """A stretch of a device file, mapped; `words` are its 32-bit words. Close it, or use it in a `with`.

    An item of a numpy array is read and written by one aligned 32-bit access, as registers want it. Slices of
    bytes, or of a memoryview, are copied by whatever accesses memcpy takes.
    """

    words: npt.NDArray[np.uint32]

    def __init__(self, file: str | Path, offset: int, size: int) -> None:
        """offset, size: bytes, multiples of 4. Raises BackendError: no such device, no right to it."""
        if offset % 4 or size % 4 or size <= 0:
            raise BackendError(f"{file}: {size} bytes at 0x{offset:x} are no whole words")
        inside = offset % mmap.ALLOCATIONGRANULARITY  # only whole pages can be mapped
        try:
            handle = os.open(file, os.O_RDWR | os.O_SYNC)  # O_SYNC: /dev/mem uncached
            try:
                self._memory = mmap.mmap(handle, size + inside, offset=offset - inside)
            finally:
                os.close(handle)
        except (OSError, ValueError, OverflowError) as error:
            reason = error.strerror if isinstance(error, OSError) else error
            raise BackendError(f"{file}: cannot map {size} bytes at 0x{offset:x}: {reason}") from None
        self.words = np.frombuffer(self._memory, np.uint32, size // 4, inside)

    def read(self, address: int) -> int:
        """The word at a byte address."""
        return int(self.words[self._index(address)])

    def write(self, address: int, value: int) -> None:
        """Write a word at a byte address. Raises BackendError: no such word, or a value that is none."""
        if not 0 <= value <= 0xFFFFFFFF:
            raise BackendError(f"{value} at byte address 0x{address:x} is no word of 32 bits")
        self.words[self._index(address)] = value

    def _index(self, address: int) -> int:
        if address % 4 or not 0 <= address < 4 * len(self.words):
            raise BackendError(f"no word at byte address 0x{address:x} of {4 * len(self.words)} bytes")
        return address // 4

    def close(self) -> None:
        """Give the memory back."""
        self.words = np.empty(0, np.uint32)  # mmap cannot be closed while it is looked at
        self._memory.close()

    def __enter__(self) -> MemoryMap:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


class MappedBus:
    """`relnav.driver.Bus` on mapped registers. Without a DMA a stream's beats are pushed by the registers."""

    def __init__(self, registers: MemoryMap, dma: Dma | None = None) -> None:
        self.registers = registers
        self.dma = dma

    def read(self, address: int) -> int:
        """A register's word."""
        return self.registers.read(address)

    def write(self, address: int, value: int) -> None:
        """Write a register's word."""
        self.registers.write(address, value)

    def stream(self, beats: Sequence[int]) -> None:
        """Give one frame's beats to the core. Raises BackendError where it takes none."""
        if self.dma is not None:
            self.dma.send(beats)
        else:
            push_beats(self, beats)

    def close(self) -> None:
        """Give the registers back."""
        self.registers.close()


def push_beats(bus: Registers, beats: Sequence[int]) -> None:
    """One frame's beats, once the core takes pushes.

    Raises BackendError where the core takes no push: it stays busy, or a stream's frame is open.
    """
    for _ in range(PUSH_LOOKS):
        if Common.STATUS.PUSH_READY.get(bus.read(Common.STATUS.ADDRESS)):
            break
    else:
        raise BackendError("the core takes no push: it is busy or a stream's frame is open")
    for number, beat in enumerate(beats, 1):
        push_beat(bus, beat, last=number == len(beats))


class DevMemBus(MappedBus):
    """A core at a physical address, through /dev/mem; needs root."""

    def __init__(
        self, base: int, dma: Dma | None = None, *, size: int = CORE_BYTES, file: str | Path = "/dev/mem"
    ) -> None:
        """base: physical byte address of the core, as the block design assigned it."""
        super().__init__(MemoryMap(file, base, size), dma)


class UioBus(MappedBus):
    """A core behind a UIO device: `uio_pdrv_genirq` on the core's node of the device tree.

    sysfs: where the kernel says how many bytes the device has. A file that stands for a device needs one of
    its own: sysfs/NAME/maps/map0/size and offset, in hexadecimal, NAME being the file's.
    """

    def __init__(
        self,
        device: str | Path,
        dma: Dma | None = None,
        *,
        index: int = 0,
        sysfs: str | Path = SYSFS,
        patience: float = 0.01,
    ) -> None:
        """index: which of the device's maps; patience: of `idle`, in seconds: a driver that waits POLLS
        looks for a frame that never ends is back after POLLS times this.

        Raises BackendError: no such device or map, or one that is too small for a core.
        """
        self.device, self.patience = Path(device), patience
        folder = Path(sysfs) / self.device.name / "maps" / f"map{index}"
        size, inside = _number(folder / "size"), _number(folder / "offset")
        if size < Common.SIZE:
            raise BackendError(f"{device}: map {index} has {size} bytes, a core needs {CORE_BYTES}")
        # a map's number is the page at which mmap finds it
        super().__init__(MemoryMap(device, index * mmap.PAGESIZE + inside, size), dma)
        try:
            self._events = os.open(device, os.O_RDWR)
        except OSError as error:
            self.registers.close()
            raise BackendError(f"{device}: cannot open it for its interrupts: {error.strerror}") from None

    @classmethod
    def named(cls, name: str, dma: Dma | None = None, *, sysfs: str | Path = SYSFS) -> UioBus:
        """The device that the kernel calls `name`, such as the node of the device tree."""
        folders = sorted(Path(sysfs).glob("uio*"))
        for folder in folders:
            if _text(folder / "name").strip() == name:
                return cls(Path("/dev") / folder.name, dma, sysfs=sysfs)
        raise BackendError(f"no UIO device is called {name!r} ({len(folders)} in {sysfs})")

    def wait_interrupt(self, seconds: float) -> bool:
        """Wait for the core's interrupt; False when none came in time.

        The kernel masks the interrupt when it comes, and this unmasks it: as its line is a level, clear it in
        the core (CoreDriver.clear_interrupts, which `feed` does) or the next wait ends at once.
        Raises BackendError where the device has no interrupt.
        """
        try:
            os.write(self._events, struct.pack("=I", 1))
            if not select.select([self._events], [], [], seconds)[0]:
                return False
            os.read(self._events, 4)  # the number of interrupts so far
        except OSError as error:
            raise BackendError(f"{self.device}: cannot wait for its interrupt: {error.strerror}") from None
        return True

    def idle(self) -> None:
        """For the driver: block until the interrupt, but not longer than `patience`."""
        self.wait_interrupt(self.patience)

    def close(self) -> None:
        """Give registers and device back."""
        super().close()
        os.close(self._events)


def _text(file: Path) -> str:
    """An entry of sysfs."""
    try:
        return file.read_text()
    except OSError as error:
        raise BackendError(f"{file}: {error.strerror}: no such UIO device or map") from None


def _number(file: Path) -> int:
    """A hexadecimal number of sysfs."""
    try:
        return int(_text(file), 16)
    except ValueError as error:
        raise BackendError(f"{file}: {one_line(error)}") from None
