"""Faults planted in what `tests/theory` looks at: where, what is wrong there, and the test that must catch it."""

import importlib
import math
import types
from dataclasses import replace
from functools import partial

import numpy as np
from scipy import special

import mdr
from tests.planted_faults.wrong import Fault, Times
from tests.railway import test_spring_input as of_input
from tests.railway import test_transverse_structure as across
from tests.theory import test_closed_forms as forms
from tests.theory import test_interface as of_interface
from tests.theory import test_rolling_theory as of_rolling
from tests.theory import test_second_order, test_wheel
from validation.analysis import spectra
from validation.railway.theory import contact_filters as spring_input
from validation.railway.theory import transverse_structure
from validation.railway.theory.transverse_structure import LineSpectrum
from validation.theory import closed_forms, interface, wheel
from validation.theory import rolling as rolling_theory
from validation.theory.rolling import RollingWheel


def damped_wheel_alone(omega, **given):
    """M^2 times what the acceleration has."""
    return wheel.acceleration_over_force(omega, mass=1.0, **given)


pairs_of, compliance_of = RollingWheel._pairs, RollingWheel.compliance


def slopes_in_one_direction(c2d, edges):
    q, s = SLOPES(c2d, edges)
    return q, s / math.sqrt(2)


two_sided = spectra.Waves.spectrum.fget
FAR_WAVES = across.test_far_waves_are_all_there_once_and_a_fast_filter_has_its_mean
SLOPES = interface._slopes
periods, panels_across = transverse_structure._periods, transverse_structure._panels_across


# the function of this name hides the module in the package
feed = importlib.import_module("mdr.rolling_spectrum")


def circle_for_the_ellipse(along, across, *, semi_axes):
    return ellipse_of_springs(along, across, semi_axes=(semi_axes[0], semi_axes[0]))


ellipse_of_springs = spring_input.rolling_input_filter


FAULTS = [
    partial(of_interface.test_the_stiffness_is_the_slope_of_the_gap_that_the_energy_leaves, 0.45),
    Fault("waves of an interface by their slope in one direction").at(interface, "_slopes", slopes_in_one_direction),
    Fault("the contact of an interface without the root of two").at(
        interface, "special", types.SimpleNamespace(erf=lambda x: special.erf(x / math.sqrt(2)))
    ),
    of_interface.test_the_area_is_that_of_pressures_that_diffuse,
    Fault("pressures that diffuse half as fast").at(
        of_interface, "contact_fraction", lambda pressure, gradient: math.erf(pressure / gradient)
    ),
    partial(of_input.test_on_a_circle_it_is_the_rolling_spectrum_of_a_wheel, 700.0),
    Fault("a circle for the ellipse in the rolling spectrum of a rail").at(
        spring_input, "rolling_input_filter", circle_for_the_ellipse
    ),
    partial(of_input.test_geikes_rule_over_the_line_of_a_power_law, 2.0),
    Fault("Geike's rule over the line without pi").at(spring_input, "geike_over_line", Times(1 / math.pi)),
    forms.test_hertz_pressure_integrates_to_the_force,
    Fault("2/3 for 4/3 in the force of Hertz").at(closed_forms, "hertz_force", Times(0.5)),
    forms.test_hertz_stiffness_is_that_of_the_punch_of_its_radius,
    Fault("a for 2a in the stiffness of Hertz").at(closed_forms, "circular_punch_stiffness", Times(0.5)),
    partial(of_rolling.test_sections_are_line_traces, 0.7),
    Fault("Geike for the line trace in rolling").at(mdr.SelfAffine, "line", mdr.SelfAffine.c1d),
    partial(of_rolling.test_springs_that_are_fed_for_rolling_have_the_level_of_the_half_space, 0.7, 1.0),
    Fault("springs that roll fed by Geike").at(
        feed, "_across", lambda q, c2d, edges, flat: float(np.pi * q * c2d(np.array(q)))
    ),
    partial(of_rolling.test_large_wheels_are_fed_less_than_geike, 0.7),
    Fault("springs that roll fed by the line trace").at(
        feed, "_across", lambda q, c2d, edges, flat: float(rolling_theory.section(q, c2d, edges=edges))
    ),
    partial(of_rolling.test_force_spectrum_by_adaptive_quadrature, 0.7, 1.7),
    Fault("factor 4 lost in the spectrum of the half-space").at(rolling_theory, "response", Times(0.5)),
    of_rolling.test_spectra_of_profiles_are_the_ones_they_are_drawn_from,
    Fault("one-sided spectrum of a track").at(spectra.Waves, "spectrum", property(lambda waves: 2 * two_sided(waves))),
    partial(across.test_a_line_over_its_surface_is_that_line, 50.0),
    Fault("half of Abel's inverse").at(LineSpectrum, "isotropic", Times(0.5)),
    partial(across.test_some_periods_stand_for_all, transverse_structure.Ridges(), 0),
    Fault("a place for its period, where a contact is many waves wide").at(
        transverse_structure, "_periods", lambda ends, period: transverse_structure.gauss(ends)
    ),
    partial(across.test_work_ends_where_the_contact_is_many_waves_wide, transverse_structure.WaveBand(1.0)),
    Fault("a work that grows with a contact that is many waves wide").at(transverse_structure, "FAR", math.inf),
    partial(across.test_the_mean_over_isotropic_ground, 150.0),
    Fault("ridges for isotropic ground").at(
        transverse_structure.IsotropicGround, "mean_square", transverse_structure.Ridges.mean_square
    ),
    across.test_ground_without_its_shortest_waves_has_the_line_that_is_left,
    Fault("a line that keeps the waves which its surface has lost").at(
        transverse_structure.IsotropicGround, "line_power", lambda ground, q: ground.line(q)
    ),
    partial(FAR_WAVES, transverse_structure.WaveBand(0.7)),
    Fault("far waves over half of a period").at(
        transverse_structure, "_periods", lambda ends, period: periods(ends, np.asarray(period) / 2)
    ),
    Fault("near waves counted among the far, too").at(
        transverse_structure, "_panels_across", lambda q, end, period, begin=0.0: panels_across(q, end, period)
    ),
    test_wheel.test_acceleration_and_force_over_the_force_at_a_fixed_approach,
    Fault("a dashpot without its own force on the wheel").at(wheel, "contact_force_over_force", damped_wheel_alone),
    partial(test_second_order.test_the_second_order_force_is_that_of_drawn_profiles, test_second_order.FIXED),
    Fault("half of the second-order force").at(RollingWheel, "force_spectrum", Times(0.25)),
    partial(test_second_order.test_the_second_order_force_is_that_of_drawn_profiles, test_second_order.MOVING),
    Fault("pairs of waves without the motion of the wheel").at(
        RollingWheel, "_pairs", lambda wheel, *waves: pairs_of(replace(wheel, mass=math.inf), *waves)
    ),
    test_second_order.test_two_waves_have_the_force_of_their_sum_and_difference,
    Fault("one end of the contact for both").at(
        RollingWheel, "_pairs", lambda wheel, *waves: pairs_of(wheel, *waves) / 4
    ),
    test_second_order.test_at_the_resonance_the_dashpot_alone_bears_the_force,
    Fault("twice the dashpot at the resonance").at(
        RollingWheel, "compliance", lambda wheel, q: compliance_of(replace(wheel, damping=2 * wheel.damping), q)
    ),
]
