"""Data have what was found: no floor, cap or mask of a figure or of a judgement reaches them."""

import math
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from tests.advice.test_model_selection import outcome as selected
from tests.cases.test_fractal_punch import synthetic
from tests.cases.test_limits import STEEP
from tests.seeded import catches
from validation.advice.cases import model_selection as ladder
from validation.advice.cases import model_selection_study as calibration
from validation.analysis.case import Outcomes
from validation.analysis.evidence import Verdict, numbers_with
from validation.analysis.series import Estimates, Series, tables_of
from validation.analysis.statistics import Interval
from validation.cases.limits import limits
from validation.cases.limits.sweeps import Sweep
from validation.cases.punch import fractal_punch
from validation.cases.punch.ensembles import DEVIATION, OVER
from validation.cases.punch.fractal_punch import SCATTER
from validation.cases.punch.fractal_punch_study import PRINTED
from validation.cases.rolling import force_spectrum as rolling
from validation.cases.stability import wheel_stability
from validation.cases.wheel.half_space import LOOSE, TIGHT, WheelLevels
from validation.railway.cases import across, across_study

# --- the punch of Fig. 14.1 ---


def floored(statistics, hurst, method, statistic, level):
    """The ratio as it is judged, in the place of the one that was found."""
    return statistics.counted(hurst, method, level)


@catches("a floor of a judgement in the data", apart=0.0, spread=0.1).at(
    "validation.cases.punch.fractal_punch.PunchStatistics.ratio", floored
)
@pytest.mark.parametrize("apart", [0.0, 0.2, 0.5, 0.96, 1.0, 3.0])
@pytest.mark.parametrize("spread", [0.002, 0.012, 0.1])
def test_the_ratio_of_two_deviations_is_that_of_the_deviations(apart, spread):
    """Zero where springs do not deviate, however small both are."""
    evidence = synthetic(apart=apart, spread=spread)
    found = evidence.table(SCATTER)
    springs, bem = (found.where(model=model)["value"] for model in ("springs", "boundary elements"))
    for quantity in (DEVIATION, DEVIATION + PRINTED):
        np.testing.assert_allclose(evidence.table(quantity).where(model=OVER)["value"], springs / bem, rtol=1e-9)
    assert springs == pytest.approx(apart * spread * np.ones(springs.size), rel=0.01)


@catches("a rule of judgement that nobody applies", *(0.5, 0.005, Verdict.WITHIN, 0.0)).at(
    "validation.cases.punch.fractal_punch.LEAST", -math.inf
)
@pytest.mark.parametrize(
    ("apart", "spread", "verdict", "value"),
    [
        # both below 1 %: alike
        (0.5, 0.005, Verdict.WITHIN, 0.0),
        (0.0, 0.005, Verdict.WITHIN, 0.0),
        # 0.6 % beside 1.2 %: the value is what was found
        (0.5, 0.012, Verdict.OUTSIDE, 20 * math.log10(0.5)),
        # 0.9 % beside 1.03 %: the rule alone makes them agree, 1 % beside 1.03 %
        (0.87, 0.0103, Verdict.WITHIN, 20 * math.log10(1 / 1.03)),
        # nothing beside 10 %, which has no decibels: 1 % beside 10 %
        (0.0, 0.1, Verdict.OUTSIDE, -20.0),
        (0.97, 0.1, Verdict.WITHIN, 20 * math.log10(0.97)),
    ],
)
def test_below_one_per_cent_two_deviations_are_alike_in_verdicts_which_say_so(apart, spread, verdict, value):
    """The reason of a number has the rule where the verdict, or the value, is owed to it, and nowhere else."""
    evidence = synthetic(apart=apart, spread=spread, surfaces=4000)
    for number in numbers_with(evidence.numbers, DEVIATION, OVER):
        assert number.verdict is verdict and number.value == pytest.approx(value, abs=0.03)
        by_rule = apart == 0 or (verdict is Verdict.WITHIN and spread < 0.02)
        assert (fractal_punch.RULE in number.reason) is by_rule


# --- other cases ---


shown = limits.shown


def no_less_than_the_panel_shows(sweep):
    for one in shown(sweep):
        yield Series(one.quantity, one.model, [max(x, 0.04) for x in one.values], along=one.along, at=one.at)


@catches("the floor of a panel in the data").at("validation.cases.limits.limits.shown", no_less_than_the_panel_shows)
def test_the_data_of_a_limit_are_the_errors_of_its_sweep():
    """Smaller than a hundredth of the tolerance too, which is where the panel ends."""
    error = np.array([0.0, 1e-9, 5.0, math.inf])
    sweep = Sweep(STEEP, np.array([0.5, 1.0, 3.0, 4.0]), error, 2.0, ("", "", "words", "words"))
    (table,) = tables_of(list(limits.shown(sweep)))
    assert table.where(model="error")["value"].tolist() == pytest.approx([0.0, 1e-9, 5.0, math.nan], nan_ok=True)
    assert table.where(model="message")["value"].tolist()[2] == 5.0
    assert limits.panel(STEEP).least[1] == STEEP.fails.tolerance / 100 == min(table.where(model="threshold")["value"])


def test_a_sweep_without_a_threshold_says_that_its_number_is_the_end():
    sweep = Sweep(STEEP, np.array([0.5, 1.0, 3.0, 4.0]), np.zeros(4), 2.0, ("",) * 4)
    (number,) = limits.threshold(sweep).numbers
    assert number.value == math.log2(4.0 / 2.0) and number.verdict is Verdict.INCONCLUSIVE
    assert "the value is the end of the sweep" in number.reason
    passed = replace(sweep, error=np.array([0.0, 1.0, 9.0, 9.0]))
    assert "end of the sweep" not in limits.threshold(passed).numbers[0].reason


def test_errors_of_selected_models_are_those_of_the_scenes():
    trials = [selected(1e-6, 1e-9, 5.0, 10.0), selected(0.1, 0.05, 5.0, 10.0)]
    case = ladder.CalibrationTest(punches=2, spheres=0, rolling=0, wheels=0, tolerances=(0.1,))
    evidence = calibration.STUDY.evidence(Outcomes(case, {"random": trials, "edges": []}))
    for quantity in (calibration.TRUE, calibration.SAVED):
        table = evidence.table(quantity)
        assert sorted(table[calibration.ESTIMATED])[-3 if quantity == calibration.TRUE else 0] <= 1e-4
        assert 1e-6 in table[calibration.ESTIMATED]
    assert 1e-9 in evidence.table(calibration.TRUE)["value"]


def test_nothing_is_far_off_where_no_tolerance_was_met():
    case = ladder.CalibrationTest(punches=1, spheres=0, rolling=0, edges=(("punch", 1),))
    for met, count in ((0.0, 0), (1.0, 1)):
        edge = {**selected(0.1, 0.05, 0, 0, met=met), "refused": np.array(""), "offered": np.array(0.0)}
        outcomes = {"random": [selected(0.1, 0.05, 5.0, 10.0)], "edges": [edge]}
        numbers = calibration.STUDY.evidence(Outcomes(case, outcomes)).numbers
        assert len(numbers_with(numbers, calibration.FAR_OFF)) == count


CROSSING = across.AcrossResult(across.Across(), {})
KEY = CROSSING.case.smooth[0]


def test_a_filter_that_is_off_in_the_first_band_reaches_no_wave(monkeypatch):
    """Down to the last band within 1 dB; to none where the longest waves are beyond it."""
    bands = len(across.strip_bands(CROSSING.case.scene(KEY)))
    monkeypatch.setattr(across, "counted", lambda a3: np.ones(bands, dtype=bool))
    monkeypatch.setattr(across.AcrossResult, "linear", lambda *_: np.zeros(bands))
    monkeypatch.setattr(across.AcrossResult, "left_by_grid", lambda *_: np.zeros(bands))
    for first, reach in ((0.0, True), (2.0, False)):
        off = np.array([first, 0.1, 0.2, *[5.0] * (bands - 3)]) / across.POWER_DECIBEL
        monkeypatch.setattr(
            across.AcrossResult,
            "over_linear",
            lambda _, key, model, off=off: Estimates.exact(np.zeros(bands) if model == across.BEM else off),
        )
        found = [one.values[0] for one in across._over_bem(CROSSING, KEY) if one.quantity == across.REACH]
        assert found and np.isfinite(found).all() == reach
        at = across.filters.millimetres(across.strip_bands(CROSSING.case.scene(KEY)))
        assert not reach or set(found) == {at[2]}


@pytest.mark.parametrize(
    ("alpha", "half", "said"),
    [
        (across.FINE_ALPHAS[0], 0.0, "0.05 and less"),
        (across.FINE_ALPHAS[-1], 0.0, "8 and more"),
        (0.5, 0.001, "0.50 ± 0.01"),
        (0.5, 0.0, "0.50 ± 0.00"),
        (0.5, 0.021, "0.50 ± 0.03"),
    ],
)
def test_a_border_at_an_end_of_the_search_is_said_to_be_one(alpha, half, said):
    assert across_study._border(Interval(float(alpha), half)) == said


@pytest.mark.parametrize("found", [0.0, 1e-5, 0.5, 1.1])
def test_roughness_that_is_not_found_has_no_level_and_differs_by_a_rule(monkeypatch, found):
    case = rolling.ForceSpectrum(heights=(0.01,))
    bands, height = len(case.bands.centres), 0.01
    true = rolling.over_bands(rolling.TrackSpectrum(case.spectrum, "geike"), case.bands)
    for name in ("by_mean_filter", "by_filter_3d"):
        monkeypatch.setattr(rolling, name, lambda bands, levels: found * true)
    level = np.ones((6, bands))
    outcome = {"level": level, "linear level": level}
    result = Outcomes(case, {(rolling.BEM, height): outcome, (rolling.REFINED, height): outcome})
    for series in rolling._roughness(result, height):
        (table,) = (one for one in tables_of([series]) if one.name == rolling.FOUND)
        values = np.array(table["value"], dtype=float)
        if found == 0:
            assert np.isneginf(values).all()
        else:
            assert values == pytest.approx(10 * math.log10(found) * np.ones(values.size), abs=1e-9)
        (number,) = (one for one in series.numbers if one.quantity == "rms of " + rolling.FOUND)
        expected = 30.0 if found == 0 else abs(10 * math.log10(found))
        assert number.value == pytest.approx(expected, abs=1e-6)
        # the verdict differs either way: only what has no level owes its value to the rule
        assert number.verdict is (Verdict.OUTSIDE if found < 1 else Verdict.WITHIN)


def test_a_step_that_turns_by_no_angle_has_no_period():
    x = np.array([0.5, 1.0, 1.5])
    found = {"angle": np.array([0.5, 0.0, 1.6]), "growth": np.ones(3), "change": np.zeros(3)}
    first, *_ = wheel_stability.linear_vibration("velocity Verlet", x, found)
    assert first.quantity == wheel_stability.PERIOD
    assert first.values.tolist() == pytest.approx([0.0, math.nan, 1 - 1.5 / 1.6], nan_ok=True)


def test_a_band_without_a_line_takes_the_largest_change_of_the_solver(monkeypatch):
    """Not none: what was not measured is not exact."""
    levels = iter((np.array([1.0, 1.0, math.nan]), np.array([1.1, 1.3, math.nan])))
    result = SimpleNamespace(
        result={LOOSE: None, TIGHT: None}, of_strips=lambda *_: (next(levels),), centres=np.zeros(3)
    )
    solver = WheelLevels.solver.func(result)
    assert solver == pytest.approx(np.log([1.1, 1.3, 1.3]))
