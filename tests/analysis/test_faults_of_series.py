"""Faults that once lived in declared series and claims, and in what cases declare: each test kills some of them."""

import itertools
import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from tests.analysis.test_declared_claims import AGREE, DIFFER, by_height
from tests.analysis.test_declared_claims import number as planted
from tests.analysis.test_judged_claims import point
from validation.analysis.claims import Claim, Matrix
from validation.analysis.evidence import ClaimStatus, Role, Verdict, number_with, numbers_with
from validation.analysis.over_range import worst
from validation.analysis.series import Estimates, Margin, Series, masked, numbers_of, single, tables_of
from validation.analysis.statistics import DECIBEL, POWER_DECIBEL, Estimate, mean_estimate, ratio_of_means, student
from validation.analysis.study import Outcomes
from validation.cases.punch import bandwidth
from validation.cases.rail import contact_filter
from validation.cases.rail.filters import linear_filter, scene_of
from validation.cases.rail.rolled_filters import OVER_BEM, RolledFilters, RolledFiltersResult
from validation.cases.rolling import force_spectrum
from validation.cases.rolling.force_spectrum import SPRINGS
from validation.cases.wheel import half_space, half_space_study
from validation.simulation.model_names import BEM, LINEAR, LINEAR_ON_LINE, SPRINGS_ON_LINE
from validation.simulation.rail_strip import strip_bands
from validation.theory.rolling import level_ratio


def test_limits_end_where_one_of_several_quantities_does_not_agree():
    numbers = [*by_height(AGREE, AGREE), *by_height(AGREE, DIFFER, quantity="slope")]
    judged = Claim(says="It is so.", along="h/d").judged(numbers)
    assert (judged.status, judged.limits) == (ClaimStatus.LIMITED, "h/d up to 0.1")


@pytest.mark.parametrize(("along", "limits"), [("q", "q up to 4"), ("-q", "q from 4 on")])
def test_limits_along_ranges_end_at_the_far_end_of_the_last_that_agrees(along, limits):
    ranges = ((1.0, 2.0), (2.0, 4.0), (4.0, 8.0), (8.0, 16.0))
    verdicts = (AGREE, AGREE, DIFFER, DIFFER)
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
    assert worst([agrees, undecided], "q a").verdict is Verdict.UNDECIDED
    assert worst([point(6.0, 2.0, at=1.0), point(3.0, 0.4, at=2.0)], "q a").where["worst at"] == 1.0


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


# --- bandwidth of a punch ---------------------------------------------------------------------------------------------

PUNCHES = bandwidth.Bandwidth(cells=16, surfaces=12, pairs=(8, 8), refined=12, rolled_off=12, profiles=12, points=64)


def pressed(narrow, refined, wider, springs):
    """Stiffnesses that are factors of the same surfaces, but for springs, and for boundary elements with a roll-off."""
    rng = np.random.default_rng(0)
    one, own = rng.lognormal(0, 0.1, (2, 12, len(PUNCHES.forces)))
    factors = {"narrow": narrow, "refined": refined, "rolled off": 1.0}
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


def test_a_change_of_the_band_is_of_springs_less_of_boundary_elements_and_all_decades_hold_at_once():
    """Springs 10 % stiffer in each wider band, boundary elements 2 %, and nothing with a roll-off but springs, 21 %."""
    numbers = numbers_of(pressed(1.0, 1.0, 1.02, (1.0, 1.1, 1.21, 1.21)))
    for place in ((4.0, 8.0), (8.0, 16.0)):
        found = numbers_with(numbers, bandwidth.CHANGE + bandwidth.MEAN, **{bandwidth.BANDWIDTH: place})
        assert [n.value for n in found] == pytest.approx([20 * math.log10(1.1 / 1.02)] * 3)
        assert [n.reference for n in found] == [0.0] * 3
    rolled = numbers_with(numbers, bandwidth.CHANGE + bandwidth.MEAN, **{bandwidth.ROLL_OFF: 4.0})
    assert [n.value for n in rolled] == pytest.approx([20 * math.log10(1.21)] * 3)
    # two statistics, three decades, two changes of the band
    assert bandwidth._ranges(PUNCHES) == 12


# --- contact filter ---------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def rail():
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


def test_a_filter_over_boundary_elements_has_the_errors_of_both_in_the_bands_that_count(rail, monkeypatch):
    monkeypatch.setattr(contact_filter, "models_of", lambda key: (BEM, LINEAR, LINEAR_ON_LINE, SPRINGS_ON_LINE))
    (key,) = rail.case.keys
    coarse, fine = rail.case.cells
    numbers, bem = numbers_of(contact_filter._of_strips(rail, key)), rail.over_twin(key, BEM)
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


def test_filters_beside_the_published_table_and_in_decibel_a(rail):
    wheel = next(iter(contact_filter.columns_of_table()))
    keep, table = contact_filter.compared(wheel), contact_filter.a3_of_table(wheel)
    found = numbers_of(contact_filter._of_table(wheel, rail.case.across))
    for model in (LINEAR, LINEAR_ON_LINE):
        off = (linear_filter(scene_of(wheel), model, "isotropic") - table)[keep]
        (number,) = numbers_with(found, model=model)
        assert number.value == pytest.approx(math.sqrt(np.mean(off**2))) and number.grid == pytest.approx(0.05)
    (ridges,) = contact_filter._in_decibel_a(rail, LINEAR_ON_LINE, "ridges").numbers
    (ground,) = contact_filter._in_decibel_a(rail, LINEAR_ON_LINE, "isotropic ground").numbers
    assert (ridges.role, ground.role) == (Role.IDENTITY, Role.FINDING)
    assert abs(ridges.value) < 1e-6 and ground.value > 0.1


# --- the wheel in three dimensions ------------------------------------------------------------------------------------


def test_a_wheel_in_three_dimensions_is_judged_by_the_worst_band_of_each_range():
    """With grid and solver added up; intervals of all bands of a range and of five numbers hold at once."""
    over = Estimates(Estimate(x, 0.05, 6) for x in (0.1, -0.3, 0.2, 0.0, 0.4))
    levels = SimpleNamespace(
        ratio=over,
        bem=np.arange(5.0),
        grid=np.array([0.01, 0.02, 0.03, 0.04, 0.05]),
        solver=np.full(5, 0.005),
        centres=np.arange(1.0, 6.0),
        ranges={"one": np.arange(5) < 2, "other": np.arange(5) > 1, "none": np.zeros(5, bool)},
        over_bem=lambda model: over,
        result=SimpleNamespace(case=SimpleNamespace(scene=SimpleNamespace(jump=1.0))),
    )
    series = list(half_space_study._of_bands(levels))
    numbers = numbers_with(numbers_of(series), half_space_study.LEVEL, half_space.OVER_BEM[half_space.GEIKE])
    expected = [("one", 2.0, -0.3, 0.025, 2), ("other", 5.0, 0.4, 0.055, 3)]
    for number, (name, at, value, grid, points) in zip(numbers, expected, strict=True):
        assert (number.where["range"], number.where["worst at"]) == (name, at)
        assert (number.value, number.grid) == pytest.approx((POWER_DECIBEL * value, POWER_DECIBEL * grid))
        assert number.sample == pytest.approx(POWER_DECIBEL * 0.05 * student(5, 1 - 0.05 / (5 * points)))
        assert number.tolerance == 1.0
    without = Estimates((replace(over[0], value=-math.inf), *over[1:]))
    levels.over_bem = lambda model: without
    assert {n.where["range"] for n in numbers_of(half_space_study._of_bands(levels))} == {"other"}
    (shown,) = (one for one in series if (one.quantity, one.model) == (half_space_study.LEVELS, half_space.GEIKE))
    np.testing.assert_allclose(shown.found, over.values + levels.bem)


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


def test_levels_are_judged_in_both_ranges_and_linear_theory_must_hold_over_low_roughness(monkeypatch):
    """Linear theory is 2 in each band, nothing in 1D below the roughness; springs 1.3, and 1.5 with the other rule."""
    bands, inside, low = len(ROLLING.bands.centres), ROLLING.bands_in(1.0, 8.0), ROLLING.bands_in(0.5, 1.0)
    monkeypatch.setattr(force_spectrum, "level_3d", lambda *_: np.full(bands, 2.0))
    monkeypatch.setattr(force_spectrum, "level_1d", lambda *_: np.where(inside, 2.6, 0.0))
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
