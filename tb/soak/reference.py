# SPDX-License-Identifier: Apache-2.0
"""A core's ports clock by clock, from docs/ alone: what the soak compares the trace with.

Everything that leaves the core is predicted, in every clock: all answers of the bus, `irq`, `tready`, the
state, every register read and every result word. Four things are taken from the trace, none of them data:
when the array throttles the beats (`beat_ready`), when the result memory makes a read wait (`result_wait`),
and the clock in which a frame is found to be rank-deficient or ill-conditioned. Each of them must come in
time, and the last two exactly for the frames that the model says.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field

from tb.soak.cores import BUSY_WRITE, Core, Settings, Solved

IDLE, LOADING, COMPUTE, DONE, VERIFY = range(5)
STATES = ("IDLE", "loading", "COMPUTE", "DONE", "VERIFY")
SLVERR = 2
RESULTS = 0x100
SWALLOW = 2  # of the loader, whose other states are IDLE and LOADING
THROTTLE = 16  # clocks in which the array must take a beat
MEMORY = 64  # clocks in which the result memory must answer
LONGEST = 65535
QUIET = 8  # clocks after which nothing inside moves by itself but the program

# bits of a line of the trace: tb/soak/soak_harness.v
(
    RST,
    AWVALID,
    AWREADY,
    WVALID,
    WREADY,
    BVALID,
    BREADY,
    BRESP,
    _,
    ARVALID,
    ARREADY,
    RVALID,
    RREADY,
    RRESP,
    _,
    TVALID,
    TREADY,
    TLAST,
    IRQ,
    BEAT_READY,
    RESULT_WAIT,
    RANK,
    ILL,
) = (1 << bit for bit in range(23))
STATE = 23
UNKNOWN = 1 << 26
EPISODE = 27
OUTPUTS = AWREADY | WREADY | BVALID | 3 * BRESP | ARREADY | RVALID | 3 * RRESP | TREADY | IRQ | 7 << STATE
NAMES = {
    AWREADY: "awready",
    WREADY: "wready",
    BVALID: "bvalid",
    3 * BRESP: "bresp",
    ARREADY: "arready",
    RVALID: "rvalid",
    3 * RRESP: "rresp",
    TREADY: "tready",
    IRQ: "irq",
    7 << STATE: "state",
}


class Mismatch(AssertionError):
    """The core did something else than the model."""


@dataclass
class Totals:
    """What was seen."""

    episodes: int = 0
    frames: int = 0
    """Complete, solved or refused."""
    solved: int = 0
    dropped: int = 0
    beats: int = 0
    pushes: int = 0
    reads: int = 0
    writes: int = 0
    refused_accesses: int = 0
    """SLVERR."""
    soft_resets: int = 0
    hard_resets: int = 0
    acknowledges: int = 0
    words: int = 0
    """Result words read and compared."""
    cycles: int = 0
    flags: Counter[str] = field(default_factory=Counter)
    """Raised, by name."""
    resets_in: Counter[str] = field(default_factory=Counter)
    """Soft and hard resets by the state they hit."""
    refusals: Counter[str] = field(default_factory=Counter)
    """Clocks from the last beat to a refusal."""

    def add(self, other: Totals) -> None:
        """Sum up."""
        for name, value in vars(other).items():
            if isinstance(value, Counter):
                getattr(self, name).update(value)
            else:
                setattr(self, name, getattr(self, name) + value)


class Reference:
    """One core. `clock` compares one clock's ports and goes on to the next."""

    def __init__(self, core: Core, totals: Totals, behind: int) -> None:
        self.core, self.totals, self.behind = core, totals, behind
        self.name_of = {address: register.__name__ for address, register in core.registers.items()}
        self.flags_mask = sum(f.mask for f in core.map.FLAGS.FIELDS.values())
        self.busy_write = core.flag(BUSY_WRITE)
        self.bits = {name: core.flag(name) for name in core.map.FLAGS.FIELDS}
        self.results = sum(len(group) for group in core.groups)
        self.ready_bits = [core.map.STATUS.FIELDS[n].mask for n in (
            ("Q_READY", "POSE_READY", "ALL_READY") if len(core.groups) == 3 else ("RATES_READY", "ALL_READY")
        )]  # fmt: skip
        self.started = False
        self.was_reset = True
        self.reset()

    def reset(self) -> None:
        """As `rst` leaves it, at the end of its clock."""
        # bus
        self.awready = self.wready = self.arready = False
        self.awaddr = self.wdata = self.wstrb = self.araddr = 0
        self.address_full = self.data_full = False
        self.bvalid, self.bresp = False, 0
        self.issue = self.capture = False
        self.rvalid, self.rresp = False, 0
        self.rdata: int | None = 0
        self.captured: int | None = 0
        self.read_waited = 0
        # registers
        self.config = self.core.map.CONFIG.RESET if self.core.in_front else 0
        self.frac = self.variance = self.data_a = self.data_b = 0
        self.soft_reset = self.acknowledge = False
        self.push_valid = False
        self.push_last = False
        self.flags = self.frame_flags = self.irq_enable = self.irq_status = self.irq = 0
        self.frame = 0
        # what stands
        self.count = self.weight = self.extra = 0
        self.cycles = [0] * len(self.core.groups)
        self.words: list[int | None] = [None] * self.results
        # loader
        self.loader = IDLE
        self.from_push = self.weighted = False
        self.rows: list[tuple[int, ...]] = []
        self.row: list[int] = []
        self.some_weight = False
        self.throttled = 0
        # frame
        self.state = IDLE
        self.ready = 0
        self.solved: Solved | None = None
        self.begun = 0
        self.latency: tuple[int, ...] = ()
        self.count_now = 0
        self.ill_seen = False
        self.again: list[int] = []
        """In VERIFY: the clocks in which the groups come once more, and the one that completes the frame."""

    @property
    def next_commit(self) -> int | None:
        """Clock in which the program gives its next group, of a frame that gets so far."""
        if self.state == VERIFY:
            return self.again[0]
        if self.state != COMPUTE or self.solved is None:
            return None
        group = sum(1 for bit in self.ready_bits if self.ready & bit)
        return self.begun + self.latency[group] if self.solved.words else None

    # ------------------------------------------------------------------ registers

    def status(self, push_waits: bool, push_open: bool) -> int:
        busy = 16 if self.state in (LOADING, COMPUTE, VERIFY) else 0
        push = 256 if push_open and not push_waits else 0
        return self.state | busy | self.ready | push | self.frame << 16

    def register(self, address: int, push_waits: bool, push_open: bool) -> int | None:
        """Word of a mapped register; None where nothing is said."""
        name = self.name_of[address]
        core = self.core
        match name:
            case "ID":
                return int(core.map.ID.RESET)
            case "VERSION":
                return int(core.map.VERSION.RESET)
            case "BUILD":
                return core.build
            case "STATUS":
                return self.status(push_waits, push_open)
            case "CONTROL" | "PUSH":
                return 0
            case "FLAGS":
                return self.flags
            case "FRAME_FLAGS":
                return self.frame_flags
            case "IRQ_ENABLE":
                return self.irq_enable
            case "IRQ_STATUS":
                return self.irq_status
            case "CONFIG":
                return self.config
            case "FRAC":
                return self.frac
            case "VARIANCE":
                return self.variance
            case "DATA_A":
                return self.data_a
            case "DATA_B":
                return self.data_b
            case "WEIGHT":
                return self.weight
        if address >= RESULTS:
            word = self.words[(address - RESULTS) >> 2]
            if word is not None:
                self.totals.words += 1
            return word
        if name == core.count:
            return self.count
        if name == core.extra:
            return self.extra
        return self.cycles[core.counters.index(name)]

    # ------------------------------------------------------------------ clock

    def clock(self, now: int, seen: int, wdata: int, rdata: int, tdata: int, address: int) -> None:
        """Compare the ports in the clock `now`, and take its rising edge. address: as the trace packs it."""
        if not self.started:  # the reset that begins an episode hits a core in any state
            self.started = True
            self.reset()
            return
        core, bits = self.core, self.bits
        # ---- loader, combinational
        state, loader, soft = self.state, self.loader, self.soft_reset
        busy = state in (LOADING, COMPUTE, VERIFY)
        from_push, push_before, weighted_before = self.from_push, self.push_valid, bool(self.config & 1)
        source_valid = push_before if from_push else bool(seen & TVALID)
        first = not self.row
        full = len(self.rows) >= LONGEST and first
        weight_beat = self.weighted and first
        loading = loader == LOADING
        to_array = loading and not weight_beat and not full and not soft
        taken_here = loader == SWALLOW or (loading and (weight_beat or full))
        ready = (to_array and bool(seen & BEAT_READY)) or (taken_here and not soft)
        clear = loader == IDLE and not busy and not soft and (push_before or bool(seen & TVALID))
        push_ready = ready and from_push
        push_open = (not busy) if loader == IDLE else from_push
        push_waits = push_before and not push_ready

        # ---- compare
        expected = (
            (AWREADY if self.awready else 0)
            | (WREADY if self.wready else 0)
            | (BVALID | self.bresp * BRESP if self.bvalid else 0)
            | (ARREADY if self.arready else 0)
            | (RVALID | self.rresp * RRESP if self.rvalid else 0)
            | (TREADY if ready and not from_push else 0)
            | (IRQ if self.irq else 0)
            | state << STATE
        )
        if seen & OUTPUTS != expected or seen & UNKNOWN:
            raise Mismatch(f"clock {now}: {_difference(seen, expected)}")
        if self.rvalid and self.rdata is not None and rdata != self.rdata:
            place = f"0x{self.araddr:03x} ({self.name_of.get(self.araddr, 'unmapped')})"
            raise Mismatch(f"clock {now}: read of {place} gave 0x{rdata:08x}, not 0x{self.rdata:08x}")
        if to_array and source_valid and not seen & BEAT_READY:
            self.throttled += 1
            if self.throttled > THROTTLE:
                raise Mismatch(f"clock {now}: the array has taken no beat for {THROTTLE} clocks")
        else:
            self.throttled = 0
        if seen & RST:
            if not self.was_reset:
                self.totals.hard_resets += 1
                self.totals.resets_in[f"hard in {STATES[state]}"] += 1
            self.was_reset = True
            self.reset()
            return
        self.was_reset = False

        self._read(now, seen, address, push_waits, push_open)  # of what stands before this edge

        # ---- frame
        raised = 0
        frame_end = dropped = False
        if ready and source_valid:
            raised, frame_end, dropped = self._beat(seen, tdata, full, weight_beat)
        refused, commits, solved, completed = False, 0, False, False
        if state == COMPUTE:
            more, refused, commits, solved = self._program(now, seen)
            raised |= more
        elif state == VERIFY:
            more, completed = self._second_pass(now, seen)
            raised |= more
        elif seen & (RANK | ILL):
            raise Mismatch(f"clock {now}: a refusal outside COMPUTE")

        # ---- registers
        acknowledge = self.acknowledge
        self.soft_reset = self.acknowledge = False
        if push_ready or soft:
            self.push_valid = False
        irq = int(bool(self.irq_enable & self.irq_status))
        kept, pending = self.flags, self.irq_status
        if self.address_full and self.data_full and not self.bvalid:
            locked, clear_flags, clear_pending = self._write(busy, push_waits, push_open)
            kept, pending = kept & ~clear_flags, pending & ~clear_pending
            if locked:
                raised |= self.busy_write
            self.address_full = self.data_full = False
            self.bvalid = True
        else:
            if seen & BREADY:
                self.bvalid = False
            if self.awready and seen & AWVALID:
                self.awaddr, self.address_full = address >> 20, True
            if self.wready and seen & WVALID:
                self.wdata, self.wstrb, self.data_full = wdata, address >> 4 & 15, True
        self.awready, self.wready = not self.address_full, not self.data_full
        self.irq, self.irq_status = irq, pending | (2 if raised else 0) | completed
        self.flags = kept | raised
        self.frame_flags = (0 if clear else self.frame_flags) | raised
        if raised:
            self.totals.flags.update(name for name, bit in bits.items() if raised & bit)
        self.frame = self.frame + completed & 0xFFFF

        # ---- frame: next
        self.ready = 0 if clear else self.ready | commits
        if frame_end:
            self._solve(now)
        elif dropped or refused:
            self.state = IDLE
        elif solved:
            self.state, self.ill_seen = VERIFY, False
            repeat = now + self.core.again(self.weighted) + self.behind
            latency = self.core.latency(self.weighted, self.config)
            self.again = [*(repeat + clocks for clocks in latency), repeat + latency[-1] + 1]
        elif completed:
            self.state = DONE
        elif clear:
            self.state = self.loader = LOADING
            self.from_push = push_before
            self.weighted = weighted_before and core.in_front
            self.rows, self.row = [], []
            self.some_weight = core.in_front and not self.weighted
        elif state == DONE and acknowledge:
            self.state = IDLE
            self.totals.acknowledges += 1
        if soft:
            self.state = self.loader = IDLE
            self.totals.soft_resets += 1
            self.totals.resets_in[f"soft in {STATES[state]}"] += 1

    def skip(self, clocks: int) -> None:
        """Clocks in which nothing moved, not compared one by one."""
        if self.throttled:
            self.throttled += clocks
        if self.read_waited:
            self.read_waited += clocks

    def _read(self, now: int, seen: int, address: int, push_waits: bool, push_open: bool) -> None:
        """The read channels."""
        issue, capture, answered = self.issue, self.capture, self.rvalid
        accept = bool(seen & ARVALID) and self.arready
        go = False
        if issue:
            known = self.araddr in self.name_of
            if known and self.araddr >= RESULTS and seen & RESULT_WAIT:
                self.read_waited += 1
                if self.read_waited > MEMORY:
                    raise Mismatch(f"clock {now}: the read of 0x{self.araddr:03x} waits for ever")
            else:
                go, self.read_waited = True, 0
                self.captured = self.register(self.araddr, push_waits, push_open) if known else 0
                self.rresp = 0 if known else SLVERR
                self.totals.reads += 1
                self.totals.refused_accesses += not known
        if capture:
            self.rdata, self.rvalid = self.captured, True
        elif seen & RREADY:
            self.rvalid = False
        if accept:
            self.araddr = address >> 8 & 0xFFF
        self.arready = not (accept or issue or capture or (answered and not seen & RREADY))
        self.issue, self.capture = accept or (issue and not go), go

    def _write(self, busy: bool, push_waits: bool, push_open: bool) -> tuple[bool, int, int]:
        """A write acts. Returns (ignored since locked, bits of FLAGS and of IRQ_STATUS to clear)."""
        core, data, strobe = self.core, self.wdata, self.wstrb
        mask = sum(0xFF << 8 * k for k in range(4) if strobe >> k & 1)
        name = self.name_of.get(self.awaddr)
        self.bresp = 0 if name else SLVERR
        self.totals.writes += 1
        self.totals.refused_accesses += not name
        if busy and name in ("CONFIG", "FRAC", "VARIANCE"):
            return True, 0, 0
        match name:
            case "CONTROL" if strobe & 1:
                self.soft_reset, self.acknowledge = bool(data & 1), bool(data & 2)
            case "CONFIG" if strobe & 1:
                self.config = data & 15
            case "FRAC":
                given = [data >> 8 * k & 0xFF for k in range(core.fracs) if strobe >> k & 1]
                if not any(95 < byte < 192 for byte in given):
                    mask &= (1 << 8 * core.fracs) - 1
                    self.frac = self.frac & ~mask | data & mask
            case "VARIANCE":
                self.variance = self.variance & ~mask | data & mask
            case "DATA_A" | "DATA_B" if push_waits:
                return True, 0, 0
            case "DATA_A":
                self.data_a = self.data_a & ~mask | data & mask
            case "DATA_B":
                self.data_b = self.data_b & ~mask | data & mask
            case "PUSH":
                if push_waits or not push_open:
                    return True, 0, 0
                self.push_valid, self.push_last = True, bool(data & strobe & 1)
            case "FLAGS":
                return False, data & mask, 0
            case "IRQ_ENABLE" if strobe & 1:
                self.irq_enable = data & 3
            case "IRQ_STATUS" if strobe & 1:
                return False, 0, data & 3
        return False, 0, 0

    def _beat(self, seen: int, tdata: int, full: bool, weight_beat: bool) -> tuple[int, bool, bool]:
        """A beat is taken. Returns (flags raised, the frame is complete, it is dropped)."""
        core, bits = self.core, self.bits
        if self.from_push:
            data, last = self.data_b << 32 | self.data_a, self.push_last
            self.totals.pushes += 1
        else:
            data, last = tdata, bool(seen & TLAST)
            self.totals.beats += 1
        raised, good = 0, False
        if self.loader == LOADING and full:
            raised = bits["TOO_LONG"]
            self.loader = SWALLOW
        elif self.loader == LOADING:
            self.row.append(data)
            if weight_beat:
                self.some_weight |= bool(data & 0xFFFF)
            closing = len(self.row) == core.beats + self.weighted
            if closing:
                if not core.in_front:
                    self.some_weight |= bool(data >> 32 & 0xFFFF)
                self.rows.append(tuple(self.row))
                self.row = []
            if last and not closing:
                raised = bits["BAD_TLAST"]
            elif last:
                raised = bits[core.few] if len(self.rows) < core.least else 0
                raised |= 0 if self.some_weight else bits["ZERO_WEIGHT"]
                good = not raised
        if last:
            self.loader = IDLE
            self.totals.dropped += not good
        return raised, last and good, last and not good

    def _solve(self, now: int) -> None:
        """A frame is complete."""
        self.state, self.begun, self.ill_seen = COMPUTE, now, False
        self.count_now = len(self.rows)
        self.latency = tuple(c + self.behind for c in self.core.latency(self.weighted, self.config))
        settings = Settings(self.config, self.frac, self.variance)
        self.solved = self.core.solve(self.rows, self.weighted, settings)
        self.totals.frames += 1

    def _program(self, now: int, seen: int) -> tuple[int, bool, int, bool]:
        """A clock of COMPUTE. Returns (flags raised, refused, bits of STATUS that rise, first pass over)."""
        core, bits, solved, clocks = self.core, self.bits, self.solved, now - self.begun
        assert solved is not None
        raised, refused = 0, False
        for bit, name in ((RANK, "RANK_DEFICIENT"), (ILL, "ILL_CONDITIONED")):
            if not seen & bit:
                continue
            if name not in solved.flags or clocks > self.latency[0] or self.ill_seen:
                raise Mismatch(
                    f"clock {now}: {name} {clocks} clocks after the last beat; model: {solved.flags}"
                )
            raised |= bits[name]
            self.ill_seen = bit == ILL
            self.totals.refusals[f"{name}, {'weighted' if self.weighted else 'plain'}: {clocks}"] += 1
            if not solved.words:
                refused = True
                if bit == ILL:
                    self.extra = solved.extra
        if not solved.words:
            if clocks > self.latency[0] and not refused:
                raise Mismatch(f"clock {now}: no {' '.join(solved.flags)} by the clock of the first result")
            return raised, refused, 0, False
        group = sum(1 for bit in self.ready_bits if self.ready & bit)
        if clocks != self.latency[group]:
            return raised, False, 0, False
        self.words[core.groups[group].start : core.groups[group].stop] = solved.words[
            core.groups[group].start : core.groups[group].stop
        ]
        self.cycles[group] = clocks
        if group == 0:
            self.count, self.weight, self.extra = self.count_now, solved.weight, solved.extra
            if self.ill_seen != ("ILL_CONDITIONED" in solved.flags):
                raise Mismatch(f"clock {now}: ILL_CONDITIONED is missing")
        if group == 1 and "Q_SATURATED" in solved.flags:
            raised |= bits["Q_SATURATED"]
        ended = group == len(core.groups) - 1
        self.totals.solved += ended
        return raised, False, self.ready_bits[group], ended

    def _second_pass(self, now: int, seen: int) -> tuple[int, bool]:
        """A clock of VERIFY: flags that stand beside results rise once more.

        Returns (flags raised, frame complete).
        """
        bits, solved = self.bits, self.solved
        assert solved is not None
        raised = 0
        if seen & (RANK | ILL):
            if seen & RANK or "ILL_CONDITIONED" not in solved.flags or self.ill_seen:
                raise Mismatch(f"clock {now}: a refusal in VERIFY; model: {solved.flags}")
            self.ill_seen = True
            raised |= bits["ILL_CONDITIONED"]
        if now != self.again[0]:
            return raised, False
        passed = len(self.core.groups) + 1 - len(self.again)
        if passed == 0 and self.ill_seen != ("ILL_CONDITIONED" in solved.flags):
            raise Mismatch(f"clock {now}: ILL_CONDITIONED is missing in VERIFY")
        if passed == 1 and "Q_SATURATED" in solved.flags:
            raised |= bits["Q_SATURATED"]
        self.again.pop(0)
        return raised, not self.again


def _difference(seen: int, expected: int) -> str:
    """The outputs that differ, in words."""
    found = [
        f"{name} is {(seen & mask) // (mask & -mask)}, not {(expected & mask) // (mask & -mask)}"
        for mask, name in NAMES.items()
        if (seen ^ expected) & mask
    ]
    return ", ".join(found) or "an output is x"
