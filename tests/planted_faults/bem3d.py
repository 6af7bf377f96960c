"""Faults planted in what `tests/bem3d` looks at: where, what is wrong there, and the test that must catch it."""

import dataclasses
import math
import os
from collections import deque
from concurrent.futures import wait
from functools import partial

import numpy as np
import scipy

import bem3d
from bem3d import (
    blocked_convolution,
    contact,
    convolution,
    diagnostics,
    far_field,
    few_cells,
    halfspace,
    kernel,
    problem,
    projected_cg,
    rolling_frame,
    threads,
    window,
    window_solve,
)
from bem3d import rolling_solve as wheel_on_strip
from bem3d.rolling_frame import Frame, Track
from bem3d.smooth_wheel import smooth_contact
from bem3d.tangent_stiffness import solve_fixed_area
from bem3d.transverse_profile import equivalent_radius
from tests import test_read_only_results
from tests.bem3d import test_accepted_solves as accepted
from tests.bem3d import test_contact_properties as properties
from tests.bem3d import test_convergence_rates as rates
from tests.bem3d import test_elliptic_wheels as ellipses
from tests.bem3d import test_few_cells as of_few_cells
from tests.bem3d import test_interfaces as interfaces
from tests.bem3d import test_load_paths as paths
from tests.bem3d import test_operator_against_dense_twin as dense_twin
from tests.bem3d import test_rolling_contact as rolled
from tests.bem3d import test_rolling_frame as frames
from tests.bem3d import test_second_level as levels
from tests.bem3d import test_threads as threaded
from tests.bem3d import test_transverse_profile as profiles
from tests.bem3d import test_warnings as doubts
from tests.bem3d import test_windows_and_starts as windows
from tests.planted_faults.wrong import E_FOR_E_STAR, Fault, Times
from validation.theory import closed_forms

multiply, share = blocked_convolution.BlockedConvolution._multiply, blocked_convolution.share
periodic_symbol = kernel.periodic_symbol


def shifted_table(cells, aspect):
    x, y = np.arange(cells[0])[:, np.newaxis], aspect * np.arange(cells[1])
    return kernel.love(x + 0.5, y, 1.0, aspect)


def repeated(quadrant, padded):
    rest = quadrant[1 : (padded[0] + 1) // 2]
    return np.concatenate([quadrant, rest]) / (padded[0] * padded[1])


def forgiving_residual(pressure, w, overlap):
    return 1e-6 * contact.residual(pressure, w, overlap)


def wait_once_more(left, at_work):
    """A wait that survives one interrupt, and no second one."""
    try:
        wait_uninterrupted(left, at_work)
    except KeyboardInterrupt:
        wait_uninterrupted(left, at_work)
        raise


def wait_uninterrupted(left, at_work):
    deque(left, maxlen=0)
    while at_work:
        threads.sleep(threads.POLL)


def share_by_futures(work, blocks, buffers):
    """Only what has a future is waited for."""
    left, futures = iter(blocks), []

    def part(own):
        for block in left:
            work(own, block)

    try:
        for own in buffers[1:]:
            futures.append(threads._pool(len(buffers) - 1, os.getpid()).submit(part, own))
        part(buffers[0])
    finally:
        deque(left, maxlen=0)
        wait(futures)


def half_a_window(half_space, marked):
    """The middle of the box that holds all cells which may touch."""
    return tuple(
        slice(side.start + (side.stop - side.start) // 4, side.stop - (side.stop - side.start) // 4)
        for side in window.smallest_box(half_space, marked)
    )


def sum_of_the_pressure(half_space, cells, **settings):
    """k = sum(p) dx dy, whose error is the residual and not its square."""
    result = solve_fixed_area(half_space, cells, **settings)
    return dataclasses.replace(result, stiffness=float(result.pressure.sum()) * half_space.cell_area)


def at_ten_times_the_tolerance(attempt, residual, tolerance, max_iterations):
    judged(attempt, residual, 10 * tolerance, max_iterations)


def of_the_first_body(kept):
    """Influence kept by the shape of the grid alone."""
    return lambda body: kept.setdefault(body.shape, influence(body))


def summed_pressure(operator):
    """1.x by the same iteration, of x itself."""
    ones = np.ones(len(operator.matrix))
    return float(scipy.sparse.linalg.cg(operator.matrix, ones, rtol=few_cells.STIFFNESS_TOLERANCE)[0].sum())


influence = few_cells._influence
judged = window_solve.IterationState.record_residual
moments = Frame._moments


COLD_SOLVE = partial(rolled.test_each_position_is_that_of_a_cold_solve, "smooth", "approach")
UNIT_OF_FORCE = partial(of_few_cells.test_the_modulus_is_the_unit_of_force, 3.0)

CUT_SHORT = partial(accepted.test_a_solve_that_is_cut_short_says_so, "solve", 3)
WORN_PROFILE = profiles.test_a_worn_profile_against_a_fine_solve_of_the_plain_contact


def mean_slope(gap, steps):
    return float(np.abs(np.diff(gap, axis=0)).mean()) / steps[0]


def yielding_mean_plane(shape, spacing, modulus):
    """The longest wave's for the zero mode, which belongs to no interface."""
    symbol = periodic_symbol(shape, spacing, modulus)
    symbol[0, 0] = symbol.max()
    return symbol


FAULTS = [
    partial(levels.test_far_away_a_block_is_felt_as_the_pressure_on_it, 1.0),
    Fault("a far field of half the blocks").at(kernel, "far_table", Times(0.5)),
    levels.test_waves_of_a_period_are_near_or_far,
    Fault("a far field that is all of K").at(
        kernel, "far_periodic_symbol", lambda shape, steps, modulus, _: periodic_symbol(shape, steps, modulus)
    ),
    partial(levels.test_work_on_a_contact_does_not_grow_with_the_grid, False),
    Fault("a near field alone").at(far_field.FarField, "_settled", lambda self, pressed, stiffness: 0 * pressed),
    levels.test_the_system_on_the_blocks_is_solved_within_its_accuracy,
    Fault("one step on the blocks").at(far_field, "MOST_STEPS", 1),
    partial(interfaces.test_a_wave_has_the_stiffness_and_the_approach_of_westergaard, 0.3),
    Fault("a mean plane of a periodic half-space that yields").at(kernel, "periodic_symbol", yielding_mean_plane),
    partial(interfaces.test_the_stiffness_of_an_interface_is_what_closes_its_mean_gap, 5e-3),
    Fault("a mean gap that the stiffness does not close").at(kernel, "periodic_symbol", yielding_mean_plane),
    partial(interfaces.test_a_load_path_lies_between_those_of_the_smooth_bodies_at_the_extreme_heights, "sphere"),
    Fault("half of the stiffness along a load path").at(
        contact.Contact, "stiffness", lambda contact: contact.frozen.stiffness / 2
    ),
    test_read_only_results.test_an_older_view_of_the_gap_changes_no_problem,
    Fault("a gap that the caller may still write to").at(problem, "kept", lambda values: values),
    WORN_PROFILE,
    Fault("a profile across for the parabola that it is about").at(
        rolling_frame,
        "checked_profile",
        lambda z, columns, step: (
            -(((np.arange(columns) - (columns - 1) / 2) * step) ** 2) / (2 * equivalent_radius(z, step))
        ),
    ),
    rates.test_sphere_force_at_second_order,
    Fault("E for E* in boundary elements").at(kernel, "free_space_symbol", Times(E_FOR_E_STAR)),
    of_few_cells.test_one_cell_is_as_soft_as_it_is_alone,
    Fault("E for E* among few cells").at(few_cells, "_influence", Times(E_FOR_E_STAR)),
    Fault("few cells as wide as they are long").at(
        few_cells, "_influence", lambda body: influence(body.like(shape=body.shape, spacing=body.steps[0]))
    ),
    of_few_cells.test_a_cell_that_leaves_the_contact_keeps_no_rounding_of_its_pressure,
    Fault("a cell that has left, kept for the rounding of its pressure").at(
        projected_cg, "_left_over", lambda pressure, change: np.maximum(pressure + change, 0.0)
    ),
    UNIT_OF_FORCE,
    Fault("a second modulus among few cells").at(few_cells, "_influence", lambda body: influence(body) / body.modulus),
    Fault("few cells on the body that was pressed before").at(few_cells, "_influence", of_the_first_body({})),
    partial(of_few_cells.test_stiffness_of_a_flat_punch_is_that_of_a_direct_solve, (1.0, 1.0)),
    Fault("the sum of the pressure for its energy").at(few_cells, "_sum_of_unit_pressure", summed_pressure),
    of_few_cells.test_the_residual_is_that_of_the_whole_grid,
    Fault("the cells that are looked at first, and no others").at(few_cells, "GROWTH", 1),
    Fault("few cells judged by a forgiving residual").at(few_cells, "residual", forgiving_residual),
    of_few_cells.test_stiffness_is_the_slope_of_the_load,
    Fault("a stiffness of few cells within a tenth").at(few_cells, "STIFFNESS_TOLERANCE", 0.1),
    rates.test_square_punch_at_first_order,
    Fault("1.1419 for 1.1523 under the square punch").at(closed_forms, "SQUARE_PUNCH", 1.012 * 2 / math.sqrt(math.pi)),
    rates.test_wave_pressure_at_first_order,
    Fault("pi lost in the pressure that closes a wave").at(closed_forms, "westergaard_full_pressure", Times(1 / np.pi)),
    Fault("factor 2 lost in the periodic symbol").at(kernel, "periodic_symbol", Times(0.5)),
    dense_twin.test_displacement_by_blocks,
    Fault("a symbol a row too far").at(
        blocked_convolution.BlockedConvolution,
        "_multiply",
        lambda convolution, buffers, block: multiply(convolution, buffers, (block[0], np.roll(block[1], 1, axis=0))),
    ),
    partial(dense_twin.test_rows_of_a_block_of_columns_are_not_a_power_of_two_apart, 1024),
    Fault("columns a power of two apart").at(blocked_convolution, "COLUMNS_AT_ONCE", 32),
    threaded.test_memory_of_the_operators,
    Fault("a spectrum for each convolution").at(
        halfspace.HalfSpace, "_memory", property(lambda body: blocked_convolution.SpectrumMemory())
    ),
    partial(threaded.test_bits_of_a_displacement_are_equal_for_any_threads, False),
    Fault("threads that share a buffer").at(
        blocked_convolution, "share", lambda work, blocks, buffers: share(work, blocks, [buffers[0]] * len(buffers))
    ),
    partial(threaded.test_after_an_exception_in_a_block_the_next_answer_is_right, True),
    Fault("nobody waits for the other threads").at(threads, "_wait", lambda left, at_work: None),
    partial(threaded.test_interrupts_of_the_wait_come_after_the_last_block, 2),
    Fault("a second interrupt ends the wait").at(threads, "_wait", wait_once_more),
    threaded.test_a_thread_is_waited_for_whose_start_is_interrupted,
    Fault("a thread whose future is lost").at(threads, "share", share_by_futures),
    dense_twin.test_displacement,
    Fault("a symbol that repeats instead of mirroring").at(convolution, "_halfplane", repeated),
    # 2n - 2 points would do, since the kernel is even: the two farthest distances may share a point
    Fault("padding two points short").at(
        halfspace, "_doubled", lambda points: max(points + points % 2, 2 * points - 4)
    ),
    Fault("kernel shifted by half a cell").at(kernel, "love_table", shifted_table),
    rates.test_a_wider_grid_changes_nothing,
    Fault("no padding, seen in a contact").at(halfspace, "_doubled", lambda points: points + points % 2),
    Fault("a residual that forgives").at((window_solve, projected_cg), "residual", forgiving_residual),
    dense_twin.test_love_against_quadrature,
    Fault("half of the corner function").at(
        kernel, "corner", lambda x, y: kernel._half(np.asarray(x, dtype=float), np.asarray(y, dtype=float))
    ),
    properties.test_stiffness_is_that_of_the_dense_contact,
    Fault("stiffness of a contact grown by a cell").at(
        contact,
        "solve_fixed_area",
        lambda body, cells, **settings: solve_fixed_area(body, cells | np.roll(cells, 1, axis=0), **settings),
    ),
    properties.test_complementarity,
    Fault("a residual blind to penetration").at(
        (window_solve, projected_cg), "residual", lambda p, w, overlap: contact.residual(p, np.maximum(w, 0.0), overlap)
    ),
    partial(windows.test_contacts_anywhere_on_the_grid, [(8, 8, 0.0), (110, 70, 0.2)], 1000.0),
    Fault("a window that cuts cells off").at(window_solve, "smallest_box", half_a_window),
    paths.test_error_of_the_stiffness_is_the_residual_squared,
    Fault("stiffness to first order in the residual").at(bem3d, "solve_fixed_area", sum_of_the_pressure),
    partial(rolled.test_ridges_across_the_track_tend_to_the_filter, 1),
    Fault("factor 2 lost in linear theory, seen by boundary elements").at(rolled, "response", Times(0.5)),
    COLD_SOLVE,
    Fault("x^2 / R under the sphere").at(Track, "wheel", Times(2.0)),
    Fault("the wheel half a cell ahead").at(
        Track, "along", lambda track, rows: (np.asarray(rows) + 0.5) * track.steps[0]
    ),
    Fault("the wheel half a cell aside").at(
        Track, "across", lambda track, columns: (np.asarray(columns) - track.height.shape[1] / 2) * track.steps[1]
    ),
    partial(rolled.test_a_bump_far_ahead_is_touched_before_the_frame_has_reached_it, "approach", 0.0),
    Fault("a frame that is trusted").at(Frame, "outside", lambda *_: None),
    frames.test_cells_that_a_frame_rules_out_are_open,
    Fault("a bound four times as large").at(
        Frame, "_moments", lambda *given: (4 * moments(*given)[0], *moments(*given)[1:])
    ),
    accepted.test_every_position_of_a_wheel_is_within_its_tolerance,
    Fault("a residual of rolling that is not looked at").at(wheel_on_strip, "residual", lambda *_: 0.0),
    doubts.test_warning_of_a_modulus_in_gigapascals,
    Fault("a modulus in gigapascals that nobody asks about").at(contact, "diagnose_units", lambda **_: ()),
    partial(doubts.test_heights_in_another_unit_than_the_grid, -1e9 * doubts.SURFACE, {"force": 1e-3}, "above"),
    Fault("heights in nm on a grid in m that nobody asks about").at(contact, "typical_slope", lambda *_: 0.0),
    partial(doubts.test_heights_in_another_unit_than_the_grid, -doubts.SURFACE, {"force": 1e-3, "metre": 1e6}, "below"),
    Fault("heights in m on a grid in um that nobody asks about").at(diagnostics, "LIGHTEST_PRESSURE", 0.0),
    partial(doubts.test_steep_and_flat_indenters_are_not_asked_about, doubts.PUNCH, {"force": 1e-2}),
    Fault("the edge of a punch asked about as a slope").at(contact, "typical_slope", mean_slope),
    doubts.test_heights_of_a_strip_in_another_unit,
    Fault("a strip in um that nobody asks about").at(rolling_frame, "typical_slope", lambda *_: 0.0),
    CUT_SHORT,
    Fault("accepted at ten times its tolerance").at(
        window_solve.IterationState, "record_residual", at_ten_times_the_tolerance
    ),
    Fault("the iteration limit taken for convergence").at(
        contact.Contact, "converged", property(lambda one: one.status in ("converged", "iteration limit"))
    ),
    partial(ellipses.test_low_waves_under_an_ellipse_have_the_filter_of_the_half_space, (1.0, 0.2), (1, 0)),
    Fault("the radii along and across exchanged").at(Track, "radii", property(lambda track: track.radius[::-1])),
    ellipses.test_the_expected_contact_is_the_ellipse_of_hertz,
    Fault("a circle of the mean radius for an ellipse").at(
        rolling_frame, "smooth_contact", lambda radii: smooth_contact((math.sqrt(radii[0] * radii[1]),) * 2)
    ),
]
