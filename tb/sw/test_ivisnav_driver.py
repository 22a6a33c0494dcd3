# SPDX-License-Identifier: Apache-2.0
"""iVisNav's driver on a bus of plain Python; what all drivers have in common is in test_core_driver.py."""

from __future__ import annotations

import numpy as np
import pytest
from relnav.errors import InputError
from relnav.ivisnav.driver import IvisnavDriver, beats_of
from relnav.ivisnav.quantise import QuantisedRows
from relnav.ivisnav.raw import RawRates, raw_to_result
from relnav.model.raw import float_to_word
from relnav.registers import Ivisnav

from tb.sw.fake_core import FakeCore

H = np.array([[1, -2, 3, -4, 5, -(1 << 31)]] * 6)
ROWS = QuantisedRows(
    H, np.array([-1, 0, 1, 2, 3, (1 << 31) - 1]), np.array([0, 65535, 9, 1, 1, 1]), 31, -3, 4.0
)


def test_beats() -> None:
    row = [0xFFFFFFFE_00000001, 0xFFFFFFFC_00000003, 0x80000000_00000005]
    last = [0xFFFFFFFF, 0xFFFF_00000000, 0x9_00000001, 0x1_00000002, 0x1_00000003, 0x1_7FFFFFFF]
    assert beats_of(ROWS) == [beat for end in last for beat in (*row, end)]
    assert all(type(beat) is int for beat in beats_of(ROWS))


def test_a_frame() -> None:
    core = FakeCore(Ivisnav)
    core.words |= {Ivisnav.ROWS.ADDRESS: 6, Ivisnav.WEIGHT.ADDRESS: 65547, Ivisnav.CONDITION.ADDRESS: 77}
    core.words |= {Ivisnav.CYCLES_RATES.ADDRESS: 300, Ivisnav.CYCLES_ALL.ADDRESS: 350}
    got = IvisnavDriver(core).solve(ROWS, 0.5)
    words = tuple(range(1000, 1028))
    expected = RawRates(6, None, 65547, 0, 77, words, cycles_rates=300, cycles_all=350)
    assert core.frames == [beats_of(ROWS)] and got == expected
    assert core.words[Ivisnav.FRAC.ADDRESS] == 0xFD1F
    assert core.words[Ivisnav.VARIANCE.ADDRESS] == float_to_word(2.0)  # times the weights' scale
    with pytest.raises(ValueError, match="does not fit"):
        IvisnavDriver(core).configure(frac_h=0, frac_y=128)
    with pytest.raises(InputError, match="not a normal binary32 number"):
        IvisnavDriver(core).solve(ROWS, 1e-300)


def test_refused_for_its_conditioning() -> None:
    """No numbers, but the condition; of any other refusal not even that, it would be another frame's."""
    core = FakeCore(Ivisnav)
    core.words[Ivisnav.CONDITION.ADDRESS] = float_to_word(9e6)
    core.solve = lambda c: c.failed(Ivisnav.FLAGS.encode(ILL_CONDITIONED=1))
    got = IvisnavDriver(core).solve(ROWS)
    assert got.failed and got == RawRates(flags=128, condition_word=float_to_word(9e6))
    result = raw_to_result(got, "far", ROWS)
    assert (result.v, result.cov, result.n, result.flags) == (None, None, 6, ("ILL_CONDITIONED",))
    assert result.condition == 3000.0
    core.solve = lambda c: c.failed(Ivisnav.FLAGS.encode(RANK_DEFICIENT=1))
    got = IvisnavDriver(core).solve(ROWS)
    assert got == RawRates(flags=2) and raw_to_result(got, 0, ROWS).condition is None


def test_what_the_words_mean() -> None:
    words = tuple(float_to_word(float(k)) for k in range(28))
    raw = RawRates(6, 5, 9, 1 << 5, float_to_word(16.0), words, 300, 350)
    result = raw_to_result(raw, "one", ROWS)
    assert result.v is not None and result.omega is not None and result.cov is not None
    assert result.v.tolist() == [0.0, 1.0, 2.0] and result.omega.tolist() == [3.0, 4.0, 5.0]
    assert result.rss == 6.0 / 4.0 and result.condition == 4.0 and result.flags == ("BUSY_WRITE",)
    assert result.cov[0].tolist() == [7.0, 8.0, 9.0, 10.0, 11.0, 12.0] and result.cov[5, 5] == 27.0
    assert result.cov[1, 1] == 13.0 and np.array_equal(result.cov, result.cov.T)
    assert result.cycles == {"rates": 300, "all": 350} and (result.frame, result.n) == ("one", 6)
    assert raw_to_result(RawRates(6, words=words), 0, ROWS).cycles is None
