# SPDX-License-Identifier: Apache-2.0
"""The microprogram's schedule, checked without the scheduler, and the generated files.

The pipelined engine has no interlock. Every event (read, write, bus, divider, result word) gets its cycle
from the latencies; each read has to find what the last writer before it in program order left, and nothing
may meet on a port.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path

import pytest
from relnav import words
from relnav.model import assembler as asm
from relnav.model import pose_program as pose
from relnav.model import rom
from relnav.model import statistics_program as statistics
from relnav.model.rom import DRAIN_EARLIEST, DRAIN_LATENCY, Program

ROOT = Path(__file__).resolve().parents[2]
# last slot -> bus, where registers, divider and result queue take it; the register can be read a clock later
BUS, RAW_BUS = asm.LATENCY - 1, asm.RAW_LATENCY - 1
FIXED_WORD = RAW_BUS + 1  # last slot -> Q15.16 in the result memory
QUEUE_WORD = 2  # queue's entrance -> first word
DIVIDER = asm.RECIPROCAL_LATENCY  # start -> result on the bus
CHOICE = asm.LATENCY - 1  # last slot of the determinant -> turn known


@dataclass(frozen=True)
class Case:
    """What the schedule does not know when it is made."""

    turn: int
    reapply: bool

    @property
    def turned(self) -> bool:
        return self.turn != 0


@dataclass
class Placed:
    """A dot product in the cycles in which it runs."""

    dot: asm.Dot
    cycle: int
    slots: list[asm.Term]
    end: int = field(init=False)

    def __post_init__(self) -> None:
        self.end = self.cycle + len(self.slots) - 1


def timeline(program: Program, case: Case) -> list[Placed]:
    """Program order with cycles: what follows the call is `return_cycle - call_cycle` later."""
    shift = program.return_cycle - program.call_cycle if case.reapply else 0
    placed = []
    for number, dot in enumerate(program.dots):
        if number == program.call and case.reapply:
            placed += [(step, step.cycle) for step in program.newton]
        placed.append((dot, dot.cycle + (shift if number >= program.call else 0)))
    return [Placed(dot, at, dot.terms * (2 if dot.reference == asm.REF_PROBED else 1)) for dot, at in placed]


def taken_lanes(dot: asm.Dot, case: Case) -> set[int]:
    """Lanes whose result is written, compared, output or on the bus."""
    if dot.write == asm.PRIVATE or dot.choose_turn:
        return {0, 1, 2, 3}
    if dot.kind == asm.FIXED or dot.output == asm.SINGLE:
        taken = {0}
    elif dot.output != asm.NO_OUTPUT:
        taken = {place + 1 for place in asm.OUTPUT_PLACES[dot.output]}
    else:
        taken = set()
    if on_bus(dot, case):
        taken.add(case.turn if dot.source == asm.TURN else dot.source)
    return taken


def read(dot: Placed, case: Case) -> Iterator[tuple[int, int]]:
    """(cycle, register or stream item) of every operand that counts in a lane whose result does."""
    taken = taken_lanes(dot.dot, case)
    for cycle, term in enumerate(dot.slots, dot.cycle):
        if case.reapply and term.only_first:
            continue
        for lane in term.enable & taken:
            yield cycle, (term.x ^ lane if term.x_by_lane else term.x) ^ (lane in term.alternate)
            yield cycle, term.y ^ lane if term.y_by_lane else term.y


def on_bus(dot: asm.Dot, case: Case) -> bool:
    """Whether the lanes' bus carries the result anywhere."""
    return dot.write == asm.BROADCAST or divides(dot, case) or dot.track != asm.NO_TRACK


def suppressed(dot: asm.Dot, case: Case) -> bool:
    return dot.only_turned and not case.turned


def destination(dot: asm.Dot, case: Case) -> int | None:
    """Register that the dot product writes in this case."""
    if dot.write == asm.NO_WRITE or suppressed(dot, case):
        return None
    return dot.dest | (8 if dot.turn_dest and not case.turned else 0)


def divides(dot: asm.Dot, case: Case) -> bool:
    wanted = {asm.DIVIDE: True, asm.DIVIDE_TURNED: case.turned, asm.DIVIDE_UNTURNED: not case.turned}
    return wanted.get(dot.divide, False)


def result_bus(dot: Placed) -> int:
    """Cycle in which the result leaves its lane."""
    return dot.end + (RAW_BUS if dot.dot.kind == asm.RAW else BUS)


def first_readable(program: Program, case: Case) -> tuple[dict[int, int], dict[int, tuple[int, int]]]:
    """Of the stream's items: cycle; of the low limbs that replace some: (no earlier than, no later than)."""
    redrain = program.redrain + (program.return_cycle - program.call_cycle if case.reapply else 0)
    places = {item: at - 1 for item, at in statistics.arrival(0).items()}
    return pose.arrival(), {
        item: (redrain + DRAIN_EARLIEST + at + 1, redrain + DRAIN_LATENCY + at + 1)
        for item, at in places.items()
    }


cases = pytest.mark.parametrize(
    "case",
    [Case(turn, reapply) for turn in range(4) for reapply in (False, True)],
    ids=[f"turn{turn}-{kind}" for turn in range(4) for kind in ("plain", "reapply")],
)


@pytest.fixture(scope="module")
def program() -> Program:
    return rom.scheduled()


@cases
def test_slots_follow_one_another(program: Program, case: Case) -> None:
    placed = timeline(program, case)
    assert all(after.cycle > before.end for before, after in pairwise(placed))


@cases
def test_every_read_finds_the_last_value_of_program_order(program: Program, case: Case) -> None:
    placed = timeline(program, case)
    in_pose = {id(dot) for dot in program.dots[: len(pose.program())]} | {id(dot) for dot in program.newton}
    landings: dict[int, list[tuple[int, int]]] = {pose.ONE: [(1, -1)]}  # register -> (readable from, writer)
    for number, at in enumerate(placed):
        register = destination(at.dot, case)
        if register is not None:
            landings.setdefault(register, []).append((result_bus(at) + 1, number))
        if divides(at.dot, case):
            assert at.dot.divide_dest is not None
            landings.setdefault(at.dot.divide_dest, []).append((result_bus(at) + DIVIDER + 1, number))
    stream, low = first_readable(program, case)
    for number, at in enumerate(placed):
        for cycle, address in read(at, case):
            where = (at.dot.name, cycle, address)
            if address >= asm.STREAM:
                if address not in low:
                    assert cycle >= stream[address], where
                elif id(at.dot) in in_pose:  # the first drain's item, before its low limb may come
                    assert stream[address] <= cycle < low[address][0], where
                else:
                    assert cycle >= low[address][1], where
                continue
            known = landings.get(address, [])
            writer = max((w for _, w in known if w < number), default=None)
            assert writer is not None, f"never written: {where}"
            _, found = max((landing for landing in known if landing[0] <= cycle), default=(0, None))
            assert found == writer, where


@cases
def test_scales_are_complete_when_looked_up(program: Program, case: Case) -> None:
    """A reference looked up in a dot product's first slot knows what has been on the bus up to that cycle."""
    quaternion = {asm.REF_QUATERNION, asm.REF_ROTATED, asm.REF_IMAGE, asm.REF_FORM}
    using = {
        asm.TRACK_QUATERNION: quaternion,
        asm.TRACK_AFRESH: quaternion,
        asm.TRACK_CENTROID: {asm.REF_CENTROID, asm.REF_ROTATED},
    }
    of_moments = {asm.REF_MOMENT, asm.REF_CROSS, asm.REF_NEWTON}
    of_moments |= {asm.REF_IMAGE, asm.REF_FORM, asm.REF_COFACTOR}
    tracked: list[tuple[int, int]] = []  # (cycle, kind) in program order
    for at in timeline(program, case):
        if at.dot.reference in of_moments:
            kinds = [pose.KIND_T] + [pose.KIND_N] * (at.dot.reference == asm.REF_CROSS)
            arrived = [pose.arrival()[pose.item(slot, kind)] for slot in range(3) for kind in kinds]
            assert at.cycle >= max(arrived) - 1, at.dot.name
        for cycle, kind in tracked:
            assert at.dot.reference not in using[kind] or at.cycle >= cycle, at.dot.name
        if at.dot.track != asm.NO_TRACK and not suppressed(at.dot, case):
            tracked.append((result_bus(at), at.dot.track))
    assert [cycle for cycle, _ in tracked] == sorted(cycle for cycle, _ in tracked)


@cases
def test_the_turn_is_known_where_it_decides(program: Program, case: Case) -> None:
    placed = timeline(program, case)
    (chosen,) = (at.end + CHOICE for at in placed if at.dot.choose_turn)
    for at in placed:
        dot = at.dot
        conditional = dot.divide in (asm.DIVIDE_TURNED, asm.DIVIDE_UNTURNED)
        if dot.source == asm.TURN or dot.turn_dest or dot.only_turned or conditional:
            assert result_bus(at) >= chosen, dot.name


@cases
def test_nothing_meets_on_a_port(program: Program, case: Case) -> None:
    """One register write a clock, one value on the bus, one division at a time."""
    writes, bus, divisions = [0], [0], []  # `start` writes ONE over the bus
    for at in timeline(program, case):
        dot = at.dot
        if dot.kind == asm.RAW:  # past the bus
            assert dot.write == asm.PRIVATE and not divides(dot, case) and dot.output == asm.NO_OUTPUT
            assert dot.track == asm.NO_TRACK
        if destination(dot, case) is not None:
            writes.append(result_bus(at))
        if divides(dot, case):
            divisions.append(result_bus(at))
            writes.append(result_bus(at) + DIVIDER)
            bus.append(result_bus(at) + DIVIDER)
        if on_bus(dot, case):
            bus.append(result_bus(at))
    assert len(set(writes)) == len(writes)
    assert len(set(bus)) == len(bus)
    divisions.sort()
    assert all(after - before >= DIVIDER for before, after in pairwise(divisions))


@cases
def test_result_words_leave_one_a_clock(program: Program, case: Case) -> None:
    stored: dict[int, str] = {}  # cycle -> who writes the result memory
    indices: list[int] = []
    free = 0
    for at in timeline(program, case):
        dot = at.dot
        if dot.kind == asm.FIXED:
            leaving = {at.end + FIXED_WORD: dot.output_index}
        elif dot.output == asm.NO_OUTPUT:
            continue
        else:
            entered = at.end + BUS
            assert entered >= free, dot.name  # the queue's places have all been taken
            places = asm.OUTPUT_PLACES[dot.output]
            free = entered + places[-1] + 1
            stride = 3 if dot.output == asm.TRIPLE_COLUMN else 1
            leaving = {entered + QUEUE_WORD + place: dot.output_index + stride * place for place in places}
        assert not leaving.keys() & stored.keys(), (dot.name, stored)
        stored |= dict.fromkeys(leaving, dot.name)
        indices += leaving.values()
    assert len(set(indices)) == len(indices)


def test_last_words_carry_the_marks(program: Program) -> None:
    """`basic` and `all` are the last words that leave, with and without the covariances."""
    for mark, dots in (("basic", program.dots[: program.basic]), ("all", program.dots)):
        outputs = [dot for dot in dots if dot.output != asm.NO_OUTPUT or dot.kind == asm.FIXED]
        assert outputs[-1].mark == mark
        assert max(outputs, key=lambda dot: dot.end) is outputs[-1]


def test_the_image_plays_the_schedule(program: Program) -> None:
    """A program counter walked over the ROM's addresses meets every slot in its cycle."""
    main = rom.addresses(program.dots, 0, 0)
    for case in (Case(0, False), Case(0, True)):
        target = main[-1] + len(program.dots[-1].terms) + 2
        step = rom.addresses(program.newton, program.call_cycle, target)
        dots = [*program.dots, *program.newton]
        starts = {id(dot): start for dot, start in zip(dots, [*main, *step], strict=True)}
        address, cycle = 0, 0
        for at in timeline(program, case):
            if at.dot is program.newton[0]:
                address = target
                cycle = program.call_cycle
            if case.reapply and at.dot is program.dots[program.call]:
                address = main[program.call] - (program.dots[program.call].cycle - program.call_cycle)
                cycle = program.return_cycle
            assert starts[id(at.dot)] - address == at.cycle - cycle, at.dot.name
            address, cycle = starts[id(at.dot)] + len(at.dot.terms), at.end + 1


def test_committed_program_is_the_generators() -> None:
    assert (ROOT / "rtl" / "oltae" / "solve_program.v").read_text() == rom.verilog()


def test_committed_words_are_the_generators() -> None:
    assert words.HEADER.read_text() == words.verilog()
