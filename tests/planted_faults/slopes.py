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
PIECES = partial(
    test_rolling_cases.test_power_laws_have_unit_height_and_are_continuous,
    PiecewisePowerLaw(edges=(1.0, 3.0), exponents=(2.0,)),
)
ONE_RAIL = own.test_a_rail_has_one_slope_of_its_strips_and_one_of_all_bands
OF_HEIGHTS = test_materials.test_slopes_are_those_of_heights
TABLE_14_1 = own.test_table_14_1_has_one_slope_everywhere
FAULTS = [
    partial(test_rolling_theory.test_contact_that_linear_theory_loses_by_drawing_pressures, 1.0),
    Fault("a root of two lost in the gradient of lost contact").at(rolling, "rms_gradient", Times(math.sqrt(0.5))),
    Fault("a root of two gained in the gradient of lost contact").at(rolling, "rms_gradient", Times(math.sqrt(2))),
    test_materials.test_slopes_are_those_of_the_spectrum,
    Fault("a root of two lost in the gradient of a drawn surface").at(roughness, "rms_gradient", Times(math.sqrt(0.5))),
    Fault("a root of two gained in the gradient of a drawn surface").at(roughness, "rms_gradient", Times(math.sqrt(2))),
    TABLE_14_1,
    Fault("a root of two lost in h' of a drawn surface").at(roughness, "slope_in_one_direction", Times(math.sqrt(0.5))),
    Fault("a root of two gained in h' of a drawn surface").at(roughness, "slope_in_one_direction", Times(math.sqrt(2))),
    TABLE_14_1,
    Fault("a root of two lost in h' a/d of the wheel on the page").at(
        half_space_study, "slope_ratio", Times(math.sqrt(0.5))
    ),
    Fault("a root of two gained in h' a/d of the wheel on the page").at(
        half_space_study, "slope_ratio", Times(math.sqrt(2))
    ),
    TABLE_14_1,
    Fault("a root of two lost in h' a/d of Table 14.1 beside spectra").at(
        reduced_case, "slope_ratio", Times(math.sqrt(0.5))
    ),
    Fault("a root of two gained in h' a/d of Table 14.1 beside spectra").at(
        reduced_case, "slope_ratio", Times(math.sqrt(2))
    ),
    PIECES,
    Fault("a root of two lost in h' of power laws").at(track_spectrum, "slope_in_one_direction", Times(math.sqrt(0.5))),
    Fault("a root of two gained in h' of power laws").at(track_spectrum, "slope_in_one_direction", Times(math.sqrt(2))),
    PIECES,
    Fault("a root of two lost in the gradient of power laws").at(PiecewisePowerLaw, "gradient", Times(math.sqrt(0.5))),
    Fault("a root of two gained in the gradient of power laws").at(PiecewisePowerLaw, "gradient", Times(math.sqrt(2))),
    own.test_slopes_of_rail_and_wheel_add_by_squares,
    Fault("a root of two lost in h' of rail and wheel").at(WheelScene, "slope_along", Times(math.sqrt(0.5))),
    Fault("a root of two gained in h' of rail and wheel").at(WheelScene, "slope_along", Times(math.sqrt(2))),
    OF_HEIGHTS,
    Fault("a root of two lost in h' of measured heights").at(MeasuredHeights, "slope_along", Times(math.sqrt(0.5))),
    Fault("a root of two gained in h' of measured heights").at(MeasuredHeights, "slope_along", Times(math.sqrt(2))),
    OF_HEIGHTS,
    Fault("a root of two lost in the gradient of measured heights").at(
        MeasuredHeights, "gradient", Times(math.sqrt(0.5))
    ),
    Fault("a root of two gained in the gradient of measured heights").at(
        MeasuredHeights, "gradient", Times(math.sqrt(2))
    ),
    own.test_anisotropic_heights_leave_their_gradient_open,
    Fault("a root of two lost in the gradient of a claim on ridges").at(
        MeasuredHeights, "gradient", Times(math.sqrt(0.5))
    ),
    Fault("a root of two gained in the gradient of a claim on ridges").at(
        MeasuredHeights, "gradient", Times(math.sqrt(2))
    ),
    TABLE_14_1,
    Fault("a root of two lost in h' a/d of a description").at(description, "slope_ratio", Times(math.sqrt(0.5))),
    Fault("a root of two gained in h' a/d of a description").at(description, "slope_ratio", Times(math.sqrt(2))),
    ONE_RAIL,
    Fault("a root of two lost in h' of a line").at(NominalBands, "slope_of_spectrum", Times(math.sqrt(0.5))),
    Fault("a root of two gained in h' of a line").at(NominalBands, "slope_of_spectrum", Times(math.sqrt(2))),
    ONE_RAIL,
    Fault("a root of two lost in h' of levels").at(RoughnessLevels, "slope_along", Times(math.sqrt(0.5))),
    Fault("a root of two gained in h' of levels").at(RoughnessLevels, "slope_along", Times(math.sqrt(2))),
    ONE_RAIL,
    Fault("a root of two lost in the loss-of-contact number of a case").at(
        rough_rail, "lost_contact_number", Times(math.sqrt(0.5))
    ),
    Fault("a root of two gained in the loss-of-contact number of a case").at(
        rough_rail, "lost_contact_number", Times(math.sqrt(2))
    ),
    own.test_the_error_of_linear_theory_on_a_rail_goes_with_the_slope_along,
    Fault("a root of two lost in the loss-of-contact number of models").at(
        rail_quantity, "lost_contact_number", Times(math.sqrt(0.5))
    ),
    Fault("a root of two gained in the loss-of-contact number of models").at(
        rail_quantity, "lost_contact_number", Times(math.sqrt(2))
    ),
    PIECES,
    Fault("a root of two lost in h' a/d in the words of rolling").at(
        PiecewisePowerLaw, "slope_along", Times(math.sqrt(0.5))
    ),
    Fault("a root of two gained in h' a/d in the words of rolling").at(
        PiecewisePowerLaw, "slope_along", Times(math.sqrt(2))
    ),
    STRIPS_AT_A_SLOPE,
    Fault("a root of two lost in heights at an h' a/d").at(reduced_case, "height_at", Times(math.sqrt(0.5))),
    Fault("a root of two gained in heights at an h' a/d").at(reduced_case, "height_at", Times(math.sqrt(2))),
    own.test_the_linear_filter_in_3d_ends_where_persson_loses_a_fifth,
    Fault("a root of two lost in the gradient of the linear filter's limit").at(
        PiecewisePowerLaw, "gradient", Times(math.sqrt(0.5))
    ),
    Fault("a root of two gained in the gradient of the linear filter's limit").at(
        PiecewisePowerLaw, "gradient", Times(math.sqrt(2))
    ),
    test_fractal_punch.test_surfaces_are_pressed_as_they_stand,
    Fault("a root of two lost in the gradient of a drawn punch").at(rough_punch, "_gradient", Times(math.sqrt(0.5))),
    Fault("a root of two gained in the gradient of a drawn punch").at(rough_punch, "_gradient", Times(math.sqrt(2))),
    partial(own.test_springs_are_right_where_persson_has_a_share_in_contact, "true contact area", 0.9),
    Fault("a root of two lost in p over E* g of nine tenths in contact").at(sweeps, "FULL", Times(math.sqrt(0.5))),
    Fault("a root of two gained in p over E* g of nine tenths in contact").at(sweeps, "FULL", Times(math.sqrt(2))),
    partial(own.test_springs_are_right_where_persson_has_a_share_in_contact, "mean gap", 0.5),
    Fault("a root of two lost in p over E* g of one half in contact").at(sweeps, "HALF", Times(math.sqrt(0.5))),
    Fault("a root of two gained in p over E* g of one half in contact").at(sweeps, "HALF", Times(math.sqrt(2))),
    own.test_loads_of_an_interface_have_the_contact_of_their_name,
    Fault("a root of two lost in loads of an interface by their contact").at(
        Interface, "pressures", Times(math.sqrt(0.5))
    ),
    Fault("a root of two gained in loads of an interface by their contact").at(
        Interface, "pressures", Times(math.sqrt(2))
    ),
    # cells are a power of two: this test has a load on each side of one
    partial(own.test_cells_of_a_light_punch_are_those_of_the_gradient, 1.04, 256),
    Fault("a root of two lost in the gradient of a light punch").at(indentation, "rms_gradient", Times(math.sqrt(0.5))),
    partial(own.test_cells_of_a_light_punch_are_those_of_the_gradient, 0.96, 128),
    Fault("a root of two gained in the gradient of a light punch").at(indentation, "rms_gradient", Times(math.sqrt(2))),
]
