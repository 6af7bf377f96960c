"""A wheel on a rail: what lifts it at constant load and in motion, on boundary elements and on springs."""

import numpy as np
import pytest

import mdr
from tests.railway.power_law_ground import isotropic_strip
from tests.seeded import catches
from validation.railway.problems import wheel_on_rail
from validation.railway.problems.wheel_on_rail import SurfaceSpringsLaw, WheelOnRail
from validation.simulation.contact_laws import HertzLaw
from validation.simulation.model_names import BEM
from validation.simulation.model_names import SPRINGS_THAT_READ as SPRINGS
from validation.simulation.motion import simulate

CELL = 1e-3
STRIP = isotropic_strip(1e-7, 0.18, CELL)


def problem(model, rms=1e-7):
    strip = isotropic_strip(rms, 0.18, CELL)
    return WheelOnRail(strip=strip, mass=500.0, speed=22.0, model=model, tolerance=1e-6)


def outcome_of(model, rms=1e-7):
    return wheel_on_rail.roll_and_move(problem(model, rms))


def off(track, other):
    """Largest difference of two tracks about their means, over the largest of the second."""
    track, other = (x - x.mean() for x in (track, other))
    return np.abs(track - other).max() / np.abs(other).max()


@pytest.mark.parametrize("model", [BEM, SPRINGS])
def test_over_little_roughness_motion_lifts_as_linear_theory_does(model):
    """At constant load and in motion, with six cells to a semi-axis: the resonance does not show in the lift."""
    outcome = outcome_of(model)
    for name in ("constant", "moving"):
        assert off(outcome[name], outcome["linear"]) < 0.12


@catches("a linear spring for Hertz in what lifts a wheel").at(
    "validation.railway.problems.wheel_on_rail.lift",
    lambda wheel, force, approach: wheel.approach + (force - wheel.load) / wheel.stiffness - approach,
)
def test_a_wheel_that_vibrates_on_a_smooth_rail_is_not_lifted():
    """The approach of Hertz under the force is the approach itself, however large the vibration is."""
    wheel = problem(SPRINGS).wheel
    motion = simulate(
        wheel, HertzLaw(wheel), time_step=2e-5, steps=400, approach=np.array([0.6 * wheel.approach]), path=True
    )
    force = wheel.mass * motion.acceleration[:, 0] + wheel.load
    lift = wheel_on_rail.lift(wheel, force, motion.path[:, 0])
    assert np.abs(lift).max() < 1e-9 * wheel.approach
    assert np.ptp(force) > wheel.load


@catches("a lift in flight").at(
    "validation.railway.problems.wheel_on_rail.lift",
    lambda wheel, force, approach: wheel.approach * (np.maximum(force, 0.0) / wheel.load) ** (2 / 3) - approach,
)
def test_a_wheel_in_flight_has_no_lift_and_is_lifted_by_the_roughness_that_it_stands_on():
    wheel = problem(SPRINGS).wheel
    d, r = wheel.approach * np.array([-0.5, 0.5, 1.0]), 1e-6
    force = HertzLaw(wheel).force(0, d + r)
    lift = wheel_on_rail.lift(wheel, force, d)
    assert np.isnan(lift[0]) and lift[1:] == pytest.approx(r, rel=1e-9)


def test_the_sphere_in_place_of_the_ellipse_has_its_load_curve_and_its_stiffness():
    wheel, contact = problem(BEM).wheel, STRIP.contact
    assert wheel.approach == pytest.approx(contact.approach, rel=1e-9)
    assert wheel.stiffness == pytest.approx(contact.stiffness, rel=1e-9)
    assert wheel.contact_radius == pytest.approx(contact.along, rel=1e-9)


def middle_line(half_widths, points, step):
    weights = np.zeros((points, half_widths.size))
    weights[points // 2] = 1.0
    return weights


@catches("springs in a time step that read one line").at(
    "validation.railway.problems.wheel_on_rail.weights_across", middle_line
)
def test_springs_in_a_time_step_are_those_of_a_track():
    """At each place the law carries the load at the approach of `mdr.roll_surface`."""
    rough = problem(SPRINGS, rms=3e-6)
    law = SurfaceSpringsLaw(rough.wheel, rough.strip)
    rolled = mdr.roll_surface(
        rough.strip.surface, spacing=CELL, radius=STRIP.radii, modulus=STRIP.modulus, force=STRIP.force
    )
    for place in (0, 50, 179):
        assert law.force(place, rolled.approach[place : place + 1])[0] == pytest.approx(STRIP.force, rel=1e-9)
