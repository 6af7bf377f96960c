"""Faults planted in what `tests/scenes` looks at: where, what is wrong there, and the test that must catch it."""

import functools
import math

import numpy as np

from tests.planted_faults.wrong import scaled, with_math
from tests.scenes import (
    test_exported_tables,
    test_height_edits,
    test_materials,
    test_measured_heights,
    test_profiled_rail,
    test_rail,
    test_steadiness,
)
from validation.scenes import (
    height_edits,
    level_files,
    material,
    measured,
    measured_lines,
    measured_surface,
    rail,
    roughness,
    roughness_levels,
    steadiness,
    text_dialect,
    transverse_profile,
)
from validation.theory import rolling as rolling_theory

measured_spectrum = measured._spectrum


def behind_the_mask(height):
    return np.asarray(height, dtype=np.float64)


def over_twice_the_contact(profile, half_width):
    return radius_of_parabola(profile, 2 * half_width)


def of_the_rail_alone(bodies, curvature, centre=0.0):
    return transverse_profile.both_together(bodies[:1], curvature, centre)


def by_the_wavelengths_as_given(levels, longest, shortest):
    ends = (
        levels.wavelengths[0] if longest is None else longest,
        levels.wavelengths[-1] if shortest is None else shortest,
    )
    return within(levels, *ends)


def rigid_beside_the_contact(profile, half_width, approach, force):
    return check_alone(profile, half_width, approach, 0.0)


def first_square(height, spacing):
    side = min(height.shape)
    return height[-side:, -side:]


within = roughness_levels.RoughnessLevels.within
check_alone = transverse_profile._check_alone
moved = transverse_profile.TransverseProfile.moved
number = text_dialect.Dialect.number
radius_of_parabola = transverse_profile.TransverseProfile.radius_within
radii_of_rail = rail.RailScene.radii.fget
slope_in_one_direction = roughness.Roughness.slope_along.fget


def half_of_the_level(height, spacing):
    edges, level = measured_spectrum(height, spacing)
    return edges, tuple(value / 2 for value in level)


FAULTS = {
    "y^2 / R for y^2 / (2 R) in the radius of a transverse profile": (
        (transverse_profile.TransverseProfile, "radius_within", scaled(radius_of_parabola, 2.0)),
        functools.partial(test_profiled_rail.test_a_parabola_has_its_radius_under_any_load, 5e4),
    ),
    "a radius of more than the contact": (
        (transverse_profile.TransverseProfile, "radius_within", over_twice_the_contact),
        test_profiled_rail.test_a_radius_is_fitted_over_the_contact_and_not_over_the_whole_head,
    ),
    "the curvature of the other body taken off that of a profile": (
        (test_profiled_rail, "both_together", lambda bodies, curvature: transverse_profile.both_together(bodies, 0.0)),
        test_profiled_rail.test_a_hollow_wheel_and_a_crown_are_one_profile,
    ),
    "a wheel moved to the other side": (
        (transverse_profile.TransverseProfile, "moved", lambda profile, offset: moved(profile, -offset)),
        test_profiled_rail.test_two_bodies_touch_where_both_together_are_highest,
    ),
    "contact where the rail alone is highest": (
        (test_profiled_rail, "both_together", of_the_rail_alone),
        test_profiled_rail.test_two_bodies_touch_where_both_together_are_highest,
    ),
    "a second contact that is not seen": (
        (transverse_profile, "_check_alone", lambda *arguments: None),
        test_profiled_rail.test_a_second_contact_is_refused_and_a_second_top_that_does_not_touch_is_none,
    ),
    "surfaces that do not give way beside the contact": (
        (transverse_profile, "_check_alone", rigid_beside_the_contact),
        test_profiled_rail.test_a_second_contact_is_refused_and_a_second_top_that_does_not_touch_is_none,
    ),
    "a column of places as a second line of heights": (
        (measured_lines, "_kinds", lambda numbers, count: ({}, {})),
        test_exported_tables.test_the_place_along_the_track_is_no_line,
    ),
    "wavenumbers in cycles taken for radians": (
        (level_files, "WAVENUMBERS", {"1/m": 1 / (2 * math.pi), "1/cm": 1e2 / (2 * math.pi)}),
        test_exported_tables.test_wavenumbers_are_cycles_over_a_metre,
    ),
    "levels of exact centres without their end bands": (
        (roughness_levels.RoughnessLevels, "within", by_the_wavelengths_as_given),
        test_rail.test_exact_centres_keep_their_bands,
    ),
    "a line filled in with its mean": (
        (height_edits, "_filled_line", lambda line: np.where(np.isnan(line), np.nanmean(line), line)),
        test_exported_tables.test_holes_of_a_line_lie_between_their_neighbours,
    ),
    "a point without data at zero": (
        (text_dialect.Dialect, "number", lambda dialect, cell: np.nan_to_num(number(dialect, cell))),
        functools.partial(test_exported_tables.test_cells_without_data_are_no_numbers, "BAD"),
    ),
    "heights of an unknown unit in metres": (
        (measured_surface, "_metres", lambda surface, given: 1.0),
        functools.partial(test_measured_heights.test_an_object_that_names_no_unit_is_asked_for_it, {}),
    ),
    "measured heights over half of their mean square": (
        (measured, "_spectrum", half_of_the_level),
        test_measured_heights.test_the_spectrum_has_the_height,
    ),
    "plateaus taken for Gaussian heights": (
        (measured, "FLAT", 0.0),
        test_measured_heights.test_note_of_plateaus_that_neither_skewness_nor_kurtosis_shows,
    ),
    "heights behind a mask": (
        (measured_surface, "real_numbers", behind_the_mask),
        test_measured_heights.test_points_without_data_are_refused,
    ),
    "the mean of all heights for points without data": (
        (measured_surface, "filled_in", lambda height, spacing: np.where(np.isnan(height), np.nanmean(height), height)),
        functools.partial(test_height_edits.test_few_points_are_filled_in_where_it_is_asked_for_and_told, "nan"),
    ),
    "cells taken for squares where points without data are filled in": (
        (height_edits, "_weight", lambda step, least: 1.0),
        test_height_edits.test_holes_at_an_edge_against_repeated_means,
    ),
    "the first square for the central one": (
        (measured_surface, "central_square", first_square),
        test_height_edits.test_a_crop_is_told_and_its_points_alone_count,
    ),
    "a surface in micrometres taken for one in metres": (
        (measured_surface, "_metres", lambda surface, given: 1.0),
        functools.partial(
            test_measured_heights.test_the_unit_that_a_surface_names_is_that_of_heights_and_sizes, {"unit": "um"}
        ),
    ),
    "the other body taken for a rigid one": (
        (material.Material, "modulus", property(lambda both: both._body.against_rigid)),
        test_materials.test_two_bodies_share_the_compliance,
    ),
    "the slope of the gradient for that along the track": (
        (roughness.Roughness, "slope_along", property(lambda rough: math.sqrt(2) * slope_in_one_direction(rough))),
        test_materials.test_slopes_are_those_of_the_spectrum,
    ),
    "half of the force that throws a wheel": (
        (steadiness, "force_spectrum_1d", scaled(rolling_theory.force_spectrum_1d, 0.25)),
        functools.partial(test_steadiness.test_the_force_on_the_way_against_a_plain_sum, 9.0),
    ),
    "a flight that nobody foretells": (
        (steadiness, "MAX_FORCE", math.inf),
        functools.partial(test_steadiness.test_flight_is_predicted, 0.33, 30e-3, "by linear theory"),
    ),
    "the mean of both curvatures across for their sum": (
        (rail.RailScene, "radii", property(lambda scene: (scene.radius, 2 * radii_of_rail(scene)[1]))),
        test_rail.test_curvatures_across_add,
    ),
    "radii across and along that changed places": (
        (rail.RailScene, "radii", property(lambda scene: radii_of_rail(scene)[::-1])),
        test_rail.test_the_contact_of_the_field,
    ),
    "a level as 10 lg of the height": (
        (roughness_levels.RoughnessLevels, "powers", property(lambda of: 1e-12 * 10 ** (np.array(of.levels) / 20))),
        functools.partial(test_rail.test_the_spectrum_has_the_power_of_each_band, "iso3095-2013"),
    ),
    "a spectrum of the powers of its bands, without what their slopes take": (
        (roughness_levels, "STEPS", 1),
        functools.partial(test_rail.test_the_spectrum_has_the_power_of_each_band, "cnossos-average"),
    ),
    "the rougher of wheel and rail for both": (
        (steadiness, "math", with_math(hypot=lambda *heights: max(heights))),
        test_steadiness.test_rail_and_wheel_are_rough_together,
    ),
}
