# SPDX-License-Identifier: Apache-2.0
"""The C driver bare on the Cortex-A9 of QEMU's Zynq-7000: both cores as mocks, without newlib."""

from __future__ import annotations

import subprocess
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from relnav.driver import beats_of
from relnav.frames import make_frame
from relnav.ivisnav.driver import beats_of as row_beats_of
from relnav.ivisnav.quantise import quantise_rows
from relnav.ivisnav.raw import raw_to_result
from relnav.ivisnav.rows import make_rate_frame
from relnav.model.core import OltaeCore
from relnav.model.rates_core import RatesCore
from relnav.model.raw import CoreConfig, raw_to_pose, variance_word
from relnav.quantise import quantise

from scripts.c_build import (
    ARM,
    CALLBACKS,
    DRIVER,
    HOST,
    SOURCES,
    STRICT_FLAGS,
    CompileError,
    missing,
    program,
    run,
)

HERE = Path(__file__).parent / "bare_metal"
MACHINE = "qemu-system-arm"
VARIANCE, F0, DT = 3.5e-4, 20e6, 0.01


def array(kind: str, name: str, values: Iterable[Any]) -> str:
    """A constant array of C; doubles exactly."""
    texts = [value.hex() if isinstance(value, float) else hex(value) for value in values]
    return f"static const {kind} {name}[] = {{{', '.join(texts)}}};\n"


def number(name: str, value: float) -> str:
    return f"static const double {name} = {value.hex()};\n"


def vectors() -> str:
    """vectors.h: a frame for each core, its beats and its results by the model."""
    rng = np.random.default_rng(1)
    a = rng.normal(size=(5, 3)).astype(np.float32)  # the same as floats and as doubles
    b = (a[:, [1, 2, 0]] + np.float32(3.25)).astype(np.float32)
    w = np.array([1.5, 0.25, 3, 0, 7], np.float32)
    points = quantise(make_frame(a, b, w))
    raw = OltaeCore().run(points, CoreConfig(variance=VARIANCE))
    pose = raw_to_pose(raw, 0, points)
    assert not raw.flags and pose.rss is not None and pose.determinant is not None
    lines = [
        f"#define OLTAE_COUNT {points.n}u\n#define OLTAE_BEATS {4 * points.n}u\n",
        f"#define OLTAE_VARIANCE {VARIANCE.hex()}\n",
        f"#define OLTAE_VARIANCE_WORD {variance_word(VARIANCE, points.weight_scale)}u\n",
        f"#define OLTAE_FRAC_WANTED ((uint32_t)({points.frac}))\n",
        *(
            array(kind, f"oltae_{name}{suffix}", map(float, part.ravel()))
            for kind, suffix in (("double", ""), ("float", "_float"))
            for name, part in zip("abw", (a, b, w), strict=True)
        ),
        array("uint64_t", "oltae_wanted", beats_of(points)),
        array("uint32_t", "oltae_head", [raw.points, raw.weight, raw.turn, 99, 133, 836]),
        array("uint32_t", "oltae_words", raw.result_words()),
        number("oltae_rss", pose.rss),
        number("oltae_determinant", pose.determinant),
    ]
    r, p = rng.normal(size=(2, 8, 3))
    beams = make_rate_frame(r, p, rng.normal(size=8), rng.uniform(0.1, 2, 8))
    rows = quantise_rows(beams, F0, DT)
    rates = RatesCore().run(rows, VARIANCE)
    found = raw_to_result(rates, 0, rows)
    assert rates.words is not None and found.rss is not None and found.condition is not None
    assert not rates.flags and beams.w is not None
    lines += [
        f"#define IVISNAV_COUNT {rows.n}u\n#define IVISNAV_BEATS {4 * rows.n}u\n",
        f"#define IVISNAV_VARIANCE {VARIANCE.hex()}\n",
        f"#define IVISNAV_F0 {F0.hex()}\n#define IVISNAV_DT {DT.hex()}\n",
        f"#define IVISNAV_VARIANCE_WORD {variance_word(VARIANCE, rows.weight_scale)}u\n",
        array("double", "ivisnav_r", map(float, beams.r.ravel())),
        array("double", "ivisnav_p", map(float, beams.p.ravel())),
        array("double", "ivisnav_dphi", map(float, beams.dphi)),
        array("double", "ivisnav_w", map(float, beams.w)),
        array("uint64_t", "ivisnav_wanted", row_beats_of(rows)),
        array("uint32_t", "ivisnav_head", [rates.n, rates.weight, rates.condition_word, 345, 0, 472]),
        array("uint32_t", "ivisnav_words", rates.words),
        number("ivisnav_rss", found.rss),
        number("ivisnav_condition", found.condition),
    ]
    return "".join(lines)


def ends_well(command: Sequence[str | Path]) -> None:
    done = subprocess.run(
        command, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=120, check=False
    )
    said = done.stdout + done.stderr
    assert done.returncode == 0 and said == "all well\n", said


@pytest.mark.parametrize("access", ["memory", "callbacks"])
def test_on_a_cortex_a9(access: str, tmp_path: Path) -> None:
    if reason := missing(ARM, MACHINE):
        pytest.skip(reason)
    (tmp_path / "vectors.h").write_text(vectors())
    sources = [HERE / name for name in ("startup.s", "board.c", "mock.c", "main.c")]
    more = [CALLBACKS] if access == "callbacks" else []
    made = program(tmp_path / "test.elf", sources, HERE / "zynq.ld", [tmp_path], more)
    quiet = ["-display", "none", "-monitor", "none", "-serial", "none"]
    console = ["-chardev", "stdio,id=console", "-semihosting-config", "enable=on,chardev=console"]
    ends_well([MACHINE, "-M", "xilinx-zynq-a9", "-m", "128M", *quiet, *console, "-kernel", made])


@pytest.mark.parametrize("sanitized", [False, True], ids=["plain", "sanitized"])
def test_the_same_on_this_machine(sanitized: bool, tmp_path: Path) -> None:
    """Also with every access and every undefined operation watched."""
    if reason := missing(HOST):
        pytest.skip(reason)
    (tmp_path / "vectors.h").write_text(vectors())
    sources = [HERE / name for name in ("host.c", "mock.c", "main.c")]
    made = tmp_path / "test"
    options = ["-O1", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"] if sanitized else ["-O2"]
    if sanitized:
        (tmp_path / "nothing.c").write_text("int main(void) { return 0; }\n")
        try:
            run([HOST, *options, "-o", made, tmp_path / "nothing.c"])
        except CompileError:
            pytest.skip(f"{HOST} has no sanitizers")
    flags = [*STRICT_FLAGS, *options, CALLBACKS, "-I", DRIVER, "-I", tmp_path]
    run([HOST, *flags, "-o", made, *SOURCES, *sources])
    ends_well([made])
