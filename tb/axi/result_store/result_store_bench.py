# SPDX-License-Identifier: Apache-2.0
"""result_store against two dictionaries: what is hidden and what can be read."""

from __future__ import annotations

import os
import random
from typing import Any

import cocotb

from tb.common import clocks

MIDDLE, LAST = int(os.environ["MIDDLE_FIRST"]), int(os.environ["LAST_FIRST"])
GROUPS = {0: range(MIDDLE), 1: range(MIDDLE, LAST), 2: range(LAST, 64)}
"""Bit of `commit` -> indices."""
GROUPS = {bit: indices for bit, indices in GROUPS.items() if indices}
IDLE = dict.fromkeys(
    ("write_valid", "write_index", "write_data", "commit", "verify", "read_valid", "read_index"), 0
)


async def read(dut: Any, index: int) -> int:
    """One read, held as long as the store asks; returns the word. Driven and left at falling edges."""
    dut.read_valid.value = 1
    dut.read_index.value = index
    while True:
        await clocks.tick(dut)
        if not int(dut.read_wait.value):
            break
    dut.read_valid.value = 0
    return int(dut.read_data.value)


async def write(dut: Any, index: int, value: int, *commits: int) -> None:
    dut.write_valid.value = 1
    dut.write_index.value = index
    dut.write_data.value = value
    dut.commit.value = sum(1 << bit for bit in commits)
    await clocks.tick(dut)
    dut.write_valid.value = 0
    dut.commit.value = 0


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def zero_at_power_up_and_between_reads(dut: Any) -> None:
    await clocks.start(dut, **IDLE)
    for index in range(64):
        assert await read(dut, index) == 0
    await write(dut, 2, 0xFFFFFFFF, 0)
    assert await read(dut, 2) == 0xFFFFFFFF
    await clocks.tick(dut)
    assert int(dut.read_data.value) == 0


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def frames(dut: Any) -> None:
    """Group by group: nothing seen before its commit, all after; a commit with the last write or later."""
    await clocks.start(dut, **IDLE)
    rng = random.Random(5)
    # the memory keeps its content over a reset, so this test begins with a frame that fills all of it
    seen: dict[int, int] = {}
    for frame in range(12):
        cut = rng.choice([None, None, *GROUPS]) if frame else None  # abort in this group
        for bit, indices in GROUPS.items():
            order = list(indices)
            rng.shuffle(order)
            fresh = {index: rng.getrandbits(32) for index in order}
            with_last = rng.random() < 0.5
            for position, index in enumerate(order):
                if cut == bit and position > len(order) // 2:
                    break
                last = position == len(order) - 1
                await write(dut, index, fresh[index], *([bit] if last and with_last else []))
                probe = rng.choice(order)
                if seen and not (last and with_last) and rng.random() < 0.3 and probe in seen:
                    assert await read(dut, probe) == seen[probe], f"word {probe} seen before its commit"
            if cut == bit:
                break
            if not with_last:
                await clocks.tick(dut, rng.randrange(3))
                dut.commit.value = 1 << bit
                await clocks.tick(dut)
                dut.commit.value = 0
            seen.update(fresh)
        for index, value in seen.items():
            assert await read(dut, index) == value, f"frame {frame}, word {index}"


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def both_at_once(dut: Any) -> None:
    """Every clock at random: a write, a commit, a read; answers compared with the model one clock later."""
    await clocks.start(dut, **IDLE)
    rng = random.Random(9)
    bank = dict.fromkeys(GROUPS, 0)
    memory: dict[tuple[int, int], int] = {}
    group_of = {index: bit for bit, indices in GROUPS.items() for index in indices}
    for (
        bit,
        indices,
    ) in GROUPS.items():  # fill both banks: an even number of commits, so the model's banks are right
        for _ in range(2):
            for index in indices:
                value = rng.getrandbits(32)
                await write(dut, index, value, *([bit] if index == indices[-1] else []))
                memory[1 - bank[bit], index] = value
            bank[bit] ^= 1
    collisions = reads = 0
    for _ in range(4000):
        store, fetch = rng.random() < 0.5, rng.random() < 0.6
        target, source, value = rng.randrange(64), rng.randrange(64), rng.getrandbits(32)
        commits = [bit for bit in GROUPS if rng.random() < 0.1]
        dut.write_valid.value = int(store)
        dut.write_index.value = target
        dut.write_data.value = value
        dut.read_valid.value = int(fetch)
        dut.read_index.value = source
        dut.commit.value = sum(1 << bit for bit in commits)
        await clocks.tick(dut)
        assert int(dut.read_wait.value) == int(store)
        expected = memory[bank[group_of[source]], source] if fetch and not store else 0
        assert int(dut.read_data.value) == expected
        if store:
            memory[1 - bank[group_of[target]], target] = value
        for bit in commits:
            bank[bit] ^= 1
        collisions += store and fetch
        reads += fetch and not store
    assert collisions > 500 and reads > 500


@cocotb.test(timeout_time=2, timeout_unit="ms")
async def second_pass(dut: Any) -> None:
    """With verify every word is compared with the one that stands, nothing is written; reads come between."""
    await clocks.start(dut, **IDLE)
    rng = random.Random(13)
    for _ in range(3):
        words = {index: rng.getrandbits(32) for index in range(64)}
        for indices in GROUPS.values():
            for index in indices:
                await write(dut, index, words[index])
                assert int(dut.differs.value) == 0
        dut.commit.value = sum(1 << bit for bit in GROUPS)
        await clocks.tick(dut)
        dut.commit.value = 0
        dut.verify.value = 1
        for index in rng.sample(range(64), 64):
            wrong = 1 << rng.randrange(32) if rng.random() < 0.4 else 0
            await write(dut, index, words[index] ^ wrong)
            assert int(dut.differs.value) == (wrong != 0), f"word {index}"
            if rng.random() < 0.5:
                await clocks.tick(dut)
                assert int(dut.differs.value) == 0
            if rng.random() < 0.3:
                assert await read(dut, index) == words[index]
        dut.verify.value = 0
        assert [await read(dut, index) for index in range(64)] == list(words.values())
