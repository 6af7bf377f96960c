"""A result stays what it is, whatever the caller does with what came in or goes out."""

import copy
import dataclasses
import pickle

import numpy as np
import pytest

import bem3d
import mdr
from tests.seeded import catches

BODY = bem3d.HalfSpace(shape=(6, 5), spacing=1.0, modulus=1.0)
GAP = np.random.default_rng(1).normal(size=(6, 5))
WHEEL = {"spacing": 0.25, "radius": 1.0, "modulus": 1.0, "approach": 1.0}
HEIGHT = 0.1 * np.random.default_rng(2).normal(size=(24, 20))


def results():
    """One of each kind that holds arrays."""
    contact = bem3d.solve(BODY, GAP, approach=0.5)
    curve = mdr.load_curve(HEIGHT[0], length=1.0, modulus=1.0)
    return [
        contact,
        contact.problem,
        bem3d.solve(BODY, GAP, force=0.0),
        bem3d.solve_polonsky_keer(BODY, GAP, approach=0.5),
        next(bem3d.indent(BODY, GAP, forces=[1.0], stiffness=True)),
        next(bem3d.indent_few_cells(BODY, GAP, forces=[1.0])),
        bem3d.solve_fixed_area(BODY, contact.pressure > 0),
        bem3d.solve_fixed_area(BODY, np.zeros((6, 5), dtype=bool)),
        bem3d.Track(height=HEIGHT, spacing=0.25, radius=1.0, modulus=1.0),
        bem3d.roll(HEIGHT, **WHEEL, positions=2),
        mdr.roll(HEIGHT[:, 0], **WHEEL),
        curve,
        curve.at_force(np.array([0.1, 0.2])),
    ]


def arrays(result):
    """All arrays of a result and of the results in it."""
    values = [getattr(result, field.name) for field in dataclasses.fields(result)]
    inner = [array for value in values if dataclasses.is_dataclass(value) for array in arrays(value)]
    return [value for value in values if isinstance(value, np.ndarray)] + inner


COPIES = [lambda result: result, copy.copy, copy.deepcopy, lambda result: pickle.loads(pickle.dumps(result))]


@pytest.mark.parametrize("through", COPIES, ids=["itself", "copied", "deeply copied", "unpickled"])
def test_results_are_read_only(through):
    for result in results():
        found = arrays(through(result))
        assert len(found) == len(arrays(result)) > 0
        for array, original in zip(found, arrays(result), strict=True):
            assert np.array_equal(array, original)
            assert array.base is None
            with pytest.raises(ValueError, match="read-only"):
                array[...] = 7.0


def with_an_older_view(values):
    """A read-only array, and a view of it that is not."""
    array = values.copy()
    view = array[:]
    array.flags.writeable = False
    return array, view


@catches("a gap that the caller may still write to").at("bem3d.problem.kept", lambda values: values)
def test_an_older_view_of_the_gap_changes_no_problem():
    gap, view = with_an_older_view(GAP)
    contact, path = bem3d.solve(BODY, gap, approach=0.5), list(bem3d.indent(BODY, gap, approaches=[0.4, 0.5]))
    view[:] = 7.0
    assert np.array_equal(contact.problem.gap, GAP)
    # one copy serves a path
    assert path[0].problem.gap is path[1].problem.gap
    assert np.array_equal(path[1].problem.gap, GAP)
    assert path[1].problem.approach == 0.5


def test_an_older_view_changes_no_other_result():
    height, view = with_an_older_view(HEIGHT)
    approach, above = with_an_older_view(np.ones(24))
    strip = bem3d.Track(height=height, spacing=0.25, radius=1.0, modulus=1.0)
    curve = mdr.load_curve(height[:, 0], length=1.0, modulus=1.0)
    wheel = mdr.roll(height[:, 0], **{**WHEEL, "approach": approach})
    in_step = mdr.RollingEnsemble(height, spacing=0.25, radius=1.0, modulus=1.0, force=4 / 3)
    borne = in_step.force(0, np.ones(20))
    own = dataclasses.replace(wheel, force=approach)
    expected = curve.approach.copy()
    view[:], above[:] = 7.0, 7.0
    assert np.array_equal(strip.height, HEIGHT)
    assert np.array_equal(curve.approach, expected)
    assert np.array_equal(in_step.force(0, np.ones(20)), borne)
    assert np.array_equal(wheel.approach, np.ones(24))
    assert np.array_equal(own.force, np.ones(24))


@pytest.mark.parametrize("force", [mdr.rolling_force(HEIGHT[:, 0], **WHEEL), bem3d.rolling_force(HEIGHT, **WHEEL)])
def test_a_plain_array_belongs_to_the_caller(force):
    force -= force.mean()
    assert force.flags.owndata


@catches("a spectrum at one wavenumber that is an array").at("mdr.spectrum.number_or_array", np.asarray)
def test_one_wavenumber_has_a_number_and_several_an_array():
    band = mdr.SelfAffine(hurst=0.7, q_min=1.0, q_max=20.0, rms=1.0)
    ends = {"edges": (band.q_min, band.q_max)}
    spectra = [
        *(band.c2d, band.c1d, band.line),
        lambda q: mdr.geike(q, band.c2d),
        lambda q: mdr.inverse_geike(q, band.c1d),
        lambda q: mdr.line_trace(q, band.c2d, q_max=20.0),
        lambda q: mdr.rolling_spectrum(q, band.c2d, **ends),
    ]
    for spectrum in spectra:
        for one in (2, 2.0, np.float64(2.0), np.array(2.0)):
            assert type(spectrum(one)) is float and spectrum(one) == spectrum([2.0])[0]
        assert spectrum(np.array([[2.0], [3.0]])).shape == (2, 1)


def test_a_spectrum_holds_numbers_of_its_own():
    rms = np.array(1.0)
    band = mdr.SelfAffine(hurst=0.7, q_min=1.0, q_max=2.0, rms=rms)
    level = band.c2d(1.5)
    rms[...] = 7.0
    assert band.c2d(1.5) == level
    assert type(band.rms) is float
