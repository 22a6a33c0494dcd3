# SPDX-License-Identifier: Apache-2.0
"""The cores that can be simulated: what runs, what goes in, what comes out."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from relnav.driver import CoreDriver, OltaeDriver
from relnav.ivisnav.driver import IvisnavDriver
from relnav.ivisnav.quantise import QuantisedRows
from relnav.ivisnav.raw import RawRates
from relnav.model.raw import CoreConfig, RawResult
from relnav.quantise import QuantisedFrame


@dataclass(frozen=True)
class SimulatedCore:
    """One core: Verilog module, the dataclasses of its frames and results, its driver.

    options: from those of a job, as JSON carries them, to arguments of the driver's `solve`.
    """

    top: str
    frame: type[Any]
    result: type[Any]
    driver: type[CoreDriver[Any]]
    options: Callable[[Mapping[str, Any]], dict[str, Any]]


CORES: dict[str, SimulatedCore] = {
    "oltae": SimulatedCore(
        "oltae_top", QuantisedFrame, RawResult, OltaeDriver, lambda given: {"config": CoreConfig(**given)}
    ),
    "ivisnav": SimulatedCore("ivisnav_top", QuantisedRows, RawRates, IvisnavDriver, dict),
}
