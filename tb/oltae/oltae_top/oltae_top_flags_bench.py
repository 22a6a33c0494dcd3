# SPDX-License-Identifier: Apache-2.0
"""oltae_top through its ports: every flag is raised by what it stands for, is cleared, and harms nothing."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import cocotb
import numpy as np
from relnav.driver import OltaeDriver
from relnav.model.raw import CoreConfig
from relnav.quantise import QuantisedFrame
from relnav.registers import Oltae

from tb.common import core_tests
from tb.oltae.environment import FULL, Bench


@cocotb.test()
async def every_flag(dut: Any) -> None:
    """Each error is raised alone, leaves the results, is cleared, and the next frame is as good as any."""
    bench = await Bench(dut, 3).begin()
    await bench.drive(OltaeDriver.identify)
    await bench.drive(lambda d: d.enable_interrupts(error=True))
    await bench.solve(bench.good())
    line = np.outer(np.arange(5), [3, -1, 2]).astype(np.int64)
    spot = np.full((4, 3), 7, dtype=np.int64)
    cloud = np.array([[9, 2, -3], [-4, 8, 1], [5, -6, 7], [1, 1, -9]], dtype=np.int64) << 24
    turned = cloud @ np.diag([-1, -1, 1])  # by 180 degrees about z
    nearly = turned + np.eye(4, 3, dtype=np.int64)
    thin = cloud >> [0, 11, 11]
    plain = CoreConfig(covariance=FULL)
    forbid = replace(plain, forbid_turns=True)
    cases: list[tuple[str, QuantisedFrame, CoreConfig]] = [
        ("FEW_POINTS", QuantisedFrame(cloud[:1], cloud[:1], None, 0), plain),
        ("FEW_POINTS", QuantisedFrame(cloud[:2], cloud[:2], None, 0), plain),
        ("RANK_DEFICIENT", QuantisedFrame(line, line + 5, None, 3), plain),
        ("RANK_DEFICIENT", QuantisedFrame(spot, spot, None, 3), plain),
        ("RANK_DEFICIENT", QuantisedFrame(cloud, turned, None, 20), forbid),
        ("Q_SATURATED", QuantisedFrame(cloud, turned, None, 20), plain),
        ("Q_SATURATED", QuantisedFrame(cloud, nearly, None, 20), plain),
        ("ILL_CONDITIONED", QuantisedFrame(thin, thin, None, 20), plain),
    ]
    if FULL:
        zero = np.zeros(4, dtype=np.int64)
        cases.append(("ZERO_WEIGHT", QuantisedFrame(cloud, cloud, zero, 20), plain))
        one = np.array([0, 5, 0, 0], dtype=np.int64)
        cases.append(("RANK_DEFICIENT", QuantisedFrame(cloud, cloud, one, 20), plain))
    for name, frame, config in cases:
        got = await bench.solve(frame, config=config)
        assert name in got.flag_names, (name, got.flag_names)
        await core_tests.raised_and_cleared(bench, set(got.flag_names))

    await core_tests.broken_frames(bench)
    await core_tests.busy_writes(bench)
    await not_built(bench)


@cocotb.test()
async def upset_in_every_state(dut: Any) -> None:
    await core_tests.upset_in_every_state(await Bench(dut, 9).begin())


@cocotb.test()
async def flags_cleared_while_busy(dut: Any) -> None:
    await core_tests.flags_cleared_while_busy(await Bench(dut, 10).begin())


async def not_built(bench: Bench) -> None:
    """What this build has not is named by the write and by every frame run so; the full build has it all."""
    wish = Oltae.CONFIG.encode(WEIGHTED=1, REAPPLY=1, COVARIANCE=1)
    await bench.drive(lambda d: d.write(Oltae.CONFIG, wish))
    kept = await bench.drive(lambda d: d.read(Oltae.CONFIG))
    assert kept == (wish if FULL else 0)
    assert (await bench.flags())[0] == (set() if FULL else {"NOT_BUILT"})
    await bench.drive(OltaeDriver.clear_flags)
    await bench.drive(OltaeDriver.clear_interrupts)
    if not FULL:
        frame = bench.good()
        got = await bench.drive(lambda d: d.solve(frame, CoreConfig(covariance=True), polls=200))
        expected = bench.model.run(frame, CoreConfig(covariance=False))
        assert got.flag_names == ("NOT_BUILT",) and got.result_words() == expected.result_words()
        bench.last = got
    await bench.drive(lambda d: bench.prepare(d, bench.good()))
    await bench.drive(OltaeDriver.clear_flags)
    await bench.solve(bench.good())
    assert await bench.flags() == (set(), set())
