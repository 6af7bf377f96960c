"""Faults that once lived in the series that cases declare: reference, grid, family, model and range of each."""

import math
from dataclasses import replace
from functools import cache
from types import SimpleNamespace

import numpy as np
import pytest

from tests.analysis.test_judged_claims import point
from validation.analysis.evidence import Role, Verdict, number_with, numbers_with
from validation.analysis.series import Estimates, numbers_of
from validation.analysis.statistics import DECIBEL, POWER_DECIBEL, Estimate, student
from validation.analysis.study import Outcomes
from validation.cases.punch import bandwidth, fractal_punch, fractal_punch_study
from validation.cases.rail import contact_filter, filters, rolled_filters
from validation.cases.rail.filters import linear_filter, scene_of
from validation.cases.rail.rolled_filters import OVER_BEM, RolledFilters, RolledFiltersResult
from validation.cases.rolling import force_spectrum
from validation.cases.rolling.force_spectrum import SPRINGS
from validation.simulation.model_names import BEM, LINEAR, LINEAR_ON_LINE, SPRINGS_ON_LINE
from validation.simulation.rail_strip import strip_bands
from validation.theory.rolling import level_ratio

# --- bandwidth of a punch ---------------------------------------------------------------------------------------------

PUNCHES = bandwidth.Bandwidth(cells=16, surfaces=12, pairs=(8, 8), refined=12, rolled_off=12, profiles=12, points=64)


def pressed(narrow, refined, wider, springs, rolled=1.0):
    """Stiffnesses that are factors of the same surfaces, and for springs of the same others."""
    rng = np.random.default_rng(0)
    one, own = rng.lognormal(0, 0.1, (2, 12, len(PUNCHES.forces)))
    factors = {"narrow": narrow, "refined": refined, "rolled off": rolled}
    factors |= {f"before {i}": 1.0 for i in range(2)} | {f"wider {i}": wider for i in range(2)}
    found = {key: {"stiffness": factor * one} for key, factor in factors.items()}
    springs = {kind: {"stiffness": factor * own} for kind, factor in zip(PUNCHES.ground, springs, strict=True)}
    return bandwidth.series(Outcomes(PUNCHES, found | springs))


def test_finer_cells_leave_twice_their_change_of_a_stiffness_and_once_of_a_change():
    """5 % stiffer on cells half as long, at all forces alike; in full contact the sample drops out."""
    numbers = numbers_of(pressed(1.0, 1.05, 1.0, (1.0, 1.0, 1.0, 1.0)))
    of_change = DECIBEL * math.log(1.05)
    assert of_change == pytest.approx(20 * math.log10(1.05))
    for model in ("mdr", bandwidth.FIT):
        found = numbers_with(numbers, bandwidth.MEAN + bandwidth.OF_BEM, model)
        assert len(found) == len(PUNCHES.ground)
        assert [n.grid for n in found] == pytest.approx([2 * of_change] * len(found))
    found = numbers_with(numbers, bandwidth.CHANGE + bandwidth.MEAN)
    assert len(found) == 3 * len(PUNCHES.first_forces)
    assert [n.grid for n in found] == pytest.approx([of_change] * len(found))
    assert numbers_with(numbers, bandwidth.DEVIATION + bandwidth.OF_BEM) == []


def test_changes_are_of_springs_less_of_boundary_elements_and_all_decades_hold_at_once():
    """Springs 10 % stiffer in each wider band, boundary elements 2 %; with a roll-off 21 % and 5 %."""
    series = pressed(1.0, 1.0, 1.02, (1.0, 1.1, 1.21, 1.21), rolled=1.05)
    numbers = numbers_of(series)
    # two statistics, three decades, two changes of the band
    assert {one.family for one in series if one.margin} == {12}
    for name, place, factor in (
        (bandwidth.BANDWIDTH, (4.0, 8.0), 1.1 / 1.02),
        (bandwidth.BANDWIDTH, (8.0, 16.0), 1.1 / 1.02),
        (bandwidth.ROLL_OFF, 4.0, 1.21 / 1.05),
    ):
        found = numbers_with(numbers, bandwidth.CHANGE + bandwidth.MEAN, **{name: place})
        assert [n.value for n in found] == pytest.approx([20 * math.log10(factor)] * 3)
        assert [n.reference for n in found] == [0.0] * 3
    for number in numbers_with(numbers, bandwidth.MEAN + bandwidth.OF_BEM):
        assert number.where[bandwidth.FORCE] == pytest.approx((10**-0.5, 10.0))
    narrow, *_, rolled = (one for one in series if (one.quantity, one.model) == (bandwidth.MEAN, "bem3d"))
    assert rolled.found.values - narrow.found.values == pytest.approx(math.log(1.05))


def test_the_size_of_a_punch_is_told_by_the_deviation_alone():
    """Surfaces with a roll-off have more than e^0.5 times the deviation."""
    wide = np.array([[-1.0], [1.0]] * 6)
    series = pressed(1.0, 1.0, 1.0, (1.0,) * 4, rolled=1 + 0.5 * wide)
    for quantity, model in ((bandwidth.DEVIATION, "bem3d"), (bandwidth.MEAN, "bem3d")):
        alone = [one for one in series if (one.quantity, one.model) == (quantity, model)]
        size = [one for one in series if (one.quantity, one.model) == (bandwidth.SIZE + quantity, model)]
        assert len(size) == (quantity == bandwidth.DEVIATION)
        for one in size:
            assert one.found.values == pytest.approx(alone[-1].found.values - alone[0].found.values)
            assert (one.found.values > 0.5).all()


def test_the_interval_of_a_change_to_finer_cells_is_left_open_too():
    noise = np.exp(0.01 * np.random.default_rng(5).standard_normal((12, 1)))
    series = pressed(1.0, 1.05 * noise, 1.0, (1.0,) * 4)
    (one, *_) = (one for one in series if one.quantity == bandwidth.CHANGE + bandwidth.MEAN)
    (change,) = bandwidth.change(bandwidth.log_mean, np.ones((12, 1)), 1.05 * noise)
    assert one.grid[0] == pytest.approx(change.value + change.half_width, rel=0.2) and one.grid[0] > 1.05 * change.value


# --- Fig. 14.1 --------------------------------------------------------------------------------------------------------

PUNCH = fractal_punch.FractalPunch(hursts=(0.4, 0.7))


class Resolved(SimpleNamespace):
    def beside(self, other):
        return Resolved(value=self.value.minus(other.value), grid=self.grid + other.grid)


def found_in_fig_14_1(contact=lambda *_: 1e9):
    """Springs 0.3 over boundary elements at each force, 0.5 where they are longer; exponents 0.6 beside 0.5."""
    ratio = {fractal_punch_study.MDR: 0.3, fractal_punch.LONG: 0.5}
    exponent, grid = ({fractal_punch_study.MDR: a, fractal_punch_study.BEM: b} for a, b in ((0.6, 0.5), (0.01, 0.02)))
    return SimpleNamespace(
        case=PUNCH,
        contact=contact,
        ratio=lambda hurst, method, *_: Resolved(value=Estimate(ratio[method], 0.01, 9), grid=0.02),
        exponent=lambda hurst, method, *_: Resolved(value=Estimate(exponent[method], 0.01, 9), grid=grid[method]),
    )


def test_each_length_of_springs_has_its_own_level_and_exponents_their_grid():
    study, found = fractal_punch_study, found_in_fig_14_1()
    numbers = numbers_of(study.compared(found, 0.7))
    for name, level in ((study.MEAN, 0.3), (study.MEAN + study.OF_LONG, 0.5), (study.DEVIATION + study.OF_LONG, 0.5)):
        of_decades = numbers_with(numbers, name)
        assert len(of_decades) == len(PUNCH.first_forces)
        for n in of_decades:
            assert (n.value, n.grid) == pytest.approx((DECIBEL * level, DECIBEL * 0.02))
            assert n.sample == pytest.approx(DECIBEL * 0.01 * student(8, 1 - 0.05 / (PUNCH.per_decade + 1)))
    exponents = numbers_with(numbers, study.EXPONENT)
    assert exponents and {(round(n.value, 9), round(n.grid, 9)) for n in exponents} == {(0.1, 0.03)}
    laws = numbers_of(study.laws(found))
    assert [(n.where[fractal_punch.H], n.model) for n in laws] == [
        (h, m) for h in PUNCH.hursts for m in (study.BEM, study.MDR)
    ]
    for n in laws:
        assert n.reference == pytest.approx(1 / (1 + n.where[fractal_punch.H]))
        assert n.sample == pytest.approx(0.01 * student(8, 1 - 0.05 / 2))
        assert n.grid == {study.BEM: 0.02, study.MDR: 0.01}[n.model]


def test_a_decade_that_is_not_whole_is_not_judged():
    study, found = fractal_punch_study, found_in_fig_14_1()
    whole, last = found.ratio, len(PUNCH.forces) - 1
    lost = Resolved(value=Estimate(-math.inf, 0.0, 9), grid=0.0)
    found.ratio = lambda hurst, method, statistic, level: lost if level == last else whole(hurst, method)
    judged = numbers_with(numbers_of(study.compared(found, 0.7)), study.MEAN)
    assert [n.where[fractal_punch.FORCE][0] for n in judged] == pytest.approx(list(PUNCH.first_forces[:-1]))


def test_the_farthest_interval_is_judged_once_more_where_contacts_have_cells_enough_at_every_hurst(monkeypatch):
    study = fractal_punch_study
    decades = [(PUNCH.forces[a], PUNCH.forces[b]) for a, b in map(PUNCH.decade, PUNCH.first_forces)]
    # few cells at one H alone, in the first decade
    found = found_in_fig_14_1(
        lambda hurst, level, cells: fractal_punch.FEW_CELLS * (0.5 if level == 0 and hurst > 0.5 else 2)
    )
    monkeypatch.setattr(fractal_punch, "PunchStatistics", lambda result: found)
    numbers = [
        point(value, sample, quantity=quantity, where={fractal_punch.FORCE: place})
        for quantity in (study.MEAN, study.DEVIATION)
        for place, value, sample in ((decades[0], 9.0, 0.1), (decades[1], 2.0, 0.1), (decades[1], -1.5, 0.9))
    ]
    mean, deviation = study.once_more(SimpleNamespace(case=PUNCH), numbers)
    assert (mean.value, mean.tolerance, mean.role) == (-1.5, 3.0, Role.CRITERION)
    assert (deviation.value, deviation.tolerance, deviation.role) == (9.0, 3.0, Role.FINDING)


# --- contact filter ---------------------------------------------------------------------------------------------------


@cache
def rolled_rail():
    """Boundary elements of other power on each strip, springs on the line 1 dB louder; few cells, 0.2 and 0.1."""
    case = RolledFilters(across=("isotropic ground",), strips=3)
    found = {}
    for cells, more in zip(case.cells, (1, 0), strict=True):
        found[case.keys[0], cells] = strips = []
        points = case.problems(case.keys[0], cells)[0].strip.shape[0]
        track = np.cos(2 * np.pi * np.outer(np.arange(points) / points, np.arange(1, 90))).sum(axis=1)
        for gain in (0.9, 1.0, 1.2):
            gains = {BEM: gain * 10 ** (0.2 * more / 20), SPRINGS_ON_LINE: 10 ** ((1 + 0.1 * more) / 20)}
            gains |= dict.fromkeys((LINEAR, LINEAR_ON_LINE), 1.0)
            strips.append({name: g * track for name, g in gains.items()} | {"failed": np.array(0.0)})
    return RolledFiltersResult(case, found, ())


def test_a_filter_over_boundary_elements_has_the_errors_of_both_in_the_bands_that_count():
    rail = rolled_rail()
    (key,) = rail.case.keys
    coarse, fine = rail.case.cells
    bem = rail.over_twin(key, BEM)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(rolled_filters, "models_of", lambda key: (BEM, LINEAR, LINEAR_ON_LINE, SPRINGS_ON_LINE))
        numbers = numbers_of(contact_filter._of_strips(rail, key))
    counts = np.flatnonzero(rail.linear(key) > contact_filter.COUNTED)
    assert 3 < counts.size < len(bem) and (np.diff(counts) == 1).all() and counts[0] == 0
    scene = rail.case.scene(key)
    mine = np.isin(scene.levels.bands.nominal, strip_bands(scene).nominal)
    for model, louder in ((LINEAR, 0.0), (LINEAR_ON_LINE, 0.0), (SPRINGS_ON_LINE, 1.0)):
        number, line = number_with(numbers, OVER_BEM, model), LINEAR if model == LINEAR else LINEAR_ON_LINE
        twin = (linear_filter(scene, line, "isotropic") - linear_filter(scene, LINEAR, "isotropic"))[mine]
        off = twin[counts] + louder - POWER_DECIBEL * bem.values[counts]
        each = [POWER_DECIBEL * bem[i].half_width_among(counts.size) for i in counts]
        at = np.argmax(np.abs(off) + each)
        assert (number.value, number.sample) == pytest.approx((off[at], each[at]), rel=1e-6)
        assert number.grid == pytest.approx((0.2 + 0.1 * louder) * coarse / (fine - coarse))
        assert number.reference == 0.0 and number.tolerance == 1.0


def test_filters_beside_the_published_table_and_in_decibel_a():
    rail = rolled_rail()
    wheel = next(iter(filters.columns_of_table()))
    keep, table = filters.compared(wheel), filters.a3_of_table(wheel)
    found = numbers_of(contact_filter._of_table(wheel, rail.case.across))
    for model in (LINEAR, LINEAR_ON_LINE):
        off = (linear_filter(scene_of(wheel), model, "isotropic") - table)[keep]
        (number,) = numbers_with(found, model=model)
        assert number.value == pytest.approx(math.sqrt(np.mean(off**2))) and number.grid == pytest.approx(0.05)
    (ridges,) = contact_filter._in_decibel_a(rail, LINEAR_ON_LINE, "ridges").numbers
    (ground,) = contact_filter._in_decibel_a(rail, LINEAR_ON_LINE, "isotropic ground").numbers
    assert (ridges.role, ground.role) == (Role.IDENTITY, Role.FINDING)
    assert abs(ridges.value) < 1e-6 and ground.value > 0.1


# --- rolling over isotropic roughness ---------------------------------------------------------------------------------

ROLLING = force_spectrum.ForceSpectrum(heights=(0.01, 0.1), last=8.0, lowest=0.5, length=32.0, strips=4, refined=3)


def of_strips(level, size, case=ROLLING):
    """Strips and tracks whose variance and level are so many times those of linear theory, and the mean force."""
    linear = np.random.default_rng(0).lognormal(0, 0.3, (size, len(case.bands.centres)))
    noise = 1 + 0.01 * np.random.default_rng(size).standard_normal(size)
    both = {"linear variance": linear.mean(axis=1), "variance": level * linear.mean(axis=1) * noise}
    return both | {"level": level * linear, "linear level": linear, "mean": level * noise}


def result_of(bem, finer, springs, height=0.1, case=ROLLING):
    fine = {name: (1.0 if name.startswith("linear") else finer) * values[:3] for name, values in bem.items()}
    found = {(force_spectrum.BEM, height): bem, (force_spectrum.REFINED, height): fine, (SPRINGS, height): springs}
    return Outcomes(case, found)


def test_the_rms_and_the_mean_force_are_those_on_cells_of_no_size():
    """Boundary elements 10 % over linear theory in power, 2 % less on finer cells; springs 30 % over it."""
    bem, springs = of_strips(1.1, 4), of_strips(1.3, 60)
    numbers = numbers_of(force_spectrum._force(result_of(bem, 0.98, springs), 0.1))
    ones = np.ones(1)
    expected = [(one, ratio_of_logs(bem), POWER_DECIBEL) for one in (ratio_of_logs(springs), Estimate(0.0, 0.0, 4))]
    mean, other = (Estimates.ratios(one["mean"], ones)[0] for one in (springs, bem))
    for number, (mine, reference, scale) in zip(numbers, [*expected, (mean, other, DECIBEL)], strict=True):
        apart = mine.minus(reference)
        assert number.value == pytest.approx(scale * (apart.value - 2 * math.log(0.98)))
        assert number.sample == pytest.approx(scale * apart.half_width)
        assert number.grid == pytest.approx(-scale * math.log(0.98))
        assert number.tolerance == pytest.approx(20 * math.log10(1.1))
    assert [number.where["h' a/d"] for number in numbers] == [float(f"{0.1 * ROLLING.spectrum.slope_along:.3g}")] * 3


def ratio_of_logs(one):
    return Estimates.ratios(one["variance"], one["linear variance"])[0]


def test_the_mean_curve_is_too_loud_by_its_limit_where_boundary_elements_are_linear_theory():
    """Within half a decibel at q a of 4 and more; 1 % less power on finer cells raises it by two of them."""
    case, name = replace(ROLLING, last=20.0), force_spectrum.MEAN_1D + force_spectrum.OVER
    bem, springs = (of_strips(1.0, size, case) for size in (4, 60))
    results = (result_of(bem, finer, springs, 0.01, case) for finer in (1.0, 0.99))
    judged = [numbers_of(force_spectrum._curve(result, 0.01)) for result in results]
    before, number = (numbers_with(some, force_spectrum.MEAN_LEVEL, name)[0] for some in judged)
    assert before.verdict is Verdict.DIFFER and before.grid == pytest.approx(0.0, abs=1e-12)
    assert before.value == pytest.approx(-10 * math.log10(level_ratio(ROLLING.hurst)), abs=0.5)
    assert number.value - before.value == pytest.approx(-20 * math.log10(0.99))
    assert number.grid == pytest.approx(-10 * math.log10(0.99))


@pytest.mark.parametrize("height", [0.01, 0.1])
def test_the_curve_is_judged_over_low_roughness_where_linear_theory_must_hold(height):
    """Linear theory is 2 in each band, (14.12) 2.6; the worst octave of linear theory is a criterion."""
    bem, springs = of_strips(1.0, 4), {"level": height**2 * np.full((60, len(ROLLING.bands.centres)), 3.0)}
    result = result_of(bem, 1.0, springs, height)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(force_spectrum, "level_3d", lambda *_: np.full(len(ROLLING.bands.centres), 2.0))
        for name in ("level_1d", "levels_on_track"):
            patch.setattr(force_spectrum, name, lambda *_: np.full(len(ROLLING.bands.centres), 2.6))
        levels, curves = (numbers_of(of(result, height)) for of in (force_spectrum._levels, force_spectrum._curve))
    of_rms = numbers_with(levels, force_spectrum.RMS_LEVEL)
    rms = {n.model.removesuffix(force_spectrum.OVER): n.value for n in of_rms}
    ratios = {force_spectrum.LINEAR_1D: 1.3, SPRINGS: 1.5, force_spectrum.LINEAR_3D: 1.0}
    assert rms == pytest.approx({name: 10 * math.log10(ratio) for name, ratio in ratios.items()}, abs=1e-9)
    must = [(n.model, n.tolerance) for n in levels if n.role is Role.CRITERION]
    assert must == ([(force_spectrum.LINEAR_3D + force_spectrum.OVER, 1.0)] if height == 0.01 else [])
    curve = numbers_with(curves, force_spectrum.CURVE)
    assert bool(curve) is (height == 0.01)
    assert [n.value for n in curve] == pytest.approx([10 * math.log10(3.0 / 2.6)] * len(curve))
