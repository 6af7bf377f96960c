"""What the solver leaves of a stiffness: measured on ensembles, and part of each of their error bars."""

import math

import numpy as np
import pytest

from tests.cases.test_bandwidth import planted
from tests.cases.test_fractal_punch import numbers, synthetic
from tests.cases.test_interface import evidence, theory
from tests.seeded import Times, catches
from validation.advice.models import boundary_elements_pressed
from validation.analysis.evidence import numbers_with
from validation.analysis.statistics import DECIBEL, Resolved
from validation.cases.punch.bandwidth import Deviations
from validation.cases.punch.ensembles import DEVIATION, MEAN
from validation.cases.punch.interface import BESIDE_BEM, FITTED
from validation.simulation import interface, rough_punch
from validation.simulation.interface import press_interface
from validation.simulation.model_names import BEM
from validation.simulation.rough_punch import STIFFNESS_ERROR, PunchRoughness, Surface, force_levels, press_surface

EXACT = 1e-7
"""Residual of fixed areas whose stiffness has all digits that are asked for."""


def stiffnesses(press, module, residual, surfaces=6):
    """A row a surface; the same contacts under any residual of their fixed areas, to a residual of their own."""
    rough = PunchRoughness(hurst=0.7, waves=(1, 16), seed=5)
    with pytest.MonkeyPatch.context() as patch:
        if residual is not None:
            patch.setattr(module, "STIFFNESS_TOLERANCE", residual)
        forces = force_levels((-1, 1), 3)[:-1]
        problems = [
            Surface(roughness=rough, realisation=i, cells=64, forces=forces, tolerance=1e-8) for i in range(surfaces)
        ]
        return np.array([press(problem)["stiffness"] for problem in problems])


@catches("fixed areas of punches to a residual of 3 %", press=press_surface, module=rough_punch).at(
    "validation.simulation.rough_punch.STIFFNESS_TOLERANCE", Times(10.0)
)
@catches("fixed areas of interfaces to a residual of 10 %", press=press_interface, module=interface).at(
    "validation.simulation.interface.STIFFNESS_TOLERANCE", Times(33.0)
)
@pytest.mark.parametrize(("press", "module"), [(press_surface, rough_punch), (press_interface, interface)])
def test_the_error_of_a_stiffness_of_an_ensemble_is_as_stated(press, module):
    """Of the mean, of the standard deviation of the errors, of the largest; and the residual is used, not a finer."""
    exact = stiffnesses(press, module, EXACT)
    finite = np.isfinite(exact)
    errors = np.where(finite, stiffnesses(press, module, None) / np.where(finite, exact, 1.0), 1.0) - 1
    assert np.abs(errors.mean(axis=0)).max() < STIFFNESS_ERROR
    assert errors.std(axis=0).max() < STIFFNESS_ERROR / 2
    assert 0 < np.abs(errors).max() < boundary_elements_pressed.SOLVER == 5 * STIFFNESS_ERROR


LEFT = 3 * STIFFNESS_ERROR


@catches("the solver's error left out of Fig. 14.1").at(
    "validation.analysis.statistics.Resolved.widened", lambda resolved, left: resolved
)
def test_error_bars_of_fig_14_1_and_of_bands_have_the_error_of_the_solver():
    """Grids that agree exactly leave it alone: 2 fine - coarse has three errors of one grid, and a deviation that of
    the errors' own, at most half as large as an error, over the deviation."""
    found, spread = synthetic(), 0.1
    assert [n.grid for n in numbers(found, MEAN)] == pytest.approx([DECIBEL * LEFT] * 2)
    of_deviation = LEFT * (1 + 0.5 / spread)
    assert [n.grid for n in numbers(found, DEVIATION)] == pytest.approx([DECIBEL * of_deviation] * 2, rel=5e-3)
    bands = Deviations(planted())
    for deviation in bands.resolved(BEM, 0.7, 2).values():
        assert deviation.grid == pytest.approx(LEFT * (1 + 0.5 / math.exp(deviation.value.value)))
    # of the slope over a decade of bandwidth, both ends
    assert bands.slope(0.7, 2).grid == pytest.approx(2 * of_deviation, rel=0.05)


@catches("the solver's error left out of interfaces").at("validation.simulation.rough_punch.STIFFNESS_ERROR", 0.0)
def test_error_bars_of_interfaces_have_the_error_of_the_solver():
    """On grids that agree exactly, and whichever way finer cells change."""
    (plain, *_), softer = (
        numbers_with(evidence(theory, finer=factor).numbers, BESIDE_BEM, FITTED) for factor in (1.0, 0.9)
    )
    assert plain.grid == pytest.approx(DECIBEL * LEFT, rel=1e-3)
    assert softer[0].grid == pytest.approx(DECIBEL * math.hypot(LEFT, math.log(0.9)), rel=1e-3)


def test_a_wider_value_is_the_same_value():
    value = Resolved("value", 0.3).widened(0.4)
    assert (value.value, value.grid) == ("value", pytest.approx(0.5))
