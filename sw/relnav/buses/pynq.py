# SPDX-License-Identifier: Apache-2.0
"""The cores on a PYNQ board. Needs the package `pynq`, which only its boards have.

Once this module is imported, an overlay's cores are objects of the classes below:

    import relnav.buses.pynq
    overlay = pynq.Overlay("relnav.bit")
    driver = overlay.oltae.driver(overlay.dma)
    raw = driver.solve(quantise(frame))
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from pynq import DefaultIP, allocate

from relnav.driver import OltaeDriver
from relnav.errors import BackendError
from relnav.ivisnav.driver import IvisnavDriver
from relnav.vlnv import vlnv

from .axi_dma import LOOKS
from .memory_map import push_beats


class PynqDma:
    """`relnav.buses.memory_map.Dma` on an overlay's AXI DMA; the buffer grows with the longest frame."""

    def __init__(self, dma: Any) -> None:
        """dma: pynq.lib.DMA with a memory-to-stream channel."""
        self.channel = dma.sendchannel
        self._buffer: Any = None
        self._sending = False

    def send(self, beats: Sequence[int]) -> None:
        """Start a frame's transfer, after the one before has ended."""
        self.wait()
        if self._buffer is None or len(self._buffer) < len(beats):
            self._release()
            self._buffer = allocate(shape=(len(beats),), dtype=np.uint64)
        self._buffer[: len(beats)] = beats
        self._sending = True
        # the channel flushes the cache
        self.channel.transfer(self._buffer, nbytes=8 * len(beats))

    def wait(self) -> None:
        """Until the core has taken the last beat of what was sent."""
        if not self._sending:
            return
        for _ in range(LOOKS):  # the channel's own wait has no bound
            if self.channel.idle:
                self._sending = False
                return
        raise BackendError("the DMA's transfer does not end: the core takes no beats")

    def reset(self) -> None:
        """Drop what is still to be sent: before CoreDriver.soft_reset, and after an error."""
        self._sending = False
        self.channel.stop()
        self.channel.start()

    def _release(self) -> None:
        if self._buffer is not None:
            self._buffer.freebuffer()


class PynqBus:
    """`relnav.driver.Bus` on an IP of an overlay. Without a DMA beats are pushed by the registers."""

    def __init__(self, ip: Any, dma: Any = None) -> None:
        """ip: a pynq.DefaultIP; dma: a pynq.lib.DMA whose stream goes to the core."""
        self.ip = ip
        self.dma = None if dma is None else PynqDma(dma)

    def read(self, address: int) -> int:
        """A register's word."""
        return int(self.ip.read(address))

    def write(self, address: int, value: int) -> None:
        """Write a register's word."""
        self.ip.write(address, value)

    def stream(self, beats: Sequence[int]) -> None:
        """Give one frame's beats to the core."""
        if self.dma is not None:
            self.dma.send(beats)
        else:
            push_beats(self, beats)


class OltaeIP(DefaultIP):  # type: ignore[misc]  # pynq has no types
    """oltae_top in an overlay."""

    bindto = [vlnv("oltae_top")]  # noqa: RUF012  # pynq reads it so

    def driver(self, dma: Any = None) -> OltaeDriver:
        """The core's driver; dma: the overlay's AXI DMA, where frames come by the stream."""
        return OltaeDriver(PynqBus(self, dma))


class IvisnavIP(DefaultIP):  # type: ignore[misc]
    """ivisnav_top in an overlay."""

    bindto = [vlnv("ivisnav_top")]  # noqa: RUF012

    def driver(self, dma: Any = None) -> IvisnavDriver:
        """The core's driver; dma: the overlay's AXI DMA, where frames come by the stream."""
        return IvisnavDriver(PynqBus(self, dma))
