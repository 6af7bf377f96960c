"""What saves operator applications: counts of small solves, to the last one, and the rules of the iteration one by one.

Where an iteration begins, what it remembers and when it looks anew shows in no answer, but in these counts. No rounding
changes them: they are the same where all heights are moved by a hundred millionth. Who changes them on purpose writes
the new ones here.
"""

import itertools

import numpy as np
import pytest

import bem3d
from bem3d import convolution, projected_cg, rolling, window_solve
from bem3d.projected_cg import IterationStep, Load, Memory
from tests import oracles

TRACK = {"spacing": 1 / 8, "radius": 1.0, "modulus": 1.0}
HERTZ = 4 / 3
"""Of the sphere on the track, at an approach of 1."""


def rough(shape, *, rms, seed=3, shaken=0.0):
    """White noise through a few running means: smooth from cell to cell; and shaken by so much of its height."""
    rng = np.random.default_rng(seed)
    h = rng.normal(size=shape)
    for axis in (0, 1):
        for _ in range(3):
            h = h + 0.9 * np.roll(h, 1, axis) + 0.9 * np.roll(h, -1, axis)
    return rms * ((h - h.mean()) / h.std() + shaken * rng.normal(size=shape))


def body(shape, periodic):
    return bem3d.HalfSpace(shape=shape, spacing=1 / 64, modulus=1.0, periodic=periodic)


def of(contact):
    """On coarser grids from the coarsest, and on its own."""
    return [*(count for _, count in contact.coarse_applications), contact.operator_applications]


def cold(shape, periodic, shaken):
    """By a force, and by the approach that comes of it."""
    half_space, gap = body(shape, periodic), -rough(shape, rms=0.01, shaken=shaken)
    by_force = bem3d.solve(half_space, gap, force=0.004, tolerance=1e-8)
    return [of(by_force), of(bem3d.solve(half_space, gap, approach=by_force.approach, tolerance=1e-8))]


def warm(shape, periodic, shaken):
    """From a contact under two thirds of the force, from its pressure alone, and by an approach of 2 % more."""
    half_space, gap = body(shape, periodic), -rough(shape, rms=0.01, shaken=shaken)
    start = bem3d.solve(half_space, gap, force=0.004, tolerance=1e-8)
    harder = start.approach + 0.02 * abs(start.approach)
    return [
        of(bem3d.solve(half_space, gap, force=0.006, start=start, tolerance=1e-8)),
        of(bem3d.solve(half_space, gap, force=0.006, start=start.pressure, tolerance=1e-8)),
        of(bem3d.solve(half_space, gap, approach=harder, start=start, tolerance=1e-8)),
    ]


def path(by, stiffness, periodic, shaken):
    """Up five loads and down again, every other of them; and the stiffness of each."""
    half_space, gap = body((40, 33), periodic), -rough((40, 33), rms=0.01, shaken=shaken)
    loads = np.geomspace(1e-4, 6e-3, 5)
    if by == "approaches":
        loads = [contact.approach for contact in bem3d.indent(half_space, gap, forces=loads)]
    contacts = list(bem3d.indent(half_space, gap, **{by: [*loads, *loads[::-2]]}, stiffness=stiffness))
    costs = [of(contact) for contact in contacts]
    return [*costs, [contact.frozen.operator_applications for contact in contacts]] if stiffness else costs


def from_nothing(periodic, shaken):
    """From no load at all, up again, down to nothing and back: only what is loaded tells of the next."""
    half_space, gap = body((40, 33), periodic), -rough((40, 33), rms=0.01, shaken=shaken)
    loads = [0.0, 1e-3, 2e-3, 2.5e-3, 2.5e-3, 0.0, 2e-3, 3e-3]
    return [of(contact) for contact in bem3d.indent(half_space, gap, forces=loads)]


def sphere(by, shaken):
    """a = 16 cells of 128, its middle at no point of symmetry of a cell."""
    x, y = (np.arange(128) - 63.2)[:, np.newaxis] / 128, (np.arange(128) - 63.9) / 128
    half_space = bem3d.HalfSpace(shape=(128, 128), spacing=1 / 128, modulus=1.0)
    gap = (x**2 + y**2) / 2 + shaken / 64 * np.random.default_rng(3).normal(size=(128, 128))
    load = {"approach": 1 / 64} if by == "approach" else {"force": HERTZ / 512}
    return [of(bem3d.solve(half_space, gap, **load, tolerance=1e-8))]


def plain(periodic, shaken):
    """By a force, and by the approach that comes of it."""
    half_space, gap = body((32, 32), periodic), -rough((32, 32), rms=0.01, shaken=shaken)
    by_force = bem3d.solve_polonsky_keer(half_space, gap, force=0.001, tolerance=1e-6)
    return [of(by_force), of(bem3d.solve_polonsky_keer(half_space, gap, approach=by_force.approach, tolerance=1e-6))]


def rolled(by, rms, positions, shaken):
    """Position by position."""
    track = bem3d.Track(height=rough((60, 40), rms=rms, seed=5, shaken=shaken), **TRACK)
    wheel = bem3d.RollingContact(track, tolerance=1e-6)
    contacts = [wheel.carry(i, HERTZ) if by == "force" else wheel.press(i, 1.0) for i in range(positions)]
    return [[contact.operator_applications for contact in contacts]]


SCENES = {
    **{
        f"{kind.__name__}, {'x'.join(map(str, shape))}, {'periodic' if periodic else 'free'}": (kind, (shape, periodic))
        for kind in (cold, warm)
        for shape in ((40, 33), (65, 47))
        for periodic in (False, True)
    },
    **{
        f"path of {by}{', stiffness' * stiffness}, {'periodic' if periodic else 'free'}": (
            path,
            (by, stiffness, periodic),
        )
        for by in ("forces", "approaches")
        for stiffness in (False, True)
        for periodic in (False, True)
    },
    **{
        f"path from nothing, {'periodic' if periodic else 'free'}": (from_nothing, (periodic,))
        for periodic in (False, True)
    },
    **{f"sphere by {by}": (sphere, (by,)) for by in ("approach", "force")},
    **{f"plain, {'periodic' if periodic else 'free'}": (plain, (periodic,)) for periodic in (False, True)},
    **{
        f"rolled by {by}, {kind}": (rolled, (by, rms, positions))
        for by in ("force", "approach")
        for kind, rms, positions in (("smooth", 0.02, 4), ("rough", 0.3, 40))
    },
}

COSTS = {
    "path from nothing, free": [[0], [7, 15], [16], [11], [1], [0], [8, 15], [16]],
    "path from nothing, periodic": [[0], [7, 13], [15], [11], [1], [0], [7, 14], [14]],
    "cold, 40x33, free": [[8, 18], [6, 19]],
    "cold, 40x33, periodic": [[8, 17], [4, 16]],
    "cold, 65x47, free": [[8, 7, 18], [5, 7, 19]],
    "cold, 65x47, periodic": [[7, 7, 16], [3, 7, 16]],
    "warm, 40x33, free": [[19], [18], [13]],
    "warm, 40x33, periodic": [[16], [16], [12]],
    "warm, 65x47, free": [[17], [16], [13]],
    "warm, 65x47, periodic": [[15], [15], [12]],
    "path of forces, free": [[8, 9], [20], [12], [15], [16], [1], [13], [7]],
    "path of forces, periodic": [[8, 9], [12], [11], [14], [14], [1], [13], [8]],
    "path of forces, stiffness, free": [[8, 9], [11], [11], [15], [15], [1], [12], [8], [2, 5, 6, 7, 8, 1, 6, 3]],
    "path of forces, stiffness, periodic": [[8, 9], [11], [9], [15], [14], [1], [11], [8], [2, 5, 5, 6, 7, 1, 5, 3]],
    "path of approaches, free": [[4, 9], [9], [11], [13], [16], [1], [13], [9]],
    "path of approaches, periodic": [[3, 9], [9], [10], [11], [12], [1], [11], [8]],
    "path of approaches, stiffness, free": [[4, 9], [8], [9], [12], [15], [1], [11], [6], [2, 5, 6, 7, 8, 1, 6, 3]],
    "path of approaches, stiffness, periodic": [[3, 9], [7], [8], [10], [12], [1], [10], [8], [2, 5, 5, 6, 7, 1, 5, 3]],
    "sphere by approach": [[4, 6, 5, 15]],
    "sphere by force": [[9, 3, 8, 14]],
    "plain, free": [[35], [31]],
    "plain, periodic": [[37], [27]],
    "rolled by force, smooth": [[12, 9, 9, 9]],
    "rolled by force, rough": [
        [
            15,
            11,
            15,
            13,
            9,
            9,
            9,
            9,
            9,
            9,
            9,
            8,
            9,
            9,
            9,
            8,
            16,
            10,
            18,
            9,
            14,
            15,
            14,
            8,
            8,
            8,
            9,
            9,
            9,
            8,
            8,
            8,
            8,
            9,
            10,
            10,
            10,
            9,
            9,
            9,
        ]
    ],
    "rolled by approach, smooth": [[12, 11, 10, 10]],
    "rolled by approach, rough": [
        [
            23,
            11,
            15,
            16,
            9,
            9,
            9,
            8,
            10,
            10,
            9,
            10,
            10,
            8,
            9,
            19,
            11,
            19,
            11,
            11,
            18,
            10,
            9,
            9,
            10,
            9,
            10,
            10,
            9,
            9,
            10,
            9,
            10,
            17,
            9,
            10,
            15,
            10,
            16,
            16,
        ]
    ],
}


@pytest.mark.parametrize("shaken", [0.0, 1e-8], ids=["as it is", "shaken"])
@pytest.mark.parametrize("scene", SCENES)
def test_a_solve_costs_what_it_did(scene, shaken):
    count, of_what = SCENES[scene]
    assert count(*of_what, shaken) == COSTS[scene]


def windows(monkeypatch, contacts):
    """Sides of the windows of 48 cells and fewer of which a residual is asked for, one row a contact."""
    sides = []
    apply = bem3d.HalfSpace.apply
    monkeypatch.setattr(bem3d.HalfSpace, "apply", lambda self, p: sides.append(self.shape) or apply(self, p))
    found = []
    for _ in contacts:
        found.append(sorted({side for shape in sides for side in shape}))
        sides.clear()
    return found


def off_the_middle(**changes):
    """A sphere of radius 1 over 96 cells a side of 1/96, lowest at 0.7 above the plane that approaches count from."""
    x, y = (np.arange(96) - 50.2)[:, np.newaxis] / 96, (np.arange(96) - 46.9) / 96
    half_space = bem3d.HalfSpace(shape=(96, 96), spacing=1 / 96, modulus=1.0, **changes)
    return half_space, 0.7 + (x**2 + y**2) / 2


@pytest.mark.parametrize(
    ("stiffness", "expected"),
    [
        (False, [[12, 24, 25], [25, 30], [40], [35], [25], [40]]),
        (True, [[12, 24, 25], [30, 32], [40], [35], [25], [50]]),
    ],
)
def test_windows_along_a_path_of_forces(stiffness, expected, monkeypatch):
    """Wide enough for the overlap s that the secant or the tangent tells: 2 sqrt(2 * 1.1 s R)."""
    half_space, gap = off_the_middle()
    radii = np.array([8, 10, 12, 11, 6, 12]) / 96
    path = bem3d.indent(half_space, gap, forces=HERTZ * radii**3, stiffness=stiffness, tolerance=1e-5)
    found = windows(monkeypatch, path)
    assert found == expected


def test_windows_of_a_warm_start(monkeypatch):
    """By its overlap, where it is a contact; a pressure alone tells none, and has all of the grid."""
    half_space, gap = off_the_middle()
    start = bem3d.solve(half_space, gap, force=HERTZ / 12**3, tolerance=1e-5)
    again = {"force": 1.2 * HERTZ / 12**3, "tolerance": 1e-5}
    from_contact = (bem3d.solve(half_space, gap, **again, start=start) for _ in range(1))
    from_pressure = (bem3d.solve(half_space, gap, **again, start=start.pressure) for _ in range(1))
    assert windows(monkeypatch, from_contact) == [[25]]
    assert windows(monkeypatch, from_pressure) == [[96]]


def test_windows_of_a_cold_start(monkeypatch):
    """By the overlap on the next coarser grid, and of the coarsest all; by an approach it is known on each."""
    half_space, gap = off_the_middle()
    by_force = (bem3d.solve(half_space, gap, force=HERTZ / 12**3, tolerance=1e-5) for _ in range(1))
    by_approach = (bem3d.solve(half_space, gap, approach=0.7 + 1 / 144, tolerance=1e-5) for _ in range(1))
    assert windows(monkeypatch, by_force) == [[12, 24, 25]]
    assert windows(monkeypatch, by_approach) == [[5, 6, 12, 24, 25]]


class Cells:
    """Cells that do not feel each other: u = p / 4, and an approximate inverse of anybody's choice."""

    stiffness = 4.0

    def __init__(self, inverse, compliance=0.25):
        self.inverse, self.compliance = inverse, compliance

    def displacement(self, pressure):
        return self.compliance * pressure


def downhill(inverse, pressure, w, memory=None, *, load=None, length=0.5):
    cells, load = Cells(inverse), load or Load(overlap=1.0)
    return projected_cg._downhill(cells, np.array(pressure), np.array(w), load, memory or Memory(len(w)), length)


@pytest.mark.parametrize("wrong", [-3.0, 0.0], ids=["uphill", "nowhere"])
def test_where_the_inverse_leads_nowhere_the_gradient_is_followed(wrong):
    """p + length * stiffness * (-w) on free cells, and back to p >= 0: a step that says that it is cut."""
    step = downhill(lambda u: wrong * u, [1.0, 1.0, 0.0, 0.0], [0.25, -0.5, -0.125, 0.5])
    assert step.change == pytest.approx([-0.5, 1.0, 0.25, 0.0])
    assert step.gain == pytest.approx(0.125 + 0.5 + 0.03125)
    assert step.cut


def test_under_a_force_the_gradient_keeps_it():
    """(1.5, 1.5, 0) less a third of the excess each, 2 of 3; of cells beside a higher one that much is left."""
    step = downhill(lambda u: -u, [1.0, 1.0, 0.0], [0.0, -0.5, -0.25], load=Load(total=2.0))
    assert step.change == pytest.approx([-0.5, 0.5, 0.0])
    assert step.gain == pytest.approx(0.25)


def test_a_solution_has_no_way_down():
    assert downhill(lambda u: 4 * u, [1.0, 0.0], [0.0, 0.5]) is None


def test_cells_are_free_under_pressure_or_overlap_and_not_where_they_just_touch():
    """The inverse, which spreads, may press no other."""
    step = downhill(lambda u: u + 1.0, [1.0, 0.0, 0.0, 0.0], [0.0, -0.5, 0.0, 0.5])
    assert (step.change != 0).tolist() == [True, True, False, False]
    assert step.change[1] == pytest.approx(0.5 * 1.5)


@pytest.mark.parametrize("second", [-0.25, -0.5], ids=["uphill", "level"])
def test_steps_that_lead_uphill_are_forgotten(second):
    """A remembered step whose image lies makes the next direction no way down: it goes, with all others."""
    memory, w = Memory(2), np.array([-0.5, second])
    memory.add(np.array([1.0, 0.0]), np.array([1.0, 20.0]))
    assert not np.array_equal(memory.improve(-w, -w), -w)
    step = downhill(lambda u: 4 * u, [1.0, 1.0], w, memory)
    assert step.change == pytest.approx([1.0, -2 * second])
    assert not step.cut
    assert np.array_equal(memory.improve(-w, -w), -w)


def test_an_operator_that_answers_nothing_ends_the_iteration():
    cells = Cells(lambda u: u, compliance=0.0)
    states = projected_cg.projected_cg(cells, np.ones(2), np.zeros(2), Load(overlap=1.0))
    assert len(list(itertools.islice(states, 9))) == 1


@pytest.mark.parametrize(
    ("cut", "best", "length", "taken", "following"),
    [
        # not cut: as far as is best, to the first bound at 1.6; the length follows by a factor of 2 at most
        (False, 0.25, 0.4, 0.25, 0.2),
        (False, 0.75, 0.4, 0.75, 0.3),
        (False, 1.5, 0.4, 1.5, 0.6),
        (False, 1.9, 0.4, 1.6, 0.76),
        (False, 3.0, 0.4, 1.6, 0.8),
        # cut, and good: whole, and the length at least as long, towards 0.4
        (True, 0.65, 0.1, 1.0, 0.2),
        (True, 0.9, 0.3, 1.0, 0.4),
        (True, 5.0, 0.7, 1.0, 0.7),
        # cut, and too long: its best part, and the length shorter by half at most
        (True, 0.64, 0.4, 0.64, 0.256),
        (True, 0.3, 0.4, 0.3, 0.2),
    ],
)
def test_how_much_of_a_step_is_taken(cut, best, length, taken, following):
    step = IterationStep(np.array([-1.0, -2.0, 1.0, 0.0]), 1.0, cut)
    found = projected_cg._taken(step, best, np.array([1.6, 3.6, 0.0, 0.0]), length)
    assert found == pytest.approx((taken, following))


@pytest.mark.parametrize("size", [1.0, 2.0**20, 2.0**-20])
@pytest.mark.parametrize(("left", "stays"), [(0.0, True), (0.9e-10, True), (1.1e-10, False), (1.9e-10, False)])
def test_a_remembered_step_that_adds_nothing_stays_out(size, left, stays):
    """Of two steps, the second is a multiple of the first but for so much of its own square."""
    gram = [[size, size, 0.0], [size, size * (1 + left), 0.0], [0.0, 0.0, 3 * size]]
    found = projected_cg.solved([row[:] for row in gram], [size, size * (1 + left / 2), 6 * size])
    assert found[2] == 2.0
    if stays:
        assert found[:2] == [1.0, 0.0]
    else:
        assert found[:2] == pytest.approx([0.5, 0.5], rel=1e-4)


def test_steps_that_are_nothing_stay_out():
    assert projected_cg.solved([[0.0, 0.0], [0.0, 2.0]], [0.0, 3.0]) == [0.0, 1.5]


def falling(factor, every):
    """Residuals that fall by a factor every so many iterations, at a pressure that stays."""

    def states(cells, pressure, separation, load, length=0.4):
        return (projected_cg.State(pressure, separation, 1.0, 0.5 * factor ** (i // every)) for i in itertools.count())

    return states


def iterations_of_press(monkeypatch, states, tolerance, most):
    monkeypatch.setattr(window_solve, "projected_cg", states)
    half_space = bem3d.HalfSpace(shape=(2, 2), spacing=1.0, modulus=1.0)
    cells, attempt = (
        window_solve.Candidates(half_space, np.ones((2, 2), dtype=bool)),
        window_solve.IterationState(np.zeros((2, 2)), 0.0),
    )
    field = np.ones((2, 2))
    window_solve._iterate(cells, field, field, Load(overlap=1.0), attempt, tolerance, most)
    assert attempt.operator_applications == len(attempt.history)
    assert attempt.status is None
    return len(attempt.history)


def iterations_of_rolling(monkeypatch, states, tolerance, most):
    monkeypatch.setattr(rolling, "projected_cg", states)
    track = bem3d.Track(height=np.zeros((40, 40)), **TRACK)
    wheel = bem3d.RollingContact(track, tolerance=tolerance, max_iterations=most)
    frame, attempt = rolling.Frame(track, ((0, 4), (18, 22))), rolling.IterationState(np.zeros((4, 4)), 0.0)
    field = np.ones((4, 4))
    wheel._iterated(frame, field > 0, field, field, Load(overlap=1.0), attempt)
    assert attempt.operator_applications == len(attempt.history) - 1
    assert attempt.status is None
    return len(attempt.history) - 1


@pytest.mark.parametrize(("count", "patience"), [(iterations_of_press, 100), (iterations_of_rolling, 30)])
def test_patience_ends_where_the_residual_has_not_halved(count, patience, monkeypatch):
    """By 0.45 in as many iterations is enough, for ever; by 0.6 is not, and the iteration ends at the next."""
    assert count(monkeypatch, falling(0.45, patience + 1), 0.11, 10**6) == 2 * patience + 2
    assert count(monkeypatch, falling(0.45, patience + 1), 0.05, 10**6) == 3 * patience + 3
    assert count(monkeypatch, falling(0.6, patience + 1), 1e-9, 10**6) == patience + 1
    assert count(monkeypatch, falling(0.45, patience + 2), 1e-9, 10**6) == patience + 1
    assert count(monkeypatch, falling(0.9, 1), 0.04, 10**6) == 24
    assert count(monkeypatch, falling(0.9, 1), 0.04, 7) in (7, 8)


def rounds_of_press(monkeypatch, errors):
    """Of a punch with a flat face, which all cells touch: iterations that leave an error of so much, in turn."""
    half_space, depth = bem3d.HalfSpace(shape=(4, 4), spacing=1.0, modulus=1.0), 1.0
    exact = np.linalg.solve(oracles.dense_operator(half_space), np.full(16, depth)).reshape(4, 4)
    monkeypatch.setattr(window_solve, "_iterate", lambda *_: (1 + next(errors)) * exact)
    problem = bem3d.problem.Problem(half_space=half_space, gap=np.zeros((4, 4)), approach=depth)
    attempt = window_solve.solve_on_window(problem, window_solve.InitialGuess((1 + next(errors)) * exact), 1e-6, 99)
    return attempt.operator_applications, str(attempt.status)


def rounds_of_rolling(monkeypatch, errors):
    """The same of a wheel so large that it is flat, on a frame of which it touches all."""
    track = bem3d.Track(height=np.zeros((9, 9)), spacing=1.0, radius=1e12, modulus=1.0)
    wheel, frame = (
        bem3d.RollingContact(track, tolerance=1e-6, max_iterations=99),
        rolling.Frame(track, ((-2, 2), (2, 6))),
    )
    exact = np.linalg.solve(oracles.dense_operator(frame.half_space), np.ones(16)).reshape(4, 4)

    def iterated(*given):
        given[-1].history.append(0.0)
        return (1 + next(errors)) * exact

    monkeypatch.setattr(wheel, "_iterated", iterated)
    attempt = rolling.IterationState(np.zeros(0), 0.0)
    start = rolling.FramePressure.by(frame, (1 + next(errors)) * exact)
    wheel._pressed(frame, np.zeros((4, 4)), Load(overlap=1.0), start, 1.0, attempt)
    return attempt.operator_applications, str(attempt.status)


@pytest.mark.parametrize("rounds", [rounds_of_press, rounds_of_rolling])
def test_rounds_end_where_a_fresh_residual_is_not_half_of_the_last(rounds, monkeypatch):
    """The residual is the error: by 0.48 a round to 1e-6 takes 19 of them; 0.52 is not enough."""
    first = rounds is rounds_of_press
    assert rounds(monkeypatch, (0.48**i for i in range(99))) == (19 + first, "converged")
    assert rounds(monkeypatch, (0.52**i for i in range(99))) == (2, "stagnation")
    assert rounds(monkeypatch, iter([1.0, 0.4, 0.1, 0.07, 0.0])) == (3 + first, "stagnation")


@pytest.mark.parametrize(
    ("padded", "small"),
    [
        ((256, 254), True),
        ((256, 256), False),
        ((64, 1022), True),
        ((66, 1022), False),
        ((512, 126), True),
        ((1024, 64), False),
    ],
)
def test_a_spectrum_of_32768_numbers_is_kept_as_a_whole(padded, small):
    """Half of the waves along the second axis, and the one at the middle."""
    symbol = np.ones((padded[0] // 2 + 1, padded[1] // 2 + 1))
    found = convolution.padded_convolution(symbol, shape=(2, 2), padded=padded, planning="estimate")
    assert type(found) is (convolution.CachedConvolution if small else convolution.PaddedConvolution)


def test_the_last_four_windows_are_kept_with_their_plans():
    half_space = bem3d.HalfSpace(shape=(9, 9), spacing=1.0, modulus=1.0)
    windows = [half_space.like(shape=(n, 5)) for n in range(2, 6)]
    assert half_space.like(shape=(9, 9)) is half_space
    assert all(half_space.like(shape=window.shape) is window for window in windows)
    half_space.like(shape=(2, 5))
    half_space.like(shape=(6, 5))  # in the place of the one that was asked for longest ago
    assert half_space.like(shape=(2, 5)) is windows[0]
    assert half_space.like(shape=(5, 5)) is windows[3]
    assert half_space.like(shape=(3, 5)) is not windows[1]


def test_a_window_remembers_three_steps():
    """A direction is made conjugate to the last three, by an operator that is diagonal: none of them is in it."""
    memory, stiffness = Memory(5), np.array([1.0, 2.0, 3.0, 4.0, 5.0])
    left = np.ones(5)
    for newest in range(5):
        step = 8.0 * (np.arange(5) == newest)
        memory.add(step, stiffness * step)
        left = 1.0 * ((np.arange(5) > newest) | (np.arange(5) < newest - 2))
        assert memory.improve(np.ones(5), np.zeros(5)) == pytest.approx(left, abs=1e-15)
    # what lies in the steps themselves is gained at once
    assert memory.improve(np.zeros(5), np.full(5, 6.0)) == pytest.approx([0, 0, 2.0, 1.5, 1.2])
