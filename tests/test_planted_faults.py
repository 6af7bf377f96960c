"""Negative controls: each fault is planted on purpose, and the named test must catch it."""

import dataclasses
import functools
import importlib
import inspect
import math
import sys
import types
from collections.abc import Iterator

import numpy as np
import pytest
from scipy import stats

import bem3d
import mdr
from bem3d import contact, halfspace, kernel, problem, projected_cg, surface, tangent_stiffness, window, window_solve
from bem3d import rolling as wheel_on_strip
from bem3d.rolling_frame import Frame, Track
from mdr import foundation
from mdr import profile as profile_module
from mdr import rolling as wheel_on_springs
from mdr import rolling_ensemble as wheels_in_step
from mdr.approach_by_sorting import Borne, by_sorting
from mdr.candidate_springs import Near
from mdr.diagnostics import doubts_of_linearity
from tests import (
    test_accepted_solves,
    test_claims,
    test_closed_forms,
    test_contact_properties,
    test_convergence_rates,
    test_doubts,
    test_doubts_of_springs,
    test_drawn_roughness,
    test_ensemble,
    test_error_bars,
    test_evidence,
    test_figure_lines,
    test_flags,
    test_fractal_punch,
    test_geike_mapping,
    test_ladder,
    test_limits,
    test_load_paths,
    test_materials,
    test_measured_heights,
    test_operator_against_dense_twin,
    test_precision,
    test_printed,
    test_read_only_results,
    test_rolling_contact,
    test_rolling_springs,
    test_rolling_theory,
    test_rough_punches,
    test_rules_by_loops,
    test_selection,
    test_springs_against_brute_force,
    test_steadiness,
    test_wheel_cases,
    test_wheel_motion,
    test_wheel_spectra,
    test_wheel_stability,
    test_wheels_on_springs,
    test_windows_and_starts,
)
from validation.analysis import records, spectra, statistics
from validation.analysis import spectral_features as regions
from validation.analysis.evidence import Number, Verdict, claim
from validation.benchmarks.work_precision import dynamic_wheel as precision_wheel
from validation.benchmarks.work_precision import errors as precision_error
from validation.benchmarks.work_precision import measurement as precision
from validation.cases.limits import springs as limits_mdr
from validation.cases.limits import sweep as limits
from validation.cases.punch import area_gap_rolloff as mdr_limits
from validation.cases.punch import fractal_punch, fractal_punch_decades
from validation.cases.rolling import force_spectrum_evidence as rolling_evidence
from validation.cases.selection import model_selection as ladder_on_trial
from validation.engine import engine as ensemble
from validation.report import build
from validation.report.figures import rolling as rolling_figure
from validation.scenes import dynamic_wheel as wheel_scene
from validation.scenes import material, measured, roughness, steadiness
from validation.selection import compare
from validation.selection import hierarchy as ladder_of_models
from validation.selection import indentation_models as rungs_pressed
from validation.selection import indentation_on_grids as rungs_pressed_grids
from validation.selection import rolling_models as rungs_rolling
from validation.simulation import contact_laws, free_vibration, integrators, rough_punch
from validation.simulation import indentation as pressed_heights
from validation.simulation import motion as wheel_in_motion
from validation.simulation import rolling_levels as rolled
from validation.simulation import rolling_quantity as rolling_question
from validation.simulation import spring_tracks as rough_springs
from validation.simulation import wheel_on_springs as wheel_ensemble
from validation.simulation.rough_punch import PunchRoughness
from validation.theory import closed_forms
from validation.theory import rolling as rolling_theory
from validation.theory import wheel as wheel_theory

POISSON = 1 / 3


def in_the_case(attribute, wrong):
    """A fault that only the fractal punch sees: its own view of a module, with one name changed."""
    view = types.SimpleNamespace(**{name: getattr(attribute, name) for name in attribute.__all__})
    for name, value in wrong.items():
        setattr(view, name, value)
    return view


def half_of_the_force(half_space, gap, *, forces, **settings):
    return bem3d.indent(half_space, gap, forces=[force / 2 for force in forces], **settings)


def upside_down(half_space, gap, **settings):
    return bem3d.indent(half_space, -gap, **settings)


def twice_the_same(entropy, *key):
    return ensemble.generator(entropy, *key[:-1], key[-1] // 2)


def half_a_circle(modes, own_mirror, amplitudes, rng):
    return np.where(own_mirror, 1.0, np.exp(1j * np.pi * rng.random(modes)))


def by_the_filter_of_one_dimension(q, c2d, *, edges, contact_radius, modulus):
    geike = functools.partial(mdr.geike, c2d=c2d)
    return rolling_theory.force_spectrum_1d(q, geike, contact_radius=contact_radius, modulus=modulus)


def without_a_resonator(question, q):
    return np.ones_like(q) / question.scene.body.mass


def one_standard_error(ratios):
    return float(np.sqrt(np.mean(ratios.var(axis=0, ddof=1) / len(ratios))))


drawn_on_a_grid = pressed_heights._drawn


def at_points(heights, grid):
    along, across = ((np.arange(n) - (n - 1) / 2) * grid.spacing for n in (grid.along // 2, grid.across))
    return heights.at(along, across)


measured_spectrum = measured._spectrum


def behind_the_mask(height):
    return np.asarray(height, dtype=np.float64)


slope_in_one_direction = roughness.Roughness.slope_along.fget


def half_of_the_level(height, spacing):
    edges, level = measured_spectrum(height, spacing)
    return edges, tuple(value / 2 for value in level)


def other_waves_on_every_grid(ground, shortest, cells, side, rng):
    return drawn_on_a_grid(ground, shortest, cells, side, np.random.default_rng(cells))


def the_last_change_alone(earlier, last):
    return abs(float(last.mean())) + ladder_of_models.mean_error(last[:, np.newaxis])


def without_the_noise_of_its_series(earlier, last):
    before, after = (abs(float(change.mean())) for change in (earlier, last))
    ratio = min(after / before, ladder_of_models.SLOWEST)
    return after * max(1.0, ratio / (1 - ratio)) + ladder_of_models.mean_error(last[:, np.newaxis])


def mean_over_bands(ratios):
    return float(np.mean([ladder_of_models.mean_error(band[:, np.newaxis]) for band in ratios.T]))


def the_same_every_time(entropy, *key):
    return ensemble.generator(entropy, *key[:-1], 0)


def of_unit_modulus(**settings):
    return bem3d.HalfSpace(**{**settings, "modulus": 1.0})


pressed_on_a_grid = rungs_pressed_grids.IndentationOnGrid._pressed


def another_surface_on_coarser_grids(rung, realisation, cells):
    return pressed_on_a_grid(rung, realisation + (cells != rung.cells), cells)


def another_strip_beside(rung, realisation, cells):
    other = realisation + (cells == rung.beside)
    return rungs_rolling.on_boundary_elements(rung.question, cells, other, rung.seed)


def geike_for_what_rolls(ground, contact_radius):
    return functools.partial(mdr.geike, c2d=ground.c2d)


def with_math(**wrong):
    """math with some names changed."""
    return types.SimpleNamespace(**{**vars(math), **wrong})


def on_the_highest_spring_alone(track, block, wanted, d):
    """Only the approach is wrong where more than one touches."""
    borne = by_sorting(track, block, wanted, d)
    return Borne(borne.approach + wanted * (1 - 1 / borne.pressed), borne.pressed, borne.looked)


def scaled(function, factor):
    """The same function with a factor on its result."""

    @functools.wraps(function)
    def wrong(*args, **kwargs):
        return factor * function(*args, **kwargs)

    return wrong


def shifted_table(cells, aspect):
    x, y = np.arange(cells[0])[:, np.newaxis], aspect * np.arange(cells[1])
    return kernel.love(x + 0.5, y, 1.0, aspect)


def one_sided_corner(x, y):
    return kernel._half(np.asarray(x, dtype=float), np.asarray(y, dtype=float))


def softer_curve(height, *, length, modulus):
    return load_curve(height, length=length, modulus=modulus * (1 - POISSON**2))


def stretched_curve(height, *, length, modulus):
    return load_curve(height, length=1.1523 * length, modulus=modulus)


def half_of_the_parabola(x, *, radius):
    return np.asarray(x) ** 2 / (2 * radius)


def level_of_the_rolling_force(hurst):
    """Gamma(H + 3/2) / (sqrt(pi) Gamma(H + 2)), the ratio of force spectra, for that of heights."""
    return math.gamma(hurst + 1.5) / (math.sqrt(math.pi) * math.gamma(hurst + 2))


def half_of_the_slope(pressure, *, gradient):
    """erf(p / (E* h')), without the root of two."""
    return math.erf(pressure / gradient)


def half_of_the_limit(scheme, x):
    return amplification(scheme, 2 * np.asarray(x))


def of_a_continuum(track, stride):
    """Springs however coarse taken for the finest."""
    return linear_response(track, 1)


def forgiving_residual(pressure, w, overlap):
    return 1e-6 * contact.residual(pressure, w, overlap)


def blind_to_penetration(pressure, w, overlap):
    return contact.residual(pressure, np.maximum(w, 0.0), overlap)


def grown_contact(half_space, cells, **settings):
    wider = cells | np.roll(cells, 1, axis=0)
    return tangent_stiffness.solve_fixed_area(half_space, wider, **settings)


def half_a_window(half_space, marked):
    """The middle of the box that holds all cells which may touch."""
    return tuple(
        slice(side.start + (side.stop - side.start) // 4, side.stop - (side.stop - side.start) // 4)
        for side in window.smallest_box(half_space, marked)
    )


def sum_of_the_pressure(half_space, cells, **settings):
    """k = sum(p) dx dy, whose error is the residual and not its square."""
    result = tangent_stiffness.solve_fixed_area(half_space, cells, **settings)
    return dataclasses.replace(result, stiffness=float(result.pressure.sum()) * half_space.cell_area)


def printed_formula(c1d, q, nyquist):
    """(14.9) as printed: sqrt(2 pi / L) C_1D, which has the wrong unit."""
    return resolved(c1d, q, nyquist) ** 2


load_curve, resolved = foundation.load_curve, profile_module._resolved
E_FOR_E_STAR = 1 - POISSON**2


class LineForGeike(mdr.SelfAffine):
    c1d = mdr.SelfAffine.line


def line_for_geike(roughness):
    first, last = roughness.waves
    return LineForGeike(hurst=roughness.hurst, q_min=2 * np.pi * first, q_max=2 * np.pi * last, rms=roughness.height)


def each_level_for_itself(realisations, rng):
    """Resamples drawn anew at every level."""
    alone = [statistics.sample(realisations[:, [level]], rng) for level in range(realisations.shape[1])]
    return statistics.Sample(
        *(np.concatenate([getattr(one, name) for one in alone], axis=1) for name in ("moments", "resampled")),
        size=len(realisations),
    )


def gap_of_the_rigid_surface(surface):
    """The mean gap as if the half-space did not yield."""
    outcome = rough_punch.press_surface(surface)
    return {**outcome, "gap": -outcome["approach"]}


def in_numpy(wrong):
    """numpy with some names changed."""
    return types.SimpleNamespace(**{**vars(np), **wrong})


def four_times_the_force(frame, pressure):
    force, centre, variance = moments(frame, pressure)
    return 4 * force, centre, variance


def half_a_cell_ahead(track, rows):
    return (np.asarray(rows) + 0.5) * track.steps[0]


def half_a_cell_aside(track, columns):
    return (np.asarray(columns) - track.height.shape[1] / 2) * track.steps[1]


def half_the_contact(track, level):
    """Springs within a / 2: a for 2a."""
    return reach(track, level) // 2


def springs_that_pull(track, approach):
    """All springs under the smooth wheel, in tension too."""
    return wheel_on_springs._full(track, float(approach[0]), None)


def springs_that_pull_at_the_edge(values, least):
    return values


def geike_for_rolling(q, c2d, edges, flat):
    return float(np.pi * q * c2d(np.array(q)))


def line_for_rolling(q, c2d, edges, flat):
    return float(rolling_theory.section(q, c2d, edges=edges))


def one_sided_spectrum(found):
    return 2 * two_sided(found)


def profile_half_a_cell_ahead(wheels, springs):
    x = (np.arange(springs.start, springs.stop) + 0.5) * wheels.spacing
    return np.rint((x**2 / wheels.radius)[:, np.newaxis] / wheels.quantum)


def springs_that_pull_in_step(values, least, out=None):
    return values


def a_place_late(wheels, place, approach):
    return force_in_step(wheels, place + 1, approach)


def not_rounded(values):
    """numpy's rint, as if there were no quantum."""
    return np.asarray(values, dtype=np.float64)


def without_load(wheel, law, **settings):
    """M z'' = F."""
    weightless = types.SimpleNamespace(load=0.0, mass=wheel.mass, eigenfrequency=wheel.eigenfrequency)
    return wheel_in_motion.simulate(weightless, law, **settings)


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


def inverted(omega, *, eigenfrequency, mass):
    """omega / omega_0 for omega_0 / omega."""
    return 1 / (mass * (1 - (np.asarray(omega) / eigenfrequency) ** 2)) ** 2


def held_at_the_edge(energy):
    """A wheel that does not lift off."""
    return 0.0 if energy >= 0 else other_turning_point(energy)


def without_a_jump(motion):
    return motion.onward - motion.onward


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


def dt_for_its_square(series, *, time_step, window="none"):
    """(14.17) with dt / T."""
    record = spectra_of_records(series, time_step=time_step, window=window)
    return records.Record(record.omega, record.density / time_step)


def one_sided_record(series, *, time_step, window="none"):
    record = spectra_of_records(series, time_step=time_step, window=window)
    return records.Record(record.omega, 2 * record.density)


def hann_as_it_is(series, *, time_step, window="none"):
    """Hann's window without its mean square, 3 / 8."""
    record = spectra_of_records(series, time_step=time_step, window=window)
    return records.Record(record.omega, record.density * (3 / 8 if window == "hann" else 1))


def half_of_the_circumference(scene):
    """pi R / dx."""
    return round(np.pi * scene.radius / scene.spacing)


def always_open(rides):
    """Places of an open track, whatever the track."""
    return places_of(dataclasses.replace(rides, track="open"))


def by_geike(rides):
    return heights_of(dataclasses.replace(rides, feed="geike"))


def half_a_line_on(omega, hann, below):
    return peak(omega, hann, below) + omega[0] / 2


def slope_of_what_is_steep(omega, density, first, last, period):
    centres, means = regions.levelled(omega, density, first, last, period, 0.0)
    return float(np.polyfit(np.log(centres), np.log(means), 1)[0])


def ends_that_move_twice_as_far(height, change, **contact):
    return doubts_of_linearity(height, change / 2, **contact)


def without_resonance(omega, *, eigenfrequency, mass):
    """a = dF / M."""
    return np.full(np.shape(omega), mass**-2.0)


def as_if_alone(quantity, mine, reference):
    """Paired realisations taken for independent ones."""
    return precision_error.error(quantity, dataclasses.replace(mine, paired=False), reference)


def at_first_order(answer, quantity, rows):
    return log_of_answer(answer, dataclasses.replace(quantity, order=1.0), rows)


def without_its_logarithm(*, mean_pressure, amplitude, wavelength, modulus):
    """d = h s."""
    return amplitude * mean_pressure * wavelength / (np.pi * modulus * amplitude)


def in_continuous_time(wheel, omega, time_step):
    """omega for the 2 sin(omega dt / 2) / dt of leapfrog."""
    return -(omega**2) / (wheel.stiffness - wheel.mass * omega**2)


def of_one_tail(estimate):
    """The quantile of 90 %."""
    return float(stats.t.ppf(0.95, estimate.samples - 1)) * estimate.error


def two_standard_errors(estimate):
    return 2 * estimate.error


def ends_apart(estimate):
    """All of the interval for its half."""
    return 2 * half_of_the_interval(estimate)


def scatter_of_the_sample_itself(drawn, statistic):
    """The bootstrap's own standard error, (n - 1) / n of the variance."""
    found = estimated(drawn, statistic)
    return dataclasses.replace(found, error=found.error * math.sqrt((found.samples - 1) / found.samples))


def of_all_samples(estimates):
    """n k - 1 degrees of freedom for (n - 1) k."""
    found = statistics.mean_of(estimates)
    return dataclasses.replace(found, samples=sum(estimate.samples for estimate in estimates))


def half_of_the_way(coarse, finer):
    """What halving the cells changes, for what all halvings do."""
    value, left = statistics.extrapolated(coarse, finer)
    return dataclasses.replace(value, value=coarse.value + finer.value), left


def fine_before_coarse(coarse, fine, rng):
    return statistics.pairs(fine, coarse, rng)


def sample_for_grid(*, grid, sample, **settings):
    return Number(grid=sample, sample=grid, **settings)


def at_ten_times_the_tolerance(attempt, residual, tolerance, max_iterations):
    judged(attempt, residual, 10 * tolerance, max_iterations)


def whoever_has_ended(contact):
    return contact.status in ("converged", "iteration limit")


def both_edges(bands, q, values):
    inside = (q[:, np.newaxis] >= bands.edges[:-1]) & (q[:, np.newaxis] <= bands.edges[1:])
    return values @ inside.astype(complex)


def unless_it_differs(sentence, numbers):
    """An undecided number taken for one that agrees."""
    return claim(sentence, [n for n in numbers if n.verdict is not Verdict.UNDECIDED])


half_of_the_interval, estimated = statistics.Estimate.half_width.fget, statistics.Sample.estimate
judged = window_solve.IterationState.judge
log_of_answer = precision_error.MethodAnswers.log
spectra_of_records, peak = records.spectra, regions.peak
places_of, heights_of = wheel_ensemble.WheelEnsemble.places.fget, wheel_ensemble.WheelEnsemble.heights
amplification, linear_response = free_vibration.amplification, rough_springs.linear_response
force_in_step, other_turning_point = mdr.RollingEnsemble.force, wheel_theory._other_turning_point
moments, reach, two_sided = Frame._moments, wheel_on_springs.SpringTrack.reach, spectra.Waves.spectrum.fget
# the function of this name hides the module in the package
feed = importlib.import_module("mdr.rolling_spectrum")
FAULTS = {
    "E for E* in boundary elements": (
        (kernel, "free_space_symbol", scaled(kernel.free_space_symbol, E_FOR_E_STAR)),
        test_convergence_rates.test_sphere_force_at_second_order,
    ),
    "E for E* in springs": (
        (mdr, "load_curve", softer_curve),
        test_springs_against_brute_force.test_force_and_stiffness_at_an_approach,
    ),
    "2/3 for 4/3 in the force of Hertz": (
        (closed_forms, "hertz_force", scaled(closed_forms.hertz_force, 0.5)),
        test_closed_forms.test_hertz_pressure_integrates_to_the_force,
    ),
    "a for 2a in the stiffness of Hertz": (
        (closed_forms, "circular_punch_stiffness", scaled(closed_forms.circular_punch_stiffness, 0.5)),
        test_closed_forms.test_hertz_stiffness_is_that_of_the_punch_of_its_radius,
    ),
    "1.1419 for 1.1523 under the square punch": (
        (closed_forms, "SQUARE_PUNCH", 1.012 * 2 / math.sqrt(math.pi)),
        test_convergence_rates.test_square_punch_at_first_order,
    ),
    "pi lost in the pressure that closes a wave": (
        (closed_forms, "westergaard_full_pressure", scaled(closed_forms.westergaard_full_pressure, 1 / np.pi)),
        test_convergence_rates.test_wave_pressure_at_first_order,
    ),
    "level of the rolling force for that of the line trace": (
        (closed_forms, "line_trace_ratio", level_of_the_rolling_force),
        test_geike_mapping.test_line_trace_of_a_wide_power_law,
    ),
    "Persson without the root of two": (
        (closed_forms, "persson_contact_fraction", half_of_the_slope),
        test_closed_forms.test_persson,
    ),
    "factor 2 lost in the periodic symbol": (
        (kernel, "periodic_symbol", scaled(kernel.periodic_symbol, 0.5)),
        test_convergence_rates.test_wave_pressure_at_first_order,
    ),
    "factor 2 lost in the periodic symbol, against the dense twin": (
        (kernel, "periodic_symbol", scaled(kernel.periodic_symbol, 0.5)),
        test_operator_against_dense_twin.test_displacement,
    ),
    "no padding": (
        (halfspace, "_doubled", lambda points: points + points % 2),
        test_operator_against_dense_twin.test_displacement,
    ),
    # 2n - 2 points would do, since the kernel is even: the two farthest distances may share a point
    "padding two points short": (
        (halfspace, "_doubled", lambda points: max(points + points % 2, 2 * points - 4)),
        test_operator_against_dense_twin.test_displacement,
    ),
    "no padding, seen in a contact": (
        (halfspace, "_doubled", lambda points: points + points % 2),
        test_convergence_rates.test_a_wider_grid_changes_nothing,
    ),
    "kernel shifted by half a cell": (
        (kernel, "love_table", shifted_table),
        test_operator_against_dense_twin.test_displacement,
    ),
    "half of the corner function": (
        (kernel, "corner", one_sided_corner),
        test_operator_against_dense_twin.test_love_against_quadrature,
    ),
    "surface shifted by half a cell": (
        (surface, "_half_a_cell", lambda mode, points: np.ones(mode.shape)),
        test_drawn_roughness.test_a_finer_grid_draws_the_same_roughness,
    ),
    "spectrum of a surface without its mirror images": (
        (surface, "_hermitian", lambda wave, amplitudes: wave),
        test_drawn_roughness.test_surface_moments_are_the_sums_over_its_waves,
    ),
    "one-sided spectrum taken for two-sided": (
        (bem3d, "rough_surface", scaled(bem3d.rough_surface, np.sqrt(2))),
        test_drawn_roughness.test_surface_moments_are_the_sums_over_its_waves,
    ),
    "(14.9) as printed": (
        (profile_module, "_resolved", printed_formula),
        test_drawn_roughness.test_profile_moments_are_the_sums_over_its_waves,
    ),
    "line trace for Geike": (
        (mdr.SelfAffine, "c1d", mdr.SelfAffine.line),
        functools.partial(test_geike_mapping.test_moments_of_power_laws_are_kept, n=2),
    ),
    "q C_2D for Geike": (
        (mdr, "geike", scaled(mdr.geike, 1 / np.pi)),
        functools.partial(test_geike_mapping.test_moments_of_arbitrary_spectra_are_kept, n=0),
    ),
    "2 pi q C_2D for Geike": (
        (mdr, "geike", scaled(mdr.geike, 2.0)),
        functools.partial(test_geike_mapping.test_moments_of_arbitrary_spectra_are_kept, n=0),
    ),
    "x^2 / 2R in one dimension": (
        (mdr, "sphere_profile", half_of_the_parabola),
        functools.partial(
            test_springs_against_brute_force.test_springs_under_a_parabola_tend_to_the_sphere_at_second_order, 0.1
        ),
    ),
    "1.1523 L for L": (
        (mdr, "load_curve", stretched_curve),
        test_springs_against_brute_force.test_force_and_stiffness_at_an_approach,
    ),
    "stiffness of a contact grown by a cell": (
        (contact, "solve_fixed_area", grown_contact),
        test_contact_properties.test_stiffness_is_that_of_the_dense_contact,
    ),
    "line trace for Geike in Fig. 14.1": (
        (PunchRoughness, "spectrum", property(line_for_geike)),
        functools.partial(test_fractal_punch.test_profiles_are_those_of_geikes_spectrum, 1.0),
    ),
    "half of the force in Fig. 14.1": (
        (rough_punch, "bem3d", in_the_case(bem3d, {"indent": half_of_the_force})),
        test_fractal_punch.test_surfaces_are_pressed_as_they_stand,
    ),
    "surfaces pressed upside down": (
        (rough_punch, "bem3d", in_the_case(bem3d, {"indent": upside_down})),
        test_fractal_punch.test_surfaces_are_pressed_as_they_stand,
    ),
    "every profile drawn twice": (
        (rough_punch, "generator", twice_the_same),
        test_fractal_punch.test_no_realisation_is_counted_twice,
    ),
    "no grid error": (
        (fractal_punch_decades.DecadeComparison, "left", 0.0),
        test_fractal_punch.test_a_change_of_the_grid_is_extrapolated_and_leaves_its_error_bar,
    ),
    "no extrapolation": (
        (fractal_punch_decades.DecadeComparison, "correction", 0.0),
        test_fractal_punch.test_a_change_of_the_grid_is_extrapolated_and_leaves_its_error_bar,
    ),
    "a third of the interval": (
        (statistics.Estimate, "half_width", property(lambda estimate: estimate.error / 1.5)),
        functools.partial(test_fractal_punch.test_verdicts_on_known_deviations, 1.15, 60, Verdict.UNDECIDED),
    ),
    "a third of the interval, seen by its coverage": (
        (statistics.Estimate, "half_width", property(lambda estimate: estimate.error / 1.5)),
        functools.partial(
            test_evidence.test_intervals_cover_the_truth,
            60,
            statistics.log_relative_deviation,
            test_evidence.one_level,
            "normal",
        ),
    ),
    "every level resampled for itself": (
        (test_evidence, "sample", each_level_for_itself),
        test_evidence.test_levels_of_a_realisation_are_resampled_together,
    ),
    "rms of the ensemble for that of each": (
        (PunchRoughness, "_normalised", lambda roughness, height: height),
        functools.partial(test_rough_punches.test_heights_are_normalised_as_they_say, "bem3d", 1.0),
    ),
    "rms of each for that of the ensemble": (
        (PunchRoughness, "_normalised", lambda roughness, height: height * roughness.height / height.std()),
        functools.partial(test_rough_punches.test_heights_are_normalised_as_they_say, "mdr", 1.0),
    ),
    "mean gap of a half-space that does not yield": (
        (test_fractal_punch, "press_surface", gap_of_the_rigid_surface),
        test_fractal_punch.test_surfaces_are_pressed_as_they_stand,
    ),
    "interface and half-space in series": (
        (mdr_limits.Layer, "log_kappa", lambda layer, stiffness: -np.log(1 / stiffness - 1 / layer.flat)),
        functools.partial(test_rough_punches.test_the_exponent_of_the_interface_is_found_behind_the_punch, 1.0),
    ),
    "the punch taken for its interface": (
        (mdr_limits.Layer, "log_kappa", lambda layer, stiffness: np.log(stiffness)),
        functools.partial(test_rough_punches.test_the_exponent_of_the_interface_is_found_behind_the_punch, 1.0),
    ),
    "phases on half of the circle": (
        (profile_module, "_random_waves", half_a_circle),
        test_drawn_roughness.test_profiles_look_the_same_up_and_down,
    ),
    "a residual that forgives": (
        ((window_solve, projected_cg), "residual", forgiving_residual),
        test_convergence_rates.test_a_wider_grid_changes_nothing,
    ),
    "a residual blind to penetration": (
        ((window_solve, projected_cg), "residual", blind_to_penetration),
        test_contact_properties.test_complementarity,
    ),
    "a window that cuts cells off": (
        (window_solve, "smallest_box", half_a_window),
        functools.partial(
            test_windows_and_starts.test_contacts_anywhere_on_the_grid, [(8, 8, 0.0), (110, 70, 0.2)], 1000.0
        ),
    ),
    "stiffness to first order in the residual": (
        (bem3d, "solve_fixed_area", sum_of_the_pressure),
        test_load_paths.test_error_of_the_stiffness_is_the_residual_squared,
    ),
    "Geike for the line trace in rolling": (
        (mdr.SelfAffine, "line", mdr.SelfAffine.c1d),
        functools.partial(test_rolling_theory.test_small_wheels_are_fed_the_line_trace, 0.7),
    ),
    "springs that roll fed by Geike": (
        (feed, "_across", geike_for_rolling),
        functools.partial(
            test_rolling_theory.test_springs_that_are_fed_for_rolling_have_the_level_of_the_half_space, 0.7, 1.0
        ),
    ),
    "springs that roll fed by the line trace": (
        (feed, "_across", line_for_rolling),
        functools.partial(test_rolling_theory.test_large_wheels_are_fed_less_than_geike, 0.7),
    ),
    "factor 4 lost in (14.12)": (
        (rolling_theory, "response", scaled(rolling_theory.response, 0.5)),
        test_rolling_springs.test_spectrum_of_the_linear_force_is_14_12,
    ),
    "factor 4 lost in the spectrum of the half-space": (
        (rolling_theory, "response", scaled(rolling_theory.response, 0.5)),
        functools.partial(test_rolling_theory.test_force_spectrum_by_adaptive_quadrature, 0.7, 1.7),
    ),
    "factor 2 lost in linear theory, seen by boundary elements": (
        (test_rolling_contact, "response", scaled(rolling_theory.response, 0.5)),
        functools.partial(test_rolling_contact.test_ridges_across_the_track_tend_to_the_filter, 1),
    ),
    "a for 2a under the wheel": (
        (wheel_on_springs.SpringTrack, "reach", half_the_contact),
        test_rolling_springs.test_full_contact_tends_to_the_filter_at_second_order,
    ),
    "x^2 / 2R under the wheel": (
        (wheel_on_springs.SpringTrack, "wheel", scaled(wheel_on_springs.SpringTrack.wheel, 0.5)),
        test_rolling_springs.test_force_is_the_sum_over_all_springs,
    ),
    "springs that pull under the smooth wheel": (
        (wheel_on_springs, "_one_sided", springs_that_pull),
        test_rolling_springs.test_one_sided_force_leaves_the_linear_one_at_second_order,
    ),
    "springs that pull wherever they are in doubt": (
        (wheel_on_springs, "np", in_numpy({"maximum": springs_that_pull_at_the_edge})),
        test_rolling_springs.test_force_is_the_sum_over_all_springs,
    ),
    "one-sided spectrum of the force": (
        (spectra.Waves, "spectrum", property(one_sided_spectrum)),
        test_rolling_springs.test_variance_of_the_force_is_that_of_its_spectrum,
    ),
    "one-sided spectrum of a track": (
        (spectra.Waves, "spectrum", property(one_sided_spectrum)),
        test_rolling_theory.test_spectra_of_profiles_are_the_ones_they_are_drawn_from,
    ),
    "x^2 / R under the sphere": (
        (Track, "sphere", scaled(Track.sphere, 2.0)),
        functools.partial(test_rolling_contact.test_each_position_is_that_of_a_cold_solve, "smooth", "approach"),
    ),
    "the wheel half a cell ahead": (
        (Track, "along", half_a_cell_ahead),
        functools.partial(test_rolling_contact.test_each_position_is_that_of_a_cold_solve, "smooth", "approach"),
    ),
    "the wheel half a cell aside": (
        (Track, "across", half_a_cell_aside),
        functools.partial(test_rolling_contact.test_each_position_is_that_of_a_cold_solve, "smooth", "approach"),
    ),
    "a frame that is trusted": (
        (Frame, "outside", lambda *_: None),
        functools.partial(
            test_rolling_contact.test_a_bump_far_ahead_is_touched_before_the_frame_has_reached_it, "approach", 0.0
        ),
    ),
    "a bound four times as large": (
        (Frame, "_moments", four_times_the_force),
        test_rolling_contact.test_cells_that_a_frame_rules_out_are_open,
    ),
    "a residual of rolling that is not looked at": (
        (wheel_on_strip, "residual", lambda *_: 0.0),
        functools.partial(
            test_rolling_contact.test_pressures_solve_the_contact_on_all_of_the_strip, "as rough as deep"
        ),
    ),
    "x^2 / 2R under many wheels": (
        (mdr.RollingEnsemble, "_profile", scaled(mdr.RollingEnsemble._profile, 0.5)),
        functools.partial(test_wheels_on_springs.test_force_to_1e_12_of_the_smooth_wheel, 7.3, 0.1),
    ),
    "many wheels half a cell ahead": (
        (mdr.RollingEnsemble, "_profile", profile_half_a_cell_ahead),
        test_wheels_on_springs.test_a_wheel_of_equal_springs_rolls_the_same_in_either_direction,
    ),
    "many wheels a cell ahead": (
        (mdr.RollingEnsemble, "force", a_place_late),
        functools.partial(test_wheels_on_springs.test_force_to_1e_12_of_the_smooth_wheel, 7.3, 0.1),
    ),
    "springs that pull under many wheels": (
        (wheels_in_step, "np", in_numpy({"maximum": springs_that_pull_in_step})),
        functools.partial(test_wheels_on_springs.test_force_to_1e_12_of_the_smooth_wheel, 30.0, 0.1),
    ),
    "springs that pull on a wheel in the air": (
        (wheels_in_step, "np", in_numpy({"maximum": springs_that_pull_in_step})),
        functools.partial(test_wheels_on_springs.test_far_above_the_track_there_is_no_force, -50.0),
    ),
    "E for E* under many wheels": (
        (mdr.RollingEnsemble, "force", scaled(force_in_step, E_FOR_E_STAR)),
        functools.partial(test_wheels_on_springs.test_force_to_1e_12_of_the_smooth_wheel, 7.3, 0.1),
    ),
    "E for E* in the force, not in the approach at rest": (
        (mdr.RollingEnsemble, "force", scaled(force_in_step, E_FOR_E_STAR)),
        test_wheel_motion.test_at_rest_the_wheel_bears_its_load,
    ),
    "sums that round": (
        (wheels_in_step, "np", in_numpy({"rint": not_rounded})),
        test_wheels_on_springs.test_a_wheel_feels_the_same_force_to_the_last_bit_whoever_rolls_beside_it,
    ),
    "load forgotten in the equation of motion": (
        (test_wheel_motion, "simulate", without_load),
        functools.partial(
            test_wheel_motion.test_on_a_smooth_track_a_wheel_stays_at_rest,
            contact_laws.HertzLaw(test_wheel_motion.WHEEL, 2),
            4 * test_wheel_motion.ULP,
        ),
    ),
    "explicit Euler where nothing is asked for": (
        (wheel_in_motion.simulate, "__kwdefaults__", by_another(integrators.EXPLICIT_EULER)),
        functools.partial(test_wheel_motion.test_time_reversal, 0.05, 0.0),
    ),
    "symplectic Euler where nothing is asked for": (
        (wheel_in_motion.simulate, "__kwdefaults__", by_another(integrators.SYMPLECTIC_EULER)),
        functools.partial(test_wheel_motion.test_free_vibration_of_a_linear_contact_is_the_exact_one_of_leapfrog, 0.3),
    ),
    "the step of a cell for that of two in Runge and Kutta": (
        (
            test_wheel_motion,
            "SCHEMES",
            {**test_wheel_motion.SCHEMES, "Runge-Kutta": half_a_step(integrators.RUNGE_KUTTA)},
        ),
        functools.partial(test_wheel_motion.test_order_of_a_scheme_on_a_free_vibration, "Runge-Kutta"),
    ),
    "velocity Verlet with the force of the beginning alone": (
        (
            test_wheel_motion,
            "SCHEMES",
            {
                **test_wheel_motion.SCHEMES,
                "velocity Verlet": dataclasses.replace(integrators.VELOCITY_VERLET, march=old_force_in_the_velocity),
            },
        ),
        functools.partial(test_wheel_motion.test_symplectic_schemes_keep_the_energy, "velocity Verlet", 1.5),
    ),
    "factor 4 lost in the leakage": (
        (wheel_theory, "leakage", scaled(wheel_theory.leakage, 4.0)),
        functools.partial(test_wheel_motion.test_leakage_is_the_spectrum_of_a_ramp, 64),
    ),
    "factor 4 lost in the leakage, seen in a motion": (
        (wheel_theory, "leakage", scaled(wheel_theory.leakage, 4.0)),
        test_wheel_motion.test_a_motion_that_repeats_itself_does_not_leak,
    ),
    "a period a thousandth too long": (
        (wheel_theory, "hertz_period", scaled(wheel_theory.hertz_period, 1.001)),
        functools.partial(test_wheel_motion.test_period_of_free_vibration_by_small_steps, 1.5),
    ),
    "half of the longest step": (
        (free_vibration, "amplification", half_of_the_limit),
        functools.partial(test_wheel_stability.test_limits_are_those_of_the_eigenvalue, integrators.VELOCITY_VERLET),
    ),
    "coarse springs taken for a continuum": (
        (rough_springs, "linear_response", of_a_continuum),
        functools.partial(test_wheel_stability.test_linear_spacing_holds_for_other_tracks, 0),
    ),
    "a period without lift-off": (
        (wheel_theory, "_other_turning_point", held_at_the_edge),
        functools.partial(test_wheel_motion.test_period_of_free_vibration_by_small_steps, 2.2),
    ),
    "omega / omega_0 for omega_0 / omega": (
        (wheel_theory, "acceleration_over_force", inverted),
        test_wheel_motion.test_acceleration_over_force_is_that_of_a_steady_motion,
    ),
    "factor 2 pi lost over frequency": (
        (wheel_theory, "over_frequency", scaled(wheel_theory.over_frequency, 1 / (2 * np.pi))),
        functools.partial(test_wheel_motion.test_spectra_over_frequency_are_those_of_the_record, 20.0),
    ),
    "one-sided spectrum over frequency": (
        (wheel_theory, "over_frequency", scaled(wheel_theory.over_frequency, 2.0)),
        functools.partial(test_wheel_motion.test_spectra_over_frequency_are_those_of_the_record, 20.0),
    ),
    "a jump that is not there": (
        (wheel_in_motion.Motion, "jump", property(without_a_jump)),
        functools.partial(test_wheel_motion.test_the_change_of_velocity_is_the_mean_acceleration, "linear"),
    ),
    "shooting without a correction": (
        (test_wheel_motion, "repeating", one_copy),
        test_wheel_motion.test_the_linear_motion_that_repeats_itself_is_the_steady_one,
    ),
    "a steady motion in continuous time": (
        (contact_laws.Linear, "steady", softer_steady),
        functools.partial(
            test_wheel_motion.test_the_steady_motion_is_that_of_a_dense_solve_and_repeats_itself, 50, 0.1
        ),
    ),
    "factor 2 lost in linear theory, seen by boundary elements in the loop": (
        (test_wheel_motion, "linear_force", scaled(test_wheel_motion.linear_force, 0.5)),
        functools.partial(
            test_wheel_motion.test_boundary_elements_in_the_loop_follow_linear_theory_in_three_dimensions, 6
        ),
    ),
    "dt for dt^2 in (14.17)": (
        (records, "spectra", dt_for_its_square),
        functools.partial(test_wheel_spectra.test_spectra_by_slow_sums, 31, "none"),
    ),
    "dt for dt^2 in (14.17), seen by Parseval": (
        (records, "spectra", dt_for_its_square),
        test_wheel_spectra.test_parseval_without_window,
    ),
    "one-sided spectrum of a record": (
        (records, "spectra", one_sided_record),
        test_wheel_spectra.test_parseval_without_window,
    ),
    "Hann without its mean square": (
        (records, "spectra", hann_as_it_is),
        functools.partial(test_wheel_spectra.test_parseval_of_hann_in_expectation, 24),
    ),
    "half a line on in the peak": (
        (regions, "peak", half_a_line_on),
        functools.partial(test_wheel_spectra.test_peak_of_a_tone_between_lines, 30.5),
    ),
    "slope of bands that are not levelled": (
        (regions, "slope", slope_of_what_is_steep),
        functools.partial(test_wheel_spectra.test_slope_under_an_oscillation, 0.7),
    ),
    "a wheel of half of its circumference": (
        (wheel_scene.WheelScene, "circumference_points", property(half_of_the_circumference)),
        test_wheel_cases.test_the_roughness_of_a_wheel_repeats_after_its_circumference,
    ),
    "a closed track taken as open": (
        (wheel_ensemble.WheelEnsemble, "places", property(always_open)),
        functools.partial(
            test_wheel_cases.test_closed_tracks_hold_whole_turns_and_steady_ones_a_half_more, "steady", 0.5, 0.16
        ),
    ),
    "Geike for the rolling feed of springs": (
        (wheel_ensemble.WheelEnsemble, "heights", by_geike),
        test_wheel_cases.test_rolling_feed_has_long_waves_and_geike_has_none,
    ),
    "no resonator in the linear spectrum": (
        (wheel_theory, "acceleration_over_force", without_resonance),
        test_wheel_cases.test_the_linear_contact_has_its_closed_form_wave_by_wave,
    ),
    "Geike for the half-space under a wheel": (
        (rolling_question, "force_spectrum_3d", by_the_filter_of_one_dimension),
        test_ladder.test_the_expected_levels_are_integrals_of_the_spectrum,
    ),
    "a factor 2 lost in the variance of the force": (
        (rolling_question, "force_variance", scaled(rolling_theory.force_variance, 0.5)),
        test_ladder.test_one_dimension_has_the_variance_of_the_force_and_not_its_levels,
    ),
    "no resonator between force and acceleration": (
        (rolling_question.RollingQuantity, "transfer", without_a_resonator),
        test_ladder.test_the_transfer_of_a_wheel_is_that_of_its_resonator,
    ),
    "one standard error for a 95 % interval": (
        (ladder_of_models, "mean_error", one_standard_error),
        test_ladder.test_the_error_of_a_mean_covers_it_in_95_of_100,
    ),
    "twice the separation of a rough face": (
        (closed_forms, "INTERFACE", 0.96),
        functools.partial(test_ladder.test_the_law_of_interfaces_holds_as_it_claims, 1.0),
    ),
    "one panel of a quadrature over decades": (
        (rolling_question, "PANEL", 1e9),
        functools.partial(test_ladder.test_the_whole_is_the_root_of_the_sum_of_its_bands, False),
    ),
    "measured heights at points, not over cells": (
        (rolled, "_resampled", at_points),
        test_ladder.test_short_waves_of_a_measured_track_are_no_longer_ones,
    ),
    "other waves on every grid of the ladder": (
        (pressed_heights, "_drawn", other_waves_on_every_grid),
        test_ladder.test_waves_that_a_grid_cannot_carry_are_left_out_and_no_others_changed,
    ),
    "an answer that stands on one cell": (
        (rungs_pressed_grids, "too_few", lambda *_: ""),
        test_claims.test_few_springs_and_few_cells_are_no_answer,
    ),
    "grids that do not converge with the error bar of those that do": (
        (test_claims, "grid_error", the_last_change_alone),
        test_claims.test_grids_that_do_not_converge_have_no_error_bar,
    ),
    "the error of a grid without that of its sample": (
        (ladder_of_models, "mean_error", lambda _: 0.0),
        test_claims.test_grids_that_do_not_converge_have_no_error_bar,
    ),
    "a table of errors held constant beyond its end": (
        (rungs_pressed, "outside", lambda *_: ""),
        functools.partial(test_claims.test_light_loads_have_no_answer_unless_it_is_that_of_the_summits, 1e-5, 8),
    ),
    "a linear filter for waves shorter than the contact": (
        (rungs_rolling, "outside", lambda *_: ""),
        functools.partial(
            test_claims.test_waves_shorter_than_the_contact_are_left_to_boundary_elements, "force-rms", 0.15
        ),
    ),
    "measured heights over half of their mean square": (
        (measured, "_spectrum", half_of_the_level),
        test_measured_heights.test_the_spectrum_has_the_height,
    ),
    "heights behind a mask": (
        (measured, "_numbers", behind_the_mask),
        test_measured_heights.test_points_without_data_are_refused,
    ),
    "a surface in micrometres taken for one in metres": (
        (measured, "_metres", lambda surface: 1.0),
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
        (steadiness, "MOST_FORCE", math.inf),
        functools.partial(test_steadiness.test_flight_is_foretold, 0.33, 30e-3, "by linear theory"),
    ),
    "factor 2 pi lost over frequency, seen in an ensemble": (
        (wheel_theory, "over_frequency", scaled(wheel_theory.over_frequency, 1 / (2 * np.pi))),
        test_wheel_cases.test_the_linear_contact_has_its_closed_form_wave_by_wave,
    ),
    "springs that say nothing of short waves": (
        (profile_module, "doubts_of_waves", lambda *_: ()),
        functools.partial(test_doubts_of_springs.test_short_waves, 25, True),
    ),
    "few springs that say nothing": (
        (foundation, "doubts_of_load", lambda *_: ()),
        functools.partial(test_doubts_of_springs.test_few_springs_in_contact, 4, True),
    ),
    "ends of a linear contact that move twice as far": (
        (wheel_on_springs, "doubts_of_linearity", ends_that_move_twice_as_far),
        functools.partial(test_doubts_of_springs.test_the_ends_of_a_linear_contact_move_as_is_said, "linear", None),
    ),
    "a limit read on its good side": (
        (limits.Sweep, "beyond", limits.Sweep.within),
        functools.partial(test_limits.test_crossings_of_a_power_law, "above"),
    ),
    "factor 4 lost over a stretched surface": (
        (limits_mdr, "response", scaled(rolling_theory.response, 0.5)),
        test_limits.test_a_stretched_surface_by_another_quadrature,
    ),
    "factor 2 lost in the periodic symbol, seen by images": (
        (kernel, "periodic_symbol", scaled(kernel.periodic_symbol, 0.5)),
        test_limits.test_images_err_as_the_lattice_sum_says,
    ),
    "nothing left open by a reference": (
        (test_precision.Point, "rank", property(lambda point: point.error + point.half_width)),
        test_precision.test_the_front_is_what_nothing_beats_and_ends_in_the_band,
    ),
    "errors ranked without their intervals": (
        (test_precision.Point, "rank", property(lambda point: max(point.error, point.band))),
        test_precision.test_errors_are_ranked_by_their_upper_ends,
    ),
    "the same surfaces taken for others": (
        (test_precision, "error", as_if_alone),
        test_precision.test_what_realisations_have_of_their_own_drops_out_of_paired_errors,
    ),
    "first order for second in an extrapolation": (
        (precision_error.MethodAnswers, "log", at_first_order),
        functools.partial(test_precision.test_two_grids_of_a_power_law_are_extrapolated_to_the_truth, 2.0),
    ),
    "decibels of an amplitude for those of a power": (
        (precision.Quantity, "distance", scaled(precision.Quantity.distance, 2.0)),
        test_precision.test_levels_differ_by_the_root_mean_square_of_decibels,
    ),
    "an approach under a wave without its logarithm": (
        (test_precision, "westergaard_approach", without_its_logarithm),
        test_precision.test_the_approach_under_a_wave_is_the_sum_of_its_compliances,
    ),
    "a filtered acceleration in continuous time": (
        (precision_wheel, "transfer", in_continuous_time),
        test_precision.test_the_filtered_acceleration_is_the_motion_that_repeats_itself,
    ),
    "a spike that nobody rolls over": (
        (Near, "beyond", lambda _, offsets: np.zeros(offsets.shape, dtype=bool)),
        test_rolling_springs.test_a_light_wheel_over_a_spike_of_a_thousand_times_the_roughness,
    ),
    "a light wheel on its highest spring alone": (
        (wheel_on_springs, "by_sorting", on_the_highest_spring_alone),
        functools.partial(test_rolling_springs.test_a_light_wheel_over_a_spike, 0.1),
    ),
    "a modulus in gigapascals that nobody asks about": (
        (contact, "doubts_of_units", lambda **_: ()),
        test_doubts.test_a_modulus_in_gigapascals_is_asked_about,
    ),
    "a contact wider than its sphere that nobody asks about": (
        (foundation, "doubts_of_units", lambda **_: ()),
        functools.partial(test_doubts_of_springs.test_units_of_a_sphere_are_asked_about, 1.0, 1.21, 1),
    ),
    "a gap that the caller may still write to": (
        (problem, "kept", lambda values: values),
        test_read_only_results.test_an_older_view_of_the_gap_changes_no_problem,
    ),
    "one tail of Student's t": (
        (statistics.Estimate, "half_width", property(of_one_tail)),
        functools.partial(test_error_bars.test_the_interval_of_a_mean_is_students, 2),
    ),
    "two standard errors of a sample of three": (
        (statistics.Estimate, "half_width", property(two_standard_errors)),
        functools.partial(test_error_bars.test_variance_and_mean_of_the_rolling_force_cover_their_truth, 3),
    ),
    "a whole interval for its half": (
        (statistics.Estimate, "half_width", property(ends_apart)),
        functools.partial(test_error_bars.test_the_interval_of_a_mean_is_students, 3),
    ),
    "a bootstrap that forgets n - 1": (
        (statistics.Sample, "estimate", scatter_of_the_sample_itself),
        functools.partial(test_error_bars.test_the_bootstrap_has_the_standard_error_of_a_mean, 3),
    ),
    "a degree of freedom for each mean too many": (
        (test_error_bars, "mean_of", of_all_samples),
        functools.partial(test_error_bars.test_the_interval_of_a_mean_of_estimates, (1.0, 0.05, 0.05)),
    ),
    "half of the way to cells of no size": (
        (test_error_bars, "extrapolated", half_of_the_way),
        test_error_bars.test_what_extrapolation_leaves_open_is_half_of_its_way_and_the_interval_of_all_of_it,
    ),
    "the finer grid taken for the coarser": (
        (fractal_punch_decades, "pairs", fine_before_coarse),
        test_error_bars.test_grids_are_paired_with_their_neighbours,
    ),
    "sample and grid exchanged": (
        (fractal_punch_decades, "Number", sample_for_grid),
        test_error_bars.test_the_grid_interval_of_fig_14_1,
    ),
    "decibels of an amplitude for those of a power, in rolling": (
        (rolling_evidence, "POWER", statistics.DECIBEL),
        test_error_bars.test_levels_of_rolling_are_powers_in_decibels,
    ),
    "an error that luck has made small, and its interval": (
        (precision_error, "math", types.SimpleNamespace(**{**vars(math), "copysign": lambda *_: 1.0})),
        functools.partial(
            test_selection.test_an_answer_that_luck_has_put_on_its_reference_scatters_as_much, test_selection.K, True
        ),
    ),
    "a line at the upper edge of a band counted in it": (
        (spectra.Bands, "sums", both_edges),
        test_rules_by_loops.test_a_band_holds_its_lower_edge_and_not_its_upper,
    ),
    "accepted at ten times its tolerance": (
        (window_solve.IterationState, "judge", at_ten_times_the_tolerance),
        functools.partial(test_accepted_solves.test_the_tolerance_is_the_one_that_was_asked_for, 9.9e-4, None),
    ),
    "accepted at ten times its tolerance, seen by a solve": (
        (window_solve.IterationState, "judge", at_ten_times_the_tolerance),
        functools.partial(test_accepted_solves.test_a_solve_that_is_cut_short_says_so, "solve", 3),
    ),
    "the iteration limit taken for convergence": (
        (contact.Contact, "converged", property(whoever_has_ended)),
        functools.partial(test_accepted_solves.test_a_solve_that_is_cut_short_says_so, "solve", 3),
    ),
    "what is lost is not told": (
        (fractal_punch, "lost", lambda *_: ()),
        functools.partial(test_flags.test_what_is_lost_is_a_line_of_the_result, "fractal punch, finer grid"),
    ),
    "the referee's surfaces those of who is tested": (
        (ladder_on_trial, "OTHER_SEED", 0),
        test_flags.test_the_referee_of_the_ladder_has_surfaces_of_its_own,
    ),
    "another model's line under a label": (
        (rolling_figure, "SPRINGS", "linear 1D"),
        test_figure_lines.test_lines_of_rolling,
    ),
    "a printed decibel halved": (
        (fractal_punch_decades, "DECIBEL", 2 * statistics.DECIBEL),
        test_printed.test_verdicts_of_fig_14_1_are_told_in_per_cent,
    ),
    "two signs of verdicts exchanged": (
        (build, "SYMBOL", {"agree": "≠", "differ": "✓", "undecided": "?"}),
        test_printed.test_rows_of_the_page_are_their_numbers,
    ),
    "undecided read as agree": (
        (test_printed, "claim", unless_it_differs),
        test_printed.test_a_claim_holds_with_all_of_its_numbers,
    ),
    "a series of grids without the noise of its last change": (
        (test_claims, "grid_error", without_the_noise_of_its_series),
        functools.partial(test_claims.test_what_a_grid_leaves_is_the_rest_of_its_series_and_of_its_sample, 0.75, 3.0),
    ),
    "quiet bands in the error of loud ones": (
        (test_claims, "mean_error", mean_over_bands),
        test_claims.test_the_error_over_bands_is_their_root_mean_square,
    ),
    "coarser grids on other surfaces": (
        (rungs_pressed_grids.IndentationOnGrid, "_pressed", another_surface_on_coarser_grids),
        test_claims.test_grids_are_compared_on_the_same_surfaces,
    ),
    "one surface for all": (
        (pressed_heights, "generator", the_same_every_time),
        test_claims.test_realisations_are_others,
    ),
    "one strip and one track for all": (
        (rolled, "generator", the_same_every_time),
        test_claims.test_realisations_are_others,
    ),
    "a half-space of unit modulus": (
        (rungs_pressed_grids, "bem3d", types.SimpleNamespace(**{**vars(bem3d), "HalfSpace": of_unit_modulus})),
        functools.partial(test_claims.test_no_stiffness_depends_on_units, test_claims.ROUGH_BODIES[1]),
    ),
    "one measured face for the mean of all": (
        (rungs_pressed, "SCATTER", 0.0),
        test_claims.test_one_measured_face_is_not_the_mean_of_all,
    ),
    "a sphere cut off at its smooth approach": (
        (pressed_heights, "DEEPEST", 0.0),
        test_claims.test_the_side_of_a_sphere_holds_what_it_may_touch,
    ),
    "one cell in contact of a light punch": (
        (pressed_heights, "CONTACT", 1),
        test_claims.test_grids_are_as_fine_in_any_unit,
    ),
    "the rule of the rms for levels in bands": (
        (rungs_rolling, "LINEAR_BANDS", rungs_rolling.LINEAR_RMS),
        functools.partial(test_claims.test_claims_of_cheap_models_of_rolling, *test_claims.RULES[1]),
    ),
    "what the finer of two grids leaves, for the coarser": (
        (rungs_rolling, "OF_COARSE", rungs_rolling.OF_FINE),
        functools.partial(test_claims.test_two_grids_of_second_order_leave_what_they_miss, finest=False),
    ),
    "a grid beside another on another strip": (
        (rungs_rolling.RollingOnGrid, "_rolled", another_strip_beside),
        functools.partial(test_claims.test_two_grids_of_second_order_leave_what_they_miss, finest=True),
    ),
    "Geike's spectrum for springs that roll": (
        (rolled, "rolling_feed", geike_for_what_rolls),
        functools.partial(
            test_claims.test_springs_on_low_roughness_are_linear_theory_in_the_mean_over_bands, "force-spectrum"
        ),
    ),
    "decibels of a power for those of a level": (
        (compare, "math", with_math(log10=lambda value: math.log10(value) / 2)),
        functools.partial(test_ladder.test_bands_are_told_with_wavenumber_frequency_and_level, "force-spectrum", "N"),
    ),
    "radians in a second told as hertz": (
        (compare, "math", with_math(pi=0.5)),
        functools.partial(test_ladder.test_bands_are_told_with_wavenumber_frequency_and_level, "acceleration", "m/s²"),
    ),
    "the rougher of wheel and rail for both": (
        (steadiness, "math", with_math(hypot=lambda *heights: max(heights))),
        test_steadiness.test_rail_and_wheel_are_rough_together,
    ),
    "results of other libraries": (
        (ensemble, "LIBRARIES", ("numpy",)),
        functools.partial(test_ensemble.test_another_version_of_a_library_is_another_version_of_the_numerics, "scipy"),
    ),
}


def parametrized(test) -> Iterator[tuple[list[str], list[tuple]]]:
    """Names of arguments, and the rows of values with which pytest runs a test, mark by mark."""
    for mark in getattr(test, "pytestmark", ()):
        if mark.name == "parametrize":
            names, rows = mark.args
            names = names.replace(" ", "").split(",") if isinstance(names, str) else list(names)
            yield names, [tuple(row) if len(names) > 1 else (row,) for row in rows]


def is_in_the_suite(named_test):
    """Whether pytest runs a named test, with these arguments and without a fault: there it must pass."""
    test = getattr(named_test, "func", named_test)
    given = inspect.signature(test).bind(*getattr(named_test, "args", ()), **getattr(named_test, "keywords", {}))
    left = dict(given.arguments)
    for names, rows in parametrized(test):
        values = tuple(left.pop(name) for name in names)
        if values not in rows:
            return False
    return not left and getattr(sys.modules[test.__module__], test.__name__) is test


def test_named_tests_are_those_of_the_suite():
    assert [fault for fault, (_, named_test) in FAULTS.items() if not is_in_the_suite(named_test)] == []


@pytest.mark.parametrize("fault", FAULTS)
def test_a_named_test_catches(fault, monkeypatch):
    (places, name, wrong), named_test = FAULTS[fault]
    for place in places if isinstance(places, tuple) else (places,):
        monkeypatch.setattr(place, name, wrong)
    with pytest.raises(AssertionError):
        named_test()
