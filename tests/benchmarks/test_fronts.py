"""The cheapest method and the front of all, of hand-made points; claims about them."""

import dataclasses
import math

import pytest

from tests.benchmarks.made_up import point
from tests.seeded import catches
from validation.analysis.evidence import Verdict
from validation.analysis.series import numbers_of
from validation.benchmarks.work_precision import pareto
from validation.benchmarks.work_precision.case import STUDY, times
from validation.benchmarks.work_precision.pareto import (
    FACTOR,
    cheapest,
    cheapest_settings,
    front,
    monotone_envelope,
)
from validation.benchmarks.work_precision.problem import BEM, BEM_METHOD, CLOSED, FILTER_3D, MDR, MDR_ROLLING
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
    "validation.benchmarks.work_precision.pareto.Point.rank", property(lambda point: point.error)
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


UPPER_END = property(lambda point: max(point.error + point.half_width, point.band, point.finer))


@catches("the cheapest setting chosen by the upper end of its interval").at(
    "validation.benchmarks.work_precision.pareto.Point.rank", UPPER_END
)
def test_the_cheapest_setting_is_chosen_by_its_error_and_judged_by_its_interval():
    """Whoever has fewer surfaces is not dearer for that: the interval says that it is inconclusive."""
    unsure, sure = point("unsure", 0.08, 0.5, half_width=0.05), point("sure", 0.02, 1.0, half_width=0.01)
    assert cheapest([sure, unsure], 0.1).method == "unsure"
    assert unsure.verdict(0.1) == Verdict.INCONCLUSIVE and sure.verdict(0.1) == Verdict.WITHIN
    assert unsure.verdict(0.02) == Verdict.OUTSIDE
    # what the reference leaves open counts too
    assert point("sure", 0.02, 1.0, half_width=0.01, band=0.071).verdict(0.1) == Verdict.INCONCLUSIVE


def test_luck_is_what_more_of_the_same_does_not_keep():
    """The largest error at finer settings of the same method; no others, and nobody who is lost."""
    chart = [
        point("a", 0.01, 1.0),
        point("a", 0.2, 2.0, half_width=0.3),
        point("a", 0.05, 3.0, half_width=0.01),
        point("a", 0.9, 9.0, status="failed: lost"),
        point("b", 0.8, 1.0),
    ]
    enveloped = monotone_envelope(chart)
    assert [p.finer for p in enveloped] == pytest.approx([0.2, 0.05, 0.0, 0.0, 0.0])
    assert [p.rank for p in enveloped[:3]] == pytest.approx([0.2, 0.2, 0.05])
    assert cheapest(enveloped[:1], 0.1) is None


def test_the_cheapest_within_a_tolerance():
    """Which is met where it is just met; nothing is within less than the reference leaves open."""
    assert [cheapest(CHART, t).value for t in (0.3, 0.125, 0.12, 0.1, 0.01, 1e-3)] == [16, 32, 32, 8, 16, 16]
    assert cheapest(CHART, 1e-4) is None
    assert cheapest(CHART[:3], 0.01) is None
    assert cheapest([point("a", 0.0, 1.0, band=0.011)], 0.01) is None


def timed_point(line, off, seconds):
    return point(line, off, seconds, runs=100, unit="%")


BESIDE_SPRINGS = [
    timed_point(CLOSED, 0.5, 1e-6),
    timed_point(MDR, 0.2, 1e-5),
    timed_point(MDR_ROLLING, 0.1, 1e-4),
    timed_point(BEM, 0.02, 1e-2),
    timed_point(BEM, 0.01, 1e-1),
]


@catches(
    "a time beside that of a method that is not as close",
    another=timed_point(FILTER_1D, 0.3, 1e-6),
    status="supported",
    rivals=(BEM, BEM),
).at(
    "validation.benchmarks.work_precision.case.cheapest",
    lambda points, tolerance: min(points, key=lambda one: one.seconds[1], default=None),
)
@pytest.mark.parametrize(
    ("another", "status", "rivals"),
    [
        # cheaper, but not within 10 %
        (timed_point(FILTER_1D, 0.3, 1e-6), "supported", (BEM, BEM)),
        # within 10 % as springs are, and cheaper
        (timed_point(FILTER_1D, 0.1, 5e-5), "refuted", (FILTER_1D, BEM)),
        # within 3 %, which springs do not reach
        (timed_point(FILTER_3D, 0.03, 1e-3), "refuted", (FILTER_3D, FILTER_3D)),
        # times whose intervals overlap
        (timed_point(FILTER_1D, 0.1, 0.99e-4), "inconclusive", (FILTER_1D, BEM)),
    ],
)
def test_the_cheapest_is_claimed_of_times(another, status, rivals):
    """Within each tolerance that springs reach, and within the others; one tolerance decides."""
    numbers = numbers_of(times([*BESIDE_SPRINGS, another]))
    assert STUDY.claims[0].judged(numbers).status == status
    assert tuple(number.source for number in numbers) == rivals


def settings_of(*chart):
    """Rows of the cheapest settings by tolerance [%] and method."""
    table = cheapest_settings([monotone_envelope(chart)])
    rows = [dict(zip(table.columns, row, strict=True)) for row in zip(*table.columns.values(), strict=True)]
    return {(row["tolerance"], row["method"]): row for row in rows}


ROW_OF_SETTING = pareto._row_of_setting
MIXED = [
    point(MDR, 0.08, 1e-5, value=8, half_width=0.01, runs=16),
    point(MDR, 0.02, 4e-5, value=32, half_width=0.005, runs=16),
    point(BEM, 0.2, 1e-4, value=4),
    point(BEM, 0.09, 1e-3, value=8, half_width=0.02, runs=16),
    point(BEM, 0.005, 1e-2, value=16, half_width=0.001, runs=16),
]


def with_the_error_of_the_finest(method, of_row, tolerance, meets, factor):
    finest = {"error": MIXED[1].error, "half_width": MIXED[1].half_width}
    mixed = dataclasses.replace(of_row, **finest) if of_row.method == MDR else of_row
    return ROW_OF_SETTING(method, mixed, tolerance, meets, factor)


@catches("the error of one setting beside the time of another").at(
    "validation.benchmarks.work_precision.pareto._row_of_setting", with_the_error_of_the_finest
)
def test_error_and_time_of_a_row_are_of_one_setting():
    """Within 10 % of the coarse ones, within 3 % of the fine ones; within 1 % springs have none."""
    rows = settings_of(*MIXED)
    told = {key: (row["setting"], row["error"], row["± sample"], row["time [s]"]) for key, row in rows.items()}
    assert told[10, MDR] == ("8 cells", pytest.approx(8), pytest.approx(1), 1e-5)
    assert told[3, MDR] == told[1, MDR] == ("32 cells", pytest.approx(2), pytest.approx(0.5), 4e-5)
    assert told[10, BEM_METHOD] == ("8 cells", pytest.approx(9), pytest.approx(2), 1e-3)
    assert told[3, BEM_METHOD] == told[1, BEM_METHOD] == ("16 cells", pytest.approx(0.5), pytest.approx(0.1), 1e-2)
    assert [rows[t, MDR]["a setting within"] for t in (10, 3, 1)] == [True, True, False]
    verdicts = [Verdict.WITHIN, Verdict.WITHIN, Verdict.OUTSIDE]
    assert [rows[t, MDR]["verdict"] for t in (10, 3, 1)] == verdicts
    assert rows[10, BEM_METHOD]["verdict"] == "inconclusive"


@catches("times beside those of boundary elements within another tolerance").at(
    "validation.benchmarks.work_precision.pareto.cheapest",
    lambda points, tolerance: min(points, key=lambda one: one.seconds[1]),
)
def test_times_faster_are_those_of_the_cheapest_settings_within_the_same_tolerance():
    rows = settings_of(*MIXED)
    assert (rows[10, MDR][FACTOR], rows[3, MDR][FACTOR]) == pytest.approx((1e-3 / 1e-5, 1e-2 / 4e-5))
    assert math.isnan(rows[1, MDR][FACTOR]) and math.isnan(rows[3, BEM_METHOD][FACTOR])


@catches("an interval of times that is dropped from a front").at(
    "validation.benchmarks.work_precision.pareto._uncertainty", lambda _: 0.0
)
def test_both_times_and_their_ratio_have_intervals():
    """Of 16 runs whose quartiles are 0.3 of the median apart: 1.57 x 0.3 / 4 each."""
    row, elements = (settings_of(*MIXED)[10, method] for method in (MDR, BEM_METHOD))
    part = 1.57 * 0.3 / 4
    for of_one, median in ((row, 1e-5), (elements, 1e-3)):
        ends = of_one["time from [s]"], of_one["time to [s]"]
        assert ends == pytest.approx((median * (1 - part), median * (1 + part)))
    half = 100 * math.sqrt(2) * part
    assert (row["factor from"], row["factor to"]) == pytest.approx((100 - half, 100 + half))


def test_levels_have_tolerances_of_their_own():
    table = cheapest_settings(
        [[point(MDR, 2.5, 1e-5, unit="dB", band=0.1), point(BEM, 0.4, 1e-3, unit="dB", band=0.1)]]
    )
    assert table["tolerance"].tolist() == [3.0, 3.0, 1.0, 1.0]
    assert table["error"].tolist() == [2.5, 0.4, 2.5, 0.4]
    assert table["a setting within"].tolist() == [True, True, False, True]


def test_nothing_is_faster_where_no_boundary_elements_are_within_the_tolerance():
    (ten, three, one) = (settings_of(point(MDR, 0.01, 1e-5), point(BEM, 0.2, 1e-3))[t, MDR] for t in (10, 3, 1))
    assert all(row["a setting within"] and math.isnan(row[FACTOR]) for row in (ten, three, one))
