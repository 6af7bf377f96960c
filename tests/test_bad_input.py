"""Every public function refuses what it cannot answer, in one sentence that names the argument."""

import numpy as np
import pytest

import bem3d
import mdr

NOT_FINITE = [np.nan, np.inf, -np.inf]
NOT_POSITIVE = [*NOT_FINITE, 0.0, -1.0]
NO_NUMBER = ["one", None, [1.0], True, 1j]


def rng():
    return np.random.default_rng(0)


def spectrum(**changes):
    return mdr.SelfAffine(**{"hurst": 0.7, "q_min": 7.0, "q_max": 50.0, "rms": 1e-6, **changes})


def profile(**changes):
    return mdr.rough_profile(**{"c1d": spectrum().c1d, "length": 1.0, "points": 32, "rng": rng(), **changes})


def surface(**changes):
    return bem3d.rough_surface(**{"c2d": spectrum().c2d, "shape": (32, 32), "spacing": 1 / 32, "rng": rng(), **changes})


def curve(**changes):
    return mdr.load_curve(**{"height": np.array([0.0, 1.0]), "length": 1.0, "modulus": 1.0, **changes})


def sphere(**changes):
    return mdr.press_sphere(**{"radius": 1.0, "modulus": 1.0, "approach": 1.0, **changes})


def half_space(**changes):
    return bem3d.HalfSpace(**{"shape": (4, 5), "spacing": 1.0, "modulus": 1.0, **changes})


def solve(**changes):
    return bem3d.solve(**{"half_space": half_space(), "gap": np.zeros((4, 5)), "approach": 1.0, **changes})


def frozen(**changes):
    return bem3d.press_frozen(**{"half_space": half_space(), "contact": np.ones((4, 5), dtype=bool), **changes})


ACCEPTED = [spectrum, profile, surface, curve, sphere, half_space, solve, frozen]


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
    ],
)
@pytest.mark.parametrize("value", NO_NUMBER)
def test_what_is_no_number(function, names, value):
    for name in names:
        with pytest.raises(TypeError, match=f"{name} must be a"):
            function(**{name: value})


@pytest.mark.parametrize("by_force", [np.nan, np.inf, -1.0])
def test_force_out_of_range(by_force):
    with pytest.raises(ValueError, match="force"):
        solve(approach=None, force=by_force)
    with pytest.raises(ValueError, match="force"):
        sphere(approach=None, force=by_force)
    with pytest.raises(ValueError, match="force"):
        curve().at_force(by_force)
    with pytest.raises(ValueError, match="force"):
        curve().at_force(np.array([1.0, by_force]))


@pytest.mark.parametrize("function", [solve, sphere])
def test_approach_and_force_are_alternatives(function):
    with pytest.raises(ValueError, match="either approach or force"):
        function(force=1.0)
    with pytest.raises(ValueError, match="either approach or force"):
        function(approach=None)


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_approach_of_a_load_curve(value):
    with pytest.raises(ValueError, match="approach"):
        curve().at_approach(value)


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
    with pytest.raises(ValueError, match=f"{name} must vanish beyond the Nyquist wavenumber"):
        draw(**fine(1.001 * nyquist))
    with pytest.raises(ValueError, match=f"{name} must vanish"):
        draw(**{name: lambda q: q**-3.0})
    with pytest.raises(ValueError, match=f"{name} has no power"):
        draw(**{name: lambda q: 0 * q})
    with pytest.raises(ValueError, match=f"{name} .*negative"):
        draw(**{name: lambda q: -(q**-3.0)})
    with pytest.raises(ValueError, match=name):
        draw(**{name: lambda q: np.nan * q})
    with pytest.raises(ValueError, match="one value a wavenumber"):
        draw(**{name: lambda q: np.ones(3)})
    with pytest.raises(TypeError, match="callable"):
        draw(**{name: np.ones(3)})
    with pytest.raises(TypeError, match="rng"):
        draw(rng=0)


def test_spectra_at_bad_wavenumbers():
    with pytest.raises(ValueError, match="q must be finite"):
        spectrum().c2d(np.nan)
    with pytest.raises(ValueError, match="q must be finite"):
        spectrum().line([1.0, np.inf])
    with pytest.raises(ValueError, match="negative"):
        mdr.geike(1.0, -1.0)
    with pytest.raises(ValueError, match="zero"):
        mdr.inverse_geike([0.0, 1.0], [1.0, 1.0])
    with pytest.raises(ValueError, match="matching shapes"):
        mdr.geike([1.0, 2.0], [1.0, 2.0, 3.0])
    with pytest.raises(ValueError, match="q_max"):
        mdr.line_trace(1.0, lambda q: q, q_max=-1.0)
    with pytest.raises(ValueError, match="radius"):
        mdr.sphere_profile(1.0, radius=0.0)
    with pytest.raises(ValueError, match="x must be finite"):
        mdr.sphere_profile(np.nan, radius=1.0)


def test_half_space_of_another_kind():
    with pytest.raises(TypeError, match="half_space"):
        solve(half_space="steel")
    with pytest.raises(TypeError, match="periodic"):
        half_space(periodic="yes")


def test_periodic_approach_beyond_the_mean_gap():
    gap = np.linspace(0, 1, 20).reshape(4, 5)
    for approach in (0.5, 2.0):
        with pytest.raises(ValueError, match="approach must stay below the mean gap"):
            solve(half_space=half_space(periodic=True), gap=gap, approach=approach)
