# SPDX-License-Identifier: Apache-2.0
"""What only OLTAE's register file has: CONFIG and the flag NOT_BUILT. All else: tb/axi/core_registers."""

from __future__ import annotations

import random
from typing import Any

import cocotb
from relnav.registers import Oltae

from tb.axi.registers import FULL, Bench, merged
from tb.common import clocks, netlist

BUILT = 0b1111 if FULL else 0b0010  # of CONFIG
PORTS = ("config_weighted", "config_forbid_turns", "config_reapply", "config_covariance")


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def configuration(dut: Any) -> None:
    """With every strobe; the outputs follow; locked while busy."""
    bench = await Bench(dut).begin()
    rng = random.Random(2)
    held = await bench.read(Oltae.CONFIG.ADDRESS)
    for strobe in [*range(16), 15, 15, 15, 15]:
        value = rng.getrandbits(32)
        await bench.write(Oltae.CONFIG.ADDRESS, value, strobe)
        held = merged(held, value, strobe) & BUILT
        assert await bench.read(Oltae.CONFIG.ADDRESS) == held
        assert sum(int(getattr(dut, port).value) << bit for bit, port in enumerate(PORTS)) == held
    await bench.clear()
    await bench.write(Oltae.CONFIG.ADDRESS, 2)
    dut.busy.value = 1
    await bench.write(Oltae.CONFIG.ADDRESS, 0)
    assert await bench.read(Oltae.CONFIG.ADDRESS) == 2, "changed while busy"
    assert await bench.read(Oltae.FLAGS.ADDRESS) == Oltae.FLAGS.BUSY_WRITE.mask
    assert await bench.read(Oltae.IRQ_STATUS.ADDRESS) == 2
    dut.busy.value = 0
    await clocks.tick(dut)
    await bench.clear()
    await bench.write(Oltae.CONFIG.ADDRESS, 0)
    assert await bench.read(Oltae.CONFIG.ADDRESS) == 0 == await bench.read(Oltae.FLAGS.ADDRESS)


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def not_built(dut: Any) -> None:
    """What the build has not reads 0 and raises NOT_BUILT at the write and in every frame run so."""
    bench = await Bench(dut).begin()
    flag = Oltae.FLAGS.NOT_BUILT.mask
    for bit in range(4):
        for ask in (1 << bit, 0):
            lacks = bool(ask & ~BUILT)
            await bench.write(Oltae.CONFIG.ADDRESS, ask)
            assert await bench.read(Oltae.CONFIG.ADDRESS) == ask & BUILT
            assert await bench.read(Oltae.FLAGS.ADDRESS) == flag * lacks
            await bench.clear()
            await bench.pulse("frame_start")
            assert (
                await bench.read(Oltae.FLAGS.ADDRESS)
                == flag * lacks
                == await bench.read(Oltae.FRAME_FLAGS.ADDRESS)
            )
            await bench.clear()


@cocotb.test(timeout_time=2, timeout_unit="ms", skip=netlist.REPLACED)
async def configuration_upsets(dut: Any) -> None:
    """A flip of CONFIG, of `asked` or of their parity raises UPSET until CONFIG is written again."""
    bench = await Bench(dut).begin()
    flag = Oltae.FLAGS.UPSET.mask
    for value in (0, 0b1010 & BUILT, BUILT):
        for signal in (dut.configuration, dut.asked, dut.parity):
            for bit in range(len(signal)):
                await bench.write(Oltae.CONFIG.ADDRESS, value)
                await bench.clear()
                assert int(dut.upset.value) == 0 == await bench.read(Oltae.FLAGS.ADDRESS)
                signal.value = int(signal.value) ^ 1 << bit
                await clocks.tick(dut, 2)
                assert int(dut.upset.value) == 1
                await bench.write(Oltae.FLAGS.ADDRESS, flag)
                assert await bench.read(Oltae.FLAGS.ADDRESS) & flag
                await bench.write(Oltae.CONFIG.ADDRESS, value)
                await clocks.tick(dut, 2)
                await bench.write(Oltae.FLAGS.ADDRESS, flag)
                assert int(dut.upset.value) == 0 == await bench.read(Oltae.FLAGS.ADDRESS)
