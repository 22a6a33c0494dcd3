# SPDX-License-Identifier: Apache-2.0
"""The Verilog header of the word lengths is what `python -m relnav.words` writes."""

from __future__ import annotations

from pathlib import Path

import pytest
from relnav import words


def test_the_header_is_current() -> None:
    assert words.HEADER.read_text() == words.verilog(), "python -m relnav.words"


def test_a_change_shows(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    header = tmp_path / "rtl" / "include" / "words.vh"
    monkeypatch.setattr(words, "HEADER", header)
    assert words.main() == 0
    assert header.read_text() == words.verilog() != words.verilog(words.WORDS[1:])
