"""Evidence of the wheel cases: verdicts after injected errors, the contrast, interrupted ensembles."""

import math
from dataclasses import replace

import numpy as np
import pytest

from tests.cases.planted import DECIBEL, QUICK_3D, ROUNDING, SMALL, TABLE, changed, statuses, times, whole
from tests.seeded import catches
from validation.analysis.evidence import ClaimStatus, Verdict, number_with, numbers_with
from validation.cases.wheel import distance as by_distance
from validation.cases.wheel import half_space, half_space_study, spectrum
from validation.cases.wheel.distance_study import CASE as DISTANCE_CASE
from validation.cases.wheel.ensembles import (
    FIRST,
    FOURTH,
    JUMP,
    LEVEL,
    PEAK,
    PERIOD,
    PLATEAU,
    QUANTITIES,
    SLOPE,
)
from validation.cases.wheel.half_space_study import CASE as CASE_3D
from validation.cases.wheel.half_space_study import LEVELS
from validation.cases.wheel.spectrum_study import CASE
from validation.engine.realisations import NotConvergedError
from validation.simulation import wheel_on_springs
from validation.simulation.motion import natural_periods

LONG = spectrum.WheelSpectrum(
    scene=replace(SMALL, distance=3.0), realisations=20, varied=6, groups=5, batch=10, parameters=False
)
FEW = replace(LONG, scene=SMALL, realisations=10)


@pytest.fixture(scope="module")
def long_wheel():
    return spectrum.run(LONG)


def feature(evidence, name):
    return number_with(evidence.numbers, QUANTITIES[name])


def altered(result, change):
    """Every batch of the base with some arrays changed."""
    name = result.case.scene.name
    return changed(result, {name: [{**one, **change(one)} for one in result[name]]})


@pytest.mark.slow
def test_wheel_evidence_is_whole(long_wheel):
    found = whole(CASE.evidence(long_wheel))
    # an estimate lies within three half-widths of theory, which is 95 % wide, or what is tolerated
    for name in spectrum.SOURCES:
        number = feature(found, name)
        assert abs(number.difference) <= number.tolerance + 2 * number.uncertainty, number.sentence


@pytest.mark.slow
def test_a_fifth_more_acceleration_is_another_level(long_wheel):
    louder = altered(
        long_wheel,
        lambda one: (
            {name: 1.44 * one[name] for name in ("plain", "hann", "levels", "square")}
            | {name: 1.2 * one[name] for name in ("jump", "mean")}
        ),
    )
    before, after = map(CASE.evidence, (long_wheel, louder))
    levels = [evidence.table(LEVEL)["value"] for evidence in (before, after)]
    # bands end below the break, which moves with the floor: not at all where it is the cutoff
    assert 3 <= len(levels[1]) <= len(levels[0])
    for one, other in zip(*levels, strict=False):
        assert other - one == pytest.approx(DECIBEL * math.log(1.44), abs=1e-9)
    assert number_with(after.numbers, LEVEL).verdict is Verdict.OUTSIDE
    for name in (PEAK, JUMP, SLOPE, PERIOD):
        assert feature(after, name).value == pytest.approx(feature(before, name).value, rel=1e-9)
    assert all(number.met for number in after.numbers)


@pytest.mark.slow
def test_a_shifted_axis_is_another_peak_jump_and_period(long_wheel):
    shifted = altered(long_wheel, lambda one: {"omega": 1.04 * one["omega"]})
    before, after = map(CASE.evidence, (long_wheel, shifted))
    for name in (PEAK, JUMP, PERIOD):
        one, other = feature(before, name), feature(after, name)
        # ranges stay, so that a line or two at their ends are others
        assert other.value / one.value == pytest.approx(1.04, rel=0.005), name
        assert other.verdict is Verdict.OUTSIDE, other.sentence
    assert after.claims[0].status is ClaimStatus.REFUTED


@pytest.mark.slow
def test_a_lost_force_is_a_missed_criterion(long_wheel):
    after = CASE.evidence(altered(long_wheel, lambda one: {"balance": one["balance"] + 1e-9}))
    (missed,) = (number for number in after.numbers if not number.met)
    assert "velocity change" in missed.quantity


def test_what_does_not_stand_out_has_no_number():
    """Waves of less than three periods of the oscillation: no slope, no period."""
    case = replace(LONG, scene=replace(SMALL, ground=replace(SMALL.rail, shortest=2e-3)), realisations=10)
    found = whole(CASE.evidence(spectrum.run(case)))
    missing = {QUANTITIES[name] for name in spectrum.SOURCES} - {number.quantity for number in found.numbers}
    assert missing == {QUANTITIES[name] for name in (SLOPE, PERIOD)}


@pytest.mark.slow
def test_one_parameter_at_a_time():
    case = replace(FEW, groups=2, parameters=True)
    names = list(case.variations())
    assert len(names) == len(set(names)) == 11
    found = whole(CASE.evidence(spectrum.run(case)))
    factors = {"v₀ × 0.25": 0.25, "v₀ × 2": 2.0, "q_min × 0.5": 0.5, "q_min × 2": 2.0, "H = 1": 1.0}
    for name, factor in factors.items():
        jump = number_with(found.numbers, QUANTITIES[JUMP], changed=name)
        assert jump.reference == pytest.approx(factor * SMALL.jump)
    # the height is not among the parameters that the book names
    places = [number.where.get(spectrum.CHANGED) for number in found.claims[0].numbers]
    assert {"unchanged", "H = 0.4", "q_max × 2"} < set(places) and not {"h₀ × 0.25", "h₀ × 4"} & set(places)


@pytest.mark.parametrize(("of", "case"), [(spectrum, LONG), (by_distance, by_distance.WheelDistance())])
def test_a_scene_without_the_roughness_of_its_case_is_refused(of, case):
    with pytest.raises(ValueError, match="scene must have a rough rail"):
        of.run(replace(case, scene=replace(TABLE, ground=None)))


# --- distances ---

DISTANCE = by_distance.WheelDistance(
    scene=SMALL, doublings=3, wheels=24, fewest=12, steady=24, heights=(0.5, 1.0), groups=4
)


@pytest.fixture(scope="module")
def distances():
    return by_distance.run(DISTANCE)


@pytest.mark.slow
def test_distance_evidence_is_whole(distances):
    found = whole(DISTANCE_CASE.evidence(distances))
    assert number_with(found.numbers, by_distance.BREAK_LAW).reference == pytest.approx(1 / 2.4, rel=ROUNDING)
    # the line has the slope of the law and goes through the middle of the breaks
    breaks = found.table(by_distance.BREAK_AT)
    line, points = (breaks.where(model=model) for model in ("T^(1/(2H+1))", "found"))
    slope = np.diff(np.log(line["value"])) / np.diff(np.log(line[by_distance.DURATION]))
    assert slope == pytest.approx(np.full(slope.size, 1 / 2.4), rel=1e-9)
    assert np.mean(np.log(line["value"])) == pytest.approx(np.mean(np.log(points["value"])), rel=1e-12)


@pytest.mark.slow
def test_regions_1_and_2_are_second_order_and_region_4_is_leakage(distances):
    """A dozen wheels: within three half-widths of the closed second order; of a linear contact nothing is there."""
    numbers = DISTANCE_CASE.evidence(distances).numbers
    over = numbers_with(numbers, by_distance.OVER)
    assert len(over) == 5
    for number in over:
        assert abs(number.value) <= 1.0 + 2 * number.uncertainty, number.sentence
    for region in (FIRST, PLATEAU):
        for record, room in ((by_distance.PERIODIC, 1e-18), (by_distance.HANN, 0.05)):
            share = number_with(numbers, by_distance.SHARE, by_distance.LINEAR, region=region, record=record)
            assert 0 < share.value < room, share.sentence
    for record in by_distance.WITHOUT_LEAKAGE:
        assert number_with(numbers, by_distance.SHARE, region=FOURTH, record=record).value < 0.02


@pytest.mark.slow
def test_a_linear_contact_as_loud_as_springs_or_a_louder_second_order_is_noticed(distances):
    """Springs in the place of the linear contact; of regions 1 and 2 twice as much; a record with its leak for a
    periodic motion."""
    steady, part = by_distance.STEADY, by_distance.PART
    linear = part._replace(model=by_distance.LINEAR)
    louder = {key: times([distances[key]], 2.0, "plain")[0] for key in (steady, (steady, 0.5))}
    planted = {linear: distances[part]}, {steady: distances[part]}, louder
    found = [DISTANCE_CASE.evidence(changed(distances, one)) for one in planted]
    assert [statuses(one)[i] for i, one in enumerate(found)] == 3 * [ClaimStatus.REFUTED]


def test_distances_take_whole_natural_periods_and_double():
    length = [ride.steps * ride.scene.spacing for ride in reversed(DISTANCE.distances().values())]
    for i, one in enumerate(length):
        # to the next length that an FFT is fast at: a part in a hundred
        periods = natural_periods(SMALL.body, one, SMALL.speed)
        assert 2**i * (1 - ROUNDING) <= periods == pytest.approx(2**i, rel=0.02)


@pytest.mark.slow
def test_wheels_that_do_not_repeat_themselves_are_no_evidence(monkeypatch):
    monkeypatch.setattr(wheel_on_springs, "STEADY_TOLERANCE", -1.0)
    few = {"doublings": 0, "wheels": 4, "fewest": 4, "steady": 4}
    with pytest.raises(NotConvergedError, match="most wheels of an ensemble do not repeat their motion") as caught:
        by_distance.run(replace(DISTANCE, scene=replace(SMALL, distance=0.05), **few))
    assert caught.value.unconverged[0].startswith("4 of 4 wheels do not repeat their motion, h₀ = 5e-07 m")
    monkeypatch.setattr(half_space, "simulate_strip", lambda strip: {"failed": np.array(0.0)})
    with pytest.raises(NotConvergedError, match="wheels on springs do not repeat their motion") as caught:
        half_space.run(QUICK_3D)
    assert caught.value.unconverged == ("20 of 20, springs, Geike's rule", "20 of 20, springs, rolling spectrum")


# --- three dimensions ---


@pytest.fixture(scope="module")
def in_3d():
    return half_space.run(QUICK_3D)


@pytest.mark.slow
def test_evidence_in_three_dimensions_is_whole(in_3d):
    found = whole(CASE_3D.evidence(in_3d))
    geike, theory = (
        number_with(found.numbers, LEVEL, half_space.OVER_BEM[model], range="region 2")
        for model in (half_space.GEIKE, half_space.LINEAR_3D)
    )
    assert geike.verdict is Verdict.OUTSIDE and geike.value < -10
    assert abs(theory.difference) <= theory.tolerance + theory.uncertainty
    assert found.claims[0].status is ClaimStatus.REFUTED
    assert np.isfinite(found.table(LEVELS).where(model=half_space.BEM)["value"]).all()


@pytest.mark.slow
def test_a_strip_that_was_lost_counts_in_nothing(in_3d):
    *others, last = in_3d["strips"]
    found = changed(in_3d, strips=[*others, last | {"failed": np.array(1.0), "bem": np.nan * last["bem"]}])
    whole(CASE_3D.evidence(found))


# --- the contrast of the oscillation ---


def with_filled_zeros(share, lines=60):
    """A of region 3 as sin²(q a), a share of it replaced by its mean; lines to a period."""
    period = TABLE.oscillation_period
    omega = period / lines * np.arange(1, math.ceil(1.2 * TABLE.cutoff / period * lines))
    wave = np.sin(np.pi * omega / period) ** 2
    return omega, ((1 - share) * wave + share / 2) * omega ** (-2 * TABLE.rail.hurst - 3)


zeros_of = half_space_study.zeros_of


@catches("a contrast read at the maxima", share=0.1).at(
    "validation.cases.wheel.half_space_study.zeros_of", lambda scene: zeros_of(scene) + 0.5
)
@pytest.mark.parametrize("share", [0.01, 0.1, 0.5, 1.0])
def test_the_contrast_is_that_of_filled_zeros(share):
    """(1 + e c) / (1 - e c), e = 1 - share; c = sin(pi / 12) / (pi / 12): the band is a twelfth of a period."""
    e = (1 - share) * math.sin(math.pi / 12) / (math.pi / 12)
    found = np.exp(half_space_study.log_contrasts(*with_filled_zeros(share), TABLE))
    # five lines to a band in place of its integral
    assert found == pytest.approx(np.full(19, (1 + e) / (1 - e)), rel=0.1)


def test_zeros_have_both_of_their_maxima_in_region_3():
    period, zeros = TABLE.oscillation_period, half_space_study.zeros_of(TABLE)
    assert TABLE.jump < (zeros[0] - 0.5) * period and TABLE.cutoff > (zeros[-1] + 0.5) * period
    narrow = replace(TABLE, ground=replace(TABLE.rail, longest=2e-3, shortest=1.5e-3))
    assert half_space_study.zeros_of(narrow).size == 0
