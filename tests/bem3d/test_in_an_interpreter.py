"""What a person sees at a prompt: names, signatures, one line a result, and progress."""

import inspect
import subprocess
import sys

import numpy as np
import pytest

import bem3d
import mdr
from bem3d import formatting

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


BODY = bem3d.HalfSpace(shape=(24, 24), spacing=1e-4, modulus=2e11)
STRIP = {"height": np.zeros((64, 48)), "spacing": 1e-4, "radius": 0.5, "modulus": 2e11}


def test_a_contact_is_a_line():
    contact = bem3d.solve(BODY, np.zeros((24, 24)), force=500.0, indenter_ends_at_edge=True)
    assert repr(contact) == (
        f"Contact(force=500 N, approach={contact.approach:.4g} m, area=5.76e-6 m^2, converged, "
        f"iterations={contact.iterations})"
    ).replace("e-0", "e-")
    cut = bem3d.solve(BODY, np.zeros((24, 24)), approach=-1.234567e-6)
    assert repr(cut) == "Contact(force=0 N, approach=-1.235e-6 m, area=0 m^2, converged, iterations=0)"
    area = bem3d.solve_fixed_area(BODY, contact.pressure > 0)
    assert repr(area).startswith(f"FixedContactArea(stiffness={area.stiffness:.4g} N/m, converged, ".replace("+0", ""))
    loose = bem3d.solve_fixed_area(BODY, contact.pressure > 0, max_iterations=1, tolerance=1e-9, raise_on_failure=False)
    assert repr(loose).endswith("not converged, iterations=1)")
    assert max(len(repr(result)) for result in (contact, area, loose)) <= 100


def test_a_problem_is_a_line():
    gap = np.zeros((24, 24))
    gap[3, 4] = -2e-6
    problem = bem3d.Problem(half_space=BODY, gap=gap, approach=1.5e-6)
    assert repr(problem) == "Problem(24 x 24 cells, modulus=2e11 Pa, gap=-2e-6..0 m, approach=1.5e-6 m)"
    periodic = bem3d.HalfSpace(shape=(4, 8), spacing=1.0, modulus=1.0, periodic=True)
    forced = bem3d.Problem(half_space=periodic, gap=np.ones((4, 8)), force=500.0, indenter_ends_at_edge=True)
    assert repr(forced) == ("Problem(4 x 8 cells, modulus=1 Pa, gap=1 m, force=500 N, periodic, indenter_ends_at_edge)")


def test_a_track_is_a_line():
    assert repr(bem3d.Track(**STRIP)) == "Track(64 x 48 cells of 0.0001 m, height=0 m, radius=0.5 m, modulus=2e11 Pa)"
    height = np.linspace(-1e-6, 2e-6, 64 * 48).reshape(64, 48)
    other = bem3d.Track(height=height, spacing=(1e-4, 2e-4), radius=(0.5, 0.3), modulus=2e11)
    assert repr(other) == (
        "Track(64 x 48 cells of 0.0001 x 0.0002 m, height=-1e-6..2e-6 m, radius=0.5 x 0.3 m, modulus=2e11 Pa)"
    )
    profile = -((np.arange(48) - 23.5) ** 2) * 1e-8 / 0.6 + 0.25e-8 / 0.6
    measured = bem3d.Track(**STRIP, transverse_profile=profile)
    assert repr(measured) == (
        f"Track(64 x 48 cells of 0.0001 m, height=0 m, radius=0.5 m, transverse_profile={profile.min():.3g}..0 m, "
        "modulus=2e11 Pa)"
    ).replace("e-0", "e-")
    assert max(len(repr(track)) for track in (other, measured)) <= 120


def test_a_rolling_wheel_is_a_line():
    track = 1e-6 * np.cos(2 * np.pi * np.arange(64) / 32)[:, np.newaxis] + STRIP["height"]
    rolled = bem3d.roll(**STRIP | {"height": track}, approach=2.5e-6)
    lowest, highest = rolled.force.min(), rolled.force.max()
    assert repr(rolled).startswith(f"Rolling(force={lowest:.3g}..{highest:.3g} N, approach=2.5e-6 m, area=")
    assert repr(rolled).endswith(" m^2, 64/64 converged)")
    wheel = bem3d.RollingContact(bem3d.Track(**STRIP)).carry(0, 500.0)
    assert repr(wheel).startswith("WheelContact(force=500 N, approach=1.915e-6 m, area=")
    assert repr(wheel).endswith(f" m^2, converged, iterations={len(wheel.history) - 1})")
    assert max(len(repr(result)) for result in (rolled, wheel)) <= 100


def pressed(progress):
    return list(bem3d.indent(BODY, np.zeros((24, 24)), forces=[0.0, 0.0, 0.0], progress=progress))


def rolled(progress):
    return bem3d.roll(**STRIP, approach=2.5e-6, positions=3, progress=progress).force


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
    done = subprocess.run([sys.executable, "-c", command], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"


def test_numbers_of_a_line():
    assert formatting.span(np.empty(0), "m") == "none"
    assert formatting.span(np.array([1.0, 1.0001]), "m") == "1 m"
    assert [formatting.short(value, 3) for value in (1.5e-6, 2e11, 0.1, -1e-12)] == ["1.5e-6", "2e11", "0.1", "-1e-12"]
