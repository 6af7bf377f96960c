"""Faults planted in what `tests/scenes` looks at: where, what is wrong there, and the test that must catch it."""

import functools
import math

import numpy as np

from tests.planted_faults.wrong import scaled, with_math
from tests.scenes import (
    test_height_edits,
    test_materials,
    test_measured_heights,
    test_profiled_rail,
    test_rail,
    test_steadiness,
)
from validation.scenes import (
    height_edits,
    material,
    measured,
    measured_surface,
    rail,
    roughness,
    roughness_levels,
    steadiness,
    transverse_profile,
)
from validation.theory import rolling as rolling_theory

measured_spectrum = measured._spectrum


def behind_the_mask(height):
    return np.asarray(height, dtype=np.float64)


def over_twice_the_contact(profile, half_width):
    return radius_of_parabola(profile, 2 * half_width)


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
        (height_edits, "filled_in", lambda height, spacing: np.where(np.isnan(height), np.nanmean(height), height)),
        functools.partial(test_height_edits.test_few_points_are_filled_in_where_it_is_asked_for_and_told, "nan"),
    ),
    "cells taken for squares where points without data are filled in": (
        (height_edits, "_weight", lambda step, least: 1.0),
        test_height_edits.test_holes_at_an_edge_against_repeated_means,
    ),
    "the first square for the central one": (
        (height_edits, "central_square", lambda height, spacing: height[-min(height.shape) :, -min(height.shape) :]),
        test_height_edits.test_a_crop_is_told_and_its_points_alone_count,
    ),
    "a surface in micrometres taken for one in metres": (
        (measured_surface, "_metres", lambda surface: 1.0),
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
