"""Reduced models of a rolling wheel: the smooth wheel, low waves by linear theory, ridges, and boundary elements."""

import math
from functools import partial

import numpy as np
import pytest

import bem3d
from tests.seeded import Times, catches
from validation.railway.theory.contact_filters import half_space_filter
from validation.simulation import mean_contact as mean
from validation.simulation import reduced_models as reduced
from validation.simulation.pressed import roll_on_layer
from validation.simulation.rolling_strip import RoughStrip
from validation.simulation.track_spectrum import self_affine

DX = 1 / 8
MODELS = (
    reduced.springs_on_a_line,
    reduced.linear_theory,
    reduced.springs_that_read,
    reduced.one_sided_bed,
    roll_on_layer,
    reduced.boundary_elements,
)


def rough_strip(height):
    scene = RoughStrip(spectrum=self_affine(0.7, 1.0, 8.0), height=height, length=16.0, width=7.0, seed=3)
    return scene.surface(8, 0)


@catches("half of the displacement under the mean contact").at(
    "validation.simulation.mean_contact.ring_operator", Times(0.5)
)
def test_the_mean_contact_of_a_smooth_wheel_is_that_of_hertz():
    found = mean.mean_contact(mean.GapLaw(np.array([0.01, 0.1, 1.0]), np.zeros(3)), 1.0)
    assert found.force == pytest.approx(4 / 3, rel=0.01)
    assert found.stiffness == pytest.approx(2.0, rel=0.02)
    r = mean.RADII
    expected = 2 / math.pi * np.sqrt(np.maximum(1 - r**2, 0.0))
    np.testing.assert_allclose(found.pressure[r < 0.9], expected[r < 0.9], rtol=0.02)


@pytest.mark.parametrize("approach", [-0.5, 0.3, 2.0])
def test_the_mean_gap_is_that_of_its_pressure(approach):
    """K p + r^2 / 2 - d = g(p), and its derivative by d."""
    law = mean.GapLaw(np.geomspace(0.01, 1.0, 8), 0.5 * np.geomspace(0.01, 1.0, 8) ** -0.3 - 0.4)
    found, more = (mean.mean_contact(law, approach + step) for step in (0.0, 1e-5))
    touching = found.pressure > 1e-12
    gap = mean.ring_operator() @ found.pressure + mean.RADII**2 / 2 - approach
    np.testing.assert_allclose(gap[touching], law(np.log(found.pressure[touching]))[0], atol=1e-6)
    np.testing.assert_allclose(more.force - found.force, 1e-5 * found.stiffness, rtol=1e-2)


@pytest.mark.parametrize("model", MODELS, ids=lambda model: model.__name__)
def test_a_smooth_wheel_has_the_force_of_hertz(model):
    found = model(1e-9 * rough_strip(1.0), DX)
    assert found.force.mean() == pytest.approx(1.0, rel=0.03)
    assert np.ptp(found.force) < 1e-6
    assert found.work > 0


@catches("a trial on a pressed layer without its step", waves=(2, 0)).at(
    "validation.simulation.pressed._where_no_step_is_left", lambda forces, steps, approach: forces[len(forces) // 2]
)
@pytest.mark.parametrize("waves", [(2, 0), (3, 2), (0, 3), (6, 1)])
def test_low_waves_under_a_pressed_layer_have_the_filter_of_the_half_space(waves):
    nx, ny = 128, 48
    along, across = 2 * np.pi * waves[0] / (nx * DX), 2 * np.pi * waves[1] / (ny * DX)
    x, y = np.arange(nx)[:, np.newaxis] * DX, (np.arange(ny) - (ny - 1) / 2) * DX
    height = 1e-3
    force = roll_on_layer(height * np.cos(along * x) * np.cos(across * y), DX).force
    smooth = roll_on_layer(np.zeros((nx, ny)), DX).force
    mode = np.fft.rfft(force - smooth)[waves[0]].real / nx * (2 if waves[0] else 1)
    # force over that of Hertz, 4 / 3, of a stiffness 2
    expected = 1.5 * height * float(half_space_filter(along, across, semi_axes=(1.0, 1.0)))
    assert mode == pytest.approx(expected, abs=0.06 * 1.5 * height)


def test_over_ridges_springs_that_read_are_those_of_a_line():
    ridges = np.repeat(0.3 * np.random.default_rng(4).standard_normal((96, 1)), 40, axis=1)
    found, line = (model(ridges, DX).force for model in (reduced.springs_that_read, reduced.springs_on_a_line))
    np.testing.assert_allclose(found, line, rtol=1e-9)


def test_a_pressed_layer_follows_boundary_elements_position_by_position_where_springs_do_not():
    strip = rough_strip(0.5)
    truth = reduced.boundary_elements(strip, DX).force
    off = [np.std(model(strip, DX).force - truth) for model in (roll_on_layer, reduced.springs_that_read)]
    assert off[0] < 0.5 * off[1]
    assert np.mean(roll_on_layer(strip, DX).force) == pytest.approx(np.mean(truth), rel=0.03)


@catches("a pressed layer that has not converged").at("bem3d.solve", partial(bem3d.solve, raise_on_failure=False))
def test_a_layer_without_a_solution_is_refused():
    refused = False
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(bem3d, "solve", partial(bem3d.solve, max_iterations=1))
        try:
            roll_on_layer(rough_strip(0.5), DX)
        except bem3d.ConvergenceError:
            refused = True
    assert refused
