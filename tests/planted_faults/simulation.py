"""Faults planted in what `tests/simulation` looks at: where, what is wrong there, and the test that must catch it."""

import dataclasses
import types
from functools import partial

import numpy as np

import bem3d
import mdr
from bem3d import few_cells, rolling_contact
from tests.cases import test_wheel_ensembles, test_wheel_on_half_space
from tests.planted_faults.wrong import E_FOR_E_STAR, Fault, Times
from tests.railway import test_profiled_strip, test_rail_filters, test_rail_sound, test_wheel_on_rail
from tests.simulation import (
    test_damping,
    test_flags_of_rolling,
    test_light_punch,
    test_periodic_motion,
    test_reduced_models,
    test_rough_punches,
    test_time_stepping,
    test_wheel_motion,
)
from validation.railway.problems import equivalent_displacement, rail_models, rail_quantity, wheel_on_rail
from validation.scenes import dynamic_wheel
from validation.scenes.wheel_body import Wheel
from validation.simulation import (
    contact_laws,
    integrators,
    mean_contact,
    ridges,
    rolling_strip,
    rough_punch,
    surface,
    wheel_on_half_space,
)
from validation.simulation import motion as wheel_in_motion
from validation.simulation import pressed as pressed_layer
from validation.simulation import rough_punch as light_punch
from validation.simulation.model_names import LINE
from validation.simulation.rough_punch import PunchRoughness
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


def without_flag(solve):
    """The outcome of a solve, without its flag."""
    return lambda *given, **settings: {**solve(*given, **settings), "failed": np.array(0.0)}


FAULTS = [
    partial(
        test_flags_of_rolling.test_a_position_without_a_solution_is_flagged_and_is_no_number,
        "validation.simulation.rolling_strip:roll_strip",
    ),
    Fault("roll_strip without its flag").at(
        test_flags_of_rolling, "roll_strip", without_flag(test_flags_of_rolling.roll_strip)
    ),
    partial(
        test_flags_of_rolling.test_a_position_without_a_solution_is_flagged_and_is_no_number,
        test_flags_of_rolling.ON_A_RAIL,
    ),
    Fault("roll_rail without its flag").at(
        test_flags_of_rolling, "roll_rail", without_flag(test_flags_of_rolling.roll_rail)
    ),
    partial(
        test_flags_of_rolling.test_a_position_without_a_solution_is_flagged_and_is_no_number,
        test_flags_of_rolling.ON_A_RAIL + ", at a constant height",
    ),
    Fault("roll_held_wheel without its flag").at(
        test_flags_of_rolling, "roll_held_wheel", without_flag(test_flags_of_rolling.roll_held_wheel)
    ),
    partial(
        test_flags_of_rolling.test_a_position_without_a_solution_is_flagged_and_is_no_number,
        test_flags_of_rolling.ON_A_RAIL + ", before it moves",
    ),
    Fault("roll_and_move without its flag").at(
        test_flags_of_rolling, "roll_and_move", without_flag(test_flags_of_rolling.roll_and_move)
    ),
    partial(
        test_flags_of_rolling.test_a_position_without_a_solution_is_flagged_and_is_no_number,
        "validation.simulation.reduced_models:boundary_elements",
    ),
    Fault("roll_by_all without its flag").at(
        test_flags_of_rolling, "roll_by_all", without_flag(test_flags_of_rolling.roll_by_all)
    ),
    partial(
        test_flags_of_rolling.test_a_position_without_a_solution_is_flagged_and_is_no_number,
        "validation.simulation.ridges:_roll",
    ),
    Fault("roll_over without its flag").at(ridges, "roll_over", without_flag(ridges.roll_over)),
    partial(
        test_flags_of_rolling.test_a_position_without_a_solution_is_flagged_and_is_no_number,
        "validation.simulation.rolling_strip:roll_loaded_strip",
    ),
    Fault("roll_loaded_strip without its flag").at(
        rolling_strip, "roll_loaded_strip", without_flag(rolling_strip.roll_loaded_strip)
    ),
    test_flags_of_rolling.test_a_position_without_a_solution_has_no_number,
    Fault("a rolling contact that always says it has converged").at(
        rolling_contact.WheelContact, "converged", property(lambda contact: True)
    ),
    Fault("numbers of a rolling contact that has not converged").at(
        rolling_contact, "math", types.SimpleNamespace(nan=1.0)
    ),
    test_reduced_models.test_a_layer_without_a_solution_is_refused,
    Fault("a pressed layer that has not converged").at(bem3d, "solve", partial(bem3d.solve, raise_on_failure=False)),
    partial(test_light_punch.test_the_same_numbers_as_by_transforms, 128),
    Fault("a finer grid half a cell aside").at(light_punch, "refined", half_a_fine_cell_aside),
    test_light_punch.test_beside_the_dense_solution,
    Fault("half of a light force").at(light_punch.bem3d, "indent_few_cells", half_of_a_light_force),
    test_light_punch.test_a_load_that_will_have_many_cells_is_not_tried,
    Fault("a load tried on a matrix whatever touches").at(
        light_punch, "_while_few", lambda contacts, forces, most: contacts
    ),
    partial(test_light_punch.test_heavier_loads_go_on_by_transforms, "OVERLAPPING", 1),
    Fault("light loads that are not carried on").at(light_punch, "press_surface", heavier_loads_as_light_ones),
    test_profiled_strip.test_a_worn_rail_rolls_as_its_profile_and_not_as_the_radius_of_its_contact,
    Fault("a fitted radius in place of the transverse profile").at(
        equivalent_displacement, "heights_across", on_the_fitted_radius
    ),
    test_rail_filters.test_over_ridges_models_are_sinc_squared_above_the_first_zero,
    Fault("the rolling spectrum of a rail that filters ridges").at(
        equivalent_displacement, "rolling_input_filter", share_of_oblique_waves
    ),
    Fault("20 lg of a ratio of powers").at(rail_quantity.RailQuantity, "filtered", Times(2.0)),
    test_rail_filters.test_short_waves_under_springs_on_the_rolling_spectrum_have_the_level_of_the_half_space,
    Fault("the line taken for the rolling spectrum of a rail").at(
        equivalent_displacement, "rolling_input_filter", surface_itself
    ),
    partial(test_rail_filters.test_long_waves_pass_under_every_model_but_springs_on_geikes_spectrum, "isotropic"),
    Fault("long waves that do not pass under springs on the rolling spectrum").at(
        equivalent_displacement, "rolling_input_filter", Times(1.1)
    ),
    partial(test_rail_filters.test_long_waves_under_springs_on_geikes_spectrum_are_off_by_his_rule_over_the_line, 2.0),
    Fault("the line trace taken for Geike's spectrum under springs on a rail").at(
        equivalent_displacement, "geike_over_line", lambda wavenumber, ground: np.ones_like(wavenumber)
    ),
    test_rail_sound.test_geikes_track_has_his_spectrum_and_the_phases_of_the_line,
    Fault("the line trace taken for Geike's spectrum").at(
        test_rail_sound, "geike_track", lambda strip: equivalent_displacement.linear_displacement(strip, LINE)
    ),
    test_rail_sound.test_springs_that_read_a_smoother_rail_are_linear_theory,
    Fault("springs that read one line of the surface").at(mdr, "roll_surface", springs_on_middle_line),
    partial(test_rough_punches.test_heights_are_normalised_as_they_say, "bem3d", 1.0),
    Fault("rms of the ensemble for that of each").at(PunchRoughness, "_normalised", lambda roughness, height: height),
    partial(test_rough_punches.test_heights_are_normalised_as_they_say, "mdr", 1.0),
    Fault("rms of each for that of the ensemble").at(
        PunchRoughness, "_normalised", lambda roughness, height: height * roughness.height / height.std()
    ),
    test_reduced_models.test_the_mean_contact_of_a_smooth_wheel_is_that_of_hertz,
    Fault("half of the displacement under the mean contact").at(mean_contact, "ring_operator", Times(0.5)),
    partial(test_reduced_models.test_low_waves_under_a_pressed_layer_have_the_filter_of_the_half_space, (2, 0)),
    Fault("a trial on a pressed layer without its step").at(
        pressed_layer, "_where_no_step_is_left", lambda forces, steps, approach: forces[len(forces) // 2]
    ),
    test_wheel_motion.test_at_rest_the_wheel_bears_its_load,
    Fault("E for E* in the force, not in the approach at rest").at(mdr.RollingEnsemble, "force", Times(E_FOR_E_STAR)),
    partial(
        test_wheel_motion.test_on_a_smooth_track_a_wheel_stays_at_rest,
        contact_laws.HertzLaw(test_wheel_motion.WHEEL, 2),
        4 * test_wheel_motion.ULP,
    ),
    Fault("load forgotten in the equation of motion").at(test_wheel_motion, "simulate", without_load),
    test_damping.test_free_vibration_decays_by_the_exact_law_of_a_dashpot_at_second_order,
    Fault("factor 2 in the constant of the dashpot").at(wheel_in_motion, "damping_rate", Times(2.0)),
    Fault("a dashpot that drives the wheel").at(wheel_in_motion, "damping_rate", Times(-1.0)),
    partial(test_damping.test_a_sine_brings_the_wheel_into_its_steady_response, 0.5),
    Fault("factor 2 in the dashpot of the steady state").at(contact_laws, "damping_rate", Times(2.0)),
    partial(test_damping.test_a_wheel_on_a_rail_moves_by_its_equation_with_the_dashpot, test_damping.SPRINGS),
    Fault("damping forgotten on a rail").at(wheel_on_rail.WheelOnRail, "wheel", property(without_a_dashpot)),
    partial(test_damping.test_a_scene_with_damping_damps_its_wheels_on_springs, True),
    Fault("damping forgotten in a scene of springs").at(
        dynamic_wheel, "DampedWheel", lambda damping, **given: Wheel(**given)
    ),
    partial(test_wheel_motion.test_time_reversal, 0.05, 0.0),
    Fault("explicit Euler where nothing is asked for").at(
        wheel_in_motion.simulate, "__kwdefaults__", by_another(integrators.EXPLICIT_EULER)
    ),
    partial(test_wheel_motion.test_free_vibration_of_a_linear_contact_is_the_exact_one_of_leapfrog, 0.3),
    Fault("symplectic Euler where nothing is asked for").at(
        wheel_in_motion.simulate, "__kwdefaults__", by_another(integrators.SYMPLECTIC_EULER)
    ),
    partial(test_time_stepping.test_order_of_a_scheme_on_a_free_vibration, "Runge-Kutta"),
    Fault("the step of a cell for that of two in Runge and Kutta").at(
        test_time_stepping,
        "SCHEMES",
        {**test_time_stepping.SCHEMES, "Runge-Kutta": half_a_step(integrators.RUNGE_KUTTA)},
    ),
    partial(test_time_stepping.test_symplectic_schemes_keep_the_energy, "velocity Verlet", 1.5),
    Fault("velocity Verlet with the force of the beginning alone").at(
        test_time_stepping,
        "SCHEMES",
        {
            **test_time_stepping.SCHEMES,
            "velocity Verlet": dataclasses.replace(integrators.VELOCITY_VERLET, march=old_force_in_the_velocity),
        },
    ),
    partial(test_periodic_motion.test_leakage_is_the_spectrum_of_a_ramp, 64),
    Fault("factor 4 lost in the leakage").at(wheel_theory, "leakage", Times(4.0)),
    test_wheel_ensembles.test_the_linear_contact_has_its_closed_form_wave_by_wave,
    Fault("omega / omega_0 for omega_0 / omega").at(wheel_theory, "acceleration_over_force", inverted),
    Fault("factor 2 pi lost over frequency").at(wheel_theory, "over_frequency", Times(1 / (2 * np.pi))),
    partial(test_wheel_motion.test_the_change_of_velocity_is_the_mean_acceleration, "linear"),
    Fault("a jump that is not there").at(
        wheel_in_motion.Motion, "jump", property(lambda motion: motion.next_acceleration - motion.next_acceleration)
    ),
    test_periodic_motion.test_the_periodic_motion_of_a_linear_contact_is_its_steady_state,
    Fault("shooting without a correction").at(test_periodic_motion, "periodic_motion", one_copy),
    partial(test_wheel_motion.test_the_steady_motion_is_that_of_a_dense_solve_and_repeats_itself, 50, 0.1),
    Fault("a steady motion in continuous time").at(contact_laws.LinearLaw, "steady_state", softer_steady),
    test_wheel_on_rail.test_a_wheel_that_vibrates_on_a_smooth_rail_is_not_lifted,
    Fault("a linear spring for Hertz in what lifts a wheel").at(
        wheel_on_rail,
        "lift",
        lambda wheel, force, approach: wheel.approach + (force - wheel.load) / wheel.stiffness - approach,
    ),
    test_wheel_on_rail.test_springs_in_a_time_step_are_those_of_a_track,
    Fault("springs in a time step that read one line").at(wheel_on_rail, "weights_across", middle_line),
    test_wheel_on_half_space.test_a_low_strip_is_the_linear_contact,
    Fault("factor 2 lost in linear theory, seen by boundary elements in the loop").at(
        wheel_on_half_space, "linear_force", Times(0.5)
    ),
    test_rail_filters.test_ground_that_is_not_given_is_a_band_between_ridges_and_isotropic_ground,
    Fault("a ground that is not given taken for known").at(
        rail_quantity.RailQuantity, "half_width", property(lambda quantity: 0 * quantity.wave)
    ),
    test_rail_filters.test_beyond_what_was_measured_no_error_is_claimed,
    Fault("errors of contact filters claimed beyond where they were measured").at(rail_models, "MOST_LOST", 10.0),
    test_rail_filters.test_a_model_that_differs_from_linear_theory_says_by_how_much,
    Fault("the error of linear theory claimed by every contact filter").at(
        rail_models.ContactFilter, "model_error", lambda model, quantity, a3: rail_models.linear_error(quantity)
    ),
]
