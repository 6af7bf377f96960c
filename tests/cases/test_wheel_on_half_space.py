"""Boundary elements in the time loop: strips, the linear contact, what does not converge."""

from dataclasses import replace

import numpy as np
import pytest

from tests.cases.planted import BOTH, LOW, ROUNDING
from tests.seeded import Times, catches
from validation.simulation.motion import natural_periods
from validation.simulation.wheel_on_half_space import WheelStrip, simulate_strip


def strip(scene=LOW, **settings):
    given = {"realisation": 0, "natural_periods": 0, "width": 2, "cells": 4, "shared": 2, "tolerance": 1e-8, "seed": 1}
    return WheelStrip(scene=scene, **{**given, **settings})


def test_strips_are_the_same_surface_on_grids_with_a_divisor():
    """Cells of a third: the coarse centres are among the fine ones; as long, and as wide."""
    coarse, fine = strip(cells=4, shared=4), strip(cells=12, shared=4)
    assert fine.surface()[1::3, 1::3] == pytest.approx(coarse.surface(), abs=1e-10 * LOW.rail.rms)
    assert fine.shape[0] * fine.spacing == pytest.approx(coarse.shape[0] * coarse.spacing, rel=ROUNDING)
    assert coarse.surface().std() == pytest.approx(LOW.rail.rms, rel=ROUNDING, abs=0)
    turn = natural_periods(LOW.body, coarse.shape[0] * coarse.spacing, LOW.speed)
    assert turn == pytest.approx(0.5, abs=0.5 * natural_periods(LOW.body, LOW.contact_radius / 4, LOW.speed))
    with pytest.raises(ValueError, match="cells must be a multiple of shared, got 5 and 2"):
        strip(cells=5)


@pytest.mark.parametrize("scene", [replace(LOW, ground=None), BOTH], ids=["smooth", "rough wheel"])
def test_a_strip_is_that_of_a_rough_rail_alone(scene):
    with pytest.raises(ValueError, match="scene must have a rough rail and a smooth wheel"):
        strip(scene)


@catches("factor 2 lost in linear theory, seen by boundary elements in the loop").at(
    "validation.simulation.wheel_on_half_space.linear_force", Times(0.5)
)
@pytest.mark.slow
def test_a_low_strip_is_the_linear_contact():
    """At h / d = 1e-3, step by step: what is left is of the grid, first order in the cells: a circle whose radius is
    known to half a cell answers the force of a wave with as much error, 1 / (2 cells)."""
    worst = {}
    for cells in (4, 8):
        outcome = simulate_strip(strip(cells=cells))
        assert outcome["failed"] == 0
        worst[cells] = np.abs(outcome["bem"] - outcome["linear"]).max() / outcome["linear"].std()
        assert worst[cells] <= 0.5 / cells
    assert worst[8] < 0.6 * worst[4]


@pytest.mark.slow
@pytest.mark.filterwarnings("default")
def test_a_strip_that_does_not_converge_has_no_acceleration_but_of_the_linear_contact():
    lost = simulate_strip(strip(tolerance=1e-18))
    assert lost["failed"] == 1
    assert np.isnan(lost["bem"]).all() and np.isfinite(lost["linear"]).all()
