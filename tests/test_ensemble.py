"""Independent solves: equal bits for any number of workers, and stored results that can be trusted."""

import os
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest

from validation import ensemble
from validation.cases import fractal_punch
from validation.ensemble import Engine, generator


@dataclass(frozen=True)
class Toy:
    number: int
    log: str


def toy(problem):
    """Leaves a trace each time it is computed."""
    with Path(problem.log).open("a") as file:
        file.write(f"{problem.number}\n")
    return {"value": generator(5, problem.number).standard_normal(4)}


def computed(log):
    return sorted(int(line) for line in Path(log).read_text().split()) if Path(log).exists() else []


def same(outcomes, others):
    return all(np.array_equal(a[k], b[k], equal_nan=True) for a, b in zip(outcomes, others, strict=True) for k in a)


@pytest.fixture
def problems(tmp_path):
    return [Toy(i, str(tmp_path / "log")) for i in range(5)]


def test_results_come_in_order_and_once(problems, tmp_path):
    engine = Engine(store=tmp_path / "store")
    first = engine.map(toy, problems)
    again = engine.map(toy, problems[::-1])[::-1]
    assert computed(problems[0].log) == [0, 1, 2, 3, 4]
    assert same(first, again)
    assert same(first, Engine().map(toy, problems))


def test_damaged_and_foreign_files_are_computed_anew(problems, tmp_path):
    store = tmp_path / "store"
    first = Engine(store=store).map(toy, problems)
    files = sorted(store.iterdir())
    assert len(files) == 5
    whole = files[0].read_bytes()
    files[0].write_bytes(whole[: len(whole) // 2])
    files[1].write_bytes(b"")
    files[2].write_bytes(os.urandom(1000))
    files[3].write_bytes(files[4].read_bytes())
    assert same(first, Engine(store=store).map(toy, problems))
    assert len(computed(problems[0].log)) == 9
    assert files[0].read_bytes() == whole


def test_other_numerics_do_not_reuse_results(problems, tmp_path, monkeypatch):
    engine = Engine(store=tmp_path / "store")
    engine.map(toy, problems)
    monkeypatch.setattr(ensemble, "_numerics", lambda: "another version")
    engine.map(toy, problems)
    assert len(computed(problems[0].log)) == 10


def test_a_failed_write_leaves_nothing_behind(problems, tmp_path, monkeypatch):
    def full_disk(self, target):
        raise OSError("no space")

    monkeypatch.setattr(Path, "replace", full_disk)
    with pytest.raises(OSError, match="no space"):
        Engine(store=tmp_path / "store").map(toy, problems)
    assert list((tmp_path / "store").iterdir()) == []


SMALL = fractal_punch.FractalPunch(
    hursts=(0.7,), cells=16, surfaces=4, profiles=6, points=64, refined=3, decades=(-1, 0), reported=(0.1, 1.0)
)


def test_any_number_of_workers_gives_the_same_bits():
    surfaces = [
        fractal_punch.Surface(case=SMALL, hurst=0.7, realisation=i, cells=32, forces=(0.1, 1.0)) for i in range(6)
    ]
    alone = Engine().map(fractal_punch.press_surface, surfaces)
    for workers in (2, 3):
        assert same(alone, Engine(workers=workers).map(fractal_punch.press_surface, surfaces))


def test_realisations_have_addresses():
    """Independent of how many others are drawn; different for every key."""
    draws = {key: generator(7, *key).random() for key in [(1, 700, 0), (1, 700, 1), (2, 700, 0), (1, 400, 0)]}
    assert len(set(draws.values())) == 4
    assert generator(7, 1, 700, 1).random() == draws[1, 700, 1]
    assert generator(8, 1, 700, 1).random() != draws[1, 700, 1]


def test_fewer_surfaces_are_the_first_of_more():
    few = fractal_punch.run(SMALL)
    more = fractal_punch.run(fractal_punch.FractalPunch(**{**vars(SMALL), "surfaces": 5}))
    np.testing.assert_array_equal(few.ensembles[0].bem["stiffness"], more.ensembles[0].bem["stiffness"][:4])


def test_a_solve_that_fails_is_counted_and_shown():
    impossible = fractal_punch.FractalPunch(**{**vars(SMALL), "tolerance": 1e-30})
    surface = fractal_punch.Surface(case=impossible, hurst=0.7, realisation=0, cells=16, forces=(10.0,))
    outcome = fractal_punch.press_surface(surface)
    assert np.isnan(outcome["stiffness"]).all()
    assert outcome["residual"][0] > 1e-30
