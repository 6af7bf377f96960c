"""What a person sees at a prompt: names, signatures, and one line a result."""

import inspect

import numpy as np
import pytest

import mdr

FUNCTIONS = [name for name in mdr.__all__ if inspect.isfunction(getattr(mdr, name))]


@pytest.mark.parametrize("name", FUNCTIONS)
def test_signatures_have_short_names(name):
    signature = inspect.signature(getattr(mdr, name))
    assert len(str(signature)) <= 300
    assert max(len(str(parameter)) for parameter in signature.parameters.values()) <= 55


def test_names_and_version():
    assert dir(mdr) == sorted([*mdr.__all__, "__version__"])
    assert mdr.__version__[0].isdigit()
    with pytest.raises(AttributeError, match="no attribute 'rol'") as found:
        mdr.rol  # noqa: B018
    assert (found.value.name, found.value.obj) == ("rol", mdr)


@pytest.mark.parametrize(
    ("call", "name"),
    [
        (lambda rough: mdr.rough_profile(rough, length=1.0, points=8, rng=np.random.default_rng(0)), "c1d"),
        (lambda rough: mdr.rolling_spectrum(1.0, rough, edges=(1.0, 10.0)), "c2d"),
        (lambda rough: mdr.geike(1.0, rough), "c2d"),
        (lambda rough: mdr.inverse_geike(1.0, rough), "c1d"),
        (lambda rough: mdr.line_trace(1.0, rough, q_max=10.0), "c2d"),
    ],
)
def test_an_object_in_place_of_its_spectrum(call, name):
    rough = mdr.SelfAffine(hurst=0.8, q_min=1.0, q_max=10.0, rms=1e-2)
    with pytest.raises(TypeError, match=rf"{name} must be a callable {name}\(q\), got SelfAffine, give its .{name}"):
        call(rough)


CURVE = mdr.load_curve(np.linspace(-2e-6, 1e-6, 100), length=1e-3, modulus=1e9)
WHEEL = {"spacing": 1e-4, "radius": 0.5, "modulus": 2e11}


@pytest.mark.parametrize(
    ("result", "line"),
    [
        (CURVE, "LoadCurve(100 springs of 1e4 N/m, approach=-1e-6..2e-6 m, force=0..1.5 N)"),
        (CURVE.at_approach(3e-6), "LoadPoint(approach=3e-6 m, force=2.5 N, stiffness=1e6 N/m)"),
        (CURVE.at_approach(np.array([2e-6, 4e-6])),
         "LoadPoint(approach=2e-6..4e-6 m, force=1.5..3.5 N, stiffness=9.9e5..1e6 N/m)"),
        (CURVE.at_force(np.empty(0)), "LoadPoint(approach=none, force=none, stiffness=none)"),
        (mdr.press_sphere(radius=0.01, modulus=1e11, force=10.0),
         "SphereContact(approach=8.255e-7 m, force=10 N, stiffness=1.817e7 N/m, contact_radius=9.086e-5 m)"),
        (mdr.roll(1e-7 * np.cos(2 * np.pi * np.arange(256) / 64), **WHEEL, approach=2e-6),
         "RollingTrack(256 points, force=499..567 N, approach=2e-6 m, stiffness=3.8e8..4.2e8 N/m)"),
    ],
)  # fmt: skip
def test_a_result_is_a_line(result, line):
    assert repr(result) == line
    assert len(line) <= 100
