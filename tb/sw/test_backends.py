# SPDX-License-Identifier: Apache-2.0
"""What goes to a core and what comes back, with a stand-in for the core."""

from __future__ import annotations

import sys
from types import SimpleNamespace

import numpy as np
import pytest
from relnav.backends import solve
from relnav.errors import BackendError, InputError
from relnav.frames import make_frame
from relnav.model.raw import CoreConfig, RawResult, float_to_word
from relnav.quantise import QuantisedFrame

FRAMES = [make_frame(np.eye(3) * k, np.eye(3) * k, name=k) for k in (1, 2)]
EMPTY = make_frame(np.zeros((0, 3)), np.zeros((0, 3)), name="none")
IDENTITY = tuple(float_to_word(v) for v in np.eye(3).ravel())


def answer(frame: QuantisedFrame, config: CoreConfig) -> RawResult:
    return RawResult(
        points=frame.n, R=IDENTITY, rss=float_to_word(float(frame.frac)), flags=config.reapply << 9
    )


def run_frames(
    frames: list[QuantisedFrame],
    simulator: str,
    rtl_dir: object = None,
    config: CoreConfig | None = None,
    waves: object = None,
) -> list[RawResult]:
    assert config is not None
    return [answer(frame, config) for frame in frames]


@pytest.mark.parametrize("backend", ["fixed", "icarus"])
def test_frames_in_order_without_the_empty_one(monkeypatch: pytest.MonkeyPatch, backend: str) -> None:
    core = SimpleNamespace(OltaeCore=lambda: SimpleNamespace(run=answer))
    monkeypatch.setitem(sys.modules, "relnav.model.core", core)
    monkeypatch.setitem(sys.modules, "relnav.rtlsim", SimpleNamespace(run_frames=run_frames))
    first, none, second = solve([FRAMES[0], EMPTY, FRAMES[1]], backend, config=CoreConfig(reapply=True))
    assert (first.frame, none.frame, second.frame) == (1, "none", 2)
    assert (first.rss, second.rss) == (30.0, 29.0) and first.flags == ("NOT_BUILT",)
    assert none.flags == ("FEW_POINTS",) and none.n == 0


def test_missing_results_are_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "relnav.rtlsim", SimpleNamespace(run_frames=lambda *_, **__: []))
    with pytest.raises(BackendError, match="0 results for 2 frames"):
        solve(FRAMES, "verilator")


def test_missing_part_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "relnav.rtlsim", None)
    with pytest.raises(BackendError, match="cannot be loaded"):
        solve(FRAMES, "icarus")


def test_every_backend_refuses_what_one_refuses() -> None:
    large = make_frame(np.eye(3) * 1e30, np.eye(3))
    tiny = make_frame(np.eye(3), np.eye(3), [1e-20, 1e-20, 1e-20])
    for backend in ("double", "fixed"):
        with pytest.raises(InputError, match="no binary point"):
            solve([large], backend)
        with pytest.raises(InputError, match="binary32"):
            solve([tiny], backend, config=CoreConfig(variance=1e30))


def test_double_takes_the_values_as_they_are() -> None:
    a = np.array([[1.0, 0, 0], [0, 1, 0], [0, 0, 1], [1e-12, 0, 0]])
    (result,) = solve([make_frame(a, a + 1e-12)], "double")
    assert result.t is not None
    np.testing.assert_allclose(result.t, 1e-12, rtol=1e-3)
