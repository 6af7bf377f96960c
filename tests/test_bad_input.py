"""Every public function refuses what it cannot answer, in one sentence that names the argument."""

import inspect
from functools import partial

import numpy as np
import pytest

import bem3d
import mdr

NOT_FINITE = [np.nan, np.inf, -np.inf]
NOT_POSITIVE = [*NOT_FINITE, 0.0, -1.0]
NO_NUMBER = ["one", None, [1.0], True, 1j]


WHEEL = {"spacing": 1.0, "radius": 4.0, "modulus": 1.0}
ON_TRACK = {"height": np.zeros(8), **WHEEL, "approach": 1.0}
ON_STRIP = {**ON_TRACK, "height": np.zeros((8, 7))}
RNG = np.random.default_rng(0)

# good input, some of which is then replaced
spectrum = partial(mdr.SelfAffine, hurst=0.7, q_min=7.0, q_max=50.0, rms=1e-6)
profile = partial(mdr.rough_profile, c1d=spectrum().c1d, length=1.0, points=32, rng=RNG)
profiles = partial(mdr.rough_profiles, c1d=spectrum().c1d, length=1.0, points=32, count=2, rng=RNG)
stiffnesses = partial(mdr.stiffness_under, force=1.0, height=np.array([[0.0, 1.0]]), length=1.0, modulus=1.0)
surface = partial(bem3d.rough_surface, c2d=spectrum().c2d, shape=(32, 32), spacing=1 / 32, rng=RNG)
curve = partial(mdr.load_curve, height=np.array([0.0, 1.0]), length=1.0, modulus=1.0)
sphere = partial(mdr.press_sphere, radius=1.0, modulus=1.0, approach=1.0)
half_space = partial(bem3d.HalfSpace, shape=(4, 5), spacing=1.0, modulus=1.0)
solve = partial(bem3d.solve, half_space=half_space(), gap=np.zeros((4, 5)), approach=1.0)
frozen = partial(bem3d.solve_fixed_area, half_space=half_space(), contact=np.ones((4, 5), dtype=bool))
springs = partial(mdr.roll, **ON_TRACK)
springs_force = partial(mdr.rolling_force, **ON_TRACK)
feed = partial(mdr.rolling_spectrum, q=10.0, c2d=spectrum().c2d, edges=(7.0, 50.0), contact_radius=1.0)
track = partial(bem3d.Track, height=np.zeros((8, 7)), **WHEEL)
strip = partial(bem3d.roll, **ON_STRIP)
strip_force = partial(bem3d.rolling_force, **ON_STRIP)
wide = partial(bem3d.roll, height=np.zeros((12, 40)), spacing=(0.5, 0.2), radius=1.0, modulus=1.0, approach=1.0)
wheel = partial(bem3d.RollingContact, track())


def press(**changes):
    return wheel().press(**{"position": 0, "approach": 1.0, **changes})


def carry(**changes):
    return wheel().carry(**{"position": 0, "force": 1.0, **changes})


ROLLED = [springs, springs_force, feed, track, strip, strip_force, wheel, press, carry]
ACCEPTED = [spectrum, profile, profiles, stiffnesses, surface, curve, sphere, half_space, solve, frozen, *ROLLED]
BAD_TRACKS = [[], [[1.0, 2.0]], np.full(8, np.nan), np.full(8, np.inf), [[1.0], [1.0, 2.0]], 1.0]
BAD_STRIPS = [[], [[]], [[1.0], [1.0, 2.0]], np.zeros(56), np.zeros((8, 7, 1)), 1.0]
BAD_STRIPS += [np.full((8, 7), value) for value in (np.nan, -np.inf)]
BAD_STEPS = [*NOT_POSITIVE, (1.0,), (1.0, -1.0), (1.0, np.inf), (1.0, 1.0, 1.0)]


@pytest.mark.parametrize("function", ACCEPTED)
def test_good_input_is_accepted(function):
    function()


@pytest.mark.parametrize(
    ("function", "name", "values"),
    [
        (spectrum, "hurst", [*NOT_POSITIVE, 1.2001, 2.0]),
        (spectrum, "q_min", [*NOT_POSITIVE, 50.0, 51.0]),
        (spectrum, "q_max", [*NOT_POSITIVE, 7.0]),
        (spectrum, "rms", NOT_POSITIVE),
        (profile, "length", NOT_POSITIVE),
        (profile, "points", [0, 1, -3]),
        (profile, "rms", NOT_POSITIVE),
        (profile, "amplitudes", ["random", ""]),
        (profiles, "length", NOT_POSITIVE),
        (profiles, "points", [0, 1, -3]),
        (profiles, "count", [0, -1]),
        (profiles, "rms", NOT_POSITIVE),
        (stiffnesses, "force", NOT_POSITIVE),
        (stiffnesses, "height", [[], [1.0, 2.0], [[0.0, np.nan]]]),
        (stiffnesses, "length", NOT_POSITIVE),
        (stiffnesses, "modulus", NOT_POSITIVE),
        (surface, "spacing", [*NOT_POSITIVE, (1.0,), (1.0, 2.0, 3.0), (1.0, 0.0), (np.nan, 1.0)]),
        (surface, "shape", [(32,), 32, (32, 32, 32), (0, 32), (-1, 32), "33"]),
        (surface, "rms", NOT_POSITIVE),
        (surface, "amplitudes", ["random"]),
        (curve, "length", NOT_POSITIVE),
        (curve, "modulus", NOT_POSITIVE),
        (curve, "height", [[], [[1.0, 2.0]], [0.0, np.nan], [np.inf, 0.0], [[1.0], [1.0, 2.0]], 1.0]),
        (sphere, "radius", NOT_POSITIVE),
        (sphere, "modulus", NOT_POSITIVE),
        (sphere, "approach", NOT_FINITE),
        (half_space, "shape", [(4,), 4, (4, 5, 6), (0, 5), (4, -5), "45", None]),
        (half_space, "spacing", [*NOT_POSITIVE, (1.0,), (1.0, -1.0), (1.0, np.inf), (1.0, 1.0, 1.0)]),
        (half_space, "modulus", NOT_POSITIVE),
        (half_space, "planning", ["patient", ""]),
        (solve, "gap", [np.zeros((5, 4)), np.zeros(20), 0.0, np.full((4, 5), np.nan), np.full((4, 5), np.inf)]),
        (solve, "approach", NOT_FINITE),
        (solve, "tolerance", [*NOT_POSITIVE, 1.0]),
        (solve, "max_iterations", [0, -1]),
        (solve, "start", [np.zeros((5, 4)), np.full((4, 5), -1.0), np.full((4, 5), np.nan)]),
        (frozen, "contact", [np.ones((5, 4), dtype=bool), np.ones((4, 5)), True]),
        (frozen, "tolerance", [*NOT_POSITIVE, 1.0]),
        (frozen, "max_iterations", [0]),
        (springs, "height", BAD_TRACKS),
        (springs, "spacing", NOT_POSITIVE),
        (springs, "radius", NOT_POSITIVE),
        (springs, "modulus", NOT_POSITIVE),
        (springs, "approach", [*NOT_POSITIVE, np.ones(7), np.ones((8, 1)), np.full(8, np.nan), []]),
        (springs, "contact", ["two-sided", "", None, "Linear"]),
        (springs_force, "height", BAD_TRACKS),
        (springs_force, "approach", [*NOT_POSITIVE, np.ones(7)]),
        (feed, "q", [*NOT_FINITE, [1.0, np.nan]]),
        (feed, "edges", [(), (7.0,), (50.0, 7.0), (7.0, 7.0), (0.0, 7.0), (-1.0, 7.0), (7.0, np.inf), (7.0, np.nan)]),
        (feed, "contact_radius", [np.nan, -np.inf, 0.0, -1.0]),
        (feed, "c2d", [lambda q: -q, lambda q: np.nan * q]),
        (track, "height", BAD_STRIPS),
        (track, "spacing", BAD_STEPS),
        (track, "radius", NOT_POSITIVE),
        (track, "modulus", NOT_POSITIVE),
        (strip, "height", BAD_STRIPS),
        (strip, "spacing", BAD_STEPS),
        (strip, "radius", NOT_POSITIVE),
        (strip, "modulus", NOT_POSITIVE),
        (strip, "approach", NOT_POSITIVE),
        (strip, "tolerance", [*NOT_POSITIVE, 1.0]),
        (strip, "max_iterations", [0, -1]),
        (strip, "positions", [0, -1]),
        (strip_force, "height", BAD_STRIPS),
        (strip_force, "approach", NOT_POSITIVE),
        (wheel, "tolerance", [*NOT_POSITIVE, 1.0]),
        (wheel, "max_iterations", [0]),
        (press, "position", [-1]),
        (press, "approach", NOT_FINITE),
        (carry, "position", [-1]),
        (carry, "force", NOT_POSITIVE),
    ],
)
def test_out_of_range(function, name, values):
    for value in values:
        with pytest.raises(ValueError, match=name):
            function(**{name: value})


@pytest.mark.parametrize(
    ("function", "names"),
    [
        (spectrum, ["hurst", "q_min", "q_max", "rms"]),
        (profile, ["length", "points"]),
        (curve, ["length", "modulus"]),
        (sphere, ["radius", "modulus"]),
        (half_space, ["modulus"]),
        (solve, ["tolerance", "max_iterations"]),
        (springs, ["spacing", "modulus"]),
        (track, ["modulus"]),
        (strip, ["modulus", "tolerance", "max_iterations"]),
        (wheel, ["tolerance", "max_iterations"]),
        (press, ["position", "approach"]),
        (carry, ["position", "force"]),
    ],
)
@pytest.mark.parametrize("value", NO_NUMBER)
def test_what_is_no_number(function, names, value):
    for name in names:
        with pytest.raises(TypeError, match=f"{name} must be a"):
            function(**{name: value})


@pytest.mark.parametrize("function", [springs, track, strip])
@pytest.mark.parametrize("value", [value for value in NO_NUMBER if not isinstance(value, list)])
def test_a_radius_that_is_no_number(function, value):
    with pytest.raises(TypeError, match="radius must be a"):
        function(radius=value)


@pytest.mark.parametrize("by_force", [np.nan, np.inf, -1.0])
def test_force_out_of_range(by_force):
    for wrong in (
        lambda: solve(approach=None, force=by_force),
        lambda: sphere(approach=None, force=by_force),
        lambda: curve().at_force(by_force),
        lambda: curve().at_force(np.array([1.0, by_force])),
    ):
        with pytest.raises(ValueError, match="force"):
            wrong()


@pytest.mark.parametrize("function", [solve, sphere, springs, strip])
def test_approach_and_force_are_alternatives(function):
    with pytest.raises(ValueError, match="either approach or force"):
        function(force=1.0)
    with pytest.raises(ValueError, match="either approach or force"):
        function(approach=None)


def test_pressure():
    for bad in (np.zeros((5, 4)), np.full((4, 5), np.nan), [[1.0], [1.0, 2.0]]):
        with pytest.raises(ValueError, match="pressure"):
            half_space().displacement(bad)
    with pytest.raises(TypeError, match="pressure"):
        half_space().displacement(np.zeros((4, 5), dtype=complex))


@pytest.mark.parametrize("draw", [profile, surface])
def test_spectra_that_a_grid_cannot_carry(draw):
    name = "c1d" if draw is profile else "c2d"
    nyquist = np.pi * 32

    def fine(q_max):
        wide = spectrum(q_max=q_max)
        return {name: wide.c1d if draw is profile else wide.c2d}

    draw(**fine(nyquist))
    for wrong, words in (
        (fine(1.001 * nyquist), f"{name} must vanish beyond the Nyquist wavenumber"),
        ({name: lambda q: q**-3.0}, f"{name} must vanish"),
        ({name: lambda q: 0 * q}, f"{name} has no power"),
        ({name: lambda q: -(q**-3.0)}, f"{name} .*negative"),
        ({name: lambda q: np.nan * q}, name),
        ({name: lambda q: np.ones(3)}, "one value a wavenumber"),
    ):
        with pytest.raises(ValueError, match=words):
            draw(**wrong)
    with pytest.raises(TypeError, match="callable"):
        draw(**{name: np.ones(3)})
    with pytest.raises(TypeError, match="rng"):
        draw(rng=0)


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        (lambda: spectrum().c2d(np.nan), "q must be finite"),
        (lambda: spectrum().line([1.0, np.inf]), "q must be finite"),
        (lambda: mdr.geike(1.0, -1.0), "negative"),
        (lambda: mdr.inverse_geike([0.0, 1.0], [1.0, 1.0]), "zero"),
        (lambda: mdr.geike([1.0, 2.0], [1.0, 2.0, 3.0]), "matching shapes"),
        (lambda: mdr.line_trace(1.0, lambda q: q, q_max=-1.0), "q_max"),
        (lambda: mdr.sphere_profile(1.0, radius=0.0), "radius"),
        (lambda: mdr.sphere_profile(np.nan, radius=1.0), "x must be finite"),
        (lambda: curve().at_approach(np.nan), "approach"),
        (lambda: curve().at_approach(np.inf), "approach"),
        (lambda: curve(modulus=1e-200, length=1e-200), "modulus and length must give a finite stiffness"),
        (lambda: curve(modulus=1e200, length=1e200), "modulus and length must give a finite stiffness"),
        (lambda: solve(half_space="steel"), "half_space"),
        (lambda: half_space(periodic="yes"), "periodic"),
    ],
)
def test_arguments_of_functions_and_results(wrong, words):
    with pytest.raises((ValueError, TypeError), match=words):
        wrong()


def test_periodic_approach_beyond_the_mean_gap():
    gap = np.linspace(0, 1, 20).reshape(4, 5)
    for approach in (0.5, 2.0):
        with pytest.raises(ValueError, match="approach must stay below the mean gap"):
            solve(half_space=half_space(periodic=True), gap=gap, approach=approach)


@pytest.mark.parametrize("function", [springs, strip])
@pytest.mark.parametrize("force", NOT_POSITIVE)
def test_a_wheel_that_carries_nothing(function, force):
    with pytest.raises(ValueError, match="force must be"):
        function(approach=None, force=force)


@pytest.mark.parametrize(("load", "contact"), [({"approach": 1.0}, 4.0), ({"approach": None, "force": 8 / 3}, 4.0)])
def test_tracks_that_are_no_longer_than_the_contact(load, contact):
    """As long as it is refused, longer is answered; at a force, of the smooth wheel that bears it: 4/3 E* a d."""
    for kind in ("one-sided", "full", "linear"):
        with pytest.raises(ValueError, match="height must be longer than the contact, 4 m, got"):
            springs(height=np.zeros(8), spacing=0.999 * contact / 8, contact=kind, **load)
        springs(height=np.zeros(8), spacing=1.001 * contact / 8, contact=kind, **load)
    with pytest.raises(ValueError, match="height must be longer than the contact"):
        strip(height=np.zeros((8, 30)), spacing=0.999 * contact / 8, **load)
    with pytest.raises(ValueError, match="height must be wider than the contact"):
        strip(height=np.zeros((30, 8)), spacing=0.999 * contact / 8, **load)


def test_an_approach_for_each_point_is_that_of_one_sided_springs():
    for contact in ("full", "linear"):
        with pytest.raises(ValueError, match="approach must be one number where contact is"):
            springs(approach=np.ones(8), contact=contact)
    with pytest.raises(ValueError, match="longer than the contact"):
        springs(approach=np.full(8, 5.0))


def test_input_spectra_at_a_wavenumber_of_zero():
    assert feed(q=0.0) > 0
    with pytest.raises(ValueError, match="q must not be zero where contact_radius is infinite"):
        feed(q=0.0, contact_radius=np.inf)
    with pytest.raises(TypeError, match="c2d must be a callable"):
        feed(c2d=1.0)


@pytest.mark.parametrize("value", NOT_FINITE)
@pytest.mark.parametrize(
    ("function", "name", "shape"),
    [(solve, "gap", (4, 5)), (curve, "height", (3,)), (springs, "height", (8,)), (track, "height", (8, 7))],
)
def test_a_single_value_that_is_not_finite(function, name, shape, value):
    given = np.zeros(shape)
    given.flat[-1] = value
    with pytest.raises(ValueError, match=f"{name} must be finite, got 1 NaN or infinite values out of {given.size}"):
        function(**{name: given})


@pytest.mark.parametrize("function", [springs, track])
def test_masked_arrays_without_a_masked_value_are_accepted(function):
    function(height=np.ma.array(np.zeros(8 if function is springs else (8, 7))))


@pytest.mark.parametrize("function", [springs, track, strip])
def test_tracks_that_hold_no_real_numbers(function):
    shape = (8,) if function is springs else (8, 7)
    for height in (np.zeros(shape, dtype=complex), np.full(shape, "a"), np.full(shape, True)):
        with pytest.raises(TypeError, match="height must hold real numbers"):
            function(height=height)


@pytest.mark.parametrize("function", [springs, track, strip])
def test_tracks_with_values_that_are_masked(function):
    height = np.ma.masked_equal(np.arange(8.0 if function is springs else 56.0), 3.0)
    with pytest.raises(ValueError, match="height must have a value everywhere, got 1 masked"):
        function(height=height if function is springs else height.reshape(8, 7))


def wheels_at(**changes):
    """Two tracks, whose middles are 1 and -2 from the plane that heights count from."""
    wheels = mdr.RollingEnsemble(np.tile([1.0, -2.0], (9, 1)), **WHEEL, force=2.0)
    return wheels.force(**{"place": 0, "approach": np.zeros(2), **changes})


@pytest.mark.parametrize(
    ("wrong", "sentence"),
    [
        (
            lambda: surface(c2d=lambda q: 3.0 - 0.5 * (q > 100) - 7 * (q < 10)),
            "c2d must be finite and nowhere negative, got -4.0 to 3.0",
        ),
        (lambda: profile(c1d=lambda q: 3.0 - 7 * (q < 10)), "c1d must be nowhere negative, got -4.0"),
        (lambda: curve().at_force([3.0, -2.0]), "force must be zero or positive, got -2.0"),
        (
            lambda: solve(start=np.arange(20.0).reshape(4, 5) - 2),
            "start must be zero or positive everywhere, got -2.0",
        ),
        (lambda: wide(height=np.zeros((3, 40))), "height must be longer than the contact, 2 m, got a track of 1.5 m"),
        (lambda: wide(height=np.zeros((4, 40))), "height must be longer than the contact, 2 m, got a track of 2 m"),
        (lambda: wide(height=np.zeros((12, 9))), "height must be wider than the contact, 2 m, got a strip of 1.8 m"),
        (lambda: wide(height=np.zeros((12, 10))), "height must be wider than the contact, 2 m, got a strip of 2 m"),
        (
            lambda: wide(height=np.outer(np.ones(12), 9.0 * (np.arange(40) == 39))),
            "height must be wider than the contact, which reaches the edge of the strip of 40 cells at position 0",
        ),
        (lambda: wheels_at(approach=np.array([5.0, np.inf])), "approach must be finite, got [ 5. inf]"),
        (
            lambda: mdr.RollingEnsemble(np.zeros((4, 1)), spacing=0.5, radius=1.0, modulus=1.0, force=4 / 3),
            "height must be longer than the contact, 2 m, got a track of 2 m",
        ),
    ],
)
def test_a_refusal_has_its_numbers(wrong, sentence):
    with pytest.raises(ValueError) as caught:
        wrong()
    assert str(caught.value) == sentence


@pytest.mark.parametrize(("most", "said"), [(1, "1 iteration"), (2, "2 iterations")])
def test_a_failure_has_its_numbers(most, said):
    """Of a solve and of a wheel."""
    gap = np.random.default_rng(0).normal(size=(4, 5))
    with pytest.raises(bem3d.ConvergenceError) as caught:
        bem3d.solve(half_space(), gap, approach=0.5, tolerance=1e-12, max_iterations=most)
    residual = caught.value.history[-1]
    assert str(caught.value) == (
        f"residual {residual:.3g} after {said} (iteration limit), asked for 1e-12, at approach 0.5 m on 4 x 5 cells"
    )
    height = 0.1 * np.random.default_rng(0).normal(size=(12, 40))
    with pytest.raises(bem3d.ConvergenceError) as caught:
        wide(height=height, max_iterations=most, tolerance=1e-12)
    residual = caught.value.history[-1]
    assert str(caught.value) == (
        f"residual {residual:.3g} after {most} iterations (iteration limit), asked for 1e-12, at position 0"
    )


FAILING = {"tolerance": 1e-6, "max_iterations": 500, "raise_on_failure": True}


@pytest.mark.parametrize(
    ("function", "called", "defaults"),
    [
        (bem3d.solve, solve, {**FAILING, "start": None}),
        (bem3d.solve_polonsky_keer, lambda: bem3d.solve_polonsky_keer(half_space(), np.zeros((4, 5)), approach=1.0),
         {**FAILING, "max_iterations": 2000}),
        (bem3d.indent, lambda: list(bem3d.indent(half_space(), np.zeros((4, 5)), forces=[1.0])),
         {**FAILING, "stiffness": False}),
        (bem3d.solve_fixed_area, frozen, FAILING),
        (bem3d.indent_few_cells, lambda: list(bem3d.indent_few_cells(half_space(), np.eye(4, 5), forces=[1.0])),
         {"max_cells": 4000, "tolerance": 1e-6, "max_iterations": 500}),
        (bem3d.roll, lambda: wide(positions=1), {**FAILING, "tolerance": 1e-5, "positions": None}),
        (bem3d.rolling_force,
         lambda: bem3d.rolling_force(np.zeros((4, 40)), spacing=0.6, radius=1.0, modulus=1.0, approach=1.0),
         {"tolerance": 1e-5}),
        (bem3d.RollingContact,
         lambda: bem3d.RollingContact(bem3d.Track(height=np.zeros((4, 40)), spacing=0.6, radius=1.0, modulus=1.0)),
         {"tolerance": 1e-5, "max_iterations": 500}),
        (bem3d.HalfSpace, half_space, {"periodic": False, "planning": "estimate"}),
        (bem3d.rough_surface, surface, {"rms": None, "amplitudes": "fixed"}),
        (mdr.rough_profile, profile, {"rms": None, "amplitudes": "fixed"}),
        (mdr.line_trace, lambda: mdr.line_trace(1.0, lambda q: q**-2, q_max=2.0), {"nodes": 400}),
    ],
)  # fmt: skip
def test_defaults(function, called, defaults):
    """Callers lean on it: what is asked of each function by who does not say."""
    called()
    known = {name: one.default for name, one in inspect.signature(function).parameters.items()}
    assert {name: known[name] for name in defaults} == defaults


def test_the_springs_of_sums_that_round_are_counted():
    """2 sqrt(d R) / dx of them."""
    wheels = mdr.RollingEnsemble(np.zeros((9, 1)), spacing=1.0, radius=4.0, modulus=1.0, force=2.0)
    with pytest.raises(ArithmeticError) as caught:
        wheels.force(0, [1.1e10])
    assert str(caught.value) == (
        f"approach must be less deep for sums of {2 * int(np.sqrt(4.4e10)) + 1} springs without rounding, got 1.1e+10 m"
    )


@pytest.mark.parametrize(
    ("draw", "sentence", "changes"),
    [
        (surface, "shape must be smaller: 40000000 x 40000000 needs about 7.68e\\+07 GB", {"shape": (4 * 10**7,) * 2}),
        (profile, "points must be smaller: 1000000000000000 needs about 4e\\+07 GB", {"points": 10**15}),
        (profiles, "count must be smaller: 1000000000000 of 1000 points needs", {"points": 1000, "count": 10**12}),
    ],
)
def test_draws_that_no_memory_holds(draw, sentence, changes):
    with pytest.raises(MemoryError, match=sentence):
        draw(**changes)


TINY, HUGE = 1e-300, 1e300
NO_DOUBLE = r"must give (numbers that a double can hold|a finite stiffness), got|spacing must be larger"
EXTREME = [
    (curve, {"height": [0.0, HUGE], "length": HUGE}),
    (curve, {"height": [-1.7e308, 1.7e308], "length": 10.0}),
    (lambda **changes: curve(modulus=TINY).at_force(1e10), {}),
    (stiffnesses, {"force": TINY, "modulus": HUGE}),
    (stiffnesses, {"modulus": TINY, "force": HUGE}),
    (sphere, {"radius": TINY, "modulus": TINY}),
    (sphere, {"radius": HUGE, "modulus": HUGE}),
    (sphere, {"approach": None, "force": 1.0, "modulus": 5e-324}),
    (lambda **changes: mdr.sphere_profile(HUGE, radius=1.0), {}),
    (spectrum, {"q_min": TINY}),
    (spectrum, {"q_min": 1e300, "q_max": 1e301}),
    (spectrum, {"rms": HUGE}),
    (lambda **changes: mdr.geike(HUGE, HUGE), {}),
    (lambda **changes: mdr.inverse_geike(TINY, HUGE), {}),
    (lambda **changes: mdr.line_trace(1.0, lambda q: 0 * q + 1.0, q_max=HUGE), {}),
    (lambda **changes: mdr.line_trace(1.0, lambda q: 0 * q + HUGE, q_max=1e20), {}),
    (feed, {"contact_radius": TINY}),
    (feed, {"q": 5e-324, "edges": (5e-324, 25e-324)}),
    (feed, {"edges": (TINY, HUGE)}),
    (feed, {"c2d": lambda q: 0 * q + 1.7e308}),
    (profile, {"length": 1e-307}),
    (profile, {"c1d": lambda q: np.where(q < 60, 1.7e308, 0.0)}),
    (profile, {"rms": HUGE, "c1d": lambda q: np.where(q < 60, TINY, 0.0)}),
    (springs, {"spacing": HUGE, "height": np.zeros(8)}),
    (springs, {"modulus": HUGE, "approach": 1e10, "radius": 1e-10, "spacing": 1e5}),
    (springs, {"approach": None, "force": TINY, "modulus": HUGE}),
    (springs, {"approach": 1e-10, "modulus": 1e-320}),
    (springs, {"approach": None, "force": HUGE, "modulus": TINY}),
    (springs, {"contact": "full", "height": np.full(8, 1.7e308)}),
    (springs, {"approach": np.full(8, 1e-10), "modulus": 1e-320}),
    (springs, {"height": [0.0, 1e100] * 4}),
    (springs, {"height": [0.0, 1e100] * 4, "approach": None, "force": 1.0}),
    (springs, {"contact": "linear", "height": np.full(8, 1.7e308)}),
    (springs, {"radius": HUGE, "spacing": 1e300, "height": np.full(8, 1e20)}),
    (lambda **changes: mdr.RollingEnsemble(np.zeros((9, 1)), spacing=1.0, radius=1.0, modulus=HUGE, force=TINY), {}),
]


@pytest.mark.parametrize(("function", "changes"), EXTREME, ids=range(len(EXTREME)))
def test_numbers_that_no_double_holds_are_refused(function, changes):
    """With what was given, and no zero, infinity or division by zero in the place of an answer."""
    with pytest.raises(ValueError, match=NO_DOUBLE):
        function(**changes)


def test_wheels_in_step_are_not_laid_over_more_springs_than_memory_holds():
    wheels = mdr.RollingEnsemble(np.zeros((9, 1)), spacing=1.0, radius=1.0, modulus=1.0, force=1.0)
    for deep in (1e17, 1e300):
        with pytest.raises(ArithmeticError, match="approach must be less deep, or spacing larger"):
            wheels.force(0, np.array([deep]))
    with pytest.raises(ArithmeticError, match="approach must be less deep, or spacing larger"):
        wheels.approach(0, 1e100)
