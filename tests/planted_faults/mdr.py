"""Faults planted in what `tests/mdr` looks at: where, what is wrong there, and the test that must catch it."""

from functools import partial

import numpy as np

import bem3d
import mdr
from bem3d import surface
from mdr import elliptic_wheel, foundation, rolling_surface, sphere
from mdr import profile as profile_module
from mdr import rolling as wheel_on_springs
from mdr import rolling_ensemble as wheels_in_step
from mdr.approach_by_sorting import Borne, by_sorting
from mdr.candidate_springs import Near
from mdr.diagnostics import diagnose_linearity
from mdr.rolling_surface import weights_across
from tests.mdr import test_drawn_roughness as drawn
from tests.mdr import test_elliptic_wheels as ellipses
from tests.mdr import test_geike_mapping as of_geike
from tests.mdr import test_rolling_ensemble as in_step
from tests.mdr import test_rolling_springs as of_springs
from tests.mdr import test_rolling_surface as of_surfaces
from tests.mdr import test_spring_warnings as doubts
from tests.mdr import test_springs_against_brute_force as brute_force
from tests.planted_faults.wrong import E_FOR_E_STAR, Fault, Times, module_with
from validation.theory import rolling as rolling_theory


def even_across(half_widths, points, step):
    """Equal weights over the contact, for those of the flat punch."""
    y = np.abs(np.arange(points) + 0.5 - points / 2)[:, np.newaxis] * step
    inside = (y <= np.maximum(half_widths, step)).astype(float)
    return inside / inside.sum(axis=0)


def half_a_circle(modes, own_mirror, amplitudes, rng):
    return np.where(own_mirror, 1.0, np.exp(1j * np.pi * rng.random(modes)))


def on_the_highest_spring_alone(track, block, wanted, d):
    """Only the approach is wrong where more than one touches."""
    borne = by_sorting(track, block, wanted, d)
    return Borne(borne.approach + wanted * (1 - 1 / borne.pressed), borne.pressed, borne.looked)


load_curve = foundation.load_curve
resolved = profile_module._resolved


def profile_half_a_cell_ahead(wheels, springs):
    x = (np.arange(springs.start, springs.stop) + 0.5) * wheels.spacing
    return np.rint((x**2 / wheels.radius)[:, np.newaxis] / wheels.quantum)


reach = wheel_on_springs.SpringTrack.reach


PROFILE_BY_WAVES = partial(drawn.test_a_profile_is_the_sum_of_its_waves_in_the_order_of_their_numbers, 20, "fixed")
SURFACE_BY_WAVES = partial(drawn.test_a_surface_is_the_sum_of_its_waves_ring_by_ring, (6, 6), (1, 1), "fixed")
IN_STEP = partial(in_step.test_force_to_1e_12_of_the_smooth_wheel, 7.3, 0.1)

FAULTS = [
    brute_force.test_force_and_stiffness_at_an_approach,
    Fault("E for E* in springs").at(
        mdr,
        "load_curve",
        lambda height, *, length, modulus: load_curve(height, length=length, modulus=E_FOR_E_STAR * modulus),
    ),
    of_geike.test_line_trace_of_a_wide_power_law,
    Fault("Geike for the line trace").at(mdr.SelfAffine, "line", mdr.SelfAffine.c1d),
    SURFACE_BY_WAVES,
    Fault("surface shifted by half a cell").at(surface, "_half_a_cell", lambda mode, points: np.ones(mode.shape)),
    Fault("spectrum of a surface without its mirror images").at(surface, "_hermitian", lambda wave, amplitudes: wave),
    Fault("one-sided spectrum taken for two-sided").at(bem3d, "rough_surface", Times(np.sqrt(2))),
    PROFILE_BY_WAVES,
    # sqrt(2 pi / L) C_1D, which has the wrong unit
    Fault("(14.9) as printed").at(profile_module, "_resolved", lambda *given: resolved(*given) ** 2),
    Fault("phases on half of the circle").at(profile_module, "_random_waves", half_a_circle),
    partial(of_geike.test_moments_of_power_laws_are_kept, n=2),
    Fault("line trace for Geike").at(mdr.SelfAffine, "c1d", mdr.SelfAffine.line),
    partial(of_geike.test_moments_of_arbitrary_spectra_are_kept, n=0),
    Fault("q C_2D for Geike").at(mdr, "geike", Times(1 / np.pi)),
    partial(brute_force.test_springs_under_a_parabola_tend_to_the_sphere_at_second_order, 0.1),
    Fault("x^2 / 2R in one dimension").at(
        mdr, "sphere_profile", lambda x, *, radius: np.asarray(x) ** 2 / (2 * radius)
    ),
    of_springs.test_spectrum_of_the_linear_force_is_14_12,
    Fault("factor 4 lost in (14.12)").at(rolling_theory, "response", Times(0.5)),
    of_springs.test_full_contact_tends_to_the_filter_at_second_order,
    Fault("a for 2a under the wheel").at(
        wheel_on_springs.SpringTrack, "reach", lambda track, level: reach(track, level) // 2
    ),
    of_springs.test_force_is_the_sum_over_all_springs,
    Fault("x^2 / 2R under the wheel").at(wheel_on_springs.SpringTrack, "wheel", Times(0.5)),
    Fault("springs that pull wherever they are in doubt").at(
        wheel_on_springs, "np", module_with(np, maximum=lambda values, least: values)
    ),
    of_springs.test_one_sided_force_leaves_the_linear_one_at_second_order,
    Fault("springs that pull under the smooth wheel").at(
        wheel_on_springs, "_one_sided", lambda track, d: wheel_on_springs._full(track, float(d[0]), None)
    ),
    IN_STEP,
    Fault("x^2 / 2R under many wheels").at(mdr.RollingEnsemble, "_profile", Times(0.5)),
    Fault("many wheels half a cell ahead").at(mdr.RollingEnsemble, "_profile", profile_half_a_cell_ahead),
    Fault("E for E* under many wheels").at(mdr.RollingEnsemble, "force", Times(E_FOR_E_STAR)),
    partial(in_step.test_force_to_1e_12_of_the_smooth_wheel, 30.0, 0.1),
    Fault("springs that pull under many wheels").at(
        wheels_in_step, "np", module_with(np, maximum=lambda values, least, out=None: values)
    ),
    in_step.test_forces_are_independent_of_the_batch_to_the_last_bit,
    Fault("sums that round").at(
        wheels_in_step, "np", module_with(np, rint=lambda values: np.asarray(values, dtype=np.float64))
    ),
    partial(doubts.test_what_is_warned_of, "short waves"),
    Fault("springs that say nothing of short waves").at(profile_module, "diagnose_waves", lambda *_: ()),
    partial(doubts.test_what_is_warned_of, "4 springs"),
    Fault("few springs that say nothing").at(foundation, "diagnose_load", lambda *_: ()),
    partial(doubts.test_heights_in_another_unit_than_the_spacing, doubts.curve, 1e9 * doubts.PROFILE, {}, doubts.STEEP),
    Fault("heights in nm on a length in m that nobody asks about").at(foundation, "diagnose_heights", lambda *_: ()),
    partial(
        doubts.test_heights_in_another_unit_than_the_spacing,
        doubts.by_roll,
        1e6 * (doubts.TRACK - doubts.TRACK.max()),
        {},
        doubts.STEEP,
    ),
    Fault("a track in um that nobody asks about").at(wheel_on_springs, "diagnose_slope", lambda *_: ()),
    partial(doubts.test_the_ends_of_a_linear_contact_move_as_warned, "linear", None),
    Fault("ends of a linear contact that move twice as far").at(
        wheel_on_springs,
        "diagnose_linearity",
        lambda height, change, **contact: diagnose_linearity(height, change / 2, **contact),
    ),
    of_springs.test_a_light_wheel_over_a_spike_of_a_thousand_times_the_roughness,
    Fault("a spike that nobody rolls over").at(Near, "beyond", lambda _, offsets: np.zeros(offsets.shape, dtype=bool)),
    partial(of_springs.test_a_light_wheel_over_a_spike, 0.1),
    Fault("a light wheel on its highest spring alone").at(wheel_on_springs, "by_sorting", on_the_highest_spring_alone),
    partial(doubts.test_warnings_of_the_units_of_a_sphere, 1.0, 1.21, 1),
    Fault("a contact wider than its sphere that nobody asks about").at(sphere, "diagnose_units", lambda **_: ()),
    ellipses.test_the_smooth_wheel_rolls_at_the_approach_of_the_ellipse,
    Fault("springs of an ellipse as stiff as those of a sphere").at(
        wheel_on_springs,
        "spring_wheel",
        lambda radius, modulus: elliptic_wheel.spring_wheel(radius, 1.0)._replace(modulus=modulus),
    ),
    ellipses.test_an_ensemble_rolls_as_its_wheels_one_by_one,
    Fault("an ensemble on the springs of a sphere").at(
        wheels_in_step,
        "spring_wheel",
        lambda radius, modulus: elliptic_wheel.spring_wheel(radius, modulus)._replace(modulus=modulus),
    ),
    ellipses.test_springs_have_the_load_curve_and_the_length_of_the_ellipse,
    Fault("the radius along the track for that of the contact").at(
        ellipses, "spring_wheel", lambda radius, modulus: (radius[0], modulus, 1.0)
    ),
    partial(of_surfaces.test_low_waves_of_any_direction_have_the_filter_of_the_half_space, 1.0, (0, 3)),
    Fault("equal weights across the contact").at(rolling_surface, "weights_across", even_across),
    of_surfaces.test_it_is_a_sum_over_springs_and_across,
    Fault("one width across for all springs").at(
        rolling_surface,
        "weights_across",
        lambda widths, points, step: weights_across(np.full_like(widths, widths.max()), points, step),
    ),
]
