"""Faults that once lived in declared series and claims, and in what cases declare: each test kills some of them."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest

from tests.analysis.test_declared_claims import AGREE, DIFFER, by_height
from tests.analysis.test_declared_claims import number as planted
from tests.analysis.test_judged_claims import point
from validation.analysis.claims import Claim, Matrix, beside
from validation.analysis.evidence import ClaimStatus, Role, Verdict
from validation.analysis.margins import MARGINS
from validation.analysis.over_range import worst
from validation.analysis.series import Estimates, Margin, Series, masked, single, spans, tables_of
from validation.analysis.statistics import Estimate
from validation.analysis.study import Outcomes, Settings, Study


def test_limits_end_where_one_of_several_quantities_does_not_agree():
    numbers = [*by_height(AGREE, AGREE), *by_height(AGREE, DIFFER, quantity="slope")]
    judged = Claim(says="It is so.", along="h/d").judged(numbers)
    assert (judged.status, judged.limits) == (ClaimStatus.LIMITED, "h/d up to 0.1")


@pytest.mark.parametrize(("along", "limits"), [("q", "q up to 8"), ("-q", "q from 2 on")])
def test_limits_along_ranges_end_at_the_far_end_of_the_last_that_agrees(along, limits):
    ranges = ((1.0, 2.0), (2.0, 4.0), (4.0, 8.0), (8.0, 16.0))
    verdicts = (AGREE, AGREE, AGREE, DIFFER)
    pairs = zip(verdicts if along == "q" else verdicts[::-1], ranges, strict=True)
    judged = Claim(says="It is so.", along=along).judged([planted(verdict, q=ends) for verdict, ends in pairs])
    assert (judged.status, judged.limits) == (ClaimStatus.LIMITED, limits)


def test_a_condition_may_be_a_type():
    numbers = [planted(AGREE, H=0.7), planted(DIFFER, H="mean over H")]
    assert Claim(says="", where={"H": float}).numbers(numbers) == numbers[:1]
    assert Claim(says="", where={"H": str}).numbers(numbers) == numbers[1:]


def test_an_undecided_point_is_worse_than_one_that_agrees_with_a_wider_interval():
    """Of two that differ, the one whose interval ends farther out."""
    undecided, agrees = point(0.95, 0.1, at=1.0), point(0.0, 0.9, at=2.0)
    assert worst([agrees, undecided]).verdict is Verdict.UNDECIDED
    assert worst([point(6.0, 2.0, at=1.0), point(3.0, 0.4, at=2.0)]).where["q a"] == 1.0


def test_a_cell_says_how_many_times_the_sample_would_decide():
    """0.3 left beside 0.2 of room takes (0.3 / 0.2)² = 2.25; beside 0.02 of room, too many to say."""
    numbers = [point(value, 0.3, where={"H": h}) for h, value in (("a", 0.8), ("b", 0.98), ("c", 0.2))]
    cells = Matrix(name="t", quantity="level", rows=("H",), columns="model").table(numbers).columns["m"]
    assert [cell.after for cell in cells] == ["needs 2.3 times the sample", "", ""]


def test_what_is_exact_has_no_sample_and_an_absolute_margin_knows_no_scale():
    margin = Margin(tolerance=0.3, reason="r").beside("theory")
    (exact,) = Series("x", "m", (2.0,), reference=1.0, scale=5.0, grid=0.1, margin=margin).numbers
    assert (exact.value, exact.reference, exact.sample, exact.grid) == (10.0, 5.0, 0.0, 0.5)
    assert (exact.tolerance, exact.source) == (0.3, "theory")
    (alone,) = single("x", "m", 2.0, 0.1, "s", "r", where={"band": (1.0, 2.0)}).numbers
    assert (alone.where, alone.tolerance, alone.role) == ({"band": (1.0, 2.0)}, 0.1, Role.CRITERION)
    (table,) = tables_of([Series("x", "m", (2.0,), where={"band": (1.0, 2.0)})])
    assert table["band"].tolist() == ["1 to 2"]


def test_what_is_masked_is_judged_nowhere_and_kept_elsewhere():
    values = Estimates(Estimate(x, 0.1, 5) for x in (9.0, 0.1, 0.2))
    kept = masked(values, np.array([False, True, True]))
    assert math.isnan(kept[0].value) and kept[1:] == list(values[1:])
    (found,) = Series("x", "m", kept, along="q", at=(1.0, 2.0, 4.0), margin=Margin(tolerance=1.0, reason="r")).numbers
    assert found.where["q"] == (2.0, 4.0) and found.verdict is Verdict.AGREE


def test_sums_and_ratios_of_estimates_are_taken_element_by_element():
    one, other = (Estimates(Estimate(x, 0.1, 5) for x in values) for values in ((1.0, 2.0), (0.5, 4.0)))
    assert (one + other).values.tolist() == [1.5, 6.0] and (one - other).values.tolist() == [0.5, -2.0]
    assert [x.error for x in one - other] == pytest.approx([0.1 * math.sqrt(2)] * 2)
    exact = Estimates.exact([1.0, 2.0])
    assert exact.values.tolist() == [1.0, 2.0] and [x.error for x in exact] == [0.0, 0.0]
    rows = np.array([[1.0, 8.0], [3.0, 8.0]])
    assert Estimates.ratios(rows, np.ones((2, 2))).values == pytest.approx(np.log([2.0, 8.0]))
    assert Estimates.ratios(rows, np.array([1.0, 4.0])).values == pytest.approx(np.log([2.0, 2.0]))
    assert Estimates.ratios(rows[:, 0], np.ones(2)).values == pytest.approx([math.log(2)])
    for pair in ((one, Estimates(other[:1])), (other[:1], one)):
        with pytest.raises(ValueError, match="zip"):
            Estimates(pair[0]) - Estimates(pair[1])


def test_ends_of_ranges_of_small_values_are_sharp():
    assert list(spans((1e-6, 2e-6, 4e-6), (2e-6, 3e-6))) == [(2e-6, 2e-6)]
    assert list(spans((2e-6, 4e-6), (1e-6, 3e-6), (5e-6, 6e-6))) == [(2e-6, 2e-6)]


@pytest.mark.parametrize("name", MARGINS)
def test_a_shared_margin_is_as_wide_as_its_reason_says(name):
    number, unit = re.match(r"([\d.]+) ?(%|dB)?", MARGINS[name].reason).groups()
    assert MARGINS[name].tolerance == pytest.approx(float(number) / (100 if unit == "%" else 1))
    assert MARGINS[name].relative is (name in ("peak", "jump", "period", "lift-off"))


def test_a_matrix_of_models_has_no_column_of_a_quantity_and_a_study_prints_what_it_names():
    matrix = Matrix(name="t", quantity=("level", "slope"), rows=("h/d",), columns="model")
    assert list(matrix.table(by_height(AGREE)).columns) == ["h/d", "m"]
    assert Settings().format("{c:g}; {d:g}; {e:g}", c=(1, 2, 3), d=(1, 2), e=(1,)) == "1, 2 and 3; 1 and 2; 1"
    one, other = (Series(name, "m", (2.0,)) for name in ("level", "slope"))
    study = Study(title="t", method="m", series=lambda _: [one, other], claims=(), printed=("slope",))
    assert [table.name for table in study.evidence(Outcomes(None, {})).page_tables] == ["slope"]


def test_a_number_is_printed_beside_its_reference_with_the_digits_of_its_tolerance():
    near = point(1234.5, reference=1234.5678, tolerance=1.0)
    assert [beside(replace(near, tolerance=t)) for t in (1.0, 2.0)] == [
        "1234.5 beside 1234.57 dB",
        "1234.5 beside 1234.6 dB",
    ]
    assert [beside(point(x)) for x in (0.5, 0.0, -0.5)] == ["+0.5 dB", "0 dB", "-0.5 dB"]
