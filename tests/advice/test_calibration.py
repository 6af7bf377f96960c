"""Errors that models claim are those that were measured: they cover new scenes, are tight, and end with the table."""

import csv
import math
import re
from dataclasses import replace
from statistics import linear_regression

import numpy as np
import pytest

from tests.advice.planted_answers import punch, waves, wheel
from tests.advice.script import calibrate
from tests.seeded import catches
from validation.advice import calibration, calibration_scenes, calibration_solves
from validation.advice.calibrate import calibration_age
from validation.advice.calibration import (
    HEIGHT,
    HURST,
    LOAD,
    LONG,
    RATIO,
    WAVES,
    MeasuredErrors,
    calibrated,
    conditions_by_kind,
)
from validation.advice.calibration_scenes import QUANTITIES, RESONANCES, CalibrationRun, CalibrationScene
from validation.advice.scene_model import Answer, Realisations
from validation.scenes.rolling import RollingQuantity
from validation.simulation.model import Cost, GridModel, Target, all_models, models_serving

PUNCH = {LOAD: 1.0, WAVES: 1.0, RATIO: 8.0, HURST: 0.7}
NAMES = {"punch": (LOAD, WAVES, RATIO, HURST), "sphere": (HEIGHT, LONG, RATIO, HURST)}
LOW, HIGH = np.array([-2.0, 0.0, 0.5, 0.3]), np.array([1.0, 0.5, 1.5, 1.0])


def population(count, seed, kind="sphere"):
    """Scenes whose errors grow with the first condition, scatter like a Gaussian, and no other rule."""
    rng = np.random.default_rng(seed)
    points = rng.uniform(LOW, HIGH, (count, 4))
    size = 0.3 * 10 ** points[:, 0] if kind == "sphere" else 0.05 * (1 + points[:, 0] ** 2)
    return points, np.abs(size * rng.normal(1.0, 0.5, count))


def measured(kind, points, errors):
    return MeasuredErrors(NAMES[kind], points, errors, np.ones(len(errors)))


def conditions(point, kind):
    return {name: x if name == HURST else 10**x for name, x in zip(NAMES[kind], point, strict=True)}


@catches("the error nearby, without what covers it", kind="punch").at(
    "validation.advice.calibration.MeasuredErrors.factor", 1.0
)
@catches("a claim that half of the scenes exceed", kind="sphere").at("validation.advice.calibration.SHARE", 0.5)
@pytest.mark.parametrize("kind", NAMES)
def test_claims_cover_new_scenes_and_are_tight(kind):
    covered, ratios = [], []
    for seed in range(12):
        table = measured(kind, *population(80, seed, kind))
        for point, error in zip(*population(60, 1000 + seed, kind), strict=True):
            claim = table.estimate(conditions(point, kind)).error
            covered.append(error <= claim)
            ratios.append(claim / error)
    # twelve tables leave one per cent, and whole scenes of a table of 80 another
    assert abs(np.mean(covered) - calibration.SHARE) <= 0.02
    assert np.median(ratios) <= 3.0


def one_of_each(kind="punch", error=0.1):
    """The corners of a box, all with one error."""
    corners = np.array(np.meshgrid(*zip(LOW, HIGH, strict=True), indexing="ij")).reshape(4, -1).T
    return measured(kind, np.repeat(corners, 2, axis=0), np.full(32, error))


@catches("a table of errors held constant beyond its end", kind="punch", name=LOAD, inside=0.0075, outside=0.0065).at(
    "validation.advice.calibration.OPEN_BELOW", (LOAD,)
)
@pytest.mark.parametrize(
    ("kind", "name", "inside", "outside"),
    [
        ("punch", LOAD, 0.0075, 0.0065),
        ("punch", WAVES, 4.2, 4.8),
        ("punch", RATIO, 2.3, 2.2),
        ("punch", RATIO, 44.0, 46.0),
        ("punch", HURST, 0.16, 0.14),
        ("punch", HURST, 1.14, 1.16),
        ("sphere", HEIGHT, 14.0, 14.3),
        ("sphere", LONG, 4.2, 4.8),
    ],
)
def test_beyond_the_table_there_is_no_claim(kind, name, inside, outside):
    middle = conditions((LOW + HIGH) / 2, kind)
    table = one_of_each(kind)
    assert table.estimate({**middle, name: inside}).error > 0
    beyond = table.estimate({**middle, name: outside})
    assert not beyond.in_range and beyond.reason.startswith(f"{name} = {outside:.3g}; ")


@pytest.mark.parametrize(
    ("kind", "name", "end"), [("punch", LOAD, 10.0), ("sphere", HEIGHT, 0.01), ("sphere", LONG, 1.0)]
)
def test_beyond_an_open_end_the_error_of_the_end_holds(kind, name, end):
    points, errors = population(60, 3, kind)
    table, middle = measured(kind, points, errors), conditions((LOW + HIGH) / 2, kind)
    low, high = (10 ** x[NAMES[kind].index(name)] for x in (points.min(axis=0), points.max(axis=0)))
    at = high if name == LOAD else low
    far = at * 1e6 if name == LOAD else at / 1e6
    assert table.estimate({**middle, name: far}).error == pytest.approx(table.estimate({**middle, name: at}).error)


def test_equal_errors_are_claimed_as_they_are():
    table = one_of_each(error=0.1)
    assert table.factor == pytest.approx(1.0)
    assert table.estimate(PUNCH).error == pytest.approx(0.1)
    # measured heights have no Hurst exponent
    assert table.estimate({name: value for name, value in PUNCH.items() if name != HURST}).error == pytest.approx(0.1)


@pytest.mark.parametrize(("power", "of_shape", "found"), [(0.5, 0, 0.5), (-1, 0, 0), (2, 0, 1), (1, 0.5, 0.5)])
def test_an_error_over_its_shape_grows_with_the_height_by_a_power_from_zero_to_one(power, of_shape, found):
    points, _ = population(60, 5)
    errors, shapes = 0.2 * 10 ** (power * points[:, 0]), 10 ** (of_shape * points[:, 0])
    assert MeasuredErrors(NAMES["sphere"], points, errors, shapes).trend == pytest.approx(found)
    assert MeasuredErrors(NAMES["punch"], points, errors, shapes).trend == 0.0


def left_out_by_loops(table, scene):
    """Root mean square of the errors of the nearest others, a tenth of the weight for the farthest of them.

    The first condition counts twice in the distance; nearest is a share of all, six at the least; under spheres the
    errors grow with the height by the power that least squares find, from zero to one.
    """
    here, trend, share, lead = table.points[scene], 0.0, 0.05, np.array([2.0, 1.0, 1.0, 1.0])
    if table.names == NAMES["sphere"]:
        slope = linear_regression(table.points[:, 0], np.log10(table.errors / table.shapes)).slope
        share, trend = 0.3, min(max(slope, 0.0), 1.0)
    far = {i: math.dist(lead * one, lead * here) for i, one in enumerate(table.points) if i != scene}
    nearest = sorted(far, key=far.get)[: max(6, round(share * len(far)))]
    weights = [1 - 0.9 * (far[i] / far[nearest[-1]]) ** 2 for i in nearest]
    grown = [10 ** (trend * (here[0] - table.points[i][0])) for i in nearest]
    squares = (table.errors / table.shapes)[nearest] ** 2 * np.square(grown)
    return table.shapes[scene] * math.sqrt(np.average(squares, weights=weights))


@catches("a scene that calibrates itself", kind="punch").at(
    "validation.advice.calibration.MeasuredErrors.left_out", lambda table: table.errors
)
@catches("a table without the growth of its errors", kind="sphere").at(
    "validation.advice.calibration.MeasuredErrors.trend", 0.0
)
@pytest.mark.parametrize("kind", NAMES)
def test_errors_nearby_are_those_of_a_loop_over_all_scenes(kind):
    points, errors = population(200, 8, kind)
    shapes = np.random.default_rng(9).uniform(0.5, 2.0, 200)
    table = MeasuredErrors(NAMES[kind], points, errors, shapes)
    found = table.left_out()
    for scene in (0, 7, 63, 199):
        assert found[scene] == pytest.approx(left_out_by_loops(table, scene), rel=1e-9)
    # 97 % of the scenes are within the claim, by the quantile that counts a scene that is not there
    ratios = np.sort(errors / found)
    place = 0.97 * 201 - 1
    assert table.factor == pytest.approx(np.interp(place, np.arange(200), ratios))
    claimed = table.estimate(conditions(points[7], kind), 1.7).error
    assert claimed == pytest.approx(table.factor * 1.7 * table._scale(points[7], np.ones(200, dtype=bool)))


def cheap(name, target):
    return next(model for model in models_serving(target.scene, target.quantity) if model.name == name)


def test_what_is_not_in_the_table_has_no_claim():
    still = Target(wheel(), "force-rms")
    assert calibrated(cheap("springs", still), still).in_range
    of_heights = next(model for model in all_models() if model.name == "linear filter, 3D")
    assert "not in the table" in calibrated(of_heights, still).reason


@pytest.mark.parametrize("quantity", QUANTITIES["wheel"])
def test_dynamic_wheels_of_the_design_excite_no_resonance(quantity):
    """But for a few, whose force changes too much, all have a level; at a lower speed the longest wave is too slow."""
    design = [CalibrationScene(kind="wheel", number=i, quantity=quantity, seed=19) for i in range(16)]
    assert sum(not point.target(0.1).rolling.no_answer for point in design) >= 14
    for point in design:
        slower = replace(point.scene, speed=point.scene.speed / 10 ** RESONANCES[1] / 1.01)
        assert "resonance" in RollingQuantity(slower, quantity).no_answer


# The table of the package


@pytest.mark.slow
def test_models_whose_code_is_another_are_named(tmp_path):
    path, asked = tmp_path / "today.csv", Target(wheel(), "force-rms")
    pressed = CalibrationScene(kind="punch", number=0, quantity="stiffness", seed=19).target()
    codes = [calibration.code_behind(cheap("springs", one), one) for one in (asked, pressed)]
    assert all(re.fullmatch("[0-9a-f]{12}", code) for code in codes) and codes[0] != codes[1]
    written(path, calibration.rows_of(calibration.TABLE))
    assert calibrate.check_calibration(1, MeasuredAgain(1.0), path, stamp=True)[0] == []
    for age in (calibration_age(path, asked), calibration_age(path)):
        assert "by code that gives the same as today's, checked " in age and age.endswith(" solves")
    written(path, calibration.rows_of(path))
    assert calibration_age(path).endswith("by today's code")
    of_springs = [{**row, "code": "0" * 12} if row["model"] == "springs" else row for row in calibration.rows_of(path)]
    written(tmp_path / "other.csv", of_springs)
    assert calibration_age(tmp_path / "other.csv", asked).endswith("by other code than today's: springs")
    assert "sphere stiffness, springs" in calibration_age(tmp_path / "other.csv")


def written(path, rows):
    """A table that was measured when that of the package was, and not checked since."""
    about = {name: text for name, text in calibration.provenance().items() if name != "checked"}
    path.write_bytes(calibrate.as_table(about, rows))
    calibration.table.cache_clear()


class MeasuredAgain:
    """An engine whose solves have the errors of the table times a factor."""

    def __init__(self, factor):
        self.factor, self.points = factor, []

    def map(self, solve, points):
        self.points = list(points)
        rows = {(r["kind"], r["number"], r["quantity"], r["model"]): r for r in calibration.rows_of(calibration.TABLE)}
        found = []
        for point in points:
            mine = [rows.get((point.kind, str(point.number), point.quantity, one.name)) for one in point.cheap]
            errors = [self.factor * float(row["error"]) if row else math.nan for row in mine]
            found.append({"error": np.array(errors), "reference": np.array(0.1), "failed": np.array(0.0)})
        return found


@pytest.mark.slow
@pytest.mark.parametrize(("factor", "same"), [(1.0, True), (1.0009, True), (0.9989, False), (1.01, False)])
def test_rows_take_the_version_of_today_where_some_measured_again_are_the_same(tmp_path, factor, same):
    path, engine = tmp_path / "table.csv", MeasuredAgain(factor)
    rows = [{**row, "code": "0" * 12} for row in calibration.rows_of(calibration.TABLE)]
    written(path, rows)
    differing, solves = calibrate.check_calibration(2, engine, path, stamp=True)
    assert solves.startswith(f"{len(engine.points)} of ")
    assert len(engine.points) == 2 * sum(len(quantities) for quantities in QUANTITIES.values())
    assert (not differing) is same
    assert ("by code that gives the same as today's, checked" in calibration_age(path)) is same
    assert (calibration.rows_of(path) == rows) is not same
    assert [{**row, "code": "0" * 12} for row in calibration.rows_of(path)] == rows
    assert ("checked" in calibration.provenance(path)) or not same
    assert same or all(re.search(r": an error of \S+ in the table, of \S+ today$", line) for line in differing)


def test_every_cheap_model_is_in_the_table_with_scenes_enough():
    cheap = {model.name for point in CalibrationRun().points for model in point.cheap}
    assert {model for _, _, model in calibration.table()} == cheap
    for (kind, _, _), table in calibration.table().items():
        assert len(table.errors) >= (8 if kind in ("rolling", "wheel") else 24)
        claims = table.factor * table.left_out()
        assert 0.9 <= np.mean(table.errors <= claims) <= 1.0
        assert np.isfinite(claims).all() and (claims > 0).all()


def test_each_row_is_a_scene_of_the_design():
    seed = int(calibration.provenance()["command"].rsplit(" ", 1)[1])
    for row in calibration.rows_of(calibration.TABLE)[::7]:
        point = CalibrationScene(kind=row["kind"], number=int(row["number"]), quantity=row["quantity"], seed=seed)
        kind, found = conditions_by_kind(point.target(0.1))
        assert kind == row["kind"]
        for name, value in found.items():
            if row.get(name):
                assert value == pytest.approx(float(row[name]), rel=1e-4)


def test_a_table_has_a_row_a_scene_and_model_with_its_error(monkeypatch):
    run = CalibrationRun(punches=2, spheres=0, rolling=0, wheels=0, seed=4)
    monkeypatch.setitem(calibration_scenes.DESIGNS, "punch", ((0.0, 1.0), (0.0, 0.0), (0.5, 0.9), (0.5, 0.9)))
    table, answers = calibrate.measured_table(run)
    rows = list(csv.DictReader(line for line in table.decode().splitlines() if line[0] != "#"))
    found = answers["punch", "stiffness"]
    left = [float(row["reference"]) for row in rows[::2]]
    assert found.number.tolist() == [0, 1] and found.reference == pytest.approx(left, rel=0.01)
    assert [(row["number"], row["model"]) for row in rows] == [(n, model) for n in "01" for model in ("fit", "springs")]
    assert all(0 < float(row["error"]) < 0.5 and float(row["reference"]) < 0.1 for row in rows)


def test_the_fit_claims_less_under_more_waves():
    """Errors times the waves on a side cover punches with one wave as they cover others."""
    measured = calibration.table()["punch", "stiffness", "fit"]
    one = measured.points[:, 1] < math.log10(1.2)
    inside = measured.errors <= measured.factor * measured.left_out()
    assert one.sum() >= 10 and np.mean(inside[one]) >= 0.92
    few, many = (Target(punch(load=5.0, ground=waves(n, 8 * n))) for n in (1, 4))
    assert calibrated(cheap("fit", many), many).error < 0.7 * calibrated(cheap("fit", few), few).error


@catches("a reference of the calibration with the surfaces of the models").at(
    "validation.advice.calibration_solves.OTHER_SEED", 0
)
def test_the_reference_has_surfaces_of_its_own_on_its_finest_grid():
    """Errors beside surfaces that the models were solved on, too, would have no scatter of those in them."""
    seeds = {True: set(), False: set()}

    def noted(one):
        seeds[isinstance(one.model, GridModel)].add(one.target.seed)
        grids = one.model.resolutions(one.target)
        assert one.resolution == max(grids, key=lambda grid: one.model.cost(one.target, grid).seconds)
        one.shared[one.model, one.resolution] = Realisations(prepare=None)
        return Answer(value=np.array([1.0]), cost=Cost(work=1, seconds=1.0))

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(calibration_solves, "try_to_solve", noted)
        for point in CalibrationRun(punches=9, spheres=9, rolling=3, wheels=3).points:
            calibration_solves.measure_errors(point)
    assert seeds[True] and seeds[False] and not seeds[True] & seeds[False]
