# SPDX-License-Identifier: Apache-2.0
"""The C driver, compiled for this machine, on the RTL of both cores: c_driver_bench.py in both simulators."""

from __future__ import annotations

import pytest
from relnav.rtlsim import HARNESS

from sim.runner import ROOT, build_and_test, sources
from tb.c.library import CDriver

# Icarus simulates some 3000 clocks a second, a tenth of Verilator's here
QUICK = ("frames", "identity", "busy", "verified", "flipped")

BUILDS = {
    "oltae": ("oltae", {}),
    "oltae-lean": ("oltae", {"WEIGHTED": 0, "COVARIANCE": 0, "REAPPLY": 0, "VERIFY": 0}),
    "ivisnav": ("ivisnav", {}),
}


@pytest.mark.parametrize("build", BUILDS)
def test_on_the_rtl(build: str, simulator: str, driver: CDriver) -> None:
    core, parameters = BUILDS[build]
    values = ", ".join(f".{name}({value})" for name, value in parameters.items())
    build_and_test(
        HARNESS,
        [*sources(), ROOT / "sim" / f"{HARNESS}.v"],
        "c_driver_bench",
        simulator=simulator,
        defines={"RELNAV_TOP": f"{core}_top", "RELNAV_PARAMETERS": f"#({values})" if values else ""},
        env={
            "CORE": core,
            "LEAN": str(int(build == "oltae-lean")),
            "LIBRARY": str(driver.file),
            "SIMULATOR": simulator,
            "FRAMES": "24" if simulator == "verilator" else "4",
        },
        testcase=None if simulator == "verilator" else QUICK,
        public=False,
    )
