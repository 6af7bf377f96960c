"""Faults that once lived in the series that cases declare: reference, grid, family, model and range of each."""

import itertools
import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from tests.analysis.test_judged_claims import point
from validation.analysis.evidence import Role, Verdict, numbers_with
from validation.analysis.series import Estimates, numbers_of
from validation.analysis.statistics import DECIBEL, POWER_DECIBEL, Estimate, mean_estimate, ratio_of_means, student
from validation.analysis.study import Outcomes
from validation.cases.punch import bandwidth, fractal_punch, fractal_punch_study
from validation.cases.rolling import force_spectrum
from validation.cases.rolling.force_spectrum import SPRINGS
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


# --- rolling over isotropic roughness ---------------------------------------------------------------------------------

ROLLING = force_spectrum.ForceSpectrum(heights=(0.1, 0.3), last=8.0, lowest=0.5, length=32.0, strips=4, refined=3)


def of_strips(level, size):
    """Strips and tracks whose variance and level are so many times those of linear theory."""
    linear = np.random.default_rng(0).lognormal(0, 0.3, (size, len(ROLLING.bands.centres)))
    noise = 1 + 0.01 * np.random.default_rng(size).standard_normal(size)
    both = {"linear variance": linear.mean(axis=1), "variance": level * linear.mean(axis=1) * noise}
    return both | {"level": level * linear, "linear level": linear}


def test_the_rms_force_is_that_on_cells_of_no_size_and_both_models_hold_at_once():
    """Boundary elements 10 % over linear theory in power, 2 % less on finer cells; springs 30 % over it."""
    bem, springs = of_strips(1.1, 4), of_strips(1.3, 60)
    fine = {name: values[:3] for name, values in bem.items()}
    fine["variance"] = 0.98 * fine["variance"]
    found = {("bem3d", 0.1): bem, ("refined", 0.1): fine, (SPRINGS, 0.1): springs}
    models = itertools.islice(force_spectrum._whole(Outcomes(ROLLING, found), 0.1), 2)
    over = ratio_of_logs(bem)
    for number, mine in zip(numbers_of(models), (ratio_of_logs(springs), Estimate(0.0, 0.0, 4)), strict=True):
        apart = mine.minus(over)
        assert number.value == pytest.approx(POWER_DECIBEL * (apart.value - 2 * math.log(0.98)))
        assert number.sample == pytest.approx(POWER_DECIBEL * apart.half_width_among(4))
        assert number.grid == pytest.approx(-POWER_DECIBEL * math.log(0.98))


def ratio_of_logs(one):
    return Estimates.ratios(one["variance"], one["linear variance"])[0]


def test_geikes_spectrum_is_too_loud_by_its_limit_where_boundary_elements_are_linear_theory():
    """Within half a decibel at q a of 4 and more; 1 % less power on finer cells raises it by two of them."""
    bem = of_strips(1.0, 4)
    for finer in (1.0, 0.99):
        fine = {name: finer * values[:3] for name, values in bem.items()}
        one = force_spectrum._excess(Outcomes(ROLLING, {("bem3d", 0.1): bem, ("refined", 0.1): fine}), 0.1)
        (number,) = one.numbers
        if finer == 1.0:
            before = number
    assert before.verdict is Verdict.AGREE and before.value > 1 and before.grid == pytest.approx(0.0, abs=1e-12)
    assert before.reference == pytest.approx(-10 * math.log10(level_ratio(ROLLING.hurst)))
    assert number.value - before.value == pytest.approx(-20 * math.log10(0.99))
    assert number.grid == pytest.approx(-10 * math.log10(0.99))
    assert number.where["q a"] == (4.0, 8.0)


def test_levels_are_judged_in_both_ranges_and_linear_theory_must_hold_over_low_roughness():
    """Linear theory is 2 in each band, nothing in 1D below the roughness; springs 1.3, and 1.5 with the other rule."""
    bands, inside, low = len(ROLLING.bands.centres), ROLLING.bands_in(1.0, 8.0), ROLLING.bands_in(0.5, 1.0)
    scatter = np.exp(0.05 * np.random.default_rng(1).standard_normal((4, 1))) * np.ones(bands)
    bem = {"level": 1.1 * scatter, "linear level": np.ones((4, bands)), "cross": np.zeros((2, 4, bands))}
    fine = {"level": 0.98 * bem["level"][:3]}
    for height, role, family in ((0.1, Role.FINDING, 8), (0.01, Role.CRITERION, 1)):
        springs = {
            rule: bem | {"level": factor * height**2 * 2 * scatter, "linear level": height**2 * 2 * scatter / 2}
            for rule, factor in ((SPRINGS, 1.3), (force_spectrum.ROLLING_SPRINGS, 1.5))
        }
        found = {("bem3d", height): bem, ("refined", height): fine} | {(r, height): one for r, one in springs.items()}
        case = replace(ROLLING, heights=(0.01, 0.1))
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(force_spectrum, "level_3d", lambda *_: np.full(bands, 2.0))
            patch.setattr(force_spectrum, "level_1d", lambda *_: np.where(inside, 2.6, 0.0))
            numbers = numbers_of(force_spectrum.levels_at(Outcomes(case, found), height))
        over, grid = Estimates.ratios(bem["level"], bem["linear level"]), -POWER_DECIBEL * math.log(0.98)
        for model, level, error in (
            (force_spectrum.LINEAR_3D, 1.0, 0.0),
            (SPRINGS, 1.3 * scatter[:, 0].mean(), 1.0),
            (force_spectrum.ROLLING_SPRINGS, 1.5 * scatter[:, 0].mean(), 1.0),
        ):
            judged = numbers_with(numbers, force_spectrum.LEVEL, model + force_spectrum.OVER)
            assert [n.where["q a"] for n in judged] == [(0.5, 1.0), (1.0, 8.0)]
            for n, among in zip(judged, (low, inside), strict=True):
                assert n.value == pytest.approx(POWER_DECIBEL * (math.log(level / 0.98**2) - over[0].value))
                assert n.grid == pytest.approx(grid)
                mine = Estimates.ratios(scatter, np.ones(bands))[0]
                apart = replace(mine, error=error * mine.error).minus(over[0])
                hold = among.sum() * (family if model == force_spectrum.LINEAR_3D else 8)
                assert n.sample == pytest.approx(POWER_DECIBEL * apart.half_width_among(hold))
                assert n.role is (role if model == force_spectrum.LINEAR_3D else Role.FINDING)
        (in_1d,) = numbers_with(numbers, force_spectrum.LEVEL, force_spectrum.LINEAR_1D + force_spectrum.OVER)
        assert in_1d.where["q a"] == (1.0, 8.0)
        (nonlinear,) = numbers_with(numbers, force_spectrum.NONLINEAR)
        assert nonlinear.where["q a"] == (1.0, 8.0) and nonlinear.grid == pytest.approx(grid)
        assert nonlinear.value == pytest.approx(POWER_DECIBEL * math.log(2.6))
        assert nonlinear.reference == pytest.approx(POWER_DECIBEL * (over[0].value + 2 * math.log(0.98)))


def test_moments_of_the_force_at_all_heights_hold_at_once():
    """Variances of two models and a mean force at each of two heights."""
    rng = np.random.default_rng(0)
    bem, springs = (of_strips(1.1, n) | {"mean": f + 0.01 * rng.standard_normal(n)} for n, f in ((4, 1.0), (60, 1.2)))
    found = Outcomes(ROLLING, {("bem3d", 0.1): bem, (SPRINGS, 0.1): springs})
    *variances, mean = numbers_of(force_spectrum.moments_at(found, 0.1))
    for n, one in zip(variances, (bem, springs), strict=True):
        ratio = ratio_of_means(one["variance"], one["linear variance"])
        assert (n.value, n.reference, n.sample) == pytest.approx((ratio.value, 1.0, ratio.half_width_among(4)))
    apart = mean_estimate(springs["mean"]).minus(mean_estimate(bem["mean"]))
    assert (mean.difference, mean.sample) == pytest.approx((apart.value, apart.half_width_among(2)))
