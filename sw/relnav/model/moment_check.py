# SPDX-License-Identifier: Apache-2.0
"""Bit-exact model of rtl/gram/moment_check.v: do the sums that leave a Gram array agree with its beats?

Modulo p = 2^16 + 1 a number is congruent to its 16-bit words with the signs + - + -, so nothing is divided.
The beats give P = sum over rows of w (s^2 - 2), s = sum of c_i u_i; the sums that are drained give C = sum of
coefficient times sum, and C - P must be 0 modulo p. The derivation stands in the header of the Verilog,
`coefficients` says what follows from it.

One flipped bit changes a sum by +-2^n, and p is a prime: a change of C (algorithm-based fault tolerance:
Huang and Abraham, IEEE Transactions on Computers C-33, 1984). The modulus 2^16 - 1 would not do: it divides
what a flipped bit of a Karatsuba sum changes, 2^n (1 - 2^16).
"""

from __future__ import annotations

import functools
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

from relnav.model.gram import DRAIN_ORDER, pair_components
from relnav.model.gram_ring import COMPONENTS

P = (1 << 16) + 1
"""The modulus, a prime."""
OFFSET = 1 << 17
"""-2 modulo p: keeps what is accumulated positive."""
WORD = (1 << 16) - 1
KEY_RESIDUE, KEY_SUM, KEY_RING_WEIGHT = 56, 57, 58
#: stream addresses of W, of the three first moments of a, and of b
ADDRESS_W, ADDRESS_A, ADDRESS_B = 24, (7, 15, 23), (25, 26, 27)


@dataclass(frozen=True)
class Layout:
    """What differs between the two arrays."""

    factors: tuple[int, ...]
    """g_k of beat k: the low half has the coefficient g_k, the high half g_k 2^(2 + k)."""
    components: int

    @property
    def component_coefficients(self) -> list[int]:
        """c_i of the components, two a beat."""
        both = [c for k, g in enumerate(self.factors) for c in (g, g << (2 + k))]
        return both[: self.components]


ARRAY = Layout(factors=(17, 39, 14), components=6)
RING = Layout(factors=(58, 8, 22, 37), components=COMPONENTS)


@functools.cache
def coefficients(layout: Layout) -> Mapping[int, int]:
    """Coefficient, in 0..p-1, of each key; negated for all but the second moments.

    The hardware negates values, the predicted residue and the sum fed back on their way (`term`).
    """
    c = layout.component_coefficients
    total = sum(c)

    def pair(i: int, j: int) -> int:
        return c[i] * c[j] * (1 if i == j else 2)

    if layout is RING:
        found = {8 * i + j: pair(i, j) for i in range(COMPONENTS) for j in range(i, COMPONENTS)}
        found[KEY_RING_WEIGHT] = -OFFSET
    else:
        found = {8 * slot + lane: pair(*pair_components(slot, lane)) for slot, lane in DRAIN_ORDER}
        found |= {address: total * c[2 * k] for k, address in enumerate(ADDRESS_A)}
        found |= {address: total * c[2 * k + 1] for k, address in enumerate(ADDRESS_B)}
        found[ADDRESS_W] = -(1 << 14) * total * total - OFFSET
    found |= {KEY_RESIDUE: 1, KEY_SUM: 1}
    return {key: value % P for key, value in found.items()}


def predicted(layout: Layout, rows: Iterable[Sequence[int]], weights: Iterable[int]) -> int:
    """P of a frame as the hardware holds it, in 50 bits, not reduced.

    Args:
        rows: signed 32-bit components of each row, in the order of the beats, low half first.
        weights: of the rows, 0..65535; 1 where unweighted.
    """
    sums = 0
    for row, weight in zip(rows, weights, strict=True):
        s = 0
        for i, u in enumerate(row):
            f = (u & WORD) - (u >> 16)
            s += layout.factors[i // 2] * (f << (2 + i // 2) if i % 2 else f)
        folded = (s & WORD) - (s >> 16)
        square = folded * folded
        sums += weight * ((square & WORD) - (square >> 16) + OFFSET)
    assert sums < 1 << 50
    return sums


def term(first: int, second: int) -> int:
    """The 19-bit term of first - second: its words with signs, the uppermost one from bit 32 on."""
    total = first - second
    return (total & WORD) - ((total >> 16) & WORD) + (total >> 32)


def item_term(item: int) -> int:
    """Congruent to an item of up to 96 bits, signed: 2^48 = -1."""
    return term(item & (1 << 48) - 1, item >> 48)


def value_term(value: int, bits: int) -> int:
    """Congruent to minus a signed value of `bits` bits, up to 64: bits 63:48 come at 47:32."""
    if bits <= 48:
        return term(0, value)
    return term(value >> 48 << 32, value & (1 << 48) - 1)


@dataclass(frozen=True)
class Comparison:
    """One check of a drain."""

    sums: tuple[int, int, int]
    """C - P, not reduced; then fed back once, and twice, with the sign changed."""

    @property
    def mismatch(self) -> bool:
        """The sums do not agree with the beats."""
        return self.sums[2] & 0x3FFFF != 0


def compare(
    layout: Layout,
    residue: int,
    items: Iterable[tuple[int, int]],
    values: Iterable[tuple[int, int]],
    value_bits: int,
) -> Comparison:
    """Check a drain.

    Args:
        residue: of `predicted`.
        items: (key, integer) of the second moments.
        values: (key, integer) of the other sums, words of value_bits bits.
    """
    table = coefficients(layout)
    total = sum(table.get(key, 0) * item_term(item) for key, item in items)
    total += sum(table.get(key, 0) * value_term(value, value_bits) for key, value in values)
    total += table[KEY_RESIDUE] * term(residue >> 48, residue & (1 << 48) - 1)
    once = term(0, total)
    return Comparison((total, once, term(0, once)))
