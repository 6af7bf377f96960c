"""Mutation testing: one small change at a time, and whether a test notices. `make mutation`.

Needs what `make coverage` and `make verdicts` have left behind: which test has executed which line, and how long each
takes. A mutant is met by the tests that have executed its lines, quickest first, until one fails or the time for it is
over. Each is run in a process forked from this one, in which libraries are loaded and the project is not, on a copy of
the project.
"""

import argparse
import ctypes
import importlib
import json
import multiprocessing
import os
import random
import re
import resource
import shutil
import signal
import sys
import tempfile
import tomllib
from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from xml.etree import ElementTree

import coverage
import pytest

from tests.mutation.mutants import Mutant, mutants_of, mutated
from tests.mutation.report import Outcome, Survey, Trial, table

ROOT = Path(__file__).parents[2]
PROJECT = ("mdr", "bem3d", "validation", "tests")
BESIDE = ("pyproject.toml", "reports/README.md", "reports/docs/own_data.md")
"""What the tests of rooms read beside it."""
KILLERS = ROOT / ".mutation-killers.json"
"""Who has killed which mutant before: it is asked first the next time."""
REASONS = ROOT / "tests" / "mutation" / "survivors.toml"
MEMORY = 8 * 2**30
"""Of a mutant, in bytes of address space."""
SETTINGS = {"HYPOTHESIS_PROFILE": "mutation", "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1", "OPENBLAS_NUM_THREADS": "1"}
QUIET = ("-qq", "-x", "--tb=no", "-p", "no:cacheprovider")


@dataclass(frozen=True)
class Field:
    """What is surveyed: files, what `make` has recorded of the tests that look at them, and the table of it."""

    targets: tuple[str, ...]
    command: str
    data: Path
    times: Path
    table: Path

    def paths(self) -> list[str]:
        """Of its files, from the root."""
        return sorted(str(path.relative_to(ROOT)) for pattern in self.targets for path in ROOT.glob(pattern))


VERDICTS = (
    "validation/analysis/series.py",
    "validation/analysis/over_range.py",
    "validation/analysis/claims.py",
    "validation/analysis/study.py",
    "validation/analysis/margins.py",
    "validation/simulation/limit_sweeps.py",
    "validation/simulation/probing.py",
    "validation/analysis/statistics.py",
    "validation/analysis/evidence.py",
    "validation/analysis/spectra.py",
    "validation/analysis/spectral_features.py",
    "validation/benchmarks/work_precision/errors.py",
    "validation/benchmarks/work_precision/pareto.py",
    "validation/selection/hierarchy.py",
    "validation/engine/engine.py",
)
CLAIMS = {
    "answers": "validation/report/answers/*.py",
    "calibration": "validation/simulation/calibrat*.py",
    "contact_force": "validation/selection/contact_force.py",
    "exported": "validation/selection/exported.py",
    "graduation": "validation/analysis/graduation.py",
    "isotropic_line": "validation/scenes/isotropic_line.py",
    "multilevel": "validation/analysis/multilevel.py",
    "rail": "validation/simulation/rail_*.py",
    "sound": "validation/analysis/sound.py",
}
"""What claims rest on: grids of Fig. 14.1, calibrated errors, rails, and what is printed of all of them."""


def looked_at_by_guards(targets: tuple[str, ...], table: str) -> Field:
    """Files that the tests of `make verdicts` look at."""
    data, times = ROOT / ".coverage-verdicts", ROOT / ".coverage-verdicts-times.xml"
    return Field(targets, "verdicts", data, times, ROOT / "tests" / "mutation" / table)


FIELDS = {
    "methods": Field(
        ("mdr/*.py", "bem3d/*.py", "validation/theory/closed_forms.py"),
        "coverage",
        ROOT / ".coverage",
        ROOT / ".coverage-times.xml",
        ROOT / "tests" / "mutation" / "MUTATIONS.md",
    ),
    "verdicts": looked_at_by_guards(VERDICTS, "MUTATIONS_OF_VERDICTS.md"),
    "claims": looked_at_by_guards(tuple(CLAIMS.values()), "MUTATIONS_OF_CLAIMS.md"),
    **{name: looked_at_by_guards((files,), f"MUTATIONS_OF_{name.upper()}.md") for name, files in CLAIMS.items()},
}


@dataclass(frozen=True)
class Suite:
    """The tests as `make` has seen them: seconds of each by itself, and which have executed a line of a file."""

    seconds: dict[str, float]
    executed: dict[str, dict[int, set[str]]]

    @classmethod
    def recorded(cls, of: Field) -> "Suite":
        """From the files in the root."""
        data = coverage.CoverageData(str(of.data))
        data.read()
        if not of.times.exists() or not data.measured_files():
            raise SystemExit(f"there is no record of the tests: run make {of.command}")
        executed = {
            str(Path(file).resolve().relative_to(ROOT)): {
                line: {context.rpartition("|")[0] for context in contexts if context}
                for line, contexts in data.contexts_by_lineno(file).items()
            }
            for file in data.measured_files()
        }
        cases = ElementTree.parse(of.times).iter("testcase")
        return cls({_node(case): _seconds(case) for case in cases}, executed)

    def tests_of(self, mutant: Mutant, sources: dict[str, str]) -> set[str]:
        """Those that have executed its lines; else those that have executed any line which names the constant that it
        changes, or stand in a file that does; else those that have executed any line of its file."""
        found = self._on(mutant.path, mutant.lines)
        if not found and mutant.name:
            found = set().union(*(self._on(path, _naming(mutant.name, text)) for path, text in sources.items()))
            found |= {test for test in self.seconds if _naming(mutant.name, _source(test.partition("::")[0]))}
        return found or self._on(mutant.path, self.executed.get(mutant.path, ()))

    def _on(self, path: str, lines: Iterable[int]) -> set[str]:
        known = self.executed.get(path, {})
        return {test for line in lines for test in known.get(line, ()) if test in self.seconds}

    def quickest(self, tests: set[str], first: str | None, most: float) -> list[str]:
        """By their seconds, which add up to `most` or little more; first the one that has killed before."""
        chosen, total = [first] if first in tests else [], 0.0
        for test in sorted(tests - {first}, key=lambda test: (self.seconds[test], test)):
            if total >= most:
                break
            chosen.append(test)
            total += self.seconds[test]
        return chosen


def _node(case: ElementTree.Element) -> str:
    return f"{case.get('classname').replace('.', '/')}.py::{case.get('name')}"


@cache
def _source(path: str) -> str:
    """Of a file of tests, from the root."""
    return (ROOT / path).read_text()


def _seconds(case: ElementTree.Element) -> float:
    """Of a test by itself: with all the fixtures that it shares with others, see `fixture_times`."""
    shared = sum(float(p.get("value")) for p in case.iter("property") if p.get("name") == "fixtures")
    return max(float(case.get("time", 0)), shared)


def _naming(name: str, source: str) -> list[int]:
    """Lines in which a name stands."""
    return [i for i, line in enumerate(source.splitlines(), 1) if re.search(rf"\b{name}\b", line)]


class Bench:
    """A copy of the project, in which tests are run on one mutant after another."""

    def __init__(self, suite: Suite, folder: Path):
        self.suite, self.folder = suite, folder
        for name in PROJECT:
            shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("__pycache__"))
        for file in BESIDE:
            (folder / file).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / file, folder / file)
        self._fork = multiprocessing.get_context("fork")
        self._running = self._fork.RawArray(ctypes.c_char, 1000)

    def load_libraries(self, tests: set[str]) -> None:
        """Import what the tests import, and forget what of it is the project's own."""
        os.environ.update(SETTINGS)
        for file in {test.partition("::")[0] for test in tests}:
            importlib.import_module(file.removesuffix(".py").replace("/", "."))
        for name in [name for name in sys.modules if name.partition(".")[0] in PROJECT]:
            del sys.modules[name]

    def trial(self, mutant: Mutant, source: str, tests: list[str]) -> Trial:
        """What becomes of a mutant."""
        if not tests:
            return Trial(mutant, Outcome.SURVIVED)
        (self.folder / mutant.path).write_text(mutated(mutant, source))
        try:
            outcome, last = self.run(tests)
        finally:
            # with its time of change, by which Python knows what it has compiled before
            shutil.copy2(ROOT / mutant.path, self.folder / mutant.path)
        return Trial(mutant, outcome, "" if outcome is Outcome.SURVIVED else last)

    def run(self, tests: list[str], *, unchanged: bool = False) -> tuple[Outcome, str]:
        """Tests in this order, until one fails; and which was the last to run. Unchanged, all of them must be there."""
        self._running.value = b""
        process = self._fork.Process(target=self._child, args=(tests, unchanged))
        process.start()
        process.join()
        last = self._running.value.decode()
        if process.exitcode in (0, pytest.ExitCode.NO_TESTS_COLLECTED):
            return Outcome.SURVIVED, last
        return (Outcome.TIMED_OUT if process.exitcode == -signal.SIGALRM else Outcome.KILLED), last

    def _child(self, tests: list[str], unchanged: bool) -> None:
        resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
        sys.dont_write_bytecode = not unchanged
        nothing = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nothing, 1)
        os.dup2(nothing, 2)
        os.chdir(self.folder)
        sys.path.insert(0, str(self.folder))
        # nothing but the tests may take long, either
        signal.setitimer(signal.ITIMER_REAL, 60)
        files = sorted({test.partition("::")[0] for test in tests})
        chosen = Chosen(tests, self.suite.seconds, self._running)
        code = pytest.main([*QUIET, *files], plugins=[chosen])
        os._exit(pytest.ExitCode.USAGE_ERROR if unchanged and chosen.missing else code)


class Chosen:
    """A plugin that runs some tests alone, in their order, and gives each ten times the time it has taken before."""

    def __init__(self, tests: list[str], seconds: dict[str, float], running: ctypes.Array):
        self._rank = {test: i for i, test in enumerate(tests)}
        self._seconds, self._running = seconds, running
        self.missing = len(tests)

    @pytest.hookimpl(trylast=True)
    def pytest_collection_modifyitems(self, items: list[pytest.Item]) -> None:
        items[:] = sorted((i for i in items if i.nodeid in self._rank), key=lambda item: self._rank[item.nodeid])
        self.missing = len(self._rank) - len(items)

    def pytest_runtest_logstart(self, nodeid: str) -> None:
        self._running.value = nodeid.encode()[:999]
        signal.setitimer(signal.ITIMER_REAL, 10 + 10 * self._seconds[nodeid])


def main(arguments: list[str]) -> None:
    """Plant mutants, all or a sample of them, and write what has become of each."""
    asked = parsed(arguments)
    of = FIELDS[asked.of]
    suite, before = Suite.recorded(of), json.loads(KILLERS.read_text()) if KILLERS.exists() else {}
    paths = of.paths()
    sources = {path: (ROOT / path).read_text() for path in paths}
    everything = [mutant for path in paths for mutant in mutants_of(path, sources[path])]
    chosen = [mutant for mutant in everything if not asked.only or mutant.path in asked.only]
    if asked.sample is not None and asked.sample < len(chosen):
        chosen = sorted(random.Random(asked.seed).sample(chosen, asked.sample), key=lambda m: (m.path, m.number))
    tests = {m: suite.quickest(suite.tests_of(m, sources), before.get(_name(m)), asked.seconds) for m in chosen}
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(suite, Path(folder))
        union = {test for some in tests.values() for test in some}
        bench.load_libraries(union)
        print(f"{len(union)} tests on the unchanged project", flush=True)
        outcome, last = bench.run(suite.quickest(union, None, float("inf")), unchanged=True)
        if outcome is not Outcome.SURVIVED:
            raise SystemExit(f"a test fails on the unchanged project, or is not there: the last was {last}")
        trials = []
        for i, mutant in enumerate(chosen):
            trials.append(bench.trial(mutant, sources[mutant.path], tests[mutant]))
            print(f"{i + 1}/{len(chosen)} {trials[-1].outcome}: {mutant.path}: {mutant.key}", flush=True)
            if trials[-1].killer:
                before[_name(mutant)] = trials[-1].killer
                KILLERS.write_text(json.dumps(before, indent=0))
    counts = Counter(mutant.path for mutant in everything)
    survey = Survey(trials, counts, asked.seed if len(chosen) < len(everything) else None, asked.seconds)
    text = table(survey, tomllib.loads(REASONS.read_text()))
    if not asked.only:
        of.table.write_text(text)
    print(text)


def _name(mutant: Mutant) -> str:
    return f"{mutant.path}: {mutant.key}"


def parsed(arguments: list[str]) -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(prog="python -m tests.mutation.runner", description=__doc__)
    parser.add_argument("--of", choices=list(FIELDS), default="methods", help="what is surveyed (default: methods)")
    parser.add_argument("--sample", type=int, help="so many mutants, drawn at random; all where it is not given")
    parser.add_argument("--seed", type=int, default=0, help="of the sample")
    parser.add_argument("--seconds", type=float, default=60.0, help="of tests that a mutant is met by, as recorded")
    parser.add_argument("--only", nargs="+", metavar="PATH", help="mutants of these files; writes no table")
    return parser.parse_args(arguments)


if __name__ == "__main__":
    main(sys.argv[1:])
