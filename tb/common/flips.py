# SPDX-License-Identifier: Apache-2.0
"""Bit flips of registers while a player plays frames: one upset a frame, as a particle does it.

The list stands in the environment variable FLIPS, as JSON: [frame, clocks, name, bit]. A frame begins with
the player's clear, counted from 0; the flip comes so many clocks later, in the middle of a clock, and stays
until the register is written. A name is a path below the player, with [n] for a generated block.
"""

from __future__ import annotations

import json
import os
import random
from collections.abc import Mapping
from typing import Any

from cocotb.triggers import FallingEdge


def registers(text: str) -> dict[str, int]:
    """Width of each register of a text with lines `path: name width, name width ..`."""
    found = {}
    for line in text.strip().splitlines():
        path, _, names = line.partition(":")
        for name, width in (word.split() for word in names.split(",")):
            found[f"{path.strip()}.{name}"] = int(width)
    return found


Flip = tuple[int, int, str, int]


def draw(rng: random.Random, widths: Mapping[str, int], frames: int, last: int) -> list[Flip]:
    """For FLIPS: a random bit in each of the frames 1 to `frames`, 2 to `last` clocks after its clear."""
    names = rng.choices(list(widths), k=frames)
    return [(k + 1, rng.randint(2, last), name, rng.randrange(widths[name])) for k, name in enumerate(names)]


def register(player: Any, name: str) -> Any:
    """The handle of a path with dots; fails where there is none."""
    handle = player
    for part in name.split("."):
        block, _, index = part.rstrip("]").partition("[")
        handle = getattr(handle, block)
        if index:
            handle = handle[int(index)]
    return handle


async def flips(player: Any) -> None:
    """Flip what FLIPS says, until the player is done."""
    waiting = {frame: (clocks, name, bit) for frame, clocks, name, bit in json.loads(os.environ["FLIPS"])}
    frame, since = -1, 0
    while True:
        await FallingEdge(player.clk)
        if int(player.done.value):
            break
        since += 1
        if int(player.clear.value):
            frame, since = frame + 1, 0
        if frame in waiting and waiting[frame][0] == since:
            _, name, bit = waiting.pop(frame)
            handle = register(player, name)
            handle.value = int(handle.value) ^ 1 << bit
    assert not waiting, f"these frames were too short: {sorted(waiting)}"
