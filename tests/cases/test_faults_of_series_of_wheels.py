"""The same of the wheel in three dimensions: bands, slope, and which over which."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from tests.analysis.test_error_bars_of_wheels import strips_of
from tests.seeded import catches
from validation.analysis.case import Outcomes
from validation.analysis.evidence import numbers_with
from validation.analysis.series import Estimates, numbers_of
from validation.analysis.statistics import POWER_DECIBEL, Estimate, student
from validation.cases.wheel import half_space, half_space_study


@catches("one number of the claim on the wheel for all of them").at(
    "validation.cases.wheel.half_space_study.OF_FIGURE", 1
)
def test_a_wheel_in_three_dimensions_is_judged_by_the_worst_band_of_each_range():
    """With grid and solver added up; intervals of all bands of a range and of five numbers hold at once."""
    over = Estimates(Estimate(x, 0.05, 6) for x in (0.1, -0.3, 0.2, 0.0, 0.4))
    levels = SimpleNamespace(
        ratio=over,
        bem=np.arange(5.0),
        left=Estimates(Estimate(x, 0.0, 6) for x in (0.015, 0.025, 0.035, 0.045, 0.055)),
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
    # three numbers of the claim on linear theory, five of that on springs
    (linear, _) = numbers_with(numbers_of(series), half_space_study.LEVEL, half_space.OVER_BEM[half_space.LINEAR_3D])
    assert linear.sample == pytest.approx(POWER_DECIBEL * 0.05 * student(5, 1 - 0.05 / (3 * 2)))
    (shown,) = (one for one in series if (one.quantity, one.model) == (half_space_study.LEVELS, half_space.GEIKE))
    np.testing.assert_allclose(shown.values, over.values + levels.bem)


def test_models_are_taken_over_boundary_elements_as_loud_as_their_strips():
    """20 % more acceleration than the linear contact has on each strip: linear theory is 1.6 dB below."""
    strips = [{**one, "bem": 1.2 * one["linear"]} for one in strips_of(1.0)]
    found = {half_space.STRIPS: strips, half_space.FINER: strips}
    levels = half_space.WheelLevels(Outcomes(half_space.Wheel3D(strips=3), found))
    levels.__dict__.update(exact=np.zeros(levels.centres.size))
    np.testing.assert_allclose(POWER_DECIBEL * levels.over_bem(half_space.LINEAR_3D).values, -20 * math.log10(1.2))


def test_the_power_law_of_region_3_is_that_of_the_roughness():
    """A of -2 H - 3 in all groups but for their scatter, with a jump of its own beyond the range of the slope."""
    scene = half_space.TABLE
    omega = np.linspace(0.5 * scene.jump, scene.cutoff, 4000)
    exponents = -2 * 0.7 - 3 + 0.01 * np.array([-1.0, 0.0, 1.0, 0.5, -0.5])
    density = (omega / scene.jump) ** exponents[:, np.newaxis] * np.where(omega < 0.75 * scene.cutoff, 1.0, 1e-3)
    levels = SimpleNamespace(
        result=SimpleNamespace(case=SimpleNamespace(scene=scene)),
        spectra=lambda _: (omega, density),
        on_grids=lambda _: [(omega, density), (omega, density * omega**0.01)],
    )
    numbers = numbers_of(half_space_study._slopes(levels))
    assert len(numbers) == 2
    for n in numbers:
        assert n.reference == pytest.approx(-4.4) and n.value == pytest.approx(-4.4, abs=0.01)
        # the change of the slope on half as long cells, twice
        assert n.grid == pytest.approx(0.02)
        assert n.sample == pytest.approx(np.std(exponents, ddof=1) / math.sqrt(5) * student(4, 0.99), rel=0.1)
