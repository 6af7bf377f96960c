"""A sphere rolled over a strip by boundary elements: against cold solves, and against linear theory."""

import math

import numpy as np
import pytest

import bem3d
from bem3d.blocked_convolution import BlockedConvolution
from bem3d.convolution import CachedConvolution
from tests.seeded import Times, catches
from validation.theory.rolling import linear_force, response

TOLERANCE = 1e-6
HERTZ = 4 / 3
SPHERE = {"radius": 1.0, "modulus": 1.0}
"""Radius of contact 1 at an approach of 1, E* = 1."""
# an error of the residual r in the gaps is one of r s in the approach, whose force is 2 E* a r s to leading order;
# twice that and more where the contact is ragged, and of either of both forces that are compared
ERROR = 10 * TOLERANCE


def strip(cells, rms, *, length=4.0, width=4.4, seed=0, waves=4):
    """Waves no shorter than a contact radius or so: smooth on every grid, the same on each of them."""
    rng = np.random.default_rng(seed)
    nx, ny = round(length * cells), round(width * cells)
    x = 2 * np.pi * (np.arange(nx) + 0.5)[:, np.newaxis] / nx
    y = 2 * np.pi * (np.arange(ny) + 0.5) / ny
    k, m = rng.integers(1, waves, 12), rng.integers(-waves, waves, 12)
    phase = rng.uniform(0, 2 * np.pi, 12)
    h = sum(np.cos(k[i] * x + m[i] * y + phase[i]) for i in range(12))
    return rms * h / h.std()


def noisy(cells, rms, *, seed=0, length=4.0, width=4.4):
    """White to the cell: no position tells anything of the next."""
    return rms * np.random.default_rng(seed).normal(size=(round(length * cells), round(width * cells)))


def cold(height, spacing, position, **prescribed):
    """On all of the strip, with the wheel over the middle: no frame, no start."""
    (nx, ny), (dx, dy) = height.shape, np.broadcast_to(spacing, 2)
    rows = np.arange(nx) - nx // 2
    x, y = rows * dx, (np.arange(ny) - (ny - 1) / 2) * dy
    gap = (x[:, np.newaxis] ** 2 + y**2) / 2 - height.take(rows + position, axis=0, mode="wrap")
    body = bem3d.HalfSpace(shape=(nx, ny), spacing=(dx, dy), modulus=1.0)
    return bem3d.solve(body, gap, tolerance=TOLERANCE, **prescribed)


STRIPS = {
    "flat": 0 * strip(6, 1.0),
    "smooth": strip(8, 0.05),
    "rough": noisy(7, 0.1),
    "very rough": strip(6, 0.4),
    "as rough as deep": noisy(6, 1.0, length=9.0, width=8.0),
}
CELLS = {"flat": 6, "smooth": 8, "rough": 7, "very rough": 6, "as rough as deep": 6}


@catches("x^2 / R under the sphere", name="smooth", by="approach").at("bem3d.Track.wheel", Times(2.0))
@catches("the wheel half a cell ahead", name="smooth", by="approach").at(
    "bem3d.Track.along", lambda track, rows: (np.asarray(rows) + 0.5) * track.steps[0]
)
@catches("the wheel half a cell aside", name="smooth", by="approach").at(
    "bem3d.Track.across",
    lambda track, columns: (np.asarray(columns) - track.height.shape[1] / 2) * track.steps[1],
)
@pytest.mark.slow
@pytest.mark.parametrize("name", STRIPS)
@pytest.mark.parametrize("by", ["approach", "force"])
def test_each_position_is_that_of_a_cold_solve(name, by):
    height, spacing = STRIPS[name], 1 / CELLS[name]
    prescribed = {by: 1.0 if by == "approach" else HERTZ}
    positions = 24
    found = bem3d.roll(height, spacing=spacing, **SPHERE, **prescribed, tolerance=TOLERANCE, positions=positions)
    assert found.converged.all()
    assert (found.residual <= TOLERANCE).all()
    assert found.force.shape == (positions,)
    for position in range(0, positions, 3):
        contact = cold(height, spacing, position, **prescribed)
        overlap = contact.approach - contact.problem.first_touch
        assert found.force[position] == pytest.approx(contact.force, rel=ERROR * overlap)
        assert found.approach[position] == pytest.approx(contact.approach, abs=ERROR * overlap)
        # cells that just touch may be counted or not
        assert found.area[position] == pytest.approx(contact.area, abs=2 * spacing**2)


@pytest.mark.parametrize("name", STRIPS)
def test_a_prescribed_force_is_borne_at_every_position(name):
    found = bem3d.roll(STRIPS[name], spacing=1 / CELLS[name], **SPHERE, force=0.7, positions=12)
    assert np.abs(found.force / 0.7 - 1).max() <= 1e-12


def test_there_is_no_pressure_before_a_position_is_solved():
    wheel = bem3d.RollingContact(bem3d.Track(height=STRIPS["flat"], spacing=1 / 6, **SPHERE), max_iterations=1)
    with pytest.raises(ValueError, match="there is no pressure"):
        wheel.pressure()
    assert not wheel.carry(0, HERTZ).converged
    with pytest.raises(ValueError, match="there is no pressure"):
        wheel.pressure()


@pytest.mark.parametrize("offset", [-3.0, 2.0])
def test_the_plane_from_which_heights_count_does_not_matter_under_a_force(offset):
    """Far below it, where the smooth sphere would not touch, or above."""
    height = STRIPS["rough"]
    settings = {"spacing": 1 / 7, **SPHERE, "force": HERTZ, "positions": 6, "tolerance": TOLERANCE}
    plain, moved = (bem3d.roll(h, **settings) for h in (height, height + offset))
    assert moved.approach == pytest.approx(plain.approach - offset, abs=2 * ERROR)
    assert np.abs(moved.area - plain.area).max() <= 2 / 7**2


@pytest.mark.parametrize(("unit", "metre"), [(2.0**38, 2.0**-10), (210e9, 1e-3), (1e-3, 1e6)])
def test_units_do_not_matter(unit, metre):
    """F ~ E* l^2, whichever is prescribed."""
    height = noisy(6, 0.2)
    here = {"spacing": 1 / 6, **SPHERE, "positions": 8, "tolerance": TOLERANCE}
    there = {**here, "spacing": metre / 6, "radius": metre, "modulus": unit}
    one = bem3d.roll(height, **here, approach=1.0)
    other = bem3d.roll(metre * height, **there, approach=metre)
    assert other.force / (unit * metre**2) == pytest.approx(one.force, rel=ERROR)
    one = bem3d.roll(height, **here, force=1.0)
    other = bem3d.roll(metre * height, **there, force=unit * metre**2)
    assert other.approach / metre == pytest.approx(one.approach, abs=ERROR)


def pairs(wave, height, cells, *, positions):
    """Forces on a wave, on its mirror image, and on the plane: their odd and even parts."""
    settings = {"spacing": 1 / cells, **SPHERE, "approach": 1.0, "tolerance": 1e-7, "positions": positions}
    up, down = (bem3d.roll(sign * height * wave, **settings).force for sign in (1, -1))
    flat = bem3d.roll(0 * wave, **{**settings, "positions": 1}).force[0]
    return (up - down) / 2, (up + down) / 2 - flat


@catches("factor 2 lost in linear theory, seen by boundary elements", waves=1).at(f"{__name__}.response", Times(0.5))
@pytest.mark.slow
@pytest.mark.parametrize("waves", [1, 2])
def test_ridges_across_the_track_tend_to_the_filter(waves):
    """(14.11) is exact in 3D for ridges: q a = pi / 2, and q a = pi, a zero of it. By cells, at first order at least.

    Of a contact of n cells to a radius, a part of order 1 / n lies in cells that are cut by its edge.
    """
    errors, counts = [], np.array([8, 16, 32])
    for cells in counts.tolist():
        x = np.arange(4 * cells) / cells
        q = np.pi / 2 * waves
        wave = np.repeat(np.cos(q * x + 0.4)[:, np.newaxis], 2 * math.ceil(1.2 * cells), axis=1)
        odd, _ = pairs(wave, 0.02, cells, positions=cells)
        exact = float(response(q, contact_radius=1.0, modulus=1.0)) * np.cos(q * x + 0.4)
        errors.append(np.abs(odd / 0.02 - exact[:cells]).max() / 2)
    assert (np.array(errors) <= 0.1 / counts).all()
    assert -np.polyfit(np.log(counts), np.log(errors), 1)[0] >= 0.8


@pytest.mark.slow
def test_the_odd_part_is_linear_theory_and_the_even_part_of_second_order():
    """F(h) - F(0) by orders, on a grid that is the same for all heights.

    (F(h) - F(-h)) / 2 is the linear force, but for the grid, and leaves it at third order in h;
    (F(h) + F(-h)) / 2 - F(0) is of second order. Cells that come and go cost some of either.
    """
    cells, positions = 16, 16
    wave = strip(cells, 1.0, width=2.8, waves=2)
    heights = np.array([0.08, 0.04, 0.02])
    exact = linear_force(wave, spacing=1 / cells, **SPHERE, approach=1.0)[:positions] - HERTZ
    odd, even = zip(*(pairs(wave, h, cells, positions=positions) for h in heights), strict=True)

    def rms(values):
        return np.sqrt(np.mean(np.square(values)))

    second = np.log([rms(part) for part in even])
    assert np.diff(second) / np.diff(np.log(heights)) == pytest.approx(2, abs=0.25)
    slopes = [part / h for part, h in zip(odd, heights, strict=True)]
    assert np.log2(rms(slopes[0] - slopes[1]) / rms(slopes[1] - slopes[2])) >= 1.5
    assert rms(slopes[-1] - exact) <= 0.02 * rms(exact)


def bumpy(*, row, column=0.0, cells=6, tall=4.0):
    """A flat strip with one tall bump, of a cell, so many radii from where the wheel starts."""
    height = np.zeros((14 * cells, 9 * cells))
    height[round(row * cells), round((4.5 + column) * cells)] = tall
    return height


@catches("a frame that is trusted", by="approach", column=0.0).at("bem3d.rolling_frame.Frame.outside", lambda *_: None)
@pytest.mark.slow
@pytest.mark.parametrize("by", ["approach", "force"])
@pytest.mark.parametrize("column", [0.0, 1.5, -2.0])
def test_a_bump_far_ahead_is_touched_before_the_frame_has_reached_it(by, column):
    """The bump rises above the sphere at a distance of 2.9 radii or so, and the frame is hardly wider than one."""
    height, prescribed = bumpy(row=5, column=column), {by: 1.0 if by == "approach" else HERTZ}
    settings = {"spacing": 1 / 6, **SPHERE, "tolerance": TOLERANCE}
    found = bem3d.roll(height, **settings, **prescribed, positions=40)
    answer = found.approach if by == "force" else found.force
    touched = np.abs(answer / answer[0] - 1) > 1e-3
    assert 0 < np.flatnonzero(touched)[0] < 6 * (5 - 1.5)
    for position in (*range(np.flatnonzero(touched)[0] - 1, 40, 3),):
        contact = cold(height, 1 / 6, position, **prescribed)
        overlap = contact.approach - contact.problem.first_touch
        assert found.force[position] == pytest.approx(contact.force, rel=ERROR * overlap)
        assert found.approach[position] == pytest.approx(contact.approach, abs=ERROR * overlap)


@pytest.mark.parametrize("row", [3, 9, 10, 11])
def test_a_contact_longer_than_the_track_meets_the_same_roughness_again(row):
    """A bump half a track away touches ahead of the wheel, and its image behind: as on the track laid down thrice."""
    height = np.zeros((20, 54))
    height[row, 27] = 6.0
    once = bem3d.roll(height, spacing=1 / 6, **SPHERE, approach=1.0, tolerance=1e-8, positions=3)
    thrice = bem3d.roll(np.tile(height, (3, 1)), spacing=1 / 6, **SPHERE, approach=1.0, tolerance=1e-8, positions=3)
    assert once.force == pytest.approx(thrice.force, rel=1e-6)


@pytest.mark.parametrize("prescribed", [{"force": 0.01}, {"approach": 0.05}])
def test_a_contact_that_the_wheel_leaves_behind(prescribed):
    """A lone spike carries all; one position on it is gone, and there is nothing to begin with."""
    height = np.zeros((40, 20))
    height[20, 10] = 0.5
    settings = {"spacing": 0.25, **SPHERE, **prescribed, "tolerance": 1e-8}
    found = bem3d.roll(height, **settings)
    for position in range(14, 27):
        alone = bem3d.roll(np.roll(height, -position, axis=0), **settings, positions=1)
        assert found.force[position] == pytest.approx(alone.force[0], rel=1e-5, abs=1e-9)
        assert found.approach[position] == pytest.approx(alone.approach[0], rel=1e-5)


def test_a_position_that_does_not_converge_is_marked_and_the_wheel_goes_on():
    """So few iterations are enough for a flat track but not for the rough part of it."""
    height = np.concatenate([noisy(6, 0.0), noisy(6, 0.0), noisy(6, 0.3), noisy(6, 0.0), noisy(6, 0.0)])
    settings = {"spacing": 1 / 6, **SPHERE, "approach": 1.0, "tolerance": 1e-4}
    found = bem3d.roll(height, **settings, max_iterations=12, raise_on_failure=False)
    assert np.array_equal(found.converged, found.residual <= 1e-4)
    assert found.converged[:24].all()
    assert not found.converged[48:72].all()
    assert found.converged[-24:].all()
    good = bem3d.roll(height, **settings)
    for numbers in (found.force, found.approach, found.area):
        assert np.array_equal(np.isfinite(numbers), found.converged)
    assert found.force[found.converged] == pytest.approx(good.force[found.converged], rel=10 * 1e-4)


LIFTED = (1.0, 0.5, -5.0, -9.0, 0.7, 1.0, -5.0, 0.1, 1.2)
WALKS = {
    "more than once, backwards, and around": (
        noisy(6, 0.1),
        1 / 6,
        dict.fromkeys((0, 1, 2, 17, 16, 3, 4, 23, 24, 25, 2), 1.0),
    ),
    "lifted off and back": (noisy(6, 0.1), 1 / 6, dict(enumerate(LIFTED))),
    # lifted above the plane; only the bump, beyond the frame of before, reaches it
    "a bump outside of the frame": (bumpy(row=3), 1 / 6, {0: 0.1, 4: -0.2}),
    "cells longer than wide": (strip(8, 0.1)[::2], (0.25, 0.125), {0: 1.0, 1: 1.0, 2: 1.0, 6: 1.0, 14: 1.0}),
}


@pytest.mark.parametrize("walk", WALKS)
def test_wherever_the_wheel_goes_each_position_is_that_of_a_cold_solve(walk):
    """And that of its own force, borne."""
    height, spacing, steps = WALKS[walk]
    wheel = bem3d.RollingContact(bem3d.Track(height=height, spacing=spacing, **SPHERE), tolerance=TOLERANCE)
    for position, approach in steps.items():
        contact, expected = wheel.press(position, approach), cold(height, spacing, position, approach=approach)
        assert contact.approach == pytest.approx(approach, rel=1e-14)
        assert contact.force == pytest.approx(expected.force, rel=2 * ERROR)
        assert contact.area == pytest.approx(expected.area, abs=2 * np.prod(np.broadcast_to(spacing, 2)))
        if approach > -1:
            assert wheel.carry(position, contact.force).approach == pytest.approx(approach, abs=4 * ERROR)
        else:
            assert (contact.force, contact.area, contact.residual) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize("by", ["approach", "force"])
def test_applications_are_counted(by, monkeypatch):
    """All of them, whether on a frame or on a window of it; but for one that scales the first pressure."""
    calls = []
    for kind in (CachedConvolution, BlockedConvolution):
        apply = kind._convolve
        monkeypatch.setattr(kind, "_convolve", lambda *given, apply=apply: calls.append(apply(*given)))
    wheel = bem3d.RollingContact(bem3d.Track(height=bumpy(row=3), spacing=1 / 6, **SPHERE), tolerance=TOLERANCE)
    for position in range(20):
        calls.clear()
        contact = wheel.press(position, 1.0) if by == "approach" else wheel.carry(position, HERTZ)
        assert len(calls) == contact.operator_applications + (position == 0)


def test_a_wheel_that_just_touches_bears_nothing():
    """At the very approach of first touch, over the middle of a cell."""
    wheel = bem3d.RollingContact(bem3d.Track(height=np.zeros((9, 9)), spacing=1.0, **SPHERE))
    contact = wheel.press(0, 0.0)
    assert (contact.force, contact.operator_applications, contact.history) == (0.0, 0, (0.0,))
    assert contact.converged


def test_the_rolling_force_is_that_of_a_roll():
    height, wheel = STRIPS["smooth"], {"spacing": 1 / 8, **SPHERE, "approach": 1.0}
    assert np.array_equal(bem3d.rolling_force(height, **wheel), bem3d.roll(height, **wheel).force)
