# SPDX-License-Identifier: Apache-2.0
"""Drivers of the cores, for any bus that reads and writes words.

Buses: the simulator's (relnav.rtlsim.bus), /dev/mem's and UIO's (relnav.buses.memory_map), PYNQ's
(relnav.buses.pynq). `CoreDriver` is what every core has; `OltaeDriver` and
relnav.ivisnav.driver.IvisnavDriver add their frames.

What is read may have been upset on its way: results, and all that decides whether there are any, are read
until two readings in a row agree, and FLAGS are looked at after the results.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import IntEnum
from typing import Any, ClassVar, Generic, Literal, Protocol, TypeVar

import numpy as np
import numpy.typing as npt

from .errors import BackendError, InputError, UpsetError
from .model.raw import RESULT_WORDS, CoreConfig, RawResult, results_from_words
from .quantise import IntArray, QuantisedFrame
from .registermap import Register
from .registers import Oltae
from .result import FAILURES

Feed = Literal["stream", "registers"]

POLLS = 10_000
"""Looks at the core before a frame counts as lost. A solved frame takes about 40 on the slowest bus. All of
them take a fraction of a second where `idle` returns at once, and 100 s where each waits 10 ms for an
interrupt (UioBus): see `polls`."""
READINGS = 4  # of the same registers, of which two in a row have to agree

Value = TypeVar("Value")


class Registers(Protocol):
    """The registers of a core; all calls block, errors are the bus's own exceptions."""

    def read(self, address: int) -> int:
        """The register word at a byte address of the core."""

    def write(self, address: int, value: int) -> None:
        """Write a whole register word."""


class Bus(Registers, Protocol):
    """What the driver needs of the hardware."""

    def stream(self, beats: Sequence[int]) -> None:
        """Give one frame's 64-bit beats to the AXI-Stream, tlast with the last.

        May return before the core has taken them, as a DMA does: the driver waits on the registers.
        """


@dataclass(frozen=True)
class CoreStatus:
    """The STATUS register. frame: frames completed since the reset, modulo 2^16."""

    state: IntEnum
    busy: bool
    all_ready: bool
    push_ready: bool
    frame: int


StatusT = TypeVar("StatusT", bound=CoreStatus)


def join(low: IntArray, high: IntArray) -> npt.NDArray[np.uint64]:
    """64-bit beats of two arrays of the same shape, of which the low 32 bits count."""
    halves = [(part.astype(np.int64) & 0xFFFFFFFF).astype(np.uint64) for part in (low, high)]
    return (halves[1] << np.uint64(32)) | halves[0]


def push_beat(bus: Registers, beat: int, *, last: bool = False) -> None:
    """One beat by the registers DATA_A, DATA_B and PUSH, which are the same in every core."""
    bus.write(Oltae.DATA_A.ADDRESS, beat & 0xFFFFFFFF)
    bus.write(Oltae.DATA_B.ADDRESS, beat >> 32)
    bus.write(Oltae.PUSH.ADDRESS, Oltae.PUSH.encode(LAST=last))


class CoreDriver(Generic[StatusT]):
    """One core behind a bus. Not for two threads at once; nobody else may write the core's registers.

    idle: called between two looks at an unfinished frame; it may sleep or block until the interrupt.
    """

    MAP: ClassVar[Any]
    """The core's class of relnav.registers."""
    NAME: ClassVar[str]
    ROWS: ClassVar[str]
    """What a frame consists of, in the plural."""
    STATUS: type[StatusT]
    FAILURE_BITS: ClassVar[int]
    """Flags that end a frame without a result."""

    def __init__(self, bus: Bus, idle: Callable[[], None] = lambda: None) -> None:
        self.bus = bus
        self.idle = idle

    # ------------------------------------------------------------------ registers

    def read(self, register: type[Register]) -> int:
        """A register's word."""
        return self.bus.read(register.ADDRESS)

    def write(self, register: type[Register], word: int) -> None:
        """Write a register's word."""
        self.bus.write(register.ADDRESS, word)

    def read_twice(self, take: Callable[[], Value]) -> Value:
        """What `take` reads, once two readings in a row agree; raises UpsetError where none do."""
        before = take()
        for _ in range(READINGS - 1):
            again = take()
            if again == before:
                return again
            before = again
        raise UpsetError(f"{READINGS} readings of the same registers differ: the bus or the core is upset")

    def write_checked(self, register: type[Register], word: int) -> None:
        """Write a register's word that stays; raises UpsetError where it is not what is then read."""
        self.write(register, word)
        found = self.read_twice(lambda: self.read(register))
        if found != word:
            raise UpsetError(f"{register.__name__} reads 0x{found:08x} after 0x{word:08x} was written")

    # ------------------------------------------------------------------ control

    def check_identity(self) -> int:
        """The BUILD word; raises BackendError that says what was found for another core or version."""
        found, wanted = self.read(self.MAP.ID), self.MAP.ID.RESET
        if found != wanted:
            raise BackendError(f"no {self.NAME} core here: ID reads 0x{found:08x}, not 0x{wanted:08x}")
        version, ours = self.read(self.MAP.VERSION), self.MAP.VERSION.RESET
        if version >> 8 != ours >> 8:  # patches keep the registers
            raise BackendError(
                f"the core is version {self._version(version)}, this driver is for {self._version(ours)}: "
                "build the one or install the other"
            )
        return self.read(self.MAP.BUILD)

    def _version(self, word: int) -> str:
        fields = self.MAP.VERSION.decode(word)
        return f"{fields['MAJOR']}.{fields['MINOR']}.{fields['PATCH']}"

    def status(self) -> StatusT:
        """The STATUS register."""
        fields = {
            name.lower(): value for name, value in self.MAP.STATUS.decode(self.read(self.MAP.STATUS)).items()
        }
        state, frame = self.MAP.State(fields.pop("state")), fields.pop("frame")
        flags: dict[str, Any] = {name: bool(value) for name, value in fields.items()}
        return self.STATUS(state=state, frame=frame, **flags)

    def check_unlocked(self) -> None:
        """Raises BackendError while a frame is open."""
        if self.status().busy:
            raise BackendError(
                "the core is busy: its configuration is locked (recover() drops the frame at hand; "
                "stop the sender first)"
            )

    def flags(self) -> int:
        """The sticky FLAGS."""
        return self.read(self.MAP.FLAGS)

    def frame_flags(self) -> int:
        """The FRAME_FLAGS, those of the last frame."""
        return self.read(self.MAP.FRAME_FLAGS)

    def clear_flags(self, bits: int | None = None) -> None:
        """Clear these sticky FLAGS, all by default."""
        every = sum(field.mask for field in self.MAP.FLAGS.FIELDS.values())
        self.write(self.MAP.FLAGS, every if bits is None else bits)

    def enable_interrupts(self, *, done: bool = False, error: bool = False) -> None:
        """Which events raise the irq line: a completed frame, a flag."""
        self.write(self.MAP.IRQ_ENABLE, self.MAP.IRQ_ENABLE.encode(DONE=done, ERROR=error))

    def clear_interrupts(self) -> tuple[bool, bool]:
        """(done, error) that were pending; they are cleared, and so the irq line falls."""
        word = self.read(self.MAP.IRQ_STATUS)
        self.write(self.MAP.IRQ_STATUS, word)
        return bool(self.MAP.IRQ_STATUS.DONE.get(word)), bool(self.MAP.IRQ_STATUS.ERROR.get(word))

    def acknowledge(self) -> None:
        """DONE back to IDLE. Not needed before the next frame."""
        self.write(self.MAP.CONTROL, self.MAP.CONTROL.encode(ACKNOWLEDGE=1))

    def soft_reset(self) -> None:
        """Drop the frame at hand; configuration, flags and results stay. Stop the stream's sender first."""
        self.write(self.MAP.CONTROL, self.MAP.CONTROL.encode(SOFT_RESET=1))

    def recover(self) -> None:
        """Drop the frame at hand, clear flags and interrupts: after an UpsetError, after a frame without an
        end, and at the start, where another program may have left the core in a frame.

        The core's watchdog ends a solving that is stuck, but the rest of a frame is waited for without end.
        Stop the stream's sender first. `configure` (and so `solve`) then writes the configuration again.
        """
        self.soft_reset()
        self.clear_flags()
        self.clear_interrupts()

    # ------------------------------------------------------------------ frames

    def feed(self, beats: Sequence[int], feed: Feed = "stream") -> int:
        """Give the core one frame; returns the ticket that `wait` takes.

        feed: "stream", or "registers", which needs no DMA. Clears the sticky FLAGS and IRQ_STATUS, so that
        the interrupt is this frame's.
        Raises InputError for a frame without beats, which nothing could end; BackendError when it cannot be
        pushed.
        """
        if not beats:
            raise InputError(f"a frame without {self.ROWS} cannot be given to the core")
        self.clear_flags()
        self.clear_interrupts()
        status = self.read_twice(self.status)
        if feed == "stream":
            self.bus.stream(beats)
            return status.frame
        if not status.push_ready:
            raise BackendError("the core takes no push: it is busy or a stream's frame is open")
        for number, beat in enumerate(beats, 1):
            # PUSH_READY need not be read in between: an open frame takes a beat before the next write comes.
            self.push(beat, last=number == len(beats))
        return status.frame

    def push(self, beat: int, *, last: bool = False) -> None:
        """One beat by the registers."""
        push_beat(self.bus, beat, last=last)

    def wait(self, ticket: int, polls: int = POLLS) -> bool:
        """Wait for the frame of this ticket; True when it was solved, False when it failed (see FRAME_FLAGS).

        What counts is the number of completed frames and the FLAGS that `feed` cleared: neither can be the
        frame's before, however late the core takes the first beat. Two looks in a row have to say the same.
        Raises BackendError after `polls`: the frame is open then, and the core busy until `recover`.
        Call it before `acknowledge`, and before the next frame is fed.
        """
        before: bool | None = None
        for _ in range(polls):
            solved = self._outcome(ticket)
            if solved is not None and solved == before:
                return solved
            if solved is None:
                self.idle()
            before = solved
        state = self.status().state.name
        raise BackendError(
            f"no result after {polls} looks at the core: its state is {state}; recover() makes it ready again"
        )

    def _outcome(self, ticket: int) -> bool | None:
        """One look at the frame of this ticket: solved, failed, or None: not over yet."""
        flags = self.flags()  # before STATUS: TOO_LONG rises while the frame is still swallowed
        status = self.status()
        # all of it: one wrong bit must not make a frame of none, nor provisional results verified ones
        if status.frame != ticket and status.state.name == "DONE" and status.all_ready:
            return True
        return False if flags & self.FAILURE_BITS and not status.busy else None

    def finish(self, ticket: int, polls: int, take: Callable[[], Value]) -> Value | None:
        """Wait for the frame of this ticket; what `take` then reads, or None where the frame failed.

        Raises UpsetError where the core noticed an upset, of this frame or while its results were read.
        """
        solved = self.wait(ticket, polls)
        taken = self.read_twice(take) if solved else None
        found = self.flags() | self.frame_flags()
        if found & self.MAP.FLAGS.UPSET.mask or (solved and found & self.FAILURE_BITS):
            names = ", ".join(name for name, set_ in self.MAP.FLAGS.decode(found).items() if set_)
            raise UpsetError(f"the {self.NAME} core was upset (FLAGS: {names}): give the frame again")
        return taken

    def result_words(self, first: type[Register], count: int) -> list[int]:
        """The result registers, from the first on."""
        return [self.bus.read(first.ADDRESS + 4 * index) for index in range(count)]


# ---------------------------------------------------------------------------------------------------- OLTAE


@dataclass(frozen=True)
class Build:
    """The BUILD register: what this core was built with. Without verify, results are computed once only."""

    weighted: bool
    covariance: bool
    reapply: bool
    verify: bool
    mantissa: int


@dataclass(frozen=True)
class Status(CoreStatus):
    """STATUS of OLTAE."""

    q_ready: bool
    pose_ready: bool


def beats_of(frame: QuantisedFrame) -> list[int]:
    """The 64-bit beats of a frame: a point is {b_k, a_k} for k = x, y, z, with its weight's beat in front."""
    words = join(frame.a, frame.b)
    if frame.w is not None:
        words = np.hstack((frame.w.astype(np.uint64)[:, None] & np.uint64(0xFFFF), words))
    beats: list[int] = words.ravel().tolist()
    return beats


class OltaeDriver(CoreDriver[Status]):
    """One OLTAE core. `solve` does all of it; the steps are there for who wants something in between."""

    MAP = Oltae
    NAME = "OLTAE"
    ROWS = "points"
    STATUS = Status
    FAILURE_BITS = Oltae.FLAGS.encode(**dict.fromkeys(FAILURES, 1))

    def __init__(self, bus: Bus, idle: Callable[[], None] = lambda: None) -> None:
        super().__init__(bus, idle)
        self._covariance = True

    def identify(self) -> Build:
        """Check that this is an OLTAE core of our version; raises BackendError that says what was found."""
        build = Oltae.BUILD.decode(self.check_identity())
        return Build(
            weighted=bool(build["WEIGHTED"]),
            covariance=bool(build["COVARIANCE"]),
            reapply=bool(build["REAPPLY"]),
            verify=bool(build["VERIFY"]),
            mantissa=build["MANTISSA"],
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
        self.check_unlocked()
        self.write(Oltae.CONFIG, word)
        kept = self.read_twice(lambda: self.read(Oltae.CONFIG))  # a bit that is not built reads as 0
        if weighted and not Oltae.CONFIG.WEIGHTED.get(kept):
            raise BackendError("this core was built without weights")
        self._covariance = bool(Oltae.CONFIG.COVARIANCE.get(kept))
        self.write_checked(Oltae.FRAC, Oltae.FRAC.encode(FRAC=frac))
        self.write_checked(Oltae.VARIANCE, variance)

    def result(self) -> RawResult:
        """The registers of the frame that was solved last, with its flags and cycles."""
        words = self.result_words(Oltae.Q, RESULT_WORDS)
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
        """Configure, feed, wait, read. A frame that failed has its flags and no numbers.

        Raises UpsetError for numbers that are not to be believed: `recover`, and give the frame again.
        """
        self.configure(
            config or CoreConfig(),
            frac=frame.frac,
            weighted=frame.w is not None,
            weight_scale=frame.weight_scale,
        )
        result = self.finish(self.feed(beats_of(frame), feed), polls, self.result)
        return result or RawResult(flags=self.read_twice(self.frame_flags))
