"""Mutation testing: one small change at a time, and whether a test notices. `make mutation`.

Needs what `make coverage` and `make verdicts` have left behind: which test has executed which line, and how long each
takes. A mutant is met by the tests that have executed its lines, quickest first, until one fails or the time for it is
over, in a process of its own on a copy of the project.
"""

import argparse
import math
import os
import random
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import tomllib
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from itertools import accumulate
from pathlib import Path
from xml.etree import ElementTree

import coverage

from tests.mutation.mutants import Mutant, mutants_of, mutated
from tests.mutation.report import Outcome, Survey, table

ROOT = Path(__file__).parents[2]
HERE = ROOT / "tests" / "mutation"
COPIED = ("mdr", "bem3d", "validation", "tests", "reports", "pyproject.toml", "README.md", "ARCHITECTURE.md")
MEMORY = 8 * 2**30
"""Of the tests of a mutant, in bytes of address space."""
SETTINGS = {"HYPOTHESIS_PROFILE": "mutation", "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1", "OPENBLAS_NUM_THREADS": "1"}
QUIET = ("-qq", "-x", "--tb=no", "-p", "no:cacheprovider")
METHODS = ("mdr/*.py", "bem3d/*.py", "validation/theory/closed_forms.py")
VERDICTS = (
    *("validation/analysis/series.py", "validation/analysis/claims.py", "validation/analysis/case.py"),
    *("validation/analysis/ranges.py", "validation/analysis/claim_text.py", "validation/analysis/number_text.py"),
    *("validation/analysis/statistics.py", "validation/analysis/evidence.py", "validation/analysis/spectra.py"),
    *("validation/simulation/limits.py", "validation/engine/engine.py"),
    *("validation/benchmarks/work_precision/pareto.py", "validation/benchmarks/work_precision/pareto.py"),
    "validation/advice/hierarchy.py",
)
CLAIMS = (
    *("validation/report/answers/*.py", "validation/advice/calibrat*.py", "validation/advice/sound_power.py"),
    *("validation/advice/exported.py", "validation/advice/table.py"),
    *("validation/railway/scenes/isotropic_line.py", "validation/analysis/spectra.py"),
    *("validation/analysis/statistics.py", "validation/railway/problems/rail_*.py"),
)
"""What claims rest on: grids of Fig. 14.1, calibrated errors, rails, and what is printed of all of them."""
FIELDS = {"methods": METHODS, "verdicts": VERDICTS, "claims": CLAIMS}
"""What is surveyed."""


@dataclass(frozen=True)
class Suite:
    """The tests as `make` has seen them: seconds of each by itself, and which have executed a line of a file."""

    seconds: dict[str, float]
    executed: dict[str, dict[int, set[str]]]

    @classmethod
    def recorded(cls, command: str) -> "Suite":
        """From the files that `make coverage` or `make verdicts` leaves in the root."""
        name = ".coverage" if command == "coverage" else ".coverage-verdicts"
        data, times = coverage.CoverageData(str(ROOT / name)), ROOT / f"{name}-times.xml"
        data.read()
        if not times.exists() or not data.measured_files():
            raise SystemExit(f"there is no record of the tests: run make {command}")
        executed = {
            str(Path(file).resolve().relative_to(ROOT)): {
                line: {context.rpartition("|")[0] for context in contexts if context}
                for line, contexts in data.contexts_by_lineno(file).items()
            }
            for file in data.measured_files()
        }
        return cls(dict(map(_timed, ElementTree.parse(times).iter("testcase"))), executed)

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

    def quickest(self, tests: set[str], most: float = math.inf) -> list[str]:
        """By their seconds, which add up to `most` or little more."""
        chosen = sorted(tests, key=lambda test: (self.seconds[test], test))
        before = accumulate((self.seconds[test] for test in chosen), initial=0.0)
        return [test for test, total in zip(chosen, before, strict=False) if total < most]

    def run(self, tests: list[str], folder: Path) -> Outcome:
        """Tests in this order on a copy of the project, until one fails."""
        command = [sys.executable, "-m", "pytest", *QUIET, *tests]
        longest = 60 + 3 * sum(self.seconds[test] for test in tests)
        try:
            done = subprocess.run(
                command,
                cwd=folder,
                env=os.environ | SETTINGS,
                timeout=longest,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY)),
            )
        except subprocess.TimeoutExpired:
            return Outcome.TIMED_OUT
        return Outcome.KILLED if done.returncode else Outcome.SURVIVED


def _timed(case: ElementTree.Element) -> tuple[str, float]:
    """A test and its seconds by itself: with all the fixtures that it shares with others, see `fixture_times`."""
    shared = sum(float(p.get("value")) for p in case.iter("property") if p.get("name") == "fixtures")
    node = f"{case.get('classname').replace('.', '/')}.py::{case.get('name')}"
    return node, max(float(case.get("time", 0)), shared)


@cache
def _source(path: str) -> str:
    return (ROOT / path).read_text(encoding="utf-8")


def _naming(name: str, source: str) -> list[int]:
    """Lines in which a name stands."""
    return [i for i, line in enumerate(source.splitlines(), 1) if re.search(rf"\b{name}\b", line)]


def copy_of_the_project(folder: Path) -> None:
    """Beside the packages, what the tests of rooms read."""
    for name in COPIED:
        if (ROOT / name).is_dir():
            skipped = shutil.ignore_patterns("__pycache__", "reference", "full", "quick", "_build")
            shutil.copytree(ROOT / name, folder / name, ignore=skipped)
        else:
            shutil.copy2(ROOT / name, folder / name)


def main(arguments: list[str]) -> None:
    """Plant mutants, all or a sample of them, and write what has become of each."""
    asked = parsed(arguments)
    suite = Suite.recorded("coverage" if asked.of == "methods" else "verdicts")
    paths = sorted({str(path.relative_to(ROOT)) for pattern in FIELDS[asked.of] for path in ROOT.glob(pattern)})
    sources = {path: _source(path) for path in paths}
    everything = [mutant for path in paths for mutant in mutants_of(path, sources[path])]
    chosen = [mutant for mutant in everything if not asked.only or mutant.path in asked.only]
    if asked.sample is not None and asked.sample < len(chosen):
        chosen = sorted(random.Random(asked.seed).sample(chosen, asked.sample), key=lambda m: (m.path, m.number))
    tests = {mutant: suite.quickest(suite.tests_of(mutant, sources), asked.seconds) for mutant in chosen}
    trials = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        copy_of_the_project(folder)
        union = suite.quickest({test for some in tests.values() for test in some})
        print(f"{len(union)} tests on the unchanged project", flush=True)
        if suite.run(union, folder) is not Outcome.SURVIVED:
            raise SystemExit("a test fails on the unchanged project, or is not there")
        for i, mutant in enumerate(chosen, 1):
            (folder / mutant.path).write_text(mutated(mutant, sources[mutant.path]), encoding="utf-8")
            outcome = suite.run(tests[mutant], folder) if tests[mutant] else Outcome.SURVIVED
            (folder / mutant.path).write_text(sources[mutant.path], encoding="utf-8")
            trials.append((mutant, outcome))
            print(f"{i}/{len(chosen)} {outcome}: {mutant.path}: {mutant.key}", flush=True)
    seed = asked.seed if len(chosen) < len(everything) else None
    text = table(
        Survey(trials, everything, seed, asked.seconds), tomllib.loads(_source("tests/mutation/survivors.toml"))
    )
    if not asked.only:
        (HERE / f"MUTATIONS{'' if asked.of == 'methods' else f'_OF_{asked.of.upper()}'}.md").write_text(
            text, encoding="utf-8"
        )
    print(text)


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
