"""What a person sees of `mdr` and `bem3d` at a prompt: names, signatures, one line a result, progress."""

import inspect
import re
import subprocess
import sys

import numpy as np
import pytest

import bem3d
import mdr
from bem3d import results

ROUGH = mdr.SelfAffine(hurst=0.8, q_min=1.0, q_max=10.0, rms=1e-2)
RNG = np.random.default_rng(0)
PACKAGES = pytest.mark.parametrize("package", [mdr, bem3d])


@PACKAGES
def test_names_signatures_and_version(package):
    assert dir(package) == sorted([*package.__all__, "__version__"])
    assert package.__version__[0].isdigit()
    with pytest.raises(AttributeError, match="no attribute 'rol'") as found:
        package.rol  # noqa: B018
    assert (found.value.name, found.value.obj) == ("rol", package)
    for function in filter(inspect.isfunction, (getattr(package, name) for name in package.__all__)):
        parameters = inspect.signature(function).parameters.values()
        assert len(str(inspect.signature(function))) <= 360 and max(len(str(one)) for one in parameters) <= 55


@pytest.mark.parametrize(
    ("call", "name"),
    [
        (lambda rough: mdr.rough_profile(rough, length=1.0, points=8, rng=RNG), "c1d"),
        (lambda rough: mdr.rolling_spectrum(1.0, rough, edges=(1.0, 10.0)), "c2d"),
        (lambda rough: mdr.geike(1.0, rough), "c2d"),
        (lambda rough: mdr.inverse_geike(1.0, rough), "c1d"),
        (lambda rough: mdr.line_trace(1.0, rough, q_max=10.0), "c2d"),
        (lambda rough: bem3d.rough_surface(rough, shape=(8, 8), spacing=1.0, rng=RNG), "c2d"),
    ],
)
def test_an_object_in_place_of_its_spectrum(call, name):
    with pytest.raises(TypeError, match=rf"{name} must be a callable {name}\(q\), got SelfAffine, give its .{name}"):
        call(ROUGH)


CURVE = mdr.load_curve(np.linspace(-2e-6, 1e-6, 100), length=1e-3, modulus=1e9)
WHEEL = {"spacing": 1e-4, "radius": 0.5, "modulus": 2e11}
BODY = bem3d.HalfSpace(shape=(24, 24), spacing=1e-4, modulus=2e11)
FLAT, ALL = np.zeros((24, 24)), np.ones((24, 24), dtype=bool)
PERIODIC = bem3d.HalfSpace(shape=(4, 8), spacing=1.0, modulus=1.0, periodic=True)
STRIP = np.linspace(-1e-6, 2e-6, 64 * 48).reshape(64, 48)
PROFILE = -((np.arange(48) - 23.5) ** 2) * 1e-8 / 0.6 + 0.25e-8 / 0.6
LOOSE = {"max_iterations": 1, "tolerance": 1e-9, "raise_on_failure": False}


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
        (bem3d.solve(BODY, FLAT, force=500.0, indenter_ends_at_edge=True),
         "Contact(force=500 N, approach=* m, area=5.76e-6 m^2, converged, iterations=*)"),
        (bem3d.solve_fixed_area(BODY, ALL, **LOOSE), "FixedContactArea(stiffness=* N/m, not converged, iterations=1)"),
        (next(bem3d.indent_few_cells(BODY, FLAT, forces=[500.0])),
         "FewCellsContact(cells=576, force=500 N, approach=* m, stiffness=* N/m)"),
        (bem3d.Problem(half_space=BODY, gap=FLAT - 2e-6 * np.eye(24), approach=1.5e-6),
         "Problem(24 x 24 cells, modulus=2e11 Pa, gap=-2e-6..0 m, approach=1.5e-6 m)"),
        (bem3d.Problem(half_space=PERIODIC, gap=np.ones((4, 8)), force=500.0, indenter_ends_at_edge=True),
         "Problem(4 x 8 cells, modulus=1 Pa, gap=1 m, force=500 N, periodic, indenter_ends_at_edge)"),
        (bem3d.Track(height=STRIP, spacing=(1e-4, 2e-4), radius=(0.5, 0.3), modulus=2e11),
         "Track(64 x 48 of 0.0001 x 0.0002 m, height=-1e-6..2e-6 m, radius=0.5 x 0.3 m, modulus=2e11 Pa)"),
        (bem3d.Track(height=0 * STRIP, **WHEEL, transverse_profile=PROFILE),
         "Track(64 x 48 of 0.0001 m, height=0 m, radius=0.5 m, profile=*..0 m, modulus=2e11 Pa)"),
        (bem3d.roll(STRIP, **WHEEL, approach=2.5e-6, positions=3),
         "Rolling(force=*..* N, approach=2.5e-6 m, area=*..* m^2, 3/3 converged)"),
        (bem3d.RollingContact(bem3d.Track(height=0 * STRIP, **WHEEL)).carry(0, 500.0),
         "WheelContact(force=500 N, approach=1.915e-6 m, area=* m^2, converged, iterations=*)"),
    ],
)  # fmt: skip
def test_a_result_is_a_line(result, line):
    """A star is a number, without a plus or a zero in its exponent."""
    number = r"-?\d+(\.\d+)?(e-?[1-9]\d*)?"
    assert re.fullmatch(re.escape(line).replace(r"\*", number), repr(result)), repr(result)
    assert len(repr(result)) < 100


def pressed(progress):
    return list(bem3d.indent(BODY, FLAT, forces=[0.0, 0.0, 0.0], progress=progress))


def rolled(progress):
    return bem3d.roll(0 * STRIP, **WHEEL, approach=2.5e-6, positions=3, progress=progress).force


@pytest.mark.parametrize("call", [pressed, rolled])
def test_progress(call, capsys, monkeypatch):
    told = []
    call(lambda *numbers: told.append(numbers))
    assert told == [(1, 3), (2, 3), (3, 3)]
    call(False)
    assert capsys.readouterr() == ("", "")
    call(True)
    assert capsys.readouterr() == ("", "\r1 of 3\r2 of 3\r3 of 3\n")
    monkeypatch.setattr("sys.stderr", None)  # a program without a console
    call(True)
    with pytest.raises(TypeError, match=r"progress must be True, False or a function of \(done, total\), got 1"):
        call(1)


def test_imports_are_few():
    """What takes longer to import than all else waits for its first use."""
    late = "'scipy.fft', 'scipy.special', 'scipy.optimize', 'importlib.metadata', 'pyfftw'"
    command = f"import sys, bem3d, mdr; print([name for name in ({late}) if name in sys.modules])"
    done = subprocess.run([sys.executable, "-c", command], capture_output=True, encoding="utf-8", check=True)
    assert done.stdout == "[]\n"


def test_a_solve_imports_of_fftw_what_it_uses_and_the_rest_is_there_for_others():
    command = """
import sys, numpy, bem3d
half_space = bem3d.HalfSpace(shape=(8, 8), spacing=1.0, modulus=1.0, periodic=True)
bem3d.solve(half_space, numpy.indices((8, 8))[0] * 0.1, force=1.0)
print([name for name in ("pyfftw.interfaces.scipy_fftpack", "scipy.fftpack", "dask") if name in sys.modules])
import pyfftw.interfaces.numpy_fft
print(pyfftw.interfaces.numpy_fft.fft([1.0, 0.0]).real.tolist(), "scipy.fftpack" in sys.modules)
"""
    done = subprocess.run([sys.executable, "-c", command], capture_output=True, encoding="utf-8", check=True)
    assert done.stdout == "[]\n[1.0, 1.0] True\n"


def test_numbers_of_a_line():
    assert results.span(np.empty(0), "m") == "none"
    assert results.span(np.array([1.0, 1.0001]), "m") == "1 m"
    assert [results.short(value, 3) for value in (1.5e-6, 2e11, 0.1, -1e-12)] == ["1.5e-6", "2e11", "0.1", "-1e-12"]
