# SPDX-License-Identifier: Apache-2.0
"""The mutants of one module, from the probe of its tests to the list of survivors."""

from __future__ import annotations

import fcntl
import hashlib
import json
import re
import tomllib
from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from mutate import netlist
from mutate.benches import TB, core_tests, first_tests, modules
from mutate.trial import attempt, processor, relative, warm
from sim.sources import ROOT, fingerprint

BUILD = ROOT / "build" / "mutate"
_IMPORT = re.compile(r"^from (tb[\w.]*) import (\([^)]*\)|[^\n]*)", re.MULTILINE)
EQUIVALENTS = Path(__file__).parent / "equivalents.toml"
SEED = 1
PROVED = "proved by SAT: no output, next state or input of an instance changes, whatever the state"
SLOWER, GRACE = 5.0, 20.0
"""A simulation may take so many times as long as with the right netlist, and so many seconds more, of the
processor."""


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
    before: float = 0.0
    """Seconds of the processor before the first mutant: netlists, builds, tests with the right netlist."""

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


def bench_files(bench: Path) -> list[Path]:
    """What the tests in a folder of tb/ are made of: its files, and those of tb/ that they import."""
    found: set[Path] = set()
    fresh = [file for file in bench.iterdir() if file.suffix in (".py", ".v")]
    while fresh:
        file = fresh.pop()
        if file in found:
            continue
        found.add(file)
        if file.suffix != ".py":
            continue
        for package, names in _IMPORT.findall(file.read_text()):
            place = TB.parent.joinpath(*package.split("."))
            fresh += [one for one in place.glob("*") if one.suffix == ".v" or one.name == "__init__.py"]
            near = [place.with_suffix(".py"), *((place / f"{name}.py") for name in re.findall(r"\w+", names))]
            fresh += [one for one in near if one.is_file()]
    return sorted(found)


def _contents(files: Iterable[Path]) -> str:
    return hashlib.sha256(b"".join(file.read_bytes() for file in files)).hexdigest()[:12]


@dataclass(frozen=True)
class Probe:
    """What a test does with the modules."""

    seconds: float
    uses: frozenset[tuple[str, netlist.Values]]
    """Module and parameters."""


def probe_folder(bench: Path) -> dict[str, Probe]:
    """The tests of a folder of tb/ that run on Icarus. Kept as long as neither they nor the modules change.

    Raises RuntimeError where one fails.
    """
    folder = BUILD / "probes" / bench.name
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / "lock").open("w") as lock:  # modules that are tried at the same time share benches
        fcntl.flock(lock, fcntl.LOCK_EX)
        return _probe(bench, folder)


def _probe(bench: Path, folder: Path) -> dict[str, Probe]:
    file = folder / "probe.json"

    def signature(names: Iterable[str]) -> str:
        texts = [fingerprint(module) if module in modules() else "none" for module in sorted(set(names))]
        return " ".join([_contents(bench_files(bench)), *texts])

    known: dict[str, Any] = {"signature": "", "used": []}
    if file.is_file():
        known.update(json.loads(file.read_text()))
    if known["signature"] != signature(known["used"]):
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
        found = {test: (seen.durations[test], sorted(set(lines))) for test, lines in seen.reports.items()}
        used = sorted({line.split()[0] for _, lines in found.values() for line in lines})
        known = {"signature": signature(used), "used": used, "tests": found}
        file.write_text(json.dumps(known, indent=1) + "\n")
    return {
        test: Probe(seconds, frozenset(netlist.read_probe(line) for line in lines))
        for test, (seconds, lines) in known["tests"].items()
    }


def _words(test: str) -> list[str]:
    """The parts of a test's parameters."""
    return test.rpartition("[")[2].rstrip("]").split("-")


class _Tests:
    """Tests on the stand-in of one module. Each passes with the right netlist before it is given mutants."""

    def __init__(self, module: str, file: Path, folder: Path) -> None:
        self.replaced = {module: file}
        self.folder = folder
        self.seconds: dict[str, float] = {}
        self.before: list[float] = []
        self.tried: Counter[str] = Counter()
        self.killed: Counter[str] = Counter()
        (folder / "right").mkdir(exist_ok=True)

    def order(self, tests: Iterable[str], before: Mapping[str, float]) -> list[str]:
        """Those first that kill most for their time."""

        def price(test: str) -> float:
            share = (self.killed[test] + 0.5) / (self.tried[test] + 1)
            return self.seconds.get(test, before.get(test, 0.0)) / share

        return sorted(tests, key=price)

    def judge(self, fate: Fate, tests: Iterable[str]) -> None:
        """Give a mutant to one test after the other until one kills it."""
        for test in tests:
            if test not in self.seconds:
                right = attempt([test], self.folder, self.replaced, right=self.folder / "right")
                if right.state != "passed":
                    raise RuntimeError(
                        f"the netlist without a mutation: {right.state} {right.test} {right.text[-300:]}"
                    )
                self.seconds[test] = right.durations[test]
                self.before.append(right.seconds)
            limit = GRACE + SLOWER * self.seconds[test]
            for right_results in (self.folder / "right", None):
                outcome = attempt(
                    [test], self.folder, self.replaced, number=fate.number, limit=limit, right=right_results
                )
                fate.seconds = round(fate.seconds + outcome.seconds, 2)
                if outcome.state != "passed" or not outcome.short:
                    break
            if outcome.state == "busy":
                raise RuntimeError(f"the machine is too busy: {test} has not ended, nor used {limit:.0f} s")
            self.tried[test] += 1
            if outcome.state != "passed":
                fate.state = {"failed": "killed", "timeout": "timeout"}.get(outcome.state, "invalid")
                fate.by = relative(outcome.test or test)
                self.killed[test] += 1
                return


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

    start = processor()
    file, mutants = netlist.make(module, used, count, seed, folder / "netlist")
    result.before = processor() - start
    tests = _Tests(module, file, folder)
    before = {test: probe.seconds for test, probe in probes.items()}
    known = equivalents(module)
    memory = folder / "known.jsonl"
    used_files = {one for bench in benches for one in bench_files(bench)}
    signature = f"{fingerprint(module)} {_contents(sorted(used_files))}"
    kept: dict[str, Fate] = {}
    if memory.is_file() and not forget:
        for line in memory.read_text().splitlines():
            entry = json.loads(line)
            if entry.pop("signature") == signature:
                kept[entry["key"]] = Fate(**entry)

    def keep(fate: Fate) -> None:
        with memory.open("a") as out:  # of two lines about a mutant the last counts
            out.write(json.dumps({**asdict(fate), "signature": signature}) + "\n")

    for mutant in mutants:
        fate = Fate(mutant.number, mutant.key, mutant.wire, mutant.source, "survived")
        if mutant.key in known:
            fate.state, fate.reason = "equivalent", known[mutant.key]
        elif mutant.key in kept:
            fate = kept[mutant.key]
            fate.number = mutant.number
        else:
            tests.judge(fate, tests.order((test for test in uses if mutant.values in uses[test]), before))
            if fate.state == "survived" and netlist.proved_equivalent(module, mutant, folder / "netlist"):
                fate.state, fate.reason = "equivalent", PROVED
            keep(fate)
        result.fates.append(fate)
    result.before += sum(tests.before)
    if deep and _alive(result):
        cores = warm([str(place) for place in core_tests(module)], folder / "collect.log")
        ports = [test for test in cores if "test_ports" in test]
        for chosen in (ids, ports):
            for fate in _alive(result):
                tests.judge(fate, [test for test in chosen if "verilator" in _words(test)])
        for fate in _alive(result):
            fate.deep = True
        for fate in result.fates:
            keep(fate)


def _alive(result: Result) -> list[Fate]:
    return [fate for fate in result.fates if fate.state == "survived" and not fate.deep]
