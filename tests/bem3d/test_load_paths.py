"""`indent`: contacts along a path, with the stiffness; the frozen contact behind it."""

import dataclasses

import numpy as np
import pytest
from hypothesis import given

import bem3d
from bem3d.tangent_stiffness import solve_fixed_area
from tests.oracles import dense_operator
from tests.seeded import catches
from tests.strategies import pressed

BODY = bem3d.HalfSpace(shape=(40, 36), spacing=1.0, modulus=1.0)
GAP = np.random.default_rng(5).normal(size=BODY.shape)


@pytest.mark.parametrize("periodic", [True, False])
@pytest.mark.parametrize("by", ["forces", "approaches"])
@pytest.mark.parametrize("stiffness", [True, False])
def test_each_contact_is_the_one_of_a_cold_solve(by, periodic, stiffness):
    """Loading, unloading, the same load twice, no load in between."""
    body = bem3d.HalfSpace(shape=BODY.shape, spacing=1.0, modulus=1.0, periodic=periodic)
    path = [0.1, 1.0, 1.0, 3.0, 0.0, 2.0, 0.5] if by == "forces" else [-2.5, -1.0, -1.0, -0.5, -9.0, -0.7, -2.0]
    contacts = list(bem3d.indent(body, GAP, **{by: path}, stiffness=stiffness, tolerance=1e-9))
    assert len(contacts) == len(path)
    for value, contact in zip(path, contacts, strict=True):
        cold = bem3d.solve(body, GAP, **{by.removesuffix("es" if by == "approaches" else "s"): value}, tolerance=1e-9)
        assert contact.force == pytest.approx(cold.force, rel=1e-6, abs=1e-12)
        assert contact.approach == pytest.approx(cold.approach, abs=1e-7)
        assert contact.area == cold.area
        if stiffness:
            assert contact.frozen is not None
            assert contact.stiffness() == contact.stiffness(tolerance=1e-4) == contact.frozen.stiffness
            assert contact.frozen.stiffness == pytest.approx(cold.stiffness(tolerance=1e-9), rel=1e-6)
        else:
            assert contact.frozen is None


@pytest.mark.parametrize(("path", "stiffness", "tolerance"), [([1.0, 3.0, 2.0], False, 1e-5), ([1.0, 2.0], True, 1e-3)])
def test_a_punch_that_keeps_its_cells_is_predicted(path, stiffness, tolerance):
    """Pressures of a flat punch are proportional to its approach: secant and tangent lead to the next, in one look."""
    gap = np.full(BODY.shape, 100.0)
    gap[10:25, 8:30] = 0.0
    *_, last = bem3d.indent(BODY, gap, approaches=path, stiffness=stiffness, tolerance=tolerance)
    assert last.operator_applications == 1


def sum_of_the_pressure(half_space, cells, **settings):
    """k = sum(p) dx dy, whose error is the residual and not its square."""
    result = solve_fixed_area(half_space, cells, **settings)
    return dataclasses.replace(result, stiffness=float(result.pressure.sum()) * half_space.cell_area)


@catches("stiffness to first order in the residual").at("bem3d.solve_fixed_area", sum_of_the_pressure)
@pytest.mark.slow
@given(problem=pressed(most=12, by=("force",)))
def test_error_of_the_stiffness_is_the_residual_squared(problem):
    """k = 2 sum(p) - sum(p K p) takes the energy of p, which is lowest for the answer: always from below, and to
    (condition of K) x residual^2, while sum(p) itself may be off by the residual."""
    contact = problem.solve().pressure > 0
    body = problem.half_space
    if body.periodic and contact.all():
        return
    cells = np.flatnonzero(contact)
    matrix = dense_operator(body)[np.ix_(cells, cells)]
    exact = np.linalg.solve(matrix, np.ones(cells.size)).sum() * body.cell_area
    condition = np.linalg.cond(matrix)
    for tolerance in (1e-1, 1e-2, 1e-3, 1e-5):
        # from a start, what is left is not orthogonal to the pressure
        frozen = bem3d.solve_fixed_area(body, contact, start=np.ones(body.shape), tolerance=tolerance)
        assert frozen.residual <= tolerance
        short = 1 - frozen.stiffness / exact
        assert -1e-12 * condition <= short <= condition * frozen.residual**2 + 1e-12 * condition


def test_an_initial_guess_for_the_fixed_area():
    contact = bem3d.solve(BODY, GAP, force=1.0).pressure > 0
    cold = bem3d.solve_fixed_area(BODY, contact, tolerance=1e-6)
    warm = bem3d.solve_fixed_area(BODY, contact, start=cold.pressure + GAP, tolerance=1e-6)
    again = bem3d.solve_fixed_area(BODY, contact, start=cold.pressure, tolerance=1e-6)
    assert warm.stiffness == pytest.approx(cold.stiffness, rel=1e-9)
    assert again.operator_applications == 1
    assert again.iterations == 0
    assert cold.iterations == cold.operator_applications == len(cold.history) - 1
    assert not again.pressure[~contact].any()
    with pytest.raises(ValueError, match="read-only"):
        cold.pressure[0, 0] = 1.0


def test_contacts_come_one_by_one(monkeypatch):
    """Nothing is solved before it is asked for; what is wrong with the input is said at once."""
    solved = []
    solve = bem3d.window_solve.solve_on_window
    monkeypatch.setattr(
        bem3d.solver, "solve_on_window", lambda problem, *more: solved.append(problem) or solve(problem, *more)
    )
    path = bem3d.indent(BODY, GAP, forces=[1.0, 2.0, 3.0])
    assert not solved
    next(path)
    assert [problem.force for problem in solved] == [1.0]
    with pytest.raises(ValueError, match=r"forces\[1\] must be zero or positive, got -1"):
        bem3d.indent(BODY, GAP, forces=[1.0, -1.0])


def test_a_stiffness_that_was_brought_along_is_not_solved_for_again(monkeypatch):
    """Down to the residual that it has."""
    (contact,) = bem3d.indent(BODY, GAP, forces=[3.0], stiffness=True)
    brought = contact.frozen.residual
    finer = contact.stiffness(tolerance=brought / 2)
    monkeypatch.delattr("bem3d.contact.solve_fixed_area")
    assert contact.stiffness() == contact.stiffness(tolerance=brought) == contact.frozen.stiffness
    with pytest.raises(NameError):
        contact.stiffness(tolerance=brought / 2)
    assert finer == pytest.approx(contact.frozen.stiffness, rel=1e-6)


FORCES = [0.3, 1.0, 3.0]


def stiffness_and_applications(tolerance):
    """Of each load, with contacts that are far more exact than their frozen ones."""
    path = bem3d.indent(BODY, GAP, forces=FORCES, stiffness=True, stiffness_tolerance=tolerance, tolerance=1e-10)
    return zip(*((contact.stiffness(), contact.frozen.operator_applications) for contact in path), strict=True)


@catches("frozen contacts that keep their own tolerance").at(
    "bem3d.indentation.solve_fixed_area",
    lambda *arguments, tolerance, **others: solve_fixed_area(*arguments, tolerance=1e-4, **others),
)
def test_the_error_of_a_stiffness_is_some_tens_of_times_the_square_of_its_tolerance():
    exact, _ = map(np.array, stiffness_and_applications(1e-9))
    errors, applications = [], []
    for tolerance in (1e-1, 1e-2, 1e-3, 1e-4):
        stiffness, used = map(np.array, stiffness_and_applications(tolerance))
        errors.append(np.abs(stiffness / exact - 1).max() / tolerance**2)
        applications.append(used.sum())
    assert max(errors) < 50
    assert applications == sorted(set(applications))


def test_a_stiffness_tolerance_is_a_fraction():
    with pytest.raises(ValueError, match="stiffness_tolerance must lie between 0 and 1, both excluded, got 0"):
        bem3d.indent(BODY, GAP, forces=FORCES, stiffness=True, stiffness_tolerance=0.0)


RIDGE = 1e-7 * np.abs(np.arange(12.0)[:, np.newaxis] - 5.0) * np.ones(10)
SMALL = bem3d.HalfSpace(shape=(12, 10), spacing=1e-4, modulus=1e11)
FORCES = [1.0, 3.0, 2.0]
TAKE = bem3d.LoadPath._take


@catches("a path that forgets the contacts that were taken").at(
    "bem3d.indentation.LoadPath._column", lambda path, number: np.array([NUMBERS[number](contact) for contact in path])
)
def test_arrays_of_a_path_are_those_of_its_contacts():
    contacts = list(bem3d.indent(SMALL, RIDGE, forces=FORCES, stiffness=True))
    expected = [np.array([number(contact) for contact in contacts]) for number in NUMBERS]
    for taken in range(4):
        path = bem3d.indent(SMALL, RIDGE, forces=FORCES, stiffness=True)
        assert [next(path).force for _ in range(taken)] == expected[1][:taken].tolist()
        for _ in range(2):
            arrays = path.approach, path.force, path.stiffness
            assert all(np.array_equal(*pair) for pair in zip(arrays, expected, strict=True))
        assert path.loads.tolist() == FORCES and list(path) == []
        assert not any(array.flags.writeable for array in (*arrays, path.loads))


NUMBERS = (lambda contact: contact.approach, lambda contact: contact.force, lambda contact: contact.stiffness())


def test_a_path_solves_what_is_asked_and_no_more():
    solved = []
    path = bem3d.indent(SMALL, RIDGE, forces=FORCES, progress=lambda done, total: solved.append(done))
    assert path.loads.size == 3 and "3 loads" in repr(path) and len(repr(path)) < 100
    assert solved == []
    next(path)
    assert solved == [1]
    with pytest.raises(ValueError, match="stiffness of a path needs stiffness=True of indent, got False"):
        _ = path.stiffness
    assert solved == [1] and path.approach.size == 3 and solved == [1, 2, 3]


def test_a_path_that_has_failed_has_no_numbers():
    path = bem3d.indent(SMALL, RIDGE, forces=FORCES, max_iterations=1, tolerance=1e-12)
    for _ in range(2):
        with pytest.raises(bem3d.ConvergenceError):
            _ = path.force
    with pytest.raises(bem3d.ConvergenceError):
        next(path)
    loose = bem3d.indent(
        SMALL, RIDGE, forces=FORCES, stiffness=True, max_iterations=1, tolerance=1e-12, raise_on_failure=False
    )
    assert np.isnan(loose.stiffness).all() and loose.force.size == 3


@catches("a warning at a line of the package").at(
    "bem3d.indentation.LoadPath._take", lambda path, *, level: TAKE(path, level=level - 1)
)
def test_a_path_warns_at_the_line_of_its_user():
    flat = np.zeros((12, 10))
    for taken in (next, list, lambda path: path.force):
        with pytest.warns(bem3d.EdgeWarning) as caught:
            taken(bem3d.indent(SMALL, flat, forces=[1.0, 2.0]))
        assert [warning.filename for warning in caught] == [__file__]
