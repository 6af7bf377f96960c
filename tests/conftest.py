import ast
import functools
import os
import random
from itertools import groupby
from pathlib import Path

import pytest
from hypothesis import HealthCheck, Phase, settings

settings.register_profile(
    "default", deadline=None, derandomize=True, max_examples=40, suppress_health_check=[HealthCheck.too_slow]
)
settings.register_profile("thorough", deadline=None, max_examples=2000, suppress_health_check=[HealthCheck.too_slow])
# few and always the same, and none smaller once one has failed: see mutation/runner.py
settings.register_profile(
    "mutation",
    settings.get_profile("default"),
    max_examples=20,
    phases=[Phase.explicit, Phase.generate],
    database=None,
    report_multiple_bugs=False,
)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "default"))


BESIDE_A_TEST = {
    *("concurrent", "multiprocessing", "signal", "socket", "threading", "time"),
    *("bem3d.threads", "tests.engine.jobs", "tests.engine.toys", "validation.benchmarks.timing"),
    *("validation.judging.worker.Visitor", "validation.engine.workers"),
}
"""Modules and names by which a file of tests has threads, clocks, signals, or processes that run beside a test."""


@functools.cache
def is_concurrent(path):
    """Whether a file of tests imports one of them."""
    names = set()
    for node in ast.walk(ast.parse(path.read_bytes())):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            names |= {f"{node.module}.{alias.name}" for alias in node.names}
    return any(f"{name}.".startswith(f"{beside}.") for name in names for beside in BESIDE_A_TEST)


def pytest_addoption(parser):
    parser.addoption(
        "--shuffled", type=int, metavar="SEED", help="files of tests, and tests in a file, in another order"
    )


def pytest_collection_modifyitems(config, items):
    for item in items:
        if is_concurrent(item.path):
            item.add_marker("concurrent")
    seed = config.getoption("--shuffled")
    if seed is not None:
        # a file in one go, whose tests share what takes long
        files = [list(tests) for _, tests in groupby(items, key=lambda item: item.path)]
        order = random.Random(seed)
        order.shuffle(files)
        for tests in files:
            order.shuffle(tests)
        items[:] = [item for tests in files for item in tests]


def pytest_terminal_summary(terminalreporter, config):
    if config.getoption("--shuffled") is not None:
        terminalreporter.write_line(f"this order again: --shuffled {config.getoption('--shuffled')}")


def pytest_configure(config):
    # not in pyproject.toml, which would import them before their coverage is measured
    for package in ("bem3d", "mdr"):
        config.addinivalue_line("filterwarnings", f"ignore::{package}.ContactWarning")


@pytest.fixture
def without_figures(monkeypatch):
    """Reports hold stand-ins for their figures, which take longest."""
    # imported here, since coverage is measured from the first import
    from validation.report import page as pictures

    monkeypatch.setattr(pictures, "draw_figure", lambda name, *rest: f"<svg>{name}</svg>".encode())


@pytest.fixture(scope="session", autouse=True)
def texts_of_sources_are_read_once():
    """What a text of code imports and says, by its bytes: a digest of the project takes seconds, and seeded faults
    forget what the project remembers of it."""
    # as below: not before coverage is measured
    from validation.engine import sources

    def by_text(of, path_of, known):
        @functools.wraps(of)
        def remembered(argument):
            path = path_of(argument)
            key = argument if of is named else argument.suffix, path and sources._source(path)
            if key not in known:
                known[key] = of(argument)
            return known[key]

        return remembered

    named = sources._import_names
    with pytest.MonkeyPatch.context() as patch:
        for of, path_of in (
            (named, sources._path),
            (sources._meaning.__wrapped__, Path),
            (sources._words.__wrapped__, Path),
        ):
            patch.setattr(sources, of.__name__, by_text(of, path_of, {}))
        yield
