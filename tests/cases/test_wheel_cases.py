"""Evidence of the wheel cases: verdicts after injected errors, the contrast, interrupted ensembles."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest

from tests.cases.wheel_scenes import COARSE, DECIBEL, QUICK_3D, ROUNDING, SMALL, TABLE
from validation.analysis.evidence import ClaimStatus, Verdict, number_with
from validation.analysis.series import ENDS, spans
from validation.cases.wheel import contrast
from validation.cases.wheel import distance as wheel_distance
from validation.cases.wheel import distance_study as wheel_distance_study
from validation.cases.wheel import features as wheel_features
from validation.cases.wheel import half_space as wheel_3d
from validation.cases.wheel import half_space_study as wheel_3d_study
from validation.cases.wheel import spectrum as wheel
from validation.cases.wheel import spectrum_study as wheel_study
from validation.cases.wheel.features import (
    BREAK,
    FLOOR,
    JUMP,
    LEVEL,
    PEAK,
    PERIOD,
    PREDICTED,
    QUANTITIES,
    SLOPE,
    Spectrum,
)
from validation.engine.convergence import NotConvergedError
from validation.engine.engine import Engine
from validation.simulation import wheel_on_springs as wheel_ensemble
from validation.simulation.motion import natural_periods

# --- evidence ---------------------------------------------------------------------------------------------------------


def feature(evidence, name):
    return number_with(evidence.numbers, QUANTITIES[name])


def whole(evidence):
    """All criteria met, all there; only lines that a band does not have are NaN."""
    assert all(number.met for number in evidence.numbers)
    assert all(math.isfinite(number.value) and math.isfinite(number.uncertainty) for number in evidence.numbers)
    assert evidence.captions
    for sentence in (evidence.method, *evidence.conclusions, *evidence.captions.values()):
        assert not re.search(r"\b(nan|inf)\b", sentence)
    assert len({table.name for table in evidence.tables}) == len(evidence.tables)
    for table in (*evidence.tables, *evidence.page_tables):
        assert all(len(column) for column in table.columns.values())


LONG = wheel.WheelSpectrum(
    scene=replace(SMALL, distance=3.0),
    realisations=20,
    varied=6,
    groups=5,
    batch=10,
    parameters=False,
    cells=6,
    snapshot_steps=4,
)


@pytest.fixture(scope="module")
def long_wheel():
    return wheel.run(LONG)


def spectrum_of(result):
    """Of the scene itself."""
    return Spectrum.of(result.case.scene, result[result.case.scene.name])


def changed(result, change):
    """Every batch of the base with some arrays changed."""
    name = result.case.scene.name
    return replace(result, found={**result.found, name: [{**o, **change(o)} for o in result[name]]})


@pytest.mark.slow
def test_wheel_evidence_is_whole(long_wheel):
    found = wheel_study.STUDY.evidence(long_wheel)
    whole(found)
    # an estimate lies within three half-widths of theory, which is 95 % wide, or what is tolerated
    for name in wheel.SOURCES:
        number = feature(found, name)
        assert abs(number.difference) <= number.tolerance + 2 * number.uncertainty, number.sentence


@pytest.mark.slow
def test_a_fifth_more_acceleration_is_another_level(long_wheel):
    def louder(o):
        return {name: 1.44 * o[name] for name in ("plain", "hann", "levels", "square")} | {
            name: 1.2 * o[name] for name in ("jump", "mean")
        }

    both = long_wheel, changed(long_wheel, louder)
    before, after = (wheel_study.STUDY.evidence(result) for result in both)
    levels = [evidence.table(LEVEL)["value"] for evidence in (before, after)]
    # bands end below the break, which moves with the floor: not at all where it is the cutoff
    assert 3 <= len(levels[1]) <= len(levels[0])
    for one, other in zip(*levels, strict=False):
        assert other - one == pytest.approx(DECIBEL * math.log(1.44), abs=1e-9)
    assert number_with(after.numbers, LEVEL).verdict is Verdict.DIFFER
    assert after.claims[0].status is ClaimStatus.CONTRADICTED and after.claims[0].answer.startswith("No: ")
    for name in (PEAK, JUMP, SLOPE, PERIOD):
        assert feature(after, name).value == pytest.approx(feature(before, name).value, rel=1e-9)
    assert all(number.met for number in after.numbers)


@pytest.mark.slow
def test_a_shifted_axis_is_another_peak_jump_and_period(long_wheel):
    before = wheel_study.STUDY.evidence(long_wheel)
    after = wheel_study.STUDY.evidence(changed(long_wheel, lambda o: {"omega": 1.04 * o["omega"]}))
    for name in (PEAK, JUMP, PERIOD):
        one, other = feature(before, name), feature(after, name)
        # ranges stay, so that a line or two at their ends are others
        assert other.value / one.value == pytest.approx(1.04, rel=0.005), name
        assert other.verdict is Verdict.DIFFER, other.sentence


@pytest.mark.slow
def test_a_floor_without_its_leak_is_not_predicted(long_wheel):
    leakless = changed(long_wheel, lambda o: {"plain": o["hann"]})
    floor = wheel_features.measured(spectrum_of(leakless))[FLOOR + PREDICTED]
    assert floor.value + floor.half_width < 0.9
    # Hann's window keeps no mean square
    assert not all(number.met for number in wheel_study.STUDY.evidence(leakless).numbers)


@pytest.mark.slow
def test_a_lost_force_is_a_missed_criterion(long_wheel):
    after = wheel_study.STUDY.evidence(changed(long_wheel, lambda o: {"balance": o["balance"] + 1e-9}))
    (missed,) = (number for number in after.numbers if not number.met)
    assert "velocity change" in missed.quantity


def test_what_does_not_stand_out_is_said_so():
    """Waves of less than three periods of the oscillation: no slope, no period, no break."""
    scene = replace(SMALL, rail=replace(SMALL.rail, shortest=2e-3))
    case = replace(LONG, scene=scene, realisations=10, batch=10)
    found = wheel_study.STUDY.evidence(wheel.run(case))
    whole(found)
    shown = found.table(wheel_study.PARAMETERS.name).columns
    assert list(shown) == ["scene", *wheel_study.JUDGED]
    missing = [quantity for quantity in wheel_study.JUDGED if shown[quantity] == ["–"]]
    assert missing == [QUANTITIES[name] for name in (SLOPE, PERIOD, BREAK + PREDICTED)]


@pytest.mark.slow
def test_one_parameter_at_a_time():
    case = replace(LONG, scene=SMALL, realisations=10, batch=10, varied=6, groups=2, parameters=True)
    names = list(case.variations())
    assert len(names) == len(set(names)) == 13
    found = wheel_study.STUDY.evidence(wheel.run(case))
    whole(found)
    table = found.table(wheel_study.PARAMETERS.name)
    assert list(table.columns["scene"]) == names
    jumps = dict(zip(names, table.columns[QUANTITIES[JUMP]], strict=True))
    base = SMALL.jump
    for name, factor in (
        ("v₀ × 0.25", 0.25),
        ("v₀ × 2", 2.0),
        ("q_min × 0.5", 0.5),
        ("q_min × 2", 2.0),
        ("H = 1", 1.0),
    ):
        assert f" beside {factor * base:.4g} rad/s: " in str(jumps[name])


def test_a_smooth_scene_has_no_spectrum():
    case = replace(LONG, scene=replace(SMALL, name="Glass", rail=None), realisations=5)
    with pytest.raises(ValueError, match="scene must have a rough rail or a rough wheel, got both smooth"):
        wheel_study.STUDY.evidence(wheel.run(case))
    smooth = replace(QUICK_3D, scene=replace(COARSE, rail=None))
    with pytest.raises(ValueError, match="scene must have a rough rail and a smooth wheel"):
        wheel_3d.run(smooth)


def test_a_rough_wheel_on_a_smooth_rail_is_a_scene_too():
    case = replace(LONG, scene=replace(SMALL, rail=None, wheel=SMALL.rail), realisations=10, batch=10, parameters=True)
    assert [name for name in case.variations() if "q_" in name] == []
    whole(wheel_study.STUDY.evidence(wheel.run(replace(case, parameters=False))))


DISTANCE = wheel_distance.WheelDistance(
    scene=SMALL, doublings=3, wheels=24, fewest=12, causes=8, rough=8, groups=4, released=2
)


@pytest.fixture(scope="module")
def distances():
    return wheel_distance.run(DISTANCE)


def of_distances(result, changed=None):
    """Evidence, with some outcomes changed."""
    return wheel_distance_study.STUDY.evidence(replace(result, found={**result.found, **(changed or {})}))


def hann(evidence):
    """Region 4 with Hann's window over that without."""
    model = f"{wheel_distance.HANN}, over {wheel_distance.OPEN}"
    return number_with(evidence.numbers, LEVEL, model)


@pytest.mark.slow
def test_distance_evidence_is_whole(distances):
    found = of_distances(distances)
    whole(found)
    number = hann(found)
    assert number.verdict is Verdict.DIFFER and number.value < -6
    law = number_with(found.numbers, wheel_distance.BREAK_LAW)
    assert law.reference == pytest.approx(1 / 2.4, rel=ROUNDING)
    # the line has the slope of the law and goes through the middle of the breaks
    breaks = found.table(wheel_distance.BREAK_AT)
    line, points = (breaks.where(model=model) for model in ("T^(1/(2H+1))", "found"))
    slope = np.diff(np.log(line["value"])) / np.diff(np.log(line[wheel_distance.DURATION]))
    assert slope == pytest.approx(np.full(slope.size, 1 / 2.4), rel=1e-9)
    assert np.mean(np.log(line["value"])) == pytest.approx(np.mean(np.log(points["value"])), rel=1e-12)
    # to second order in the amplitude
    hertz = found.table(wheel_distance.OVER_EIGEN).where(model="Hertz, quadrature")
    assert hertz["value"][0] == pytest.approx(1 - hertz[wheel_distance.RELEASE][0] ** 2 / 24, abs=1e-6)


def test_distances_take_whole_natural_periods_and_double():
    length = [ride.steps * ride.scene.spacing for ride in reversed(DISTANCE.distances().values())]
    for i, one in enumerate(length):
        # to the next length that an FFT is fast at: a part in a hundred
        assert natural_periods(SMALL.body, one, SMALL.speed) == pytest.approx(2**i, rel=0.02)
        assert natural_periods(SMALL.body, one, SMALL.speed) >= 2**i * (1 - ROUNDING)


@pytest.mark.slow
def test_a_rectangular_window_in_place_of_hann_drops_nothing(distances):
    opened = distances[wheel_distance.OPEN]
    found = of_distances(distances, {wheel_distance.OPEN: {**opened, "hann": opened["plain"]}})
    assert hann(found).value == pytest.approx(0, abs=1e-9)


@pytest.mark.slow
def test_floors_without_their_leak_are_not_predicted(distances):
    """Half of the floor, as if its jumps were lower by the root of two, at every distance."""
    halved = {key: {**(o := distances[key]), "jump": math.sqrt(2) * o["jump"]} for key in DISTANCE.distances()}
    floors = [of_distances(distances, one).table(wheel_distance.FLOORS)["value"] for one in (None, halved)]
    assert floors[0] == pytest.approx(np.ones(4), abs=0.1)
    assert floors[1] == pytest.approx(floors[0] / 2, rel=1e-9)


@pytest.mark.slow
def test_a_linear_contact_with_a_floor_misses_its_identity(distances):
    steady = distances[wheel_distance.LINEAR_STEADY]
    leaking = {**steady, "plain": steady["plain"] + 1e-12 * steady["plain"].max()}
    found = of_distances(distances, {wheel_distance.LINEAR_STEADY: leaking})
    assert len([number for number in found.numbers if not number.met]) == 2


@pytest.mark.slow
def test_wheels_that_do_not_repeat_themselves_are_no_evidence(monkeypatch):
    monkeypatch.setattr(wheel_ensemble, "STEADY_TOLERANCE", -1.0)
    with pytest.raises(NotConvergedError, match="most wheels of an ensemble do not repeat their motion") as caught:
        wheel_distance.run(replace(DISTANCE, doublings=0, scene=replace(SMALL, distance=0.05)))
    assert caught.value.unconverged[0].startswith("24 of 24 wheels do not repeat their motion, h₀ = 5e-07 m")
    with pytest.raises(NotConvergedError, match="wheels on springs do not repeat their motion") as caught:
        wheel_3d.run(QUICK_3D)
    assert caught.value.unconverged == ("geike", "rolling")


@pytest.fixture(scope="module")
def in_3d():
    return wheel_3d.run(QUICK_3D)


@pytest.mark.slow
def test_evidence_in_three_dimensions_is_whole(in_3d):
    found = wheel_3d_study.STUDY.evidence(in_3d)
    whole(found)
    geike, theory = (
        number_with(found.numbers, LEVEL, wheel_3d.OVER_BEM[model], range="region 2")
        for model in (wheel_3d.GEIKE, wheel_3d.LINEAR_3D)
    )
    assert geike.verdict is Verdict.DIFFER and geike.value < -10
    assert abs(theory.difference) <= theory.tolerance + theory.uncertainty
    assert found.claims[0].status is ClaimStatus.CONTRADICTED
    assert np.isfinite(found.table(wheel_3d_study.LEVELS).where(model=wheel_3d.BEM)["value"]).all()


@pytest.mark.slow
def test_a_fifth_more_acceleration_in_three_dimensions(in_3d):
    strips = {name: [{**o, "bem": 1.2 * o["bem"]} for o in in_3d[name]] for name in in_3d.case.strips_of()}
    results = in_3d, replace(in_3d, found={**in_3d.found, **strips})
    tables = (wheel_3d_study.STUDY.evidence(result).table(LEVEL) for result in results)
    one, other = ({name: t[name][np.isfinite(t["value"])] for name in ENDS} for t in tables)
    assert len(one["value"]) >= 12
    assert one["value"] - other["value"] == pytest.approx(DECIBEL * math.log(1.44), abs=1e-9)
    assert other["high"] - other["low"] == pytest.approx(one["high"] - one["low"], rel=1e-6)


@pytest.mark.slow
def test_grids_that_differ_leave_the_level_open(in_3d):
    """A coarse grid 1 dB louder, with a quarter more cells on the fine one: three times as much is left open."""
    louder = [{**o, "bem": 10 ** (1 / 20) * o["bem"]} for o in in_3d["coarser"]]
    found = wheel_3d.WheelLevels(replace(in_3d, found={**in_3d.found, "coarser": louder}))
    before = wheel_3d.WheelLevels(in_3d)
    change = DECIBEL * np.maximum(found.grid, before.grid)
    assert (change >= 1.5 - 1e-9).all()


# --- the contrast of the oscillation ----------------------------------------------------------------------------------


def with_filled_zeros(scene, share, lines=60):
    """A of region 3 as sin²(q a), a share of it replaced by its mean; lines to a period."""
    omega = (
        scene.oscillation_period
        / lines
        * np.arange(1, math.ceil(1.2 * scene.cutoff / scene.oscillation_period * lines))
    )
    wave = np.sin(np.pi * omega / scene.oscillation_period) ** 2
    return omega, ((1 - share) * wave + share / 2) * omega ** (-2 * scene.rail.hurst - 3)


@pytest.mark.parametrize("share", [0.01, 0.1, 0.5, 1.0])
def test_the_contrast_is_that_of_filled_zeros(share):
    """(1 + e c) / (1 - e c), e = 1 - share; c = sin(pi / 12) / (pi / 12): the band is a twelfth of a period."""
    omega, density = with_filled_zeros(TABLE, share)
    e = (1 - share) * math.sin(math.pi / 12) / (math.pi / 12)
    found = np.exp(contrast.log_contrasts(omega, density, TABLE))
    # five lines to a band in place of its integral
    assert found == pytest.approx(np.full(19, (1 + e) / (1 - e)), rel=0.1)


def test_zeros_have_both_of_their_maxima_in_region_3():
    period = TABLE.oscillation_period
    zeros = contrast.zeros_of(TABLE)
    assert TABLE.jump < (zeros[0] - 0.5) * period and TABLE.cutoff > (zeros[-1] + 0.5) * period
    narrow = replace(TABLE, rail=replace(TABLE.rail, longest=2e-3, shortest=1.5e-3))
    assert contrast.zeros_of(narrow).size == 0


def test_an_oscillation_that_dies_is_noticed():
    """Zeros that fill from the first to the last: the worst is the last, and differs; the first alone agrees."""
    omega, wave = with_filled_zeros(TABLE, 0.0)
    _, mean = with_filled_zeros(TABLE, 1.0)
    zeros = contrast.zeros_of(TABLE)
    share = np.interp(omega / TABLE.oscillation_period, zeros[[0, -1]], [0.0, 1.0])
    rng = np.random.default_rng(0)
    groups = ((1 - share) * wave + share * mean) * rng.gamma(400, 1 / 400, (6, 1))
    reference, found = contrast.log_contrasts(omega, wave, TABLE), contrast.contrasts_of(omega, groups, TABLE)
    series = contrast.contrast_series("springs", found, TABLE, reference)
    (first,) = replace(series, ranges=spans(zeros, zeros[[0, 0]])).numbers
    assert first.verdict is Verdict.AGREE
    (worst,) = series.numbers
    assert worst.verdict is Verdict.DIFFER and worst.where["worst at"] == zeros[-1]


# --- interrupted ensembles --------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_an_interrupted_ensemble_goes_on_where_it_was(tmp_path):
    """Four files; one is lost: it alone is written anew, and all is as before to the bit."""
    case = replace(LONG, scene=SMALL, realisations=12, groups=3, batch=4)
    engine = Engine(store=tmp_path)
    first = wheel.run(case, engine)
    files = sorted(tmp_path.glob("*.npz"))
    assert len(files) == 4
    lost = next(file for file in files if "simulate_ensemble" in file.name)
    kept = {file: file.stat().st_ino for file in files if file != lost}
    lost.unlink()
    again = wheel.run(case, engine)
    assert sorted(tmp_path.glob("*.npz")) == files
    assert {file: file.stat().st_ino for file in kept} == kept
    outcomes = [[*r[case.scene.name], r[wheel.SNAPSHOT]] for r in (first, again, wheel.run(case))]
    for one, *others in zip(*outcomes, strict=True):
        for other in others:
            assert one.keys() == other.keys()
            for name, values in one.items():
                np.testing.assert_array_equal(other[name], values, err_msg=name)
    assert wheel_study.STUDY.evidence(first) == wheel_study.STUDY.evidence(again)
