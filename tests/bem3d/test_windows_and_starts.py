"""What makes the solver fast must not be seen in its answers: windows, candidate cells, coarse grids, given starts."""

import threading

import numpy as np
import pyfftw
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

import bem3d
from bem3d import nested, projected_cg, window
from bem3d.problem import Problem
from bem3d.window import smallest_box
from tests.oracles import displacement
from tests.strategies import half_spaces, pressed


def residual(contact):
    """Of the whole grid, by an operator of the test's own."""
    problem = contact.problem
    w = problem.gap + displacement(problem.half_space, contact.pressure) - contact.approach
    s = contact.approach - problem.gap.min()
    return max((contact.pressure * np.abs(w)).sum() / contact.pressure.sum(), -w.min()) / s


def spheres(shape, *places, radius=200.0):
    x, y = np.indices(shape)
    return np.min([((x - i) ** 2 + (y - j) ** 2) / (2 * radius) + high for i, j, high in places], axis=0)


@pytest.mark.parametrize("places", [[(10, 100, 0.0)], [(8, 8, 0.0), (110, 70, 0.2)], [(60, 3, 0.0), (64, 90, 1.0)]])
@pytest.mark.parametrize("force", [3.0, 100.0, 1000.0])
def test_contacts_anywhere_on_the_grid(places, force):
    """Under a force that reaches a second, distant contact or does not: the residual holds on all cells."""
    body = bem3d.HalfSpace(shape=(120, 110), spacing=1.0, modulus=1.0)
    gap = spheres(body.shape, *places)
    contact = bem3d.solve(body, gap, force=force, tolerance=1e-8)
    assert residual(contact) <= 1.01e-8
    plain = bem3d.solve_polonsky_keer(body, gap, force=force, tolerance=1e-9)
    assert contact.approach == pytest.approx(plain.approach, rel=1e-6)


@pytest.mark.parametrize("load", [{"force": 200.0}, {"approach": 0.8}])
@pytest.mark.parametrize("size", [1e-12, 1.0, 1e12])
def test_a_start_somewhere_else(load, size):
    """Pressure where there is no contact, far too small or far too large."""
    body = bem3d.HalfSpace(shape=(120, 110), spacing=1.0, modulus=1.0)
    gap = spheres(body.shape, (30, 30, 0.0))
    start = np.zeros(body.shape)
    start[100:105, 90:100] = size
    contact = bem3d.solve(body, gap, **load, start=start, tolerance=1e-8)
    assert residual(contact) <= 1.01e-8
    assert not contact.pressure[80:].any()


def test_a_start_with_a_window_too_small():
    """The contact of a small load starts a load a thousand times as large, and the other way round."""
    body = bem3d.HalfSpace(shape=(120, 110), spacing=1.0, modulus=1.0)
    gap = spheres(body.shape, (50, 60, 0.0))
    small = bem3d.solve(body, gap, force=1.0, tolerance=1e-8)
    large = bem3d.solve(body, gap, force=1000.0, start=small, tolerance=1e-8)
    again = bem3d.solve(body, gap, force=1.0, start=large, tolerance=1e-8)
    for contact, cold in ((large, bem3d.solve(body, gap, force=1000.0, tolerance=1e-8)), (again, small)):
        assert residual(contact) <= 1.01e-8
        assert contact.approach == pytest.approx(cold.approach, rel=1e-7)


@given(data=st.data())
def test_a_window_is_a_part_of_the_grid(data):
    """K on a window: the same displacement there, for pressure inside."""
    body = data.draw(half_spaces(most=12, periodic=False))
    marked = data.draw(arrays(np.bool_, body.shape))
    box = window.smallest_box(body, marked)
    inside = np.zeros(body.shape, dtype=bool)
    inside[box] = True
    assert not (marked & ~inside).any()
    pressure = np.where(marked, data.draw(arrays(np.float64, body.shape, elements=st.floats(-1, 1, width=32))), 0.0)
    part = body.like(shape=pressure[box].shape).displacement(pressure[box])
    assert part == pytest.approx(body.displacement(pressure)[box], abs=1e-12 * max(1.0, np.abs(pressure).sum()))


@pytest.mark.slow
@given(data=st.data())
def test_candidates_are_a_part_of_the_field(data):
    """Vectors over some cells, through the operator and back: those of the field that is zero elsewhere."""
    body = data.draw(half_spaces(most=9))
    marked = data.draw(arrays(np.bool_, body.shape))
    cells = window.Candidates(body, marked)
    pressure = np.where(marked, data.draw(arrays(np.float64, body.shape, elements=st.floats(-1, 1, width=32))), 0.0)
    vector = cells.compress(pressure)
    np.testing.assert_array_equal(cells.spread(vector), pressure)
    np.testing.assert_array_equal(cells.displacement(vector), body.displacement(pressure)[marked])


@pytest.mark.slow
@given(data=st.data(), total=st.floats(1e-6, 1e6))
def test_nearest_pressure_of_a_total(data, total):
    """Least squares on p >= 0, sum(p) = total, by its conditions: one multiplier on the cells that carry, and no cell
    without pressure that would rather have some."""
    aim = data.draw(arrays(np.float64, st.integers(1, 12), elements=st.floats(-10, 10, width=32)))
    free = data.draw(arrays(np.bool_, aim.shape))
    if not free.any():
        return
    found = projected_cg.Load(total=total).nearest(aim, free)
    assert found.sum() == pytest.approx(total, rel=1e-9)
    assert (found >= 0).all()
    assert not found[~free].any()
    level = (aim - found)[found > 0]
    assert level == pytest.approx(level[0], abs=1e-9 * (10 + total))
    assert (aim[free & (found == 0)] <= level.min() + 1e-9 * (10 + total)).all()


@given(data=st.data())
def test_coarser_grids(data):
    """Means are kept, a constant stays one, the sides of a period stay what they are."""
    body = data.draw(half_spaces(most=70))
    coarse = nested.coarser(body)
    if coarse is None:
        assert max(body.shape) < 32
        return
    values = data.draw(arrays(np.float64, body.shape, elements=st.floats(-1, 1, width=32), fill=st.just(0.5)))
    down = nested.restrict(values)
    assert down.shape == coarse.shape
    if all(n % 2 == 0 or n == m for n, m in zip(body.shape, coarse.shape, strict=True)):
        assert down.mean() == pytest.approx(values.mean(), abs=1e-12)
    constant = nested.prolong(np.ones(coarse.shape), body)
    assert constant.shape == body.shape
    assert constant[1:-1, 1:-1] == pytest.approx(1.0)
    if body.periodic:
        sides = [n * d for n, d in zip(body.shape, body.steps, strict=True)]
        assert [n * d for n, d in zip(coarse.shape, coarse.steps, strict=True)] == pytest.approx(sides)


@given(problem=pressed(most=12))
def test_a_first_pressure_lowers_the_energy_most(problem):
    """Of all multiples of the geometric overlap; uniform where a force is prescribed."""
    stated = Problem(half_space=problem.half_space, gap=problem.gap, **problem.prescribed)
    p = nested.first_pressure(stated).pressure
    if stated.approach is None:
        assert np.ptp(p) == 0
        return
    overlap = np.maximum(stated.approach - problem.gap, 0.0)
    assert p * overlap.max() == pytest.approx(overlap * p.max(), rel=1e-12, abs=0)
    # the slope of 1/2 p K p - (d - g) p along p itself
    downhill = (p * overlap).sum()
    assert (p * problem.half_space.displacement(p)).sum() == pytest.approx(downhill, rel=1e-9, abs=0)


@pytest.mark.parametrize("shape", [(64, 64), (65, 47)])
@pytest.mark.parametrize("load", [{"force": 300.0}, {"approach": 20.5}])
def test_coarser_grids_come_with_their_overlap(shape, load):
    """A coarser grid has another first touch: the approach it gives to begin with is that of the solution, nearly."""
    body = bem3d.HalfSpace(shape=shape, spacing=1.0, modulus=1.0)
    gap = 20 + spheres(shape, (30.3, 20.7, 0.0))
    start, levels = nested.initial_guess_from_coarse_grids(Problem(half_space=body, gap=gap, **load), 500)
    contact = bem3d.solve(body, gap, **load)
    assert levels
    assert start.overlap == pytest.approx(contact.approach - gap.min(), rel=0.05)
    assert start.pressure.sum() == pytest.approx(contact.pressure.sum(), rel=0.05)


@pytest.mark.parametrize("periodic", [True, False])
def test_pressures_are_interpolated_around_a_period_and_end_with_the_grid_in_free_space(periodic):
    """3/4 of the coarser cell that a finer one lies in, 1/4 of the one that it lies next to."""
    body = bem3d.HalfSpace(shape=(64, 3), spacing=1.0, modulus=1.0, periodic=periodic)
    for last, places in ((-1, [61, 62, 63, 0]), (0, [2, 1, 0, 63])):
        coarse, fine = np.zeros((32, 3)), np.zeros((64, 3))
        coarse[last] = 4.0
        fine[places] = np.array([[1.0], [3.0], [3.0], [1.0 if periodic else 0.0]])
        np.testing.assert_array_equal(nested.prolong(coarse, body), fine)


@pytest.mark.parametrize("shape", [(64, 64), (65, 47), (1, 97), (101, 40)])
@pytest.mark.parametrize("periodic", [True, False])
def test_coarse_grids_give_a_start_and_no_more(shape, periodic, monkeypatch):
    """With and without them, the same contact."""
    body = bem3d.HalfSpace(shape=shape, spacing=(1.0, 1.7), modulus=1.0, periodic=periodic)
    gap = np.random.default_rng(1).normal(size=shape)
    one = bem3d.solve(body, gap, force=3.0, tolerance=1e-10)
    assert one.coarse_applications
    monkeypatch.setattr(nested, "FEWEST_CELLS", 10**9)
    other = bem3d.solve(body, gap, force=3.0, tolerance=1e-10)
    assert not other.coarse_applications
    assert one.pressure == pytest.approx(other.pressure, abs=1e-7 * other.pressure.max())


def test_what_a_half_space_has_solved_before_does_not_matter():
    """Equal bits from a new half-space, from one that has solved other problems, and from threads that share one."""
    gap = np.random.default_rng(1).normal(size=(70, 50))

    def new():
        return bem3d.HalfSpace(shape=gap.shape, spacing=1.0, modulus=1.0)

    first = bem3d.solve(new(), gap, force=1.0).pressure
    used = new()
    for force in (10.0, 0.01, 1000.0):
        bem3d.solve(used, gap[::-1], force=force)
    np.testing.assert_array_equal(bem3d.solve(used, gap, force=1.0).pressure, first)
    found = []
    threads = [
        threading.Thread(target=lambda: found.append(bem3d.solve(used, gap, force=1.0).pressure)) for _ in range(4)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(found) == 4
    for pressure in found:
        np.testing.assert_array_equal(pressure, first)


@pytest.mark.slow
@pytest.mark.parametrize("periodic", [True, False])
def test_measured_plans_leave_the_estimates_of_others_alone(periodic):
    """FFTW remembers what it has measured in a process, and would use it for the next estimate."""
    pressure = np.random.default_rng(0).random((60, 60))

    def displacement(planning):
        body = bem3d.HalfSpace(shape=(60, 60), spacing=1.0, modulus=1.0, periodic=periodic, planning=planning)
        return body.displacement(pressure)

    before = displacement("estimate")
    assert displacement("measure") == pytest.approx(before, rel=1e-12, abs=1e-12)
    np.testing.assert_array_equal(displacement("estimate"), before)


def test_the_memory_of_fftw_is_put_back_as_it_was():
    """What others have measured in this process stays, and what a half-space has measured goes."""
    field = pyfftw.empty_aligned(24, dtype=np.complex128)
    try:
        pyfftw.FFTW(field, field, flags=("FFTW_MEASURE",))
        known = [set(part.splitlines()) for part in pyfftw.export_wisdom()]
        bem3d.HalfSpace(shape=(20, 12), spacing=1.0, modulus=1.0, planning="measure").displacement(np.ones((20, 12)))
        assert [set(part.splitlines()) for part in pyfftw.export_wisdom()] == known
    finally:
        pyfftw.forget_wisdom()


def test_a_window_is_laid_around_the_middle_of_what_it_holds():
    """21 cells in one of 25, with two to spare on each side, or as many as the grid has."""
    half_space = bem3d.HalfSpace(shape=(60, 40), spacing=1.0, modulus=1.0)
    marked = np.zeros((60, 40), dtype=bool)
    marked[10:31, 39] = marked[10:31, 19] = True
    assert smallest_box(half_space, marked) == (slice(8, 33), slice(15, 40))


def test_sides_of_windows_are_few():
    """The shortest that is long enough, as far as there are cells."""
    sides = [window.fast_side(length, 99) for length in range(1, 36)]
    assert sides == [*range(1, 9), *[10] * 2, *[12] * 2, *[14] * 2, *[16] * 2, *[20] * 4, *[25] * 5, *[28] * 3,
                     *[30] * 2, *[32] * 2, *[35] * 3]  # fmt: skip
    assert [window.fast_side(length, 9) for length in (8, 9)] == [8, 9]
