# SPDX-License-Identifier: Apache-2.0
"""Bit-exact model of rtl/gram/butterfly.v: sum and difference of two items of a stream."""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass, field
from enum import Enum

from relnav.words import LEAN, Build


class Role(Enum):
    """What an item of the stream is."""

    PLAIN = "plain"
    FIRST = "first"
    SECOND = "second"


def role(lane: int) -> Role:
    """Role of a slot's pair by lane: 0, 1 give T_i, E_i; 3, 4 F_ij, H_ij; 5, 6 P_ij, N_ij; 2 passes."""
    firsts, seconds = (0, 3, 5), (1, 4, 6)
    return Role.FIRST if lane in firsts else Role.SECOND if lane in seconds else Role.PLAIN


@dataclass
class Butterfly:
    """Turns a, b into a + b (with a's tag) and a - b (with b's tag)."""

    words: Build = LEAN
    _held: list[tuple[Hashable, int]] = field(default_factory=list)

    def push(self, kind: Role, value: int, tag: Hashable = None) -> list[tuple[Hashable, int]]:
        """Take one item, return those that leave, in order; ValueError if anything comes between a and b."""
        if (kind is Role.SECOND) != bool(self._held):
            raise ValueError("a second item must follow its first one")
        if kind is Role.FIRST:
            self._held.append((tag, value))
            return []
        if kind is Role.PLAIN:
            return [(tag, value)]
        first_tag, first = self._held.pop()
        return [(first_tag, self._wrap(first + value)), (tag, self._wrap(first - value))]

    def _wrap(self, value: int) -> int:
        """Two's complement of CENTRED bits (centred moments never wrap)."""
        half = 1 << (self.words.CENTRED - 1)
        return (value + half) % (2 * half) - half
