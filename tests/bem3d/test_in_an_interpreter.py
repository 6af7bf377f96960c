"""What a person sees at a prompt: names, signatures, one line a result, and progress."""

import inspect

import numpy as np
import pytest

import bem3d
import mdr

FUNCTIONS = [name for name in bem3d.__all__ if inspect.isfunction(getattr(bem3d, name))]


@pytest.mark.parametrize("name", FUNCTIONS)
def test_signatures_have_short_names(name):
    signature = inspect.signature(getattr(bem3d, name))
    assert len(str(signature)) <= 360
    assert max(len(str(parameter)) for parameter in signature.parameters.values()) <= 55


def test_names_and_version():
    assert dir(bem3d) == sorted([*bem3d.__all__, "__version__"])
    assert bem3d.__version__[0].isdigit()
    with pytest.raises(AttributeError, match="no attribute 'solv'") as found:
        bem3d.solv  # noqa: B018
    assert (found.value.name, found.value.obj) == ("solv", bem3d)


def test_an_object_in_place_of_its_spectrum():
    rough = mdr.SelfAffine(hurst=0.8, q_min=1.0, q_max=10.0, rms=1e-2)
    with pytest.raises(TypeError, match=r"c2d must be a callable c2d\(q\), got SelfAffine, give its .c2d"):
        bem3d.rough_surface(rough, shape=(8, 8), spacing=1.0, rng=np.random.default_rng(0))
    with pytest.raises(TypeError, match=r"got int$"):
        bem3d.rough_surface(3, shape=(8, 8), spacing=1.0, rng=np.random.default_rng(0))
