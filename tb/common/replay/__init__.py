# SPDX-License-Identifier: Apache-2.0
"""Replay of stimulus files through a device under test; Python only prepares and compares."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt

from sim.runner import build_and_test, sources
from tb.common.vectors import Rows, read_hex, read_hex_rows, unpack, write_hex, write_hex_rows

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
    _simulate(top, folders, simulator, folder, len(stimulus), parameters)
    # the file has the cycle and the result each in whole hexadecimal digits
    bits = 1 + sum(out_widths)
    digits = (bits + 3) // 4
    rows = []
    for word in read_hex(folder / "results.hex"):
        valid, *fields = unpack(word & ((1 << (4 * digits)) - 1), [1, *out_widths])
        assert valid == 1
        rows.append((word >> (4 * digits), fields))
    return rows


def run_rows(
    top: Path,
    folders: Sequence[str],
    simulator: str,
    folder: Path,
    stimulus: Rows,
    in_bits: int,
    fields: Sequence[np.dtype[np.unsignedinteger]],
    parameters: Mapping[str, int],
    extra: Sequence[Path] = (),
) -> list[npt.NDArray[np.unsignedinteger]]:
    """`run` for a million words: `stimulus` as rows of bytes, results as one array a field.

    The first array holds the cycles; the fields after the valid bit are unsigned integers of whole bytes.
    `extra` are sources outside rtl/.
    """
    write_hex_rows(folder / "stimulus.hex", stimulus, in_bits)
    _simulate(top, folders, simulator, folder, len(stimulus), parameters, extra)
    rows = read_hex_rows(folder / "results.hex")
    width = sum(field.itemsize for field in fields)
    # the cycle's eight digits, the digit of the valid bit, the fields
    cycle = (rows[:, -width - 5 : -width - 1] << 4) | (rows[:, -width - 4 : -width] >> 4)
    assert np.all(rows[:, -width - 1] & 15 == 1)
    columns = [np.ascontiguousarray(cycle).view(">u4")[:, 0].astype(np.uint32)]
    place = rows.shape[1] - width
    for field in fields:
        column = np.ascontiguousarray(rows[:, place : place + field.itemsize])
        columns.append(column.view(field.newbyteorder(">"))[:, 0].astype(field))
        place += field.itemsize
    return columns


def _simulate(
    top: Path,
    folders: Sequence[str],
    simulator: str,
    folder: Path,
    cycles: int,
    parameters: Mapping[str, int],
    extra: Sequence[Path] = (),
) -> None:
    plusargs = [f"+stimulus={folder}/stimulus.hex", f"+cycles={cycles}", f"+results={folder}/results.hex"]
    build_and_test(
        top.stem,
        [*sources(*folders), *extra, HERE / "replay.v", top],
        "replay_bench",
        simulator=simulator,
        parameters=parameters,
        plusargs=plusargs,
        public=False,
    )
