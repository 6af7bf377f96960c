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
