"""A root of two, lost and gained in each place where h' or g is computed, and the test that must catch it."""

import math
from functools import partial

from tests.cases import test_fractal_punch, test_rolling_cases
from tests.cases import test_slopes as own
from tests.planted_faults.wrong import Fault, Times
from tests.scenes import test_materials
from tests.theory import test_rolling_theory
from validation.analysis.spectra import NominalBands
from validation.cases.limits import sweeps
from validation.cases.punch.interface import Interface
from validation.cases.rolling import reduced_models as reduced_case
from validation.cases.wheel import half_space_study
from validation.railway.cases import rough_rail
from validation.railway.problems import rail_quantity
from validation.railway.scenes.level_files import RoughnessLevels
from validation.scenes import description, roughness
from validation.scenes.dynamic_wheel import WheelScene
from validation.scenes.measured import MeasuredHeights
from validation.simulation import indentation, rough_punch, track_spectrum
from validation.simulation.track_spectrum import PiecewisePowerLaw
from validation.theory import rolling

STRIPS_AT_A_SLOPE = partial(own.test_strips_at_equal_slopes_have_them, 0.3)
AREA, GAP = (
    partial(own.test_springs_are_right_where_persson_has_a_share_in_contact, *share)
    for share in (("true contact area", 0.9), ("mean gap", 0.5))
)
PIECES = partial(
    test_rolling_cases.test_power_laws_have_unit_height_and_are_continuous,
    PiecewisePowerLaw(edges=(1.0, 3.0), exponents=(2.0,)),
)
ONE_RAIL = own.test_a_rail_has_one_slope_of_its_strips_and_one_of_all_bands
OF_HEIGHTS = test_materials.test_slopes_are_those_of_heights
TABLE_14_1 = own.test_table_14_1_has_one_slope_everywhere
PLACES = {
    "the gradient of lost contact": (
        rolling,
        "rms_gradient",
        partial(test_rolling_theory.test_contact_that_linear_theory_loses_by_drawing_pressures, 1.0),
    ),
    "the gradient of a drawn surface": (
        roughness,
        "rms_gradient",
        test_materials.test_slopes_are_those_of_the_spectrum,
    ),
    "h' of a drawn surface": (roughness, "slope_in_one_direction", TABLE_14_1),
    "h' a/d of the wheel on the page": (half_space_study, "slope_ratio", TABLE_14_1),
    "h' a/d of Table 14.1 beside spectra": (reduced_case, "slope_ratio", TABLE_14_1),
    "h' of power laws": (track_spectrum, "slope_in_one_direction", PIECES),
    "the gradient of power laws": (PiecewisePowerLaw, "gradient", PIECES),
    "h' of rail and wheel": (WheelScene, "slope_along", own.test_slopes_of_rail_and_wheel_add_by_squares),
    "h' of measured heights": (MeasuredHeights, "slope_along", OF_HEIGHTS),
    "the gradient of measured heights": (MeasuredHeights, "gradient", OF_HEIGHTS),
    "the gradient of a claim on ridges": (
        MeasuredHeights,
        "gradient",
        own.test_anisotropic_heights_leave_their_gradient_open,
    ),
    "h' a/d of a description": (description, "slope_ratio", TABLE_14_1),
    "h' of a line": (NominalBands, "slope_of_spectrum", ONE_RAIL),
    "h' of levels": (RoughnessLevels, "slope_along", ONE_RAIL),
    "the loss-of-contact number of a case": (rough_rail, "lost_contact_number", ONE_RAIL),
    "the loss-of-contact number of models": (
        rail_quantity,
        "lost_contact_number",
        own.test_the_error_of_linear_theory_on_a_rail_goes_with_the_slope_along,
    ),
    "h' a/d in the words of rolling": (PiecewisePowerLaw, "slope_along", PIECES),
    "heights at an h' a/d": (reduced_case, "height_at", STRIPS_AT_A_SLOPE),
    "the gradient of the linear filter's limit": (
        PiecewisePowerLaw,
        "gradient",
        own.test_the_linear_filter_in_3d_ends_where_persson_loses_a_fifth,
    ),
    "the gradient of a drawn punch": (
        rough_punch,
        "_gradient",
        test_fractal_punch.test_surfaces_are_pressed_as_they_stand,
    ),
    "p over E* g of nine tenths in contact": (sweeps, "FULL", AREA),
    "p over E* g of one half in contact": (sweeps, "HALF", GAP),
    "loads of an interface by their contact": (
        Interface,
        "pressures",
        own.test_loads_of_an_interface_have_the_contact_of_their_name,
    ),
}
FAULTS = [
    row
    for what, (place, name, test) in PLACES.items()
    for became, factor in (("lost", math.sqrt(0.5)), ("gained", math.sqrt(2)))
    for row in (test, Fault(f"a root of two {became} in {what}").at(place, name, Times(factor)))
]
# cells are a power of two: their test has a load on each side of one
for became, factor, load in (("lost", math.sqrt(0.5), (1.04, 256)), ("gained", math.sqrt(2), (0.96, 128))):
    FAULTS += [
        partial(own.test_cells_of_a_light_punch_are_those_of_the_gradient, *load),
        Fault(f"a root of two {became} in the gradient of a light punch").at(
            indentation, "rms_gradient", Times(factor)
        ),
    ]
