"""The report as a user makes it: files, bytes, exit statuses."""

import json
import os
import re
import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import bem3d
import mdr
from validation import __main__ as command
from validation.advice.cases import model_selection as ladder
from validation.analysis.case import Case
from validation.analysis.contents import as_csv, as_json, csv_name, from_csv
from validation.analysis.evidence import Role
from validation.analysis.quantity import key_of
from validation.cases.exact import geike, hertz
from validation.cases.limits import limits
from validation.cases.punch import bandwidth, interface
from validation.cases.punch.fractal_punch import FractalPunch
from validation.cases.rolling import force_spectrum as rolling
from validation.cases.rolling import reduced_models, ridges, track_stiffness
from validation.cases.stability import wheel_stability
from validation.cases.wheel import distance as wheel_distance
from validation.cases.wheel import half_space as wheel_3d
from validation.cases.wheel import spectrum as wheel
from validation.cases.wheel.ensembles import QUANTITIES
from validation.engine import engine as ensemble
from validation.railway.cases.across import Across
from validation.railway.cases.rail_dynamic import RailDynamic
from validation.railway.cases.rail_sound import RailSound, shipped_rail
from validation.railway.cases.rough_rail import RoughRail
from validation.report import build
from validation.report.chapter import ENTRIES
from validation.report.contents import CASES
from validation.report.earlier_report import kept_sections
from validation.report.section import numbers_table, results_of

ROOT = Path(__file__).parents[2]
PUNCHES = {"cells": 16, "profiles": 40, "points": 64, "decades": (-1, 0)}
STRIPS = {"lowest": 0.5, "length": 32.0, "width": 12.0, "cells": 4, "strips": 3}
TRACKS = {"tracks": 5, "springs": 8}
SMALL = {
    "hertz": hertz.Hertz(
        cells_per_radius=(4, 6, 8), load_steps=2, wave_cells=(32, 64, 128), loads=(0.5,), ellipse_cells=(16, 32)
    ),
    "geike": geike.Geike(cells=256, longest=16),
    "fractal_punch": FractalPunch(
        hursts=(0.4, 1.0),
        surfaces=((0, 12, 6, 4, 0),) * 2,
        fine_profiles=10,
        **PUNCHES | {"profiles": 30, "decades": (-1, 1)},
    ),
    "bandwidth": bandwidth.Bandwidth(
        hursts=(0.7,),
        bands=(bandwidth.Band(4, 16, 8, 8, (8, 8), 4), bandwidth.Band(8, 32, 8, 8)),
        roll_off=(2, 0),
        rolled_off=4,
        profiles=30,
        decades=(-2, 0),
        per_decade=1,
    ),
    "interface": interface.Interface(
        grounds=((8, 0.7), (4, 0.7)), pressed=(4, 0.7), band=2, surfaces=6, refined=3, profiles=40, points=64
    ),
    "ridges": ridges.RollingOverRidges(length=20, shortest=6.0, cells=(4, 6), springs=(8.5, 16.5)),
    "rolling": rolling.ForceSpectrum(heights=(0.01, 0.3), last=9.0, rough_strips=3, refined=3, **STRIPS, **TRACKS),
    "reduced_models": reduced_models.ReducedModels(
        spectra=((0.7, 2.0, 6.0), (0.4, 2.0, 6.0)), strips=3, waves=3, length=10, width=6, cells=6
    ),
    "track_stiffness": track_stiffness.TrackStiffness(
        forces=(1.0,), waves=2, width=6, cells=4, strips=3, tracks=5, springs=16
    ),
    "wheel": wheel.WheelSpectrum(
        scene=replace(wheel.TABLE, distance=0.15, springs=40),
        realisations=6,
        groups=3,
        parameters=False,
    ),
    "wheel_distance": wheel_distance.WheelDistance(
        scene=replace(wheel.TABLE, distance=0.1, springs=24, ground=replace(wheel.TABLE.rail, shortest=0.5e-3)),
        doublings=2,
        wheels=4,
        fewest=4,
        steady=8,
        heights=(0.5, 1.0),
        groups=4,
    ),
    "wheel_3d": wheel_3d.Wheel3D(strips=3, cells=5, shared=1, finer=2, wheels=6, groups=3),
    "wheel_stability": wheel_stability.WheelStability(turns=3, long_steps=2000, heights=(1e-3,)),
    "across": Across(across=("isotropic ground",), cells=(4, 5)),
    "rough_rail": RoughRail(offsets=(20.0,), strips=3, cells=(4, 5)),
    "rail_dynamic": RailDynamic(
        offsets=(0.0,), longest=0.05, periods=2, rounds=(0, 1), cells=5, coarse=4, strips=3, compared=2
    ),
    "rail_sound": RailSound(rail=shipped_rail(), seconds=0.02, repeats=2, cells=(4, 5), parts=2, blocks=5),
    "ladder": ladder.CalibrationTest(punches=3, spheres=1, rolling=0, tolerances=(0.3,)),
    "limits": limits.Limits(cells=16, surfaces=2, profiles=10, resolved=1, length=8.0, strip_cells=6, track=32.0),
}


@pytest.fixture
def small(monkeypatch):
    """The same cases, small enough for a test."""
    for name, case in SMALL.items():
        use(monkeypatch, name, case)
    # takes a second a case: test_kept has it
    monkeypatch.setattr(build, "versions_of", lambda names, profile: dict.fromkeys(names, ""))
    return list(CASES)


def use(monkeypatch, name, case):
    monkeypatch.setitem(CASES, name, replace(CASES[name], quick=case))


def report(*words):
    return command.main(["report", *words])


def contents(folder, *patterns):
    return {str(f.relative_to(folder)): f.read_bytes() for p in patterns for f in sorted(folder.glob(p))}


def recorded(monkeypatch):
    """A list to which each run of a case adds its evidence."""
    found, evidence_of = [], Case.evidence
    monkeypatch.setattr(Case, "evidence", lambda *of: found.append(evidence_of(*of)) or found[-1])
    return found


def files_of(name, evidence):
    """A CSV for each table that is not played, a figure for each caption, one of each at least, and a WAV a sound."""
    assert evidence.tables and name in evidence.captions
    played = evidence.sounds.table if evidence.sounds else None
    shown = {table.name for table in evidence.tables} - {played}
    data = {f"data/{csv_name(name, table)}" for table in (*shown, "numbers")}
    sounds = {f"sounds/{name}-{sound.name}.wav" for sound in evidence.sounds.tracks} if evidence.sounds else set()
    pictures = {f"figures/{figure}.svg" for figure in evidence.captions}
    return {"results.json", "data/columns.csv", *data, *pictures, *sounds}


def no_identity_is_a_finding(evidence):
    """What is its reference, with nothing left open, would be so for every input; a shortfall may be none."""
    findings = [n for n in evidence.numbers if n.role is Role.FINDING and not n.quantity.startswith("shortfall")]
    exact = [n.label for n in findings if abs(n.difference) + n.uncertainty < 1e-9 * max(abs(n.reference), 1)]
    assert not exact


def read_back_whole(folder):
    """A case that is kept by a later report says all that it said."""
    kept = kept_sections(folder, "quick", regenerated=())
    said = json.loads((folder / "results.json").read_text(encoding="utf-8"))
    assert json.loads(as_json(results_of(kept, "quick"))) == {
        name: said[name] for name in ("schema_version", "profile", "cases")
    }
    (section,) = kept
    assert section.files == contents(folder, f"data/{section.name}-*.csv", "sounds/*.wav")
    tables = [*section.evidence.tables, numbers_table(section.numbers)]
    assert {f"data/{csv_name(section.name, t.name)}": as_csv(t, drawn=True) for t in tables} == contents(
        folder, f"data/{section.name}-*.csv"
    )


NUMBERS = ("results.json", "data/*.csv", "sounds/*.wav")
FIGURES = ("figures/*.svg",)
SOLVES = ("realisations/*.npz",)
REDRAWN = ("geike",)
"""Whose figure is drawn twice: all are written by the same code, from tables that are equal."""


@pytest.mark.slow
@pytest.mark.parametrize("name", list(CASES))
def test_a_case_gives_equal_bytes(name, small, tmp_path, monkeypatch, request):
    """By any number of workers, and as well from stored results, of which every third is solved anew. No contact warns:
    a case avoids it, or is about it."""
    one = tmp_path / "one"
    evidences = recorded(monkeypatch)
    with warnings.catch_warnings():
        warnings.simplefilter("error", bem3d.ContactWarning)
        warnings.simplefilter("error", mdr.SpringContactWarning)
        # grids this small may miss a criterion
        assert report("--only", name, "--out", str(one), "--workers", "1") in (0, 1)
    assert set(contents(one, *NUMBERS, *FIGURES)) == files_of(name, evidences[0])
    whole_page(one, [name])
    players_of_all_sounds(one)
    assert "".join(claim.claim for claim in evidences[0].claims[:1]) == CASES[name].claim
    names_no_machine(one)
    in_the_book(name, evidences[0])
    no_identity_is_a_finding(evidences[0])
    read_back_whole(one)
    by_one, drawn = contents(one, *NUMBERS), contents(one, *FIGURES)
    if name not in REDRAWN:
        request.getfixturevalue("without_figures")
    solved = set(contents(one, *SOLVES))
    lose_every_third(one)
    assert report("--only", name, "--out", str(one), "--workers", "2") in (0, 1)
    assert contents(one, *NUMBERS) == by_one and set(contents(one, *SOLVES)) == solved
    assert name not in REDRAWN or contents(one, *FIGURES) == drawn
    request.getfixturevalue("without_figures")
    for place in one_of_each_solve_that_may_fail(one / "realisations"):
        whole = place.read_bytes()
        lose(place)
        with warnings.catch_warnings():
            # of statistics of too few
            warnings.simplefilter("ignore", RuntimeWarning)
            status = report("--only", name, "--out", str(one), "--workers", "1")
        assert status == command.Exit.NOT_CONVERGED, place.name
        place.write_bytes(whole)


def lose_every_third(folder):
    """Of the stored results of each kind of solve, in the order in which they were solved."""
    found = {}
    for place in sorted(folder.glob(*SOLVES), key=lambda place: place.stat().st_mtime_ns):
        found.setdefault(place.name.rpartition("-")[0], []).append(place)
    for place in (place for places in found.values() for place in places[::3]):
        place.unlink()


def one_of_each_solve_that_may_fail(store):
    """Stored results, by the names of their solves."""
    found = {}
    for place in sorted(store.glob("*.npz")):
        with np.load(place) as outcome:
            if "failed" in outcome and not outcome["failed"].any():
                found.setdefault(place.name.rpartition("-")[0], place)
    return list(found.values())


def lose(place):
    """A stored result becomes that of a solve which did not converge: a flag, and no number."""
    with np.load(place) as stored_there:
        outcome = dict(stored_there)
    key = json.loads(str(outcome.pop(ensemble.LABEL)))["key"]
    floats = {name: values for name, values in outcome.items() if values.dtype.kind in "fc"}
    lost = {name: np.full_like(values, np.nan) for name, values in floats.items()}
    ensemble.save_result(place, key, {**outcome, **lost, "failed": np.ones_like(outcome["failed"])})


def text_of(folder):
    """Of all pages."""
    return "".join(page.read_text(encoding="utf-8") for page in sorted(folder.glob("*.html")))


def whole_page(folder, names):
    """Assert that the page has each case, each figure in it, and needs nothing from elsewhere."""
    page = text_of(folder)
    for name in names:
        assert f'id="{name}"' in page
    figures = len(list((folder / "figures").glob("*.svg")))
    # some stand on the front page, too
    assert len(set(re.findall(r'<img alt="[^"]+" src="(figures/[^"]+)"', page))) == figures >= len(names)
    for external in ("http://", "https://", "<script", "@import", 'rel="stylesheet"'):
        assert external not in page
    assert "profile: quick" in page


def names_no_machine(folder):
    text = (folder / "provenance.json").read_text(encoding="utf-8") + (folder / "results.json").read_text(
        encoding="utf-8"
    )
    assert not [name for name in (str(ROOT), str(folder), os.uname().nodename) if name in text]


def players_of_all_sounds(folder):
    """Assert that each sound has a player with a label, which needs no script, and a link."""
    page = text_of(folder)
    found = [f"sounds/{file.name}" for file in sorted((folder / "sounds").glob("*.wav"))]
    assert page.count("<audio controls") == page.count('preload="metadata" aria-label="') == len(found)
    assert all(f'src="{place}"></audio>' in page and f'href="{place}" download' in page for place in found)


def in_the_book(name, evidence):
    """Assert that each number and claim of the case that answers the chapter exists; a feature may not stand out."""
    features = {*map(key_of, QUANTITIES.values())}
    for entry in ENTRIES:
        for test in entry.tests:
            exists = test.judged(entry.statement, evidence) is not None or test.quantity in features
            assert test.case != name or exists, (entry.place, test)


@pytest.mark.slow
def test_not_converged_is_exit_3(small, tmp_path, monkeypatch, capsys):
    """One case fails, the others are still reported."""
    use(monkeypatch, "hertz", hertz.Hertz(cells_per_radius=(4, 6), load_steps=1, tolerance=1e-30))
    assert report("--only", "hertz", "geike", "--out", str(tmp_path), "--workers", "1") == command.Exit.NOT_CONVERGED
    printed = capsys.readouterr().out
    assert "not converged: residual" in printed
    results = json.loads((tmp_path / "results.json").read_text(encoding="utf-8"))
    assert results["cases"]["hertz"]["numbers"] == []
    assert results["cases"]["geike"]["numbers"]


def limited(monkeypatch, is_lost):
    """Give up at once on the solves that are to be lost."""
    indent = bem3d.indent

    def stubborn(half_space, gap, *, forces, **settings):
        for force in forces:
            lost = is_lost(half_space, gap, force)
            yield from indent(half_space, gap, forces=[force], **settings, max_iterations=1 if lost else 500)

    monkeypatch.setattr(bem3d, "indent", stubborn)


@pytest.mark.slow
def test_a_lost_realisation_is_shown_and_is_exit_3(small, tmp_path, monkeypatch):
    """One surface of twenty-four fails at its largest force: named, counted, and the report still stands."""
    seen = []

    def is_lost(half_space, gap, force):
        seen.append(gap.shape == (8, 8) and force > 0.9e-2)
        return seen[-1] and sum(seen) == 1

    limited(monkeypatch, is_lost)
    assert report("--only", "fractal_punch", "--out", str(tmp_path), "--workers", "1") == command.Exit.NOT_CONVERGED
    results = json.loads((tmp_path / "results.json").read_text(encoding="utf-8"))["cases"]["fractal_punch"]
    assert len(results["unconverged"]) == 1
    assert results["unconverged"][0].startswith("surface 0, H = 0.4, 8² cells, Fbar = 10: residual")
    assert len(results["numbers"]) > 10
    counted = from_csv("surfaces", (tmp_path / "data" / "fractal_punch-surfaces.csv").read_text(encoding="utf-8"))
    assert counted["value"].tolist() == [12] * 6 + [11] + [12] * 7
    assert "surface 0, H = 0.4" in text_of(tmp_path)


@pytest.mark.slow
def test_a_lost_ensemble_has_no_result_and_is_exit_3(small, tmp_path, monkeypatch, capsys):
    limited(monkeypatch, lambda half_space, gap, force: force > 0.9e-3)
    assert report("--only", "fractal_punch", "--out", str(tmp_path), "--workers", "1") == command.Exit.NOT_CONVERGED
    results = json.loads((tmp_path / "results.json").read_text(encoding="utf-8"))["cases"]["fractal_punch"]
    assert results["numbers"] == []
    assert "3 are needed" in results["unconverged"][0]
    assert "no result" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["report", "--profile", "slow"], "--profile"),
        (["report", "--only", "hertz", "moon"], "--only"),
        (["report", "--only"], "--only"),
        (["report", "--workers", "0"], "--workers"),
        (["report", "--workers", "two"], "whole number"),
        (["report", "--seed", "-1"], "--seed"),
        (["report", "--seed", "nan"], "--seed"),
        (["benchmark", "--executor", "local"], "usage: mdr-validation benchmark "),
        (["judge", "a.py", "b.py"], "mdr-validation judge: error: unrecognized arguments: b.py"),
        (["sound", "rail", "--models", "bem,moon"], "--models"),
        (["sound", "rail", "--seconds", "nan"], "--seconds"),
        (["sound", "rail", "--seconds", "-1"], "--seconds"),
        (["dance"], "dance"),
        ([], "COMMAND"),
    ],
)
def test_bad_usage_is_exit_2(words, said, capsys):
    with pytest.raises(SystemExit) as caught:
        command.main(words)
    assert caught.value.code == command.Exit.BAD_INPUT
    # however narrow the terminal is
    assert said in " ".join(capsys.readouterr().err.split())


@pytest.mark.parametrize("executor", ["dask", "dask://nowhere", "tcp://127.0.0.1:1"])
def test_an_executor_that_is_none_is_exit_2(executor, tmp_path, capsys):
    out = tmp_path / "out"
    assert report("--only", "hertz", "--executor", executor, "--out", str(out)) == command.Exit.BAD_INPUT
    assert "executor must be" in capsys.readouterr().err
    assert not out.exists()


def test_a_case_whose_figure_nothing_draws_ends_before_the_first_solve(tmp_path, monkeypatch, capsys):
    def solved(case, engine):
        raise AssertionError("a solve")

    monkeypatch.setitem(CASES, "moon", replace(CASES["hertz"], name="moon", run=solved))
    assert report("--only", "moon", "--out", str(tmp_path / "out")) == command.Exit.BAD_INPUT
    assert "figure 'moon' must be a chart of its case, or in OWN" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()
