"""The cases of a report: modules of `cases` and `benchmarks`, and of houses, with a `CASE`, chapter by chapter."""

import statistics
from collections.abc import Sequence
from importlib import import_module
from pkgutil import walk_packages

from validation import benchmarks, cases
from validation.analysis.case import Case, Chapter, Profile
from validation.benchmarks.peers import peers_installed
from validation.engine.street import modules_in
from validation.report.durations import seconds_of


def _cases_in_order() -> list[Case]:
    """In the order of their chapters and of their places there. ValueError for a name or a place that two have."""
    modules = [
        import_module(module.name)
        for room in (cases, benchmarks)
        for module in walk_packages(room.__path__, f"{room.__name__}.")
    ] + list(modules_in("cases"))
    chapters = list(Chapter)
    entries = [module.CASE for module in modules if hasattr(module, "CASE")]
    for what, values in (
        ("name", [case.name for case in entries]),
        ("place", [f"{case.place} of {case.chapter!r}" for case in entries]),
    ):
        if twice := {value for value in values if values.count(value) > 1}:
            raise ValueError(f"a case must have a {what} of its own, got twice: {', '.join(sorted(twice))}")
    return sorted(entries, key=lambda case: (chapters.index(case.chapter), case.place))


_ALL = {case.name: case for case in _cases_in_order()}
CASES = {name: case for name, case in _ALL.items() if not case.timed}
TIMED = {name: case for name, case in _ALL.items() if case.timed}
"""Run alone, last and in this order; their times differ from run to run, and stay out of the results."""


def timed_here() -> list[str]:
    """What is timed and can be here: other solvers only where some are installed."""
    return [name for name in TIMED if name != "race" or peers_installed()]


def expected_seconds(names: Sequence[str], profile: Profile) -> dict[str, float]:
    """Of work of one core, by `durations.toml`; a case that is not there is like their mean."""
    seconds = seconds_of(profile)
    return {name: seconds.get(name, statistics.fmean(seconds.values())) for name in names}
