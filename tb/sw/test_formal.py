# SPDX-License-Identifier: Apache-2.0
"""Smoke test of `make formal`: the cheapest proof, its broken copy, and what the runner must notice."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from formal.runner import (
    RTL,
    DoesNotFit,
    Group,
    ToolsMissing,
    broken_copy,
    caught,
    labels,
    run,
    sources,
    tools,
)
from formal.targets import GROUPS

CHEAPEST = next(group for group in GROUPS if group.module == "sign_run")


@pytest.fixture
def installed() -> None:
    try:
        tools()
    except ToolsMissing as error:
        pytest.skip(str(error))


@pytest.mark.usefixtures("installed")
def test_the_cheapest_proof_holds(tmp_path: Path) -> None:
    outcome = run(CHEAPEST.module, CHEAPEST.proof, tmp_path / "proof")
    assert (outcome.status, outcome.failed) == ("PASS", ())
    assert outcome.engine == "complete, yices"


@pytest.mark.usefixtures("installed")
def test_its_broken_copy_fails(tmp_path: Path) -> None:
    broken = CHEAPEST.broken[0]
    broken_copy(CHEAPEST.module, broken, tmp_path / "rtl")
    outcome = run(CHEAPEST.module, broken.task, tmp_path / "broken", tmp_path / "rtl")
    assert outcome.status == "FAIL"
    assert caught(broken, outcome)
    assert not caught(replace(broken, label="another"), outcome)


@pytest.mark.usefixtures("installed")
def test_a_run_that_takes_too_long_is_ended(tmp_path: Path) -> None:
    assert run(CHEAPEST.module, CHEAPEST.proof, tmp_path / "proof", limit=0.01).status == "TIMEOUT"


@pytest.mark.parametrize("group", GROUPS, ids=lambda group: f"{group.module}-{group.proof}")
def test_every_fault_fits_the_rtl_and_names_an_assertion(group: Group, tmp_path: Path) -> None:
    known = set().union(*labels(group.module).values())
    for number, broken in enumerate(group.broken):
        assert broken.file in sources(group.module)
        assert set(broken.label.split()) <= known
        broken_copy(group.module, broken, tmp_path / str(number))
        assert (tmp_path / str(number) / broken.file).read_text() != (RTL / broken.file).read_text()


def test_a_fault_that_does_not_fit_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(DoesNotFit, match="0 times"):
        broken_copy(CHEAPEST.module, replace(CHEAPEST.broken[0], old="no such text"), tmp_path)
