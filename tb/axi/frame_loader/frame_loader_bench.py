# SPDX-License-Identifier: Apache-2.0
"""frame_loader against a plain description of what a frame must lead to, clock by clock.

One coroutine does it all: inputs change at the falling edge, outputs are read once they have settled, and the
next rising edge sees both.
"""

from __future__ import annotations

import os
import random
from collections import deque
from dataclasses import dataclass, field
from typing import Any

import cocotb
from cocotb.triggers import ClockCycles, FallingEdge, ReadOnly

from tb.common import clocks, netlist

BEATS = int(os.environ.get("BEATS", "3"))
LEAST = int(os.environ.get("LEAST", "3"))
WEIGHTED = int(os.environ.get("WEIGHTED", "1"))
FRONT, INSIDE = WEIGHTED == 1, WEIGHTED == 2
"""Where a weight may be: a beat in front of the row, or bits 47:32 of its last beat."""
FLAGS = ("few_rows", "zero_weight", "bad_tlast", "too_long")
PULSES = ("clear", "frame_start", "frame_end", "frame_dropped", *FLAGS)
LONGEST = 65535
STATES = ("IDLE", "LOAD", "SWALLOW")


@dataclass
class Frame:
    """The beats of one frame. The counter is set as if `done` rows had come before the first.

    weighted: a weight beat in front of each row.
    """

    beats: list[int]
    weighted: bool = False
    done: int = 0


@dataclass
class Expected:
    """What the Gram array must see, (data, index, weight, last), and the pulses of each accepted beat."""

    beats: list[tuple[int, int, int, int]] = field(default_factory=list)
    pulses: list[set[str]] = field(default_factory=list)
    length: int = 0


def expect(frame: Frame) -> Expected:
    """The contract in plain words."""
    out = Expected(length=len(frame.beats))
    per_row = BEATS + frame.weighted
    weight, total = 1, 0
    swallowing = False
    for position, data in enumerate(frame.beats):
        last = position == len(frame.beats) - 1
        part = position % per_row
        row = frame.done + position // per_row + 1
        pulses: set[str] = set()
        if row > LONGEST:
            if not swallowing:
                pulses.add("too_long")
            swallowing = True
            if last:
                pulses.add("frame_dropped")
            out.pulses.append(pulses)
            continue
        closes = part == per_row - 1
        if frame.weighted and part == 0:
            weight = data & 0xFFFF
            total += weight
        if INSIDE and closes:
            weight = data >> 32 & 0xFFFF
            total += weight
        some = total > 0 or not (frame.weighted or INSIDE)
        good = closes and row >= LEAST and some
        if last:
            if good:
                pulses.add("frame_end")
            else:
                pulses.add("frame_dropped")
                if not closes:
                    pulses.add("bad_tlast")
                else:
                    pulses |= {"few_rows"} if row < LEAST else set()
                    pulses |= set() if some else {"zero_weight"}
        out.pulses.append(pulses)
        if not (frame.weighted and part == 0):
            index = part - frame.weighted
            out.beats.append((data, index, weight if closes else -1, int(last and good)))
    return out


class Source:
    """Frames waiting at one of the two inputs."""

    def __init__(self, dut: Any, names: tuple[str, str, str, str], rng: random.Random) -> None:
        self.valid, self.ready, self.data, self.last = (getattr(dut, name) for name in names)
        self.frames: deque[Frame] = deque()
        self.position = 0
        self.offered = False
        self.rng = rng

    def drive(self, gap: float) -> None:
        """Once valid, a beat stays; without one, data and last are noise."""
        self.offered = bool(self.frames) and (self.offered or self.rng.random() >= gap)
        if self.offered:
            frame = self.frames[0]
            self.data.value = frame.beats[self.position]
            self.last.value = int(self.position == len(frame.beats) - 1)
        else:
            self.data.value = self.rng.getrandbits(64)
            self.last.value = self.rng.getrandbits(1)
        self.valid.value = int(self.offered)

    def taken(self) -> bool:
        return self.offered and bool(int(self.ready.value))

    def advance(self) -> None:
        self.offered = False
        self.position += 1
        if self.position == len(self.frames[0].beats):
            self.drop()

    def drop(self) -> None:
        """Forget what is left of the first frame."""
        self.frames.popleft()
        self.position = 0
        self.offered = False


class Bench:
    def __init__(self, dut: Any, seed: int) -> None:
        self.dut = dut
        self.rng = random.Random(seed)
        stream = ("s_axis_tvalid", "s_axis_tready", "s_axis_tdata", "s_axis_tlast")
        push = ("push_valid", "push_ready", "push_data", "push_last")
        self.sources = {"stream": Source(dut, stream, self.rng), "push": Source(dut, push, self.rng)}
        self.open: Source | None = None
        self.expected = Expected()
        self.seen: list[tuple[int, int, int, int]] = []
        self.accepted = 0
        self.busy = 0  # clocks for which the core does not accept
        self.gap = self.stall = 0.0
        self.longest_compute = 6
        self.frames = 0
        self.count: dict[str, int] = dict.fromkeys(PULSES, 0)
        self.reset_in: set[tuple[str, int, bool]] = set()
        self.abort_in: set[tuple[str, int, bool]] = set()
        self.aborted = False  # the open frame is given up
        self.told = False  # an upset is due
        self.rows: int | None = None  # of the frame that ended, until the next

    async def begin(self) -> Bench:
        names = ("accept", "weighted", "soft_reset", "give_up", "beat_ready")
        sources = ("s_axis_tvalid", "s_axis_tlast", "s_axis_tdata", "push_valid", "push_last", "push_data")
        await clocks.start(self.dut, **dict.fromkeys((*names, *sources), 0))
        return self

    def next_frame(self) -> Source | None:
        """The source that would be taken now: the push register first."""
        for name in ("push", "stream"):
            if self.sources[name].offered:
                return self.sources[name]
        return None

    def rows_done(self) -> int:
        """Rows of the open frame whose last beat has been taken, those before the first beat included."""
        assert self.open is not None
        frame = self.open.frames[0]
        return min(frame.done + self.accepted // (BEATS + frame.weighted), LONGEST)

    async def clock(self, soft_reset: bool = False, give_up: bool = False) -> None:
        """One clock: drive at this falling edge, check, go to the next."""
        dut, rng = self.dut, self.rng
        for source in self.sources.values():
            source.drive(self.gap)
        accept = self.busy == 0
        if self.open is None:
            upcoming = self.next_frame()
            weighted = int(upcoming.frames[0].weighted) if upcoming else rng.getrandbits(1)
        else:  # neither is looked at within a frame
            accept = bool(rng.getrandbits(1))
            weighted = rng.getrandbits(1)
        dut.accept.value = int(accept)
        dut.weighted.value = weighted
        dut.soft_reset.value = int(soft_reset)
        dut.give_up.value = int(give_up)
        dut.beat_ready.value = int(rng.random() >= self.stall)
        await ReadOnly()

        pulses = {name for name in PULSES if int(getattr(dut, name).value)}
        for name in pulses:
            self.count[name] += 1
        takers = [source for source in self.sources.values() if source.taken()]
        beat = int(dut.beat_valid.value) and int(dut.beat_ready.value)
        start = None
        held = soft_reset or (give_up and STATES[int(dut.state.value)] != "SWALLOW")
        assert int(dut.open.value) == int(self.open is not None)
        assert int(dut.upset.value) == int(self.told)
        self.told = give_up and STATES[int(dut.state.value)] == "LOAD"
        if self.open is not None and not self.aborted:
            assert int(dut.rows.value) == self.rows_done()
        elif self.rows is not None:
            assert int(dut.rows.value) == self.rows, "the rows of the frame that ended"
        if self.open is None:
            upcoming = self.next_frame()
            starts = accept and upcoming is not None and not soft_reset
            assert pulses == ({"clear", "frame_start"} if starts else set()), pulses
            assert not takers and not int(dut.beat_valid.value)
            assert int(dut.push_open.value) == int(accept)
            start = upcoming if starts else None
        else:
            assert int(dut.push_open.value) == int(self.open is self.sources["push"])
            assert all(source is self.open for source in takers), "a beat of the other source was taken"
            assert int(dut.beat_weighted.value) == int(self.open.frames[0].weighted)
            due = self.expected.pulses[self.accepted] if takers else set()
            if self.aborted:
                due = {"frame_dropped"} & due or ({"frame_dropped"} if "frame_end" in due else set())
                assert not int(dut.beat_valid.value), "a beat of a frame given up"
            assert pulses == due, f"{pulses} instead of {due}"
            if beat:
                last = int(dut.beat_last.value)
                index = int(dut.beat_index.value)
                weight = int(dut.beat_weight.value) if index == BEATS - 1 else -1
                self.seen.append((int(dut.beat_data.value), index, weight, last))
                assert takers, "the array took a beat that the source keeps"
                assert self.seen == self.expected.beats[: len(self.seen)], (self.seen[-1], len(self.seen))
            self.accepted += len(takers)
        if held:
            assert not takers and not pulses - {"clear", "frame_start"} and not beat
            assert not (soft_reset and pulses)
            offered = self.open.offered if self.open else self.next_frame() is not None
            kind = self.reset_in if soft_reset else self.abort_in
            kind.add((STATES[int(dut.state.value)], int(dut.beat.value), offered))

        await FallingEdge(dut.clk)
        self.busy = max(0, self.busy - 1)
        if start is not None:
            self.open = start
            self.expected = expect(start.frames[0])
            self.seen, self.accepted = [], 0
            self.aborted, self.rows = False, None
            if start.frames[0].done:
                dut.count.value = start.frames[0].done
                dut.enough.value = 1
        elif give_up and self.open is not None:
            self.aborted = True
        if "frame_end" in pulses:
            self.rows = self.rows_done()
        for source in takers:
            source.advance()
        if "frame_end" in pulses or "frame_dropped" in pulses:
            assert self.accepted == self.expected.length
            assert self.aborted or self.seen == self.expected.beats
            self.open = None
            self.frames += 1
            if "frame_end" in pulses:
                self.busy = rng.randrange(self.longest_compute)
        if soft_reset and self.open is not None:
            self.open.drop()
            self.open = None
            self.rows = None

    async def drain(self, limit: int = 200_000) -> None:
        for _ in range(limit):
            if self.open is None and not any(source.frames for source in self.sources.values()):
                return
            await self.clock()
        raise AssertionError("a frame got stuck")


def beats(rng: random.Random, rows: int, weighted: bool, weight: int | None = None) -> list[int]:
    """Beats of whole rows; `weight` of all of them, None at random."""
    out = []
    for _ in range(rows):
        value = rng.choice([0, 1, 65535, rng.getrandbits(16)]) if weight is None else weight
        if weighted:
            out.append(rng.getrandbits(48) << 16 | value)
        out += [rng.getrandbits(64) for _ in range(BEATS)]
        if INSIDE:
            out[-1] = out[-1] & ~(0xFFFF << 32) | value << 32
    return out


def random_frame(rng: random.Random, kind: str = "", extra: int = 0) -> Frame:
    weighted = FRONT and rng.random() < 0.5
    kind = kind or rng.choice(["good", "good", "good", "few", "zero", "inside", "long", "exact"])
    rows = rng.randint(LEAST, 9)
    if kind == "few":
        return Frame(beats(rng, rng.randint(1, LEAST - 1), weighted, rng.choice([0, None])), weighted)
    if kind == "zero":
        return Frame(beats(rng, rows, weighted, 0), weighted)
    if kind == "inside":
        whole = beats(rng, rows, weighted)
        per_row = BEATS + weighted
        return Frame(whole[: rng.randrange(rows) * per_row + rng.randint(1, per_row - 1)], weighted)
    if kind == "long":
        extra = extra or rng.randint(1, 5 * (BEATS + weighted))
        return Frame(
            [*beats(rng, rows, weighted), *(rng.getrandbits(64) for _ in range(extra))],
            weighted,
            LONGEST - rows,
        )
    if kind == "exact":
        return Frame(beats(rng, rows, weighted), weighted, LONGEST - rows)
    return Frame(beats(rng, rows, weighted), weighted)


@cocotb.test(timeout_time=20, timeout_unit="ms")
async def random_frames(dut: Any) -> None:
    """Frames of every kind from both sources without a reset between, from no gaps at all to mostly gaps."""
    bench = await Bench(dut, 1).begin()
    for gap, stall, compute in (
        (0, 0, 1),
        (0, 0, 6),
        (0.5, 0, 6),
        (0, 0.5, 6),
        (0.3, 0.3, 1),
        (0.85, 0.7, 20),
    ):
        bench.gap, bench.stall, bench.longest_compute = gap, stall, compute
        for _ in range(20):
            bench.sources[bench.rng.choice(["stream", "push"])].frames.append(random_frame(bench.rng))
        await bench.drain()
    assert (
        bench.frames
        == 120
        == bench.count["frame_start"]
        == bench.count["frame_end"] + bench.count["frame_dropped"]
    )
    for name in PULSES:
        assert bench.count[name] > 0 or (name == "zero_weight" and not WEIGHTED), name


@cocotb.test(timeout_time=20, timeout_unit="ms")
async def every_error(dut: Any) -> None:
    """Each error alone, by each source, followed by a good frame at once."""
    bench = await Bench(dut, 2).begin()
    kinds = {"few": "few_rows", "inside": "bad_tlast", "long": "too_long"}
    if WEIGHTED:
        kinds["zero"] = "zero_weight"
    for name, source in bench.sources.items():
        for kind, flag in kinds.items():
            for _ in range(8):
                frame = random_frame(bench.rng, kind)
                if kind == "zero" and not (frame.weighted or INSIDE):
                    continue
                before = dict(bench.count)
                source.frames += [frame, random_frame(bench.rng, "good")]
                expected = expect(source.frames[-1])
                await bench.drain()
                assert bench.count[flag] == before[flag] + 1, f"{flag} by {name}"
                assert bench.count["frame_dropped"] - before["frame_dropped"] in (1, 2)
                assert bench.seen == expected.beats


@cocotb.test(timeout_time=20, timeout_unit="ms")
async def resets(dut: Any) -> None:
    """A soft reset in every state, at every beat, with and without a beat waiting; the next frame is good."""
    bench = await Bench(dut, 3).begin()
    bench.gap, bench.stall = 0.4, 0.2
    parts = range(BEATS + FRONT)
    wanted = {("LOAD", part, offered) for part in parts for offered in (False, True)}
    wanted |= {("SWALLOW", part, offered) for part in parts for offered in (False, True)}
    for _ in range(40_000):
        for source in bench.sources.values():
            if not source.frames:
                kind = bench.rng.choice(["good", "inside", "long", "long", "long"])
                source.frames.append(random_frame(bench.rng, kind, extra=20))
        if wanted <= bench.reset_in and bench.frames > 200:
            break
        swallowing = int(dut.state.value) == STATES.index("SWALLOW")
        await bench.clock(soft_reset=bench.rng.random() < (0.1 if swallowing else 0.04))
    await bench.drain()
    assert wanted <= bench.reset_in, f"no reset came in {sorted(wanted - bench.reset_in)}"
    assert {state for state, _, _ in bench.reset_in} >= {"IDLE", "LOAD", "SWALLOW"}


@cocotb.test(timeout_time=20, timeout_unit="ms")
async def aborts(dut: Any) -> None:
    """Given up in every state, at every beat: the frame is swallowed, the next is good."""
    bench = await Bench(dut, 6).begin()
    bench.gap, bench.stall = 0.4, 0.2
    parts = range(BEATS + FRONT)
    wanted = {("LOAD", part, offered) for part in parts for offered in (False, True)} | {("IDLE", 0, True)}
    for _ in range(40_000):
        for source in bench.sources.values():
            if not source.frames:
                source.frames.append(random_frame(bench.rng, bench.rng.choice(["good", "good", "long"])))
        seen = {(state, 0 if state == "IDLE" else part, offered) for state, part, offered in bench.abort_in}
        if wanted <= seen and bench.frames > 200:
            break
        await bench.clock(give_up=bench.rng.random() < (0.3 if bench.open is None else 0.03))
    await bench.drain()
    assert wanted <= seen, f"not given up in {sorted(wanted - seen)}"
    assert bench.count["frame_end"] > 20 and bench.count["frame_dropped"] > 50


@cocotb.test(timeout_time=20, timeout_unit="ms", skip=netlist.REPLACED)
async def weight_upset(dut: Any) -> None:
    """A flip of either copy of a weight that is held while a frame loads is told of in the next clock."""
    copies = dut.g_front.weight_register
    bench = await Bench(dut, 7).begin()
    stream = bench.sources["stream"]
    for copy in (copies.first, copies.second):
        for bit in range(16):
            stream.frames.append(Frame(beats(bench.rng, LEAST, True), True))
            while bench.accepted == 0 or bench.open is None:
                await bench.clock()
            copy.value = int(copy.value) ^ 1 << bit
            dut.s_axis_tvalid.value = 0
            stream.offered = False
            await FallingEdge(dut.clk)
            assert int(dut.upset.value) == 1
            dut.soft_reset.value = 1
            stream.drop()
            bench.open = None
            await FallingEdge(dut.clk)
            dut.soft_reset.value = 0
            await FallingEdge(dut.clk)
            assert int(dut.upset.value) == 0, "told of though no frame is open"
            bench.accepted = 0


@cocotb.test(timeout_time=20, timeout_unit="ms")
async def priority(dut: Any) -> None:
    """A push waits for an open stream frame and is taken before the next one, and the other way round."""
    bench = await Bench(dut, 4).begin()
    stream, push = bench.sources["stream"], bench.sources["push"]
    stream.frames += [random_frame(bench.rng, "good") for _ in range(2)]
    while bench.accepted < 4:
        await bench.clock()
    push.frames.append(random_frame(bench.rng, "good"))
    order = []
    opened = None
    while stream.frames or push.frames:
        await bench.clock()
        if bench.open is not opened:
            opened = bench.open
            if opened:
                order.append("push" if opened is push else "stream")
    assert order == ["stream", "push", "stream"]


@cocotb.test(timeout_time=20, timeout_unit="ms")
async def longest_frames(dut: Any) -> None:
    """65535 rows for real end well; with one more beat they are swallowed; the next frame is good again.

    The beats come without a gap, so the simulator runs alone and Python only looks at the ends.
    """
    await clocks.start(
        dut,
        accept=1,
        weighted=0,
        soft_reset=0,
        give_up=0,
        beat_ready=1,
        s_axis_tvalid=0,
        s_axis_tlast=0,
        s_axis_tdata=1 << 32 | 1,
        push_valid=0,
    )

    async def settle() -> set[str]:
        await ReadOnly()
        return {name for name in PULSES if int(getattr(dut, name).value)}

    for extra in (0, 1):
        dut.s_axis_tvalid.value = 1
        assert await settle() == {"clear", "frame_start"}
        await FallingEdge(dut.clk)
        await ClockCycles(dut.clk, BEATS * LONGEST - 1)  # all but the last beat of row 65535
        await FallingEdge(dut.clk)
        dut.s_axis_tlast.value = 1 - extra
        assert int(dut.rows.value) == LONGEST - 1
        assert await settle() == (set() if extra else {"frame_end"})
        assert int(dut.beat_last.value) == 1 - extra and int(dut.beat_index.value) == BEATS - 1
        await FallingEdge(dut.clk)
        if extra:
            assert await settle() == {"too_long"} and not int(dut.beat_valid.value)
            await FallingEdge(dut.clk)
            for _ in range(7):
                assert await settle() == set() and not int(dut.beat_valid.value)
                await FallingEdge(dut.clk)
            dut.s_axis_tlast.value = 1
            assert await settle() == {"frame_dropped"}
            await FallingEdge(dut.clk)
        dut.s_axis_tvalid.value = 0
        dut.s_axis_tlast.value = 0
        await FallingEdge(dut.clk)
    bench = Bench(dut, 5)
    bench.sources["stream"].frames.append(random_frame(bench.rng, "good"))
    await bench.drain()
