"""How much a solve costs, in operator applications: counts are deterministic, and kept in ranges."""

import numpy as np
import pytest

import bem3d
import mdr


def sphere(n, **prescribed):
    """a = n/4 cells, E* = R = 1 on a grid of side 1."""
    x = (np.arange(n) + 0.5) / n - 0.5
    half_space = bem3d.HalfSpace(shape=(n, n), spacing=1 / n, modulus=1.0)
    return half_space, (x[:, np.newaxis] ** 2 + x**2) / 2


def self_affine(n, *, periodic):
    """H = 0.7 from 2 pi / L to four cells a wave."""
    band = mdr.SelfAffine(hurst=0.7, q_min=2 * np.pi, q_max=2 * np.pi * n / 4, rms=0.01)
    height = bem3d.rough_surface(band.c2d, shape=(n, n), spacing=1 / n, rng=np.random.default_rng(3), rms=0.01)
    return bem3d.HalfSpace(shape=(n, n), spacing=1 / n, modulus=1.0, periodic=periodic), -height


BOTH = ({"approach": 1 / 16}, {"force": 4 / 3 / 64})


@pytest.mark.parametrize("prescribed", BOTH)
def test_sphere_costs_the_same_on_any_grid(prescribed):
    """At most 20 applications to 1e-8 from a cold start, growing by no more than 3 from 128 to 1024 cells a side."""
    counts = []
    for n in (128, 256, 512, 1024):
        half_space, gap = sphere(n)
        contact = bem3d.solve(half_space, gap, **prescribed, tolerance=1e-8)
        counts.append(contact.operator_applications)
        if n < 1024:  # what the solver says, by the whole grid
            w = gap + half_space.displacement(contact.pressure) - contact.approach
            assert bem3d.residual(contact.pressure, w, contact.approach - gap.min()) <= 1e-8
    assert max(counts) <= 20
    assert counts[-1] - counts[0] <= 3


def test_textbook_iteration_grows_with_the_grid():
    """The negative control of the test above."""
    counts = [
        bem3d.solve_polonsky_keer(*sphere(n), approach=1 / 16, tolerance=1e-8).operator_applications for n in (64, 256)
    ]
    assert counts[1] > 1.5 * counts[0] > 90


def test_textbook_iteration_costs_what_it_does():
    """Two applications an iteration: from the overlap to 1e-8 about 55 of them, from a uniform pressure about 35."""
    by_approach, by_force = (bem3d.solve_polonsky_keer(*sphere(128), **load, tolerance=1e-8) for load in BOTH)
    assert 100 <= by_approach.operator_applications <= 120
    assert 60 <= by_force.operator_applications <= 80


@pytest.mark.parametrize("periodic", [True, False])
@pytest.mark.parametrize("n", [256, 512, 1024])
def test_rough_contact_costs_forty_at_most(n, periodic):
    half_space, gap = self_affine(n, periodic=periodic)
    by_force = bem3d.solve(half_space, gap, force=0.008, tolerance=1e-6)
    assert 0.03 < by_force.area < 0.1
    by_approach = bem3d.solve(half_space, gap, approach=by_force.approach, tolerance=1e-6)
    assert max(by_force.operator_applications, by_approach.operator_applications) <= 40
    assert len(by_force.coarse_applications) == round(np.log2(n / 16))


@pytest.mark.parametrize("periodic", [True, False])
def test_load_path(periodic):
    """24 loads over three decades, up to a tenth of the area: 13 applications a load on average, but up to 20 at the
    largest loads, where a third of the contact is new at each; the stiffness costs half as much again."""
    half_space, gap = self_affine(256, periodic=periodic)
    forces = np.geomspace(1.2e-5, 1.2e-2, 24)
    contacts = list(bem3d.indent(half_space, gap, forces=forces, stiffness=True))
    assert 0.09 < contacts[-1].area < 0.12
    solves = np.array([contact.operator_applications for contact in contacts])
    both = solves + [contact.frozen.operator_applications for contact in contacts]
    assert solves.mean() <= 14
    assert solves.max() <= 24
    assert both.mean() <= 22
    assert both.max() <= 36
    light = forces < 1.2e-3
    assert solves[light].max() <= 15
    assert both[light].max() <= 25


@pytest.mark.parametrize("by", ["approach", "force"])
def test_nothing_but_the_window_is_transformed(by, monkeypatch):
    """A sphere in the corner of a large grid: the operator is applied on a window of 2.8 a and a little, no more."""
    n, a = 256, 12
    x = np.arange(n) - 40.0
    gap = (x[:, np.newaxis] ** 2 + x**2) / 2
    half_space = bem3d.HalfSpace(shape=(n, n), spacing=1.0, modulus=1.0)
    shapes = []
    apply = bem3d.HalfSpace.apply
    monkeypatch.setattr(bem3d.HalfSpace, "apply", lambda self, p: shapes.append(self.shape) or apply(self, p))
    contact = bem3d.solve(half_space, gap, **{by: a**2 if by == "approach" else 4 / 3 * a**3}, tolerance=1e-8)
    assert max(shape[0] for shape in shapes if shape[0] <= 64) < 3.4 * a
    assert (n, n) not in shapes
    assert contact.force == pytest.approx(4 / 3 * a**3, rel=1e-2)
