# SPDX-License-Identifier: Apache-2.0
"""What the generated `relnav.registers` is made of: a register is a class, a field a (low, width) pair."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar


@dataclass(frozen=True)
class Field:
    """Bits `low + width - 1` down to `low` of a register word."""

    low: int
    width: int
    signed: bool = False

    @property
    def mask(self) -> int:
        """The field's bits within the word."""
        return ((1 << self.width) - 1) << self.low

    def get(self, word: int) -> int:
        """The field's value in a register word."""
        value = (word & self.mask) >> self.low
        return value - (1 << self.width) if self.signed and value >> (self.width - 1) else value

    def put(self, value: int) -> int:
        """The word with this field at `value` and all else 0; ValueError when it does not fit."""
        lowest = -(1 << (self.width - 1)) if self.signed else 0
        if not lowest <= value < lowest + (1 << self.width):
            raise ValueError(
                f"{value} does not fit {self.width} {'signed' if self.signed else 'unsigned'} bits"
            )
        return (value << self.low) & self.mask


class Register:
    """A 32-bit register, or COUNT of them in a row."""

    ADDRESS: ClassVar[int]
    ACCESS: ClassVar[str]
    """ro, rw, wo or w1c (write 1 to clear)."""
    RESET: ClassVar[int | None] = None
    """Word after reset; None where hardware decides."""
    COUNT: ClassVar[int] = 1
    FIELDS: ClassVar[Mapping[str, Field]]

    @classmethod
    def element(cls, index: int) -> int:
        """Address of one word of a row; IndexError outside it."""
        if not 0 <= index < cls.COUNT:
            raise IndexError(f"{cls.__name__} has {cls.COUNT} words, not {index + 1}")
        return cls.ADDRESS + 4 * index

    @classmethod
    def decode(cls, word: int) -> dict[str, int]:
        """Every field of a word by name."""
        return {name: field.get(word) for name, field in cls.FIELDS.items()}

    @classmethod
    def encode(cls, **fields: int) -> int:
        """The word with these fields, all else 0; KeyError or ValueError for a wrong name or value."""
        word = 0
        for name, value in fields.items():
            word |= cls.FIELDS[name].put(value)
        return word
