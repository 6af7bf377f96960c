"""Which tests are marked as concurrent, and the order of tests, as `.ci/anywhere` asks for them."""

from pathlib import Path
from types import SimpleNamespace

import pytest

from tests import conftest

ROOT = Path(__file__).parents[1]


@pytest.mark.parametrize(
    ("imports", "concurrent"),
    [
        ("import threading", True),
        ("from concurrent.futures import Future", True),
        ("import time", True),
        ("from bem3d import threads as shared_out", True),
        ("from validation.judging.worker import OthersError, Visitor", True),
        ("from tests.engine.jobs import stay", True),
        ("from validation.judging.worker import Called", False),
        ("import subprocess", False),
        ("import timeit", False),
    ],
)
def test_a_file_is_marked_by_what_it_imports(imports, concurrent, tmp_path):
    path = tmp_path / "test_it.py"
    path.write_text(f"def test_it():\n    {imports}\n", encoding="utf-8")
    assert conftest.is_concurrent(path) == concurrent


def collected(seed):
    """Three files of tests, the middle one concurrent, as they are collected with an option; and what is marked."""
    paths = [ROOT / "tests" / name for name in ("test_conventions.py", "bem3d/test_threads.py", "test_readme.py")]
    marked = []
    items = [
        SimpleNamespace(path=path, number=number, add_marker=lambda mark, path=path: marked.append((mark, path.name)))
        for path in paths
        for number in range(8)
    ]
    config = SimpleNamespace(getoption=lambda name: {"--shuffled": seed}[name])
    conftest.pytest_collection_modifyitems(config, items)
    assert marked == 8 * [("concurrent", "test_threads.py")]
    return [(item.path.name, item.number) for item in items]


def test_a_seed_is_an_order_of_the_same_tests_whose_files_stay_together():
    plain, first, again, other = (collected(seed) for seed in (None, 0, 0, 1))
    assert first == again and first != other and first != plain
    for order in (first, other):
        assert sorted(order) == sorted(plain)
        assert [name for name, _ in order[::8]] == [name for name, _ in order[7::8]]


def test_without_a_seed_the_order_stays():
    assert [number for _, number in collected(None)] == 3 * list(range(8))
