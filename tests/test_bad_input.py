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
RNG = np.random.default_rng(0)

WHEEL = {"spacing": 1.0, "radius": 4.0, "modulus": 1.0}
ON_TRACK = {"height": np.zeros(8), **WHEEL, "approach": 1.0}
ON_STRIP = {**ON_TRACK, "height": np.zeros((8, 7))}
PARABOLA = -((np.arange(7) - 3.0) ** 2) / 8

# good input, some of which is then replaced
spectrum = partial(mdr.SelfAffine, hurst=0.7, q_min=7.0, q_max=50.0, rms=1e-6)
profile = partial(mdr.rough_profile, c1d=spectrum().c1d, length=1.0, points=32, rng=RNG)
profiles = partial(mdr.rough_profiles, c1d=spectrum().c1d, length=1.0, points=32, count=2, rng=RNG)
stiffnesses = partial(mdr.stiffness_under, force=1.0, height=np.array([[0.0, 1.0]]), length=1.0, modulus=1.0)
surface = partial(bem3d.rough_surface, c2d=spectrum().c2d, shape=(32, 32), spacing=1 / 32, rng=RNG)
curve = partial(mdr.load_curve, height=np.array([0.0, 1.0]), length=1.0, modulus=1.0)
sphere = partial(mdr.press_sphere, radius=1.0, modulus=1.0, approach=1.0)
half_space = partial(bem3d.HalfSpace, shape=(4, 5), spacing=1.0, modulus=1.0)
PRESSED = {"half_space": half_space(), "gap": np.zeros((4, 5))}
solve = partial(bem3d.solve, **PRESSED, approach=1.0)
path = partial(bem3d.indent, **PRESSED, forces=[1.0])
path_down = partial(bem3d.indent, **PRESSED, approaches=[1.0])
frozen = partial(bem3d.solve_fixed_area, half_space=half_space(), contact=np.ones((4, 5), dtype=bool))
springs = partial(mdr.roll, **ON_TRACK)
springs_force = partial(mdr.rolling_force, **ON_TRACK)
springs_across = partial(mdr.roll_surface, **ON_STRIP)
feed = partial(mdr.rolling_spectrum, q=10.0, c2d=spectrum().c2d, edges=(7.0, 50.0), contact_radius=1.0)
in_step = partial(mdr.RollingEnsemble, height=np.zeros((9, 2)), **WHEEL, force=2.0)
track = partial(bem3d.Track, height=np.zeros((8, 7)), **WHEEL)
strip = partial(bem3d.roll, **ON_STRIP)
crowned = partial(bem3d.Track, height=np.zeros((8, 7)), **WHEEL, transverse_profile=PARABOLA)
strip_force = partial(bem3d.rolling_force, **ON_STRIP)
wide = partial(bem3d.roll, height=np.zeros((12, 40)), spacing=(0.5, 0.2), radius=1.0, modulus=1.0, approach=1.0)
wheel = partial(bem3d.RollingContact, track())


solve_force, sphere_force, springs_under, strip_under = (
    partial(function, approach=None, force=1.0) for function in (solve, sphere, springs, strip)
)
borne = partial(curve().at_force, force=1.0)
displaced = partial(half_space().displacement, pressure=np.zeros((4, 5)))


def few_cells(**changes):
    return list(bem3d.indent_few_cells(**{**PRESSED, "gap": np.eye(4, 5), "forces": [1.0], **changes}))


def press(**changes):
    return wheel().press(**{"position": 0, "approach": 1.0, **changes})


def carry(**changes):
    return wheel().carry(**{"position": 0, "force": 1.0, **changes})


def stand(**changes):
    return in_step().force(**{"place": 0, "approach": [1.0, 1.0], **changes})


def stand_again(**changes):
    wheels = in_step()
    wheels.force(0, [1.0, 1.0])
    return wheels.force(**{"place": 0, "approach": [1.0, 1.0], **changes})


def bear(**changes):
    return in_step().approach(**{"place": 0, "force": 2.0, **changes})


ROLLED = [springs, springs_force, springs_across, feed, track, crowned, strip, strip_force, wheel, press, carry]
PATHS = [path, path_down, few_cells]
IN_STEP = [in_step, stand, stand_again, bear]
DRAWN = [spectrum, profile, profiles, surface]
FORCED = [solve_force, sphere_force, borne]
ACCEPTED = [
    *DRAWN,
    *FORCED,
    springs_under,
    strip_under,
    displaced,
    partial(feed, q=0.0),
    stiffnesses,
    curve,
    sphere,
    half_space,
    solve,
    frozen,
    *PATHS,
    *ROLLED,
    *IN_STEP,
]
POSITIVE = [
    (spectrum, ["hurst", "q_min", "q_max", "rms"]),
    *((draws, ["length", "rms"]) for draws in (profile, profiles)),
    (surface, ["spacing", "rms"]),
    (stiffnesses, ["force", "length", "modulus"]),
    (curve, ["length", "modulus"]),
    (sphere, ["radius", "modulus"]),
    (half_space, ["spacing", "modulus"]),
    *((kind, ["tolerance"]) for kind in (solve, frozen, path, few_cells, wheel)),
    *((kind, ["spacing", "radius", "modulus"]) for kind in (track, crowned)),
    *((kind, ["spacing", "radius", "modulus", "approach"]) for kind in (springs, springs_across)),
    (strip, ["spacing", "radius", "modulus", "approach", "tolerance"]),
    *((kind, ["approach"]) for kind in (springs_force, strip_force)),
    (in_step, ["spacing", "radius", "modulus", "force"]),
    *((kind, ["force"]) for kind in (carry, bear, springs_under, strip_under)),
]
BAD_TRACKS = [[], [[1.0, 2.0]], np.full(8, np.nan), np.full(8, np.inf), [[1.0], [1.0, 2.0]], 1.0]
BAD_STRIPS = [[], [[]], [[1.0], [1.0, 2.0]], np.zeros(56), np.zeros((8, 7, 1)), 1.0]
BAD_STRIPS += [np.full((8, 7), value) for value in (np.nan, -np.inf)]
BAD_STEPS = [(1.0,), (1.0, -1.0), (1.0, np.inf), (1.0, 1.0, 1.0)]
BAD_RADII = [(1.0,), (1.0, 0.0), (np.nan, 1.0), (1.0, 1.0, 1.0)]
BAD_GAPS = [np.zeros((5, 4)), np.zeros(20), 0.0, np.full((4, 5), np.nan), np.full((4, 5), np.inf)]
BAD_LOADS = [[], 1.0, [[1.0]], [1.0, np.nan], [1.0, np.inf]]


@pytest.mark.parametrize("function", ACCEPTED)
def test_good_input_is_accepted(function):
    function()


@pytest.mark.parametrize(
    ("function", "name", "values"),
    [
        *[(function, name, NOT_POSITIVE) for function, names in POSITIVE for name in names],
        *[(function, "tolerance", [1.0]) for function in (solve, frozen, path, few_cells, strip, wheel)],
        *[(function, "max_iterations", [0, -1]) for function in (solve, frozen, path, few_cells, strip, wheel)],
        *[(function, "height", BAD_TRACKS) for function in (curve, springs, springs_force)],
        *[(function, "height", BAD_STRIPS) for function in (springs_across, track, strip, strip_force)],
        *[(function, "spacing", BAD_STEPS) for function in (half_space, surface, springs_across, track, strip)],
        *[(function, "radius", BAD_RADII) for function in (springs, springs_across, in_step, track, strip)],
        *[(function, "approach", NOT_FINITE) for function in (sphere, solve, press)],
        *[(function, "force", [np.nan, np.inf, -1.0]) for function in FORCED],
        (borne, "force", [np.array([1.0, value]) for value in (np.nan, np.inf, -1.0)]),
        (displaced, "pressure", [np.zeros((5, 4)), np.full((4, 5), np.nan), [[1.0], [1.0, 2.0]]]),
        *[(function, "points", [0, 1, -3]) for function in (profile, profiles)],
        *[(function, "amplitudes", ["random", ""]) for function in (profile, surface)],
        *[(function, "gap", BAD_GAPS) for function in (solve, path, few_cells)],
        *[(function, "place", [-1]) for function in (stand, stand_again, bear)],
        *[(function, "position", [-1]) for function in (press, carry)],
        (spectrum, "hurst", [1.2001, 2.0]),
        (spectrum, "q_min", [50.0, 51.0]),
        (spectrum, "q_max", [7.0]),
        (profiles, "count", [0, -1]),
        (stiffnesses, "height", [[], [1.0, 2.0], [[0.0, np.nan]]]),
        (surface, "shape", [(32,), 32, (32, 32, 32), (0, 32), (-1, 32), "33"]),
        (half_space, "shape", [(4,), 4, (4, 5, 6), (0, 5), (4, -5), "45", None]),
        (half_space, "planning", ["patient", ""]),
        (solve, "start", [np.zeros((5, 4)), np.full((4, 5), -1.0), np.full((4, 5), np.nan)]),
        (path, "forces", [*BAD_LOADS, [1.0, -1.0]]),
        (path_down, "approaches", BAD_LOADS),
        (few_cells, "forces", [*BAD_LOADS, [0.0, 1.0], [2.0, 1.0], [1.0, 1.0]]),
        (few_cells, "max_cells", [0]),
        (few_cells, "half_space", [half_space(periodic=True)]),
        (frozen, "contact", [np.ones((5, 4), dtype=bool), np.ones((4, 5)), True]),
        (springs, "approach", [np.ones(7), np.ones((8, 1)), np.full(8, np.nan), []]),
        (springs_force, "approach", [np.ones(7)]),
        (springs, "contact", ["two-sided", "", None, "Linear"]),
        (in_step, "height", [np.zeros(shape) for shape in ((9,), (9, 2, 1), (0, 2), (9, 0), (), (2, 2))]),
        (in_step, "height", [np.full((9, 2), value) for value in NOT_FINITE]),
        *[(function, "approach", [1.0, [1.0], [1.0] * 3, [[1.0, 1.0]], [], [np.nan, 1.0], [1.0, np.inf],
           np.ma.array([1.0, 2.0], mask=[False, True])]) for function in (stand, stand_again)],
        (feed, "q", [*NOT_FINITE, [1.0, np.nan]]),
        (feed, "edges", [(), (7.0,), (50.0, 7.0), (7.0, 7.0), (0.0, 7.0), (-1.0, 7.0), (7.0, np.inf), (7.0, np.nan)]),
        (feed, "contact_radius", [np.nan, -np.inf, 0.0, -1.0]),
        (feed, "c2d", [lambda q: -q, lambda q: np.nan * q]),
        (strip, "positions", [0, -1]),
        (crowned, "transverse_profile", [PARABOLA[:-1], PARABOLA[:, np.newaxis], np.full(7, np.nan), PARABOLA + 1e-3,
         PARABOLA - 0.2, -PARABOLA, 0 * PARABOLA, -np.eye(7)[0] - np.eye(7)[6], np.ma.masked_less(PARABOLA, -1.0)]),
    ],
)  # fmt: skip
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
        (springs, ["spacing", "radius", "modulus"]),
        (in_step, ["spacing", "radius", "modulus", "force"]),
        *((kind, ["place"]) for kind in (stand, stand_again, bear)),
        (bear, ["force"]),
        (track, ["radius", "modulus"]),
        (strip, ["radius", "modulus", "tolerance", "max_iterations"]),
        (wheel, ["tolerance", "max_iterations"]),
        (press, ["position", "approach"]),
        (carry, ["position", "force"]),
    ],
)
@pytest.mark.parametrize("value", NO_NUMBER)
def test_what_is_no_number(function, names, value):
    """A list may be two radii."""
    for name in names:
        if (name, value) != ("radius", [1.0]):
            with pytest.raises(TypeError, match=f"{name} must be a"):
                function(**{name: value})


@pytest.mark.parametrize("function", [solve, sphere, springs, springs_across, strip])
def test_approach_and_force_are_alternatives(function):
    with pytest.raises(ValueError, match="either approach or force"):
        function(force=1.0)
    with pytest.raises(ValueError, match="either approach or force"):
        function(approach=None)


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
        *[(partial(function, place=2.0), "place") for function in (stand, stand_again, bear)],
        *[(partial(solve, half_space=half_space(periodic=True), gap=np.linspace(0, 1, 20).reshape(4, 5), approach=d),
           "approach must stay below the mean gap") for d in (0.5, 2.0)],
        (lambda: displaced(pressure=np.zeros((4, 5), dtype=complex)), "pressure"),
        (lambda: solve(half_space="steel"), "half_space"),
        (lambda: half_space(periodic="yes"), "periodic"),
        (lambda: path(forces=None), "give either approaches or forces, got approaches=None and forces=None"),
        (lambda: path(approaches=[1.0]), "give either approaches or forces"),
        (lambda: crowned(radius=(4.0, 3.0)), "radius must be a real number"),
        (lambda: crowned(transverse_profile=["a"] * 7), "transverse_profile must hold real numbers"),
        (lambda: feed(q=0.0, contact_radius=np.inf), "q must not be zero where contact_radius is infinite"),
        (lambda: feed(c2d=1.0), "c2d must be a callable"),
        (lambda: springs(approach=np.ones(8), contact="full"), "approach must be one number where contact is"),
        (lambda: springs(approach=np.ones(8), contact="linear"), "approach must be one number where contact is"),
        (lambda: springs(approach=np.full(8, 5.0)), "longer than the contact"),
        (lambda: in_step(height=np.zeros((2, 2))), "longer than the contact, 3.63424 m, got a track of 2 m"),
        (lambda: springs_across(height=np.zeros((3, 7))), "longer"),
        (lambda: springs_across(height=np.zeros((8, 3))), "wider"),
        (lambda: springs_across(height=1e13 * np.outer(np.eye(8)[0], np.eye(7)[3])), "springs on each side"),
        (lambda: surface(c2d=lambda q: 3.0 - 0.5 * (q > 100) - 7 * (q < 10)), "nowhere negative, got -4.0 to 3.0"),
        (lambda: profile(c1d=lambda q: 3.0 - 7 * (q < 10)), "c1d must be nowhere negative, got -4.0"),
        (lambda: curve().at_force([3.0, -2.0]), "force must be zero or positive, got -2.0"),
        (lambda: solve(start=np.arange(20.0).reshape(4, 5) - 2), "start must be zero or positive .* got -2.0"),
        (lambda: wide(height=np.zeros((3, 40))), "longer than the contact, 2 m, got a track of 1.5 m"),
        (lambda: wide(height=np.zeros((4, 40))), "longer than the contact, 2 m, got a track of 2 m"),
        (lambda: wide(height=np.zeros((12, 9))), "wider than the contact, 2 m, got a strip of 1.8 m"),
        (lambda: wide(height=np.zeros((12, 10))), "wider than the contact, 2 m, got a strip of 2 m"),
        (lambda: wide(height=np.outer(np.ones(12), 9.0 * (np.arange(40) == 39))),
         "wider than the contact, which reaches the edge of the strip of 40 cells at position 0"),
    ],
)  # fmt: skip
def test_arguments_of_functions_and_results(wrong, words):
    with pytest.raises((ValueError, TypeError), match=words):
        wrong()


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


@pytest.mark.parametrize(
    ("function", "shape"),
    [(springs, (8,)), (track, (8, 7)), (strip, (8, 7)), (in_step, (9, 2)), (springs_across, (8, 7))],
)
def test_tracks_hold_real_numbers_of_which_none_is_masked(function, shape):
    function(height=np.ma.array(np.zeros(shape)))
    for height in (np.zeros(shape, dtype=complex), np.full(shape, "a"), np.full(shape, True)):
        with pytest.raises(TypeError, match="height must hold real numbers"):
            function(height=height)
    with pytest.raises(ValueError, match="height must have a value everywhere, got 1 masked"):
        function(height=np.ma.masked_equal(np.arange(float(np.prod(shape))), 3.0).reshape(shape))


@pytest.mark.parametrize(
    ("failing", "most", "said", "where"),
    [(solve, 1, "1 iteration", "at approach 1 m on 4 x 5 cells"), (wide, 2, "2 iterations", "at position 0")],
)
def test_a_failure_has_its_numbers(failing, most, said, where):
    rough = {"gap": np.random.default_rng(0).normal(size=(4, 5))}
    if failing is wide:
        rough = {"height": 0.1 * np.random.default_rng(0).normal(size=(12, 40))}
    with pytest.raises(bem3d.ConvergenceError) as caught:
        failing(**rough, tolerance=1e-12, max_iterations=most)
    residual = f"residual {caught.value.history[-1]:.3g} after {said} (iteration limit), asked for 1e-12"
    assert str(caught.value) == f"{residual}, {where}"


FAILING = {"tolerance": 1e-6, "max_iterations": 500, "raise_on_failure": True}


@pytest.mark.parametrize(
    ("function", "defaults"),
    [
        (bem3d.solve, {**FAILING, "start": None}),
        (bem3d.solve_polonsky_keer, {**FAILING, "max_iterations": 2000}),
        (bem3d.indent, {**FAILING, "stiffness": False}),
        (bem3d.solve_fixed_area, FAILING),
        (bem3d.indent_few_cells, {"max_cells": 4000, "tolerance": 1e-6, "max_iterations": 500}),
        (bem3d.roll, {**FAILING, "tolerance": 1e-5, "positions": None}),
        (bem3d.rolling_force, {"tolerance": 1e-5}),
        (bem3d.RollingContact, {"tolerance": 1e-5, "max_iterations": 500}),
        (bem3d.HalfSpace, {"periodic": False, "planning": "estimate"}),
        (bem3d.rough_surface, {"rms": None, "amplitudes": "fixed"}),
        (mdr.rough_profile, {"rms": None, "amplitudes": "fixed"}),
        (mdr.line_trace, {"nodes": 400}),
    ],
)
def test_defaults(function, defaults):
    """Callers lean on it: what is asked of each function by who does not say."""
    known = {name: one.default for name, one in inspect.signature(function).parameters.items()}
    assert {name: known[name] for name in defaults} == defaults


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
