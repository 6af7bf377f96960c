"""Faults planted in what `tests/cases` looks at: where, what is wrong there, and the test that must catch it."""

import types
from dataclasses import replace
from functools import partial

import numpy as np

import bem3d
import mdr
from bem3d import kernel
from tests.cases import (
    test_bandwidth,
    test_edge_scenes,
    test_exact_cases,
    test_flags,
    test_fractal_punch,
    test_limits,
    test_rail_cases,
    test_rail_sound,
    test_wheel_cases,
    test_wheel_ensembles,
    test_wheel_stability,
)
from tests.cases import test_from_force_to_roughness_and_stiffness as test_force
from tests.planted_faults.wrong import scaled
from validation.analysis import multilevel, statistics
from validation.analysis import series as analysis_series
from validation.analysis.evidence import Verdict
from validation.analysis.multilevel import Resolved
from validation.analysis.spectra import waves
from validation.analysis.statistics import mean_estimate
from validation.cases.exact import geike, square_punch
from validation.cases.limits import sweeps as limits
from validation.cases.punch import bandwidth, ensembles, fractal_punch, work
from validation.cases.rail import filters as rail_filters
from validation.cases.rail import line_convention, rail_sound
from validation.cases.rolling import roughness_from_force, validity
from validation.cases.selection import model_selection as calibration
from validation.cases.wheel import half_space_study
from validation.engine.random_numbers import random_generator
from validation.scenes import dynamic_wheel as wheel_scene
from validation.simulation import (
    equivalent_displacement,
    free_vibration,
    indentation,
    integrators,
    limits_of_springs,
    reduced_strip,
    rolling_strip,
    rough_punch,
)
from validation.simulation import spring_tracks as rough_springs
from validation.simulation import wheel_on_springs as wheel_ensemble
from validation.simulation.exact_contacts import PublishedContact
from validation.simulation.rail_strip import RailStrip
from validation.simulation.rough_punch import PunchRoughness
from validation.theory import damped_wheel
from validation.theory import rolling as rolling_theory
from validation.theory import wheel as wheel_theory

REAL_SCENE, REAL_WEIGHTING, combined = rail_filters.scene_of, rail_filters.a_weighting, multilevel.combined
PERIODIC_TRACKS = test_wheel_ensembles.test_periodic_tracks_take_whole_natural_periods_and_a_half
STEADY = {"track": "steady-state"}
zeros_of, amplification = half_space_study.zeros_of, free_vibration.amplification
linear_response = rough_springs.linear_response
places_of, heights_of = wheel_ensemble.WheelEnsemble.places.fget, wheel_ensemble.WheelEnsemble.heights


def pressed_by(indent):
    """A fault that only the fractal punch sees: its own view of bem3d, with another path of contacts."""
    return types.SimpleNamespace(**{name: getattr(bem3d, name) for name in bem3d.__all__} | {"indent": indent})


def halves(forces):
    return [force / 2 for force in forces]


def whole_frame_in_contact(wheel, position):
    wheel.carry(position, 4 / 3)
    pressure = wheel.pressure()[2]
    body = bem3d.HalfSpace(shape=pressure.shape, spacing=wheel.track.spacing, modulus=1.0)
    return bem3d.solve_fixed_area(body, np.ones(pressure.shape, dtype=bool)).stiffness


class LineForGeike(mdr.SelfAffine):
    c1d = mdr.SelfAffine.line


def line_for_geike(roughness):
    first, last = roughness.waves
    return LineForGeike(hurst=roughness.hurst, q_min=2 * np.pi * first, q_max=2 * np.pi * last, rms=roughness.height)


def gap_of_the_rigid_surface(surface):
    """As if the half-space did not yield."""
    outcome = rough_punch.press_surface(surface)
    return {**outcome, "gap": -outcome["approach"]}


DRAWN = PunchRoughness._drawn
FAULTS = {
    "a weighting of amplitudes taken twice": (
        (rail_sound, "a_weighting", lambda f: 2 * REAL_WEIGHTING(f)),
        partial(test_rail_sound.test_a_level_has_the_weight_of_the_standard, 100, -19.1),
    ),
    "levels of all frequencies in each range": (
        (rail_sound, "filtered", lambda signal, gain: signal),
        test_rail_sound.test_each_range_is_compared_alone,
    ),
    "a window of a measured sphere that ends at its contact": (
        (indentation, "MARGIN", 2),
        partial(test_edge_scenes.test_claims_hold_on_measured_faces_and_few_of_them_are_refused, "sphere"),
    ),
    "no plateau below the roll-off": (
        (rough_punch.PlateauSpectrum, "c2d", mdr.SelfAffine.c2d),
        test_bandwidth.test_the_plateau_is_flat_and_the_band_beyond_is_self_affine,
    ),
    "a wide band without the change from the narrow one": (
        (bandwidth, "accumulate", lambda steps, initial: [initial] * (1 + len(steps))),
        test_bandwidth.test_a_planted_change_of_boundary_elements_adds_up,
    ),
    "half of the jackknife's error in a change": (
        (statistics, "jackknife_error", scaled(statistics.jackknife_error, 0.5)),
        partial(test_bandwidth.test_intervals_of_a_change_hold_it_as_often_as_they_say, "mean stiffness"),
    ),
    "the stiffness of the square is that of the finest grid": (
        (square_punch, "first_order_limit", lambda values: values[-1]),
        test_exact_cases.test_the_square_the_model_of_its_length_and_the_quoted_factor,
    ),
    "a line trace with the moments of Geike's spectrum": (
        (geike, "mean_power_of_cosine", lambda n: 1.0),
        test_exact_cases.test_the_line_is_not_geikes_spectrum_and_would_be_told_if_it_were,
    ),
    "line trace for Geike in Fig. 14.1": (
        (PunchRoughness, "spectrum", property(line_for_geike)),
        partial(test_fractal_punch.test_profiles_are_those_of_geikes_spectrum, 1.0),
    ),
    "half of the force in Fig. 14.1": (
        (
            rough_punch,
            "bem3d",
            pressed_by(lambda *args, forces, **more: bem3d.indent(*args, forces=halves(forces), **more)),
        ),
        test_fractal_punch.test_surfaces_are_pressed_as_they_stand,
    ),
    "surfaces pressed upside down": (
        (rough_punch, "bem3d", pressed_by(lambda half_space, gap, **more: bem3d.indent(half_space, -gap, **more))),
        test_fractal_punch.test_surfaces_are_pressed_as_they_stand,
    ),
    "every profile drawn twice": (
        (rough_punch, "random_generator", lambda entropy, *key: random_generator(entropy, *key[:-1], key[-1] // 2)),
        test_fractal_punch.test_no_realisation_is_counted_twice,
    ),
    "no grid error": (
        (multilevel.Resolved, "beside", lambda one, other: Resolved(one.value.beside(other.value), 0.0)),
        test_fractal_punch.test_a_change_of_the_grid_is_extrapolated_and_leaves_its_error_bar,
    ),
    "no extrapolation": (
        (fractal_punch, "on_no_size", multilevel.on_finest),
        test_fractal_punch.test_a_change_of_the_grid_is_extrapolated_and_leaves_its_error_bar,
    ),
    "a third of the interval": (
        (multilevel, "student", lambda freedom, confidence=0.95: 2 / 3),
        partial(test_fractal_punch.test_verdicts_on_known_deviations, 1.25, 60, Verdict.UNDECIDED),
    ),
    "the mean of a decade for its worst force": (
        (
            analysis_series,
            "worst",
            lambda points: replace(points[0], value=float(np.mean([p.difference for p in points]))),
        ),
        test_fractal_punch.test_a_decade_is_judged_by_its_worst_force,
    ),
    "a fine application as cheap as a coarse one": (
        (work, "_cost", lambda applications, cells: 1.0),
        test_fractal_punch.test_the_work_beside_plain_sampling,
    ),
    "the order of the curves turned round": (
        (fractal_punch, "combined", lambda weights, parts: combined(-np.abs(weights), parts)),
        test_fractal_punch.test_the_order_of_the_curves_is_found_or_shown_to_be_absent,
    ),
    "other phases for every Hurst exponent": (
        (PunchRoughness, "_drawn", lambda mine, *of, **grid: DRAWN(replace(mine, common=False), *of, **grid)),
        test_fractal_punch.test_hurst_exponents_have_common_phases,
    ),
    "mean gap of a half-space that does not yield": (
        (test_fractal_punch, "press_surface", gap_of_the_rigid_surface),
        test_fractal_punch.test_surfaces_are_pressed_as_they_stand,
    ),
    "half of the longest step": (
        (free_vibration, "amplification", lambda scheme, x: amplification(scheme, 2 * np.asarray(x))),
        partial(test_wheel_stability.test_limits_are_those_of_the_eigenvalue, integrators.VELOCITY_VERLET),
    ),
    "coarse springs taken for a continuum": (
        (rough_springs, "linear_response", lambda track, stride: linear_response(track, 1)),
        partial(test_wheel_stability.test_linear_spacing_holds_for_other_tracks, 0),
    ),
    "a wheel of half of its circumference": (
        (wheel_scene.WheelScene, "circumference_points", property(lambda one: round(np.pi * one.radius / one.spacing))),
        test_wheel_ensembles.test_the_roughness_of_a_wheel_repeats_after_its_circumference,
    ),
    "a periodic track taken as open": (
        (wheel_ensemble.WheelEnsemble, "places", property(lambda rides: places_of(replace(rides, track="open")))),
        partial(PERIODIC_TRACKS, "steady-state", 1, 0.16),
    ),
    "factor 4 lost in the filter of one dimension, read backwards": (
        (roughness_from_force, "force_spectrum_1d", scaled(rolling_theory.force_spectrum_1d, 0.25)),
        test_force.test_the_filter_in_one_dimension_finds_the_roughness_of_ridges,
    ),
    "half of the height in the filter of three dimensions, read backwards": (
        (roughness_from_force, "level_3d", scaled(roughness_from_force.level_3d, 0.5)),
        test_force.test_the_filter_in_three_dimensions_finds_isotropic_roughness,
    ),
    "contact kept beside a wheel of another force": (
        (validity, "contact_kept", lambda strips: mean_estimate(np.array([one["area"].mean() for one in strips]))),
        test_force.test_a_smooth_wheel_keeps_its_contact_whatever_its_force,
    ),
    "amplitudes of a reduced model twice as large": (
        (reduced_strip, "waves", lambda force, spacing: waves(2 * force, spacing=spacing)),
        test_force.test_a_reduced_model_stands_beside_boundary_elements_on_the_surface_itself,
    ),
    "stiffness of the frame for that of the contact": (
        (rolling_strip, "tangent_stiffness", whole_frame_in_contact),
        partial(test_force.test_the_stiffness_along_a_track_is_the_change_of_force_with_approach, 0.3),
    ),
    "Geike's spectrum for the rolling-equivalent one": (
        (wheel_ensemble.WheelEnsemble, "heights", lambda rides: heights_of(replace(rides, input_spectrum="geike"))),
        test_wheel_ensembles.test_the_rolling_spectrum_has_long_waves_and_geikes_has_none,
    ),
    "a part of a motion that repeats itself after the part": (
        (
            wheel_ensemble.WheelEnsemble,
            "places",
            property(lambda rides: places_of(replace(rides, **STEADY))),
        ),
        partial(PERIODIC_TRACKS, "part", 2, 0.16),
    ),
    "no resonator in the linear spectrum": (
        (damped_wheel, "acceleration_over_force", lambda omega, mass, **_: np.full(np.shape(omega), mass**-2.0)),
        test_wheel_ensembles.test_the_linear_contact_has_its_closed_form_wave_by_wave,
    ),
    "factor 2 pi lost over frequency, seen in an ensemble": (
        (wheel_theory, "over_frequency", scaled(wheel_theory.over_frequency, 1 / (2 * np.pi))),
        test_wheel_ensembles.test_the_linear_contact_has_its_closed_form_wave_by_wave,
    ),
    "a contrast read at the maxima": (
        (half_space_study, "zeros_of", lambda scene: zeros_of(scene) + 0.5),
        partial(test_wheel_cases.test_the_contrast_is_that_of_filled_zeros, 0.1),
    ),
    "a limit read on its good side": (
        (limits.Sweep, "past_threshold", limits.Sweep.before_threshold),
        partial(test_limits.test_crossings_of_a_power_law, "above"),
    ),
    "factor 4 lost over a stretched surface": (
        (limits_of_springs, "response", scaled(rolling_theory.response, 0.5)),
        test_limits.test_a_stretched_surface_by_another_quadrature,
    ),
    "factor 2 lost in the periodic symbol, seen by images": (
        (kernel, "periodic_symbol", scaled(kernel.periodic_symbol, 0.5)),
        test_limits.test_images_err_as_the_lattice_sum_says,
    ),
    "failed loads are not listed": (
        (ensembles, "describe_failures", lambda *_: ()),
        partial(test_flags.test_what_is_lost_is_a_line_of_the_result, "fractal punch, finer grid"),
    ),
    "the reference on the surfaces of the tested models": (
        (calibration, "OTHER_SEED", 0),
        test_edge_scenes.test_the_reference_of_the_calibration_test_has_surfaces_of_its_own,
    ),
    "one of two elastic bodies taken for rigid": (
        (PublishedContact, "modulus", property(lambda problem: 2 * 82e9 / (1 - 0.28))),
        test_rail_cases.test_contact_of_the_program_contact_is_reproduced,
    ),
    "the load of an axle for that of a wheel": (
        (rail_filters, "scene_of", lambda wheel: REAL_SCENE(wheel._replace(load=2 * wheel.load))),
        test_rail_cases.test_linear_theory_of_the_ellipse_over_isotropic_ground_is_the_published_table_within_a_decibel,
    ),
    "A-weighting that is not zero at 1 kHz": (
        (rail_sound, "a_weighting", lambda frequency: REAL_WEIGHTING(frequency) - 2),
        partial(test_rail_sound.test_a_level_has_the_weight_of_the_standard, 1000, 0.0),
    ),
    "the masked value of the published table compared": (
        (rail_filters, "MASKED", set()),
        test_rail_cases.test_published_table_has_five_columns_of_all_bands_and_one_masked_value,
    ),
    "a wheel that bumps let down": (
        (equivalent_displacement, "lifted", lambda approach: approach - np.mean(approach)),
        test_rail_cases.test_a_strip_of_ridges_has_the_filter_of_a_row_of_springs_in_boundary_elements,
    ),
    "a strip with half of its power": (
        (RailStrip, "variance", property(scaled(RailStrip.variance.func, 0.5))),
        test_rail_cases.test_line_of_a_drawn_strip_has_the_rms_of_its_ground,
    ),
    "one line for the mean of heights": (
        (line_convention, "mean_of_lines", lambda places: lambda along, across: np.ones_like(along + across)),
        test_rail_cases.test_mean_of_heights_over_ridges_is_one_line_and_over_isotropic_ground_less,
    ),
}
