"""What makes the solver fast must not be seen in its answers: windows, candidate cells, coarse grids, given starts."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pyfftw
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

import bem3d
from bem3d import nested, projected_cg, window
from tests.oracles import residual
from tests.seeded import catches


def left(contact):
    return residual(contact.problem.half_space, contact.problem.gap, contact.pressure, contact.approach)


def spheres(shape, *places, radius=200.0):
    x, y = np.indices(shape)
    return np.min([((x - i) ** 2 + (y - j) ** 2) / (2 * radius) + high for i, j, high in places], axis=0)


def half_a_window(half_space, marked):
    """The middle of the box that holds all cells which may touch."""
    return tuple(
        slice(side.start + (side.stop - side.start) // 4, side.stop - (side.stop - side.start) // 4)
        for side in window.smallest_box(half_space, marked)
    )


@catches("a window that cuts cells off", places=[(8, 8, 0.0), (110, 70, 0.2)], force=1000.0).at(
    "bem3d.window_solve.smallest_box", half_a_window
)
@pytest.mark.parametrize("places", [[(10, 100, 0.0)], [(8, 8, 0.0), (110, 70, 0.2)], [(60, 3, 0.0), (64, 90, 1.0)]])
@pytest.mark.parametrize("force", [3.0, 100.0, 1000.0])
def test_contacts_anywhere_on_the_grid(places, force):
    """Under a force that reaches a second, distant contact or does not: the residual holds on all cells."""
    body = bem3d.HalfSpace(shape=(120, 110), spacing=1.0, modulus=1.0)
    gap = spheres(body.shape, *places)
    contact = bem3d.solve(body, gap, force=force, tolerance=1e-8)
    assert left(contact) <= 1.01e-8
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
    assert left(contact) <= 1.01e-8
    assert not contact.pressure[80:].any()


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
    gap, used = (
        np.random.default_rng(1).normal(size=(70, 50)),
        bem3d.HalfSpace(shape=(70, 50), spacing=1.0, modulus=1.0),
    )
    forces = (1.0, 10.0, 0.01, 1000.0) * 2

    def solved(force, body=used):
        return bem3d.solve(body, gap, force=force).pressure

    first = [solved(force, bem3d.HalfSpace(shape=(70, 50), spacing=1.0, modulus=1.0)) for force in forces]
    np.testing.assert_array_equal([solved(force) for force in forces], first)
    with ThreadPoolExecutor(8) as threads:
        np.testing.assert_array_equal(list(threads.map(solved, forces)), first)


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


@pytest.mark.parametrize("periodic", [True, False])
def test_pressures_are_interpolated_around_a_period_and_end_with_the_grid_in_free_space(periodic):
    """3/4 of the coarser cell that a finer one lies in, 1/4 of the one that it lies next to."""
    body = bem3d.HalfSpace(shape=(64, 3), spacing=1.0, modulus=1.0, periodic=periodic)
    for last, places in ((-1, [61, 62, 63, 0]), (0, [2, 1, 0, 63])):
        coarse, fine = np.zeros((32, 3)), np.zeros((64, 3))
        coarse[last] = 4.0
        fine[places] = np.array([[1.0], [3.0], [3.0], [1.0 if periodic else 0.0]])
        np.testing.assert_array_equal(nested.prolong(coarse, body), fine)


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
