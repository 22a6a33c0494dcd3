# SPDX-License-Identifier: Apache-2.0
"""The rates' schedule, checked without the scheduler: whoever reads gets what the program's order says.

Every write is an event at the cycle from which it can be read; every read must find the write of the step
that precedes it in the program. Latencies are the hardware's, as its headers give them.
"""

from __future__ import annotations

from collections import defaultdict
from pathlib import Path

from relnav.model.rates_program import Bank, Operation
from relnav.model.rates_rom import verilog
from relnav.model.rates_schedule import Resource, arrivals, reads, schedule, writes


def test_every_read_finds_its_write() -> None:
    placed = schedule()
    events: dict[Resource, list[tuple[int, int]]] = defaultdict(list)
    for resource, cycle in arrivals().items():
        events[resource].append((cycle, -1))
    for number, (step, cycle) in enumerate(zip(placed.steps, placed.cycles, strict=True)):
        for write in writes(step):
            events[write.resource].append((cycle + write.offset, number))
    in_order: dict[Resource, int] = {}
    checked = 0
    for number, (step, cycle) in enumerate(zip(placed.steps, placed.cycles, strict=True)):
        for read in reads(step):
            when = cycle + read.offset
            visible = [event for event in events[read.resource] if event[0] <= when]
            if read.resource in in_order or read.resource in arrivals():
                assert max(visible)[1] == in_order.get(read.resource, -1), (step.name, read)
                checked += 1
            else:
                assert str(read.resource).startswith("('track'"), (step.name, read)
        for write in writes(step):
            in_order[write.resource] = number
    assert checked > 800


def test_one_operation_and_one_term_a_cycle() -> None:
    placed = schedule()
    pairs = list(zip(placed.steps, placed.cycles, strict=True))
    for kind in (True, False):
        cycles = [cycle for step, cycle in pairs if isinstance(step, Operation) == kind]
        assert len(cycles) == len(set(cycles))


def test_accumulators_are_written_in_the_order_of_the_terms() -> None:
    placed = schedule()
    by_row: dict[int, list[tuple[int, int]]] = defaultdict(list)
    for number, (step, cycle) in enumerate(zip(placed.steps, placed.cycles, strict=True)):
        if not isinstance(step, Operation):
            by_row[step.row].append((cycle, number))
    for row in by_row.values():
        assert sorted(row) == sorted(row, key=lambda pair: pair[1])


def test_what_is_read_at_all_is_written() -> None:
    """No operand of the program comes out of nowhere: lanes that do not count read nothing."""
    written: set[Resource] = set(arrivals())
    for step in schedule().steps:
        for read in reads(step):
            if isinstance(read.resource, tuple) and read.resource[0] in (Bank.S, Bank.A, Bank.P):
                assert read.resource in written, (step.name, read)
        written |= {write.resource for write in writes(step)}


def test_generated_program_is_current() -> None:
    rtl = Path(__file__).resolve().parents[2] / "rtl" / "ivisnav" / "rates_program.v"
    assert rtl.read_text() == verilog()
