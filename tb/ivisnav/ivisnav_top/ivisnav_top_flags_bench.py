# SPDX-License-Identifier: Apache-2.0
"""ivisnav_top through its ports: every flag is raised by what it stands for, cleared, and harms nothing."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import cocotb
import numpy as np
from relnav.ivisnav.driver import IvisnavDriver
from relnav.ivisnav.quantise import QuantisedRows
from relnav.registers import Ivisnav

from tb.common import core_tests
from tb.ivisnav.environment import Bench


@cocotb.test()
async def every_flag(dut: Any) -> None:
    """Each error is raised alone, leaves the results, is cleared, and the next frame is as good as any."""
    bench = await Bench(dut, 3).begin()
    await bench.drive(IvisnavDriver.identify)
    await bench.drive(lambda d: d.enable_interrupts(error=True))
    await bench.solve(bench.good())
    frame = bench.good(9)
    h = frame.h
    flat = np.hstack((h[:, :5], h[:, 4:5]))  # two columns alike
    few = np.where(np.arange(9) < 5, 7, 0)  # only five rows count
    cases: list[tuple[str, QuantisedRows]] = [
        ("FEW_ROWS", bench.tail(frame, 1)),
        ("FEW_ROWS", bench.tail(frame, 5)),
        ("RANK_DEFICIENT", replace(frame, h=np.zeros_like(h))),
        ("RANK_DEFICIENT", replace(frame, h=np.tile(h[:1], (9, 1)), w=np.ones(9, np.int64))),
        ("RANK_DEFICIENT", replace(frame, h=flat)),
        ("RANK_DEFICIENT", replace(frame, w=few)),
        ("RANK_DEFICIENT", replace(frame, w=np.where(np.arange(9) == 4, 7, 0))),
        ("ILL_CONDITIONED", thin(bench)),
        ("ZERO_WEIGHT", replace(frame, w=np.zeros(9, np.int64))),
    ]
    for name, case in cases:
        got = await bench.solve(case)
        assert got.flag_names == (name,), (name, got.flag_names)
        shown = await bench.drive(lambda d: d.read(Ivisnav.CONDITION))
        refused = name == "ILL_CONDITIONED"
        assert shown == (got.condition_word if refused else bench.last.condition_word)
        await core_tests.raised_and_cleared(bench, {name})
    both = bench.beats(bench.tail(replace(frame, w=np.zeros(9, np.int64)), 5))
    ticket = await bench.drive(lambda d: bench.prepare(d, frame).feed(both))
    assert not await bench.drive(lambda d: d.wait(ticket, 200))
    await core_tests.raised_and_cleared(bench, {"FEW_ROWS", "ZERO_WEIGHT"})
    await core_tests.broken_frames(bench)
    await core_tests.busy_writes(bench)


@cocotb.test()
async def upset_in_every_state(dut: Any) -> None:
    await core_tests.upset_in_every_state(await Bench(dut, 9).begin())


@cocotb.test()
async def flags_cleared_while_busy(dut: Any) -> None:
    await core_tests.flags_cleared_while_busy(await Bench(dut, 10).begin())


def thin(bench: Bench) -> QuantisedRows:
    """Nine rows that the core refuses for their conditioning alone."""
    numpy = np.random.default_rng(1)
    for bits in np.arange(4.0, 30.0, 0.25):
        h = numpy.normal(size=(9, 6)) * 2.0**28
        h[:, 5] = h[:, 4] + h[:, 5] * 2.0**-bits
        rows = QuantisedRows(np.rint(h).astype(np.int64), np.arange(9) << 20, np.ones(9, np.int64), 0, 0)
        if bench.model.run(rows, 0.0).flag_names == ("ILL_CONDITIONED",):
            return rows
    raise AssertionError("no such rows")
