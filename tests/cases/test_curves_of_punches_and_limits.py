"""What figures of rough punches and tables of limits show beside their numbers, on outcomes made up."""

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.cases.test_fractal_punch import LEVELS
from tests.cases.test_limits import STEEP
from validation.analysis.case import Outcomes
from validation.analysis.series import tables_of
from validation.cases.limits import limits
from validation.cases.limits.sweeps import Sweep
from validation.cases.punch import fractal_punch as punch
from validation.cases.punch.bandwidth import Bandwidth
from validation.cases.punch.ensembles import FEW, FORCE
from validation.simulation.model_names import BEM
from validation.simulation.model_names import SPRINGS as MDR
from validation.simulation.rough_punch import FEW_CELLS

CASE = replace(LEVELS, surfaces=((0, 0, 12, 8, 5),) * 2, profiles=12, fine_profiles=12)
AREA = np.array([1e-4, 2e-3, 0.02, 0.1, 0.5])
"""Of boundary elements at each force; springs touch on half of it."""


@pytest.fixture(scope="module")
def tables():
    force = CASE.height * np.array(CASE.forces)
    rng = np.random.default_rng(3)

    def outcome(count, area):
        stiffness = (1 + 0.1 * rng.standard_normal((count, 1))) * np.sqrt(force)
        return {"stiffness": stiffness, "approach": 2 * force / stiffness, "area": area * np.ones((count, 1))}

    found = {(0.7, BEM, cells): outcome(count, AREA) for cells, count in CASE.counts(1.0).items()}
    found |= {
        (0.7, method, points): outcome(12, AREA / 2)
        for method in (MDR, punch.LONG)
        for points in (CASE.points, 2 * CASE.points)
    }
    series = list(punch.curves(punch.PunchStatistics(Outcomes(CASE, found)), 0.7))
    return {table.name: table for table in tables_of(series)}


def test_the_contact_is_a_share_of_the_face_on_the_finest_grid(tables):
    bem, springs = (tables[punch.FRACTION].where(model=model)["value"] for model in (BEM, MDR))
    np.testing.assert_allclose(bem, AREA)
    np.testing.assert_allclose(springs, AREA / 2)


def test_symbols_are_open_where_the_contact_has_few_cells(tables):
    """On 32 a side; the values are those of all symbols."""
    few = 32**2 * AREA < FEW_CELLS
    assert few.any() and not few.all()
    for quantity in (punch.STIFFNESS, punch.SCATTER, punch.SLOPE):
        bem, marked = (tables[quantity].where(model=model)["value"] for model in (BEM, FEW))
        assert np.isfinite(bem).all() and np.isfinite(marked).tolist() == few.tolist()
        np.testing.assert_array_equal(marked[few], bem[few])


def test_the_power_law_goes_through_the_middle_and_ends_where_most_of_the_face_carries(tables):
    law = tables[punch.STIFFNESS].where(model=punch.LAW)
    force = np.array(CASE.forces)
    assert np.isfinite(law["value"]).tolist() == (force <= 1).tolist() and (force > 1).any()
    bem, middle = tables[punch.STIFFNESS].where(model=BEM)["value"], len(force) // 2
    known = force <= 1
    np.testing.assert_allclose(law["value"][known], bem[middle] * (force[known] / force[middle]) ** (1 / 1.7))
    assert set(tables[punch.SLOPE].where(model=punch.LAW)["value"]) == {1 / 1.7}
    np.testing.assert_allclose(law[FORCE], force)


def test_surfaces_are_those_of_the_grid_that_has_the_most(tables):
    assert tables["surfaces"]["value"].tolist() == [12.0] * len(CASE.forces)


def test_intervals_of_a_claim_hold_for_all_decades_of_two_quantities():
    assert CASE.family(3) == 2 * 2 * 3
    assert Bandwidth(decades=(-3, 1)).family(5) == 2 * 4 * 5


# --- the table of limits ---


@pytest.mark.parametrize(("side", "sign"), [("above", ">"), ("below", "<")])
@pytest.mark.parametrize(("derived", "by"), [(True, "by theory"), (False, "by an estimate")])
@pytest.mark.parametrize(("predicted", "words"), [(2.0, "as predicted"), (40.0, "elsewhere")])
def test_a_row_says_on_which_side_a_method_fails_and_how_that_is_known(side, sign, derived, by, predicted, words):
    x = np.array([0.25, 0.5, 1.0, 2.0, 4.0, 8.0])
    error = x**2 if side == "above" else 16 / x**2
    limit = replace(
        STEEP, fails=STEEP.fails._replace(side=side), judged=STEEP.judged._replace(derived=derived, warned=True)
    )
    row = limits.summarised(Sweep(limit, x, error, predicted, tuple("words" if e > 4 else "" for e in error)))
    assert row["fails where"] == f"x {sign} {predicted:g}: x = 2"
    assert row["error"] == "y above 4; reference: nothing"
    assert row["within"] == f"a factor 1.5, {by}"
    assert row["fails at"] == f"2, {words}"
    share = row["values with the right message, or with none"]
    assert (share == "100 %") is (predicted == 2.0)
    assert (row["message of the software"] == "words") is (predicted == 2.0 or side == "below")


def test_a_message_is_marked_where_there_is_one():
    sweep = Sweep(STEEP, np.array([0.5, 1.0, 3.0, 4.0]), np.array([0.1, 1.0, 9.0, math.inf]), 2.0, ("", "", "w", "w"))
    (table,) = tables_of(list(limits.shown(sweep)))
    marked, none = (table.where(model=model)["value"] for model in ("message", "no answer"))
    assert marked.tolist() == pytest.approx([math.nan, math.nan, 9.0, math.nan], nan_ok=True)
    assert np.isfinite(none).tolist() == [False, False, False, True] and none[3] >= 4 * STEEP.fails.tolerance
