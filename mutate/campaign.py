# SPDX-License-Identifier: Apache-2.0
"""The mutants of one module, from the probe of its tests to the list of survivors."""

from __future__ import annotations

import hashlib
import json
import re
import tomllib
from collections.abc import Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from mutate import netlist
from mutate.benches import core_tests, first_tests, modules
from mutate.trial import Outcome, attempt, relative, warm
from sim.sources import ROOT, RTL

BUILD = ROOT / "build" / "mutate"
EQUIVALENTS = Path(__file__).parent / "equivalents.toml"
SEED = 1
PROVED = "proved by SAT: no output, next state or input of an instance changes, whatever the state"
SLOWER, GRACE = 5.0, 20.0
"""A simulation may take so many times as long as with the right netlist, and so many seconds more."""


@dataclass
class Fate:
    """A mutant and what became of it."""

    number: int
    key: str
    wire: str
    source: str
    state: str
    """killed, timeout (killed by hanging), survived, equivalent, invalid."""
    by: str = ""
    """The test that killed it."""
    reason: str = ""
    """Why it is equivalent."""
    seconds: float = 0.0
    deep: bool = False
    """Whether a survivor has been given to Verilator and the cores too."""


@dataclass
class Result:
    """A module's row."""

    module: str
    source: str
    """Of the module's text; what equivalents.toml is checked against."""
    fates: list[Fate] = field(default_factory=list)
    error: str = ""
    seconds: float = 0.0

    def count(self, *states: str) -> int:
        """How many mutants ended so."""
        return sum(fate.state in states for fate in self.fates)

    @property
    def judged(self) -> int:
        """Mutants that can be killed, as far as known."""
        return self.count("killed", "timeout", "survived")

    @property
    def percent(self) -> float:
        """Killed of those that can be."""
        return 100 * self.count("killed", "timeout") / self.judged if self.judged else 100.0


def fingerprint(module: str) -> str:
    """Of a module's text without comments and blanks."""
    text = re.sub(r"//[^\n]*|/\*.*?\*/", "", netlist.module_file(module).read_text(), flags=re.DOTALL)
    lines = [" ".join(line.split()) for line in text.splitlines()]
    return hashlib.sha256("\n".join(lines).encode()).hexdigest()[:12]


def equivalents(module: str) -> dict[str, str]:
    """Mutants of the module's present text that are known to be equivalent, with the reason.

    Raises SystemExit for an entry without a reason.
    """
    listed: dict[str, Any] = tomllib.loads(EQUIVALENTS.read_text()).get(module, {})
    found = {}
    for entry in listed.get("mutants", []) if listed.get("source") == fingerprint(module) else []:
        if not str(entry.get("reason", "")).strip():
            raise SystemExit(f"mutate: {EQUIVALENTS.name}: {module}: {entry.get('key')} has no reason")
        found[str(entry["key"])] = str(entry["reason"])
    return found


def run_module(
    module: str, count: int | None, *, seed: int = SEED, deep: bool = True, forget: bool = False
) -> Result:
    """Try `count` mutants of a module (None: all). Outcomes of the same sources and tests are kept.

    deep: survivors go on to the same tests on Verilator and then to those of the cores.
    """
    result = Result(module, fingerprint(module))
    folder = BUILD / module
    folder.mkdir(parents=True, exist_ok=True)
    try:
        _run(result, folder, count, seed, deep, forget)
    except (RuntimeError, ValueError, LookupError, OSError) as error:
        result.error = f"{type(error).__name__}: {error}"[:500]
    (folder / "result.json").write_text(json.dumps(asdict(result), indent=1) + "\n")
    return result


def _contents(folders: Sequence[Path]) -> str:
    """Of the files in some folders."""
    found = sorted(
        file for folder in folders for file in folder.rglob("*") if file.suffix in (".py", ".v", ".vh")
    )
    return hashlib.sha256(b"".join(file.read_bytes() for file in found)).hexdigest()[:12]


@dataclass(frozen=True)
class Probe:
    """What a test does with the modules."""

    seconds: float
    uses: frozenset[tuple[str, netlist.Values]]
    """Module and parameters."""


def probe_folder(bench: Path) -> dict[str, Probe]:
    """The tests of a folder of tb/ that run on Icarus. Kept as long as neither they nor rtl/ change.

    Raises RuntimeError where one fails.
    """
    folder = BUILD / "probes" / bench.name
    folder.mkdir(parents=True, exist_ok=True)
    signature = _contents([bench, ROOT / "tb" / "common", RTL])
    file = folder / "probe.json"
    if not file.is_file() or json.loads(file.read_text())["signature"] != signature:
        report = folder / "report.txt"
        copies = {module: folder / "rtl" / f"{module}.v" for module in modules()}
        (folder / "rtl").mkdir(exist_ok=True)
        for module, copy in copies.items():
            netlist.write_probe(module, copy, report)
        ids = warm([str(bench)], folder / "collect.log")
        quick = [test for test in ids if "icarus" in _words(test)]
        if not quick:
            raise RuntimeError(f"no test of {bench.name} runs on Icarus")
        seen = attempt(quick, folder, copies, report=report, limit=1800.0)
        if seen.state != "passed":
            raise RuntimeError(f"{seen.test} {seen.state} without a mutant: {seen.text[-300:]}")
        found = {test: [seen.durations[test], sorted(set(lines))] for test, lines in seen.reports.items()}
        file.write_text(json.dumps({"signature": signature, "tests": found}, indent=1) + "\n")
    listed: dict[str, Any] = json.loads(file.read_text())["tests"]
    return {
        test: Probe(seconds, frozenset(netlist.read_probe(line) for line in lines))
        for test, (seconds, lines) in listed.items()
    }


def _words(test: str) -> list[str]:
    """The parts of a test's parameters."""
    return test.rpartition("[")[2].rstrip("]").split("-")


def _run(result: Result, folder: Path, count: int | None, seed: int, deep: bool, forget: bool) -> None:
    module = result.module
    benches = first_tests(module)
    probes = {test: probe for bench in benches for test, probe in probe_folder(bench).items()}
    uses = {
        test: [values for name, values in sorted(probe.uses) if name == module]
        for test, probe in probes.items()
    }
    used = list(dict.fromkeys(values for found in uses.values() for values in found))
    if not used:
        raise RuntimeError("no test that runs on Icarus has the module in it")
    ids = warm([str(bench) for bench in benches], folder / "collect.log")

    file, mutants = netlist.make(module, used, count, seed, folder / "netlist")
    order = sorted(uses, key=lambda test: probes[test].seconds)
    known = equivalents(module)
    memory = folder / "known.jsonl"
    signature = fingerprint(module) + _contents([*benches, ROOT / "tb" / "common", Path(__file__).parent])
    kept: dict[str, Fate] = {}
    if memory.is_file() and not forget:
        for line in memory.read_text().splitlines():
            entry = json.loads(line)
            if entry.pop("signature") == signature:
                kept[entry["key"]] = Fate(**entry)

    def keep(fate: Fate) -> None:
        with memory.open("a") as out:  # of two lines about a mutant the last counts
            out.write(json.dumps({**asdict(fate), "signature": signature}) + "\n")

    sound: set[str] = set()  # tests that pass with the netlist as it should be
    for mutant in mutants:
        fate = Fate(mutant.number, mutant.key, mutant.wire, mutant.source, "survived")
        if mutant.key in known:
            fate.state, fate.reason = "equivalent", known[mutant.key]
        elif mutant.key in kept:
            fate = kept[mutant.key]
            fate.number = mutant.number
        else:
            concerned = [test for test in order if mutant.values in uses[test]]
            times = [probes[test].seconds for test in concerned]
            limit, whole = GRACE + SLOWER * max(times), GRACE + SLOWER * sum(times)
            outcome = attempt(
                concerned, folder, {module: file}, number=mutant.number, limit=limit, whole=whole
            )
            if outcome.test and outcome.test not in sound:
                right = attempt([outcome.test], folder, {module: file}, limit=limit)
                if right.state != "passed":
                    raise RuntimeError(
                        f"the netlist without a mutation: {right.state} {right.test} {right.text[-300:]}"
                    )
            sound |= {outcome.test, *outcome.durations}
            _judge(fate, outcome)
            if fate.state == "survived" and netlist.proved_equivalent(module, mutant, folder / "netlist"):
                fate.state, fate.reason = "equivalent", PROVED
            keep(fate)
        result.fates.append(fate)
        result.seconds += fate.seconds
    if deep:
        _second_chance(
            result, folder, file, [test for test in ids if "verilator" in _words(test)], "verilator"
        )
        if _alive(result):
            cores = warm([str(place) for place in core_tests(module)], folder / "collect.log")
            ports = [test for test in cores if "verilator" in _words(test) and "test_ports" in test]
            _second_chance(result, folder, file, ports, "core")
        for fate in result.fates:
            if fate.state == "survived" or fate.deep:
                fate.deep = True
                keep(fate)


def _alive(result: Result) -> list[Fate]:
    return [fate for fate in result.fates if fate.state == "survived" and not fate.deep]


def _second_chance(result: Result, folder: Path, file: Path, chosen: Sequence[str], stage: str) -> None:
    """Give survivors to further tests, one build for all of them."""
    if not _alive(result) or not chosen:
        return
    right = attempt(chosen, folder, {result.module: file})
    if right.state != "passed":
        result.error = f"{stage}: without a mutation: {right.state} {right.test} {right.text[-300:]}"
        return
    order = sorted(chosen, key=lambda test: right.durations.get(test, 0.0))
    for fate in _alive(result):
        limit = GRACE + SLOWER * max(right.durations.values())
        whole = GRACE + SLOWER * sum(right.durations.values())
        _judge(
            fate, attempt(order, folder, {result.module: file}, number=fate.number, limit=limit, whole=whole)
        )


def _judge(fate: Fate, outcome: Outcome) -> None:
    states = {
        "passed": "survived",
        "failed": "killed",
        "timeout": "timeout",
        "invalid": "invalid",
        "none": "invalid",
    }
    fate.state = states[outcome.state]
    fate.by = relative(outcome.test)
    fate.seconds = round(fate.seconds + outcome.seconds, 2)
