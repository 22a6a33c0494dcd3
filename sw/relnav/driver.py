# SPDX-License-Identifier: Apache-2.0
"""Driver of the OLTAE core, for any bus that reads and writes words: the simulator's, /dev/mem's, PYNQ's."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Literal, Protocol

import numpy as np

from .errors import BackendError, InputError
from .model.raw import RESULT_WORDS, CoreConfig, RawResult, results_from_words
from .quantise import QuantisedFrame
from .registermap import Register
from .registers import Oltae
from .result import FAILURES

Feed = Literal["stream", "registers"]

POLLS = 10_000  # of STATUS, before a frame counts as lost; a solved frame takes about 40 on the slowest bus
ALL_FLAGS = Oltae.FLAGS.encode(**dict.fromkeys(Oltae.FLAGS.FIELDS, 1))
FAILURE_BITS = Oltae.FLAGS.encode(**dict.fromkeys(FAILURES, 1))


class Bus(Protocol):
    """What the driver needs of the hardware; all calls block, errors are the bus's own exceptions."""

    def read(self, address: int) -> int:
        """The register word at a byte address of the core."""

    def write(self, address: int, value: int) -> None:
        """Write a whole register word."""

    def stream(self, beats: Sequence[int]) -> None:
        """Give one frame's 64-bit beats to the AXI-Stream, tlast with the last.

        May return before the core has taken them, as a DMA does: the driver waits on the registers.
        """


@dataclass(frozen=True)
class Build:
    """The BUILD register: what this core was built with."""

    weighted: bool
    covariance: bool
    reapply: bool
    mantissa: int


@dataclass(frozen=True)
class Status:
    """The STATUS register. frame: frames completed since the reset, modulo 2^16."""

    state: Oltae.State
    busy: bool
    q_ready: bool
    pose_ready: bool
    all_ready: bool
    push_ready: bool
    frame: int


def beats_of(frame: QuantisedFrame) -> list[int]:
    """The 64-bit beats of a frame: a point is {b_k, a_k} for k = x, y, z, with its weight's beat in front."""
    components = np.stack((frame.a, frame.b), axis=2)  # (n, 3, 2)
    halves = components.astype(np.int64) & 0xFFFFFFFF
    words = (halves[:, :, 1].astype(np.uint64) << np.uint64(32)) | halves[:, :, 0].astype(np.uint64)
    if frame.w is not None:
        words = np.hstack((frame.w.astype(np.uint64)[:, None] & np.uint64(0xFFFF), words))
    beats: list[int] = words.ravel().tolist()
    return beats


class OltaeDriver:
    """One OLTAE core behind a bus. Not for two threads at once; nobody else may write the core's registers.

    `solve` does all of it; the steps are there for those who want something else in between.
    idle: called between two looks at an unfinished frame; it may sleep or block until the interrupt.
    """

    def __init__(self, bus: Bus, idle: Callable[[], None] = lambda: None) -> None:
        self.bus = bus
        self.idle = idle
        self._covariance = True

    # ------------------------------------------------------------------ registers

    def read(self, register: type[Register]) -> int:
        """A register's word."""
        return self.bus.read(register.ADDRESS)

    def write(self, register: type[Register], word: int) -> None:
        """Write a register's word."""
        self.bus.write(register.ADDRESS, word)

    # ------------------------------------------------------------------ control

    def identify(self) -> Build:
        """Check that this is an OLTAE core of our version; raises BackendError that says what was found."""
        found = self.read(Oltae.ID)
        if found != Oltae.ID.RESET:
            raise BackendError(f"no OLTAE core here: ID reads 0x{found:08x}, not 0x{Oltae.ID.RESET:08x}")
        version, ours = self.read(Oltae.VERSION), Oltae.VERSION.RESET
        if version >> 8 != ours >> 8:  # patches keep the registers
            raise BackendError(
                f"the core is version {_version(version)}, this driver is for {_version(ours)}: "
                "build the one or install the other"
            )
        build = Oltae.BUILD.decode(self.read(Oltae.BUILD))
        return Build(
            bool(build["WEIGHTED"]), bool(build["COVARIANCE"]), bool(build["REAPPLY"]), build["MANTISSA"]
        )

    def status(self) -> Status:
        """The STATUS register."""
        word = self.read(Oltae.STATUS)
        bits = Oltae.STATUS
        return Status(
            Oltae.State(bits.STATE.get(word)),
            busy=bool(bits.BUSY.get(word)),
            q_ready=bool(bits.Q_READY.get(word)),
            pose_ready=bool(bits.POSE_READY.get(word)),
            all_ready=bool(bits.ALL_READY.get(word)),
            push_ready=bool(bits.PUSH_READY.get(word)),
            frame=bits.FRAME.get(word),
        )

    def configure(
        self, config: CoreConfig, *, frac: int, weighted: bool = False, weight_scale: float = 1.0
    ) -> None:
        """Set CONFIG, FRAC and VARIANCE for the next frames.

        frac: binary places of the inputs; weighted: frames bring weights; weight_scale: of `QuantisedFrame`.
        Raises BackendError while a frame is open and for weights that this core would take for points.
        """
        variance = config.variance_word(weight_scale)
        word = Oltae.CONFIG.encode(
            WEIGHTED=weighted,
            FORBID_TURNS=config.forbid_turns,
            REAPPLY=config.reapply,
            COVARIANCE=config.covariance,
        )
        if self.status().busy:
            raise BackendError("the core is busy: its configuration is locked")
        self.write(Oltae.CONFIG, word)
        kept = self.read(Oltae.CONFIG)  # a bit that is not built reads as 0
        if weighted and not Oltae.CONFIG.WEIGHTED.get(kept):
            raise BackendError("this core was built without weights")
        self._covariance = bool(Oltae.CONFIG.COVARIANCE.get(kept))
        self.write(Oltae.FRAC, Oltae.FRAC.encode(FRAC=frac))
        self.write(Oltae.VARIANCE, variance)

    def flags(self) -> int:
        """The sticky FLAGS."""
        return self.read(Oltae.FLAGS)

    def clear_flags(self, bits: int = ALL_FLAGS) -> None:
        """Clear these sticky FLAGS, all by default."""
        self.write(Oltae.FLAGS, bits)

    def enable_interrupts(self, *, done: bool = False, error: bool = False) -> None:
        """Which events raise the irq line: a completed frame, a flag."""
        self.write(Oltae.IRQ_ENABLE, Oltae.IRQ_ENABLE.encode(DONE=done, ERROR=error))

    def clear_interrupts(self) -> tuple[bool, bool]:
        """(done, error) that were pending; they are cleared, and so the irq line falls."""
        word = self.read(Oltae.IRQ_STATUS)
        self.write(Oltae.IRQ_STATUS, word)
        return bool(Oltae.IRQ_STATUS.DONE.get(word)), bool(Oltae.IRQ_STATUS.ERROR.get(word))

    def acknowledge(self) -> None:
        """DONE back to IDLE. Not needed before the next frame."""
        self.write(Oltae.CONTROL, Oltae.CONTROL.encode(ACKNOWLEDGE=1))

    def soft_reset(self) -> None:
        """Drop the frame at hand; configuration, flags and results stay. Stop the stream's sender first."""
        self.write(Oltae.CONTROL, Oltae.CONTROL.encode(SOFT_RESET=1))

    # ------------------------------------------------------------------ frames

    def feed(self, beats: Sequence[int], feed: Feed = "stream") -> int:
        """Give the core one frame; returns the ticket that `wait` takes.

        beats: of `beats_of`. feed: "stream", or "registers", which needs no DMA. Clears the sticky FLAGS.
        Raises InputError for a frame without beats, which nothing could end; BackendError when it cannot be
        pushed.
        """
        if not beats:
            raise InputError("a frame without points cannot be given to the core")
        self.clear_flags()
        status = self.status()
        if feed == "stream":
            self.bus.stream(beats)
            return status.frame
        if not status.push_ready:
            raise BackendError("the core takes no push: it is busy or a stream's frame is open")
        for number, beat in enumerate(beats, 1):
            # PUSH_READY need not be read in between: an open frame takes a beat before the next write comes.
            self.write(Oltae.DATA_A, beat & 0xFFFFFFFF)
            self.write(Oltae.DATA_B, beat >> 32)
            self.write(Oltae.PUSH, Oltae.PUSH.encode(LAST=number == len(beats)))
        return status.frame

    def wait(self, ticket: int, polls: int = POLLS) -> bool:
        """Wait for the frame of this ticket; True when it was solved, False when it failed (see FRAME_FLAGS).

        What counts is the number of completed frames and the FLAGS that `feed` cleared: neither can be the
        frame's before, however late the core takes the first beat. Raises BackendError after `polls`.
        """
        for _ in range(polls):
            flags = self.flags()  # before STATUS: TOO_LONG rises while the frame is still swallowed
            status = self.status()
            if status.frame != ticket:
                return True
            if flags & FAILURE_BITS and not status.busy:
                return False
            self.idle()
        raise BackendError(f"no result after {polls} looks at the core: its state is {status.state.name}")

    def result(self) -> RawResult:
        """The registers of the frame that was solved last, with its flags and cycles."""
        words = [self.bus.read(Oltae.Q.ADDRESS + 4 * index) for index in range(RESULT_WORDS)]
        return RawResult(
            points=self.read(Oltae.POINTS),
            weight=self.read(Oltae.WEIGHT),
            turn=self.read(Oltae.TURN),
            flags=self.read(Oltae.FRAME_FLAGS),
            cycles_q=self.read(Oltae.CYCLES_Q),
            cycles_pose=self.read(Oltae.CYCLES_POSE),
            cycles_all=self.read(Oltae.CYCLES_ALL),
            **results_from_words(words, covariance=self._covariance),  # type: ignore[arg-type]
        )

    def solve(
        self,
        frame: QuantisedFrame,
        config: CoreConfig | None = None,
        *,
        feed: Feed = "stream",
        polls: int = POLLS,
    ) -> RawResult:
        """Configure, feed, wait, read. A frame that failed has its flags and no numbers."""
        self.configure(
            config or CoreConfig(),
            frac=frame.frac,
            weighted=frame.w is not None,
            weight_scale=frame.weight_scale,
        )
        if self.wait(self.feed(beats_of(frame), feed), polls):
            return self.result()
        return RawResult(flags=self.read(Oltae.FRAME_FLAGS))


def _version(word: int) -> str:
    fields = Oltae.VERSION.decode(word)
    return f"{fields['MAJOR']}.{fields['MINOR']}.{fields['PATCH']}"
