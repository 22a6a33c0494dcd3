# SPDX-License-Identifier: Apache-2.0
"""The benchmarks run and notice what they are for; their numbers are made by `make bench`, not here."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from relnav.model.core import OltaeCore
from relnav.model.raw import RawResult, float_to_word

from bench import accuracy, limits, rates, three_sigma
from bench.clouds import FAMILIES, make_case
from bench.measure import floats, measure


@pytest.mark.parametrize("family", [name for name in FAMILIES if not name.startswith("many")])
def test_cases_are_the_same_on_every_call(family: str) -> None:
    first, second = make_case(family, 3), make_case(family, 3)
    np.testing.assert_array_equal(first.frame.a, second.frame.a)
    np.testing.assert_array_equal(first.frame.b, second.frame.b)
    assert first.config == second.config and first.frame.frac == second.frame.frac


def test_accuracy_keeps_its_bound() -> None:
    found = accuracy.run(120, processes=1)
    assert found["over_bound_near"] == 0 and not found["broken"] and not found["failed_below_1e6"]
    assert [entry["kappa_below"] for entry in found["bins"]] == list(accuracy.BINS)
    assert "largest errors" in accuracy.text(found)


def test_an_error_is_noticed() -> None:
    case = make_case("round", 0)
    good = measure(OltaeCore(), case)
    assert good.q is not None and good.q < 1e-7

    class Wrong(OltaeCore):
        def run(self, *arguments: object) -> RawResult:
            raw = super().run(*arguments)  # type: ignore[arg-type]
            return replace(raw, q=tuple(float_to_word(v) for v in floats(raw.q) * (1 + 1e-6)))

    bad = measure(Wrong(), case)
    assert bad.q == pytest.approx(1e-6, rel=0.2)
    assert accuracy.report([good, bad])["over_bound"] == 1


def test_three_sigma_holds_roughly() -> None:
    found = three_sigma.run(60, processes=1)
    shares = [share for row in found["angles"] for share in row["inside"].values()]
    assert len(shares) == 24 and np.mean(shares) > 0.985
    assert all(0.7 < ratio < 1.3 for row in found["angles"] for ratio in row["rms_over_sigma"].values())


def test_flags_rise_where_they_should() -> None:
    found = limits.run(60, processes=1)
    for shape in found.values():
        assert shape["golden_differs"] <= 1
        for flag, bound in (("ILL_CONDITIONED", -12.0), ("RANK_DEFICIENT", -20.0)):
            row = shape["flags"][flag]
            assert row["largest_log2_ratio_with"] < bound + 0.1
            assert row["least_log2_ratio_without"] > bound - 0.1


def test_random_rows_keep_their_bound() -> None:
    found = rates.random_matrices(6, processes=1)
    assert all(entry["holds"] for entry in found)
    assert [entry["refused"] for entry in found][:3] == [0, 0, 0] and found[-1]["refused"] == 6
    assert all(entry["explicit"] > entry["error"] for entry in found[:-1])


def test_rates_inside_3_sigma_roughly() -> None:
    found = rates.coverage(40, 20, processes=1)
    for row in found:
        assert not row["without_result"] and min(row["inside"].values()) > 0.9
        assert all(0.6 < ratio < 1.4 for ratio in row["rms_over_sigma"].values())


def test_a_wrong_rate_is_noticed() -> None:
    cell = ("alternately skewed", 0.5, 2.0, False)
    good = rates.run_rings((cell, 0, 2))
    assert rates.cell_report(cell, good)["holds"]
    bad = [replace(case, x=case.truth * (1 + 2e-5)) for case in good]
    assert not rates.cell_report(cell, bad)["holds"]
    refused = [replace(case, x=None) for case in good]
    assert rates.cell_report(cell, refused)["refused_within"] == 2
    assert not rates.cell_report(cell, refused)["holds"]
    beyond = [replace(case, cond=2100.0) for case in good]
    assert not rates.cell_report(cell, beyond)["holds"]


def test_rss_is_right_above_its_floor(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(rates, "NOISES", (1e-2,))
    (entry,) = rates.residuals(3, processes=1)
    assert entry["frames"] == 3 and entry["error"] < 1e-6
