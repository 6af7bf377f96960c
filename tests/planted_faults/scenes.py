"""Faults planted in what `tests/scenes` looks at: where, what is wrong there, and the test that must catch it."""

import math
from fractions import Fraction
from functools import partial

import numpy as np

from tests.planted_faults.wrong import Fault, Times, module_with
from tests.railway import test_profiled_rail, test_rail
from tests.scenes import (
    test_damping_key,
    test_exported_tables,
    test_height_edits,
    test_limits_of_scenes,
    test_materials,
    test_measured_heights,
    test_steadiness,
    test_units,
)
from validation.railway.scenes import level_files, rail, transverse_profile
from validation.railway.scenes import level_files as roughness_levels
from validation.railway.scenes.level_files import RoughnessLevels
from validation.railway.scenes.transverse_profile import TransverseProfile
from validation.scenes import material, measured, measured_surface, roughness, text_dialect, units
from validation.scenes import measured as height_edits
from validation.scenes import wheel_body as steadiness

real_spectrum, check_alone = measured._spectrum, transverse_profile._check_alone
both_together = transverse_profile.both_together
moved, radius_of_parabola = TransverseProfile.moved, TransverseProfile.radius_within
filled_in, number, within = height_edits.filled_in, text_dialect.Dialect.number, RoughnessLevels.within
radii_of_rail, slope_in_one_direction = rail.RailScene.radii.fget, roughness.Roughness.slope_along.fget


def half_of_the_level(height, spacing):
    edges, level = real_spectrum(height, spacing)
    return edges, tuple(value / 2 for value in level)


FAULTS = [
    partial(test_units.test_a_quantity_is_the_nearest_float, "40 uN", "force", 4e-5),
    Fault("a load in uN taken for one in mN").at(
        units, "UNITS", {**units.UNITS, "force": {**units.UNITS["force"], "uN": Fraction(1, 1000)}}
    ),
    test_limits_of_scenes.test_two_bodies_yield_each_by_itself,
    Fault("E of one body for E / (1 - nu^2)").at(
        material.Elastic, "against_rigid", property(lambda body: body.youngs_modulus)
    ),
    partial(test_profiled_rail.test_a_parabola_has_its_radius_under_any_load, 5e4),
    Fault("y^2 / R for y^2 / (2 R) in the radius of a transverse profile").at(
        TransverseProfile, "radius_within", Times(2.0)
    ),
    test_profiled_rail.test_a_radius_is_fitted_over_the_contact_and_not_over_the_whole_head,
    Fault("a radius of more than the contact").at(
        TransverseProfile, "radius_within", lambda profile, half: radius_of_parabola(profile, 2 * half)
    ),
    test_profiled_rail.test_a_hollow_wheel_and_a_crown_are_one_profile,
    Fault("the curvature of the other body taken off that of a profile").at(
        test_profiled_rail, "both_together", lambda bodies, curvature: both_together(bodies, 0.0)
    ),
    test_profiled_rail.test_two_bodies_touch_where_both_together_are_highest,
    Fault("a wheel moved to the other side").at(
        TransverseProfile, "moved", lambda profile, offset: moved(profile, -offset)
    ),
    Fault("contact where the rail alone is highest").at(
        test_profiled_rail, "both_together", lambda bodies, *other: both_together(bodies[:1], *other)
    ),
    test_profiled_rail.test_a_second_contact_is_refused_and_a_second_top_that_does_not_touch_is_none,
    Fault("a second contact that is not seen").at(transverse_profile, "_check_alone", lambda *arguments: None),
    Fault("surfaces that do not give way beside the contact").at(
        transverse_profile, "_check_alone", lambda *of: check_alone(*of[:3], 0.0)
    ),
    test_exported_tables.test_wavenumbers_are_cycles_over_a_metre,
    Fault("wavenumbers in cycles taken for radians").at(
        level_files, "WAVENUMBERS", {"1/m": 1 / (2 * math.pi), "1/cm": 1e2 / (2 * math.pi)}
    ),
    test_rail.test_exact_centres_keep_their_bands,
    Fault("levels of exact centres without their end bands").at(
        RoughnessLevels,
        "within",
        lambda of, *ends: within(of, ends[0] or of.wavelengths[0], ends[1] or of.wavelengths[-1]),
    ),
    test_exported_tables.test_holes_of_a_line_lie_between_their_neighbours,
    Fault("a line filled in with its mean").at(
        height_edits, "_filled_line", lambda line: np.where(np.isnan(line), np.nanmean(line), line)
    ),
    partial(test_exported_tables.test_cells_without_data_are_no_numbers, "BAD"),
    Fault("a point without data at zero").at(
        text_dialect.Dialect, "number", lambda dialect, cell: np.nan_to_num(number(dialect, cell))
    ),
    test_measured_heights.test_the_spectrum_has_the_height,
    Fault("measured heights over half of their mean square").at(measured, "_spectrum", half_of_the_level),
    test_measured_heights.test_note_of_plateaus_that_neither_skewness_nor_kurtosis_shows,
    Fault("plateaus taken for Gaussian heights").at(measured, "FLAT", 0.0),
    test_measured_heights.test_points_without_data_are_refused,
    Fault("heights behind a mask").at(
        measured_surface, "real_numbers", lambda height: np.asarray(height, dtype=np.float64)
    ),
    partial(test_height_edits.test_few_points_are_filled_in_where_it_is_asked_for_and_told, "nan"),
    Fault("the mean of all heights for points without data").at(
        measured_surface, "filled_in", lambda height, spacing: np.where(np.isnan(height), np.nanmean(height), height)
    ),
    test_height_edits.test_holes_at_an_edge_against_repeated_means,
    Fault("cells taken for squares where points without data are filled in").at(
        test_height_edits, "filled_in", lambda height, spacing: filled_in(height, (1.0, 1.0))
    ),
    test_height_edits.test_a_crop_is_told_and_its_points_alone_count,
    Fault("the first square for the central one").at(
        measured_surface, "central_square", lambda height, spacing: height[-32:, -32:]
    ),
    partial(test_measured_heights.test_the_unit_that_a_surface_names_is_that_of_heights_and_sizes, {"unit": "um"}),
    Fault("a surface in micrometres taken for one in metres").at(
        measured_surface, "_metres", lambda surface, given: 1.0
    ),
    test_materials.test_two_bodies_share_the_compliance,
    Fault("the other body taken for a rigid one").at(
        material.Material, "modulus", property(lambda both: both._body.against_rigid)
    ),
    test_materials.test_slopes_are_those_of_the_spectrum,
    Fault("the slope of the gradient for that along the track").at(
        roughness.Roughness, "slope_along", property(lambda rough: math.sqrt(2) * slope_in_one_direction(rough))
    ),
    partial(test_steadiness.test_the_force_on_the_way_against_a_plain_sum, 9.0, 0.0),
    Fault("half of the force that throws a wheel").at(steadiness, "force_spectrum_1d", Times(0.25)),
    partial(test_steadiness.test_flight_is_predicted, 0.33, 30e-3, "by linear theory"),
    Fault("a flight that nobody foretells").at(steadiness, "MAX_FORCE", math.inf),
    test_rail.test_curvatures_across_add,
    Fault("the mean of both curvatures across for their sum").at(
        rail.RailScene, "radii", property(lambda scene: (scene.radius, 2 * radii_of_rail(scene)[1]))
    ),
    test_rail.test_the_contact_of_the_field,
    Fault("radii across and along that changed places").at(
        rail.RailScene, "radii", property(lambda scene: radii_of_rail(scene)[::-1])
    ),
    partial(test_rail.test_the_spectrum_has_the_power_of_each_band, "iso3095-2013"),
    Fault("a level as 10 lg of the height").at(
        RoughnessLevels, "powers", property(lambda of: 1e-12 * 10 ** (np.array(of.levels) / 20))
    ),
    partial(test_rail.test_the_spectrum_has_the_power_of_each_band, "cnossos-average"),
    Fault("a spectrum of the powers of its bands, without what their slopes take").at(roughness_levels, "STEPS", 1),
    test_damping_key.test_per_cent_is_a_hundredth,
    Fault("per cent of damping taken for the ratio").at(
        units, "UNITS", units.UNITS | {"share of critical": {"%": Fraction(1)}}
    ),
    test_steadiness.test_rail_and_wheel_are_rough_together,
    Fault("the rougher of wheel and rail for both").at(
        steadiness, "math", module_with(math, hypot=lambda *heights: max(heights))
    ),
]
