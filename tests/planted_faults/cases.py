"""Faults planted in what `tests/cases` looks at: where, what is wrong there, and the test that must catch it."""

import math
import types
from dataclasses import replace
from functools import partial

import numpy as np

import bem3d
import mdr
from bem3d import kernel
from tests.advice import test_edge_scenes
from tests.cases import (
    test_bandwidth,
    test_exact_cases,
    test_flags,
    test_fractal_punch,
    test_interface,
    test_limits,
    test_rolling_cases,
    test_wheel_cases,
    test_wheel_ensembles,
    test_wheel_stability,
)
from tests.cases import test_from_force_to_roughness_and_stiffness as test_force
from tests.planted_faults.wrong import Fault, Times, module_with
from tests.railway import test_rail_cases
from tests.railway import test_rail_sound_case as test_rail_sound
from validation.advice.cases import model_selection as calibration
from validation.analysis import series as analysis_series
from validation.analysis import statistics as multilevel
from validation.analysis.evidence import ClaimStatus, Verdict
from validation.analysis.statistics import Resolved, nearest
from validation.cases.exact import geike, hertz
from validation.cases.limits import sweeps as limits
from validation.cases.punch import bandwidth, ensembles, fractal_punch, interface
from validation.cases.rolling import force_spectrum
from validation.cases.wheel import half_space_study
from validation.engine.random_numbers import random_generator
from validation.railway.cases import filters as rail_filters
from validation.railway.cases import rail_sound, rough_rail
from validation.railway.problems import equivalent_displacement
from validation.railway.problems.rail_strip import RailStrip
from validation.scenes import dynamic_wheel as wheel_scene
from validation.simulation import (
    free_vibration,
    indentation,
    integrators,
    limits_of_springs,
    reduced_models,
    rolling_strip,
    rough_punch,
)
from validation.simulation import rolling_levels as roughness_from_force
from validation.simulation import spring_tracks as rough_springs
from validation.simulation import spring_tracks as springs_over_area
from validation.simulation import wheel_on_springs as wheel_ensemble
from validation.simulation.exact_contacts import PublishedContact
from validation.simulation.rolling_strip import level_1d
from validation.simulation.rough_punch import PunchRoughness

REAL_SCENE, REAL_WEIGHTING, combined = rail_filters.scene_of, rail_filters.a_weighting, multilevel.combined
PERIODIC_TRACKS = test_wheel_ensembles.test_periodic_tracks_take_whole_natural_periods_and_a_half
STEADY = {"track": "steady-state"}
zeros_of, amplification = half_space_study.zeros_of, free_vibration.amplification
linear_response = rough_springs.linear_response
REAL_CROSSING = limits.Sweep.crossing.fget
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
SERIES = 1.1523, Verdict.AGREE
STEPS, FRACTION = bandwidth.Deviations.steps, springs_over_area._fraction
FAULTS = [
    partial(test_rail_sound.test_a_level_has_the_weight_of_the_standard, 100, -19.1),
    Fault("a weighting of amplitudes taken twice").at(rail_sound, "a_weighting", lambda f: 2 * REAL_WEIGHTING(f)),
    partial(test_edge_scenes.test_claims_hold_on_measured_faces_and_few_of_them_are_refused, "sphere"),
    Fault("a window of a measured sphere that ends at its contact").at(indentation, "MARGIN", 2),
    partial(test_interface.test_a_power_of_the_load_is_found_and_judged, 1.0, ClaimStatus.HOLDS),
    Fault("exponents of an interface over equal steps of the load").at(
        interface.Interface, "slopes", lambda case, ground: lambda mean, _: np.diff(np.log(mean)) / np.log(3)
    ),
    partial(test_interface.test_a_punch_is_put_beside_its_interface_in_series_with_the_flat_punch, *SERIES),
    Fault("an interface and a punch side by side").at(
        interface, "_over_series", lambda rows: np.log(rows.mean(axis=0)[0] / (rows.mean(axis=0)[1] + 1.1523))
    ),
    test_bandwidth.test_the_plateau_is_flat_and_the_band_beyond_is_self_affine,
    Fault("no plateau below the roll-off").at(rough_punch.PlateauSpectrum, "c2d", mdr.SelfAffine.c2d),
    test_bandwidth.test_deviations_add_up_over_bands,
    Fault("a wide band without the change from the narrow one").at(
        bandwidth, "multilevel_moments", lambda columns: multilevel.multilevel_moments(columns[:1]) * len(columns)
    ),
    test_bandwidth.test_a_change_to_finer_cells_is_doubled_and_left_open_also_in_wider_bands,
    Fault("a change to finer cells that is taken once").at(
        bandwidth.Deviations, "steps", lambda found, *key: {i: 0.5 * one for i, one in STEPS(found, *key).items()}
    ),
    test_bandwidth.test_a_change_by_decade_is_that_of_the_ratio,
    Fault("a change by factor e of bandwidth for that by decade").at(np, "log10", np.log),
    test_bandwidth.test_springs_without_coupling_stand_beside,
    Fault("as many springs over an area as boundary elements have cells in contact").at(
        bandwidth, "nearest", lambda fractions, wide: nearest(fractions, 0.01 * wide)
    ),
    partial(test_bandwidth.test_springs_over_an_area_carry_the_load, 0.1),
    Fault("overlap of springs over an area without their own height").at(
        springs_over_area, "_fraction", lambda height, load: FRACTION(height, 2 * load)
    ),
    partial(test_exact_cases.test_a_contact_that_is_off_contradicts_its_claim, "square"),
    Fault("the stiffness of the square is that of the finest grid").at(
        hertz, "first_order_limit", lambda values: values[-1]
    ),
    test_exact_cases.test_lines_of_a_drawn_surface_have_the_line_trace,
    Fault("the spectrum of a line in Geike's place").at(mdr.SelfAffine, "line", mdr.SelfAffine.c1d),
    test_exact_cases.test_a_profile_keeps_the_moments_and_a_line_the_share_of_its_direction,
    Fault("a line trace with the moments of Geike's spectrum").at(geike, "mean_power_of_cosine", lambda n: 1.0),
    partial(test_fractal_punch.test_profiles_are_those_of_geikes_spectrum, 1.0),
    Fault("line trace for Geike in Fig. 14.1").at(PunchRoughness, "spectrum", property(line_for_geike)),
    test_fractal_punch.test_surfaces_are_pressed_as_they_stand,
    Fault("half of the force in Fig. 14.1").at(
        rough_punch,
        "bem3d",
        pressed_by(lambda *args, forces, **more: bem3d.indent(*args, forces=halves(forces), **more)),
    ),
    Fault("mean gap of a half-space that does not yield").at(
        test_fractal_punch, "press_surface", gap_of_the_rigid_surface
    ),
    test_fractal_punch.test_no_realisation_is_counted_twice,
    Fault("every profile drawn twice").at(
        rough_punch, "random_generator", lambda entropy, *key: random_generator(entropy, *key[:-1], key[-1] // 2)
    ),
    test_fractal_punch.test_a_change_of_the_grid_is_extrapolated_and_leaves_its_error_bar,
    Fault("no grid error").at(
        multilevel.Resolved, "beside", lambda one, other: Resolved(one.value.beside(other.value), 0.0)
    ),
    Fault("no extrapolation").at(fractal_punch, "on_no_size", multilevel.on_finest),
    partial(test_fractal_punch.test_verdicts_on_known_deviations, 1.25, 60, Verdict.UNDECIDED),
    Fault("a third of the interval").at(multilevel, "student", lambda freedom, confidence=0.95: 2 / 3),
    test_fractal_punch.test_a_decade_is_judged_by_its_worst_force,
    Fault("the mean of a decade for its worst force").at(
        analysis_series,
        "worst",
        lambda points: replace(points[0], value=float(np.mean([p.difference for p in points]))),
    ),
    test_fractal_punch.test_the_order_of_the_curves_is_found_or_shown_to_be_absent,
    Fault("the order of the curves turned round").at(
        fractal_punch, "combined", lambda weights, parts: combined(-np.abs(weights), parts)
    ),
    test_fractal_punch.test_hurst_exponents_have_common_phases,
    Fault("other phases for every Hurst exponent").at(
        PunchRoughness, "_drawn", lambda mine, *of, **grid: DRAWN(replace(mine, common=False), *of, **grid)
    ),
    partial(test_wheel_stability.test_limits_are_those_of_the_eigenvalue, integrators.VELOCITY_VERLET),
    Fault("half of the longest step").at(
        free_vibration, "amplification", lambda scheme, x: amplification(scheme, 2 * np.asarray(x))
    ),
    partial(test_wheel_stability.test_linear_spacing_holds_for_other_tracks, 0),
    Fault("coarse springs taken for a continuum").at(
        rough_springs, "linear_response", lambda track, stride: linear_response(track, 1)
    ),
    test_wheel_ensembles.test_the_roughness_of_a_wheel_repeats_after_its_circumference,
    Fault("a wheel of half of its circumference").at(
        wheel_scene.WheelScene, "circumference_points", property(lambda one: round(np.pi * one.radius / one.spacing))
    ),
    partial(PERIODIC_TRACKS, "steady-state", 1, 0.16),
    Fault("a periodic track taken as open").at(
        wheel_ensemble.WheelEnsemble, "places", property(lambda rides: places_of(replace(rides, track="open")))
    ),
    test_rolling_cases.test_the_curve_on_a_track_is_that_of_its_waves_through_the_filter,
    Fault("a band of all waves for the waves of a track, in the curve of the book").at(
        force_spectrum, "levels_on_track", lambda case, spectrum: level_1d(case.spectrum, "geike", case.bands)
    ),
    test_force.test_the_mean_filter_finds_the_roughness_of_the_mean_force,
    Fault("factor 2 lost in the mean filter, read backwards").at(
        roughness_from_force, "mean_force_spectrum_1d", Times(0.5)
    ),
    test_force.test_the_filter_in_three_dimensions_finds_isotropic_roughness,
    Fault("half of the height in the filter of three dimensions, read backwards").at(
        roughness_from_force, "level_3d", Times(0.5)
    ),
    test_force.test_models_on_a_strip_have_its_level_where_it_is_low,
    Fault("half of the force of linear theory beside boundary elements").at(reduced_models, "linear_force", Times(0.5)),
    Fault("contact kept beside a square wheel").at(reduced_models, "math", module_with(math, pi=4.0)),
    partial(test_force.test_the_stiffness_along_a_track_is_the_change_of_force_with_approach, 0.3),
    Fault("stiffness of the frame for that of the contact").at(
        rolling_strip, "tangent_stiffness", whole_frame_in_contact
    ),
    test_wheel_ensembles.test_the_rolling_spectrum_has_long_waves_and_geikes_has_none,
    Fault("Geike's spectrum for the rolling-equivalent one").at(
        wheel_ensemble.WheelEnsemble, "heights", lambda rides: heights_of(replace(rides, input_spectrum="geike"))
    ),
    partial(PERIODIC_TRACKS, "part", 2, 0.16),
    Fault("a part of a motion that repeats itself after the part").at(
        wheel_ensemble.WheelEnsemble, "places", property(lambda rides: places_of(replace(rides, **STEADY)))
    ),
    partial(test_wheel_cases.test_the_contrast_is_that_of_filled_zeros, 0.1),
    Fault("a contrast read at the maxima").at(half_space_study, "zeros_of", lambda scene: zeros_of(scene) + 0.5),
    partial(test_limits.test_crossings_of_a_power_law, "above"),
    Fault("a limit read on its good side").at(limits.Sweep, "past_threshold", limits.Sweep.before_threshold),
    partial(test_limits.test_a_sweep_that_passes_no_threshold_decides_nothing, [1.0] * 4, "above", 1.0),
    Fault("a sweep that passes no threshold agrees at its end").at(
        limits.Sweep, "crossing", property(lambda sweep: REAL_CROSSING(sweep) or (sweep.values[:: sweep.sign][-1], 0.0))
    ),
    test_limits.test_a_stretched_surface_by_another_quadrature,
    Fault("factor 4 lost over a stretched surface").at(limits_of_springs, "response", Times(0.5)),
    test_limits.test_images_err_as_the_lattice_sum_says,
    Fault("factor 2 lost in the periodic symbol, seen by images").at(kernel, "periodic_symbol", Times(0.5)),
    partial(test_flags.test_what_is_lost_is_a_line_of_the_result, "fractal punch, finer grid"),
    Fault("failed loads are not listed").at(ensembles, "describe_failures", lambda *_: ()),
    test_edge_scenes.test_the_reference_of_the_calibration_test_has_surfaces_of_its_own,
    Fault("the reference on the surfaces of the tested models").at(calibration, "OTHER_SEED", 0),
    partial(
        test_edge_scenes.test_a_scene_that_is_refused_is_no_failure_and_one_that_did_not_converge_is,
        *test_edge_scenes.LOST,
    ),
    Fault("a contact at the edge that did not converge taken for a refusal").at(
        calibration, "NotConvergedError", KeyError
    ),
    partial(test_exact_cases.test_a_contact_that_is_off_contradicts_its_claim, "ellipse"),
    Fault("one of two elastic bodies taken for rigid").at(
        PublishedContact, "modulus", property(lambda problem: 2 * 82e9 / (1 - 0.28))
    ),
    test_rail_cases.test_linear_theory_of_the_ellipse_over_isotropic_ground_is_the_published_table_within_a_decibel,
    Fault("the load of an axle for that of a wheel").at(
        rail_filters, "scene_of", lambda wheel: REAL_SCENE(wheel._replace(load=2 * wheel.load))
    ),
    test_rail_cases.test_a_strip_of_ridges_has_the_filter_of_a_row_of_springs_in_boundary_elements,
    Fault("a wheel that bumps let down").at(
        equivalent_displacement, "lifted", lambda approach: approach - np.mean(approach)
    ),
    test_rail_cases.test_line_of_a_drawn_strip_has_the_rms_of_its_ground,
    Fault("a strip with half of its power").at(RailStrip, "variance", Times(0.5)),
    test_rail_cases.test_mean_of_heights_over_ridges_is_one_line_and_over_isotropic_ground_less,
    Fault("one line for the mean of heights").at(
        rough_rail, "mean_of_lines", lambda places: lambda along, across: np.ones_like(along + across)
    ),
]
