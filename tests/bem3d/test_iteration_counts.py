"""What a solve costs in operator applications, as upper bounds; and the windows it works on.

Counts are deterministic, and rounding does not change them. A solver that needs fewer passes.
"""

import numpy as np
import pytest

import bem3d
import mdr

TRACK = {"spacing": 1 / 8, "radius": 1.0, "modulus": 1.0}
HERTZ = 4 / 3
"""Force on a sphere of E* = R = 1 at an approach of 1."""
BOTH = ({"approach": 1 / 16}, {"force": HERTZ / 64})


def sphere(n, middle=(0.0, 0.0)):
    """E* = R = 1 on a grid of side 1, so many cells from the middle; a = n/4 cells under `BOTH`."""
    x, y = ((np.arange(n) + 0.5 - m) / n - 0.5 for m in middle)
    return bem3d.HalfSpace(shape=(n, n), spacing=1 / n, modulus=1.0), (x[:, np.newaxis] ** 2 + y**2) / 2


def self_affine(n, *, periodic):
    """H = 0.7 from 2 pi / L to four cells a wave."""
    band = mdr.SelfAffine(hurst=0.7, q_min=2 * np.pi, q_max=2 * np.pi * n / 4, rms=0.01)
    height = bem3d.rough_surface(band.c2d, shape=(n, n), spacing=1 / n, rng=np.random.default_rng(3), rms=0.01)
    return bem3d.HalfSpace(shape=(n, n), spacing=1 / n, modulus=1.0, periodic=periodic), -height


def smoothed_noise(shape, *, rms, seed=3):
    """White noise through a few running means: smooth from cell to cell."""
    h = np.random.default_rng(seed).normal(size=shape)
    for axis in (0, 1):
        for _ in range(3):
            h = h + 0.9 * np.roll(h, 1, axis) + 0.9 * np.roll(h, -1, axis)
    return rms * (h - h.mean()) / h.std()


@pytest.mark.slow
@pytest.mark.parametrize("prescribed", BOTH)
def test_sphere_costs_the_same_on_any_grid(prescribed):
    """At most 20 applications to 1e-8 from a cold start, growing by no more than 3 from 128 to 512 cells a side."""
    counts = []
    for n in (128, 256, 512):
        half_space, gap = sphere(n)
        contact = bem3d.solve(half_space, gap, **prescribed, tolerance=1e-8)
        counts.append(contact.operator_applications)
        # what the solver says, by the whole grid
        w = gap + half_space.displacement(contact.pressure) - contact.approach
        assert bem3d.residual(contact.pressure, w, contact.approach - gap.min()) <= 1e-8
    assert max(counts) <= 20
    assert counts[-1] - counts[0] <= 3


@pytest.mark.slow
@pytest.mark.parametrize("periodic", [True, False])
@pytest.mark.parametrize("n", [256, 512])
def test_rough_contact_costs_forty_at_most(n, periodic):
    half_space, gap = self_affine(n, periodic=periodic)
    by_force = bem3d.solve(half_space, gap, force=0.008, tolerance=1e-6)
    assert 0.03 < by_force.area < 0.1
    by_approach = bem3d.solve(half_space, gap, approach=by_force.approach, tolerance=1e-6)
    assert max(by_force.operator_applications, by_approach.operator_applications) <= 40
    assert len(by_force.coarse_applications) == round(np.log2(n / 32))


# Solves of a few thousand cells


def rough(shape, periodic):
    """A rough half-space and its gap."""
    half_space = bem3d.HalfSpace(shape=shape, spacing=1 / 64, modulus=1.0, periodic=periodic)
    return half_space, -smoothed_noise(shape, rms=0.01)


def applications(contact):
    """On the grid of a contact, on coarser ones, and for its stiffness."""
    coarse = sum(count for _, count in contact.coarse_applications)
    return contact.operator_applications + coarse + (contact.frozen.operator_applications if contact.frozen else 0)


def cold(shape, periodic):
    """By a force, and by the approach that comes of it."""
    problem = rough(shape, periodic)
    by_force = bem3d.solve(*problem, force=0.004, tolerance=1e-8)
    return [by_force, bem3d.solve(*problem, approach=by_force.approach, tolerance=1e-8)]


def warm(shape, periodic):
    """From a contact under two thirds of the force, from its pressure alone, and by an approach of 2 % more."""
    problem = rough(shape, periodic)
    start = bem3d.solve(*problem, force=0.004, tolerance=1e-8)
    harder = start.approach + 0.02 * abs(start.approach)
    return [
        bem3d.solve(*problem, force=0.006, start=start, tolerance=1e-8),
        bem3d.solve(*problem, force=0.006, start=start.pressure, tolerance=1e-8),
        bem3d.solve(*problem, approach=harder, start=start, tolerance=1e-8),
    ]


def load_path(by, stiffness, periodic):
    """Up five loads and down again, every other of them."""
    loads = np.geomspace(1e-4, 6e-3, 5)
    if by == "approaches":
        loads = [contact.approach for contact in bem3d.indent(*rough((40, 33), periodic), forces=loads)]
    return bem3d.indent(*rough((40, 33), periodic), **{by: [*loads, *loads[::-2]]}, stiffness=stiffness)


def path_from_nothing(periodic):
    """From no load at all, up again, down to nothing and back: only a loaded contact predicts the next."""
    loads = [0.0, 1e-3, 2e-3, 2.5e-3, 2.5e-3, 0.0, 2e-3, 3e-3]
    return bem3d.indent(*rough((40, 33), periodic), forces=loads)


def off_the_middle(load):
    """a = 16 cells of 128, the middle at no point of symmetry of a cell."""
    return [bem3d.solve(*sphere(128, (-0.3, 0.4)), **load, tolerance=1e-8)]


@pytest.mark.parametrize(
    ("solves", "given", "most"),
    [
        (cold, ((40, 33), False), 37),
        (cold, ((40, 33), True), 33),
        (cold, ((65, 47), False), 45),
        (cold, ((65, 47), True), 40),
        (warm, ((40, 33), False), 50),
        (warm, ((40, 33), True), 46),
        (warm, ((65, 47), False), 46),
        (warm, ((65, 47), True), 42),
        (load_path, ("forces", False, False), 98),
        (load_path, ("forces", False, True), 84),
        (load_path, ("forces", True, False), 124),
        (load_path, ("forces", True, True), 115),
        (load_path, ("approaches", False, False), 76),
        (load_path, ("approaches", False, True), 67),
        (load_path, ("approaches", True, False), 109),
        (load_path, ("approaches", True, True), 98),
        (path_from_nothing, (False,), 75),
        (path_from_nothing, (True,), 72),
        (off_the_middle, ({"approach": 1 / 64},), 24),
        (off_the_middle, ({"force": HERTZ / 512},), 27),
    ],
)
def test_a_solve_costs_no_more_than(solves, given, most):
    """A twentieth more than it did."""
    assert sum(applications(contact) for contact in solves(*given)) <= most


@pytest.mark.parametrize(
    ("by", "rms", "positions", "most"),
    [("force", 0.02, 4, 40), ("force", 0.3, 40, 425), ("approach", 0.02, 4, 45), ("approach", 0.3, 40, 485)],
)
def test_a_rolling_wheel_costs_no_more_than(by, rms, positions, most):
    track = bem3d.Track(height=smoothed_noise((60, 40), rms=rms, seed=5), **TRACK)
    wheel = bem3d.RollingContact(track, tolerance=1e-6)
    contacts = [wheel.carry(i, HERTZ) if by == "force" else wheel.press(i, 1.0) for i in range(positions)]
    assert sum(contact.operator_applications for contact in contacts) <= most


# The windows that are transformed, and how wide each is


@pytest.mark.parametrize("by", ["approach", "force"])
def test_nothing_but_the_window_is_transformed(by, monkeypatch):
    """A sphere in the corner of a large grid: from nothing, from a contact and along a path, 2.8 a and a little."""
    n, a = 256, 12
    x = np.arange(n) - 40.0
    gap = (x[:, np.newaxis] ** 2 + x**2) / 2
    half_space = bem3d.HalfSpace(shape=(n, n), spacing=1.0, modulus=1.0)
    load = a**2 if by == "approach" else 4 / 3 * a**3
    shapes = []
    apply = bem3d.HalfSpace.apply
    monkeypatch.setattr(bem3d.HalfSpace, "apply", lambda self, p: shapes.append(self.shape) or apply(self, p))
    contact = bem3d.solve(half_space, gap, **{by: load}, tolerance=1e-8)
    assert contact.force == pytest.approx(4 / 3 * a**3, rel=1e-2)
    bem3d.solve(half_space, gap, **{by: 0.9 * load}, tolerance=1e-8, start=contact)
    list(bem3d.indent(half_space, gap, **{"forces" if by == "force" else "approaches": [0.7 * load, load]}))
    assert max(shape[0] for shape in shapes if shape[0] <= 64) < 3.4 * a
    assert (n, n) not in shapes
