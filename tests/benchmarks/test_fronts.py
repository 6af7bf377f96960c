"""The cheapest method and the front of all, of hand-made points; claims about them."""

import dataclasses
import math

import pytest

from tests.benchmarks.made_up import point
from tests.seeded import catches
from validation.analysis.series import numbers_of
from validation.benchmarks.work_precision.case import STUDY, times
from validation.benchmarks.work_precision.pareto import (
    cheapest,
    faster,
    front,
    in_unit_of_error,
    monotone_envelope,
    reason_if_none,
)
from validation.benchmarks.work_precision.problem import BEM, CLOSED, FILTER_3D, MDR, MDR_ROLLING
from validation.simulation.model_names import FILTER_1D

CHART = [
    point("MDR", 0.13, 1e-5, value=16),
    point("MDR", 0.12, 2e-5, value=32),
    point("BEM", 0.2, 1e-4, value=4),
    point("BEM", 0.03, 1e-3, value=8),
    point("BEM", 0.0005, 1e-2, value=16),
    point("BEM", 0.0001, 1e-1, value=32),
    point("plain", 0.03, 2e-3, value=8),
]


def names(found):
    return [(p.method, p.value) for p in found]


@catches("nothing left open by a reference").at(
    "validation.benchmarks.work_precision.pareto.Point.rank", property(lambda point: point.error + point.half_width)
)
def test_the_front_is_what_nothing_beats_and_ends_in_the_band():
    """BEM with 32 cells is closer than with 16, but below what the reference can tell."""
    assert names(front(CHART)) == [("MDR", 16), ("MDR", 32), ("BEM", 8), ("BEM", 16)]
    assert names(front(CHART[::-1])) == names(front(CHART))


def test_of_equals_the_first_stands_on_the_front():
    twins = [point("one", 0.1, 1.0), point("other", 0.1, 1.0)]
    assert names(front(twins)) == [("one", 8.0)]
    assert names(front(twins[::-1])) == [("other", 8.0)]
    # as wrong and dearer, or as dear and worse, is beaten
    assert names(front([*twins[:1], point("dearer", 0.1, 2.0), point("worse", 0.2, 1.0)])) == [("one", 8.0)]


@pytest.mark.parametrize(
    "settings",
    [
        {"off": math.nan, "status": "failed: RuntimeError: lost"},
        {"off": math.nan, "status": "out of range: too few cells"},
        {"off": 0.0, "is_reference": True},
    ],
)
def test_neither_who_has_not_finished_nor_the_reference_is_on_the_front(settings):
    no_part = point("none", seconds=1e-9, **settings)
    assert names(front([no_part, *CHART])) == names(front(CHART))
    assert front([no_part]) == []


@catches("errors ranked without their intervals").at(
    "validation.benchmarks.work_precision.pareto.Point.rank", property(lambda point: max(point.error, point.band))
)
def test_errors_are_ranked_by_their_upper_ends():
    sure, unsure = point("sure", 0.02, 1.0), point("unsure", 0.01, 0.5, half_width=0.5)
    assert cheapest([sure, unsure], 0.1).method == "sure"
    assert cheapest([sure, dataclasses.replace(unsure, half_width=0.05)], 0.1).method == "unsure"


def test_luck_is_what_more_of_the_same_does_not_keep():
    """The largest upper end at finer settings of the same method; no others, and nobody who is lost."""
    chart = [
        point("a", 0.01, 1.0),
        point("a", 0.2, 2.0),
        point("a", 0.05, 3.0, half_width=0.01),
        point("a", 0.9, 9.0, status="failed: lost"),
        point("b", 0.8, 1.0),
    ]
    found = monotone_envelope(chart)
    assert [p.finer for p in found] == pytest.approx([0.2, 0.06, 0.0, 0.0, 0.0])
    assert [p.rank for p in found[:3]] == pytest.approx([0.2, 0.2, 0.06])


def test_the_cheapest_within_a_tolerance():
    """Which is met where it is just met."""
    assert [cheapest(CHART, t).value for t in (0.3, 0.125, 0.12, 0.1, 0.01, 1e-3)] == [16, 32, 32, 8, 16, 16]
    assert cheapest(CHART, 1e-4) is None
    assert cheapest(CHART[:3], 0.01) is None
    assert in_unit_of_error(0.3, "%") == 0.3
    assert in_unit_of_error(0.3, "dB") == pytest.approx(20 * math.log10(1.3))


@pytest.mark.parametrize(("band", "why"), [(0.01, "none"), (0.0100001, "the reference cannot tell")])
def test_why_there_is_no_cheapest(band, why):
    assert reason_if_none([point("a", 0.5, 1.0, band=band)], 0.01) == why


def timed_point(line, off, seconds):
    return point(line, off, seconds, runs=100, unit="%")


BESIDE_SPRINGS = [
    timed_point(CLOSED, 0.5, 1e-6),
    timed_point(MDR, 0.2, 1e-5),
    timed_point(MDR_ROLLING, 0.1, 1e-4),
    timed_point(BEM, 0.05, 1e-2),
    timed_point(BEM, 0.01, 1e-1),
]


@catches(
    "a time beside that of a method that is not as close",
    another=timed_point(FILTER_1D, 0.3, 1e-6),
    status="supported",
    rivals=(BEM, BEM),
).at(
    "validation.benchmarks.work_precision.case.cheapest_as_close",
    lambda _, others: min(others, key=lambda one: one.seconds[1], default=None),
)
@pytest.mark.parametrize(
    ("another", "status", "rivals"),
    [
        # cheaper, but not as close
        (timed_point(FILTER_1D, 0.3, 1e-6), "supported", (BEM, BEM)),
        # as close as the closest springs, and cheaper than these alone
        (timed_point(FILTER_1D, 0.1, 5e-5), "refuted", (FILTER_1D, BEM)),
        (timed_point(FILTER_3D, 0.05, 1e-3), "refuted", (FILTER_3D, FILTER_3D)),
        # times whose intervals overlap
        (timed_point(FILTER_1D, 0.1, 0.99e-4), "inconclusive", (FILTER_1D, BEM)),
    ],
)
def test_the_cheapest_is_claimed_of_times(another, status, rivals):
    """At every error that springs reach, and at every smaller one; one error decides."""
    numbers = numbers_of(times([*BESIDE_SPRINGS, another]))
    assert STUDY.claims[0].judged(numbers).status == status
    assert tuple(number.source for number in numbers) == rivals


@catches("times beside a grid that is not as close").at(
    "validation.benchmarks.work_precision.pareto.cheapest_as_close",
    lambda _, others: min(others, key=lambda one: one.seconds[1], default=None),
)
def test_times_faster_are_those_of_the_cheapest_boundary_elements_with_no_larger_error():
    """At the least error of springs, 0.12: not the coarsest grid, whose error is larger, nor a finer and dearer one."""
    springs = [point(MDR, 0.13, 1e-5), point(MDR, 0.12, 2e-5), point(MDR, 0.12, 4e-5)]
    elements = [point(BEM, 0.2, 1e-4), point(BEM, 0.1, 1e-3, half_width=0.01), point(BEM, 0.01, 1e-2)]
    table = faster([[*springs, *elements]])
    assert table["times faster"].tolist() == pytest.approx([1e-3 / 2e-5])
    assert table["error"].tolist() == pytest.approx([12.0])
    assert table["error of boundary elements"].tolist() == pytest.approx([11.0])


@catches("times that are known exactly").at("validation.benchmarks.work_precision.pareto._uncertainty", lambda _: 0.0)
def test_times_faster_have_the_intervals_of_both_medians():
    """Of 16 runs whose quartiles are 0.3 of the median apart: 1.57 x 0.3 / 4 each."""
    table = faster([[point(MDR, 0.1, 1e-5, runs=16), point(BEM, 0.1, 1e-3, runs=16)]])
    half = 100 * math.sqrt(2) * 1.57 * 0.3 / 4
    assert [table["from"][0], table["to"][0]] == pytest.approx([100 - half, 100 + half])


def test_nothing_is_faster_where_no_boundary_elements_are_as_close():
    assert faster([[point(MDR, 0.01, 1e-5), point(BEM, 0.1, 1e-3)]])["scene"].size == 0
