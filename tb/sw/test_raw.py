# SPDX-License-Identifier: Apache-2.0
"""Register words to results: bit patterns, flags, and what the weights' scale undoes."""

from __future__ import annotations

import numpy as np
import pytest
from relnav import golden, registers
from relnav.errors import InputError
from relnav.frames import make_frame
from relnav.model.raw import (
    RESULT_LAYOUT,
    CoreConfig,
    RawResult,
    float_to_word,
    raw_to_pose,
    results_from_words,
    word_to_float,
)
from relnav.quantise import QuantisedFrame, quantise
from relnav.result import FLAG_NAMES, PoseResult

UPPER = np.triu_indices(3)


def raw_of(result: PoseResult, quantised: QuantisedFrame) -> RawResult:
    """What a perfect core would leave: the golden result in binary32."""

    def words(values: object) -> tuple[int, ...]:
        return tuple(float_to_word(float(v)) for v in np.ravel(np.asarray(values)))

    assert result.q is not None and result.q_cov is not None and result.t_cov is not None
    assert result.rss is not None and result.condition is not None and result.weight is not None
    return RawResult(
        points=quantised.n,
        weight=round(result.weight),
        q=words(result.q),
        q_fixed=tuple(round(v * 65536) for v in result.q),
        R=words(result.R),
        T=words(result.t),
        rss=float_to_word(result.rss),
        condition=float_to_word(result.condition),
        q_cov=words(result.q_cov[UPPER]),
        t_cov=words(result.t_cov[UPPER]),
    )


def test_flags_and_layout_are_the_registers() -> None:
    fields = registers.Oltae.FLAGS.FIELDS
    assert {name: 1 << bit for bit, name in enumerate(FLAG_NAMES)} == {n: f.put(1) for n, f in fields.items()}
    for name, (start, count) in RESULT_LAYOUT.items():
        register = getattr(registers.Oltae, name if name in ("R", "T") else name.upper())
        assert start == (register.ADDRESS - 0x100) // 4 and getattr(register, "COUNT", 1) == count


@pytest.mark.parametrize("given", [True, False], ids=["sigma", "rss"])
@pytest.mark.parametrize("factor", [1.0, 0.25, 1.0 / 3.0, 1e-7, 1e9])
def test_weight_scale_is_undone(factor: float, given: bool) -> None:
    """A core that counts in integer weights gives the user the covariance and rss of the user's weights."""
    rng = np.random.default_rng(1)
    a = rng.normal(size=(20, 3))
    b = a + 0.01 * rng.normal(size=a.shape) + [1.0, 2.0, 3.0]
    w = np.asarray(rng.integers(2000, 60000, 20) * factor, dtype=np.float64)
    quantised = quantise(make_frame(a, b, w))
    assert quantised.w is not None
    config = CoreConfig(variance=0.7 * factor if given else 0.0)
    variance = word_to_float(config.variance_word(quantised.weight_scale))
    first, second = quantised.values()
    core = golden.estimate(first, second, np.asarray(quantised.w, dtype=np.float64), variance=variance)
    ours = raw_to_pose(raw_of(core, quantised), "k", quantised)
    user = golden.estimate(a, b, w, variance=config.variance)
    for name in ("q", "R", "t", "q_cov", "t_cov", "rss", "weight", "condition", "quaternion"):
        expected = np.asarray(getattr(user, name))
        np.testing.assert_allclose(
            getattr(ours, name), expected, rtol=1e-3, atol=1e-4 * np.abs(expected).max(), err_msg=name
        )


def test_numbers_are_the_words_unrounded() -> None:
    rng = np.random.default_rng(2)
    a = rng.normal(size=(5, 3))
    quantised = quantise(make_frame(a, a + 1.0))
    raw = raw_of(golden.estimate(a, a + 1.0), quantised)
    pose = raw_to_pose(raw, 0, quantised)
    assert pose.t is not None and [float_to_word(v) for v in pose.t] == list(raw.T)
    assert pose.cycles is None and pose.turn == "none" and pose.flags == ()


def test_words_there_and_back() -> None:
    words = [*range(1, 22), 0, *range(22, 34)]
    words[4] = 0xFFFFFFFF
    raw = RawResult(**results_from_words(words))  # type: ignore[arg-type]
    assert raw.q_fixed == (4, -1, 6) and raw.result_words() == words
    assert results_from_words(words, covariance=False)["t_cov"] is None


@pytest.mark.parametrize("bit", range(10))
def test_failed_frames_have_no_numbers(bit: int) -> None:
    quantised = quantise(make_frame(np.eye(3), np.eye(3)))
    raw = RawResult(points=99, flags=1 << bit, R=tuple(float_to_word(v) for v in np.eye(3).ravel()))
    pose = raw_to_pose(raw, 7, quantised)
    assert pose.flags == (FLAG_NAMES[bit],)
    failed = FLAG_NAMES[bit] not in ("BUSY_WRITE", "Q_SATURATED", "ILL_CONDITIONED", "NOT_BUILT")
    assert pose.failed is failed is (pose.R is None)
    assert pose.n == (3 if failed else 99)  # a failed frame's registers hold the frame before


def test_infinite_q_is_none() -> None:
    quantised = quantise(make_frame(np.eye(3), np.eye(3)))
    turn = np.diag([-1.0, -1.0, 1.0])
    raw = RawResult(
        points=3,
        flags=1 << 6,
        q=(0, 0, float_to_word(np.inf)),
        R=tuple(float_to_word(v) for v in turn.ravel()),
        q_cov=(float_to_word(np.inf),) * 6,
        t_cov=(0,) * 6,
        cycles_q=1,
        cycles_pose=2,
        cycles_all=3,
    )
    values = raw_to_pose(raw, 0, quantised).to_json()
    assert values["q"] is None and values["q_cov"] is None and values["t_cov"] == [[0.0] * 3] * 3
    assert values["quaternion"] == [0.0, 0.0, 0.0, 1.0] and values["cycles"] == {"q": 1, "pose": 2, "all": 3}


def test_variance_word() -> None:
    assert CoreConfig().variance_word(0.5) == 0
    assert word_to_float(CoreConfig(variance=0.5).variance_word(4.0)) == 2.0
    for variance, scale in ((1e-30, 1e-20), (1e30, 1e20), (5e-324, 1e-10)):
        with pytest.raises(InputError, match="binary32"):
            CoreConfig(variance=variance).variance_word(scale)
