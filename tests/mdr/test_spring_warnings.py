"""Warnings of springs, with numbers, of what an answer may still be wrong about."""

import math
import warnings
from functools import partial

import numpy as np
import pytest

import mdr
from mdr.diagnostics import diagnose_linearity
from tests.seeded import catches

WHEEL = {"radius": 1.0, "modulus": 1.0, "approach": 1.0}


def said(function, *args, **settings):
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        result = function(*args, **settings)
    return result, [(w.category, w.message.detail, w.filename) for w in caught]


def parabola(springs):
    """A sphere on so many springs to its contact at the approach one."""
    x = (np.arange(8 * springs) - 4 * springs + 0.5) * 2 / springs
    return mdr.load_curve(-mdr.sphere_profile(x, radius=1.0), length=16.0, modulus=1.0)


@pytest.mark.parametrize("springs", [5, 9, 15])
def test_error_of_few_springs_is_that_of_the_warning(springs):
    """Springs anywhere under a parabola: never off by more than a spring, and 1 / sqrt(6) of one in the mean square."""
    dx, places = 2 / springs, np.linspace(0, 1, 400, endpoint=False)
    x = dx * (np.arange(-2 * springs, 2 * springs)[:, np.newaxis] + places)
    k = dx * np.count_nonzero(x**2 < 1, axis=0)
    assert np.abs(k / 2 - 1).max() <= (1 + 1e-6) / springs
    lengths = np.linspace(springs, springs + 1, 400, endpoint=False)
    counts = np.floor(lengths[:, np.newaxis] + places)
    assert np.sqrt(np.mean((counts - lengths[:, np.newaxis]) ** 2)) == pytest.approx(1 / np.sqrt(6), rel=0.01)


def drawn(waves):
    """So many of the shortest on 64 springs."""
    band = mdr.SelfAffine(hurst=0.8, q_min=2 * np.pi, q_max=2 * np.pi * waves, rms=1e-2)
    mdr.rough_profile(band.c1d, length=1.0, points=64, rng=np.random.default_rng(0))


def rolled(roll, springs):
    """A smooth wheel with so many springs to its contact."""
    roll(np.zeros(8 * springs), spacing=2 / springs, **WHEEL)


def in_step(height, spacing, **wheel):
    force = 4 / 3 * wheel["modulus"] * math.sqrt(wheel["radius"]) * wheel.pop("approach") ** 1.5
    mdr.RollingEnsemble(height[:, np.newaxis], spacing=spacing, **wheel, force=force * (1 - 1e-12))


def under(*forces):
    """One spring that stands out of three."""
    mdr.load_curve([0.0, 1.0, 0.0], length=1.0, modulus=1.0).at_force(np.array(forces))


ROLLS = (mdr.roll, mdr.rolling_force, in_step)
FEW, SHORT = "springs in contact: k may be", "the shortest wave of the spectrum has"
SMOOTH = "the contact of the smooth wheel has only"
WARNED = {
    "4 springs": (lambda: parabola(4).at_approach(1.0), f"only 4 {FEW} 25% off; take more springs"),
    "14 springs": (lambda: parabola(14).at_approach(1.0), f"only 14 {FEW} 7% off"),
    "16 springs": (lambda: parabola(16).at_approach(1.0), None),
    "two springs": (lambda: parabola(4).at_force(1e-9), f"only 2 {FEW} 50% off"),
    "one spring": (lambda: under(1e-9), "only 1 spring in contact: the answer is that of the spacing, not of the"),
    "one spring or all": (lambda: under(1e-9, 9.0), "only 1 spring in contact at 1 of 2 loads, at the lightest: the"),
    "no spring": (lambda: parabola(4).at_force(0.0), None),
    "no spring or many": (lambda: parabola(40).at_approach(np.array([-1.0, 1.0])), None),
    "many loads": (
        lambda: parabola(40).at_approach(np.array([-1.0, 0.01, 0.02, 1.0])),
        "only 4 springs in contact at 2 of 4 loads, at the lightest: k may be 25% off",
    ),
    "a punch": (lambda: mdr.load_curve(np.zeros(5), length=1.0, modulus=1.0).at_approach(1.0), None),
    "short waves": (lambda: drawn(25), f"{SHORT} 2.6 springs, fewer than 4"),
    "waves just too short": (lambda: drawn(17), f"{SHORT} 3.8 springs, fewer than 4"),
    "waves just long enough": (lambda: drawn(16), None),
    **{f"5 under {roll.__name__}": (partial(rolled, roll, 5), f"{SMOOTH} 5 springs") for roll in ROLLS},
    **{f"15 under {roll.__name__}": (partial(rolled, roll, 15), f"{SMOOTH} 15 springs") for roll in ROLLS},
    **{f"16 under {roll.__name__}": (partial(rolled, roll, 16), None) for roll in ROLLS},
    "no contact": (lambda: mdr.roll(np.zeros(80), **{**WHEEL, "approach": np.full(80, -1.0)}, spacing=0.05), None),
}


@catches("springs that say nothing of short waves", what="short waves").at("mdr.profile.diagnose_waves", lambda *_: ())
@catches("few springs that say nothing", what="4 springs").at("mdr.foundation.diagnose_load", lambda *_: ())
@pytest.mark.parametrize("what", WARNED)
def test_what_is_warned_of(what):
    call, words = WARNED[what]
    _, found = said(call)
    assert [(category, place) for category, _, place in found] == [(mdr.SpringResolutionWarning, __file__)] * bool(
        words
    )
    assert all(sentence.startswith(words) for _, sentence, _ in found)


@catches("a contact wider than its sphere that nobody asks about", modulus=1.0, approach=1.21, asked=1).at(
    "mdr.sphere.diagnose_units", lambda **_: ()
)
@pytest.mark.parametrize(
    ("modulus", "approach", "asked"), [(2e9, 0.9, 0), (1.0, 1.0, 0), (1.0, 1.21, 1), (2e9, 1.21, 1)]
)
def test_warnings_of_the_units_of_a_sphere(modulus, approach, asked):
    """Where the radius of contact is above its own, by whatever function."""
    contact, found = said(mdr.press_sphere, radius=1.0, modulus=modulus, approach=approach)
    wheel = {"spacing": 1 / 40, "radius": 1.0, "modulus": modulus}
    _, rolled = said(mdr.roll, np.zeros(200), **wheel, approach=approach)
    _, borne = said(mdr.roll, np.zeros(200), **wheel, force=contact.force * (1 - 1e-12))
    _, forced = said(mdr.rolling_force, np.zeros(200), **wheel, approach=approach)
    _, ensemble = said(mdr.RollingEnsemble, np.zeros((200, 1)), **wheel, force=contact.force * (1 - 1e-12))
    sentence = "the radius of contact is 1.1 times that of the sphere: are the units right?"
    for told in (found, rolled, borne, forced, ensemble):
        assert told == [(mdr.SpringUnitsWarning, sentence, __file__)] * asked


NM, UM = 1e9, 1e6
PROFILE = mdr.rough_profile(
    mdr.SelfAffine(hurst=0.8, q_min=1e5, q_max=8e5, rms=2e-8).c1d,
    length=6.4e-5, points=64, rng=np.random.default_rng(4), rms=2e-8,
)  # fmt: skip
ROLLED_ON = {"spacing": 1e-4, "radius": 0.5, "modulus": 2e11}
TRACK = 1e-7 * np.cos(2 * np.pi * np.arange(96) / 16)
STEEP, LOW = "half of the springs have a slope above ", "the heights lie within "


def curve(height, modulus=2e11, length=6.4e-5):
    mdr.load_curve(height, length=length, modulus=modulus)


def stiff(height, modulus=2e11, length=6.4e-5):
    mdr.stiffness_under(1.0, height[np.newaxis], length=length, modulus=modulus)


def by_roll(height, **wheel):
    mdr.roll(height, **ROLLED_ON | wheel, approach=2e-6)


def by_force(height, **wheel):
    mdr.roll(height, **ROLLED_ON | wheel, force=266e-11 * (ROLLED_ON | wheel)["modulus"])


def by_rolling_force(height, **wheel):
    mdr.rolling_force(height, **ROLLED_ON | wheel, approach=2e-6)


def by_ensemble(height, **wheel):
    mdr.RollingEnsemble(height[:, np.newaxis], **ROLLED_ON | wheel, force=266e-11 * (ROLLED_ON | wheel)["modulus"])


def by_surface(height, **wheel):
    mdr.roll_surface(np.repeat(height[:, np.newaxis], 64, axis=1), **ROLLED_ON | wheel, approach=2e-6)


PROFILES, TRACKS = (curve, stiff), (by_roll, by_force, by_rolling_force, by_ensemble, by_surface)
OF_HEIGHTS = [
    *((press, height, settings, words) for press in PROFILES for height, settings, words in (
        (PROFILE, {}, None),
        (NM * PROFILE, {}, STEEP),
        (UM * PROFILE, {}, STEEP),
        (NM * PROFILE, {"modulus": 1.0}, None),
        (NM * PROFILE, {"length": 64e3}, None),
        (PROFILE, {"length": 64.0}, None),
        (PROFILE, {"length": 64e3}, LOW),
        (PROFILE, {"length": 64e3, "modulus": 1.0}, None),
        (np.zeros(64), {}, None),
        (1e-3 + 1e-19 * np.arange(64), {}, None),
        # heights in any order on a fine spacing, a punch in a wider profile, a pit
        (1e-6 * np.random.default_rng(1).standard_normal(4096), {}, None),
        (np.where(np.arange(64) < 20, 0.0, -1.0), {}, None),
        (np.where(np.arange(64) == 20, -1.0, PROFILE), {}, None),
    )),
    *((roll, height, settings, words) for roll in TRACKS for height, settings, words in (
        (TRACK, {}, None),
        (UM * (TRACK - TRACK.max()), {}, STEEP),
        (np.where(np.arange(96) == 20, -1.0, TRACK), {}, None),
    )),
    *((roll, 2e3 * (TRACK - TRACK.max()) / 1e-7, {"modulus": 1.0, "radius": (0.5, 0.4)}, None) for roll in TRACKS),
]  # fmt: skip


@catches(
    "heights in nm on a length in m that nobody asks about", call=curve, height=1e9 * PROFILE, settings={}, words=STEEP
).at("mdr.foundation.diagnose_heights", lambda *_: ())
@catches(
    "a track in um that nobody asks about", call=by_roll, height=1e6 * (TRACK - TRACK.max()), settings={}, words=STEEP
).at("mdr.rolling.diagnose_slope", lambda *_: ())
@pytest.mark.parametrize(("call", "height", "settings", "words"), OF_HEIGHTS)
def test_heights_in_another_unit_than_the_spacing(call, height, settings, words):
    """Where the modulus is the unit of pressure, heights may have one of their own."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        call(height, **settings)
    found = [w.message.detail for w in caught if w.category is mdr.SpringUnitsWarning]
    assert {w.filename for w in caught} <= {__file__}
    assert len(found) == (words is not None)
    assert all(sentence.startswith(words) and sentence.endswith(": are the units right?") for sentence in found)


def rough(height, q_max=3.0):
    """A track of long waves, so long that the ends of the contact are ends."""
    band = mdr.SelfAffine(hurst=0.7, q_min=0.5, q_max=q_max, rms=height)
    return mdr.rough_profile(band.c1d, length=400.0, points=400 * 32, rng=np.random.default_rng(3), rms=height)


@catches("ends of a linear contact that move twice as far", contact="linear", force=None).at(
    "mdr.rolling.diagnose_linearity",
    lambda height, change, **contact: diagnose_linearity(height, change / 2, **contact),
)
@pytest.mark.parametrize("contact", ["linear", "full"])
@pytest.mark.parametrize("force", [None, 4 / 3])
def test_the_ends_of_a_linear_contact_move_as_warned(contact, force):
    """The number in the sentence is the difference to one-sided springs, but for its third order."""
    height = rough(0.4)
    wheel = {"spacing": 1 / 32, "radius": 1.0, "modulus": 1.0}
    load = {"approach": 1.0} if force is None else {"force": force}
    linear, ((category, sentence, _),) = said(mdr.roll, height, **wheel, **load, contact=contact)
    assert category is mdr.LinearityWarning
    assert sentence.startswith(f"roughness of h_rms / d = {0.4:.2g} moves the ends of the contact")
    part = float(sentence.partition("second order ")[2].partition("%")[0]) / 100
    if force is None:
        true = mdr.roll(height, **wheel, **load)
        assert np.std(true.force - linear.force) / np.std(linear.force) == pytest.approx(part, rel=0.3)


@pytest.mark.parametrize(("height", "warned"), [(0.01, False), (0.05, False), (0.5, True)])
def test_no_warning_of_low_roughness(height, warned):
    _, found = said(mdr.roll, rough(height), spacing=1 / 32, **WHEEL, contact="linear")
    assert [category for category, _, _ in found] == [mdr.LinearityWarning] * warned
    assert said(mdr.roll, rough(height), spacing=1 / 32, **WHEEL)[1] == []
    assert said(mdr.roll, np.zeros(800), spacing=1 / 32, **WHEEL, contact="full")[1] == []


@pytest.mark.parametrize("contact", ["linear", "full"])
@pytest.mark.parametrize("by", ["approach", "force"])
def test_units_do_not_matter_to_what_is_left_out(contact, by):
    """Lengths and moduli that are powers of two: the same sentence."""
    height = rough(0.5)

    def sentence(metre, pascal):
        load = {"approach": metre} if by == "approach" else {"force": 4 / 3 * metre**2 * pascal}
        wheel = {"spacing": metre / 32, "radius": metre, "modulus": pascal, "contact": contact}
        ((_, words, _),) = said(mdr.roll, metre * height, **wheel, **load)[1]
        return words

    assert sentence(2.0**-6, 2.0**20) == sentence(1.0, 1.0)


def test_a_loop_is_warned_once_of_a_cause():
    """By Python's default filter: the numbers change from call to call, the text does not."""
    curve, track = parabola(40), rough(0.5)
    with warnings.catch_warnings(record=True) as caught:
        warnings.resetwarnings()
        for i in range(1, 4):
            curve.at_approach(0.01 * i)
            curve.at_force(1e-4 * i)
            mdr.press_sphere(radius=1.0, modulus=1.0, approach=1.0 + i)
            mdr.roll(np.zeros(80), spacing=0.25 * i, radius=1.0, modulus=1.0, approach=1.0)
            mdr.roll(track, spacing=1 / 32, radius=1.0 + i / 10, modulus=1.0, approach=1.0, contact="linear")
            band = mdr.SelfAffine(hurst=0.8, q_min=1.0, q_max=2 + i / 10, rms=1e-2)
            mdr.rough_profile(band.c1d, length=64.0, points=64, rng=np.random.default_rng(0))
    few = mdr.SpringResolutionWarning
    assert [w.category for w in caught] == [few, few, mdr.SpringUnitsWarning, few, mdr.LinearityWarning, few]
    assert len({str(w.message) for w in caught}) == 5
    assert {w.filename for w in caught} == {__file__}
    assert mdr.SpringContactWarning("alone").detail == "alone"
