# SPDX-License-Identifier: Apache-2.0
"""The mutants of one module, from the probe of its tests to the list of survivors."""

from __future__ import annotations

import fcntl
import hashlib
import json
import math
import re
import time
import tomllib
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from mutate import netlist
from mutate.benches import TB, core_tests, first_tests, modules
from mutate.trial import Outcome, attempt, processor, relative, warm
from sim.sources import ROOT, fingerprint

BUILD = ROOT / "build" / "mutate"
_IMPORT = re.compile(r"^from (tb[\w.]*) import (\([^)]*\)|[^\n]*)", re.MULTILINE)
EQUIVALENTS = Path(__file__).parent / "equivalents.toml"
SEED = 1
PROVED = "proved by SAT: no output, next state or input of an instance changes, whatever the state"
SLOWER, GRACE = 5.0, 8.0
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
    """Seconds of the processor that are not a mutant's: netlists, builds, tests with the right netlist."""
    probes: dict[str, float] = field(default_factory=dict)
    """Folder of tests -> seconds of the processor that its probe took."""
    unfit: dict[str, str] = field(default_factory=dict)
    """Tests that don't pass with the right netlist (they reach into the module), with their last words."""
    left: int = 0
    """Mutants that were not begun before the run's end."""

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
    module: str,
    count: int | None,
    *,
    seed: int = SEED,
    deep: bool = True,
    forget: bool = False,
    end: float = math.inf,
) -> Result:
    """Try `count` mutants of a module (None: all). Outcomes of the same sources and tests are kept.

    deep: survivors go on to the same tests on Verilator and then to those of the cores.
    end: time.monotonic() after which no mutant is begun.
    """
    result = Result(module, fingerprint(module))
    folder = BUILD / module
    folder.mkdir(parents=True, exist_ok=True)
    try:
        _run(result, folder, count, seed, deep, forget, end)
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


def probe_seconds(bench: Path) -> float:
    """What the kept probe of a folder of tb/ took, of the processor."""
    known = json.loads((BUILD / "probes" / bench.name / "probe.json").read_text())
    return float(known.get("seconds", 0.0))


def _probe(bench: Path, folder: Path) -> dict[str, Probe]:
    file = folder / "probe.json"

    def signature(names: Iterable[str]) -> str:
        texts = [fingerprint(module) if module in modules() else "none" for module in sorted(set(names))]
        return " ".join([_contents(bench_files(bench)), *texts])

    known: dict[str, Any] = {"signature": "", "used": []}
    start = processor()
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
        known["seconds"] = round(processor() - start, 1)
        file.write_text(json.dumps(known, indent=1) + "\n")
    return {
        test: Probe(seconds, frozenset(netlist.read_probe(line) for line in lines))
        for test, (seconds, lines) in known["tests"].items()
    }


def _words(test: str) -> list[str]:
    """The parts of a test's parameters."""
    return test.rpartition("[")[2].rstrip("]").split("-")


class _Tests:
    """Tests on the stand-ins of one module. Each passes with the right netlist before it is given mutants."""

    def __init__(
        self,
        module: str,
        file: Path,
        single: Sequence[Path],
        uses: Mapping[str, Sequence[netlist.Values]],
        folder: Path,
    ) -> None:
        self.module, self.file, self.single, self.uses, self.folder = module, file, single, uses, folder
        self.seconds: dict[tuple[str, Path], float] = {}
        self.unfit: dict[str, str] = {}
        """Tests that don't pass with the right netlist, with their last words; without any: skipped here."""
        self.before = 0.0
        """Seconds of the processor that the right netlist took."""
        self.tried: Counter[str] = Counter()
        self.killed: Counter[str] = Counter()
        (folder / "right").mkdir(exist_ok=True)

    def order(self, tests: Iterable[str], before: Mapping[str, float]) -> list[str]:
        """Those first that kill most for their time."""
        known = {test: seconds for (test, _), seconds in self.seconds.items()}

        def price(test: str) -> float:
            share = (self.killed[test] + 0.5) / (self.tried[test] + 1)
            return known.get(test, before.get(test, 0.0)) / share

        return sorted(tests, key=price)

    def stand_in(self, test: str, mutant: netlist.Mutant) -> Path | None:
        """The file for a test: that of its only set of parameters, if it passes with it, else that of all.

        None where it passes with neither, or is skipped.
        """
        files = [self.file]
        if list(self.uses.get(sibling(test), ())) == [mutant.values]:
            files.insert(0, self.single[mutant.part])
        for file in files:
            if test in self.unfit:
                continue
            if (test, file) not in self.seconds:
                right = self._attempt(test, file)
                self.before += right.seconds
                if right.state != "passed":
                    if file == files[-1]:
                        skipped = right.state == "none"
                        self.unfit[test] = "" if skipped else f"{right.state} {right.text[-300:]}"
                    continue
                self.seconds[test, file] = right.durations[test]
            return file
        return None

    def _attempt(self, test: str, file: Path, **options: Any) -> Outcome:
        replaced = {self.module: file}
        options = {"right": self.folder / "right", **options}
        return attempt([test], self.folder, replaced, named=file != self.file, **options)

    def judge(self, fate: Fate, mutant: netlist.Mutant, tests: Iterable[str]) -> None:
        """Give a mutant to one test after the other until one kills it."""
        for test in tests:
            file = self.stand_in(test, mutant)
            if file is None:
                continue
            limit = GRACE + SLOWER * self.seconds[test, file]
            for right_results in (self.folder / "right", None):
                outcome = self._attempt(test, file, number=fate.number, limit=limit, right=right_results)
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


def sibling(test: str) -> str:
    """The same test on Icarus, which the probe has run."""
    name, bracket, words = test.rpartition("[")
    words = "-".join("icarus" if word == "verilator" else word for word in words.removesuffix("]").split("-"))
    return f"{name}[{words}]" if bracket else test


def _run(
    result: Result, folder: Path, count: int | None, seed: int, deep: bool, forget: bool, end: float
) -> None:
    if time.monotonic() > end:
        result.left = count or 1
        return
    module = result.module
    benches = first_tests(module)
    probes = {test: probe for bench in benches for test, probe in probe_folder(bench).items()}
    result.probes = {str(bench.relative_to(TB)): probe_seconds(bench) for bench in benches}
    uses = {
        test: [values for name, values in sorted(probe.uses) if name == module]
        for test, probe in probes.items()
    }
    used = list(dict.fromkeys(values for found in uses.values() for values in found))
    if not used:
        raise RuntimeError("no test that runs on Icarus has the module in it")
    start = processor()
    ids = warm([str(bench) for bench in benches], folder / "collect.log")
    file, single, mutants = netlist.make(module, used, count, seed, folder / "netlist")
    tests = _Tests(module, file, single, uses, folder)
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

    spent = 0.0

    @contextmanager
    def timed(fate: Fate) -> Iterator[None]:
        nonlocal spent
        then = processor() - tests.before
        yield
        used = processor() - tests.before - then
        fate.seconds = round(fate.seconds + used, 2)
        spent += used

    for mutant in mutants:
        fate = Fate(mutant.number, mutant.key, mutant.wire, mutant.source, "survived")
        if mutant.key in known:
            fate.state, fate.reason = "equivalent", known[mutant.key]
        elif mutant.key in kept:
            fate = kept[mutant.key]
            fate.number = mutant.number
        elif time.monotonic() > end:
            result.left += 1
            continue
        else:
            having = [test for test in uses if mutant.values in uses[test]]
            with timed(fate):
                tests.judge(fate, mutant, tests.order(having, before))
                if fate.state == "survived" and netlist.proved_equivalent(module, mutant, folder / "netlist"):
                    fate.state, fate.reason = "equivalent", PROVED
            if fate.state == "survived" and set(having) <= set(tests.unfit):
                raise RuntimeError(f"no test passes with the netlist without a mutation: {tests.unfit}")
            keep(fate)
        result.fates.append(fate)
    if deep and _alive(result):
        cores = warm([str(place) for place in core_tests(module)], folder / "collect.log")
        ports = [test for test in cores if "test_ports" in test]
        by_number = {mutant.number: mutant for mutant in mutants}
        for chosen in (ids, ports):
            for fate in _alive(result):
                mutant = by_number[fate.number]
                there = [test for test in chosen if "verilator" in _words(test)]
                # where the probe doesn't know a test's sets of parameters, it may have this one
                having = [test for test in there if mutant.values in uses.get(sibling(test), used)]
                with timed(fate):
                    tests.judge(fate, mutant, having)
        for fate in _alive(result):
            fate.deep = True
        for fate in result.fates:
            if fate.key not in known:
                keep(fate)
    result.before = processor() - start - spent
    result.unfit = {test: words for test, words in tests.unfit.items() if words}


def _alive(result: Result) -> list[Fate]:
    return [fate for fate in result.fates if fate.state == "survived" and not fate.deep]
