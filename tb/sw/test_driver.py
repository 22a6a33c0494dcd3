# SPDX-License-Identifier: Apache-2.0
"""OLTAE's driver on a bus of plain Python; what all drivers have in common is in test_core_driver.py."""

from __future__ import annotations

import numpy as np
import pytest
from relnav.driver import Build, OltaeDriver, beats_of
from relnav.errors import BackendError
from relnav.model.raw import CoreConfig, float_to_word
from relnav.quantise import QuantisedFrame
from relnav.registers import Oltae

from tb.sw.fake_core import FakeCore

FRAME = QuantisedFrame(np.array([[1, -2, 3]] * 3), np.array([[-(1 << 31), 5, 6]] * 3), None, -7)
WEIGHTED = QuantisedFrame(FRAME.a, FRAME.b, np.array([0, 65535, 9]), 95, 4.0)


def lean() -> FakeCore:
    """A core that has none of the options."""
    core = FakeCore(Oltae)
    core.kept[Oltae.CONFIG.ADDRESS] = Oltae.CONFIG.encode(FORBID_TURNS=1)
    return core


def test_beats() -> None:
    point = [0x80000000_00000001, 0x00000005_FFFFFFFE, 0x00000006_00000003]
    assert beats_of(FRAME) == point * 3
    assert beats_of(WEIGHTED) == [0, *point, 65535, *point, 9, *point]
    assert all(type(beat) is int for beat in beats_of(WEIGHTED))


def test_build() -> None:
    core = FakeCore(Oltae)
    core.words[Oltae.BUILD.ADDRESS] = Oltae.BUILD.encode(WEIGHTED=1, REAPPLY=1, MANTISSA=35)
    build = OltaeDriver(core).identify()
    assert build == Build(weighted=True, covariance=False, reapply=True, verify=False, mantissa=35)


def test_a_frame() -> None:
    core = FakeCore(Oltae)
    core.words |= {Oltae.POINTS.ADDRESS: 3, Oltae.WEIGHT.ADDRESS: 65544, Oltae.TURN.ADDRESS: 2}
    core.words |= {Oltae.CYCLES_Q.ADDRESS: 90, Oltae.CYCLES_POSE.ADDRESS: 120, Oltae.CYCLES_ALL.ADDRESS: 130}
    core.solve = lambda c: c.solved(Oltae.FLAGS.encode(Q_SATURATED=1))
    got = OltaeDriver(core).solve(WEIGHTED, CoreConfig(variance=0.5))
    assert core.frames == [beats_of(WEIGHTED)]
    assert (got.points, got.weight, got.turn, got.flag_names) == (3, 65544, 2, ("Q_SATURATED",))
    assert (got.cycles_q, got.cycles_pose, got.cycles_all) == (90, 120, 130)
    assert got.result_words() == [*range(1000, 1021), 0, *range(1022, 1034)]
    assert core.words[Oltae.CONFIG.ADDRESS] == Oltae.CONFIG.encode(WEIGHTED=1, COVARIANCE=1)
    assert core.words[Oltae.FRAC.ADDRESS] == 95
    assert core.words[Oltae.VARIANCE.ADDRESS] == float_to_word(2.0)  # times the weights' scale


def test_negative_frac_and_no_covariance() -> None:
    core = FakeCore(Oltae)
    got = OltaeDriver(core).solve(FRAME, CoreConfig(covariance=False, forbid_turns=True))
    assert core.words[Oltae.FRAC.ADDRESS] == 0xF9 and core.words[Oltae.CONFIG.ADDRESS] == 2
    assert got.q_cov is None and got.t_cov is None and got.rss == 1018


def test_what_is_not_built() -> None:
    core = lean()
    driver = OltaeDriver(core)
    with pytest.raises(BackendError, match="without weights"):
        driver.solve(WEIGHTED)
    assert not core.frames
    assert driver.solve(FRAME).q_cov is None  # no covariance to be read
    with pytest.raises(ValueError, match="does not fit"):
        driver.configure(CoreConfig(), frac=128)
