"""Faults planted in what `tests/simulation` looks at: where, what is wrong there, and the test that must catch it."""

import dataclasses
import types
from functools import partial

import numpy as np

import bem3d
import mdr
from bem3d import few_cells, rolling_contact
from tests.cases import test_wheel_ensembles, test_wheel_on_half_space
from tests.planted_faults.wrong import E_FOR_E_STAR, force_in_step, scaled
from tests.simulation import (
    test_damping,
    test_flags_of_rolling,
    test_light_punch,
    test_periodic_motion,
    test_profiled_strip,
    test_rail_filters,
    test_rail_sound,
    test_reduced_models,
    test_rough_punches,
    test_time_stepping,
    test_wheel_motion,
    test_wheel_on_rail,
)
from validation.scenes import dynamic_wheel
from validation.scenes.damping import damping_rate
from validation.scenes.wheel_body import Wheel
from validation.simulation import (
    contact_laws,
    equivalent_displacement,
    integrators,
    light_punch,
    mean_contact,
    pressed_layer,
    rail_models,
    rail_quantity,
    ridges,
    rolling_strip,
    rough_punch,
    surface,
    wheel_on_half_space,
    wheel_on_rail,
)
from validation.simulation import motion as wheel_in_motion
from validation.simulation.model_names import LINE
from validation.simulation.rough_punch import PunchRoughness
from validation.theory import spring_input
from validation.theory import wheel as wheel_theory


def without_load(wheel, law, **settings):
    """M z'' = F."""
    weightless = types.SimpleNamespace(load=0.0, mass=wheel.mass, eigenfrequency=wheel.eigenfrequency)
    return wheel_in_motion.simulate(weightless, law, **settings)


def without_a_dashpot(case):
    """The wheel on a rail, whatever damping it is given."""
    springs = wheel_on_rail.spring_wheel(case.strip.radii, case.strip.modulus)
    return Wheel(radius=springs.radius, modulus=springs.modulus, mass=case.mass, load=case.strip.force)


def half_a_fine_cell_aside(height, cells):
    """The mean of neighbours: what it is between them, nearly."""
    fine = surface.refined(height, cells)
    return (fine + np.roll(fine, 1, axis=0)) / 2


def half_of_a_light_force(half_space, gap, *, forces, **settings):
    return few_cells.indent_few_cells(half_space, gap, forces=forces / 2, **settings)


def heavier_loads_as_light_ones(surface):
    return rough_punch.press_surface(dataclasses.replace(surface, forces=tuple(f / 2 for f in surface.forces)))


def by_another(march):
    """What `simulate` does where no scheme is asked for."""
    return {**wheel_in_motion.simulate.__kwdefaults__, "integrator": march}


def half_a_step(scheme):
    """Forces at the right cells, steps of half their length."""
    return dataclasses.replace(scheme, march=lambda f, y, v, dt: scheme.march(f, y, v, dt / 2))


def old_force_in_the_velocity(f, y, v, dt):
    """Velocity Verlet whose velocity has the force of the beginning alone: d is of first order then."""
    place = 0
    while True:
        a = f(place, y)
        yield y, v, a
        y, v, place = y + dt * v + dt**2 / 2 * a, v + dt * a, place + 1


def inverted(omega, *, eigenfrequency, mass, damping):
    """omega / omega_0 for omega_0 / omega."""
    return 1 / (mass * (1 - (np.asarray(omega) / eigenfrequency) ** 2)) ** 2


def without_a_jump(motion):
    return motion.next_acceleration - motion.next_acceleration


def one_copy(wheel, law, **settings):
    """Shooting that rolls and does not correct."""
    start = settings.pop("start")
    for name in ("rounds", "tolerance"):
        settings.pop(name, None)
    motion = wheel_in_motion.simulate(wheel, law(1), **settings, approach=start[0], velocity=start[1])
    return motion.approach, motion.velocity, np.zeros(start[0].shape)


def softer_steady(law, time_step):
    """omega for the 2 sin(omega dt / 2) / dt of leapfrog."""
    frequency = 2 * np.pi * np.fft.rfftfreq(len(law.change), time_step)[:, np.newaxis]
    waves = np.fft.rfft(law.change, axis=0) / (law.wheel.stiffness - law.wheel.mass * frequency**2)
    d = -np.fft.irfft(waves, len(law.change), axis=0)
    return law.wheel.approach + d[0], (d[1] - d[-1]) / (2 * time_step)


def middle_line(half_widths, points, step):
    weights = np.zeros((points, half_widths.size))
    weights[points // 2] = 1.0
    return weights


def line_itself(strip):
    """A line trace in the place of Geike's spectrum."""
    return equivalent_displacement.linear_displacement(strip, LINE)


def springs_on_middle_line(height, *, spacing, **wheel):
    return mdr.roll(height[:, height.shape[1] // 2], spacing=spacing[0], **wheel)


def share_of_oblique_waves(along, across, *, semi_axes):
    """sqrt(e(S)), which is not over e(k_x a_x): waves along the track are filtered twice."""
    return 1 / np.sqrt(1 + (along * semi_axes[0]) ** 2 + (across * semi_axes[1]) ** 2)


def surface_itself(along, across, *, semi_axes):
    """The line, whose level is too high for short waves."""
    return np.ones_like(along + across)


def on_the_fitted_radius(strip, profile):
    """The parabola that stands in for the profile."""
    y = (np.arange(strip.shape[1]) - (strip.shape[1] - 1) / 2) * strip.spacing
    return slice(None), -(y**2) / (2 * strip.radii[1])


def told_of_none(solve):
    """The outcome of a solve, without its flag."""
    return lambda *given, **settings: {**solve(*given, **settings), "failed": np.array(0.0)}


def without_its_flag(place, solve, path):
    """A solve that keeps what failed to itself, and the test that rolls it over a position without a solution."""
    test = partial(test_flags_of_rolling.test_a_position_without_a_solution_is_flagged_and_is_no_number, path)
    return (place, solve, told_of_none(getattr(place, solve))), test


ON_A_RAIL = test_flags_of_rolling.ON_A_RAIL
FLAGS = (
    (test_flags_of_rolling, "roll_strip", "validation.simulation.rolling_strip:roll_strip"),
    (test_flags_of_rolling, "roll_rail", ON_A_RAIL),
    (test_flags_of_rolling, "roll_held_wheel", f"{ON_A_RAIL}, at a constant height"),
    (test_flags_of_rolling, "roll_and_move", f"{ON_A_RAIL}, before it moves"),
    (test_flags_of_rolling, "roll_by_all", "validation.simulation.reduced_models:boundary_elements"),
    (ridges, "roll_over", "validation.simulation.ridges:_roll"),
    (rolling_strip, "roll_loaded_strip", "validation.simulation.rolling_strip:roll_loaded_strip"),
)

FAULTS = {
    **{f"{solve} without its flag": without_its_flag(place, solve, path) for place, solve, path in FLAGS},
    "a rolling contact that always says it has converged": (
        (rolling_contact.WheelContact, "converged", property(lambda contact: True)),
        test_flags_of_rolling.test_a_position_without_a_solution_has_no_number,
    ),
    "numbers of a rolling contact that has not converged": (
        (rolling_contact, "math", types.SimpleNamespace(nan=1.0)),
        test_flags_of_rolling.test_a_position_without_a_solution_has_no_number,
    ),
    "a pressed layer that has not converged": (
        (bem3d, "solve", partial(bem3d.solve, raise_on_failure=False)),
        test_reduced_models.test_a_layer_without_a_solution_is_refused,
    ),
    "a finer grid half a cell aside": (
        (light_punch, "refined", half_a_fine_cell_aside),
        partial(test_light_punch.test_the_same_numbers_as_by_transforms, 128),
    ),
    "half of a light force": (
        (light_punch.bem3d, "indent_few_cells", half_of_a_light_force),
        test_light_punch.test_beside_the_dense_solution,
    ),
    "a load tried on a matrix whatever touches": (
        (light_punch, "_while_few", lambda contacts, forces, most: contacts),
        test_light_punch.test_a_load_that_will_have_many_cells_is_not_tried,
    ),
    "light loads that are not carried on": (
        (light_punch, "press_surface", heavier_loads_as_light_ones),
        partial(test_light_punch.test_heavier_loads_go_on_by_transforms, "OVERLAPPING", 1),
    ),
    "a fitted radius in place of the transverse profile": (
        (equivalent_displacement, "heights_across", on_the_fitted_radius),
        test_profiled_strip.test_a_worn_rail_rolls_as_its_profile_and_not_as_the_radius_of_its_contact,
    ),
    "the rolling spectrum of a rail that filters ridges": (
        (equivalent_displacement, "rolling_input_filter", share_of_oblique_waves),
        test_rail_filters.test_over_ridges_models_are_sinc_squared_above_the_first_zero,
    ),
    "the line taken for the rolling spectrum of a rail": (
        (equivalent_displacement, "rolling_input_filter", surface_itself),
        test_rail_filters.test_short_waves_under_springs_on_the_rolling_spectrum_have_the_level_of_the_half_space,
    ),
    "long waves that do not pass under springs on the rolling spectrum": (
        (equivalent_displacement, "rolling_input_filter", scaled(spring_input.rolling_input_filter, 1.1)),
        partial(test_rail_filters.test_long_waves_pass_under_every_model_but_springs_on_geikes_spectrum, "isotropic"),
    ),
    "the line trace taken for Geike's spectrum under springs on a rail": (
        (equivalent_displacement, "geike_over_line", lambda wavenumber, ground: np.ones_like(wavenumber)),
        partial(
            test_rail_filters.test_long_waves_under_springs_on_geikes_spectrum_are_off_by_his_rule_over_the_line, 2.0
        ),
    ),
    "the line trace taken for Geike's spectrum": (
        (test_rail_sound, "geike_track", line_itself),
        test_rail_sound.test_geikes_track_has_his_spectrum_and_the_phases_of_the_line,
    ),
    "springs that read one line of the surface": (
        (mdr, "roll_surface", springs_on_middle_line),
        test_rail_sound.test_springs_that_read_a_smoother_rail_are_linear_theory,
    ),
    "rms of the ensemble for that of each": (
        (PunchRoughness, "_normalised", lambda roughness, height: height),
        partial(test_rough_punches.test_heights_are_normalised_as_they_say, "bem3d", 1.0),
    ),
    "rms of each for that of the ensemble": (
        (PunchRoughness, "_normalised", lambda roughness, height: height * roughness.height / height.std()),
        partial(test_rough_punches.test_heights_are_normalised_as_they_say, "mdr", 1.0),
    ),
    "half of the displacement under the mean contact": (
        (mean_contact, "ring_operator", scaled(mean_contact.ring_operator, 0.5)),
        test_reduced_models.test_the_mean_contact_of_a_smooth_wheel_is_that_of_hertz,
    ),
    "a trial on a pressed layer without its step": (
        (pressed_layer, "_where_no_step_is_left", lambda forces, steps, approach: forces[len(forces) // 2]),
        partial(test_reduced_models.test_low_waves_under_a_pressed_layer_have_the_filter_of_the_half_space, (2, 0)),
    ),
    "E for E* in the force, not in the approach at rest": (
        (mdr.RollingEnsemble, "force", scaled(force_in_step, E_FOR_E_STAR)),
        test_wheel_motion.test_at_rest_the_wheel_bears_its_load,
    ),
    "load forgotten in the equation of motion": (
        (test_wheel_motion, "simulate", without_load),
        partial(
            test_wheel_motion.test_on_a_smooth_track_a_wheel_stays_at_rest,
            contact_laws.HertzLaw(test_wheel_motion.WHEEL, 2),
            4 * test_wheel_motion.ULP,
        ),
    ),
    "factor 2 in the constant of the dashpot": (
        (wheel_in_motion, "damping_rate", scaled(damping_rate, 2.0)),
        test_damping.test_free_vibration_decays_by_the_exact_law_of_a_dashpot_at_second_order,
    ),
    "a dashpot that drives the wheel": (
        (wheel_in_motion, "damping_rate", scaled(damping_rate, -1.0)),
        test_damping.test_free_vibration_decays_by_the_exact_law_of_a_dashpot_at_second_order,
    ),
    "factor 2 in the dashpot of the steady state": (
        (contact_laws, "damping_rate", scaled(damping_rate, 2.0)),
        partial(test_damping.test_a_sine_brings_the_wheel_into_its_steady_response, 0.5),
    ),
    "damping forgotten on a rail": (
        (wheel_on_rail.WheelOnRail, "wheel", property(without_a_dashpot)),
        partial(test_damping.test_a_wheel_on_a_rail_moves_by_its_equation_with_the_dashpot, test_damping.SPRINGS),
    ),
    "damping forgotten in a scene of springs": (
        (dynamic_wheel, "DampedWheel", lambda damping, **given: Wheel(**given)),
        partial(test_damping.test_a_scene_with_damping_damps_its_wheels_on_springs, True),
    ),
    "explicit Euler where nothing is asked for": (
        (wheel_in_motion.simulate, "__kwdefaults__", by_another(integrators.EXPLICIT_EULER)),
        partial(test_wheel_motion.test_time_reversal, 0.05, 0.0),
    ),
    "symplectic Euler where nothing is asked for": (
        (wheel_in_motion.simulate, "__kwdefaults__", by_another(integrators.SYMPLECTIC_EULER)),
        partial(test_wheel_motion.test_free_vibration_of_a_linear_contact_is_the_exact_one_of_leapfrog, 0.3),
    ),
    "the step of a cell for that of two in Runge and Kutta": (
        (
            test_time_stepping,
            "SCHEMES",
            {**test_time_stepping.SCHEMES, "Runge-Kutta": half_a_step(integrators.RUNGE_KUTTA)},
        ),
        partial(test_time_stepping.test_order_of_a_scheme_on_a_free_vibration, "Runge-Kutta"),
    ),
    "velocity Verlet with the force of the beginning alone": (
        (
            test_time_stepping,
            "SCHEMES",
            {
                **test_time_stepping.SCHEMES,
                "velocity Verlet": dataclasses.replace(integrators.VELOCITY_VERLET, march=old_force_in_the_velocity),
            },
        ),
        partial(test_time_stepping.test_symplectic_schemes_keep_the_energy, "velocity Verlet", 1.5),
    ),
    "factor 4 lost in the leakage": (
        (wheel_theory, "leakage", scaled(wheel_theory.leakage, 4.0)),
        partial(test_periodic_motion.test_leakage_is_the_spectrum_of_a_ramp, 64),
    ),
    "omega / omega_0 for omega_0 / omega": (
        (wheel_theory, "acceleration_over_force", inverted),
        test_wheel_ensembles.test_the_linear_contact_has_its_closed_form_wave_by_wave,
    ),
    "factor 2 pi lost over frequency": (
        (wheel_theory, "over_frequency", scaled(wheel_theory.over_frequency, 1 / (2 * np.pi))),
        test_wheel_ensembles.test_the_linear_contact_has_its_closed_form_wave_by_wave,
    ),
    "a jump that is not there": (
        (wheel_in_motion.Motion, "jump", property(without_a_jump)),
        partial(test_wheel_motion.test_the_change_of_velocity_is_the_mean_acceleration, "linear"),
    ),
    "shooting without a correction": (
        (test_periodic_motion, "periodic_motion", one_copy),
        test_periodic_motion.test_the_periodic_motion_of_a_linear_contact_is_its_steady_state,
    ),
    "a steady motion in continuous time": (
        (contact_laws.LinearLaw, "steady_state", softer_steady),
        partial(test_wheel_motion.test_the_steady_motion_is_that_of_a_dense_solve_and_repeats_itself, 50, 0.1),
    ),
    "a linear spring for Hertz in what lifts a wheel": (
        (
            wheel_on_rail,
            "lift",
            lambda wheel, force, approach: wheel.approach + (force - wheel.load) / wheel.stiffness - approach,
        ),
        test_wheel_on_rail.test_a_wheel_that_vibrates_on_a_smooth_rail_is_not_lifted,
    ),
    "springs in a time step that read one line": (
        (wheel_on_rail, "weights_across", middle_line),
        test_wheel_on_rail.test_springs_in_a_time_step_are_those_of_a_track,
    ),
    "factor 2 lost in linear theory, seen by boundary elements in the loop": (
        (wheel_on_half_space, "linear_force", scaled(wheel_on_half_space.linear_force, 0.5)),
        test_wheel_on_half_space.test_a_low_strip_is_the_linear_contact,
    ),
    "20 lg of a ratio of powers": (
        (rail_quantity.RailQuantity, "filtered", scaled(rail_quantity.RailQuantity.filtered, 2.0)),
        test_rail_filters.test_over_ridges_models_are_sinc_squared_above_the_first_zero,
    ),
    "a ground that is not given taken for known": (
        (rail_quantity.RailQuantity, "half_width", property(lambda quantity: 0 * quantity.wave)),
        test_rail_filters.test_ground_that_is_not_given_is_a_band_between_ridges_and_isotropic_ground,
    ),
    "errors of contact filters claimed beyond where they were measured": (
        (rail_models, "MOST_LOST", 10.0),
        test_rail_filters.test_beyond_what_was_measured_no_error_is_claimed,
    ),
    "the error of linear theory claimed by every contact filter": (
        (rail_models.ContactFilter, "model_error", lambda model, quantity, a3: rail_models.linear_error(quantity)),
        test_rail_filters.test_a_model_that_differs_from_linear_theory_says_by_how_much,
    ),
}
