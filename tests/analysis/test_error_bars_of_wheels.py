"""Error bars of the spectra of wheels, on populations with a known answer."""

import math

import numpy as np
import pytest

from tests.analysis.intervals import covered, ends, holds
from validation.analysis.case import Outcomes
from validation.analysis.series import Estimates
from validation.analysis.statistics import POWER_DECIBEL, Estimate
from validation.cases.wheel import distance as wheel_distance
from validation.cases.wheel import half_space as wheel_3d
from validation.cases.wheel import spectrum as wheel
from validation.cases.wheel.ensembles import FLOOR, Spectrum, measured


def test_the_law_of_the_break_covers_its_truth():
    """Breaks that scatter as their standard errors say, of ten groups each."""
    rng, groups = np.random.default_rng(0), 10
    duration = 2.0 ** np.arange(5)

    def drawn():
        own = 0.05 * np.array([1.0, 1.0, 1.0, 2.0, 2.0])
        breaks = 1e4 * duration**0.4 * np.exp(own * rng.standard_normal(5))
        seen = own * breaks * np.sqrt(rng.chisquare(groups - 1, 5) / (groups - 1))
        found = Estimates(Estimate(*one, groups) for one in zip(breaks, seen, strict=True))
        law = wheel_distance.law_of_break(duration, found)
        return law.value, law.half_width_among(3)

    assert holds(covered(drawn, 0.4), short=0.02, wide=0.03)


def test_the_level_over_linear_theory_covers_its_truth():
    """Groups of wheels whose level is that of linear theory but for a factor of their own: 10 lg of the mean."""
    rng, scene = np.random.default_rng(3), wheel_distance.TABLE
    omega = np.arange(1, 400) * 2 * scene.cutoff / 400
    linear = Spectrum(scene, omega, np.ones((1, 399)), np.ones((1, 399)), np.ones(1), 1e-6, 0.05).linear

    def drawn():
        hann = 1.3 * linear * rng.gamma(100, 1 / 100, (6, 1))
        spectrum = Spectrum(scene, omega, hann, hann, 1e-3 * np.ones(6), 1e-6, 0.05)
        # all bands of a group share its factor
        first = next(wheel.levels_over_linear(spectrum)[0].rows())
        return first["value"], first["high"] - first["value"]

    assert holds(covered(drawn, 10 * math.log10(1.3), trials=300), trials=300, short=0.01)


@pytest.mark.slow
def test_a_feature_covers_its_truth():
    """The floor B / omega^2 of groups that differ by a factor, jackknifed."""
    rng, scene = np.random.default_rng(4), wheel_distance.TABLE
    omega = np.arange(1, 1200) * 3 * scene.cutoff / 1200
    shape = (2 * np.sin(omega * 1e-6 / 2) / 1e-6) ** -2

    def drawn():
        plain = 7.0 * shape * rng.gamma(100, 1 / 100, (8, 1))
        hann = (scene.jump / omega) ** 4 + 1e-3 * shape + 0 * plain
        return ends(measured(Spectrum(scene, omega, plain, hann, rng.standard_normal(8), 1e-6, 0.05))[FLOOR])

    assert holds(covered(drawn, 7.0, trials=60), trials=60)


def strips_of(factor, rng_seed=0, count=3, steps=720):
    """Series of boundary elements `factor` times the linear ones."""
    linear = np.random.default_rng(rng_seed).standard_normal((count, steps))
    return [{"bem": factor * x, "linear": x, "time step": np.array(1e-5), "failed": np.zeros(1)} for x in linear]


def test_what_grid_and_solver_leave_open_in_three_dimensions():
    """To first order in the cells: levels on cells of no size, of which the change is left; the solver, all of it."""
    case = wheel_3d.Wheel3D(strips=3, finer=2)
    louder = 10 ** (1 / 20)
    strips = {
        wheel_3d.STRIPS: strips_of(1.0),
        wheel_3d.FINER: strips_of(louder, count=2),
        wheel_3d.LOOSE: strips_of(1.0, 7, 1),
        wheel_3d.TIGHT: strips_of(louder**0.1, 7, 1),
    }
    levels = wheel_3d.WheelLevels(Outcomes(case, strips))
    np.testing.assert_allclose(POWER_DECIBEL * levels.solver, 0.1, rtol=1e-9)
    np.testing.assert_allclose(POWER_DECIBEL * levels.left.values, 1.1, rtol=1e-9)
    np.testing.assert_allclose(POWER_DECIBEL * levels.ratio.values, 2.0, rtol=1e-9)
    assert max(one.error for one in levels.left) < 1e-12


def test_a_band_in_three_dimensions_has_all_of_its_errors():
    """Both samples in quadrature, as they are independent."""
    case = wheel_3d.Wheel3D(strips=3)
    strips = [{**one, "bem": f * one["bem"]} for one, f in zip(strips_of(1.0), (0.9, 1.0, 1.2), strict=True)]
    levels = wheel_3d.WheelLevels(Outcomes(case, {wheel_3d.STRIPS: strips, wheel_3d.FINER: strips}))
    bands = len(levels.centres)
    groups = 0.01 * np.random.default_rng(0).standard_normal((6, bands))
    springs = Estimates.ratios(np.exp(groups), np.ones(bands))
    levels.__dict__.update(springs=lambda model: springs, exact=np.zeros(bands))
    theory, springs = (levels.over_bem(model)[0] for model in (wheel_3d.LINEAR_3D, wheel_3d.GEIKE))
    # of small logarithms, the spread of their means
    own = groups[:, 0].std(ddof=1) / math.sqrt(6)
    assert math.sqrt(springs.error**2 - theory.error**2) == pytest.approx(own, rel=0.02)
    assert theory.error > 0 and theory.samples == 3 <= springs.samples
