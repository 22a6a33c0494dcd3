# SPDX-License-Identifier: Apache-2.0
"""Operands for benches: corners, random values of random length, and files for $readmemh.

Bulk work goes through files: the pytest side writes the operands, a small Verilog wrapper reads them and
writes its results, and Python only compares the two files. Python at every clock edge would cost ten times
the simulation itself.
"""

from __future__ import annotations

import random
from collections.abc import Iterable, Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt

Rows = npt.NDArray[np.uint8]
"""Words as rows of bytes, the most significant first: what `to_rows` makes."""


def to_unsigned(value: int, bits: int) -> int:
    """The two's complement word of `bits` bits; refuses a value that does not fit (signed or unsigned)."""
    if not -(1 << (bits - 1)) <= value < (1 << bits):
        raise ValueError(f"{value} does not fit {bits} bits")
    return value & ((1 << bits) - 1)


def to_signed(word: int, bits: int) -> int:
    """The signed value of a two's complement word of `bits` bits."""
    word &= (1 << bits) - 1
    return word - (1 << bits) if word >> (bits - 1) else word


def pack(fields: Iterable[tuple[int, int]]) -> int:
    """One word from (value, bits) fields, the first field in the most significant bits."""
    word = 0
    for value, bits in fields:
        word = (word << bits) | to_unsigned(value, bits)
    return word


def unpack(word: int, widths: Sequence[int]) -> list[int]:
    """The unsigned fields of a word made by `pack`, in the same order."""
    fields = []
    for bits in reversed(widths):
        fields.append(word & ((1 << bits) - 1))
        word >>= bits
    return fields[::-1]


def corners(bits: int, signed: bool = True) -> list[int]:
    """Zero, the ends of the range, their neighbours and the powers of two with theirs."""
    low, high = (-(1 << (bits - 1)), (1 << (bits - 1)) - 1) if signed else (0, (1 << bits) - 1)
    values = {0, 1, low, low + 1, high, high - 1}
    for power in range(bits):
        values |= {(1 << power) + d for d in (-1, 0, 1)} | {-(1 << power) + d for d in (-1, 0, 1)}
    return sorted(v for v in values if low <= v <= high)


def random_value(rng: random.Random, bits: int, signed: bool = True) -> int:
    """A value of random length, so that small numbers are as common as large ones."""
    length = rng.randint(0, bits - 1 if signed else bits)
    value = rng.getrandbits(length) if length else 0
    return -value - 1 if signed and rng.random() < 0.5 else value


def write_hex(file: Path, words: Iterable[int], bits: int) -> int:
    """Write words (signed or unsigned) for $readmemh, one a line; returns how many."""
    digits = (bits + 3) // 4
    lines = [f"{to_unsigned(word, bits):0{digits}x}" for word in words]
    file.write_text("\n".join(lines) + "\n")
    return len(lines)


def read_hex(file: Path) -> list[int]:
    """The unsigned words of a file of hexadecimal lines; an x or z in one is an error that names the line."""
    words = []
    for number, line in enumerate(file.read_text().splitlines(), 1):
        try:
            words.append(int(line.strip(), 16))
        except ValueError:
            raise ValueError(f"{file.name}: line {number}: {line!r} is not a known value") from None
    return words


# A million words a second or more: words as rows of bytes.
_DIGITS = np.frombuffer(b"0123456789abcdef", np.uint8)
_VALUES = np.full(256, 255, np.uint8)
_VALUES[_DIGITS] = np.arange(16, dtype=np.uint8)


def to_rows(*fields: npt.NDArray[np.unsignedinteger]) -> Rows:
    """Unsigned integers of whole bytes side by side, the first on top: (n,) each to (n, bytes in all)."""
    columns = [field.astype(field.dtype.newbyteorder(">")).view(np.uint8) for field in fields]
    return np.concatenate([column.reshape(len(fields[0]), -1) for column in columns], axis=1)


def write_hex_rows(file: Path, rows: Rows, bits: int) -> None:
    """`write_hex` for rows of bytes, of which the lowest `bits` bits are the word."""
    text = np.empty((len(rows), 2 * rows.shape[1] + 1), np.uint8)
    text[:, 0:-1:2] = _DIGITS[rows >> 4]
    text[:, 1:-1:2] = _DIGITS[rows & 15]
    text[:, -1] = ord("\n")
    text[:, -1 - (bits + 3) // 4 :].tofile(file)


def read_hex_rows(file: Path) -> Rows:
    """`read_hex` for lines of one length: (lines, bytes), right-aligned."""
    text = np.fromfile(file, np.uint8)
    if text.size == 0:
        return np.empty((0, 0), np.uint8)
    lines = text.reshape(-1, int(np.argmax(text == ord("\n"))) + 1)[:, :-1]
    values = _VALUES[lines]
    unknown = np.flatnonzero(np.any(values > 15, axis=1))
    if unknown.size:
        line = lines[unknown[0]].tobytes()
        raise ValueError(f"{file.name}: line {unknown[0] + 1}: {line!r} is not a known value")
    if values.shape[1] % 2:
        values = np.pad(values, ((0, 0), (1, 0)))
    rows: Rows = np.bitwise_or(np.left_shift(values[:, 0::2], 4), values[:, 1::2])
    return rows
