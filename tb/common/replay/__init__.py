# SPDX-License-Identifier: Apache-2.0
"""Replay of stimulus files through a device under test; Python only prepares and compares."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from sim.runner import build_and_test, sources
from tb.common.vectors import read_hex, unpack, write_hex

HERE = Path(__file__).parent


def run(
    top: Path,
    folders: Sequence[str],
    simulator: str,
    folder: Path,
    stimulus: Sequence[int],
    in_bits: int,
    out_widths: Sequence[int],
    parameters: Mapping[str, int],
) -> list[tuple[int, list[int]]]:
    """Play `stimulus` through the wrapper `top`, whose device is made of `folders` of rtl/.

    Returns (cycle, unsigned fields after the valid bit) of every result.
    """
    write_hex(folder / "stimulus.hex", stimulus, in_bits)
    plusargs = [f"+stimulus={folder}/stimulus.hex", f"+cycles={len(stimulus)}"]
    plusargs += [f"+results={folder}/results.hex"]
    build_and_test(
        top.stem,
        [*sources(*folders), HERE / "replay.v", top],
        "replay_bench",
        simulator=simulator,
        parameters=parameters,
        plusargs=plusargs,
        public=False,
    )
    # the file has the cycle and the result each in whole hexadecimal digits
    bits = 1 + sum(out_widths)
    digits = (bits + 3) // 4
    rows = []
    for word in read_hex(folder / "results.hex"):
        valid, *fields = unpack(word & ((1 << (4 * digits)) - 1), [1, *out_widths])
        assert valid == 1
        rows.append((word >> (4 * digits), fields))
    return rows
