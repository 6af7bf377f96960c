"""Warnings, with numbers, of what a converged answer may still be wrong about."""

import pickle
import re
import warnings

import numpy as np
import pytest

import bem3d
import mdr
from bem3d import diagnostics
from tests.oracles import dense_operator
from tests.seeded import catches

BODY = bem3d.HalfSpace(shape=(24, 24), spacing=1.0, modulus=1.0)


def bowl(middle):
    x = np.arange(24.0)
    return ((x[:, np.newaxis] - middle) ** 2 + (x - 12) ** 2) / 200


def said(function, *args, **settings):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        result = function(*args, **settings)
    return result, [(w.category, w.message.detail, w.filename) for w in caught]


@pytest.mark.parametrize("side", [2, 3, 4, 5])
def test_error_of_few_cells_is_that_of_the_warning(side):
    """A square punch of side^2 cells against 1.1523 E* L: too soft by about 0.3 / side."""
    body = bem3d.HalfSpace(shape=(side, side), spacing=1 / side, modulus=1.0)
    k = np.linalg.solve(dense_operator(body), np.ones(side**2)).sum() / side**2
    assert 1 - k / 1.15225 == pytest.approx(0.3 / side, rel=0.1)


def test_no_warning_of_enough_cells_away_from_the_edge_or_without_one():
    contact, nothing = said(bem3d.solve, BODY, bowl(12), approach=0.2)
    assert contact.area > 32
    assert nothing == []
    assert said(bem3d.solve, BODY, bowl(12), force=0.0)[1] == []
    periodic = bem3d.HalfSpace(shape=(24, 24), spacing=1.0, modulus=1.0, periodic=True)
    assert said(bem3d.solve, periodic, bowl(1), approach=0.3)[1] == []


@pytest.mark.parametrize(("cells", "warned"), [(2.5, True), (3.9, True), (4.0, False), (8.0, False)])
def test_short_waves(cells, warned):
    """Fewer than four cells to the shortest wave of a spectrum."""
    band = mdr.SelfAffine(hurst=0.8, q_min=2 * np.pi, q_max=2 * np.pi * 64 / cells, rms=1e-2)
    _, found = said(
        bem3d.rough_surface, band.c2d, shape=(64, 64), spacing=1 / 64, rng=np.random.default_rng(0), rms=1e-2
    )
    assert [category for category, _, _ in found] == [bem3d.ResolutionWarning] * warned
    if warned:
        assert found[0][1].startswith(f"the shortest wave of the spectrum has {cells:.2g} cells, fewer than 4")


@pytest.mark.parametrize(
    ("height", "neighbour", "warned"), [(0.0, 0.0, 0), (6.0, 0.0, 1), (6.0, 3.0, 0), (2.0, 0.0, 0)]
)
@pytest.mark.parametrize("periodic", [False, True])
def test_a_spike_of_one_cell(height, neighbour, warned, periodic):
    """Warned of where it touches alone and carries most of the force, wherever it stands."""
    body = bem3d.HalfSpace(shape=(24, 24), spacing=1.0, modulus=1.0, periodic=periodic)
    gap = bowl(12) * np.ones((24, 24))
    gap[5, 12] -= height
    gap[5, 13] -= neighbour
    contact, found = said(bem3d.solve, body, gap, force=8.0)
    share = contact.pressure[5, 12] / contact.pressure.sum()
    assert [category for category, _, _ in found] == [bem3d.ResolutionWarning] * warned
    assert (share > 0.5) == (height == 6.0)
    if warned:
        assert found[0][1].startswith(f"cell (5, 12), which touches alone, carries {share:.0%} of the force")


def test_a_spike_across_the_edge_of_a_period_is_not_alone():
    body = bem3d.HalfSpace(shape=(24, 24), spacing=1.0, modulus=1.0, periodic=True)
    gap = bowl(12) * np.ones((24, 24))
    gap[0, 12] -= 7.0
    assert "cell (0, 12)" in said(bem3d.solve, body, gap, force=8.0)[1][0][1]
    gap[23, 12] -= 3.5
    assert said(bem3d.solve, body, gap, force=8.0)[1] == []


@catches("a modulus in gigapascals that nobody asks about").at("bem3d.contact.diagnose_units", lambda **_: ())
def test_warning_of_a_modulus_in_gigapascals():
    """2 GPa typed as 2: a grid of a millimetre, pressed by metres; once along a path, and of a wheel."""
    x = (np.arange(24) - 11.5) * 1e-3 / 24
    gap = np.add.outer(x**2, x**2) / 2e-2
    right, wrong = (bem3d.HalfSpace(shape=(24, 24), spacing=1e-3 / 24, modulus=modulus) for modulus in (2e9, 2.0))
    flat = {"height": np.zeros((80, 80)), "spacing": 0.1, "radius": 1.0, "modulus": 2.0, "approach": 1.0}
    for asked, call in (
        (0, lambda: bem3d.solve(right, gap, force=0.5)),
        (1, lambda: bem3d.solve(wrong, gap, force=0.5)),
        (1, lambda: list(bem3d.indent(wrong, gap, forces=[0.5, 0.6]))),
        (1, lambda: bem3d.roll(positions=1, **flat)),
    ):
        found = [(category, place) for category, _, place in said(call)[1] if category is bem3d.UnitsWarning]
        assert found == [(bem3d.UnitsWarning, __file__)] * asked


NM, UM = 1e9, 1e6
SURFACE = bem3d.rough_surface(
    mdr.SelfAffine(hurst=0.8, q_min=1e5, q_max=8e5, rms=2e-8).c2d,
    shape=(48, 48), spacing=1e-6, rng=np.random.default_rng(4), rms=2e-8,
)  # fmt: skip
X = (np.arange(48) - 23.5) * 1e-6
RADII = np.hypot(X[:, np.newaxis], X)
SPHERE = RADII**2 / 2e-2
PUNCH = np.where(RADII < 1e-5, 0.0, 1.0)


def asked(gap, *, modulus=1e11, metre=1.0, **load):
    """Whether units are asked about, in a solve and on a path, of a grid whose unit is so many to the metre."""
    body = bem3d.HalfSpace(shape=gap.shape, spacing=1e-6 * metre, modulus=modulus)
    _, found = said(bem3d.solve, body, gap, **load)
    on_path = said(
        lambda: list(
            bem3d.indent(
                body, gap, **{f"{key}s" if key == "force" else "approaches": [value] for key, value in load.items()}
            )
        )
    )[1]
    for warned in (found, on_path):
        assert {place for category, _, place in warned if category is bem3d.UnitsWarning} <= {__file__}
    sentences = [sentence for category, sentence, _ in found if category is bem3d.UnitsWarning]
    assert sentences == [sentence for category, sentence, _ in on_path if category is bem3d.UnitsWarning]
    return sentences


@catches(
    "heights in nm on a grid in m that nobody asks about", gap=-1e9 * SURFACE, settings={"force": 1e-3}, word="above"
).at("bem3d.problem.typical_slope", lambda *_: 0.0)
@catches(
    "heights in m on a grid in um that nobody asks about",
    gap=-SURFACE,
    settings={"force": 1e-3, "metre": 1e6},
    word="below",
).at("bem3d.diagnostics.LIGHTEST_PRESSURE", 0.0)
@pytest.mark.parametrize(
    ("gap", "settings", "word"),
    [
        (-SURFACE, {"force": 1e-3}, None),
        (-NM * SURFACE, {"force": 1e-3}, "above"),
        (-UM * SURFACE, {"force": 1e-3}, "above"),
        (-500 * SURFACE / 2e-8, {"force": 1e-9}, "above"),
        (NM * SPHERE, {"force": 1e-3}, "above"),
        (np.repeat(-NM * SURFACE[:, :1], 48, axis=1), {"force": 1e-3}, "above"),
        (np.repeat(-NM * SURFACE[:1], 48, axis=0), {"force": 1e-3}, "above"),
        (-SURFACE, {"force": 1e-3, "metre": UM}, "below"),
        (-SURFACE, {"approach": 0.0, "metre": UM}, "below"),
        (-NM * SURFACE, {"approach": -30 * NM * 2e-8}, None),
        (-NM * SURFACE, {"force": 0.0}, None),
        (-NM * SURFACE, {"force": 1e-3, "modulus": 1.0}, None),
    ],
)  # fmt: skip
def test_heights_in_another_unit_than_the_grid(gap, settings, word):
    """Heights in nm or um on a grid in m, and in m on a grid in um. No contact, and a unit of pressure, ask nothing."""
    sentences = " ".join(asked(gap, **settings))
    assert sentences.count("slope") == (word is not None)
    assert sentences.startswith(f"half of the cells have a slope {word} ") == (word is not None)


def mean_slope(gap, steps):
    return float(np.abs(np.diff(gap, axis=0)).mean()) / steps[0]


@catches("the edge of a punch asked about as a slope", gap=PUNCH, load={"force": 1e-2}).at(
    "bem3d.problem.typical_slope", mean_slope
)
@pytest.mark.parametrize(
    ("gap", "load"),
    [
        (SPHERE * 1e2, {"force": 1e-3}),
        (np.sqrt(3) * RADII, {"force": 1e-4}),
        (24e-6 - np.sqrt(np.maximum(24e-6**2 - RADII**2, 0.0)), {"force": 1e-4}),
        (PUNCH, {"force": 1e-2}),
        (np.where(RADII < 1e-5, SPHERE, 1e6), {"force": 1e-2}),
        (np.where(RADII < 2e-6, SPHERE - 1.0, SPHERE), {"force": 1e-4}),
        (np.zeros((48, 48)), {"force": 1e-9}),
        (1 + 2.3e-16 * np.random.default_rng(0).integers(3, size=(48, 48)), {"force": 1e-9}),
        (1e-10 * np.cos(2 * np.pi * X / 48e-6) * np.ones((48, 1)), {"force": 1e-6}),
        (SPHERE * 1e-6, {"force": 1e-3}),
    ],
    ids=[
        "sphere",
        "cone of 60 degrees",
        "half of a ball",
        "punch",
        "cut out",
        "pit",
        "flat",
        "rounding",
        "wave",
        "lens",
    ],
)
def test_steep_and_flat_indenters_are_not_asked_about(gap, load):
    assert asked(gap, **load) == []


def test_the_slope_of_a_large_grid_is_that_of_a_plane():
    """Read on some of its rows and columns; the steeper axis counts, each by its own side of a cell."""
    rows, columns = np.arange(200.0)[:, np.newaxis], np.arange(150.0)
    for along, across in ((3.0, -2.0), (-1.0, 8.0)):
        plane = along * rows + across * columns
        assert diagnostics.typical_slope(plane, (0.5, 2.0)) == pytest.approx(max(abs(along) / 0.5, abs(across) / 2.0))
    assert diagnostics.typical_slope(np.zeros((1, 1)), (1.0, 1.0)) == 0.0
    assert diagnostics.typical_slope(2.0 * rows[:, :1], (1.0, 1.0)) == 2.0


@catches("a strip in um that nobody asks about").at("bem3d.rolling_frame.typical_slope", lambda *_: 0.0)
def test_heights_of_a_strip_in_another_unit():
    wheel = {"spacing": 1e-4, "radius": 0.5, "modulus": 2e11, "approach": 2e-6, "positions": 1}
    waves = 1e-7 * np.cos(2 * np.pi * np.arange(64) / 16)[:, np.newaxis] * np.ones(48)
    pit = np.where(np.arange(64) == 40, -0.1, 0.0)[:, np.newaxis] * np.ones(48)
    for height, count in ((waves, 0), (pit, 0), (UM * (waves - waves.max()), 1)):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            bem3d.roll(height, **wheel)
        assert [w.category for w in caught].count(bem3d.UnitsWarning) == count


def pressure(cells):
    """So many cells of one in the middle of 10 x 10."""
    inner = 1.0 * (np.arange(64) < cells)
    return np.pad(inner.reshape(8, 8), 1)


def edges(**settings):
    touching = np.ones((10, 6))
    touching[3:5, 2] = 0.0
    return diagnostics.diagnose_pressure(touching, **settings)


def units(modulus, pressure, approach, slope=0.0):
    return diagnostics.diagnose_units(pressure=pressure, modulus=modulus, approach=approach, side=1.0, slope=slope)


GRID = "; refine the grid (32 cells or more are not warned of)"
COARSE, ROUGH = "in contact: the answer is that of the grid, not of the surface", "its area is rougher still"


@pytest.mark.parametrize(
    ("found", "words"),
    [
        (diagnostics.diagnose_pressure(pressure(0), edge=True), None),
        (diagnostics.diagnose_pressure(pressure(1), edge=True), f"only 1 cell {COARSE}{GRID}"),
        (diagnostics.diagnose_pressure(pressure(5), edge=True), f"only 5 cells {COARSE}{GRID}"),
        (diagnostics.diagnose_pressure(pressure(6), edge=True),
         f"only 6 cells in contact: a flat punch of so few is 12% too soft, {ROUGH}{GRID}"),
        (diagnostics.diagnose_pressure(pressure(31), edge=True),
         f"only 31 cells in contact: a flat punch of so few is 5% too soft, {ROUGH}{GRID}"),
        (diagnostics.diagnose_pressure(pressure(32), edge=True), None),
        (edges(edge=True), "28 of 58 contact cells lie on the edge of the grid, beyond which nothing carries: widen"),
        (edges(edge=False), None),
        (diagnostics.diagnose_sphere(31.9), "the contact of the smooth sphere has only 32 cells: refine the grid"),
        (diagnostics.diagnose_sphere(32.0), None),
        (units(2.0, 0.2, 1.0), None),
        (units(2.0, 0.201, 1.0), r"the mean pressure is 0.1 E\* [^,]*: are the units right"),
        (units(1.0, 9.0, 1.0), None),
        (units(1.0, 9.0, 1.01), "the approach beyond the first touch, 1.01 m, is more than the side of the grid, 1 m"),
        (units(2.0, 0.1, 1.0, 10.0), None),
        (units(2.0, 0.1, 1.0, 10.1), "half of the cells have a slope above 10 (up to 10 is not asked about): are the"),
        (units(2.0, 1.9e-7, 1.0, 0.9e-6),
         r"half of the cells have a slope below 9e-07, under a mean pressure of 9.5e-08 E\* \(from 1e-06 or 1e-07"),
        (units(2.0, 2e-7, 1.0, 0.9e-6), None),
        (units(2.0, 1.9e-7, 1.0, 1e-6), None),
        (units(2.0, 1.9e-7, 1.0, 0.0), None),
        (units(2.0, 0.201, 1.01), r"the mean pressure is 0.1 E\* .*, and the approach .* side of the grid, 1 m: are"),
    ],
)  # fmt: skip
def test_what_is_said_has_its_numbers(found, words):
    """A modulus of one is the unit of pressure: no mean pressure is asked about."""
    assert len(found) == (words is not None)
    for warning in found:
        assert warning.detail.startswith(words) or re.match(words, warning.detail), warning.detail


def test_a_loop_is_warned_once_of_a_cause():
    """By Python's default filter: numbers change from load to load, the text does not; contacts have the numbers."""
    contacts, rng = [], np.random.default_rng(0)
    with warnings.catch_warnings(record=True) as caught:
        warnings.resetwarnings()
        for i in range(3):
            contacts.append(bem3d.solve(BODY, bowl(1), force=0.01 * 2**i))
            wheel = {"spacing": 1.0, "radius": 1.0 + i / 10, "modulus": 1.0, "approach": 1.0}
            bem3d.roll(np.zeros((16, 16)), **wheel, positions=1)
            band = mdr.SelfAffine(hurst=0.8, q_min=0.5, q_max=2.0 + i / 10, rms=1.0)
            bem3d.rough_surface(band.c2d, shape=(16, 16), spacing=1.0, rng=rng)
    few = bem3d.ResolutionWarning
    assert [w.category for w in caught] == [few, bem3d.EdgeWarning, few, few]
    assert len({str(w.message) for w in caught}) == 4
    assert len({contact.warnings[0] for contact in contacts}) > 1
    assert contacts[0].warnings == tuple(sentence for _, sentence in contacts[0].diagnostics)


def test_a_path_tells_each_cause_once():
    """A spike and few cells are both of the resolution."""
    gap = bowl(12) * np.ones((24, 24))
    gap[5, 12] -= 6.0
    _, found = said(lambda: list(bem3d.indent(BODY, gap, forces=[0.01, 0.02, 8.0, 8.1])))
    assert [sentence.partition(" ")[0] for _, sentence, _ in found] == ["only", "cell"]


@pytest.mark.parametrize("ends", [False, True])
def test_a_punch_may_end_where_its_grid_does(ends):
    """Told so, it is not warned of; every bit is the same."""
    flat = np.zeros((24, 24))
    contact, found = said(bem3d.solve, BODY, flat, force=1.0, indenter_ends_at_edge=ends)
    assert [category for category, _, _ in found] == [bem3d.EdgeWarning] * (not ends)
    (step,), on_path = said(lambda: list(bem3d.indent(BODY, flat, forces=[1.0], indenter_ends_at_edge=ends)))
    assert [category for category, _, _ in on_path] == [bem3d.EdgeWarning] * (not ends)
    assert (step.pressure == contact.pressure).all()
    assert (contact.pressure == said(bem3d.solve, BODY, flat, force=1.0)[0].pressure).all()
    with pytest.raises(TypeError, match="indenter_ends_at_edge must be True or False, got 1"):
        bem3d.solve(BODY, flat, force=1.0, indenter_ends_at_edge=1)


def test_a_warning_of_ones_own_and_its_copy():
    warning = pickle.loads(pickle.dumps(bem3d.EdgeWarning("text", "text with 3")))
    assert (str(warning), warning.detail, bem3d.ContactWarning("alone").detail) == ("text", "text with 3", "alone")
