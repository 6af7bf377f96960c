"""Verdicts and statistics: intervals that cover, and verdicts that follow from them."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from validation.analysis.evidence import Evidence, Number, Role, Table, Verdict, grouped
from validation.analysis.statistics import Estimate

reals = st.floats(-1e3, 1e3)
sizes = st.floats(0, 1e3)


def number(**changes):
    given = {"quantity": "x", "value": 1.0, "reference": 1.0, "source": "s", "tolerance": 0.1, "reason": "r", **changes}
    return Number(**given)


@given(value=reals, reference=reals, tolerance=sizes, grid=sizes, sample=sizes)
def test_verdicts_follow_from_the_interval(value, reference, tolerance, grid, sample):
    n = number(value=value, reference=reference, tolerance=tolerance, grid=grid, sample=sample)
    ends = [abs(value - reference) + side * (grid + sample) for side in (-1, 1)]
    expected = {
        Verdict.WITHIN: ends[1] <= tolerance,
        Verdict.OUTSIDE: ends[0] > tolerance,
        Verdict.INCONCLUSIVE: ends[0] <= tolerance < ends[1],
    }
    assert expected[n.verdict]
    assert sum(expected.values()) == 1


def test_a_criterion_must_agree_and_a_finding_need_not():
    assert number().met
    assert not number(value=2.0).met
    assert not number(sample=1.0).met
    assert number(value=2.0, role=Role.FINDING).met
    assert number(role=Role.IDENTITY).met and not number(value=2.0, role=Role.IDENTITY).met


@pytest.mark.parametrize("name", ["value", "reference", "tolerance", "grid", "sample"])
def test_numbers_are_finite(name):
    with pytest.raises(ValueError, match=name):
        number(**{name: np.nan})


def test_tables_have_columns_of_one_length():
    with pytest.raises(ValueError, match="one length"):
        Table("t", {"a": [1, 2], "b": [1]})
    assert Table("t", {"a": [1, 2, 1], "b": [4, 5, 6]}).where(a=1)["b"].tolist() == [4, 6]


@given(value=reals, tolerance=sizes, grid=sizes, sample=st.floats(1e-3, 1e3))
def test_so_much_more_of_a_sample_would_decide(value, tolerance, grid, sample):
    """A little more than the factor named, and the interval of the sample that belongs to it decides; a little less
    does not; where no sample would, the factor is infinite."""
    n = number(value=value, reference=0.0, tolerance=tolerance, grid=grid, sample=sample)
    for more in (1.001, 0.999):
        factor = n.sample_needed * more
        if np.isfinite(factor) and factor > 0:
            other = number(value=value, reference=0.0, tolerance=tolerance, grid=grid, sample=sample / factor**0.5)
            assert (other.verdict is Verdict.INCONCLUSIVE) == (more < 1)
    if np.isinf(n.sample_needed):
        other = number(value=value, reference=0.0, tolerance=tolerance, grid=grid, sample=1e-9 * sample)
        assert other.verdict is Verdict.INCONCLUSIVE


@given(a=st.floats(0.01, 10), b=st.floats(0.01, 10), n=st.integers(3, 100), m=st.integers(3, 100))
def test_difference_of_estimates(a, b, n, m):
    apart = Estimate(3.0, a, n).minus(Estimate(1.0, b, m))
    assert apart.value == 2.0
    assert apart.error == pytest.approx(np.hypot(a, b))
    assert min(n, m) - 1 <= apart.samples <= n + m


def test_rows_are_grouped_by_the_values_of_columns_in_their_order():
    table = Table("t", {"kind": ["b", "a", "b"], "x": [1.0, 2.0, 4.0]})
    found = grouped("g", table, ("kind",), {"sum": lambda t: float(t["x"].sum()), "rows": lambda t: len(t["x"])})
    assert (found.name, found.columns) == ("g", {"kind": ["b", "a"], "sum": [5.0, 2.0], "rows": [2, 1]})


def evidence(numbers):
    return Evidence(title="t", method="", numbers=numbers, tables=(), conclusions=(), captions={})


@pytest.mark.parametrize("models", ["aab", "abb", "aba"])
def test_two_numbers_of_one_label_are_refused(models):
    with pytest.raises(ValueError, match=rf"twice: \['{max(models, key=models.count)}: x'\]$"):
        evidence([number(model=model) for model in models])


def test_numbers_that_differ_in_a_part_of_their_key_have_labels_of_their_own():
    keys = {"quantity": "y"}, {"model": "m"}, {"where": {"H": 0.7}}, {"where": {"H": 0.8}}, {"where": {"band": "low"}}
    assert len(evidence([number(), *(number(**key) for key in keys)]).numbers) == 1 + len(keys)


def test_a_table_is_there_if_one_has_the_name():
    tables = (Table("a", {"x": [1.0]}), Table("b", {"x": [2.0]}))
    some = Evidence(title="t", method="m", numbers=(), tables=tables, conclusions=(), captions={})
    assert some.has_table("b") and not some.has_table("c")
